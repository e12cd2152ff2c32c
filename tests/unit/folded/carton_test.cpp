// Cartons: what their panels are called, what is found to be joined in them, and whether what closes does.
//
// What is expected of closed shapes is computed here from the angles that the refined pattern asks for, by
// plane geometry and closed formulas, and by nothing of the room that is tested.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "popup/files.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "popup/refinement.h"
#include "support/designs.h"
#include "support/dielines.h"
#include "support/folded_ends.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::add_line;

constexpr double kPi = std::numbers::pi;
const int kPrisms = test::sanitized_count(300, 30);

std::vector<std::string> names_of(const CreasePattern& pattern) {
    Diagnostics diagnostics;
    const auto assembly = fold_sheet(pattern, {}, diagnostics);
    std::vector<std::string> names;
    if (assembly) {
        for (const Plate& plate : assembly->plates) names.push_back(plate.name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

// A strip of walls, side by side, and folds between them.
CreasePattern strip(const std::vector<double>& widths, double height) {
    CreasePattern pattern;
    const double all = std::accumulate(widths.begin(), widths.end(), 0.0);
    add_line(pattern, {{0, 0}, {all, 0}, {all, height}, {0, height}}, true, CreaseUse::cut);
    double at = 0.0;
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
        at += widths[i];
        add_line(pattern, {{at, 0}, {at, height}}, false, CreaseUse::valley);
    }
    return pattern;
}

// The folds of a strip that is refined, by where they are: how far each is folded, radians.
std::vector<double> turns_of_strip(const CreasePattern& pattern) {
    std::vector<std::pair<double, double>> folds;
    for (const CreaseLine& line : pattern.lines) {
        if (line.use == CreaseUse::cut) continue;
        const double sign = line.use == CreaseUse::mountain ? -1.0 : 1.0;
        folds.emplace_back(line.points.front().x, sign * line.fold_deg.value() * kPi / 180.0);
    }
    std::sort(folds.begin(), folds.end());
    std::vector<double> turns;
    for (const auto& [x, turn] : folds) turns.push_back(turn);
    return turns;
}

// Where a strip ends that begins in 0 and goes to the right, seen along its folds.
std::complex<double> end_of_strip(const std::vector<double>& widths, const std::vector<double>& turns) {
    std::complex<double> at = 0.0;
    double direction = 0.0;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        at += widths[i] * std::polar(1.0, direction);
        if (i < turns.size()) direction += turns[i];
    }
    return at;
}

Join ends_of_strip(const CreasePattern& pattern, const std::vector<double>& widths, double y) {
    Diagnostics diagnostics;
    const auto assembly = fold_sheet(pattern, {}, diagnostics);
    const double all = std::accumulate(widths.begin(), widths.end(), 0.0);
    Join join;
    for (const double x : {0.0, all}) {
        for (const Plate& plate : assembly->plates) {
            for (const Vec2 corner : plate.outline.outer) {
                if (distance(corner, Vec2{x, y}) < 1e-6) join.parts.push_back({plate.name, corner});
            }
        }
    }
    return join;
}

// A polygon with triangles on its sides, that meet over its middle.
CreasePattern pyramid(int sides, double radius, double slant) {
    CreasePattern pattern;
    std::vector<Vec2> base;
    std::vector<Vec2> border;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * kPi * i / sides;
        base.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const double inner = radius * std::cos(kPi / sides);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * kPi * (i + 0.5) / sides;
        border.push_back(base[static_cast<std::size_t>(i)]);
        border.push_back({(inner + slant) * std::cos(angle), (inner + slant) * std::sin(angle)});
    }
    add_line(pattern, border, true, CreaseUse::cut);
    for (std::size_t i = 0; i < base.size(); ++i)
        add_line(pattern, {base[i], base[(i + 1) % base.size()]}, false, CreaseUse::valley);
    return pattern;
}

TEST(Carton, PanelsOfATubeAreNamed) {
    const auto carton =
        test::read_folded(std::filesystem::path(POPUP_SOURCE_DIR) / "samples/folded/carton.svg");
    ASSERT_TRUE(carton);
    EXPECT_EQ(names_of(*carton), (std::vector<std::string>{
                                     "sheet/back", "sheet/bottom-flap-back", "sheet/bottom-flap-front",
                                     "sheet/bottom-flap-left", "sheet/bottom-flap-right", "sheet/front",
                                     "sheet/glue-flap", "sheet/left", "sheet/right", "sheet/top-flap-back",
                                     "sheet/top-flap-front", "sheet/top-flap-left", "sheet/top-flap-right"}));
}

// A tuck-end box: a lid with its tuck, dust flaps beside it, a window, and rounded corners on the tuck.
TEST(Carton, TucksDustFlapsAndLocksAreNamed) {
    CreasePattern box;
    const auto cut = [&box](std::vector<Vec2> points) {
        add_line(box, std::move(points), false, CreaseUse::cut);
    };
    const auto fold = [&box](Vec2 a, Vec2 b) { add_line(box, {a, b}, false, CreaseUse::valley); };
    // Walls: 12 glue, 60, 30, 60, 30; 90 high.
    cut({{12, 0}, {0, 5}, {0, 85}, {12, 90}});
    for (const double x : {12.0, 72.0, 102.0, 162.0}) fold({x, 0}, {x, 90});
    // The lid on the first wall, its tuck with rounded corners, and a lock in the middle of that.
    std::vector<Vec2> tuck{{12, 90}, {12, 120}};
    for (int i = 0; i <= 8; ++i)
        tuck.push_back({20 - 8 * std::cos(kPi * i / 16), 122 + 8 * std::sin(kPi * i / 16)});
    for (int i = 0; i <= 8; ++i)
        tuck.push_back({64 + 8 * std::sin(kPi * i / 16), 122 + 8 * std::cos(kPi * i / 16)});
    tuck.insert(tuck.end(), {{72, 120}, {72, 90}});
    cut(tuck);
    fold({12, 90}, {72, 90});
    fold({12, 120}, {72, 120});
    // Dust flaps on the narrow walls.
    cut({{72, 90}, {75, 108}, {99, 108}, {102, 90}});
    fold({72, 90}, {102, 90});
    cut({{162, 90}, {165, 108}, {189, 108}, {192, 90}});
    fold({162, 90}, {192, 90});
    cut({{102, 90}, {162, 90}});
    cut({{192, 90}, {192, 0}, {12, 0}});
    // A window, and a lock that is cut out of the back.
    add_line(box, {{30, 30}, {54, 30}, {54, 60}, {30, 60}}, true, CreaseUse::cut);
    cut({{125, 20}, {125, 30}, {140, 30}, {140, 20}});
    fold({125, 20}, {140, 20});
    EXPECT_EQ(names_of(box),
              (std::vector<std::string>{"sheet/back", "sheet/back-lock", "sheet/front", "sheet/glue-flap",
                                        "sheet/left", "sheet/right", "sheet/top", "sheet/top-dust-flap-left",
                                        "sheet/top-dust-flap-right", "sheet/top-tuck"}));
}

// A box to hang up: the back goes on above the box as a header, which is no reason to take it for a tray.
TEST(Carton, AHeaderMakesNoWallHigher) {
    CreasePattern box;
    const auto cut = [&box](std::vector<Vec2> points) {
        add_line(box, std::move(points), false, CreaseUse::cut);
    };
    const auto fold = [&box](Vec2 a, Vec2 b) { add_line(box, {a, b}, false, CreaseUse::valley); };
    cut({{0, 0}, {-14, 4}, {-14, 136}, {0, 140}});
    for (const double x : {0.0, 90.0, 130.0, 220.0}) fold({x, 0}, {x, 140});
    cut({{260, 0}, {260, 140}});
    // The header, and the lids: the top on the front, the bottom on the back.
    cut({{0, 140}, {0, 175}, {3, 208}, {87, 208}, {90, 175}, {90, 140}});
    fold({0, 175}, {90, 175});
    cut({{130, 140}, {130, 195}, {220, 195}, {220, 140}});
    fold({130, 140}, {220, 140});
    fold({130, 180}, {220, 180});
    cut({{0, 0}, {0, -55}, {90, -55}, {90, 0}});
    fold({0, 0}, {90, 0});
    fold({0, -40}, {90, -40});
    cut({{130, 0}, {220, 0}});
    for (const double x : {90.0, 220.0}) {
        cut({{x, 140}, {x + 6, 165}, {x + 34, 165}, {x + 40, 140}});
        fold({x, 140}, {x + 40, 140});
        cut({{x, 0}, {x + 6, -25}, {x + 34, -25}, {x + 40, 0}});
        fold({x, 0}, {x + 40, 0});
    }
    const std::vector<std::string> names = names_of(box);
    for (const std::string name : {"sheet/top", "sheet/top-tuck", "sheet/bottom", "sheet/bottom-tuck",
                                   "sheet/glue-flap", "sheet/top-dust-flap-left"})
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

// Walls of three widths, which the house on the end of the first says are a tube.
TEST(Carton, ATubeIsNamedByThePanelOnItsEnd) {
    CreasePattern house;
    const double roof = std::sqrt(1800.0);
    const std::vector<double> widths{60, 40, roof, roof, 40};
    add_line(house, {{60, 0}, {140 + 2 * roof, 0}, {140 + 2 * roof, 80}, {60, 80}}, false, CreaseUse::cut);
    add_line(house, {{60, 80}, {60, 120}, {30, 150}, {0, 120}, {0, 80}, {-10, 76}, {-10, 4}, {0, 0}, {60, 0}},
             false, CreaseUse::cut);
    double x = 0.0;
    for (const double width : widths) {
        add_line(house, {{x, 0}, {x, 80}}, false, CreaseUse::fold);
        x += width;
    }
    add_line(house, {{140 + 2 * roof, 0}, {140 + 2 * roof, 80}}, false, CreaseUse::cut);
    add_line(house, {{0, 80}, {60, 80}}, false, CreaseUse::fold);
    EXPECT_EQ(names_of(house),
              (std::vector<std::string>{"sheet/front", "sheet/glue-flap", "sheet/top", "sheet/wall-2",
                                        "sheet/wall-3", "sheet/wall-4", "sheet/wall-5"}));
}

TEST(Carton, PanelsOfATrayAreNamed) {
    CreasePattern tray;
    add_line(tray,
             {{80, -20},
              {95, -18},
              {95, -2},
              {80, 0},
              {100, 0},
              {100, 60},
              {80, 60},
              {80, 80},
              {0, 80},
              {0, 60},
              {-20, 60},
              {-20, 0},
              {0, 0}},
             false, CreaseUse::cut);
    add_line(tray, {{0, 0}, {0, -20}, {80, -20}}, false, CreaseUse::cut);
    for (const auto& [a, b] : {std::pair{Vec2{0, 0}, Vec2{80, 0}},
                               {Vec2{80, 0}, Vec2{80, 60}},
                               {Vec2{80, 60}, Vec2{0, 60}},
                               {Vec2{0, 60}, Vec2{0, 0}},
                               {Vec2{80, 0}, Vec2{80, -20}}})
        add_line(tray, {a, b}, false, CreaseUse::valley);
    EXPECT_EQ(names_of(tray),
              (std::vector<std::string>{"sheet/back", "sheet/base", "sheet/front", "sheet/front-corner-right",
                                        "sheet/left", "sheet/right"}));
}

// Accordions, and what loops hold, are no boxes: their panels keep their numbers.
// Its lid is as large as its base, has walls on four sides, too, and is drawn first.
TEST(Carton, TheBaseOfAMailerIsWhatHasTheRolledWalls) {
    const auto mailer = test::read_folded(std::filesystem::path(POPUP_SOURCE_DIR) / "tests" / "cases" /
                                          "board" / "mailer.svg");
    ASSERT_TRUE(mailer);
    Diagnostics diagnostics;
    const auto folded = fold_sheet(*mailer, {}, diagnostics);
    ASSERT_TRUE(folded);
    const auto box_of = [&](const std::string& name) {
        for (const Plate& plate : folded->plates) {
            if (plate.name == "sheet/" + name) return bounds(plate.outline.outer);
        }
        return Box{};
    };
    // The drawing has y upwards here: the lid is at its top, the base below.
    EXPECT_GT(box_of("lid").min.y, box_of("back").min.y);
    EXPECT_GT(box_of("lid-tuck").min.y, box_of("lid").min.y);
    EXPECT_GT(box_of("back").min.y, box_of("base").min.y);
    EXPECT_GT(box_of("base").min.y, box_of("front").min.y);
    for (const std::string side : {"left", "right"}) {
        EXPECT_NEAR(box_of(side + "-rim").width(), 2.0, 1e-6);
        EXPECT_NEAR(box_of(side + "-lining").width(), 36.0, 1e-6);
        EXPECT_LT(box_of("lid-tuck-ear-" + side).width(), 40.0);
        EXPECT_LT(box_of("lid-ear-" + side).width(), 40.0);
    }
}

// Bottom, back, lid and tuck lie side by side as the walls of a tube and its glue flap do; of 180 × 110 × 45
// mm.
TEST(Carton, AMailerIsATrayWithALid) {
    for (const bool angles : {true, false}) {
        for (const bool ears : {true, false}) {
            Diagnostics diagnostics("box.svg");
            ReadOptions options;
            options.drawing.as = DrawnAs::folded;
            const Reading reading =
                read_source_text({"box.svg", test::tucked_mailer(angles, ears)}, options, diagnostics);
            ASSERT_TRUE(reading.creases) << test::findings(diagnostics);
            std::vector<std::string> names{"back",
                                           "back-corner-left",
                                           "back-corner-right",
                                           "base",
                                           "front",
                                           "front-corner-left",
                                           "front-corner-right",
                                           "left",
                                           "left-lining",
                                           "left-rim",
                                           "lid",
                                           "lid-tuck",
                                           "right",
                                           "right-lining",
                                           "right-rim"};
            if (ears)
                names.insert(names.end(),
                             {"lid-ear-left", "lid-ear-right", "lid-tuck-ear-left", "lid-tuck-ear-right"});
            for (std::string& name : names) name.insert(0, "sheet/");
            std::sort(names.begin(), names.end());
            EXPECT_EQ(names_of(*reading.creases), names);
        }
    }
}

TEST(Carton, WhatIsNoBoxKeepsItsNumbers) {
    CreasePattern accordion = strip({40, 40, 40, 40, 40}, 60);
    for (std::size_t i = 1; i < accordion.lines.size(); i += 2) accordion.lines[i].use = CreaseUse::mountain;
    EXPECT_EQ(names_of(accordion),
              (std::vector<std::string>{"sheet/1", "sheet/2", "sheet/3", "sheet/4", "sheet/5"}));
}

// Strips of any walls close to polygons where no wall is longer than the others together.
TEST(Carton, StripsCloseWherePolygonsDo) {
    test::Random random(20);
    int open = 0;
    for (int i = 0; i < kPrisms; ++i) {
        std::vector<double> widths;
        const std::size_t count = 3 + random.below(6);
        for (std::size_t j = 0; j < count; ++j) widths.push_back(20.0 + 60.0 * random.unit());
        if (random.below(4) == 0) widths[random.below(count)] = 60.0 * static_cast<double>(count);
        const double all = std::accumulate(widths.begin(), widths.end(), 0.0);
        const double over = 2.0 * *std::max_element(widths.begin(), widths.end()) - all;
        if (std::abs(over) < 2.0) continue;
        const CreasePattern pattern = strip(widths, 50);
        RefineOptions options;
        options.joins = {ends_of_strip(pattern, widths, 0.0), ends_of_strip(pattern, widths, 50.0)};
        ASSERT_EQ(options.joins[0].parts.size(), 2U);
        Diagnostics diagnostics;
        const auto refined = refine_shape(pattern, options, diagnostics);
        ASSERT_TRUE(refined);
        const std::vector<double> turns = turns_of_strip(refined->pattern);
        ASSERT_EQ(turns.size(), count - 1);
        const double gap = std::abs(end_of_strip(widths, turns));
        EXPECT_NEAR(gap, refined->residual_mm, 1e-6) << "strip " << i;
        if (over < 0.0) {
            EXPECT_TRUE(refined->closes) << "strip " << i << " of " << count << " is open by " << gap;
            EXPECT_LE(gap, 1e-6 * all) << "strip " << i;
            // Ends that are near each other by chance may have far to go nevertheless.
            for (const Diagnostic& one : diagnostics.sorted()) EXPECT_EQ(one.code, "join-swings");
        } else {
            ++open;
            EXPECT_FALSE(refined->closes);
            EXPECT_GE(gap, over - 1e-6);
            ASSERT_TRUE(diagnostics.has_findings());
            EXPECT_EQ(diagnostics.sorted().front().code, "join-open");
        }
    }
    EXPECT_GT(open, kPrisms / 10);
}

// The tips of a pyramid meet where its triangles lean by acos(inner radius / slant).
TEST(Carton, PyramidsAreFoundAndClose) {
    for (const int sides : {3, 4, 5, 6, 8}) {
        const double radius = 40.0;
        const double inner = radius * std::cos(kPi / sides);
        const double slant = inner + 25.0;
        const CreasePattern pattern = pyramid(sides, radius, slant);
        Diagnostics diagnostics;
        SuggestOptions options;
        options.near_mm = 2.0 * inner + 1.0;
        const auto found = suggest_joins(pattern, options, diagnostics);
        ASSERT_TRUE(found);
        ASSERT_FALSE(found->rows.empty()) << sides;
        const Suggestion& first = found->rows.front();
        EXPECT_EQ(first.name(), "merge 1");
        EXPECT_EQ(first.join.parts.size(), static_cast<std::size_t>(sides));
        EXPECT_TRUE(first.closes) << first.residual_mm;
        const auto joins = accept_joins(pattern, options, *found, "merge 1", {}, diagnostics);
        ASSERT_TRUE(joins);
        const auto refined = refine_shape(pattern, {{}, *joins}, diagnostics);
        ASSERT_TRUE(refined);
        EXPECT_TRUE(refined->closes);
        int folds = 0;
        for (const CreaseLine& line : refined->pattern.lines) {
            if (line.use == CreaseUse::cut) continue;
            ++folds;
            EXPECT_EQ(line.use, CreaseUse::valley);
            EXPECT_NEAR(line.fold_deg.value(), std::acos(-inner / slant) * 180.0 / kPi, 1e-4) << sides;
        }
        EXPECT_EQ(folds, sides);
        EXPECT_FALSE(diagnostics.has_findings());
    }
}

// The motion of what is refined ends with the tips in one place, as joints and frames have it.
TEST(Carton, TheMotionEndsInTheRefinedShape) {
    const CreasePattern pattern = pyramid(5, 40, 60);
    Diagnostics diagnostics;
    SuggestOptions options;
    options.near_mm = 80.0;
    const auto found = suggest_joins(pattern, options, diagnostics);
    ASSERT_TRUE(found);
    AcceptOptions far;
    far.most_turn_deg = 180.0;
    const auto joins = accept_joins(pattern, options, *found, "all", far, diagnostics);
    ASSERT_TRUE(joins);
    const auto refined = refine_shape(pattern, {{}, *joins}, diagnostics);
    ASSERT_TRUE(refined);
    auto assembly = fold_sheet(refined->pattern, {}, diagnostics);
    ASSERT_TRUE(assembly);
    ASSERT_TRUE(simulate_sheet(*assembly, {}, diagnostics));
    std::vector<Frame> frames(assembly->plates.size());
    ASSERT_TRUE(place(*assembly, Angle::degrees(0.0), frames));
    std::vector<Vec3> tips;
    for (std::size_t i = 0; i < assembly->plates.size(); ++i) {
        const Ring& ring = assembly->plates[i].outline.outer;
        if (ring.size() != 3) continue;
        const Vec2 tip =
            *std::max_element(ring.begin(), ring.end(), [](Vec2 a, Vec2 b) { return length(a) < length(b); });
        tips.push_back(frames[i].point(tip));
    }
    ASSERT_EQ(tips.size(), 5U);
    for (const Vec3 tip : tips) EXPECT_LT(distance(tip, tips.front()), 0.01);
}

TEST(Carton, WhatIsLikeAnAcceptedMergeIsAcceptedToo) {
    // A tube of four walls with a pyramid at either end; its glue flap is left out.
    CreasePattern pattern;
    std::vector<Vec2> border;
    for (int i = 0; i < 4; ++i) {
        border.push_back({40.0 * i, 0});
        border.push_back({40.0 * i + 20, -28});
    }
    border.push_back({160, 0});
    for (int i = 3; i >= 0; --i) {
        border.push_back({40.0 * i + 40, 70});
        border.push_back({40.0 * i + 20, 98});
    }
    border.push_back({0, 70});
    add_line(pattern, border, true, CreaseUse::cut);
    for (int i = 0; i < 4; ++i) {
        add_line(pattern, {{40.0 * i, 0}, {40.0 * i + 40, 0}}, false, CreaseUse::valley);
        add_line(pattern, {{40.0 * i, 70}, {40.0 * i + 40, 70}}, false, CreaseUse::valley);
        if (i > 0) add_line(pattern, {{40.0 * i, 0}, {40.0 * i, 70}}, false, CreaseUse::valley);
    }
    Diagnostics diagnostics;
    SuggestOptions options;
    options.near_mm = 30.0;
    const auto found = suggest_joins(pattern, options, diagnostics);
    ASSERT_TRUE(found);
    ASSERT_GE(found->rows.size(), 2U);
    EXPECT_EQ(found->rows[0].join.parts.size(), 4U);
    EXPECT_EQ(found->rows[1].join.parts.size(), 4U);
    EXPECT_EQ(found->rows[0].like, std::vector<int>{2});
    const auto both = accept_joins(pattern, options, *found, "merge 1", {}, diagnostics);
    ASSERT_TRUE(both);
    // And the walls still meet, at the top and at the bottom.
    EXPECT_EQ(both->size(), 4U);
    const auto one = accept_joins(pattern, options, *found, "merge 1", {false}, diagnostics);
    ASSERT_TRUE(one);
    EXPECT_EQ(one->size(), 3U);
    const auto refined = refine_shape(pattern, {{}, *both}, diagnostics);
    ASSERT_TRUE(refined);
    EXPECT_TRUE(refined->closes) << refined->residual_mm;
    // The tips lean in from the upright walls.
    const double lean = std::asin(20.0 / 28.0) * 180.0 / kPi;
    for (const CreaseLine& line : refined->pattern.lines) {
        if (line.use == CreaseUse::cut || std::abs(line.points[0].x - line.points[1].x) < 1.0) continue;
        EXPECT_NEAR(line.fold_deg.value(), lean, 1e-3);
    }
}

// The same words, with what they accepted before, change nothing, and take no other suggestion.
TEST(Carton, AcceptingAgainIsRepeatable) {
    const CreasePattern pattern = pyramid(4, 40, 53);
    Diagnostics diagnostics;
    SuggestOptions options;
    options.near_mm = 60.0;
    const auto found = suggest_joins(pattern, options, diagnostics);
    ASSERT_TRUE(found);
    ASSERT_FALSE(found->rows.empty());
    const auto once = accept_joins(pattern, options, *found, "merge 1", {false}, diagnostics);
    ASSERT_TRUE(once);
    options.joins = *once;
    const auto then = suggest_joins(pattern, options, diagnostics);
    ASSERT_TRUE(then);
    for (const Suggestion& row : then->rows) EXPECT_NE(row.name(), "merge 1");
    const auto twice = accept_joins(pattern, options, *then, "merge 1", {false}, diagnostics);
    ASSERT_TRUE(twice);
    EXPECT_EQ(write_refinement(*twice, {}), write_refinement(*once, {}));
    EXPECT_FALSE(accept_joins(pattern, options, *then, "merge 1,", {}, diagnostics));
    EXPECT_EQ(diagnostics.sorted().front().message, "\"merge 1,\" names nothing before or behind a comma");
}

TEST(Carton, AFlapIsPastedOnItsWall) {
    // Three walls and a glue flap: at right angles the flap is far from the plane of the first wall.
    const std::vector<double> widths{60, 60, 60, 12};
    const CreasePattern pattern = strip(widths, 80);
    Diagnostics diagnostics;
    const auto assembly = fold_sheet(pattern, {}, diagnostics);
    ASSERT_TRUE(assembly);
    std::string flap;
    std::string first;
    for (const Plate& plate : assembly->plates) {
        const Box box = bounds(plate.outline.outer);
        if (box.width() < 13.0) flap = plate.name;
        if (box.min.x < 1.0) first = plate.name;
    }
    RefineOptions options;
    options.joins = {{JoinKind::paste, {{flap, {}}, {first, {}}}},
                     {JoinKind::merge, {{first, {0, 0}}, {flap, {180, 0}}}}};
    const auto refined = refine_shape(pattern, options, diagnostics);
    ASSERT_TRUE(refined);
    EXPECT_TRUE(refined->closes) << refined->residual_mm;
    const std::vector<double> turns = turns_of_strip(refined->pattern);
    ASSERT_EQ(turns.size(), 3U);
    for (const double turn : turns) EXPECT_NEAR(turn, 2.0 * kPi / 3.0, 1e-6);
}

TEST(Carton, JoinsOfWhatIsNotThereAreTold) {
    const CreasePattern pattern = pyramid(4, 40, 60);
    const auto told = [&](const Join& join) {
        Diagnostics diagnostics;
        EXPECT_FALSE(refine_shape(pattern, {{}, {join}}, diagnostics));
        return diagnostics.sorted().empty() ? std::string() : diagnostics.sorted().front().message;
    };
    EXPECT_EQ(told({JoinKind::paste, {{"sheet/lid", {}}, {"sheet/base", {}}}}),
              "join 1: a paste names \"sheet/lid\", and the sheet has no such panel");
    EXPECT_EQ(told({JoinKind::paste, {{"sheet/base", {}}, {"sheet/base", {}}}}),
              "join 1: a paste names \"sheet/base\" twice: what is joined is of different panels");
    EXPECT_EQ(told({JoinKind::merge, {{"sheet/base", {}}}}),
              "join 1: a merge joins two corners or more, and this one names 1");
    EXPECT_EQ(told({JoinKind::merge, {{"sheet/base", {40.5, 0}}, {"sheet/front", {40, 0}}}}),
              "join 1: \"sheet/base\" has no corner at (40.50, 0.00) mm; the nearest is at (40.00, 0.00) mm, "
              "0.50 mm away");
    Diagnostics diagnostics;
    const auto found = suggest_joins(pattern, {}, diagnostics);
    ASSERT_TRUE(found);
    EXPECT_FALSE(accept_joins(pattern, {}, *found, "merge 99", {}, diagnostics));
    EXPECT_EQ(diagnostics.sorted().front().message, "there is no suggestion \"merge 99\"");
}

// A fold that is drawn flat stays what it was drawn as.
TEST(Carton, FlatMountainsStayMountains) {
    CreasePattern pattern = strip({40, 40, 40, 40, 40}, 60);
    pattern.lines[2].use = CreaseUse::mountain;
    pattern.lines[2].fold_deg = 0.0;
    Diagnostics diagnostics;
    const auto refined = refine_shape(pattern, {}, diagnostics);
    ASSERT_TRUE(refined);
    EXPECT_EQ(std::count_if(refined->pattern.lines.begin(), refined->pattern.lines.end(),
                            [](const CreaseLine& line) { return line.use == CreaseUse::mountain; }),
              1);
}

// Of hundreds of strips that lie near one another only some pairs are looked at: all would take minutes.
TEST(Carton, AccordionsEnd) {
    CreasePattern pattern = strip(std::vector<double>(600, 20.0), 60.0);
    for (std::size_t i = 1; i < pattern.lines.size(); ++i) {
        if (i % 2 == 0) pattern.lines[i].use = CreaseUse::mountain;
        pattern.lines[i].fold_deg = 170.0;
    }
    Diagnostics diagnostics;
    const auto found = suggest_joins(pattern, {}, diagnostics);
    ASSERT_TRUE(found);
    EXPECT_LE(found->rows.size(), kMostSuggestions);
    EXPECT_GT(found->left_out, 0U) << "not all were looked at";
}

// Drawings of others: what is suggested is the same each time, and what is accepted of all of it closes.
TEST(Carton, DrawingsOfOthersCloseAsFarAsTheyMay) {
    const std::filesystem::path folder =
        std::filesystem::path(POPUP_SOURCE_DIR).parent_path() / "shared/data/folded/cartons";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no carton drawings in " << folder;
    int seen = 0;
    for (const char* name : {"fefco0201-350x190x230-t5.svg", "tucklock-C001GX-200x150x60-t1.5.svg"}) {
        const auto pattern = test::read_folded(folder / name, {{"#005cff", DrawnUse::cut}});
        ASSERT_TRUE(pattern) << name;
        Diagnostics diagnostics;
        const auto found = suggest_joins(*pattern, {}, diagnostics);
        const auto again = suggest_joins(*pattern, {}, diagnostics);
        ASSERT_TRUE(found && again) << name;
        ASSERT_EQ(found->rows.size(), again->rows.size());
        for (std::size_t i = 0; i < found->rows.size(); ++i)
            EXPECT_EQ(shown_join(found->rows[i].join, {}), shown_join(again->rows[i].join, {}));
        const auto joins = accept_joins(*pattern, {}, *found, "all", {}, diagnostics);
        ASSERT_TRUE(joins);
        const auto refined = refine_shape(*pattern, {{}, *joins}, diagnostics);
        ASSERT_TRUE(refined);
        EXPECT_TRUE(refined->closes) << name << ": " << refined->residual_mm;
        ++seen;
    }
    EXPECT_EQ(seen, 2);
}

}  // namespace
}  // namespace popup
