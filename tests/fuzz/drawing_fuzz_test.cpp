// The reader of drawings against drawings that nobody would make. Seeded, so that a failure comes again.
//
// Whatever the bytes, reading ends, crashes nothing, and says what is wrong where it stands; and whatever is
// read keeps what flat_parts.h promises and becomes a pattern.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "popup/pattern.h"
#include "support/drawings.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Random;

const std::array<std::string, 4> kSeeds{
    R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" viewBox="0 0 100 80" fill="none" stroke="red">
<style>.v{stroke:#f0f;stroke-dasharray:3 1} #lid{fill:#abc}</style>
<path id="lid" d="M10 10h30v20a5 5 0 0 1-5 5H15q-5 0-5-5z"/><circle cx="20" cy="20" r="3"/><path class="v" d="M10 25H40"/>
<g id="lines" transform="translate(50 5) rotate(10)"><line x2="20"/><path d="M20 0C25 5 25 15 20 20"/><polyline points="20 20 0 20 0 0"/></g>
</svg>)svg",
    R"svg(<?xml version="1.0"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "x.dtd"><s:svg xmlns:s="http://www.w3.org/2000/svg"
 xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="-5 -5 300 200"><s:defs><s:symbol id="a" viewBox="0 0 2 2"><s:path d="M0 0 2 0 1 2zM.5.5 1.5.5 1 1z"
 fill="#00f" fill-rule="evenodd"/></s:symbol></s:defs><s:use xlink:href="#a" x="3" width="50" height="40%"/><s:use xlink:href="#a" transform="scale(20) skewX(20)"/>
<s:text>no</s:text></s:svg>)svg",
    R"svg(<svg width="4in" height="3in"><g style="stroke:rgb(0,0,0);fill:none"><ellipse cx="1in" cy="1in" rx=".8in" ry="1cm"/><rect x="2in" y="5mm" width="1in" height="2in" rx="3"/>
<rect x="2.2in" y="10mm" width=".5in" height="10%"/><svg x="10" y="200" width="80" height="60" viewBox="0 0 4 3" preserveAspectRatio="none"><polygon points="0 0 4 0 2 3"/><path d="m1,.5t1 0 1,0s-1 1-1 2z"/></svg></g></svg>)svg",
    R"svg(<svg xmlns:inkscape="x" width="60mm" height="60mm" viewBox="0 0 60 60"><g class="sheet"><g inkscape:groupmode="layer" inkscape:label="fill" stroke="none"><g data-piece="p" data-design="d"><path fill="#123456" d="M5,5L55,5L55,55L5,55Z"/></g></g>
<g inkscape:groupmode="layer" inkscape:label="label"><g data-piece="p" data-design="d"><text x="30" y="30" font-size="5" transform="rotate(-90 30 30)">p</text></g></g>
<g inkscape:groupmode="layer" inkscape:label="valley" fill="none" stroke="#ff00ff"><g data-piece="p" data-design="d"><path stroke-dasharray="3 1" d="M5,30L55,30"/></g></g>
<g inkscape:groupmode="layer" inkscape:label="cut" fill="none" stroke="#ff0000"><g data-piece="p" data-design="d"><path d="M5,5L55,5L55,55L5,55Z"/><path d="M20,20L40,20"/></g><g data-piece="q" data-design="d"><path d="M20,25L40,25L40,40Z"/></g></g></g></svg>)svg",
};

constexpr std::array<std::string_view, 60> kPieces{"<",
                                                   ">",
                                                   "/>",
                                                   "\"",
                                                   "&",
                                                   "&amp;",
                                                   "&#49;",
                                                   "&x;",
                                                   "<!--",
                                                   "-->",
                                                   "<![CDATA[",
                                                   "]]>",
                                                   "<?",
                                                   "\0",
                                                   "\xC3\xA4",
                                                   "\xFF",
                                                   "\r\n",
                                                   " ",
                                                   "nan",
                                                   "1e308",
                                                   "1e-320",
                                                   "-",
                                                   ",",
                                                   ".",
                                                   "e",
                                                   "0",
                                                   "1",
                                                   "999999",
                                                   "-0",
                                                   "1e5",
                                                   "z",
                                                   "Z",
                                                   "M",
                                                   "m10 10",
                                                   "a1 1 0 1 1 5 5",
                                                   "A0 0 0 0 0 1 1",
                                                   "c1 1 2 2 3 3",
                                                   "s1 1 2 2",
                                                   "q9 9",
                                                   "t1 1",
                                                   "h5",
                                                   "V9",
                                                   "%",
                                                   "mm",
                                                   "</svg>",
                                                   "<g>",
                                                   "</g>",
                                                   "<use href='#a'/>",
                                                   "<use href='#lid' x='1'/>",
                                                   "<rect width='9' height='9'/>",
                                                   "<circle r='4'/>",
                                                   "<path d='M0 0H9V9'/>",
                                                   "transform='scale(0)'",
                                                   "transform='matrix(1 2 2 4 0 0)'",
                                                   "display:none",
                                                   "stroke:none",
                                                   "fill='red'",
                                                   "id='lid'",
                                                   "style='",
                                                   "{"};

std::string mutated(const std::string& seed, Random& random) {
    std::string text = seed;
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t i = 0; i < changes; ++i) {
        const std::size_t at = random.below(text.size() + 1);
        const std::size_t length = std::min(random.below(12), text.size() - at);
        switch (random.below(6)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, kPieces.at(random.below(kPieces.size())));
                break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(random.below(256));
                break;
            case 3:
                text.insert(random.below(text.size() + 1), text.substr(at, random.below(80)));
                break;
            case 4:
                text.resize(at);
                break;
            default:
                text.replace(at, length, kPieces.at(random.below(kPieces.size())));
                break;
        }
    }
    return text;
}

// Changes that mostly leave a drawing what it is: other digits, and shapes between tags.
std::string mutated_gently(const std::string& seed, Random& random) {
    constexpr std::array<std::string_view, 8> kBetween{" ",
                                                       "<!-- > -->",
                                                       "<rect x='7' y='8' width='9' height='9'/>",
                                                       "<path d='M3 3L30 30'/>",
                                                       "<path d='M3 3L30 30L5 20L30 5z'/>",
                                                       "<circle cx='20' cy='20' r='1'/>",
                                                       "<a/>",
                                                       "<use href='#lid' x='11'/>"};
    constexpr std::array<std::string_view, 10> kNumbers{"0",  "7",   "12",  "&#53;", "40",
                                                        "1.", "3e1", ".25", "-3",    "55"};
    std::string text = seed;
    const std::size_t changes = 1 + random.below(6);
    for (std::size_t i = 0; i < changes; ++i) {
        const bool between = random.below(3) == 0;
        const std::size_t at = text.find_first_of(between ? ">" : "0123456789", random.below(text.size()));
        if (at == std::string::npos) continue;
        if (between) {
            text.insert(at + 1, kBetween.at(random.below(kBetween.size())));
        } else {
            text.replace(at, 1, kNumbers.at(random.below(kNumbers.size())));
        }
    }
    return text;
}

void check_part(const FlatPart& part, std::set<std::string>& names) {
    ASSERT_FALSE(part.name.empty());
    ASSERT_TRUE(names.insert(part.name).second) << part.name;
    ASSERT_GE(part.place.line, 1);
    ASSERT_FALSE(part.paper.empty()) << part.name;
    for (const Polygon& paper : part.paper) {
        ASSERT_GE(paper.outer.size(), 3U);
        ASSERT_GT(signed_area(paper.outer), 0.0);
        ASSERT_GT(area(paper), -1e-6);
        for (const Vec2 p : paper.outer) ASSERT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1e5);
        for (const Ring& hole : paper.holes) ASSERT_LT(signed_area(hole), 0.0);
    }
    for (const auto& slit : part.slits) ASSERT_GE(slit.size(), 2U);
    for (const FlatLine& line : part.lines) ASSERT_GE(line.points.size(), 2U);
}

void check_one(const std::string& text, std::size_t& read) {
    const auto reading = test::read_drawing(text);
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    bool errors = false;
    for (const Diagnostic& d : reading.findings) {
        errors = errors || d.severity == Severity::error;
        ASSERT_FALSE(d.message.empty());
        ASSERT_NE(find_code(d.code), nullptr);
        ASSERT_LE(d.place.line, lines);
        ASSERT_TRUE(d.place.line >= 1 || d.code == "empty-input" || d.code == "no-contours" ||
                    d.code == "document-too-large")
            << d.code;
        ASSERT_EQ(d.place.line >= 1, d.place.column >= 1);
    }
    ASSERT_EQ(reading.list.has_value(), !errors);
    if (!reading.list) return;
    ++read;
    ASSERT_FALSE(reading.parts().empty());
    std::set<std::string> names;
    for (const FlatPart& part : reading.parts()) check_part(part, names);
    Diagnostics diagnostics;
    const auto pattern = make_pattern(assembly_of(*reading.list), {}, diagnostics);
    ASSERT_TRUE(pattern);
    ASSERT_EQ(pattern->pieces.size(), reading.parts().size());
    for (const PatternPiece& piece : pattern->pieces) ASSERT_FALSE(piece.cuts.empty());
}

void fuzz(std::uint64_t seed, int rounds) {
    Random random(seed);
    std::size_t read = 0;
    for (int i = 0; i < rounds; ++i) {
        const std::string& start = kSeeds.at(random.below(kSeeds.size()));
        const std::string text = i % 2 == 0 ? mutated(start, random) : mutated_gently(start, random);
        check_one(text, read);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ", round " << i << ":\n" << text;
            return;
        }
    }
    // Refused drawings test only half of the reader.
    EXPECT_GT(read, static_cast<std::size_t>(rounds) / 10);
}

TEST(DrawingFuzz, SeedsThemselvesAreRead) {
    for (const std::string& text : kSeeds) {
        std::size_t read = 0;
        check_one(text, read);
        EXPECT_EQ(read, 1U) << test::read_drawing(text).codes() << text;
    }
}

TEST(DrawingFuzz, EveryTruncationIsRefusedOrRead) {
    for (const std::string& text : kSeeds) {
        std::size_t read = 0;
        for (std::size_t length = 0; length < text.size(); ++length) check_one(text.substr(0, length), read);
        EXPECT_EQ(read, 0U);
    }
}

TEST(DrawingFuzz, MutatedDrawings) { fuzz(1, test::sanitized_count(10'000)); }

TEST(LongDrawingFuzz, ManyMutatedDrawings) {
    for (std::uint64_t seed = 2; seed < 40; ++seed) fuzz(seed, 10'000);
}

}  // namespace
}  // namespace popup
