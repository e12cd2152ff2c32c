// Sheets whose motion is known from formulas, and what is found in patterns that are not clean.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "miura.h"
#include "popup/crease_pattern.h"
#include "popup/motion.h"
#include "support/designs.h"

namespace popup {
namespace {

constexpr double kPi = std::numbers::pi;

Ring rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

CreasePattern sheet(std::vector<CreaseLine> lines) {
    CreasePattern pattern;
    pattern.lines = std::move(lines);
    return pattern;
}

Assembly folded(const CreasePattern& pattern, Diagnostics& diagnostics, const FoldOptions& options = {}) {
    auto assembly = fold_sheet(pattern, options, diagnostics);
    EXPECT_TRUE(assembly) << test::findings(diagnostics);
    return assembly ? std::move(*assembly) : Assembly{};
}

Assembly folded(const CreasePattern& pattern, const FoldOptions& options = {}) {
    Diagnostics diagnostics("sheet");
    Assembly assembly = folded(pattern, diagnostics, options);
    EXPECT_EQ(test::findings(diagnostics), "");
    return assembly;
}

std::vector<Frame> frames_at(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames));
    return frames;
}

// The largest distance between the places that plates give one corner of the sheet: whatever is said of
// hinges and loops, paper that is not cut hangs together there.
double torn(const Assembly& assembly, double deg) {
    const std::vector<Frame> frames = frames_at(assembly, deg);
    double largest = 0.0;
    for (const Line& line : assembly.lines) {
        if (line.kind == LineKind::cut) continue;
        const Frame& a = frames[static_cast<std::size_t>(line.plate)];
        const Frame& b = frames[static_cast<std::size_t>(line.other_plate)];
        for (const Vec2 p : {line.at.a, line.at.b})
            largest = std::max(largest, distance(a.point(p), b.point(p)));
    }
    return largest;
}

// How far a fold is bent, degrees; positive when its plates come nearer to each other in front of the paper.
double bend(const Assembly& assembly, const std::vector<Frame>& frames, const Line& line) {
    const Frame& left = frames[static_cast<std::size_t>(line.plate)];
    const Frame& right = frames[static_cast<std::size_t>(line.other_plate)];
    const Vec3 along = left.direction(unit(line.at.b - line.at.a));
    EXPECT_GE(line.piece, 0);
    EXPECT_LT(line.piece, static_cast<int>(assembly.pieces.size()));
    return std::atan2(dot(along, cross(right.normal(), left.normal())), dot(left.normal(), right.normal())) *
           180.0 / kPi;
}

TEST(FoldSheet, FoldsOneCreaseByItsShare) {
    const Assembly card = folded(sheet({{rectangle(0, 0, 200, 100), true, CreaseUse::cut},
                                        {{{100, 0}, {100, 100}}, false, CreaseUse::valley, 120.0}}));
    ASSERT_EQ(card.plates.size(), 2U);
    const Line& crease = card.lines.back();
    EXPECT_EQ(crease.kind, LineKind::valley);
    EXPECT_NEAR(*crease.fold_angle, 120.0 * kPi / 180.0, 1e-12);
    for (const double deg : {180.0, 135.0, 90.0, 10.0, 0.0})
        EXPECT_NEAR(bend(card, frames_at(card, deg), crease), 120.0 * (1.0 - deg / 180.0), 1e-9);
    EXPECT_FALSE(card.sweep.closed_flat);
}

TEST(FoldSheet, FoldsACubeWhoseFacesMeet) {
    // A cross of six squares.
    std::vector<CreaseLine> lines;
    lines.push_back({{{0, 0},
                      {10, 0},
                      {10, -10},
                      {20, -10},
                      {20, 0},
                      {40, 0},
                      {40, 10},
                      {20, 10},
                      {20, 20},
                      {10, 20},
                      {10, 10},
                      {0, 10}},
                     true,
                     CreaseUse::cut});
    for (const Segment& s :
         {Segment{{10, 0}, {10, 10}}, Segment{{20, 0}, {20, 10}}, Segment{{30, 0}, {30, 10}},
          Segment{{10, 0}, {20, 0}}, Segment{{10, 10}, {20, 10}}})
        lines.push_back({{s.a, s.b}, false, CreaseUse::mountain});
    const Assembly cube = folded(sheet(lines));
    ASSERT_EQ(cube.plates.size(), 6U);
    const std::vector<Frame> half = frames_at(cube, 90.0);
    for (const Line& line : cube.lines) {
        if (line.kind != LineKind::cut) {
            EXPECT_NEAR(bend(cube, half, line), -45.0, 1e-9);
        }
    }
    // Folded, its 24 corners are eight points.
    const std::vector<Frame> whole = frames_at(cube, 0.0);
    std::map<std::array<long, 3>, int> corners;
    for (std::size_t i = 0; i < cube.plates.size(); ++i) {
        for (const Vec2 p : cube.plates[i].outline.outer) {
            const Vec3 at = whole[i].point(p);
            ++corners[{std::lround(at.x * 1e6), std::lround(at.y * 1e6), std::lround(at.z * 1e6)}];
        }
    }
    EXPECT_EQ(corners.size(), 8U);
    for (const auto& [at, count] : corners) EXPECT_EQ(count, 3);
}

// A Miura sheet has one motion: all angles follow from one of them. With the lean γ of its sides, half of the
// turn about a side and about a crossing line are related by tan(across / 2) = sin γ tan(side / 2), as
// spherical trigonometry has it of a corner that folds flat.
TEST(FoldSheet, FoldsAMiuraSheetAsItsFormulaSays) {
    constexpr double kLean = 0.35;
    const Assembly sheet = folded(test::miura(6, 6, 12.0, 15.0, kLean));
    ASSERT_EQ(sheet.plates.size(), 36U);
    EXPECT_TRUE(sheet.sweep.closed_flat);
    for (int deg = 0; deg <= 180; deg += 5) EXPECT_LT(torn(sheet, deg), 1e-9 * 90.0) << deg;
    for (const double deg : {175.0, 120.0, 60.0, 20.0}) {
        const std::vector<Frame> frames = frames_at(sheet, deg);
        double side = 0.0;
        double across = 0.0;
        for (const Line& line : sheet.lines) {
            if (line.kind == LineKind::cut) continue;
            const double half = std::abs(bend(sheet, frames, line)) * kPi / 360.0;
            const bool is_across = std::abs(line.at.b.y - line.at.a.y) < 1e-6;
            double& known = is_across ? across : side;
            if (known == 0.0) known = half;
            EXPECT_NEAR(half, known, 1e-9) << deg;
            EXPECT_EQ(bend(sheet, frames, line) > 0.0, line.kind == LineKind::valley);
        }
        const double factor = std::tan(across) / std::tan(side);
        EXPECT_NEAR(std::min(factor, 1.0 / factor), std::sin(kLean), 1e-9) << deg;
    }
}

// Two boxes on the fold of a card whose corners are off by up to a hundredth of a millimetre: their folds are
// not parallel, so the sheet is rigid, strictly.
TEST(FoldSheet, RefinesCornersThatADrawingRounded) {
    std::vector<CreaseLine> lines{{rectangle(0, 0, 150, 160), true, CreaseUse::cut},
                                  {{{0, 80}, {30, 80}}, false, CreaseUse::valley, 180.0},
                                  {{{70, 80}, {80, 80}}, false, CreaseUse::valley, 180.0},
                                  {{{120, 80}, {150, 80}}, false, CreaseUse::valley, 180.0}};
    for (const double x : {30.0, 80.0}) {
        const double high = 15.0 + 0.2 * x;
        for (const double side : {x, x + 40.0})
            lines.push_back({{{side, 80 - high}, {side, 80 + high}}, false, CreaseUse::cut});
        for (const double y : {80 - high, 80 + high})
            lines.push_back({{{x, y}, {x + 40.0, y}}, false, CreaseUse::valley, 180.0});
        lines.push_back({{{x, 80}, {x + 40.0, 80}}, false, CreaseUse::mountain, 180.0});
    }
    CreasePattern rounded = sheet(std::move(lines));
    for (CreaseLine& line : rounded.lines) {
        for (Vec2& p : line.points) {
            // As much for all lines that meet in it.
            const double by = 0.01 * std::sin(7.0 * std::round(p.x) + 3.0 * std::round(p.y));
            p = p + Vec2{by, -0.7 * by};
        }
    }
    Diagnostics diagnostics("rounded");
    const Assembly card = folded(rounded, diagnostics);
    EXPECT_NE(test::findings(diagnostics).find("corners-refined"), std::string::npos)
        << test::findings(diagnostics);
    EXPECT_EQ(card.sweep.from_deg, 0.0);
    for (int deg = 0; deg <= 180; deg += 5) EXPECT_LT(torn(card, deg), 1e-9 * 160.0) << deg;
    // No corner is far from where it was drawn.
    for (const Plate& plate : card.plates) {
        for (const Vec2 p : plate.outline.outer) {
            double nearest = 1e9;
            for (const CreaseLine& line : rounded.lines) {
                for (const Vec2 q : line.points) nearest = std::min(nearest, distance(p, q));
            }
            EXPECT_LT(nearest, 0.05);
        }
    }
}

// Four folds from a corner to the border of a sheet. By Kawasaki's theorem they fold flat, for opposite
// sectors are half a turn together; one of the folds beside the smallest sector goes the other way.
CreasePattern flat_corner(std::mt19937& random, double digits) {
    const auto number = [&random](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
    };
    const double first = number(0.3, 0.45) * kPi;
    const double second = number(0.55, 0.7) * kPi;
    const std::array<double, 4> sectors{first, second, kPi - first, kPi - second};
    const auto smallest = std::min_element(sectors.begin(), sectors.end()) - sectors.begin();
    const Vec2 corner{number(40, 80), number(40, 60)};
    const auto rounded = [digits](Vec2 p) {
        return Vec2{std::round(p.x * digits) / digits, std::round(p.y * digits) / digits};
    };
    CreasePattern pattern = sheet({{rectangle(0, 0, 120, 100), true, CreaseUse::cut}});
    double at = number(0.0, 2.0 * kPi);
    for (std::ptrdiff_t i = 0; i < 4; ++i) {
        const Vec2 out{std::cos(at), std::sin(at)};
        const double far = std::min((out.x > 0.0 ? 120.0 - corner.x : -corner.x) / out.x,
                                    (out.y > 0.0 ? 100.0 - corner.y : -corner.y) / out.y);
        pattern.lines.push_back({{rounded(corner), rounded(corner + far * out)},
                                 false,
                                 i == smallest ? CreaseUse::mountain : CreaseUse::valley,
                                 180.0});
        at += sectors.at(static_cast<std::size_t>(i));
    }
    return pattern;
}

// Flat states are singular: what a drawing rounds by some millionths keeps folds from their last hundredths
// of a degree, and no more.
TEST(FoldSheet, FoldsRoundedCornersNearlyFlat) {
    std::mt19937 random(20);
    for (int round = 0; round < 30; ++round) {
        const Assembly sheet = folded(flat_corner(random, 1e6));
        int folds = 0;
        for (const Line& line : sheet.lines) {
            if (line.kind == LineKind::cut) continue;
            ++folds;
            EXPECT_GT(line.fold_angle.value_or(0.0) * 180.0 / kPi, 179.2) << round;
        }
        EXPECT_EQ(folds, 4) << round;
        for (int deg = 0; deg <= 180; deg += 20) EXPECT_LT(torn(sheet, deg), 1e-6) << round;
    }
}

// A map of panels of 20 mm: lines across are folded first, and the others over them.
CreasePattern map_of(int columns, int rows, double bent_mm) {
    CreasePattern pattern = sheet({{rectangle(0, 0, 20.0 * columns, 20.0 * rows), true, CreaseUse::cut}});
    const auto corner = [&](int i, int j) {
        const bool inside = i > 0 && i < columns && j > 0 && j < rows;
        return Vec2{20.0 * i + (inside ? bent_mm * std::sin(5.0 * i + 3.0 * j) : 0.0), 20.0 * j};
    };
    const auto use = [](bool mountain) { return mountain ? CreaseUse::mountain : CreaseUse::valley; };
    for (int j = 1; j < rows; ++j) {
        for (int i = 0; i < columns; ++i)
            pattern.lines.push_back({{corner(i, j), corner(i + 1, j)}, false, use(j % 2 == 0), 180.0});
    }
    for (int i = 1; i < columns; ++i) {
        for (int j = 0; j < rows; ++j)
            pattern.lines.push_back({{corner(i, j), corner(i, j + 1)}, false, use((i + j) % 2 == 0), 180.0});
    }
    return pattern;
}

void expect_folds_in_turn(const Assembly& map) {
    EXPECT_EQ(map.sweep.from_deg, 0.0);
    const auto largest_bend = [&](const std::vector<Frame>& frames, bool across) {
        double least = 1e9;
        double most = 0.0;
        for (const Line& line : map.lines) {
            const bool is_across = std::abs(line.at.b.y - line.at.a.y) < 1e-3;
            if (line.kind == LineKind::cut || is_across != across) continue;
            const double angle = std::abs(bend(map, frames, line));
            least = std::min(least, angle);
            most = std::max(most, angle);
        }
        return std::pair{least, most};
    };
    for (int deg = 0; deg <= 180; deg += 5) EXPECT_LT(torn(map, deg), 1e-7) << deg;
    // The first lines are folded flat half way, and then the others go.
    const auto half = frames_at(map, 90.0);
    EXPECT_GT(largest_bend(half, true).first, 179.99);
    EXPECT_LT(largest_bend(half, false).second, 0.01);
    const auto later = frames_at(map, 60.0);
    EXPECT_GT(largest_bend(later, true).first, 179.99);
    EXPECT_GT(largest_bend(later, false).first, 20.0);
    EXPECT_GT(largest_bend(frames_at(map, 0.0), false).first, 179.99);
}

TEST(FoldSheet, FoldsTheLinesOfAMapOneAfterAnother) {
    for (const auto& [columns, rows] : {std::pair{2, 2}, std::pair{3, 3}, std::pair{4, 3}, std::pair{8, 8}})
        expect_folds_in_turn(folded(map_of(columns, rows, 0.0)));
}

TEST(FoldSheet, StraightensLinesThatADrawingRounded) {
    Diagnostics diagnostics("map");
    const Assembly map = folded(map_of(4, 4, 0.001), diagnostics);
    const std::string told = test::findings(diagnostics);
    EXPECT_NE(told.find("corners-refined"), std::string::npos) << told;
    EXPECT_EQ(told.find("not-rigid"), std::string::npos) << told;
    expect_folds_in_turn(map);
}

TEST(FoldSheet, SaysThatNothingFolds) {
    CreasePattern tray = sheet({{rectangle(0, 0, 90, 90), true, CreaseUse::cut},
                                {{{30, 0}, {30, 90}}, false, CreaseUse::cut},
                                {{{60, 0}, {60, 90}}, false, CreaseUse::cut}});
    tray.lines[0].name = "Stanz";
    tray.lines[1].name = tray.lines[2].name = "Rill hoch";
    Diagnostics diagnostics("tray");
    folded(tray, diagnostics);
    const auto told = diagnostics.sorted();
    ASSERT_EQ(told.size(), 1U) << test::findings(diagnostics);
    EXPECT_EQ(told[0].code, "no-folds");
    EXPECT_EQ(told[0].message, "no line of this sheet is a fold, so nothing of it folds");
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{
                                 "say which lines are folds, as --lines fold='Rill hoch'; lines here are "
                                 "called Stanz, 'Rill hoch'"}));
    tray.lines[2].use = CreaseUse::fold;
    Diagnostics folds("tray");
    folded(tray, folds);
    for (const Diagnostic& one : folds.sorted()) EXPECT_NE(one.code, "no-folds");
}

// Ends of pillow boxes: folds that are drawn as folds alone, of which no other says which way they go.
TEST(FoldSheet, SaysThatFoldsWithABendStayFlatWhicheverWayTheyGo) {
    for (const CreaseUse use : {CreaseUse::fold, CreaseUse::valley}) {
        Diagnostics diagnostics("pillow");
        folded(sheet({{rectangle(0, 0, 30, 30), true, CreaseUse::cut},
                      {{{0, 15}, {15, 10}, {30, 15}}, false, use}}),
               diagnostics);
        const auto told = diagnostics.sorted();
        ASSERT_EQ(told.size(), 1U) << test::findings(diagnostics);
        EXPECT_EQ(told[0].code, "not-rigid");
        EXPECT_TRUE(
            told[0].message.starts_with("the loop of 2 folds around the corner at (15.00, 10.00) mm "
                                        "closes only while nothing is folded"))
            << told[0].message;
        ASSERT_EQ(told[0].hints.size(), 1U);
        EXPECT_NE(told[0].hints[0].find("draw it straight"), std::string::npos) << told[0].hints[0];
    }
}

TEST(FoldSheet, SaysWhichFoldsStayFlat) {
    // Of a corner with four folds of which one line is a valley and the other one as well, both cannot go.
    CreasePattern pattern = map_of(2, 2, 0.0);
    for (CreaseLine& line : pattern.lines) {
        if (line.use == CreaseUse::cut) continue;
        line.use = CreaseUse::valley;
        if (line.points[0].x == line.points[1].x) line.fold_deg = 60.0;
    }
    Diagnostics diagnostics("valleys");
    const Assembly card = folded(pattern, diagnostics);
    const std::string told = test::findings(diagnostics);
    EXPECT_NE(told.find("fold-stays-flat"), std::string::npos) << told;
    for (int deg = 0; deg <= 180; deg += 5) EXPECT_LT(torn(card, deg), 1e-7) << deg;
}

TEST(FoldSheet, SaysWhichLoopIsRigid) {
    // Three folds meet in an inner corner: no angles but nought close them.
    Diagnostics diagnostics("rigid");
    const Assembly sheet_ = folded(sheet({{rectangle(-50, -50, 50, 50), true, CreaseUse::cut},
                                          {{{0, 0}, {50, 0}}, false, CreaseUse::valley},
                                          {{{0, 0}, {-50, 30}}, false, CreaseUse::valley},
                                          {{{0, 0}, {-50, -30}}, false, CreaseUse::mountain}}),
                                   diagnostics);
    const std::string told = test::findings(diagnostics);
    EXPECT_NE(told.find("not-rigid"), std::string::npos) << told;
    EXPECT_NE(told.find("the corner at (0.00, 0.00) mm"), std::string::npos) << told;
    EXPECT_TRUE(sheet_.sweep.bends);
}

// A strip with corners along its middle, each with a fold up and one down, which are mirror images of each
// other, so that it folds flat: but those of one corner, that of the number `odd`.
CreasePattern strip_with_odd_corner(int corners, int odd) {
    constexpr double kApart = 30.0;
    constexpr double kHeight = 40.0;
    CreasePattern strip =
        sheet({{rectangle(0, -kHeight, (corners + 1) * kApart, kHeight), true, CreaseUse::cut}});
    for (int i = 0; i <= corners; ++i) {
        strip.lines.push_back({{{i * kApart, 0}, {(i + 1) * kApart, 0}},
                               false,
                               i % 2 == 0 ? CreaseUse::valley : CreaseUse::mountain,
                               180.0});
        if (i == corners) break;
        const double x = (i + 1) * kApart;
        const double end = x + (i % 2 == 0 ? 11.0 : -7.0);
        const double other_end = i == odd ? end + 8.0 : end;
        strip.lines.push_back({{{x, 0}, {end, kHeight}}, false, CreaseUse::valley, 180.0});
        strip.lines.push_back({{{x, 0}, {other_end, -kHeight}}, false, CreaseUse::valley, 180.0});
    }
    return strip;
}

TEST(FoldSheet, SaysWhichLoopEndsItsMotion) {
    // A fold of that corner is folded by half a turn before the others are; all close until then.
    for (const int odd : {0, 2, 4}) {
        Diagnostics diagnostics("strip");
        folded(strip_with_odd_corner(5, odd), diagnostics);
        const std::string told = test::findings(diagnostics);
        const std::string where =
            "the corner at (" + std::to_string(30 * (odd + 1)) + ".00, 0.00) mm closes only until";
        EXPECT_NE(told.find(where), std::string::npos) << told;
    }
}

TEST(FoldSheet, CutsHolesAndSlits) {
    // A box on the fold of a card, whose sides are slits: its loops go around the two of them.
    const Assembly card = folded(sheet({{rectangle(0, 0, 100, 160), true, CreaseUse::cut},
                                        {{{0, 80}, {30, 80}}, false, CreaseUse::valley, 180.0},
                                        {{{70, 80}, {100, 80}}, false, CreaseUse::valley, 180.0},
                                        {{{30, 60}, {30, 100}}, false, CreaseUse::cut},
                                        {{{70, 60}, {70, 100}}, false, CreaseUse::cut},
                                        {{{30, 60}, {70, 60}}, false, CreaseUse::valley, 180.0},
                                        {{{30, 100}, {70, 100}}, false, CreaseUse::valley, 180.0},
                                        {{{30, 80}, {70, 80}}, false, CreaseUse::mountain, 180.0},
                                        {rectangle(40, 110, 60, 140), true, CreaseUse::cut}}));
    ASSERT_EQ(card.plates.size(), 4U);
    for (int deg = 0; deg <= 180; deg += 5) {
        EXPECT_LT(torn(card, deg), 1e-9) << deg;
        const std::vector<Frame> frames = frames_at(card, deg);
        for (const Line& line : card.lines) {
            // It is a parallelogram: all four folds turn alike.
            if (line.kind != LineKind::cut) {
                EXPECT_NEAR(std::abs(bend(card, frames, line)), 180.0 - deg, 1e-8);
            }
        }
    }
    double paper = 0.0;
    for (const Plate& plate : card.plates) paper += area(plate.outline);
    EXPECT_NEAR(paper, 100.0 * 160.0 - 20.0 * 30.0, 1e-6);
    EXPECT_TRUE(card.sweep.closed_flat);
}

// Programs for origami write the edge of the paper as lines that are not folded, and two sheets side by side.
TEST(FoldSheet, EndsAtFlatLinesWhereNothingIsCut) {
    CreasePattern pattern;
    for (const double x : {0.0, 200.0}) {
        const Ring ring = rectangle(x, 0, x + 100, 60);
        for (std::size_t i = 0; i < 4; ++i)
            pattern.lines.push_back({{ring[i], ring[(i + 1) % 4]}, false, CreaseUse::flat});
        pattern.lines.push_back({{{x + 50, 0}, {x + 50, 60}}, false, CreaseUse::valley});
        // Within the paper a flat line is nothing.
        pattern.lines.push_back({{{x, 0}, {x + 50, 60}}, false, CreaseUse::flat});
    }
    Diagnostics diagnostics("flat");
    const Assembly made = folded(pattern, diagnostics);
    EXPECT_EQ(made.pieces.size(), 2U);
    ASSERT_EQ(made.plates.size(), 4U);
    for (const Plate& plate : made.plates) EXPECT_NEAR(area(plate.outline), 50.0 * 60.0, 1e-6);
    ASSERT_EQ(diagnostics.sorted().size(), 1U) << test::findings(diagnostics);
    EXPECT_EQ(diagnostics.sorted()[0].message,
              "the pattern has no border; 8 flat lines at its outside were taken for it");
}

// A corner of a waterbomb closes where its folds go to 180°, and nobody has said that they do not.
TEST(FoldSheet, TellsHowFoldsOfOrigamiAreSaidToGo) {
    CreasePattern pattern = sheet({{rectangle(0, 0, 100, 100), true, CreaseUse::cut},
                                   {{{0, 50}, {100, 50}}, false, CreaseUse::mountain},
                                   {{{0, 0}, {100, 100}}, false, CreaseUse::valley},
                                   {{{0, 100}, {100, 0}}, false, CreaseUse::valley}});
    const auto hint_of = [&pattern] {
        Diagnostics diagnostics("waterbomb");
        folded(pattern, diagnostics);
        for (const Diagnostic& one : diagnostics.sorted()) {
            if (one.code == "other-angle") return one.hints.front();
        }
        return std::string("none");
    };
    EXPECT_NE(hint_of().find("--fold-angle 180"), std::string::npos) << hint_of();
    for (CreaseLine& line : pattern.lines) line.fold_deg = 80.0;
    EXPECT_EQ(hint_of().find("--fold-angle 180"), std::string::npos) << hint_of();
    pattern.fold_deg = 180.0;
    for (CreaseLine& line : pattern.lines) line.fold_deg.reset();
    EXPECT_EQ(hint_of(), "none");
}

TEST(FoldSheet, MendsWhatIsNotClean) {
    const auto told = [](std::vector<CreaseLine> lines) {
        Diagnostics diagnostics("untidy");
        fold_sheet(sheet(std::move(lines)), {}, diagnostics);
        return test::findings(diagnostics);
    };
    const CreaseLine border{rectangle(0, 0, 100, 60), true, CreaseUse::cut};
    // An end that stops short of the border by 0.3 mm.
    const std::string moved = told({border, {{{50, 0}, {50, 59.7}}, false, CreaseUse::valley}});
    EXPECT_NE(moved.find("end-moved"), std::string::npos) << moved;
    const std::string dangling = told({border, {{{50, 0}, {50, 40}}, false, CreaseUse::valley}});
    EXPECT_NE(dangling.find("dangling-fold"), std::string::npos) << dangling;
    const std::string twice = told({border,
                                    {{{50, 0}, {50, 60}}, false, CreaseUse::valley},
                                    {{{50, 0}, {50, 60}}, false, CreaseUse::mountain}});
    EXPECT_NE(twice.find("fold-drawn-twice"), std::string::npos) << twice;
    const std::string open = told({{{{0, 0}, {100, 0}, {100, 60}}, false, CreaseUse::cut},
                                   {{{100, 60}, {0, 60}}, false, CreaseUse::cut},
                                   {{{0, 60}, {0, 0}}, false, CreaseUse::valley},
                                   {{{50, 0}, {50, 60}}, false, CreaseUse::valley}});
    EXPECT_NE(open.find("no-border"), std::string::npos) << open;
    const std::string falling = told({border,
                                      {rectangle(20, 20, 60, 40), true, CreaseUse::cut},
                                      {{{40, 20}, {40, 40}}, false, CreaseUse::valley}});
    EXPECT_NE(falling.find("falls-out"), std::string::npos) << falling;
    const std::string nothing = told({{{{0, 0}, {100, 0}}, false, CreaseUse::valley}});
    EXPECT_NE(nothing.find("no-sheet"), std::string::npos) << nothing;
    // Cuts that enclose nothing are a border with a gap.
    const std::string gap = told({{{{0, 0}, {100, 0}, {100, 60}, {0, 60}}, false, CreaseUse::cut},
                                  {{{50, 20}, {50, 40}}, false, CreaseUse::valley}});
    EXPECT_NE(gap.find("no-sheet"), std::string::npos) << gap;
}

TEST(FoldSheet, GivesFoldsAloneABorder) {
    CreasePattern pattern;
    pattern.lines.push_back({{{0, 20}, {100, 20}}, false, CreaseUse::valley});
    pattern.lines.push_back({{{50, 0}, {50, 60}}, false, CreaseUse::flat});
    pattern.lines.push_back({{{0, 0}, {100, 0}}, false, CreaseUse::valley});
    pattern.lines.push_back({{{0, 60}, {100, 60}}, false, CreaseUse::mountain});
    Diagnostics diagnostics("sheet");
    const auto sheet = fold_sheet(pattern, {}, diagnostics);
    const std::string found = test::findings(diagnostics);
    ASSERT_TRUE(sheet) << found;
    EXPECT_EQ(sheet->plates.size(), 2U) << found;
    EXPECT_NE(found.find("the pattern has no border; the rectangle around its folds was taken for it, from "
                         "(0.00, 0.00) mm to (100.00, 60.00) mm"),
              std::string::npos)
        << found;
    double paper = 0.0;
    for (const Plate& plate : sheet->plates) paper += area(plate.outline);
    EXPECT_NEAR(paper, 6000.0, 1e-9);
}

TEST(FoldSheet, TakesAnglesFromOptions) {
    CreasePattern pattern = sheet({{rectangle(0, 0, 90, 50), true, CreaseUse::cut},
                                   {{{30, 0}, {30, 50}}, false, CreaseUse::valley, 120.0, {}, "#0000ff"},
                                   {{{60, 0}, {60, 50}}, false, CreaseUse::mountain, {}, {}, "#ff0000"}});
    const auto angles = [&](FoldOptions options) {
        const Assembly assembly = folded(pattern, options);
        const std::vector<Frame> frames = frames_at(assembly, assembly.sweep.from_deg);
        std::vector<double> found;
        for (const Line& line : assembly.lines) {
            if (line.kind != LineKind::cut) found.push_back(bend(assembly, frames, line));
        }
        return found;
    };
    const auto expect = [](const std::vector<double>& found, double valley, double mountain) {
        ASSERT_EQ(found.size(), 2U);
        EXPECT_NEAR(found[0], valley, 1e-9);
        EXPECT_NEAR(found[1], mountain, 1e-9);
    };
    FoldOptions options;
    expect(angles(options), 120.0, -90.0);
    options.fold_angles = {{"", Angle::degrees(60.0)}, {"#ff0000", Angle::degrees(30.0)}};
    expect(angles(options), 60.0, -30.0);
    options.fold_angles = {{"valley", Angle::degrees(20.0)}};
    options.to = 0.5;
    expect(angles(options), 10.0, -45.0);
}

}  // namespace
}  // namespace popup
