// Drawings that are cards, held against the lines that were drawn: on the sheet is what the drawing shows.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input/drawing/card/read.h"
#include "output/xml.h"
#include "popup/compile.h"
#include "popup/mechanism.h"
#include "support/drawn_cards.h"
#include "support/line_sets.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Hand;
using test::HandOptions;
using test::InkedCard;
using test::Pen;

CompileOptions card_options() {
    CompileOptions options;
    options.read.drawing.as = DrawnAs::card;
    options.until = Stage::pattern;
    options.motion.examine = false;
    return options;
}

CompiledDesign compiled(const std::string& name, std::string text) {
    return compile({Source{name, std::move(text)}}, card_options(), {}).designs.front();
}

// "3:5 end-moved" a finding that is no remark, worst first.
std::string findings(const CompiledDesign& one) {
    std::string text;
    for (const Diagnostic& told : one.diagnostics.sorted()) {
        if (told.severity == Severity::remark || told.code == "protrusion") continue;
        text += fmt::format("{}:{} {}: {}\n", told.place.line, told.place.column, told.code, told.message);
    }
    return text;
}

// "box-fold beak": the elements, in their order.
std::string elements(const CompiledDesign& one) {
    std::string text;
    if (!one.design) return "nothing";
    for (const Structure& s : one.design->structures) text += (text.empty() ? "" : " ") + s.type;
    return text;
}

// The sheet of a card that is turned upright has the drawing's upper half on the left.
void expect_drawn(const InkedCard& card, const CompiledDesign& one, double within, const std::string& what) {
    ASSERT_TRUE(one.pattern) << what << findings(one);
    ASSERT_EQ(one.pattern->pieces.size(), 1U) << what;
    EXPECT_LE(test::apart(card.sets(), test::lines_of(one.pattern->pieces.front())), within) << what;
}

// A house with a step before it, a tree, a beak, a window and a star.
InkedCard town() {
    InkedCard card;
    card.width = 240;
    card.height = 180;
    const auto fold = [&](Pen pen, double x, double from, double to) {
        card.line(pen, {{x, from}, {x, to}});
    };
    // The house: 45 deep on the left, 30 on the right.
    card.line(Pen::cut, {{-45, -60}, {30, -60}});
    card.line(Pen::cut, {{-45, -10}, {30, -10}});
    fold(Pen::valley, -45, -60, -10);
    fold(Pen::mountain, -15, -60, -10);
    fold(Pen::valley, 30, -60, -45);
    fold(Pen::valley, 30, -25, -10);
    // The step on its right fold: 12 and 20.
    card.line(Pen::cut, {{18, -45}, {50, -45}});
    card.line(Pen::cut, {{18, -25}, {50, -25}});
    fold(Pen::valley, 18, -45, -25);
    fold(Pen::mountain, 38, -45, -25);
    fold(Pen::valley, 50, -45, -25);
    card.line(Pen::cut, {{-6, -50}, {6, -50}, {6, -48}, {-6, -45}}, true);
    // The tree: 35 and 25.
    card.cubic(Pen::cut, {-35, 23}, {-28, 10}, {-16, 10}, {-10, 16});
    card.cubic(Pen::cut, {-10, 16}, {-4, 22}, {-2, 21}, {0, 21});
    card.cubic(Pen::cut, {0, 21}, {10, 21}, {18, 24}, {25, 28});
    card.cubic(Pen::cut, {25, 48}, {18, 52}, {8, 51}, {0, 53});
    card.line(Pen::cut, {{0, 53}, {-10, 57}, {-35, 48}});
    fold(Pen::valley, -35, 23, 48);
    fold(Pen::mountain, -10, 16, 57);
    fold(Pen::valley, 25, 28, 48);
    // The beak.
    card.line(Pen::cut, {{-16, 82}, {12, 82}});
    card.line(Pen::valley, {{0, 68}, {-16, 82}});
    card.line(Pen::valley, {{0, 68}, {12, 82}});
    card.line(Pen::mountain, {{0, 68}, {-14 * std::tan(std::atan2(16, 14) - std::atan2(12, 14)), 82}});
    for (const auto& [from, to] : {std::pair{-90.0, -60.0}, {-10.0, 21.0}, {53.0, 68.0}, {82.0, 90.0}})
        fold(Pen::valley, 0, from, to);
    card.line(Pen::cut, {{-90, 20}, {-70, 20}, {-80, 30}}, true);
    return card;
}

TEST(DrawnCard, EveryHandDrawsTheSameCard) {
    const InkedCard card = town();
    for (const Hand hand : test::kHands) {
        for (const bool lying : {false, true}) {
            for (const bool doubled : {false, true}) {
                const std::string what =
                    fmt::format("hand {} lying {} doubled {}", static_cast<int>(hand), lying, doubled);
                HandOptions options;
                options.lying = lying;
                options.doubled = doubled;
                const CompiledDesign one = compiled("town.svg", test::draw_card(card, hand, options));
                EXPECT_EQ(findings(one), "") << what;
                expect_drawn(card, one, 0.01, what);
                std::string found = elements(one);
                EXPECT_EQ(std::count(found.begin(), found.end(), ' '), 5) << found;
                for (const std::string type : {"box-fold", "freeform", "beak", "hole"})
                    EXPECT_NE(found.find(type), std::string::npos) << what << found;
            }
        }
    }
}

TEST(DrawnCard, RandomCardsComeOutAsTheyAreDrawn) {
    int features = 0;
    for (std::uint64_t seed = 1; seed <= test::sanitized_count<std::uint64_t>(150, 5); ++seed) {
        const InkedCard card = test::CardMaker(seed).run();
        features += card.features;
        HandOptions options;
        options.lying = seed % 3 == 0;
        options.doubled = seed % 5 == 0;
        const std::string text = test::draw_card(card, test::kHands.at(seed % 6), options, seed);
        const CompiledDesign one = compiled("random.svg", text);
        const std::string what = fmt::format("seed {}\n", seed);
        EXPECT_EQ(findings(one), "") << what << text;
        expect_drawn(card, one, 0.01, what);
        if (HasFailure()) return;
        // The document of it makes the same sheet.
        ASSERT_TRUE(one.checked);
        CompileOptions plain = card_options();
        const Compilation again =
            compile({Source{"random.xml", write_document(one.checked->design())}}, plain, {});
        EXPECT_FALSE(again.has_findings()) << what << findings(again.designs.front());
        expect_drawn(card, again.designs.front(), 0.01, what);
        EXPECT_LE(test::apart(test::lines_of(one.pattern->pieces.front()),
                              test::lines_of(again.designs.front().pattern->pieces.front())),
                  1e-5)
            << what;
    }
    EXPECT_GT(features, test::sanitized_count(500, 5));
}

TEST(DrawnCard, EndsThatMissAreMovedAndTold) {
    std::size_t moved = 0;
    for (std::uint64_t seed = 1; seed <= test::sanitized_count<std::uint64_t>(300); ++seed) {
        const InkedCard card = test::CardMaker(seed).run();
        HandOptions options;
        options.jitter = 0.3;
        const std::string text = test::draw_card(card, test::kHands.at(seed % 6), options, seed);
        const CompiledDesign one = compiled("rough.svg", text);
        // A few have their hole on a fold, where it cannot be.
        if (!compiled("clean.svg", test::draw_card(card, test::kHands.at(seed % 6))).pattern) continue;
        // Ends were moved along their lines alone, so the sheet is the one that was meant.
        expect_drawn(card, one, 0.02, fmt::format("seed {}\n{}", seed, findings(one)));
        if (HasFailure()) return;
        for (const Diagnostic& told : one.diagnostics.sorted()) {
            if (told.code != "end-moved") continue;
            if (!told.change) continue;  // how many more there are
            ++moved;
            EXPECT_GT(told.place.line, 2);
        }
    }
    EXPECT_GT(moved, test::sanitized_count(200U));
}

}  // namespace
}  // namespace popup
