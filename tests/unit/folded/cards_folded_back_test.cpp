// Two halves of the program against each other: cards of one sheet move by closed forms, one mechanism on the
// other, and written as FOLD they are creases and cuts of which nothing else is known. Folded as such, they
// must move alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "output/fold.h"
#include "popup/compile.h"
#include "support/designs.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup {
namespace {

const auto kSeeds = test::sanitized_count<std::uint64_t>(12, 6);
const int kLeast = test::sanitized_count(120, 6);

// The pattern that is written of a card, read and folded again.
std::optional<Assembly> folded_back(const Assembly& card, std::string& told) {
    const SceneCard scene{&card, nullptr, ""};
    Diagnostics diagnostics("back.fold");
    const auto text = write_fold(std::span(&scene, 1), {}, diagnostics);
    if (!text) return std::nullopt;
    Reading reading = read_source_text(Source{"back.fold", *text}, {}, diagnostics);
    std::optional<Assembly> back;
    if (reading.creases) back = fold_sheet(*reading.creases, {}, diagnostics);
    told = test::findings(diagnostics);
    return back;
}

double angle_between(const Frame& a, const Frame& b) {
    return std::atan2(length(cross(a.normal(), b.normal())), dot(a.normal(), b.normal())) * 180.0 /
           std::numbers::pi;
}

// Compares distances between points of all plates of the card with those of the same points of the sheet.
void expect_alike(const Assembly& card, const Assembly& back, const std::string& what) {
    Box page;
    for (const Plate& plate : card.plates) {
        for (const Vec2 p : plate.outline.outer) page.extend(p);
    }
    Box sheet;
    for (const Plate& plate : back.plates) {
        for (const Vec2 p : plate.outline.outer) sheet.extend(p);
    }
    const Vec2 by = sheet.min - page.min;
    const double size = std::max(page.width(), page.height());
    struct Pair {
        std::size_t on_card, on_sheet;
        Vec2 at;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < card.plates.size(); ++i) {
        const Vec2 at = inner_point(card.plates[i].outline, 0.1).at;
        const auto same = std::find_if(back.plates.begin(), back.plates.end(),
                                       [&](const Plate& plate) { return contains(plate.outline, at + by); });
        ASSERT_NE(same, back.plates.end()) << what << ": " << card.plates[i].name;
        pairs.push_back({i, static_cast<std::size_t>(same - back.plates.begin()), at});
    }
    ASSERT_EQ(card.covers.size(), 2U);
    const auto on_sheet = [&](int plate) {
        return std::find_if(pairs.begin(), pairs.end(),
                            [&](const Pair& pair) { return pair.on_card == static_cast<std::size_t>(plate); })
            ->on_sheet;
    };
    const std::size_t left = on_sheet(card.covers[0]);
    const std::size_t right = on_sheet(card.covers[1]);
    std::vector<Frame> there(back.plates.size());
    std::vector<Frame> here(card.plates.size());
    for (const double deg : {171.0, 130.0, 90.0, 47.0, 12.0}) {
        ASSERT_TRUE(place(back, Angle::degrees(deg), there));
        const double opening = 180.0 - angle_between(there[left], there[right]);
        ASSERT_TRUE(place(card, Angle::degrees(opening), here)) << what;
        double largest = 0.0;
        for (const Pair& p : pairs) {
            for (const Pair& q : pairs) {
                const double own = distance(here[p.on_card].point(p.at), here[q.on_card].point(q.at));
                const double other =
                    distance(there[p.on_sheet].point(p.at + by), there[q.on_sheet].point(q.at + by));
                largest = std::max(largest, std::abs(own - other));
            }
        }
        EXPECT_LT(largest, 1e-6 * size) << what << " open by " << opening;
    }
}

TEST(CardsFoldedBack, SamplesMoveAsTheirClosedFormsSay) {
    for (const char* name : {"castle", "stairs", "birthday", "skyline", "bird", "city", "sweetheart",
                             "ziggurat", "old-town", "branch"}) {
        const std::string file = std::string(POPUP_SOURCE_DIR) + "/samples/" + name + ".xml";
        CompileOptions options;
        options.until = Stage::assembly;
        const Compilation run = compile({Source{file, test::read_file(file)}}, options, {});
        ASSERT_TRUE(run.designs[0].assembly) << name;
        std::string told;
        const auto back = folded_back(*run.designs[0].assembly, told);
        ASSERT_TRUE(back) << name << told;
        EXPECT_EQ(told, "") << name;
        EXPECT_LT(back->sweep.from_deg, 0.36) << name;
        expect_alike(*run.designs[0].assembly, *back, name);
    }
}

TEST(CardsFoldedBack, GeneratedCardsMoveAsTheirClosedFormsSay) {
    int compared = 0;
    int others = 0;
    std::string besides;
    for (const ElementInfo& info : element_table()) {
        if (info.glued) continue;
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            const Design design = test::generate_of(info, seed, 4);
            const test::Built built = test::build(design);
            if (!built.assembly || built.assembly->pieces.size() != 1) continue;
            std::string told;
            const auto back = folded_back(*built.assembly, told);
            const std::string what = std::string(info.name) + " " + std::to_string(seed);
            ASSERT_TRUE(back) << what << told;
            // Of flat states the six decimals of a FOLD file leave their square root.
            if (back->sweep.from_deg > 0.36 || !told.empty()) {
                besides += what + ": " + told;
                ++others;
                continue;
            }
            expect_alike(*built.assembly, *back, what);
            ++compared;
        }
    }
    // Of a few what six decimals leave is rigid.
    EXPECT_GT(compared, kLeast);
    EXPECT_LE(others, 8) << besides;
}

}  // namespace
}  // namespace popup
