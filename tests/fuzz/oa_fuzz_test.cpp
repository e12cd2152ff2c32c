// The reader of webOAcard's designs against files that nobody would save. Seeded, so that a failure comes
// again.
//
// Whatever the bytes, reading ends, crashes nothing, and says what is wrong where it stands; and whatever is
// read holds what assemblies promise, opens and closes, and is unfolded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "input/assembly/guarantees.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "popup/pattern.h"
#include "support/mutate_json.h"
#include "support/random.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Json;
using test::mutated_bytes;
using test::mutated_values;
using test::Random;
using test::sanitized_count;

const std::vector<std::string>& seeds() {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> all;
        for (const std::string name : {"villa.oa", "citadel.oa"})
            all.push_back(test::read_file(std::string(POPUP_SOURCE_DIR) + "/samples/" + name));
        all.emplace_back(
            R"({"settings": {"cardW": 60, "cardH": 50}, "faces": [{"contours": [{"outer": [{"X": 10, "Y": 20},
{"X": 40, "Y": 20}, {"X": 40, "Y": 0}, {"X": 10, "Y": 0}], "holes": [[{"X": 20, "Y": 15}, {"X": 30, "Y": 15},
{"X": 25, "Y": 5}], []]}], "contoursType": "expolygons", "type": "VFACE", "mode": 0, "t": 20, "timestamp": 7},
{"contours": [{"outer": [{"X": 5, "Y": 30}, {"X": 15, "Y": 30}, {"X": 5, "Y": 10}, {"X": 15, "Y": 10}]}],
"mode": 2, "t": 30}, {"contours": [{"outer": [{"X": 12, "Y": 4}, {"X": 38, "Y": 9}, {"X": 12, "Y": 9}]}],
"mode": 1, "t": 25, "timestamp": 3}]})");
        return all;
    }();
    return texts;
}

void expect_sound(const std::string& text) {
    Diagnostics diagnostics("card.oa");
    const Source source{"card.oa", text};
    const Reading reading = read_source_text(source, {}, diagnostics);
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    for (const Diagnostic& one : diagnostics.sorted()) {
        EXPECT_GE(one.place.line, 0);
        EXPECT_LE(one.place.line, lines);
    }
    if (!reading.assembly) {
        EXPECT_TRUE(diagnostics.has_errors()) << text;
        return;
    }
    const Assembly& assembly = *reading.assembly;
    for (const AssemblyFault& fault : faults_of(assembly)) ADD_FAILURE() << fault.what << "\n" << text;
    std::vector<Frame> frames(assembly.plates.size());
    for (const double deg : {0.0, 40.0, 90.0, 180.0}) {
        ASSERT_TRUE(place(assembly, Angle::degrees(deg), frames)) << text;
        EXPECT_LT(closure_error(assembly, frames), 1e-6) << text;
    }
    EXPECT_TRUE(make_pattern(assembly, {}, diagnostics)) << text;
}

TEST(OaFuzz, SeedsAreSound) {
    for (const std::string& text : seeds()) expect_sound(text);
}

TEST(OaFuzz, DamagedBytes) {
    Random random(4101);
    for (int n = 0; n < sanitized_count(6000); ++n)
        expect_sound(mutated_bytes(seeds()[random.below(seeds().size())], random));
}

TEST(OaFuzz, StrangeValues) {
    Random random(4102);
    for (int n = 0; n < sanitized_count(1500); ++n)
        expect_sound(mutated_values(seeds()[random.below(seeds().size())], random));
}

// Many polygons over each other: it ends, with a card or an error.
TEST(OaFuzz, TangledContours) {
    Random random(4103);
    for (int n = 0; n < sanitized_count(60); ++n) {
        Json card{{"settings", {{"cardW", 100}, {"cardH", 100}}}, {"faces", Json::array()}};
        const std::size_t faces = 1 + random.below(12);
        for (std::size_t i = 0; i < faces; ++i) {
            Json ring = Json::array();
            const std::size_t corners = 3 + random.below(60);
            for (std::size_t k = 0; k < corners; ++k)
                ring.push_back({{"X", 120.0 * random.unit() - 10.0}, {"Y", 200.0 * random.unit() - 100.0}});
            card["faces"].push_back({{"contours", {{{"outer", ring}, {"holes", Json::array()}}}},
                                     {"mode", random.below(3)},
                                     {"t", 1.0 + 99.0 * random.unit()}});
        }
        expect_sound(card.dump());
    }
}

}  // namespace
}  // namespace popup
