// Cartons of forty panels, and smaller ones that are rolled: what is found in them to be joined, and that
// they close.
#include <fmt/format.h>
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
#include "support/sanitized.h"

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

// Of dielines and of suggestions of one, the sanitizers look at a few: each takes them seconds.
const std::size_t kOneIn = test::kSanitized ? 4 : 1;

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
    for (std::size_t i = 0; i < kDielines.size(); i += kOneIn) {
        const auto& [drawing, panels] = kDielines[i];
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

// By fold, less than 0 for mountains.
std::vector<double> angles_of(const CreasePattern& refined) {
    std::vector<double> deg;
    for (const CreaseLine& line : refined.lines) {
        if (line.use != CreaseUse::cut)
            deg.push_back(line.use == CreaseUse::mountain ? -*line.fold_deg : *line.fold_deg);
    }
    return deg;
}

// How far the fold goes that ends furthest from where the sheet leaves it without joins.
double furthest_turn(const CreasePattern& refined, const CreasePattern& rough) {
    const std::vector<double> to = angles_of(refined);
    const std::vector<double> from = angles_of(rough);
    EXPECT_EQ(to.size(), from.size());
    double most = 0.0;
    for (std::size_t i = 0; i < std::min(to.size(), from.size()); ++i)
        most = std::max(most, std::abs(to[i] - from[i]));
    return most;
}

const std::vector<std::string> kDrawings{test::locked_tray(),
                                         test::locked_tube(8),
                                         test::pointed_tube(13),
                                         test::rolled_tray(6.0, true),
                                         test::rolled_tray(6.0, false),
                                         test::tucked_mailer(true, true),
                                         test::tucked_mailer(false, false)};

// Each suggestion says which fold it turns most, and how far.
TEST(FortyPanels, SuggestionsSayHowFarFoldsTurn) {
    std::size_t far = 0;
    for (const std::string& drawing : kDrawings) {
        const CreasePattern pattern = read(drawing);
        Diagnostics diagnostics;
        const auto found = suggest_joins(pattern, {}, diagnostics);
        const auto rough = refine_shape(pattern, {}, diagnostics);
        ASSERT_TRUE(found && rough);
        for (const Suggestion& row : found->rows) {
            if (!row.closes || row.lies()) continue;
            const auto refined = refine_shape(pattern, {{}, {row.join}}, diagnostics);
            ASSERT_TRUE(refined);
            // One that is found with the panels in between alone may turn others a little when all may move.
            EXPECT_NEAR(refined->furthest.by_deg(), furthest_turn(refined->pattern, rough->pattern), 1e-3);
            EXPECT_FALSE(row.furthest.panels[0].empty());
            const bool is_far = row.furthest.by_deg() > kMostTurnDeg;
            far += is_far ? 1 : 0;
            EXPECT_EQ(shown_outcome(row).find("closes, turning a fold by") == 0, is_far)
                << shown_outcome(row);
        }
    }
    EXPECT_GT(far, 8U);
}

// Where nobody looks for crossings, either, "all" takes nothing that undoes a roll or lays a flap elsewhere.
TEST(FortyPanels, AllTurnsNoFoldFar) {
    std::size_t named = 0;
    for (std::size_t i = 0; i < kDrawings.size(); i += kOneIn) {
        const CreasePattern pattern = read(kDrawings[i]);
        Diagnostics diagnostics;
        const auto found = suggest_joins(pattern, {}, diagnostics);
        const auto rough = refine_shape(pattern, {}, diagnostics);
        ASSERT_TRUE(found && rough);
        for (const double most : {kMostTurnDeg, 15.0, 5.0}) {
            Diagnostics told;
            const auto joins = accept_joins(pattern, {}, *found, "all", {true, {}, most}, told);
            ASSERT_TRUE(joins);
            const auto refined = refine_shape(pattern, {{}, *joins}, diagnostics);
            ASSERT_TRUE(refined);
            EXPECT_TRUE(refined->closes);
            EXPECT_LE(furthest_turn(refined->pattern, rough->pattern), most + 1e-3);
            const auto is_far = [&](const Suggestion& row) {
                return row.closes && row.join.kind != JoinKind::coplanar && row.furthest.by_deg() > most;
            };
            const auto row = std::find_if(found->rows.begin(), found->rows.end(), is_far);
            if (row == found->rows.end()) continue;
            EXPECT_NE(
                test::findings(told).find(row->name() + fmt::format(" by {:.1f}°", row->furthest.by_deg())),
                std::string::npos)
                << test::findings(told);
            // What is named is taken nevertheless.
            const auto one = accept_joins(pattern, {}, *found, row->name(), {false, {}, most}, told);
            ASSERT_TRUE(one);
            EXPECT_EQ(shown_join(one->front(), pattern.ruler), shown_join(row->join, pattern.ruler));
            ++named;
        }
    }
    EXPECT_GT(named, 6U / kOneIn);
}

TEST(FortyPanels, TurnsAreToldWithTheFold) {
    EXPECT_EQ(shown_turn({{"sheet/front", "sheet/lid"}, 90.0, 76.12}),
              "the fold sheet/front+sheet/lid turns by 13.9°, from 90.0° to 76.1°");
    EXPECT_EQ(shown_turn({{"sheet/front", "sheet/lid"}, -90.0, -76.12}),
              "the fold sheet/front+sheet/lid turns by 13.9°, from 90.0° to 76.1°");
    EXPECT_EQ(shown_turn({{"sheet/front", "sheet/lid"}, 90.0, -10.0}),
              "the fold sheet/front+sheet/lid turns by 100.0°, from 90.0° to -10.0°");
    EXPECT_EQ(shown_turn({}), "no fold turns");
}

// Least and most of a panel along an axis of the folded shape, mm, from the corner of the base at the front
// left.
std::pair<double, double> reach_of(const Assembly& closed, const std::string& panel, std::size_t axis) {
    std::vector<Frame> frames(closed.plates.size());
    EXPECT_TRUE(place(closed, Angle::degrees(0.0), frames));
    const auto reach = [&](const std::string& name) {
        std::pair<double, double> along{HUGE_VAL, -HUGE_VAL};
        for (std::size_t i = 0; i < closed.plates.size(); ++i) {
            if (closed.plates[i].name != "sheet/" + name) continue;
            for (const Vec2 p : closed.plates[i].outline.outer) {
                const Vec3 at = frames[i].point(p);
                const double x = axis == 0 ? at.x : axis == 1 ? at.y : at.z;
                along = {std::min(along.first, x), std::max(along.second, x)};
            }
        }
        return along;
    };
    const double from = reach("base").first;
    const auto [least, most] = reach(panel);
    return {least - from, most - from};
}

// It is closed without a join: walls stand upright on a base of 200 × 140 mm and are 50 mm high, the lid lies
// level with them, and what is rolled in or tucked in is as far from its wall as the generator says. Nothing
// is taken of "all", for what lies a little apart there lies within something else: together, they would
// cross.
TEST(FortyPanels, TheLockedTrayClosesAsItIsDrawn) {
    const CreasePattern pattern = read(test::locked_tray());
    Diagnostics diagnostics;
    const auto closed = fold_sheet(pattern, {}, diagnostics);
    ASSERT_TRUE(closed);
    struct Lies {
        std::string panel;
        std::size_t axis;  // across it
        double at;         // mm
    };
    for (const Lies& one : std::vector<Lies>{{"base", 2, 0.0},
                                             {"front", 1, 0.0},
                                             {"back", 1, 140.0},
                                             {"left", 0, 0.0},
                                             {"right", 0, 200.0},
                                             {"front-corner-left", 0, 0.0},
                                             {"back-corner-right", 0, 200.0},
                                             {"front-rim", 2, 50.0},
                                             {"front-lining", 1, 1.5},
                                             {"left-lining", 0, 1.5},
                                             {"right-lining", 0, 198.5},
                                             {"lid", 2, 50.0},
                                             {"lid-tuck", 1, 2.0},
                                             {"lid-ear-left", 0, 2.5},
                                             {"lid-ear-right", 0, 197.5}}) {
        SCOPED_TRACE(one.panel);
        EXPECT_NEAR(reach_of(*closed, one.panel, one.axis).first, one.at, 1e-6);
        EXPECT_NEAR(reach_of(*closed, one.panel, one.axis).second, one.at, 1e-6);
    }
    for (const std::string panel : {"front", "back", "left", "right"}) {
        EXPECT_NEAR(reach_of(*closed, panel, 2).first, 0.0, 1e-6);
        EXPECT_NEAR(reach_of(*closed, panel, 2).second, 50.0, 1e-6);
    }
    const auto crossings = [](const CreasePattern& refined) { return crossings_in(refined, true, {}, {}); };
    EXPECT_TRUE(crossings(pattern).empty());
    const auto found = suggest_joins(pattern, {}, diagnostics);
    ASSERT_TRUE(found);
    std::size_t candidates = 0;
    std::size_t looked_at = 0;
    for (const Suggestion& row : found->rows) {
        if (!row.closes || row.furthest.by_deg() > kMostTurnDeg || row.join.kind == JoinKind::coplanar ||
            row.lies())
            continue;
        if (candidates++ % kOneIn != 0) continue;
        const auto refined = refine_shape(pattern, {{}, {row.join}}, diagnostics);
        ASSERT_TRUE(refined);
        EXPECT_FALSE(crossings(refined->pattern).empty()) << row.name();
        ++looked_at;
    }
    EXPECT_GT(candidates, 10U);
    EXPECT_GT(looked_at, 10U / kOneIn);
}

// The seam is taken before the tips of the flaps, which would meet without it, and then keep it open. What
// crossed because it was open crosses no more; no corner of the tube is made flat.
TEST(FortyPanels, TubesCloseAlongTheirSeamsFirst) {
    const std::vector<std::string> tubes{test::pointed_tube(11), test::pointed_tube(13),
                                         test::locked_tube(13)};
    for (std::size_t i = 0; i < tubes.size(); i += kOneIn) {
        const CreasePattern pattern = read(tubes[i]);
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
