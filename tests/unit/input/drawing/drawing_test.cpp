// What is read of a drawing: shapes, units, transforms and styles, held against formulas.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "input/drawing/read.h"
#include "input/drawing/transform.h"
#include "popup/language.h"
#include "popup/path.h"
#include "support/drawings.h"

namespace popup {
namespace {

using test::area;
using test::bounds;
using test::drawing;
using test::read_drawing;

constexpr double kPi = std::numbers::pi;

void expect_box(const Box& box, double left, double bottom, double right, double top, double slack = 1e-5) {
    EXPECT_NEAR(box.min.x, left, slack);
    EXPECT_NEAR(box.min.y, bottom, slack);
    EXPECT_NEAR(box.max.x, right, slack);
    EXPECT_NEAR(box.max.y, top, slack);
}

// The only part of a drawing without findings.
FlatPart only_part(const std::string& body) {
    const auto reading = read_drawing(drawing(body));
    EXPECT_EQ(reading.codes(), "") << body;
    if (!reading.list || reading.parts().size() != 1) {
        ADD_FAILURE() << body;
        return {};
    }
    return reading.part();
}

// Chords lie inside of a round contour, at most 0.01 mm from it.
void expect_round(const FlatPart& part, double true_area, double around) {
    EXPECT_LE(area(part), true_area + 1e-6);
    EXPECT_GE(area(part), true_area - 0.01 * around);
}

TEST(Drawing, ShapesHaveTheAreasOfTheirFormulas) {
    EXPECT_NEAR(area(only_part("<rect x='10' y='20' width='30' height='40'/>")), 1200.0, 1e-6);
    expect_box(bounds(only_part("<rect x='10' y='20' width='30' height='40'/>")), 10, 40, 40, 80);
    expect_round(only_part("<circle cx='50' cy='50' r='20'/>"), kPi * 400.0, 2.0 * kPi * 20.0);
    expect_box(bounds(only_part("<circle cx='50' cy='40' r='20'/>")), 30, 40, 70, 80);
    expect_round(only_part("<ellipse cx='50' cy='50' rx='30' ry='10'/>"), kPi * 300.0, 4.0 * 40.0);
    // One radius stands for both, and neither is more than half a side.
    const double corners = (4.0 - kPi) * 25.0;
    expect_round(only_part("<rect x='10' y='10' width='40' height='30' rx='5'/>"), 1200.0 - corners, 140.0);
    expect_round(only_part("<rect x='10' y='10' width='40' height='30' ry='5' rx='auto'/>"), 1200.0 - corners,
                 140.0);
    expect_round(only_part("<rect x='10' y='10' width='40' height='30' rx='90' ry='90'/>"), kPi * 300.0,
                 140.0);
    EXPECT_NEAR(area(only_part("<polygon points='10,10 30,10 30,30'/>")), 200.0, 1e-6);
    EXPECT_NEAR(area(only_part("<polyline points='10 10 30 10 30 30 10 10'/>")), 200.0, 1e-6);
}

TEST(Drawing, YPointsUpFromTheLowerLeftCorner) {
    expect_box(bounds(only_part("<path d='M10,10 H20 V30 H10 Z'/>")), 10, 70, 20, 90);
}

TEST(Drawing, EveryPathCommandDrawsWhatItSays) {
    // The same figure, in all the ways there are to write it.
    for (const std::string d :
         {"M10 10L30 10L30 40L10 40Z", "m10 10l20 0 0 30-20 0z", "M10 10H30V40H10Z", "m10 10h20v30h-20z",
          "M10 10 30 10 30 40 10 40z", "M 10,10 h 20 v 30 h -20 z", "M1e1.1e2L.3e2 10 30.0,4e+1 10 40Z",
          "m10 10 20,0,0,30-20,0z", "\tM10 10\nH 30\rV40 H10Z"}) {
        const FlatPart part = only_part("<path d='" + d + "'/>");
        EXPECT_NEAR(area(part), 600.0, 1e-6) << d;
        expect_box(bounds(part), 10, 60, 30, 90);
    }
}

// Under a parabola y = 2 h t (1 - t) · … the area is two thirds of base times height.
TEST(Drawing, CurvesHaveTheAreasOfTheirFormulas) {
    // A quadratic with its control point 30 above the chord is a parabola 15 high.
    const double parabola = 2.0 / 3.0 * 40.0 * 15.0;
    for (const std::string d :
         {"M10 50Q30 20 50 50Z", "m10 50q20-30 40 0z", "M10 50C23.333333 30 36.666667 30 50 50Z",
          "m10 50c13.333333-20 26.666667-20 40 0z"}) {
        expect_round(only_part("<path d='" + d + "'/>"), parabola + 1e-4, 100.0);
    }
    // Two waves: the second half by mirrored control points; they lie on both sides of the chord.
    const FlatPart wave = only_part("<path d='M10 50Q20 35 30 50T50 50V80H10Z'/>");
    EXPECT_NEAR(area(wave), 40.0 * 30.0, 0.5);
    expect_box(bounds(wave), 10, 20, 50, 57.5, 0.02);
    const FlatPart smooth = only_part("<path d='M10 50C15 40 25 40 30 50S45 60 50 50V80H10Z'/>");
    const FlatPart spelt = only_part("<path d='M10 50C15 40 25 40 30 50C35 60 45 60 50 50V80H10Z'/>");
    EXPECT_EQ(smooth.paper[0].outer, spelt.paper[0].outer);
    // After another command nothing is mirrored.
    const FlatPart plain = only_part("<path d='M10 50H30S45 60 50 50V80H10Z'/>");
    const FlatPart plain_spelt = only_part("<path d='M10 50H30C30 50 45 60 50 50V80H10Z'/>");
    EXPECT_EQ(plain.paper[0].outer, plain_spelt.paper[0].outer);
}

TEST(Drawing, ArcsTakeTheSideTheirFlagsSay) {
    // A chord of 20 in a circle of radius 20 cuts off a segment of 60°.
    const double segment = 400.0 * (kPi / 6.0 - std::sqrt(3.0) / 4.0);
    const double disc = kPi * 400.0;
    const std::map<std::string, double> areas{
        {"0 0 0", segment}, {"0 0 1", segment}, {"0 1 0", disc - segment}, {"0 1 1", disc - segment}};
    for (const auto& [flags, expected] : areas) {
        const FlatPart part = only_part("<path d='M40 50A20 20 " + flags + " 60 50Z'/>");
        expect_round(part, expected, 130.0);
        // With the sweep flag an arc to the right runs over the top of the drawing, which is up.
        const bool over = flags.ends_with('1');
        EXPECT_EQ(bounds(part).max.y > 50.5, over) << flags;
        EXPECT_EQ(bounds(part).min.y < 49.5, !over) << flags;
    }
    // Flags need no blank around them.
    EXPECT_EQ(only_part("<path d='M40 50A20 20 0 1160 50Z'/>").paper[0].outer,
              only_part("<path d='M40 50A20 20 0 1 1 60 50Z'/>").paper[0].outer);
    EXPECT_EQ(only_part("<path d='M40 50a20 20 0 0120 0z'/>").paper[0].outer,
              only_part("<path d='M40 50A20 20 0 0 1 60 50Z'/>").paper[0].outer);
    // Radii that are too small grow until the arc reaches: half an ellipse.
    expect_round(only_part("<path d='M20 50A1 0.5 0 0 1 80 50Z'/>"), 0.5 * kPi * 30.0 * 15.0, 130.0);
    // A turned ellipse: its area does not depend on the turn.
    expect_round(only_part("<path d='M50 20A30 10 30 0 1 50 80A30 10 30 0 1 50 20Z'/>"),
                 area(only_part("<path d='M50 20A30 10 30 0 0 50 80A30 10 30 0 0 50 20Z'/>")), 250.0);
}

TEST(Drawing, ChordsStrayFromCurvesByNoMoreThanTheTolerance) {
    for (const double radius : {0.5, 5.0, 50.0, 500.0}) {
        Path path;
        path.move({radius, 0.0});
        path.arc(radius, radius, 0.0, true, true, {0.0, -radius});
        Flattened flat;
        ASSERT_EQ(flatten(path, flat), FlatteningFault::none);
        const std::vector<Vec2>& arc = flat.lines.at(0).points;
        for (std::size_t i = 1; i < arc.size(); ++i) {
            EXPECT_NEAR(length(arc[i]), radius, 1e-5 + 1e-6 * radius);
            EXPECT_LE(radius - length(lerp(arc[i - 1], arc[i], 0.5)), kFlatMm + 1e-5);
        }
    }
}

TEST(Drawing, ScaledCurvesAreAsSmoothAsOthers) {
    const FlatPart small = only_part("<circle cx='0.05' cy='0.05' r='0.04' transform='scale(1000)'/>");
    const FlatPart large = only_part("<circle cx='50' cy='50' r='40'/>");
    EXPECT_EQ(small.paper[0].outer.size(), large.paper[0].outer.size());
}

// A transform as text, and where it must take (1, 2), worked out by hand.
TEST(Drawing, TransformsAreComposedFromTheRight) {
    const double c = std::cos(kPi / 6.0);
    const double s = 0.5;
    const std::map<std::string, Vec2> expected{
        {"", {1, 2}},
        {"translate(10)", {11, 2}},
        {"translate(10,-3)", {11, -1}},
        {"scale(2)", {2, 4}},
        {"scale(2 3)", {2, 6}},
        {"rotate(90)", {-2, 1}},
        {"rotate(30)", {c - 2 * s, s + 2 * c}},
        {"rotate(90 1 0)", {-1, 0}},
        {"rotate(-270 , 1 , 0)", {-1, 0}},
        {"skewX(45)", {3, 2}},
        {"skewY(45)", {1, 3}},
        {"matrix(1 2 3 4 5 6)", {1 + 6 + 5, 2 + 8 + 6}},
        {"translate(10,0) scale(2)", {12, 4}},
        {"scale(2)translate(10,0)", {22, 4}},
        {" scale( 2 ) , rotate(90)\n translate(1-1)", {-2, 4}},
    };
    for (const auto& [text, point] : expected) {
        const auto map = drawing::parse_transform(text);
        ASSERT_TRUE(map) << text;
        EXPECT_NEAR((*map)({1, 2}).x, point.x, 1e-12) << text;
        EXPECT_NEAR((*map)({1, 2}).y, point.y, 1e-12) << text;
    }
    for (const std::string wrong : {"turn(3)", "scale()", "scale(1 2 3)", "rotate(1 2)", "matrix(1 2 3)",
                                    "scale(1", "scale 2", "translate(a)", "3"}) {
        EXPECT_FALSE(drawing::parse_transform(wrong)) << wrong;
    }
}

TEST(Drawing, TransformsOfGroupsActOnWhatIsInThem) {
    const FlatPart part = only_part(
        "<g transform='translate(50 50)'><g transform='rotate(90)'><rect x='1' y='2' width='10' height='20' "
        "transform='scale(1.5)'/></g></g>");
    EXPECT_NEAR(area(part), 200.0 * 2.25, 1e-5);
    // x' = 50 - 1.5 y, y' = 50 + 1.5 x, from the top.
    expect_box(bounds(part), 50 - 33, 100 - 50 - 16.5, 50 - 3, 100 - 50 - 1.5);
}

TEST(Drawing, UnitsAreThoseOfCss) {
    const std::map<std::string, double> mm{{"100mm", 100},  {"10cm", 100}, {"4in", 101.6},   {"288pt", 101.6},
                                           {"24pc", 101.6}, {"400Q", 100}, {"384px", 101.6}, {"384", 101.6}};
    for (const auto& [size, expected] : mm) {
        const auto reading =
            read_drawing("<svg width='" + size + "' height='" + size +
                         "' viewBox='0 0 10 10'><rect stroke='red' width='10' height='10'/></svg>");
        ASSERT_TRUE(reading.list) << size;
        expect_box(bounds(reading.part()), 0, 0, expected, expected);
        const bool told = size.ends_with("px") || size == "384";
        EXPECT_EQ(reading.codes(), told ? "1:1 size-in-pixels\n" : "") << size;
    }
    const auto wrong = read_drawing("<svg width='3ells' height='3em'><rect width='3' height='3'/></svg>");
    EXPECT_EQ(wrong.codes(), "1:6 bad-number\n1:20 bad-number\n");
}

TEST(Drawing, LengthsInShapesMayHaveUnits) {
    const auto reading = read_drawing(
        "<svg width='100mm' height='100mm'><rect stroke='red' x='1cm' y='10%' width='25.4mm' "
        "height='1in'/></svg>");
    ASSERT_TRUE(reading.list);
    expect_box(bounds(reading.part()), 10, 100 - 10 - 25.4, 35.4, 90);
}

TEST(Drawing, OneSizeAndAViewBoxGiveTheOther) {
    for (const std::string size : {"width='200mm'", "height='100mm'", "width='200mm' height='100%'"}) {
        const auto reading = read_drawing("<svg " + size +
                                          " viewBox='5 5 20 10'><rect stroke='red' x='5' y='5' width='20' "
                                          "height='10'/></svg>");
        EXPECT_EQ(reading.codes(), "");
        ASSERT_TRUE(reading.list);
        expect_box(bounds(reading.part()), 0, 0, 200, 100);
    }
}

TEST(Drawing, WithoutASizeUnitsArePixelsAndThatIsSaid) {
    for (const std::string size : {"", "width='100%' height='100%'"}) {
        const auto reading = read_drawing(
            "<svg " + size + " viewBox='0 0 960 480'><rect stroke='red' width='960' height='480'/></svg>");
        EXPECT_EQ(reading.codes(), "1:1 size-missing\n");
        ASSERT_TRUE(reading.list);
        expect_box(bounds(reading.part()), 0, 0, 254, 127);
    }
    const auto bare = read_drawing("<svg><rect stroke='red' x='96' y='96' width='96' height='96'/></svg>");
    EXPECT_EQ(bare.codes(), "1:1 size-missing\n");
    ASSERT_TRUE(bare.list);
    expect_box(bounds(bare.part()), 25.4, -50.8, 50.8, -25.4);
}

// Illustrator names itself, and counts in points, whether it calls them pixels or nothing at all.
TEST(Drawing, OfIllustratorsDrawingsItIsSaidHowLargeTheyAreMeant) {
    const std::string by =
        "<!-- Generator: Adobe Illustrator 27.0.0, SVG Export Plug-In . SVG Version: 6.00 Build 0)  -->\n";
    for (const auto& [size, code] : {std::pair("", "2:1 size-missing\n"),
                                     std::pair("width='720px' height='360px'", "2:1 size-in-pixels\n")}) {
        const auto reading =
            read_drawing(by + "<svg " + size +
                         " viewBox='0 0 720 360'><rect stroke='red' width='720' height='360'/></svg>");
        EXPECT_EQ(reading.codes(), code);
        const std::vector<std::string>& hints = reading.findings.front().hints;
        EXPECT_EQ(hints.back(),
                  "Adobe Illustrator, which wrote it, counts 72 to the inch: --scale 1.333333 makes it "
                  "254.00 × 127.00 mm");
    }
    const auto real = read_drawing(by +
                                   "<svg width='254mm' height='127mm' viewBox='0 0 720 360'>"
                                   "<rect stroke='red' width='720' height='360'/></svg>");
    EXPECT_EQ(real.codes(), "");
    ASSERT_TRUE(real.list);
    expect_box(bounds(real.part()), 0, 0, 254, 127);
}

TEST(Drawing, TextsOnALayerOfNotesAreNoLettersToCut) {
    for (const auto& [layer, codes] : {std::pair("Notes", ""), std::pair("Front", "1:88 not-cut\n")}) {
        const auto reading = read_drawing(
            std::string("<svg width='99mm' height='99mm'><rect stroke='red' width='9' height='9'/><g id='") +
            layer + "'><text>30 mm</text></g></svg>");
        ASSERT_TRUE(reading.list);
        EXPECT_EQ(reading.codes(), codes) << layer;
    }
}

TEST(Drawing, PreserveAspectRatioSaysHowABoxIsFitted) {
    // A box of 10 × 10 in 100 × 50 mm.
    const std::map<std::string, Box> expected{
        {"", {{25, 0}, {75, 50}}},
        {"xMidYMid meet", {{25, 0}, {75, 50}}},
        {"xMinYMin", {{0, 0}, {50, 50}}},
        {"xMaxYMax meet", {{50, 0}, {100, 50}}},
        {"none", {{0, 0}, {100, 50}}},
        {"xMidYMid slice", {{0, -25}, {100, 75}}},
        {"xMidYMin slice", {{0, -50}, {100, 50}}},
        {"xMidYMax slice", {{0, 0}, {100, 100}}},
    };
    for (const auto& [preserve, box] : expected) {
        const auto reading =
            read_drawing("<svg width='100mm' height='50mm' viewBox='0 0 10 10' preserveAspectRatio='" +
                         preserve + "'><rect stroke='red' width='10' height='10'/></svg>");
        ASSERT_TRUE(reading.list) << preserve;
        SCOPED_TRACE(preserve);
        expect_box(bounds(reading.part()), box.min.x, box.min.y, box.max.x, box.max.y);
    }
}

TEST(Drawing, AnSvgInsideAnotherIsAPictureInARectangle) {
    const FlatPart part = only_part(
        "<svg x='10' y='20' width='40' height='40' viewBox='0 0 4 4'><rect x='1' y='1' width='50%' "
        "height='2'/></svg>");
    expect_box(bounds(part), 20, 100 - 50, 40, 100 - 30);
}

TEST(Drawing, UsesDrawWhatTheyNameWhereTheyAre) {
    const auto reading = read_drawing(drawing(
        "<defs><g id='g'><rect id='r' width='10' height='5'/></g><symbol id='s' viewBox='0 0 2 2'><circle "
        "cx='1' cy='1' r='1'/></symbol></defs>"
        "<use href='#g' x='10' y='10'/><use id='two' xlink:href='#r' transform='translate(30 10) scale(2)'/>"
        "<use href='#s' x='60' y='60' width='20' height='20'/>"));
    EXPECT_EQ(reading.codes(), "");
    ASSERT_EQ(reading.parts().size(), 3U);
    expect_box(bounds(reading.part(0)), 10, 85, 20, 90);
    expect_box(bounds(reading.part(1)), 30, 80, 50, 90);
    expect_box(bounds(reading.part(2)), 60, 20, 80, 40);
    EXPECT_EQ(reading.part(0).name, "r");
    EXPECT_EQ(reading.part(1).name, "two");
}

TEST(Drawing, UsesThatNameNothingOrThemselvesAreRefused) {
    EXPECT_EQ(read_drawing(drawing("<use href='#nothing'/>")).codes(), "2:6 bad-reference\n");
    EXPECT_EQ(read_drawing(drawing("<use href='other.svg#a'/>")).codes(), "2:6 bad-reference\n");
    EXPECT_EQ(read_drawing(drawing("<g id='a'><use href='#a'/></g>")).codes(), "2:11 bad-reference\n");
    EXPECT_EQ(read_drawing(drawing("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>")).codes(),
              "2:11 bad-reference\n");
    EXPECT_EQ(read_drawing(drawing("<use id='u' href='#u'/>")).codes(), "2:1 bad-reference\n");
}

TEST(Drawing, AFewUsesThatMakeMillionsOfElementsAreRefusedSoon) {
    std::string body = "<g id='a0'><rect width='1' height='1'/></g>";
    for (int i = 1; i < 12; ++i) {
        body += "<g id='a" + std::to_string(i) + "'>";
        for (int j = 0; j < 10; ++j) body += "<use href='#a" + std::to_string(i - 1) + "'/>";
        body += "</g>";
    }
    const auto reading = read_drawing(drawing(body));
    EXPECT_FALSE(reading.list);
    ASSERT_FALSE(reading.findings.empty());
    EXPECT_EQ(reading.findings.front().code, "document-too-large");
}

TEST(Drawing, HiddenThingsAreNotCut) {
    const auto reading = read_drawing(
        drawing("<rect id='seen' width='10' height='10'/><rect x='20' width='10' height='10' display='none'/>"
                "<g style='display:none'><rect x='40' width='10' height='10'/></g>"
                "<g visibility='hidden'><rect x='60' width='10' height='10'/>"
                "<rect id='seen-again' x='80' width='10' height='10' visibility='visible'/></g>"));
    EXPECT_EQ(reading.codes(), "2:41 hidden-shape\n");
    ASSERT_EQ(reading.parts().size(), 2U);
    EXPECT_EQ(reading.part(0).name, "seen");
    EXPECT_EQ(reading.part(1).name, "seen-again");
    EXPECT_NE(reading.findings[0].message.find("3 hidden elements are"), std::string::npos);
}

TEST(Drawing, TextsAndImagesAreToldOfOnceAKind) {
    const auto reading =
        read_drawing(drawing("<rect width='50' height='50'/><text x='1' y='1'>a<tspan>b</tspan></text>\n"
                             "<text>c</text><image width='3' height='3' href='x.png'/>"));
    EXPECT_EQ(reading.codes(), "2:31 not-cut\n3:15 not-cut\n");
    EXPECT_EQ(reading.findings[0].message, "2 text elements are not cut");
    EXPECT_EQ(reading.findings[1].message, "1 image element is not cut");
    ASSERT_TRUE(reading.list);
}

TEST(Drawing, ClipPathsAreNotAppliedAndThatIsSaid) {
    const auto reading =
        read_drawing(drawing("<clipPath id='c'><rect width='5' height='5'/></clipPath>\n"
                             "<rect width='50' height='50' clip-path='url(#c)'/>"));
    EXPECT_EQ(reading.codes(), "3:1 clip-ignored\n");
    EXPECT_NEAR(area(reading.part()), 2500.0, 1e-6);
}

TEST(Drawing, UnknownElementsOfSvgAreToldOfAndOthersAreNot) {
    const std::string body =
        "<rect width='5' height='5'/><sodipodi:namedview/><blob/><blob/><metadata><rdf:RDF/></metadata>";
    EXPECT_EQ(read_drawing(drawing(body)).codes(), "2:50 unknown-markup\n");
    EXPECT_FALSE(read_drawing(drawing(body), true).list);
}

TEST(Drawing, DocumentTypesAndPrefixesAreTakenAsTheyCome) {
    const auto reading = read_drawing(
        "<?xml version='1.0'?>\n<!DOCTYPE svg:svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\" [\n"
        "<!ENTITY ns \"http://x > y\">\n<!-- ] > -->\n]>\n"
        "<svg:svg xmlns:svg='http://www.w3.org/2000/svg' xmlns:x='&ns;' width='10mm' height='10mm'>"
        "<svg:rect width='5mm' height='5mm' stroke='red'/><rect/></svg:svg>");
    EXPECT_EQ(reading.codes(), "");
    EXPECT_NEAR(area(reading.part()), 25.0, 1e-6);
    EXPECT_EQ(read_drawing("<!DOCTYPE svg [<svg/>").codes(), "1:1 xml-syntax\n");
    EXPECT_EQ(read_drawing("<popup/>").codes(), "1:1 wrong-root\n");
    EXPECT_EQ(read_drawing("<x:svg xmlns:x='http://example.org'/>").codes(), "1:1 wrong-root\n");
    EXPECT_EQ(read_drawing("").codes(), "0:0 empty-input\n");
}

TEST(Drawing, MistakesAreToldWithTheirPlaces) {
    EXPECT_EQ(read_drawing(drawing("<path d='M0 0 L10'/>")).codes(), "2:18 bad-path\n");
    EXPECT_EQ(read_drawing(drawing("<path d='M0 0\n L10 x'/>")).codes(), "3:6 bad-path\n");
    EXPECT_EQ(read_drawing(drawing("<path d='L1 1'/>")).codes(), "2:10 bad-path\n");
    EXPECT_EQ(read_drawing(drawing("<path d='M0 0H9,Z'/>")).codes(), "2:16 bad-path\n");
    EXPECT_EQ(read_drawing(drawing("<path d='M0 0A1 1 0 2 0 3 3'/>")).codes(), "2:21 bad-path\n");
    EXPECT_EQ(read_drawing(drawing("<polygon points='1 2 3'/>")).codes(), "2:10 bad-path\n");
    EXPECT_EQ(read_drawing(drawing("<rect width='wide' height='3'/>")).codes(), "2:7 bad-number\n");
    EXPECT_EQ(read_drawing(drawing("<g transform='spin(3)'><rect width='3' height='3'/></g>")).codes(),
              "2:4 bad-transform\n");
    EXPECT_EQ(read_drawing("<svg viewBox='0 0 10'/>").codes(), "1:6 bad-number\n");
    EXPECT_EQ(read_drawing("<svg width='-3mm' height='3mm'/>").codes(), "1:6 bad-number\n");
    EXPECT_EQ(read_drawing(drawing("<svg viewBox='0 0 0 1'/>")).codes(), "2:6 bad-number\n");
}

TEST(Drawing, NumbersBeyondReasonAreRefused) {
    for (const std::string body :
         {"<rect width='1e300' height='5'/>", "<path d='M0 0H1e400V3Z'/>", "<circle r='1e7'/>",
          "<rect width='5' height='5' transform='scale(1e308) scale(1e308)'/>",
          "<path d='M0 0A1e300 1e-300 1e300 1 1 5 5Z'/>", "<path d='M0 0C1e9 0 0 1e9 5 5Z'/>"}) {
        EXPECT_EQ(read_drawing(drawing(body)).codes(), "2:1 bad-number\n") << body;
    }
    EXPECT_EQ(read_drawing("<svg width='10mm' height='10mm' viewBox='0 0 1e-300 1e-300'><rect stroke='red' "
                           "width='1' height='1'/></svg>")
                  .codes(),
              "1:61 bad-number\n");
}

// --- styles

// How far the lines of a folded drawing are folded, and as what.
std::string angles_of(const std::string& element) {
    Diagnostics said("box.svg");
    ReadOptions read;
    read.drawing.as = DrawnAs::folded;
    const std::string text =
        drawing("<path class='cut' stroke='#000' fill='none' d='M0 0H90V90H0Z'/>" + element);
    const Reading reading = read_source_text({"box.svg", text}, read, said);
    std::string all;
    if (!reading.creases) {
        for (const Diagnostic& one : said.sorted()) {
            if (one.severity == Severity::error) all += one.message + " [" + one.code + "]";
        }
        return all;
    }
    for (const CreaseLine& line : reading.creases->lines) {
        if (line.use == CreaseUse::cut) continue;
        all += all.empty() ? "" : ", ";
        all += kCreaseUseNames.at(static_cast<std::size_t>(line.use));
        if (line.fold_deg) all += " " + fmt::format("{}", *line.fold_deg);
    }
    return all;
}

TEST(Drawing, FoldsGoAsFarAsTheirElementSays) {
    struct Row {
        std::string element, folds;
    };
    const std::string two = "fill='none' d='M10 0V90M20 0V90'";
    for (const Row& row : std::vector<Row>{
             {"<path class='valley' stroke='#f0f' data-fold-angle='60' " + two + "/>",
              "valley 60, valley 60"},
             {"<path class='valley' stroke='#f0f' data-fold-angle=' 60,\n128.571429 ' " + two + "/>",
              "valley 60, valley 128.571429"},
             {"<path class='valley' stroke='#f0f' data-fold-angle='auto 0' " + two + "/>",
              "valley, valley 0"},
             {"<path class='mountain' stroke='#f0f' data-fold-angle='-30 180' " + two + "/>",
              "valley 30, mountain 180"},
             {"<path class='fold' stroke='#f0f' data-fold-angle='30 -30' " + two + "/>",
              "fold 30, mountain 30"},
             // Before what Origami Simulator reads in the opacity, which stays as it was.
             {"<path stroke='#ff0000' stroke-opacity='0.5' data-fold-angle='60 auto' " + two + "/>",
              "mountain 60, mountain 90"},
             {"<line stroke='#ff0000' x1='10' y1='0' x2='10' y2='90' data-fold-angle='45'/>", "mountain 45"},
             {"<g data-fold-angle='45'><path class='valley' stroke='#f0f' " + two + "/></g>",
              "valley 45, valley 45"},
             // Each side of what has straight ones alone: of a rectangle from its corner along x.
             {"<rect class='fold' stroke='#f0f' fill='none' x='20' y='20' width='40' height='30' "
              "data-fold-angle='90 -80 auto 70'/>",
              "fold 90, mountain 80, fold, fold 70"},
             {"<rect class='fold' stroke='#f0f' x='20' y='20' width='40' height='30' fill='none' "
              "data-fold-angle='80'/>",
              "fold 80"},
             {"<path class='valley' stroke='#f0f' fill='none' data-fold-angle='60 70 80' "
              "d='M10 0V30H50M60 0V50'/>",
              "valley 60, valley 70, valley 80"},
             {"<polygon class='valley' stroke='#f0f' points='20 20 40 20 40 40' fill='none' "
              "data-fold-angle='60 70 80'/>",
              "valley 60, valley 70, valley 80"},
             {"<polygon class='valley' stroke='#f0f' points='20 20 40 20 40 40' fill='none' "
              "data-fold-angle='60 70'/>",
              "'data-fold-angle' has 2 angles, and its element draws 1 line with 3 sides [bad-number]"},
             {"<path class='valley' stroke='#f0f' fill='none' data-fold-angle='60 70' "
              "d='M10 20C20 40 30 40 40 20H50'/>",
              "'data-fold-angle' has 2 angles, and its element draws 1 line [bad-number]"},
             // Points that are one point on the grid have no side between them.
             {"<path class='valley' stroke='#f0f' fill='none' data-fold-angle='60 70' "
              "d='M10 10h40v1e-7h40'/>",
              "valley 60, valley 70"},
             {"<path class='valley' stroke='#f0f' fill='none' data-fold-angle='60 70 80' "
              "d='M10 10h40v1e-7h40'/>",
              "'data-fold-angle' has 3 angles, and its element draws 1 line with 2 sides [bad-number]"},
             {"<path class='valley' stroke='#f0f' fill='none' data-fold-angle='60 70 80' "
              "transform='scale(1000)' d='M.01 .01h.04v1e-6h.04'/>",
              "valley 60, valley 70, valley 80"},
             // Of a cut it says nothing.
             {"<path class='cut' stroke='#000' data-fold-angle='60' " + two + "/>", ""},
             {"<path class='valley' stroke='#f0f' data-fold-angle='60 70 80' " + two + "/>",
              "'data-fold-angle' has 3 angles, and its element draws 2 lines [bad-number]"},
             {"<path class='valley' stroke='#f0f' data-fold-angle='' " + two + "/>",
              "'data-fold-angle' has 0 angles, and its element draws 2 lines [bad-number]"},
             {"<path class='valley' stroke='#f0f' data-fold-angle='60 1e3' " + two + "/>",
              "'data-fold-angle' has \"1e3\", which is no angle from -180 to 180 degrees, nor auto "
              "[bad-number]"},
             {"<path class='valley' stroke='#f0f' data-fold-angle='60deg' " + two + "/>",
              "'data-fold-angle' has \"60deg\", which is no angle from -180 to 180 degrees, nor auto "
              "[bad-number]"}})
        EXPECT_EQ(angles_of(row.element), row.folds) << row.element;
}

TEST(DrawingStyle, FillsThatAreWrittenArePrintedOnWhatIsLeft) {
    const FlatPart part =
        only_part("<path d='M10 10H40V40H10Z M20 20H30V30H20Z' fill='#abcdef' fill-rule='evenodd'/>");
    ASSERT_EQ(part.fills.size(), 1U);
    EXPECT_EQ(part.fills[0].color, (Color{0xab, 0xcd, 0xef}));
    EXPECT_NEAR(area(part.fills[0].shape), 800.0, 1e-6);
    // By directions both squares are inside; the hole is cut away all the same.
    const FlatPart same_way = only_part("<path d='M10 10H40V40H10Z M20 20H30V30H20Z' fill='#abcdef'/>");
    ASSERT_EQ(same_way.fills.size(), 1U);
    EXPECT_NEAR(area(same_way.fills[0].shape), 800.0, 1e-6);
    // The black that is meant where nothing is written is not printed; a decoration without a stroke is.
    const auto reading = read_drawing(
        "<svg width='100mm' height='100mm' viewBox='0 0 100 100'><rect stroke='red' width='50' height='50'/>"
        "<circle cx='25' cy='50' r='10' fill='blue'/></svg>");
    EXPECT_EQ(reading.codes(), "");
    ASSERT_EQ(reading.part().fills.size(), 1U);
    EXPECT_NEAR(area(reading.part().fills[0].shape), 50.0 * kPi, 0.5);  // what lies outside is left out
    EXPECT_EQ(reading.part().paper[0].holes.size(), 0U);
}

}  // namespace
}  // namespace popup
