// Walls that a glue flap closes to a tube: how far their folds are to go, told where the sheet collides.
#include "folded/carton/ring.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "folded/carton/closing_angles.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "support/dielines.h"

namespace popup {
namespace {

void add(CreasePattern& pattern, std::vector<Vec2> points, bool closed, CreaseUse use, std::string name) {
    CreaseLine line;
    line.points = std::move(points);
    line.closed = closed;
    line.use = use;
    line.name = std::move(name);
    line.place = {static_cast<int>(pattern.lines.size()) + 1, 1};
    pattern.lines.push_back(std::move(line));
}

// Walls so wide side by side, the glue flap last, 50 mm high; the border is line 0.
CreasePattern strip(const std::vector<double>& widths) {
    CreasePattern pattern;
    pattern.file = "strip.svg";
    const double all = std::accumulate(widths.begin(), widths.end(), 0.0);
    add(pattern, {{0, 0}, {all, 0}, {all, 50}, {0, 50}}, true, CreaseUse::cut, "#000000");
    double x = 0.0;
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
        x += widths[i];
        add(pattern, {{x, 0}, {x, 50}}, false, CreaseUse::mountain, "#ff0000");
    }
    return pattern;
}

// The same with a lid on the second wall, whose fold has that colour, and goes to 90°.
CreasePattern strip_with_lid(const std::vector<double>& widths, const std::string& colour) {
    CreasePattern pattern = strip(widths);
    const double a = widths[0];
    const double b = a + widths[1];
    std::vector<Vec2>& border = pattern.lines[0].points;
    border = {border[0], border[1], border[2], {b, 50}, {b - 2.0, 80}, {a + 2.0, 80}, {a, 50}, border[3]};
    add(pattern, {{a, 50}, {b, 50}}, false, CreaseUse::mountain, colour);
    return pattern;
}

std::optional<folded::OpenRing> first_ring(const CreasePattern& pattern, const FoldOptions& options) {
    const auto rings = folded::open_rings(pattern, options);
    return rings.empty() ? std::nullopt : std::optional(rings.front());
}

bool simulated(Assembly& sheet, Diagnostics& found) { return simulate_sheet(sheet, {}, found).has_value(); }

// What is told of a sheet that collides.
std::vector<Diagnostic> told_of(const CreasePattern& pattern) {
    Diagnostics told(pattern.file);
    folded::tell_open_ring(pattern, {}, true, simulated, told);
    return told.sorted();
}

std::size_t collisions(const CreasePattern& pattern, const FoldOptions& options) {
    Diagnostics found;
    auto sheet = fold_sheet(pattern, options, found);
    if (!sheet) return 0;
    simulate_sheet(*sheet, {}, found);
    std::size_t all = 0;
    for (const Diagnostic& one : found.sorted()) all += one.code == "collision" ? 1 : 0;
    return all;
}

TEST(OpenRing, SixWallsGoBySixtyDegrees) {
    const auto ring = first_ring(strip({40, 40, 40, 40, 40, 40, 12}), {});
    ASSERT_TRUE(ring);
    EXPECT_EQ(ring->lines, (std::vector<int>{1, 2, 3, 4, 5, 6}));
    for (const double deg : ring->deg) EXPECT_DOUBLE_EQ(deg, 60.0);
}

TEST(OpenRing, TheGlueFlapMayComeFirst) {
    const auto ring = first_ring(strip({12, 30, 30, 30, 30, 30}), {});
    ASSERT_TRUE(ring);
    EXPECT_EQ(ring->lines, (std::vector<int>{5, 4, 3, 2, 1}));
    for (const double deg : ring->deg) EXPECT_DOUBLE_EQ(deg, 72.0);
}

TEST(OpenRing, OppositeWallsMayBeWiderThanOthers) {
    const auto ring = first_ring(strip({60, 30, 25, 60, 30, 25, 12}), {});
    ASSERT_TRUE(ring);
    for (const double deg : ring->deg) EXPECT_DOUBLE_EQ(deg, 60.0);
}

TEST(OpenRing, ThreeWallsGoAsTheTriangleHasIt) {
    const auto ring = first_ring(strip({30, 40, 50, 12}), {});
    ASSERT_TRUE(ring);
    ASSERT_EQ(ring->deg.size(), 3U);
    EXPECT_NEAR(ring->deg[0], 90.0, 1e-9);  // between the legs
    EXPECT_NEAR(ring->deg[1], 180.0 - 36.8699, 1e-4);
    EXPECT_NEAR(ring->deg[2], 180.0 - 53.1301, 1e-4);
}

TEST(OpenRing, NothingIsSaidOfWhatIsNoneOrIsKnown) {
    const std::vector<double> six{40, 40, 40, 40, 40, 40, 12};
    EXPECT_FALSE(first_ring(strip({50, 30, 50, 30, 12}), {})) << "a box";
    EXPECT_FALSE(first_ring(strip({40, 40, 40, 40, 40, 40}), {})) << "the last is no glue flap";
    EXPECT_FALSE(first_ring(strip({20, 90, 30, 25, 12}), {})) << "one is longer than all others together";
    EXPECT_FALSE(first_ring(strip({20, 90, 30, 12}), {})) << "no triangle";
    CreasePattern says_it = strip(six);
    for (CreaseLine& line : says_it.lines) line.fold_deg = 90.0;
    EXPECT_FALSE(first_ring(says_it, {})) << "the drawing says how far";
    FoldOptions options;
    options.fold_angles.push_back({"", Angle::degrees(90.0)});
    EXPECT_FALSE(first_ring(strip(six), options)) << "the options do";
    CreasePattern back = strip(six);
    back.lines[3].use = CreaseUse::valley;
    EXPECT_FALSE(first_ring(back, {})) << "one goes the other way";
    CreasePattern folds_right = strip(six);
    folds_right.fold_deg = 60.0;
    EXPECT_FALSE(first_ring(folds_right, {})) << "they go so already";
}

struct Closed {
    std::string name;
    std::vector<double> widths, deg;
    std::string why;
};

// Of walls of different widths, in the shape that a designer would draw.
TEST(ClosingAngles, WallsOfDifferentWidthsMeet) {
    const std::string right = "with as many right angles as they can have";
    const std::string round = "in the shape that has the most room";
    const double slant = std::atan2(40.0, 30.0) * 180.0 / std::numbers::pi;
    const double taper = std::acos(15.0 / 40.0) * 180.0 / std::numbers::pi;
    const double kite = std::atan2(60.0, 30.0) * 180.0 / std::numbers::pi;
    const double roof = std::sqrt(30.0 * 30.0 + 10.0 * 10.0);
    const double pitch = std::atan2(10.0, 30.0) * 180.0 / std::numbers::pi;
    for (const Closed& row : std::vector<Closed>{
             {"one slanted wall", {80, 40, 50, 50}, {90, 90, slant, 180.0 - slant}, right},
             {"tapered on both sides", {80, 40, 50, 40}, {180.0 - taper, taper, taper, 180.0 - taper}, round},
             {"a kite", {30, 60, 60, 30}, {90, 180.0 - 2.0 * (90.0 - kite), 90, 180.0 - 2.0 * kite}, round},
             {"a house", {60, 40, roof, roof, 40}, {90, 90.0 - pitch, 2.0 * pitch, 90.0 - pitch, 90}, right},
             {"one edge off", {60, 50, 40, std::sqrt(800.0), 30}, {90, 90, 45, 45, 90}, right}}) {
        const auto found = folded::closing_angles(row.widths, std::nullopt);
        ASSERT_FALSE(found.empty()) << row.name;
        EXPECT_EQ(found.front().why, row.why) << row.name;
        EXPECT_EQ(found.back().why, round) << row.name;
        for (std::size_t i = 0; i < row.deg.size(); ++i)
            EXPECT_NEAR(found.front().deg[i], row.deg[i], 1e-6) << row.name << " " << i;
    }
}

TEST(ClosingAngles, WhateverIsFoundMeets) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> width(20.0, 60.0);
    for (int round = 0; round < 300; ++round) {
        std::vector<double> widths(static_cast<std::size_t>(4 + round % 6));
        for (double& one : widths) one = width(random);
        const double all = std::accumulate(widths.begin(), widths.end(), 0.0);
        const bool closes = 2.0 * *std::max_element(widths.begin(), widths.end()) < all;
        const auto found = folded::closing_angles(widths, std::nullopt);
        EXPECT_EQ(!found.empty(), closes);
        for (const folded::ClosingAngles& one : found) {
            EXPECT_NEAR(std::accumulate(one.deg.begin(), one.deg.end(), 0.0), 360.0, 1e-6);
            EXPECT_LT(folded::gap_of(widths, one.deg), folded::kMeets * all);
            EXPECT_GT(*std::min_element(one.deg.begin(), one.deg.end()), 0.0);
        }
    }
}

// The walls of a quadrangle with no symmetry, on one of which its end hangs, drawn either way around.
TEST(ClosingAngles, AnEndHasThem) {
    const Ring end{{0, 0}, {70, 0}, {80, 45}, {15, 55}};
    const auto side = [&](std::size_t i) { return distance(end[i % 4], end[(i + 1) % 4]); };
    for (const bool onwards : {true, false}) {
        std::vector<double> widths;
        for (std::size_t i = 0; i < 4; ++i) widths.push_back(side(onwards ? i + 3 : 5 - i));
        const auto deg = folded::fold_angles_of_end(end, {{70, 0}, {0, 0}}, widths, 1);
        ASSERT_TRUE(deg) << onwards;
        EXPECT_NEAR(std::accumulate(deg->begin(), deg->end(), 0.0), 360.0, 1e-9);
        EXPECT_LT(folded::gap_of(widths, *deg), 1e-9) << onwards;
        const auto found = folded::closing_angles({widths[0] - 0.5, widths[1], widths[2], widths[3]}, deg);
        ASSERT_FALSE(found.empty());
        EXPECT_EQ(found.front().why, "as the panel has it that closes an end");
        EXPECT_LT(folded::gap_of({widths[0] - 0.5, widths[1], widths[2], widths[3]}, found.front().deg),
                  1e-4);
        widths[2] += 10.0;
        EXPECT_FALSE(folded::fold_angles_of_end(end, {{70, 0}, {0, 0}}, widths, 1));
    }
}

// Nothing collides at 90°: the last wall just does not reach the first.
TEST(OpenRing, ATubeThatHangsOpenIsTold) {
    const CreasePattern tapered = strip({80, 40, 50, 40, 10});
    Diagnostics told(tapered.file);
    folded::tell_open_ring(tapered, {}, false, simulated, told);
    const auto all = told.sorted();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(
        all[0].message,
        "4 walls side by side, with a glue flap at their end, meet if their 4 folds go by 112.02°, "
        "67.98°, 67.98° and 112.02°, in this order instead of 90°, in the shape that has the most room; "
        "nothing goes through anything then");
    EXPECT_EQ(
        all[0].hints,
        (std::vector<std::string>{
            "write data-fold-angle=\"112.0243\" in line 2, data-fold-angle=\"67.9757\" in line 3, "
            "data-fold-angle=\"67.9757\" in line 4 and data-fold-angle=\"112.0243\" in line 5 into their "
            "elements"}));
    // A tray with half a lid: its walls hang on the second wall of the row, and are no end of it.
    CreasePattern tray = strip({40, 100, 40, 50, 20});
    std::vector<Vec2>& border = tray.lines[0].points;
    border = {{0, 0}, {40, 0}, {40, -40}, {140, -40}, {140, 0}, {250, 0}, {250, 50}, {0, 50}};
    add(tray, {{40, 0}, {140, 0}}, false, CreaseUse::mountain, "#ff0000");
    folded::tell_open_ring(tray, {}, false, simulated, told);
    EXPECT_EQ(told.sorted().size(), 1U);
    // What meets already.
    folded::tell_open_ring(strip({50, 30, 50, 30, 12}), {}, false, simulated, told);
    EXPECT_EQ(told.sorted().size(), 1U);
}

// Whoever gives the option no longer sees a collision.
// A tube of many sides with flaps at its ends, whose folds say nothing: by right angles it coils up, wall on
// wall, and nothing need collide.
TEST(OpenRing, ATubeThatCoilsUpIsTold) {
    for (const int sides : {5, 6, 7, 12}) {
        std::string drawing = test::pointed_tube(sides);
        const std::string said = fmt::format(" data-fold-angle=\"{:g}\"", std::round(360.0 / sides));
        for (std::size_t at = drawing.find(said); at != std::string::npos; at = drawing.find(said))
            drawing.erase(at, said.size());
        ReadOptions read;
        read.drawing.as = DrawnAs::folded;
        Diagnostics diagnostics("box.svg");
        const Reading reading = read_source_text({"box.svg", drawing}, read, diagnostics);
        ASSERT_TRUE(reading.creases);
        Diagnostics told("box.svg");
        folded::tell_open_ring(*reading.creases, {}, false, simulated, told);
        ASSERT_EQ(told.sorted().size(), 1U) << sides;
        const Diagnostic one = told.sorted().front();
        EXPECT_EQ(one.code, "ring-open");
        EXPECT_EQ(
            one.message,
            fmt::format("{0} walls side by side, with a glue flap at their end, meet if their {0} folds "
                        "go by {1:.6g}° instead of 90°; nothing goes through anything then",
                        sides, std::round(36000.0 / sides) / 100.0));
    }
}

TEST(OpenRing, TheHintIsAnOptionWhereANameIsOfTheseFoldsAlone) {
    const CreasePattern pattern = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#00ff00");
    EXPECT_GT(collisions(pattern, {}), 0U);
    const auto told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].message,
              "6 walls side by side, with a glue flap at their end, meet if their 6 folds go by 60° instead "
              "of 90°; nothing goes through anything then");
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{"fold them so: --fold-angle '#ff0000=60'"}));
    EXPECT_EQ(told[0].place.line, 2);
    FoldOptions options;
    options.fold_angles.push_back({"#ff0000", Angle::degrees(60.0)});
    EXPECT_EQ(collisions(pattern, options), 0U);
}

TEST(OpenRing, TheHintIsTheirKindWhereOnlyTheyAreOfIt) {
    CreasePattern pattern = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#ff0000");
    pattern.lines.back().use = CreaseUse::valley;  // the lid opens
    const auto told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{"fold them so: --fold-angle mountain=60"}));
}

TEST(OpenRing, TheHintIsForTheDrawingWhereNoOptionTellsThemApart) {
    CreasePattern pattern = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#ff0000");
    const auto hint = [&] {
        const auto told = told_of(pattern);
        return told.size() == 1 && told[0].hints.size() == 1 ? told[0].hints[0] : "";
    };
    EXPECT_EQ(
        hint(),
        "write data-fold-angle=\"60\" into their elements, in lines 2, 3, 4, 5, 6 and 7, or draw them in "
        "a colour that no other fold has, and give --fold-angle for that colour");
    pattern.file = "strip.dxf";
    EXPECT_EQ(
        hint(),
        "draw them, their middles at (60.00, 25.00) mm, (90.00, 25.00) mm, (115.00, 25.00) mm, (175.00, "
        "25.00) mm, (205.00, 25.00) mm and (230.00, 25.00) mm, in a colour that no other fold has, and "
        "give --fold-angle for that colour");
    // An attribute would be of the lid, too.
    pattern.file = "strip.svg";
    for (CreaseLine& line : pattern.lines) line.place = {2, 3};
    EXPECT_EQ(
        hint(),
        "draw them, in line 2, in a colour that no other fold has, and give --fold-angle for that colour");
}

// Their angles differ, so that each needs a colour of its own, or all need one.
TEST(OpenRing, ThreeWallsAreToldWithThreeAngles) {
    CreasePattern pattern = strip({30, 40, 50, 12});
    auto told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_NE(told[0].message.find("by 90°, 143.13° and 126.87°, in this order"), std::string::npos)
        << told[0].message;
    for (std::size_t i = 1; i < pattern.lines.size(); ++i) pattern.lines[i].name = fmt::format("#00000{}", i);
    told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].hints,
              (std::vector<std::string>{"fold them so: --fold-angle '#000001=90' --fold-angle "
                                        "'#000002=143.1301' --fold-angle '#000003=126.8699'"}));
}

// Pure red and blue are the colours of Origami Simulator, whose folds go to 180° unless they are pale.
TEST(OpenRing, ColoursThatSay180DoNotStandInTheWay) {
    CreasePattern box = strip_with_lid({50, 30, 50, 30, 12}, "#ff0000");
    for (CreaseLine& line : box.lines) line.fold_deg = 180.0;
    EXPECT_GT(collisions(box, {}), 0U);
    auto told = told_of(box);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].message,
              "4 walls side by side, with a glue flap at their end, meet if their 4 folds go by 90° instead "
              "of 180°, and all other folds by 90°; nothing goes through anything then");
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{"fold them so: --fold-angle 90"}));
    FoldOptions options;
    options.fold_angles.push_back({"", Angle::degrees(90.0)});
    EXPECT_EQ(collisions(box, options), 0U);
    // Another angle that the drawing says is not to be overruled.
    CreasePattern leaning = box;
    leaning.lines.back().fold_deg = 100.0;
    EXPECT_TRUE(first_ring(leaning, {}));
    for (const Diagnostic& one : told_of(leaning)) EXPECT_NE(one.hints[0], "fold them so: --fold-angle 90");
    CreasePattern six = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#0000ff");
    for (CreaseLine& line : six.lines) line.fold_deg = 180.0;
    told = told_of(six);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].hints,
              (std::vector<std::string>{"fold them so: --fold-angle 90 --fold-angle '#ff0000=60'"}));
    options.fold_angles.push_back({"#ff0000", Angle::degrees(60.0)});
    EXPECT_EQ(collisions(six, options), 0U);
}

TEST(OpenRing, NothingIsToldThatDoesNotMend) {
    const CreasePattern pattern = strip({60, 30, 25, 60, 30, 25, 12});
    Diagnostics told(pattern.file);
    const auto collides = [](Assembly& /*sheet*/, Diagnostics& found) {
        found.warning("collision", {}, "two walls go through each other");
        return true;
    };
    folded::tell_open_ring(pattern, {}, true, collides, told);
    const auto locks = [](Assembly& /*sheet*/, Diagnostics& /*found*/) { return false; };
    folded::tell_open_ring(pattern, {}, true, locks, told);
    EXPECT_TRUE(told.sorted().empty());
    folded::tell_open_ring(pattern, {}, true, simulated, told);
    EXPECT_EQ(told.sorted().size(), 1U);
}

}  // namespace
}  // namespace popup
