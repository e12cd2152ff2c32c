// Guarantees of check and repair: every constraint holds afterwards, every change is said, and a repaired
// design needs no repair.
#include "popup/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "mechanism/builder.h"
#include "support/designs.h"

namespace popup::test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

std::set<std::string> codes(const Diagnostics& diagnostics) {
    std::set<std::string> found;
    for (const Diagnostic& d : diagnostics.sorted()) found.insert(d.code);
    return found;
}

using Codes = std::set<std::string>;

struct Checked {
    std::optional<CheckedDesign> design;
    Diagnostics diagnostics;
    [[nodiscard]] Vec2 point(std::size_t structure, std::size_t i) const {
        return design->design().structures[structure].points[i].at;
    }
};
Checked run(const Design& design, const CheckOptions& options = {}) {
    Checked result;
    result.design = check(design, options, result.diagnostics);
    return result;
}

// The design repaired, looked at again: nothing to say, and nothing written differently.
void expect_settled(const Checked& first) {
    ASSERT_TRUE(first.design) << findings(first.diagnostics);
    Design again = first.design->design();
    for (Structure& structure : again.structures) {
        for (DesignPoint& point : structure.points) {
            if (point.changed)
                point.at = {std::round(point.at.x * 1e5) / 1e5,
                            std::round(point.at.y * 1e5) / 1e5};  // as written
            point.changed = false;
        }
    }
    const Checked second = run(again);
    ASSERT_TRUE(second.design) << findings(second.diagnostics);
    EXPECT_FALSE(second.diagnostics.has_findings()) << findings(second.diagnostics) << "after\n"
                                                    << findings(first.diagnostics);
    for (const Structure& structure : second.design->design().structures) {
        for (const DesignPoint& point : structure.points) EXPECT_FALSE(point.changed);
    }
}

std::vector<Vec2> v_fold(double a, double b, double sum, double seam = 60.0) {
    const Vec2 e{0, -40};
    const Vec2 g = e + rotated({0, seam}, 0.5 * sum * kDeg);
    const Vec2 h = e + rotated({0, seam}, -0.5 * sum * kDeg);
    return {rotated({0, seam}, a * kDeg),
            {0, 0},
            rotated({0, seam}, -b * kDeg),
            g,
            e,
            h,
            h + Vec2{0, 60},
            g + Vec2{0, 60}};
}
const std::vector<Vec2> kTent{{-30, -30}, {-30, 30}, {40, -30}, {40, 30},
                              {-50, -30}, {-50, 30}, {60, -30}, {60, 30}};
const std::vector<Vec2> kStep{{-40, -30}, {-40, 30}, {40, -30}, {40, 30}};

Checked one(const std::string& type, const std::vector<Vec2>& points) {
    Design design = card();
    add(design, type, points);
    return run(design);
}

TEST(Check, DeviationsWithinRoundingAreMendedWithoutAWord) {
    Design design = card();
    add(design, "step", {{-40.015, -30}, {-39.985, 30}, {40, -30}, {40.01, 30}});
    const Checked result = run(design);
    ASSERT_TRUE(result.design);
    EXPECT_EQ(findings(result.diagnostics), "");
    EXPECT_EQ(result.point(0, 0), (Vec2{-40.015, -30})) << "the author's number stands";
    const Segment fold = result.design->skeleton().folds[1].on_left;
    EXPECT_EQ(fold.a.x, fold.b.x) << "and the fold is exactly parallel";
}

TEST(Check, StepFoldIsTurnedAboutItsMidpoint) {
    const Checked result = one("step", {{-42, -30}, {-38, 30}, {40, -30}, {40, 30}});
    EXPECT_EQ(codes(result.diagnostics), Codes{"not-parallel"});
    const Vec2 a = result.point(0, 0);
    const Vec2 b = result.point(0, 1);
    EXPECT_NEAR(a.x, -40, 1e-9);
    EXPECT_NEAR(b.x, -40, 1e-9);
    EXPECT_NEAR(distance(a, b), std::hypot(4, 60), 1e-9) << "its length is kept";
    EXPECT_NEAR(0.5 * (a.y + b.y), 0, 1e-9);
    expect_settled(result);
}

TEST(Check, EveryRepairNamesPlaceBeforeAndAfter) {
    const Checked result = one("step", {{-42, -30}, {-38, 30}, {40, -30}, {40, 30}});
    const auto repairs = result.diagnostics.repairs();
    ASSERT_EQ(repairs.size(), 1u);
    EXPECT_EQ(repairs[0].element, "e1");
    EXPECT_EQ(repairs[0].place.line, 1);
    EXPECT_EQ(repairs[0].change->before, "A (-42, -30) B (-38, 30)");
    EXPECT_EQ(repairs[0].change->after, "A (-40, -30.0666) B (-40, 30.0666)");
}

TEST(Check, BeakApexIsProjectedOntoTheFold) {
    const Checked result = one("beak", {{2, 40}, {-40, 0}, {40, 0}});
    EXPECT_EQ(codes(result.diagnostics), Codes{"apex-off-fold"});
    EXPECT_LT(distance(result.point(0, 0), Vec2{0, 40}), 1e-9);
    expect_settled(result);
}

TEST(Check, BeakOpensByAtMost175Degrees) {
    const Checked result = one("beak", {{0, 0}, {-40, -0.5}, {40, -0.5}});
    EXPECT_EQ(codes(result.diagnostics), Codes{"opening-too-wide"});
    const Vec2 b = result.point(0, 1);
    EXPECT_NEAR(std::atan2(std::abs(b.x), -b.y) / kDeg, 87.5, 1e-9);
    expect_settled(result);
}

TEST(Check, AngledStepSidesMeetHalfwayBetweenTheirCrossings) {
    // Left side meets the fold at y = -20, right side at y = -24.
    const Checked result = one("angled-step", {{-20, 0}, {-40, 20}, {20, -4}, {44, 20}});
    EXPECT_EQ(codes(result.diagnostics), Codes{"sides-do-not-meet"});
    const auto meets = [&](std::size_t i, std::size_t o) {
        const Vec2 p = result.point(0, i);
        const Vec2 q = result.point(0, o);
        return q.y - q.x * (q.y - p.y) / (q.x - p.x);
    };
    EXPECT_NEAR(meets(0, 1), -22, 1e-9);
    EXPECT_NEAR(meets(2, 3), -22, 1e-9);
    EXPECT_EQ(result.point(0, 1), (Vec2{-40, 20})) << "C is kept";
    EXPECT_EQ(result.point(0, 3), (Vec2{44, 20})) << "F is kept";
    expect_settled(result);
}

TEST(Check, AngledStepWithParallelSidesShouldBeAStep) {
    const Checked result = one("angled-step", {{-40, 0}, {-40, 20}, {40, 0}, {40, 20}});
    EXPECT_FALSE(result.design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"should-be-step"});
}

TEST(Check, VFoldSeamsFollowThePage) {
    auto points = v_fold(60, 60, 150);
    points[3] = points[4] + 1.1 * (points[3] - points[4]);
    const Checked result = one("v-fold", points);
    EXPECT_EQ(codes(result.diagnostics), Codes{"seam-length"});
    EXPECT_NEAR(distance(result.point(0, 3), result.point(0, 4)), 60, 1e-9);
    EXPECT_EQ(result.point(0, 0), points[0]) << "the page rules";
    expect_settled(result);
}

TEST(Check, VFoldAnglesAreKeptApart) {
    const Checked narrow = one("v-fold", v_fold(60, 60, 125));
    EXPECT_EQ(codes(narrow.diagnostics), Codes{"piece-too-narrow"});
    expect_settled(narrow);
    const Checked wide = one("v-fold", v_fold(80, 80, 200));
    EXPECT_EQ(codes(wide.diagnostics), Codes{"piece-too-wide"});
    expect_settled(wide);
    const Checked open = one("v-fold", v_fold(86, 86, 180));
    EXPECT_EQ(codes(open.diagnostics), Codes{"opening-too-wide"});
    expect_settled(open);
}

TEST(Check, VFoldThatOpensTheOtherWayIsRenamed) {
    auto points = v_fold(60, 60, 150);
    for (std::size_t i = 0; i < 3; ++i) points[i].y = -points[i].y;
    const Checked result = one("v-fold", points);
    EXPECT_EQ(codes(result.diagnostics), Codes{"wrong-form"});
    EXPECT_EQ(result.design->design().structures[0].type, "inverted-v-fold");
    EXPECT_TRUE(result.design->design().structures[0].type_changed);
    expect_settled(result);
}

TEST(Check, PieceDrawnFromTheBackIsMirroredWithWhatStandsOnIt) {
    Design design = card();
    auto points = v_fold(60, 50, 150);
    for (std::size_t i = 3; i < 8; ++i) points[i].x = -points[i].x;
    add(design, "v-fold", points);
    DrawnLine line;
    line.page = 1;
    line.points.resize(2);
    line.points[0].at = {5, 0};
    line.points[1].at = {9, 0};
    design.lines.push_back(line);
    const Checked result = run(design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"piece-mirrored"});
    EXPECT_EQ(result.design->design().lines[0].points[0].at, (Vec2{-5, 0}));
    expect_settled(result);
}

TEST(Check, TentNarrowerThanItsSeamsIsWidened) {
    auto points = kTent;
    for (const std::size_t i : {4u, 5u}) points[i].x = -30;
    for (const std::size_t i : {6u, 7u}) points[i].x = 30;
    const Checked result = one("tent", points);
    EXPECT_EQ(codes(result.diagnostics), Codes{"tent-too-narrow"});
    EXPECT_NEAR(result.point(0, 6).x - result.point(0, 4).x, 70, 1e-9);
    expect_settled(result);
}

TEST(Check, OneWrongTentSeamEndMovesAlone) {
    auto points = kTent;
    points[5].y += 7;  // H
    const Checked result = one("tent", points);
    EXPECT_EQ(codes(result.diagnostics), Codes{"seam-length"});
    for (const std::size_t i : {4u, 6u, 7u}) EXPECT_EQ(result.point(0, i), points[i]) << i;
    EXPECT_NEAR(result.point(0, 5).y, 30, 1e-9);
    expect_settled(result);
}

// Whose points are mirrored is drawn the other way round: its red plate is on the right now.
TEST(Check, SwappedSidesAreExchangedWithTheirColours) {
    Design design = card();
    Structure& step = add(design, "step", {{40, -30}, {40, 30}, {-30, -30}, {-30, 30}});
    step.argument(0).value = Color{1, 2, 3};
    const Checked result = run(design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"sides-exchanged"});
    EXPECT_EQ(result.point(0, 0), (Vec2{-30, -30}));
    EXPECT_EQ(result.design->skeleton().draft.plates[2].fill, std::nullopt);
    EXPECT_EQ(result.design->skeleton().draft.plates[3].fill, (Color{1, 2, 3})) << "e1/right";
    const Structure& written = result.design->design().structures[0];
    EXPECT_FALSE(written.arguments[0].given());
    EXPECT_EQ(std::get<Color>(written.arguments[1].value), (Color{1, 2, 3}));
    expect_settled(result);
}

// A piece of which only the points on the page are mirrored lies as it did: so do its colours.
TEST(Check, APieceThatIsNotMirroredKeepsItsColours) {
    for (const bool piece_too : {false, true}) {
        Design design = card();
        auto points = v_fold(60, 50, 150);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (i < 3 || piece_too) points[i].x = -points[i].x;
        }
        add(design, "v-fold", points).argument(0).value = Color{1, 2, 3};
        const Checked result = run(design);
        EXPECT_EQ(codes(result.diagnostics), Codes{"sides-exchanged"}) << findings(result.diagnostics);
        ASSERT_TRUE(result.design);
        EXPECT_EQ(result.design->design().structures[0].arguments[piece_too ? 1 : 0].value.index(), 1U);
        expect_settled(result);
    }
}

TEST(Check, GutterGivenDownwardsIsOneRemarkAndNoChange) {
    Design design = card();
    auto points = v_fold(60, 50, 150);
    for (std::size_t i = 0; i < 3; ++i) points[i] = -points[i];  // drawn by an author who sits at the top
    add(design, "v-fold", points, {0, 100}, {0, -100});
    const Checked result = run(design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"fold-turned"});
    ASSERT_TRUE(result.design) << findings(result.diagnostics);
    EXPECT_FALSE(result.diagnostics.has_findings());
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(result.point(0, i), points[i]);
    EXPECT_EQ(result.design->design().structures[0].type, "v-fold");
}

TEST(Check, FormsFollowTheirFold) {
    Design design = card();
    add(design, "step", {{-60, -60}, {-60, 60}, {60, -60}, {60, 60}});
    add(design, "step", {{-20, -30}, {-20, 30}, {20, -30}, {20, 30}});
    const Checked result = run(design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"wrong-form"});
    EXPECT_EQ(result.design->design().structures[1].type, "inverted-step");
    expect_settled(result);
}

TEST(Check, ElementLargerThanItsPlaneIsMadeAsBigAsWillFit) {
    const Checked result = one("step", {{-400, -30}, {-400, 30}, {40, -30}, {40, 30}});
    EXPECT_EQ(codes(result.diagnostics), Codes{"does-not-fit"});
    EXPECT_NEAR(result.point(0, 0).x, -279.4 / 2 + 1, 0.02) << "1 mm of paper is left";
    EXPECT_EQ(result.point(0, 2), (Vec2{40, -30})) << "the right side fits and stays";
    expect_settled(result);
    const Checked high = one("step", {{-40, -300}, {-40, 30}, {40, -300}, {40, 30}});
    EXPECT_EQ(codes(high.diagnostics), Codes{"does-not-fit"});
    expect_settled(high);
    expect_settled(one("v-fold", v_fold(60, 60, 150, 400)));
    auto tent = kTent;
    for (const std::size_t i : {0u, 1u}) tent[i].x = -300;
    for (const std::size_t i : {1u, 3u, 5u, 7u}) tent[i].y = 150;
    expect_settled(one("tent", tent));
    expect_settled(one("beak", {{0, 0}, {-300, 90}, {40, 90}}));
    expect_settled(one("angled-step", {{-20, 0}, {-200, 180}, {20, 0}, {40, 20}}));
}

TEST(Check, FoldIsFoundWithinFiveMillimetresAndOtherwiseNamed) {
    Design design = card();
    add(design, "step", kStep, {3, -100}, {3, 100});
    const Checked near = run(design);
    EXPECT_EQ(codes(near.diagnostics), Codes{"fold-snapped"});
    EXPECT_NEAR(near.design->design().structures[0].fold.begin.at.x, 0, 1e-12);
    expect_settled(near);
    design.structures[0].fold.begin.at.x = design.structures[0].fold.end.at.x = 20;
    const Checked far = run(design);
    EXPECT_FALSE(far.design);
    EXPECT_NE(findings(far.diagnostics).find("the nearest is a fold of \"page\", 20.00 mm away"),
              std::string::npos)
        << findings(far.diagnostics);
}

// What stood on a step that was moved, and still names its old fold, follows as a whole: it is not bent.
TEST(Check, WhatStoodOnAMovedFoldFollowsAsAWhole) {
    for (const Vec2 by : {Vec2{4, 0}, Vec2{10, 0}, Vec2{10, 7}, Vec2{-12, -3}}) {
        Design design = card();
        add(design, "step", {{-30, -20}, {-30, 20}, {30, -20}, {30, 20}});
        add(design, "step", {{-36, -8}, {-36, 8}, {-25, -8}, {-25, 8}}, {-30, -20}, {-30, 20});
        ASSERT_EQ(codes(run(design).diagnostics), Codes{});
        for (DesignPoint& point : design.structures[0].points) point.at = point.at + by;
        const Checked result = run(design);
        EXPECT_EQ(codes(result.diagnostics), Codes{"moved-with-fold"}) << findings(result.diagnostics);
        ASSERT_TRUE(result.design);
        const Structure& child = result.design->design().structures[1];
        for (std::size_t i = 0; i < child.points.size(); ++i)
            EXPECT_LT(distance(child.points[i].at, design.structures[1].points[i].at + by), 1e-9);
        expect_settled(result);
    }
    // Two steps of one length, alike far away: nobody knows which it was.
    Design design = card();
    add(design, "step", {{-30, -20}, {-30, 20}, {30, -20}, {30, 20}});
    add(design, "step", {{-48, -8}, {-48, 8}, {-42, -8}, {-42, 8}}, {-45, -20}, {-45, 20});
    EXPECT_EQ(codes(run(design).diagnostics), Codes{"moved-with-fold"});
    design.structures[1].fold.begin.at.x = design.structures[1].fold.end.at.x = 5.5;
    EXPECT_EQ(codes(run(design).diagnostics), Codes{"fold-not-found"});
}

TEST(Check, AFoldThatIsGoneIsSaidToBeGone) {
    Design design = card();
    add(design, "step", {{-36, -8}, {-36, 8}, {-25, -8}, {-25, 8}}, {-30, -20}, {-30, 20});
    const Checked result = run(design);
    EXPECT_FALSE(result.design);
    EXPECT_EQ(findings(result.diagnostics).substr(0, 58),
              "error fold-not-found: the fold that \"e1\" stood on is gone:")
        << findings(result.diagnostics);
    EXPECT_NE(findings(result.diagnostics)
                  .find("most likely an element on the gutter made it, 30.00 mm from there and "
                        "40.00 mm long"),
              std::string::npos)
        << findings(result.diagnostics);
}

TEST(Check, FoldCutAwayIsAnErrorThatNamesTheCutter) {
    Design design = card();
    add(design, "step",
        {{-40, -30}, {-40, 30}, {20, -30}, {20, 30}});  // its centre fold is not over the gutter
    add(design, "tent", {{-8, -10}, {-8, 10}, {8, -10}, {8, 10}, {-12, -10}, {-12, 10}, {12, -10}, {12, 10}});
    const Checked result = run(design);
    EXPECT_FALSE(result.design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"fold-cut-away"});
    EXPECT_NE(findings(result.diagnostics).find("cut away by \"e1\""), std::string::npos);
}

TEST(Check, OfFoldsOnOneLineTheOneThatIsStillThereCounts) {
    Design design = card();
    add(design, "step", kStep);
    add(design, "inverted-beak", {{0, 20}, {-15, -10}, {15, -10}});
    add(design, "beak", {{0, 80}, {-15, 50}, {15, 50}});
    const Checked result = run(design);
    ASSERT_TRUE(result.design) << findings(result.diagnostics);
    EXPECT_FALSE(result.diagnostics.has_findings()) << findings(result.diagnostics);
    const auto& joints = result.design->skeleton().draft.joints;
    EXPECT_EQ(result.design->skeleton()
                  .draft.plates[static_cast<std::size_t>(std::get<FourBar>(joints[3].how).left.drive)]
                  .name,
              "e1/left");
    EXPECT_EQ(result.design->skeleton()
                  .draft.plates[static_cast<std::size_t>(std::get<FourBar>(joints[4].how).left.drive)]
                  .name,
              "page/left");
}

TEST(Check, NeighboursOnOneLineDoNotTakeEachOthersFolds) {
    Design design = card();
    add(design, "step", {{-40, -30}, {-40, 0}, {40, -30}, {40, 0}});
    add(design, "step", {{-40, 2.5}, {-40, 30}, {40, 2.5}, {40, 30}});
    add(design, "beak", {{0, 32.5}, {-20, 50}, {20, 50}});
    const Checked result = run(design);
    EXPECT_TRUE(result.design);
    EXPECT_EQ(findings(result.diagnostics), "");
}

TEST(Check, ChildrenKeepTheirPlaceOnAFoldThatARepairMoved) {
    Design design = card();
    add(design, "step", {{-44, -30}, {-36, 30}, {40, -30}, {40, 30}});
    // On the tilted side fold as the author drew it: apex halfway, points square to that fold.
    const Vec2 dir = unit(Vec2{8, 60});
    const Vec2 mid{-40, 0};
    add(design, "beak",
        {mid, mid + 12.0 * dir + 10.0 * left_of(dir), mid + 12.0 * dir + 10.0 * right_of(dir)}, {-44, -30},
        {-36, 30});
    const Checked result = run(design);
    EXPECT_EQ(codes(result.diagnostics), (Codes{"not-parallel", "moved-with-fold"}))
        << findings(result.diagnostics);
    ASSERT_TRUE(result.design);
    EXPECT_NEAR(result.point(1, 1).x, -50, 1e-9);
    EXPECT_NEAR(result.point(1, 2).x, -30, 1e-9);
    EXPECT_NEAR(result.point(1, 1).y, result.point(1, 2).y, 1e-9);
    expect_settled(result);
}

TEST(Check, CutElementOnASeamIsAnError) {
    Design design = card();
    add(design, "tent", kTent);
    Structure& step =
        add(design, "step", {{-40, -10}, {-40, 10}, {-40, -10}, {-40, 10}}, {-30, -30}, {-30, 30});
    step.points[2].page = step.points[3].page = 1;
    EXPECT_EQ(codes(run(design).diagnostics), Codes{"cut-on-seam"});
}

TEST(Check, SeamsThatStayFlatCarryNothing) {
    Design design = card();
    auto points = v_fold(60, 60, 150);
    for (std::size_t i = 0; i < 3; ++i) points[i].y = -points[i].y;
    add(design, "inverted-v-fold", points);
    Structure& tent = add(design, "tent", kTent, points[1], points[0]);
    for (const std::size_t i : {2u, 3u}) tent.points[i].page = 1;
    EXPECT_EQ(codes(run(design).diagnostics), Codes{"seam-stays-flat"});
}

TEST(Check, PointsOnASeamMustNameTheirPage) {
    Design design = card();
    add(design, "tent", kTent);
    add(design, "tent", kTent, {-30, -30}, {-30, 30});
    const Checked result = run(design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"wrong-page"});
}

TEST(Check, DegenerateElementsAreErrorsOrDropped) {
    Design design = card();
    add(design, "v-fold", v_fold(60, 60, 150));
    add(design, "tent", {{-0.2, 70}, {-0.2, 90}, {0.2, 70}, {0.2, 90}, {-1, 0}, {-1, 20}, {1, 0}, {1, 20}});
    auto points = v_fold(60, 60, 150, 20);
    for (std::size_t i = 0; i < 3; ++i) points[i] = points[i] + Vec2{0, -90};
    add(design, "v-fold", points);
    add(design, "inverted-step", {{-5, -35}, {-5, -30}, {5, -35}, {5, -30}}, {0, -40}, {0, 0}, 3);
    const Checked strict = run(design);
    EXPECT_EQ(codes(strict.diagnostics), Codes{"degenerate"});
    CheckOptions options;
    options.drop = true;
    const Checked dropped = run(design, options);
    ASSERT_TRUE(dropped.design) << findings(dropped.diagnostics);
    EXPECT_EQ(codes(dropped.diagnostics), Codes{"dropped"}) << findings(dropped.diagnostics);
    EXPECT_TRUE(dropped.design->design().structures[1].dropped);
    EXPECT_EQ(dropped.design->design().structures[3].fold.page, 2) << "pages close up";
}

TEST(Check, WhatStandsOnABrokenElementIsNotComplainedAbout) {
    Design design = card();
    add(design, "step", {{-40, -30}, {-40, 30}, {40, 30}, {40, -30}});  // cuts cross
    add(design, "step", {{-50, -5}, {-50, 5}, {-30, -5}, {-30, 5}}, {-40, -30}, {-40, 30});
    const Checked result = run(design);
    EXPECT_EQ(codes(result.diagnostics), Codes{"points-exchanged"}) << findings(result.diagnostics);
}

TEST(Check, WithoutRepairEveryRepairIsAnError) {
    Design design = card();
    add(design, "step", {{-42, -30}, {-38, 30}, {40, -30}, {40, 30}});
    CheckOptions options;
    options.repair = false;
    const Checked result = run(design, options);
    EXPECT_FALSE(result.design);
    EXPECT_TRUE(result.diagnostics.has_errors());
}

// Shake sound designs: whatever comes out is refused, or repaired so that it needs no repair and moves as it
// must.
TEST(Check, ShakenDesignsAreRefusedOrRepairedForGood) {
    int repaired = 0;
    int refused = 0;
    MotionOptions unexamined;  // shaken elements may well collide
    unexamined.examine = false;
    std::uint64_t state = 12345;
    const auto noise = [&](double size) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return size * (static_cast<double>(state >> 33) * 0x1p-30 - 1.0);
    };
    for (int seed = 1; seed <= 400; ++seed) {
        SCOPED_TRACE(seed);
        Design design = generate(static_cast<std::uint64_t>(seed) + 1000, 8);
        for (Structure& structure : design.structures) {
            for (DesignPoint& point : structure.points) point.at = point.at + Vec2{noise(1.5), noise(1.5)};
        }
        const Checked first = run(design);
        if (!first.design) {
            EXPECT_TRUE(first.diagnostics.has_errors());
            ++refused;
            continue;
        }
        ++repaired;
        expect_settled(first);
        Diagnostics diagnostics;
        const auto assembly = assemble(*first.design, {}, diagnostics);
        ASSERT_TRUE(assembly) << findings(diagnostics);
        EXPECT_TRUE(simulate(*assembly, unexamined, diagnostics)) << findings(diagnostics);
    }
    EXPECT_GT(repaired, 20);
    RecordProperty("repaired", repaired);
    RecordProperty("refused", refused);
}

}  // namespace
}  // namespace popup::test
