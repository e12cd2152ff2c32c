// The reader of DXF against files that nobody would write. Seeded, so that a failure comes again.
//
// Whatever the bytes, reading ends, crashes nothing, and says what is wrong where it stands; and whatever is
// read can be folded or laid out, or that is refused with an error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "input/assembly/guarantees.h"
#include "popup/language.h"
#include "popup/pattern.h"
#include "support/dxf_text.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Random;

// A carton with its tables; blocks in blocks on a grid; every kind of curve.
const std::vector<std::string>& seeds() {
    static const std::vector<std::string> texts{
        test::dxf_file("0 LWPOLYLINE|8 CUT|90 6|70 1|10 0|20 0|10 90|20 0|42 0.4|10 95|20 20|10 90|20 40|10 "
                       "45|20 44|10 0|20 40|0 "
                       "LINE|8 CREASE|10 30|20 0|11 30|21 42|0 LINE|8 CREASE|62 5|10 60|20 0|11 60|21 42|0 "
                       "CIRCLE|8 CUT|10 45|20 "
                       "20|40 5|0 TEXT|8 0|10 1|20 1|40 3|1 box",
                       "0 TABLE|2 LTYPE|0 LTYPE|2 RILL|73 2|49 3|49 -1|0 ENDTAB|0 TABLE|2 LAYER|0 LAYER|2 "
                       "CUT|70 0|62 7|6 "
                       "CONTINUOUS|0 LAYER|2 CREASE|70 0|62 1|6 RILL|0 ENDTAB",
                       {}, "9 $ACADVER|1 AC1015|9 $INSUNITS|70 4"),
        test::dxf_file(
            "0 INSERT|8 CUT|2 PAIR|10 5|20 5|41 2|42 -1|50 30|70 3|71 2|44 60|45 50|0 INSERT|8 0|2 ONE|10 "
            "200|20 9|210 0|220 0|230 -1",
            {},
            "0 BLOCK|2 ONE|70 0|10 1|20 1|0 LWPOLYLINE|8 0|62 0|90 3|70 1|10 0|20 0|10 9|20 0|10 5|20 9|0 "
            "ENDBLK|0 BLOCK|2 PAIR|10 0|20 0|0 INSERT|8 0|2 ONE|10 0|20 0|0 INSERT|8 0|2 ONE|10 20|20 "
            "0|50 90|0 ENDBLK",
            "9 $MEASUREMENT|70 1"),
        test::dxf_file("0 SPLINE|8 0|70 12|71 2|72 6|73 3|40 0|40 0|40 0|40 1|40 1|40 1|41 1|41 0.7|41 1|10 "
                       "50|20 0|10 50|20 50|10 "
                       "0|20 50|0 SPLINE|8 0|70 8|71 3|74 3|11 0|21 50|11 -30|21 30|11 0|21 0|0 LINE|8 0|10 "
                       "0|20 0|11 50|21 0|0 "
                       "ELLIPSE|8 0|10 20|20 20|11 4|21 3|40 0.5|41 0|42 6.283185307|0 POLYLINE|8 FOLD|66 "
                       "1|70 0|0 VERTEX|8 "
                       "0|10 0|20 0|42 0.3|0 VERTEX|8 0|10 35|20 35|0 SEQEND|8 0|0 ARC|8 0|10 80|20 0|40 "
                       "9|50 10|51 200")};
    return texts;
}

constexpr std::array<std::string_view, 34> kPieces{"0\n",           "EOF\n",
                                                   "0\nENDSEC\n",   "0\nSECTION\n",
                                                   "0\nLINE\n",     "0\nINSERT\n",
                                                   "0\nENDBLK\n",   "0\nBLOCK\n",
                                                   "0\nSEQEND\n",   "0\nVERTEX\n",
                                                   "999\n",         "nan",
                                                   "1e308",         "-1e308",
                                                   "1e9",           "1e-320",
                                                   "-0.0",          "99999999999",
                                                   "\xFF",          "\r",
                                                   "\r\n",          "\n",
                                                   "42\n1\n",       "70\n1\n",
                                                   "62\n-7\n",      "67\n1\n",
                                                   "8\nMOUNTAIN\n", "230\n-1\n",
                                                   "2\nONE\n",      "2\nPAIR\n",
                                                   "70\n30000\n",   "71\n30000\n",
                                                   "\\U+0041",      " "};

std::string mutated(std::string text, Random& random) {
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = random.below(text.size());
        const std::size_t length = std::min(random.below(20), text.size() - at);
        switch (random.below(5)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, kPieces.at(random.below(kPieces.size())));
                break;
            case 2:
                text[at] = static_cast<char>(random.below(256));
                break;
            case 3:
                text.insert(random.below(text.size()), text.substr(at, random.below(80)));
                break;
            default:
                text.resize(text.size() - random.below(40) % text.size());
                break;
        }
    }
    return text;
}

// Whole lines changed: mostly still DXF.
std::string mutated_lines(const std::string& text, Random& random) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    constexpr std::array<std::string_view, 16> kValues{"0", "1",   "-1",  "0.5",  "1e6", "-1e-9",
                                                       "3", "360", "45",  "1e20", "255", "256",
                                                       "2", "64",  "100", "CUT"};
    const std::size_t changes = 1 + random.below(5);
    for (std::size_t i = 0; i < changes; ++i) {
        // Values, and seldom a code.
        const std::size_t pair = random.below(lines.size() / 2);
        lines[2 * pair + (random.below(6) == 0 ? 0U : 1U)] = kValues.at(random.below(kValues.size()));
        if (random.below(4) == 0) {
            const std::size_t from = 2 * random.below(lines.size() / 2);
            const std::vector<std::string> some(
                lines.begin() + static_cast<std::ptrdiff_t>(from),
                lines.begin() +
                    static_cast<std::ptrdiff_t>(std::min(lines.size(), from + 2 * random.below(8))));
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(2 * random.below(lines.size() / 2)),
                         some.begin(), some.end());
        }
    }
    std::string made;
    for (const std::string& line : lines) made += line + "\n";
    return made;
}

void expect_sound(const std::string& text) {
    Diagnostics diagnostics("box.dxf");
    const Reading reading = read_source_text(Source{"box.dxf", text}, {}, diagnostics);
    const auto lines =
        1 + std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
    for (const Diagnostic& one : diagnostics.sorted()) {
        EXPECT_GE(one.place.line, 0);
        EXPECT_LE(one.place.line, lines) << one.message << "\n" << text;
    }
    if (!reading.creases && !reading.assembly) {
        EXPECT_TRUE(diagnostics.has_errors()) << text;
        return;
    }
    const auto assembly = reading.creases ? fold_sheet(*reading.creases, {}, diagnostics) : reading.assembly;
    if (!assembly) {
        EXPECT_TRUE(diagnostics.has_errors()) << text;
        return;
    }
    for (const AssemblyFault& fault : faults_of(*assembly)) ADD_FAILURE() << fault.what << "\n" << text;
    EXPECT_TRUE(make_pattern(*assembly, {}, diagnostics) || diagnostics.has_errors()) << text;
}

TEST(DxfFuzz, SeedsAreSound) {
    for (const std::string& text : seeds()) {
        expect_sound(text);
        const test::TracedDxf read = test::traced_dxf(text);
        EXPECT_TRUE(read.tracing) << read.told;
    }
}

TEST(DxfFuzz, DamagedBytes) {
    Random random(21);
    for (int i = 0; i < test::sanitized_count(2000); ++i)
        expect_sound(mutated(seeds()[random.below(seeds().size())], random));
}

TEST(DxfFuzz, DamagedValues) {
    Random random(22);
    for (int i = 0; i < test::sanitized_count(2000); ++i)
        expect_sound(mutated_lines(seeds()[random.below(seeds().size())], random));
}

}  // namespace
}  // namespace popup
