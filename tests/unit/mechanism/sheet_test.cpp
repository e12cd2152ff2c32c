// Guarantees of what is cut from one sheet: where its folds lie, that its plates share the paper out, that it
// closes flat and stays closed, that curves stay curves, and what is said of outlines that cannot be cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>

#include "input/xml/read.h"
#include "mechanism/border.h"
#include "mechanism/catmull_rom.h"
#include "output/xml.h"
#include "popup/check.h"
#include "popup/motion.h"
#include "popup/path.h"
#include "sheet_features.h"
#include "support/designs.h"
#include "support/freeform_sheet.h"

namespace popup::test {
namespace {

// --- side folds and centre folds

TEST(Sheet, ABoxFoldIsAStepBetweenTwoCorners) {
    const FromXml made = from_xml(box(-20, -10, 30, 25, "b"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    const FromXml step = from_xml(
        "<structure type='step' id='b'><point x='-20' y='-10'/><point x='-20' y='25'/><point x='30' "
        "y='-10'/><point x='30' y='25'/><parentfold><begin x='0' y='-75'/><end x='0' y='75'/></parentfold>"
        "</structure>");
    ASSERT_TRUE(step.assembly);
    ASSERT_EQ(made.assembly->plates.size(), step.assembly->plates.size());
    for (std::size_t i = 0; i < step.assembly->plates.size(); ++i)
        EXPECT_EQ(made.assembly->plates[i].outline.outer, step.assembly->plates[i].outline.outer);
    // Whichever corners are given, in whichever order.
    EXPECT_EQ(from_xml(box(30, -10, -20, 25, "b")).assembly->plates[2].outline.outer,
              made.assembly->plates[2].outline.outer);
}

// A circle of 20 mm about a point 5 mm left of the fold: 2 mm of a line lie in it at sqrt(20² - 1).
TEST(Sheet, ACircleIsTruncatedWhereItIsTwoMillimetresWide) {
    const FromXml made = from_xml(freeform("M 15 0 A 20 20 0 0 1 -25 0 A 20 20 0 0 1 15 0 Z"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    const double reach = std::sqrt(399.0);
    std::vector<double> at;
    for (const Hinge& hinge : made.assembly->hinges) at.push_back(hinge.a_line.a.x);
    ASSERT_EQ(at.size(), 4U);
    EXPECT_NEAR(at[1], -5.0 - reach, 0.03);
    EXPECT_NEAR(at[3], -5.0 + reach, 0.03);
    // q from the left one.
    EXPECT_NEAR(at[2], at[1] + at[3], 1e-9);
    EXPECT_NEAR(distance(made.assembly->hinges[1].a_line.a, made.assembly->hinges[1].a_line.b), 2.0, 0.3);
}

// All ends of folds lie on the curve: as near to it as a search of my own comes.
TEST(Sheet, FoldsMeetTheCurveItself) {
    const std::string d =
        "M 30 -40 C 40 -10 10 5 25 40 C 10 60 -20 20 -40 35 C -60 10 -30 -10 -45 -30 C -20 "
        "-60 10 -20 30 -40 Z";
    const FromXml made = from_xml(freeform(d, "<folds top='30' bottom='20'/>"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    Path path;
    ASSERT_FALSE(parse_path(d, path));
    std::vector<Cubic> cubics;
    Vec2 at = path.subpaths()[0].start;
    for (const PathStep& step : path.subpaths()[0].steps) {
        if (step.curve) cubics.push_back({at, step.control_1, step.control_2, step.to});
        at = step.to;
    }
    const auto off = [&](Vec2 p) {
        double best = HUGE_VAL;
        for (const Cubic& cubic : cubics) {
            for (int i = 0; i < 400; ++i) {
                double lo = i / 400.0;
                double hi = (i + 1) / 400.0;
                for (int k = 0; k < 60; ++k) {
                    const double a = lo + (hi - lo) / 3.0;
                    const double b = hi - (hi - lo) / 3.0;
                    (distance(cubic.at(a), p) < distance(cubic.at(b), p) ? hi : lo) =
                        distance(cubic.at(a), p) < distance(cubic.at(b), p) ? b : a;
                }
                best = std::min(best, distance(cubic.at(0.5 * (lo + hi)), p));
            }
        }
        return best;
    };
    std::size_t ends = 0;
    for (const Hinge& hinge : made.assembly->hinges) {
        if (hinge.a == 0 && hinge.b == 1) continue;  // the gutter
        for (const Vec2 p : {hinge.a_line.a, hinge.a_line.b}) {
            EXPECT_LT(off(p), 1e-6);
            ++ends;
        }
    }
    EXPECT_GE(ends, 6U);
}

TEST(Sheet, FarEdgesAlongTheFoldAreItsSideFolds) {
    const FromXml made = from_xml(
        "<structure type='polygon' id='p'><outline d='M 20 -10 L 20 25 L -5 30 L -40 18 L -40 -2 "
        "Z'/></structure>");
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_EQ(made.assembly->hinges[1].a_line, (Segment{{-40, -2}, {-40, 18}}));
    EXPECT_EQ(made.assembly->hinges[3].a_line, (Segment{{20, -10}, {20, 25}}));
    EXPECT_NEAR(made.assembly->hinges[2].a_line.a.x, -20.0, 1e-9);
}

TEST(Sheet, SideFoldsMayBeGiven) {
    const std::string d = "M 30 -20 L 30 20 L 0 40 L -50 0 L 0 -40 Z";
    const FromXml made = from_xml(freeform(d, "<folds top='35' bottom='10'/>"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_NEAR(made.assembly->hinges[1].a_line.a.x, -35.0, 1e-9);
    EXPECT_NEAR(made.assembly->hinges[2].a_line.a.x, -25.0, 1e-9);
    EXPECT_NEAR(made.assembly->hinges[3].a_line.a.x, 10.0, 1e-9);
    EXPECT_EQ(from_xml(freeform(d, "<folds top='60'/>")).text,
              "error outline-off-fold: \"f\": its top fold is to lie 60.00 mm from the fold, and the outline "
              "reaches only 50.00 mm out there\n");
}

// Two towers that are equally high: one roof hangs on the fold with each, and they move as one.
TEST(Sheet, TowersOfOneHeightHangOnOneFoldEach) {
    const FromXml made =
        from_xml(freeform("M 15 -30 L 15 30 L -50 30 L -50 12 L -10 12 L -10 -12 L -50 -12 L "
                          "-50 -30 Z"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_EQ(made.assembly->plates.size(), 5U);
    const std::size_t more = made.plate("f/left-2");
    std::vector<Frame> frames(made.assembly->plates.size());
    for (const double deg : {0.0, 37.0, 90.0, 155.0, 180.0}) {
        ASSERT_TRUE(place(*made.assembly, Angle::degrees(deg), frames));
        const Frame& one = frames[made.plate("f/left")];
        for (const Vec2 p : {Vec2{0, 0}, {50, 0}, {0, 50}})
            EXPECT_LT(distance(one.point(p), frames[more].point(p)), 1e-12);
    }
}

// A lower tower beside them hangs on nothing: it stays level with the wall, over the line of the centre fold.
TEST(Sheet, WhatHangsOnNoSideFoldStaysLevel) {
    const FromXml made =
        from_xml(freeform("M 15 -30 L 15 30 L -45 30 L -45 10 L -20 10 L -20 -10 L -60 -10 L -60 -30 Z"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_EQ(made.assembly->plates.size(), 4U);
    // The roof is 15 mm deep and as wide as the tower on the fold: the other's top is part of the wall.
    const Polygon& roof = made.assembly->plates[made.plate("f/left")].outline;
    EXPECT_NEAR(area(roof), 15.0 * 20.0, 1e-6);
}

// Edges that lie in the line of the centre fold, from above and from below, and corners that touch it.
TEST(Sheet, EdgesInTheLineOfTheCentreFoldAreNoFolds) {
    // p 40, q 10: the centre fold lies at x = -30.
    for (const std::string d : {
             "M 10 -20 L 10 20 L -30 20 L -30 40 L -40 40 L -40 -40 L -30 -40 L -30 -20 Z",  // a T
             "M 10 -40 L 10 40 L -30 40 L -30 10 L -40 10 L -40 -10 L -30 -10 L -30 -40 Z",  // shoulders
             "M 10 -30 L 10 30 L -40 30 L -40 10 L -30 0 L -40 -10 L -40 -30 Z",  // a notch touches
             "M 10 -30 L 10 30 L -35 30 L -30 20 L -40 15 L -40 -15 L -30 -20 L -35 -30 Z",
         }) {
        SCOPED_TRACE(d);
        const FromXml made = from_xml(freeform(d));
        EXPECT_EQ(made.text, "");
        expect_sound(made);
        for (const Hinge& hinge : made.assembly->hinges) {
            const Vec2 middle = 0.5 * (hinge.a_line.a + hinge.a_line.b);
            if (std::abs(middle.x + 30.0) > 1e-9) continue;
            // There is paper on both sides of it.
            for (const double aside : {-0.01, 0.01}) {
                const auto on = [&](const Plate& plate) {
                    return plate.name.starts_with("f/") && contains(plate.outline, middle + Vec2{aside, 0});
                };
                EXPECT_TRUE(std::any_of(made.assembly->plates.begin(), made.assembly->plates.end(), on));
            }
        }
    }
}

TEST(Sheet, AVFoldCutFoldsAsABeakDoes) {
    const FromXml made = from_xml(
        "<structure type='v-fold-cut' id='b'><point x='0' y='-20'/><outline d='M -30 5 L 20 "
        "12'/></structure>");
    // A straight cut encloses nothing: that is a beak.
    EXPECT_NE(made.text.find("bad-path"), std::string::npos) << made.text;
    const FromXml bent = from_xml(
        "<structure type='v-fold-cut' id='b'><point x='0' y='-20'/><outline d='M -30 5 "
        "L 0 9.2 L 20 12.001'/></structure>");
    const FromXml beak = from_xml(
        "<structure type='beak' id='b'><point x='0' y='-20'/><point x='-30' y='5'/><point x='20' y='12.001'/>"
        "<parentfold><begin x='0' y='-75'/><end x='0' y='75'/></parentfold></structure>");
    EXPECT_EQ(bent.text, "");
    expect_sound(bent);
    ASSERT_TRUE(beak.assembly) << beak.text;
    for (std::size_t i = 1; i < 4; ++i) {
        const Segment a = bent.assembly->hinges[i].a_line;
        const Segment b = beak.assembly->hinges[i].a_line;
        EXPECT_LT(distance(a.a, b.a) + distance(a.b, b.b), 1e-3) << i;
    }
}

TEST(Sheet, ALeafFoldsWhereItLeavesItsApex) {
    const FromXml made = from_xml(
        "<structure type='v-fold-cut' id='leaf'><point x='0' y='-40'/><outline d='M 0 "
        "-40 C -40 -20 -40 20 0 40 C 30 20 30 -20 0 -40 Z'/></structure>");
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_NEAR(distance(made.assembly->hinges[1].a_line.a, made.assembly->hinges[1].a_line.b), 2.0, 0.3);
    EXPECT_EQ(
        from_xml("<structure type='v-fold-cut' id='leaf'><point x='0' y='-60'/><outline d='M 0 -40 C -40 "
                 "-20 -40 20 0 40 C 30 20 30 -20 0 -40 Z'/></structure>")
            .text,
        "error outline-off-fold: \"leaf\": its outline does not go through A\n");
}

// --- the fold that is meant

TEST(Sheet, StandsOnTheFoldThatItsOutlineCrosses) {
    // In turn on the gutter, on the box's right fold, and on that one's centre fold.
    const FromXml made =
        from_xml(box(-40, -40, 40, 40, "a") + box(30, -20, 50, 20, "b") + box(36, -10, 44, 10, "c"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_EQ(made.assembly->plates.size(), 8U);
}

TEST(Sheet, NamesTheFoldsOfAnOutlineThatCrossesNoneOrSeveral) {
    EXPECT_EQ(
        from_xml(freeform("M -60 -10 h 30 v 20 h -30 Z")).text,
        "error no-fold-crossed: the outline of \"f\" crosses no fold on page 0 exactly twice; the nearest "
        "to its middle is the gutter, 45.00 mm away\n");
    EXPECT_EQ(
        from_xml(box(-20, -40, 10, 0, "a") + freeform("M -40 -30 h 37 v 20 h -37 Z")).text,
        "error folds-crossed: the outline of \"f\" crosses 2 folds twice: the centre fold of \"a\" and the "
        "left fold of \"a\"\n");
    const FromXml named =
        from_xml(box(-20, -40, 30, 0, "a") +
                 freeform("M -30 -30 h 28 v 20 h -28 Z",
                          "<parentfold><begin x='-20' y='-40'/><end x='-20' y='0'/></parentfold>"));
    EXPECT_EQ(named.text, "");
    expect_sound(named);
    const std::string wave = "M 20 -20 L -20 -20 L -20 -10 L 10 -10 L 10 0 L -20 0 L -20 10 L 20 10 Z";
    EXPECT_EQ(
        from_xml(freeform(wave)).text,
        "error no-fold-crossed: the outline of \"f\" crosses no fold on page 0 exactly twice; it crosses the "
        "gutter 4 times\n");
    EXPECT_EQ(
        from_xml(freeform(wave, "<parentfold><begin x='0' y='0'/><end x='0' y='9'/></parentfold>")).text,
        "error outline-off-fold: \"f\": its outline crosses the line of its parent fold 4 times; it must "
        "cross it twice\n");
}

TEST(Sheet, AFoldIsSplitWhereAFeatureIsAndWholeWithoutIt) {
    const auto gutter = [](const FromXml& made) {
        double sum = 0.0;
        for (const Line& line : made.assembly->lines) {
            if (line.kind == LineKind::valley && line.plate == 0 && line.other_plate == 1)
                sum += distance(line.at.a, line.at.b);
        }
        return sum;
    };
    EXPECT_NEAR(gutter(from_xml("")), 150.0, 1e-9);
    EXPECT_NEAR(gutter(from_xml(box(-20, -10, 20, 30, "a"))), 110.0, 1e-9);
    EXPECT_NEAR(gutter(from_xml(box(-20, -10, 20, 30, "a") + freeform("M 10 -50 h -20 v 20 h 20 Z"))), 90.0,
                1e-9);
    EXPECT_NEAR(gutter(from_xml(freeform("M 10 -50 h -20 v 20 h 20 Z"))), 130.0, 1e-9);
}

TEST(Sheet, FeaturesStandOnFeaturesToAnyDepth) {
    // Each on the right fold of the one before, half as large.
    std::string structures;
    double at = 0.0;
    double size = 30.0;
    double half = 60.0;
    constexpr int kDepth = 8;
    for (int i = 0; i < kDepth; ++i) {
        const std::string id = "e" + std::to_string(i + 1);
        if (i % 2 == 0) {
            structures += box(at - size, -half, at + size, half, id);
        } else {
            const auto n = [](double v) { return std::to_string(v); };
            structures += freeform("M " + n(at - size) + " " + n(-half) + " C " + n(at - 0.3 * size) + " " +
                                       n(-half - 1.0) + " " + n(at + 0.3 * size) + " " + n(-half - 1.0) +
                                       " " + n(at + size) + " " + n(-half) + " L " + n(at + size) + " " +
                                       n(half) + " L " + n(at - size) + " " + n(half) + " Z",
                                   "", id);
        }
        at += size;
        size = std::min(0.68 * size, size - 1.1);
        half -= 4.0;
    }
    const FromXml made = from_xml(structures);
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_EQ(made.assembly->plates.size(), 2U + 2U * kDepth);
}

// --- outlines that cross themselves

TEST(Sheet, OfAnOutlineThatCrossesItselfTheLargerLoopIsKept) {
    // A square of 1600 mm², and below it two triangles of 100 mm² each.
    const FromXml made =
        from_xml(freeform("M 20 20 L -20 20 L -20 -20 L 10 -20 L -10 -40 L 10 -40 L -10 -20 L 20 -20 Z"));
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(
        made.text,
        "warning outline-crosses: \"f\": its outline crosses or touches itself at (-10.00, -20.00) mm; the "
        "smaller loop, of 200.00 mm², is no part of it now [an outline of 8 edges with 1 loop -> an outline "
        "that "
        "encloses 1600.00 mm²]\n");
    expect_sound(made);
    double own = 0.0;
    for (const Plate& plate : made.assembly->plates)
        own += plate.name.starts_with("f/") ? area(plate.outline) : 0.0;
    EXPECT_NEAR(own, 1600.0, 1e-6);
}

TEST(Sheet, LoopsOfCurvesAreLeftOutWhereTheCurvesCross) {
    // One cubic with a loop: x = 0 at its crossing, by symmetry.
    Path path;
    ASSERT_FALSE(parse_path("M -10 0 C 40 30 -40 30 10 0 L 10 -20 L -10 -20 Z", path));
    Border border;
    ASSERT_EQ(border_of(path.subpaths()[0], border), FlatteningFault::none);
    const LoopRepair repair = without_loops(border);
    ASSERT_EQ(repair.dropped.size(), 1U);
    EXPECT_NEAR(repair.dropped[0].at.x, 0.0, 1e-9);
    // There the curve's x is nought twice: t = 1/2 ± sqrt(...), where y is what the cubic has.
    const Cubic cubic{{-10, 0}, {40, 30}, {-40, 30}, {10, 0}};
    double lo = 0.0;
    double hi = 0.4;
    for (int i = 0; i < 80; ++i) (cubic.at(0.5 * (lo + hi)).x > 0.0 ? hi : lo) = 0.5 * (lo + hi);
    EXPECT_NEAR(repair.dropped[0].at.y, cubic.at(lo).y, 1e-6);
    EXPECT_EQ(curves_of({&border, 1}).size(), 1U);
    // Written and read again it has nothing to mend.
    const Path mended = path_of(border);
    Border again;
    ASSERT_EQ(border_of(mended.subpaths()[0], again), FlatteningFault::none);
    EXPECT_TRUE(without_loops(again).dropped.empty());
}

TEST(Sheet, TouchesAndDoubledStretchesAreLoops) {
    const auto left = [](const std::string& d) {
        Path path;
        EXPECT_FALSE(parse_path(d, path));
        Border border;
        EXPECT_EQ(border_of(path.subpaths()[0], border), FlatteningFault::none);
        const LoopRepair repair = without_loops(border);
        EXPECT_FALSE(repair.hopeless);
        return std::abs(signed_area(ring_of(border)));
    };
    // A spike; a bridge that is gone along twice; two squares that touch in a corner, and along an edge.
    EXPECT_NEAR(left("M 0 0 h 20 v 10 h 10 h -10 v 10 h -20 Z"), 400.0, 1e-9);
    EXPECT_NEAR(left("M 0 0 h 20 v 10 h 10 v -5 h 5 v 5 h -15 v 10 h -20 Z"), 400.0, 1e-9);
    EXPECT_NEAR(left("M 0 0 h 20 v 20 h 10 v 10 h -10 v -10 h -20 Z"), 400.0, 1e-9);
    EXPECT_NEAR(left("M 0 0 h 20 v 20 h -20 Z"), 400.0, 1e-9);
    // A curve that touches a line from inside.
    EXPECT_NEAR(left("M 0 0 L 40 0 L 40 30 C 30 -10 10 -10 0 30 Z"), 40.0 * 30.0 - 40.0 * 30.0, 801.0);
}

TEST(Sheet, RefusesWhatIsLeftOfScribble) {
    EXPECT_EQ(
        from_xml(freeform("M 1 0 L -1 0 L 1 1 L -1 1 Z")).text,
        "error outline-crosses: \"f\": its outline encloses 0.50 mm² without its loops, and 4 mm² are the "
        "least\n");
}

TEST(Sheet, ARepairedOutlineNeedsNoOther) {
    const std::string document =
        "<popup version='3.0' units='mm'><mainpage width='200' height='150'/><structurelist>" +
        freeform("M 20 20 C -60 60 -60 -60 20 -20 L 30 -30 C 35 -35 25 -35 20 -30 L 30 -20 L 20 -10 Z") +
        "<structure type='freeform' id='touched'><touchpoints><point x='-40' y='-60'/><point x='20' y='-60'/>"
        "<point x='30' y='-40'/><point x='40' y='-40'/><point x='40' y='-44'/><point x='20' y='-42'/>"
        "<point x='-40' y='-40'/></touchpoints></structure>"
        "</structurelist></popup>";
    Diagnostics first;
    const Source source{"card.xml", document};
    const auto design = xml::read(source, {}, first);
    ASSERT_TRUE(design) << findings(first);
    const auto checked = check(*design, {}, first);
    ASSERT_TRUE(checked) << findings(first);
    EXPECT_TRUE(first.has_findings());
    for (const std::string& text :
         {xml::patch(source, checked->design()), write_document(checked->design())}) {
        Diagnostics second;
        const auto again = xml::read({"card.xml", text}, {}, second);
        ASSERT_TRUE(again) << findings(second) << text;
        EXPECT_TRUE(check(*again, {}, second));
        EXPECT_EQ(findings(second), "") << text;
    }
}

// --- touch points

// The curve goes through the points, and its tangents are those of the formula with chordal parameters.
TEST(Sheet, TouchPointsBecomeAClosedCatmullRomCurve) {
    const Ring points{{0, 0}, {30, 5}, {34, 20}, {10, 33}, {-9, 14}};
    const auto path = catmull_rom(points);
    ASSERT_TRUE(path);
    const Subpath& line = path->subpaths().at(0);
    ASSERT_EQ(line.steps.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t n = points.size();
        const Vec2 before = points[(i + n - 1) % n];
        const Vec2 from = points[i];
        const Vec2 to = points[(i + 1) % n];
        EXPECT_EQ(line.steps[i].to, to);
        const double a = distance(before, from);
        const double b = distance(from, to);
        const Vec2 tangent =
            (1.0 / a) * (from - before) - (1.0 / (a + b)) * (to - before) + (1.0 / b) * (to - from);
        EXPECT_LT(distance(line.steps[i].control_1, from + (b / 3.0) * tangent), 1e-12);
        const Vec2 start = i == 0 ? line.start : line.steps[i - 1].to;
        const Vec2 incoming = line.steps[(i + n - 1) % n].control_2;
        EXPECT_LT(distance(incoming, from - (a / 3.0) * tangent), 1e-12);
        EXPECT_EQ(start, from);
    }
    EXPECT_FALSE(catmull_rom(Ring{{0, 0}, {1, 0}, {0, 0}}));
    const FromXml made = from_xml(
        "<structure type='freeform' id='f'><touchpoints><point x='-20' y='-30' t='0'/><point x='20' y='-25' "
        "t='0.1'/><point x='24' y='10'/><point x='-30' y='15'/></touchpoints></structure>");
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_EQ(
        from_xml("<structure type='freeform' id='f'><parentfold><begin x='0' y='-75'/><end x='0' y='75'/>"
                 "</parentfold></structure>")
            .text,
        "error no-outline: \"f\": this freeform has no outline\n");
}

// --- off the paper

TEST(Sheet, SaysByHowMuchAFeatureLeavesThePage) {
    EXPECT_EQ(from_xml(freeform("M 20 -10 L -120 -10 L -120 10 L 20 10 Z")).text,
              "error does-not-fit: \"f\": it leaves the paper on the left of its fold by 20.00 mm\n");
    EXPECT_EQ(from_xml(freeform("M 20 -74.5 L -20 -74.5 L -20 10 L 20 10 Z")).text,
              "error does-not-fit: \"f\": it reaches 0.48 mm over the end of what is left of its fold, with "
              "1.00 mm "
              "of paper around it\n");
    EXPECT_EQ(
        from_xml(freeform("M 20 -20 L -99.5 -20 L -99.5 10 L 20 10 Z")).text,
        "error does-not-fit: \"f\": on the left of its fold it comes nearer than 1.00 mm to an edge of the "
        "paper, a cut or a seam\n");
}

// What the benchmark of many outlines measures is a card.
TEST(Sheet, ManyFreeformFeaturesShareThePageOut) {
    Diagnostics diagnostics;
    const auto design = read_design({"sheet.xml", freeform_sheet(23)}, {}, diagnostics);
    ASSERT_TRUE(design) << findings(diagnostics);
    const Built built = build(*design);
    ASSERT_TRUE(built.assembly);
    EXPECT_EQ(findings(built.diagnostics), "");
    EXPECT_EQ(built.assembly->plates.size(), 2U + 2U * 23U);
    const Balance balance = balance_of(*built.assembly, 0);
    EXPECT_NEAR(balance.plates, design->width_mm * design->height_mm, 1e-6);
    EXPECT_LT(balance.overlap, 5e-4);
}

TEST(Sheet, RemarksOnCurvesThatAKnifeCannotFollow) {
    const FromXml made =
        from_xml(freeform("M 20 -20 L -20 -20 L -20 20 L 20.05 20 A 0.05 0.05 0 0 0 20.05 19.9 L 20 19 Z"));
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(made.text.substr(0, 24), "remark curve-too-tight: ") << made.text;
}

// --- curves

TEST(Sheet, ACubicThatNoFoldCutsIsOneOfItsCurves) {
    const FromXml made = from_xml(
        freeform("M 30 0 C 30 10 20 10 20 25 C 10 30 5 35 -10 32 C -25 35 -30 30 -35 20 C -45 15 -45 10 -40 "
                 "0 C -45 -10 -45 "
                 "-15 -35 -20 C -30 -30 -25 -35 -10 -32 C 5 -35 10 -30 20 -25 C 20 -10 30 -10 30 0 Z"));
    EXPECT_EQ(made.text, "");
    expect_sound(made);
    EXPECT_EQ(made.assembly->curves.size(), 8U);
}

// What is kept of an element's border from one question to the next is of the very line that it is asked of:
// cards one after another whose outlines differ in one number, each the first anew or after others.
TEST(Sheet, OutlinesThatDifferInOneNumberAreNotTakenForOneAnother) {
    const auto plate_of = [](const std::string& control, const std::string& corner) {
        const FromXml made =
            from_xml(freeform("M 20 -20 L " + corner + " L -20 20 C " + control + " 10 30 20 20 Z"));
        EXPECT_TRUE(made.assembly) << made.text;
        return made.assembly ? made.assembly->plates.back().outline.outer : Ring{};
    };
    const Ring first = plate_of("-10 30", "-20 -20");
    const Ring other_control = plate_of("-10 31", "-20 -20");
    const Ring other_corner = plate_of("-10 30", "-20 -21");
    EXPECT_FALSE(first.empty());
    EXPECT_NE(other_control, first);
    EXPECT_NE(other_corner, first);
    EXPECT_EQ(plate_of("-10 30", "-20 -20"), first);
    EXPECT_EQ(plate_of("-10 31", "-20 -20"), other_control);
}

}  // namespace
}  // namespace popup::test
