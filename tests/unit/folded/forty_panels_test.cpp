// Cartons of forty panels: what is found in them to be joined, and that they close.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "popup/edit_drawing.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "popup/refinement.h"
#include "support/designs.h"
#include "support/dielines.h"

namespace popup {
namespace {

CreasePattern read(const std::string& drawing) {
    Diagnostics diagnostics("box.svg");
    ReadOptions options;
    options.drawing.as = DrawnAs::folded;
    Reading reading = read_source_text({"box.svg", drawing}, options, diagnostics);
    EXPECT_TRUE(reading.creases) << test::findings(diagnostics);
    return reading.creases.value_or(CreasePattern{});
}

const std::vector<std::pair<std::string, std::size_t>> kDielines{
    {test::pointed_tube(13), 40}, {test::locked_tube(8), 41}, {test::locked_tray(), 42}};

TEST(FortyPanels, AreInTheDielines) {
    for (const auto& [drawing, panels] : kDielines) {
        Diagnostics diagnostics("box.svg");
        const auto assembly = fold_sheet(read(drawing), {}, diagnostics);
        ASSERT_TRUE(assembly);
        EXPECT_EQ(assembly->plates.size(), panels);
        EXPECT_EQ(assembly->pieces.size(), 1U);
        EXPECT_FALSE(diagnostics.has_findings()) << test::findings(diagnostics);
    }
}

// What is accepted of all closes, and brings no crossing.
TEST(FortyPanels, MayBeAcceptedWhole) {
    for (const auto& [drawing, panels] : kDielines) {
        const CreasePattern pattern = read(drawing);
        Diagnostics diagnostics;
        const auto found = suggest_joins(pattern, {}, diagnostics);
        ASSERT_TRUE(found);
        EXPECT_GT(found->rows.size(), 30U);
        const auto crossings = [](const CreasePattern& refined, bool whole_way) {
            return crossings_in(refined, whole_way, {}, {});
        };
        const Crossings before = crossings(pattern, true);
        const auto joins = accept_joins(pattern, {}, *found, "all", {true, crossings}, diagnostics);
        ASSERT_TRUE(joins);
        // The tray is drawn as it closes: whatever lies against something there lies a little apart.
        EXPECT_EQ(joins->empty(), panels == 42);
        const auto refined = refine_shape(pattern, {{}, *joins}, diagnostics);
        ASSERT_TRUE(refined);
        EXPECT_TRUE(refined->closes) << panels;
        for (const auto& pair : crossings(refined->pattern, true))
            EXPECT_TRUE(before.contains(pair)) << pair.first << " crosses " << pair.second;
    }
}

// The seam is taken before the tips of the flaps, which would meet without it, and then keep it open. What
// crossed because it was open crosses no more; no corner of the tube is made flat.
TEST(FortyPanels, TubesCloseAlongTheirSeamsFirst) {
    for (const std::string& drawing :
         {test::pointed_tube(11), test::pointed_tube(13), test::locked_tube(13)}) {
        const CreasePattern pattern = read(drawing);
        const auto crossings = [](const CreasePattern& refined, bool whole_way) {
            return crossings_in(refined, whole_way, {}, {});
        };
        EXPECT_FALSE(crossings(pattern, true).empty());
        Diagnostics diagnostics;
        const auto found = suggest_joins(pattern, {}, diagnostics);
        ASSERT_TRUE(found);
        const auto joins = accept_joins(pattern, {}, *found, "all", {true, crossings}, diagnostics);
        ASSERT_TRUE(joins);
        const auto is_seam = [](const Join& join) {
            return join.kind == JoinKind::paste && join.parts.front().panel == "sheet/glue-flap";
        };
        EXPECT_TRUE(std::any_of(joins->begin(), joins->end(), is_seam));
        for (const Join& join : *joins) EXPECT_NE(join.kind, JoinKind::coplanar);
        const auto refined = refine_shape(pattern, {{}, *joins}, diagnostics);
        ASSERT_TRUE(refined);
        EXPECT_TRUE(refined->closes);
        EXPECT_TRUE(crossings(refined->pattern, true).empty());
    }
}

// The tube of 13 sides, whose folds say 28°: its first and last wall meet at both ends, and so do their
// flaps, which begin a little beside the corners of the walls.
TEST(FortyPanels, WallsCloseWhoseFlapsBeginBesideTheirCorners) {
    const CreasePattern pattern = read(test::pointed_tube(13));
    Diagnostics diagnostics;
    const auto found = suggest_joins(pattern, {}, diagnostics);
    ASSERT_TRUE(found);
    const auto of_walls = [](const Suggestion& row) {
        const auto& parts = row.join.parts;
        return parts.size() == 2 && parts[0].panel == "sheet/wall-2" && parts[1].panel == "sheet/front";
    };
    const auto row = std::find_if(found->rows.begin(), found->rows.end(), of_walls);
    ASSERT_NE(row, found->rows.end());
    EXPECT_TRUE(row->closes) << shown_outcome(*row);
    const auto joins = accept_joins(pattern, {}, *found, row->name(), {}, diagnostics);
    ASSERT_TRUE(joins);
    ASSERT_EQ(joins->size(), 2U);
    const auto refined = refine_shape(pattern, {{}, *joins}, diagnostics);
    ASSERT_TRUE(refined);
    EXPECT_TRUE(refined->closes);
    // Its walls, one behind the other, come back to where they began.
    std::map<double, double> turns;  // by where the fold is
    for (const CreaseLine& line : refined->pattern.lines) {
        if (line.use != CreaseUse::cut && *line.fold_deg < 80.0)
            turns[line.points.front().x] = *line.fold_deg * std::numbers::pi / 180.0;
    }
    ASSERT_EQ(turns.size(), 13U);  // with that of the glue flap, which comes last
    turns.erase(std::prev(turns.end()));
    std::complex<double> end = 30.0;
    double way = 0.0;
    for (const auto& [x, turn] : turns) end += std::polar(30.0, way += turn);
    EXPECT_LT(std::abs(end), 1e-3);
    EXPECT_TRUE(crossings_in(refined->pattern, true, {}, {}).empty());
}

// What is not there is answered with what is, in few words.
TEST(FortyPanels, SuggestionsThatThereAreAreNamedInRanges) {
    const CreasePattern pattern = read(test::pointed_tube(13));
    Diagnostics diagnostics;
    const auto found = suggest_joins(pattern, {}, diagnostics);
    ASSERT_TRUE(found);
    for (const std::string word : {"merge 99", "1", "merge"}) {
        Diagnostics told;
        EXPECT_FALSE(accept_joins(pattern, {}, *found, word, {}, told));
        ASSERT_EQ(told.sorted().size(), 1U);
        EXPECT_EQ(told.sorted().front().message, "there is no suggestion \"" + word + "\"");
        EXPECT_EQ(told.sorted().front().hints,
                  std::vector<std::string>{"there are merge 1 to 32, paste 1, coplanar 1 to 2"});
    }
}

// How often it is looked for crossings: of a sheet in which nothing crosses, once of what is folded, and once
// on the whole way. What the sheet crosses without the joins is not asked then.
TEST(FortyPanels, AreLookedAtOnceWhereNothingCrosses) {
    const CreasePattern pattern = read(test::pointed_tube(13));
    Diagnostics diagnostics;
    const auto found = suggest_joins(pattern, {}, diagnostics);
    ASSERT_TRUE(found);
    std::vector<bool> asked;
    const auto nothing = [&](const CreasePattern&, bool whole_way) {
        asked.push_back(whole_way);
        return Crossings{};
    };
    const auto row = std::find_if(found->rows.begin(), found->rows.end(),
                                  [](const Suggestion& one) { return one.closes && one.like.size() == 1; });
    ASSERT_NE(row, found->rows.end());
    EXPECT_TRUE(accept_joins(pattern, {}, *found, row->name(), {true, nothing}, diagnostics));
    EXPECT_EQ(asked, (std::vector<bool>{false, true}));
}

}  // namespace
}  // namespace popup
