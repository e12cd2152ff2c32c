// The reader of drawn cards against drawings that are damaged, and lines that nobody would draw. Seeded.
//
// Whatever the lines, reading ends, crashes nothing and says what is wrong where it stands; and what is
// accepted without a word has every line of the drawing on its sheet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "input/drawing/card/read.h"
#include "popup/compile.h"
#include "support/drawn_cards.h"
#include "support/line_sets.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::InkedCard;
using test::Pen;
using test::Random;
using test::sanitized_count;

CompiledDesign compiled(const std::string& text, Stage until) {
    CompileOptions options;
    options.read.drawing.as = DrawnAs::card;
    options.until = until;
    options.motion.examine = false;
    return std::move(compile({Source{"card.svg", text}}, options, {}).designs.front());
}

void expect_sound(const CompiledDesign& one, const std::string& text) {
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    for (const Diagnostic& told : one.diagnostics.sorted()) {
        ASSERT_FALSE(told.message.empty());
        ASSERT_NE(find_code(told.code), nullptr);
        ASSERT_GE(told.place.line, 0);
        ASSERT_LE(told.place.line, lines);
    }
    // Of elements, or folded as it is drawn.
    ASSERT_EQ(one.checked.has_value() || one.assembly.has_value(), !one.diagnostics.has_errors());
    const std::vector<Diagnostic> told = one.diagnostics.sorted();
    const bool as_drawn = std::any_of(told.begin(), told.end(), [](const Diagnostic& found) {
        return found.code == "card-of-no-elements";
    });
    ASSERT_EQ(as_drawn, !one.checked.has_value() && one.assembly.has_value());
}

// Other digits, here and there.
std::string with_other_digits(std::string text, Random& random) {
    constexpr std::string_view kDigits = "0123456789-.";
    for (std::size_t i = 1 + random.below(5); i > 0; --i) {
        const std::size_t at = text.find_first_of("0123456789", random.below(text.size()));
        if (at != std::string::npos) text[at] = kDigits[random.below(kDigits.size())];
    }
    return text;
}

// Anything in place of some of it.
std::string damaged(std::string text, Random& random) {
    constexpr std::array<std::string_view, 12> kPieces{"<path d='M0 0L90 90'/>",
                                                       "<rect width='80' height='50'/>",
                                                       "z",
                                                       "M",
                                                       "<g>",
                                                       "'",
                                                       "1e9",
                                                       "nan",
                                                       "C",
                                                       "<circle cx='60' cy='60' r='20'/>",
                                                       "stroke='blue'",
                                                       ""};
    for (std::size_t i = 1 + random.below(3); i > 0; --i) {
        const std::size_t at = random.below(text.size());
        text.replace(at, std::min<std::size_t>(random.below(9), text.size() - at),
                     kPieces.at(random.below(kPieces.size())));
    }
    return text;
}

void fuzz_texts(std::uint64_t from, std::uint64_t to) {
    std::size_t accepted = 0;
    for (std::uint64_t seed = from; seed < to; ++seed) {
        Random random(seed);
        const InkedCard card = test::CardMaker(1 + seed % 40).run();
        std::string text = test::draw_card(card, test::kHands.at(seed % 6), {}, seed);
        text = seed % 2 == 0 ? with_other_digits(text, random) : damaged(text, random);
        const CompiledDesign one = compiled(text, Stage::check);
        expect_sound(one, text);
        accepted += one.checked ? 1 : 0;
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ":\n" << text;
            return;
        }
    }
    EXPECT_GT(accepted, (to - from) / 20);
}

Vec2 somewhere(const InkedCard& card, Random& random) {
    return {(random.unit() - 0.5) * card.width, (random.unit() - 0.5) * card.height};
}

// A page full of lines that mean nothing.
void fuzz_lines(std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t seed = from; seed < to; ++seed) {
        Random random(seed);
        InkedCard card;
        card.line(Pen::valley, {{0, -80}, {0, 80}});
        // Many of them on a grid, so that they meet, run along each other and make faces.
        const auto pen = [&] { return static_cast<Pen>(random.below(3)); };
        const auto point = [&] {
            const Vec2 p = somewhere(card, random);
            if (seed % 3 == 0) return p;
            return Vec2{10.0 * std::round(0.1 * p.x), 10.0 * std::round(0.1 * p.y)};
        };
        for (std::size_t i = 4 + random.below(40); i > 0; --i) {
            switch (random.below(4)) {
                case 0:
                    card.line(pen(), {point(), point(), point()}, true);
                    break;
                case 1:
                    card.cubic(pen(), point(), point(), point(), point());
                    break;
                default: {
                    const Vec2 p = point();
                    const double size = 10.0 * static_cast<double>(1 + random.below(5));
                    card.line(pen(), {p, p + (random.below(2) == 0 ? Vec2{size, 0} : Vec2{0, size})});
                }
            }
        }
        const std::string text = test::draw_card(card, test::kHands.at(seed % 6), {}, seed);
        const CompiledDesign one = compiled(text, Stage::check);
        expect_sound(one, text);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ":\n" << text;
            return;
        }
    }
}

// The lines in short pieces, without those in the area.
test::LineSets without(const test::LineSets& sets, const Ring& ring) {
    const Polygon area{ring, {}};
    test::LineSets kept;
    for (const auto& [name, lines] : sets) {
        kept[name];
        for (const Segment& s : lines) {
            const int count = 1 + static_cast<int>(distance(s.a, s.b) / 0.5);
            for (int i = 0; i < count; ++i) {
                const Segment part{lerp(s.a, s.b, static_cast<double>(i) / count),
                                   lerp(s.a, s.b, static_cast<double>(i + 1) / count)};
                if (!contains(area, part.a) && !contains(area, part.b)) kept[name].push_back(part);
            }
        }
    }
    return kept;
}

// A card with one line more than it should have: that line is told of, or it is on the sheet.
void fuzz_one_more(std::uint64_t from, std::uint64_t to) {
    std::size_t taken = 0;
    for (std::uint64_t seed = from; seed < to; ++seed) {
        Random random(seed);
        InkedCard card = test::CardMaker(1 + seed % 60).run();
        const auto pen = static_cast<Pen>(random.below(3));
        const Vec2 p = somewhere(card, random);
        const double size = 4.0 + 20.0 * random.unit();
        const auto kind = random.below(3);
        if (kind == 0)
            card.line(pen, {p, p + size * unit(somewhere(card, random))});
        else if (kind == 1)
            card.line(pen, {p, p + Vec2{0.0, size}});
        else
            card.line(Pen::cut, {p, p + Vec2{size, 0.0}, p + Vec2{0.5 * size, size}}, true);
        const std::string text = test::draw_card(card, test::kHands.at(seed % 6), {}, seed);
        const CompiledDesign one = compiled(text, Stage::pattern);
        bool told = false;
        for (const Diagnostic& finding : one.diagnostics.sorted()) {
            told = told || (finding.severity != Severity::remark && finding.code != "protrusion") ||
                   finding.code == "folds-found";
        }
        if (told) continue;
        ++taken;
        ASSERT_TRUE(one.pattern);
        const test::LineSets made = test::lines_of(one.pattern->pieces.front());
        test::LineSets drawn = card.sets();
        // What falls out with a hole is not cut.
        if (kind == 2) drawn = without(drawn, card.lines.back().points);
        test::LineSets all = card.sets();
        for (const auto& [pen_name, lines] : made)
            EXPECT_LE(test::furthest(lines, all[pen_name], 1.0), 0.02) << "seed " << seed << ":\n" << text;
        for (const auto& [pen_name, lines] : drawn) {
            const auto found = made.find(pen_name);
            ASSERT_NE(found, made.end());
            EXPECT_LE(test::furthest(lines, found->second, 1.0), 0.02) << "seed " << seed << ":\n" << text;
        }
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(taken, (to - from) / 40);
}

TEST(DrawnCardFuzz, DamagedDrawings) { fuzz_texts(1, sanitized_count(1500)); }
TEST(DrawnCardFuzz, LinesWithoutSense) { fuzz_lines(1, sanitized_count(1500)); }
TEST(DrawnCardFuzz, OneLineMoreIsToldOrMade) { fuzz_one_more(1, sanitized_count(600)); }

TEST(LongDrawnCardFuzz, ManyDrawings) {
    fuzz_texts(1500, 40'000);
    fuzz_lines(1500, 60'000);
    fuzz_one_more(600, 10'000);
}

}  // namespace
}  // namespace popup
