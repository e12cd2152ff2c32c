// The reader of assemblies against texts that nobody would write. Seeded, so that a failure comes again.
//
// Whatever the bytes, reading ends, crashes nothing, and says what is wrong where it stands; and whatever is
// read holds what assemblies promise, moves, is unfolded, and is read again as the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "input/assembly/guarantees.h"
#include "output/emit.h"
#include "popup/motion.h"
#include "popup/pattern.h"
#include "support/designs.h"
#include "support/random.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Random;
using Json = nlohmann::ordered_json;

Reading read(const std::string& text, Diagnostics& diagnostics) {
    return read_source_text(Source{"a.assembly.json", text}, {}, diagnostics);
}

// Elements of all kinds, flat parts, and a piece that is glued on another.
const std::vector<std::string>& seeds() {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> all;
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            const test::Built built = test::build(test::generate(seed, 3));
            all.push_back(emit_assembly(*built.assembly));
        }
        for (const std::string name : {"samples/parts.svg", "samples/tree.xml", "tests/cases/box/sound.xml",
                                       "tests/cases/floating-layer/sound.xml",
                                       "tests/cases/disc/behind-its-window.xml", "samples/flatlang/box.fl"}) {
            const std::string path = std::string(POPUP_SOURCE_DIR) + "/" + name;
            if (!std::ifstream(path)) continue;
            Diagnostics diagnostics;
            const Source source{path, test::read_file(path)};
            Reading reading = read_source_text(source, {}, diagnostics);
            if (reading.design) reading.assembly = test::build(*reading.design).assembly;
            if (reading.assembly) all.push_back(emit_assembly(*reading.assembly));
        }
        return all;
    }();
    return texts;
}

// Bytes taken out, doubled, or replaced.
std::string mutated_bytes(std::string text, Random& random) {
    constexpr std::array<std::string_view, 16> kPieces{
        "{", "}", "[", "]", ",", ":", "\"", "null", "true", "1e99", "-0.0", "\\u0", "\0", "\xFF", "[[", "\n"};
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = random.below(text.size());
        const std::size_t length = std::min(random.below(30), text.size() - at);
        switch (random.below(4)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(random.below(text.size() + 1), text.substr(at, length));
                break;
            case 2:
                text.resize(at);
                break;
            default:
                text.replace(at, length, kPieces.at(random.below(kPieces.size())));
        }
    }
    return text;
}

// All values of a document, those inside others, too.
void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (!value.is_structured()) return;
    for (Json& inside : value) collect(inside, all);
}

// A document that is still JSON: values exchanged, taken out, doubled, or made strange.
std::string mutated_values(const std::string& text, Random& random) {
    Json whole = Json::parse(text);
    const std::size_t changes = 1 + random.below(3);
    for (std::size_t i = 0; i < changes; ++i) {
        std::vector<Json*> all;
        collect(whole, all);
        Json& one = *all[random.below(all.size())];
        const Json other = *all[random.below(all.size())];
        constexpr std::array<double, 12> kNumbers{0.0, 1.0,   -1.0,    180.0, 360.0,  1e-12,
                                                  1e6, 1e300, -1e-300, 0.1,   -127.0, 90.0};
        switch (random.below(6)) {
            case 0:
                one = other;
                break;
            case 1:
                if (one.is_array() && !one.empty()) one.erase(random.below(one.size()));
                break;
            case 2:
                if (one.is_array() && !one.empty()) one.push_back(one[random.below(one.size())]);
                break;
            case 3:
                if (one.is_array()) std::reverse(one.begin(), one.end());
                break;
            default:
                if (one.is_number()) {
                    const double value = one.get<double>();
                    one = random.below(2) == 0
                              ? kNumbers.at(random.below(kNumbers.size()))
                              : value + (random.unit() - 0.5) * std::pow(10.0, -8.0 * random.unit() + 2.0);
                } else if (one.is_boolean()) {
                    one = !one.get<bool>();
                } else if (one.is_string()) {
                    one = random.below(2) == 0 ? "" : one.get<std::string>() + "x";
                }
        }
    }
    return whole.dump(1, ' ', false, Json::error_handler_t::replace);
}

void check_one(const std::string& text, std::size_t& sound) {
    Diagnostics diagnostics("a.assembly.json");
    const Reading reading = read(text, diagnostics);
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    for (const Diagnostic& d : diagnostics.sorted()) {
        ASSERT_FALSE(d.message.empty());
        ASSERT_EQ(d.place.line >= 1, d.place.column >= 1);
        ASSERT_LE(d.place.line, lines);
        ASSERT_EQ(d.message.find('\n'), std::string::npos) << d.message;
    }
    ASSERT_EQ(reading.assembly.has_value(), !diagnostics.has_errors());
    if (!reading.assembly) return;
    ++sound;
    const Assembly& assembly = *reading.assembly;
    ASSERT_TRUE(faults_of(assembly).empty());
    const std::string again = emit_assembly(assembly);
    Diagnostics none;
    const Reading second = read(again, none);
    ASSERT_TRUE(second.assembly) << test::findings(none);
    ASSERT_EQ(emit_assembly(*second.assembly), again);
    Diagnostics later;
    if (moves(assembly)) {
        MotionOptions options;
        simulate(assembly, options, later);
    }
    make_pattern(assembly, {}, later);
}

void fuzz(std::uint64_t seed, int rounds) {
    Random random(seed);
    std::size_t sound = 0;
    for (int i = 0; i < rounds; ++i) {
        const std::string& start = seeds()[random.below(seeds().size())];
        const std::string text = i % 4 == 0 ? mutated_bytes(start, random) : mutated_values(start, random);
        check_one(text, sound);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ", round " << i << ":\n" << text;
            return;
        }
    }
    // Refused texts test only half of what is promised.
    EXPECT_GT(sound, static_cast<std::size_t>(rounds) / 20);
}

TEST(AssemblyFuzz, SeedsThemselvesAreRead) {
    ASSERT_GE(seeds().size(), 5U);
    for (const std::string& text : seeds()) {
        std::size_t sound = 0;
        check_one(text, sound);
        EXPECT_EQ(sound, 1U) << text;
    }
}

TEST(AssemblyFuzz, MutatedTexts) { fuzz(1, test::sanitized_count(120)); }

TEST(LongAssemblyFuzz, ManyMutatedTexts) {
    for (std::uint64_t seed = 2; seed < 8; ++seed) fuzz(seed, 2'000);
}

}  // namespace
}  // namespace popup
