// Colours, rules and dashes of drawings, and what lines of them mean.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "input/drawing/style.h"
#include "popup/language.h"
#include "popup/profile.h"
#include "support/drawings.h"

namespace popup {
namespace {

using test::drawing;
using test::read_drawing;

TEST(DrawingStyle, RulesWeighAsInCss) {
    // What of a tag, a class, an id, the style and an attribute says stroke or none decides whether the
    // second contour is there.
    const auto cut = [](const std::string& css, const std::string& attributes) {
        const auto reading = read_drawing("<svg width='100mm' height='100mm'><style>/* a { b } */" + css +
                                          "</style><rect stroke='red' fill='none' width='5' "
                                          "height='5'/><path fill='none' d='M50 50h50v50h-50z' " +
                                          attributes + "/></svg>");
        return reading.list && reading.parts().size() == 2;
    };
    EXPECT_TRUE(cut("", "stroke='red'"));
    EXPECT_FALSE(cut("", "stroke='none'"));
    EXPECT_TRUE(cut("", "style='stroke:red' stroke='none'"));
    EXPECT_FALSE(cut("path{stroke:none}", "stroke='red'"));
    EXPECT_TRUE(cut("path{stroke:none}.a{stroke:red}", "class='b a'"));
    EXPECT_TRUE(cut(".a{stroke:red}path{stroke:none}", "class='a'"));
    EXPECT_FALSE(cut(".a{stroke:red}path.a{stroke:none}", "class='a'"));
    EXPECT_FALSE(cut(".a{stroke:red}.b{stroke:none}", "class='b a'"));
    EXPECT_TRUE(cut("#p{stroke:red}.b{stroke:none}", "class='b' id='p'"));
    EXPECT_FALSE(cut("#p{stroke:red}", "id='p' style='stroke:none'"));
    EXPECT_TRUE(cut("#p{stroke:red !important}", "id='p' style='stroke:none'"));
    EXPECT_TRUE(cut("*{stroke:red}", ""));
    EXPECT_TRUE(cut("rect, path {fill:none;stroke:red;}", ""));
    EXPECT_TRUE(cut("@import url(x.css); @font-face{src:url(a)} path{stroke:red}", ""));
    EXPECT_TRUE(cut("<![CDATA[path{stroke:red}]]>", ""));
}

TEST(DrawingStyle, SelectorsThatAreNotReadAreToldOf) {
    const auto reading = read_drawing(
        drawing("<style>g > rect{stroke:none} a:hover{color:red} @media print{rect{display:none}}</style>"
                "<rect width='5' height='5'/>"));
    EXPECT_EQ(reading.codes(), "1:1 style-ignored\n");
    EXPECT_EQ(reading.findings[0].message, "2 style rules are not understood");
}

TEST(DrawingStyle, PaintIsReadInAllItsSpellings) {
    using drawing::Paint;
    const auto red = Paint{Paint::Kind::color, {255, 0, 0}};
    for (const std::string text :
         {"red", "#f00", "#FF0000", "#f00f", "#ff000080", "rgb(255,0,0)", "RGB( 100% 0% 0% )",
          "rgba(255, 0, 0, .5)", " Red ", "hsl(0, 100%, 50%)", "HSL(0deg 100% 50%)",
          "hsla(360, 100%, 50%, .3)", "hsl(-1turn 100 50 / 20%)", "hsl(400grad 100% 50%)",
          "hsl(none 100% 50%)", "hwb(0 0% 0%)", "hwb(720deg 0 0 / .5)", "hsl(6.2831853rad 100% 50%)"}) {
        EXPECT_EQ(drawing::parse_paint(text), red) << text;
    }
    for (const std::string text : {"rgb(255 0 0)", "rgb(100% 0% 0% / 50%)", "rgb(255 none none)"})
        EXPECT_EQ(drawing::parse_paint(text), red) << text;
    // Of CSS Color 4's own examples and tables.
    const std::vector<std::pair<std::string, Color>> others{
        {"hsl(120deg 100% 25%)", {0, 128, 0}}, {"hsl(240, 100%, 50%)", {0, 0, 255}},
        {"hsl(120 75% 75%)", {143, 239, 143}}, {"hsl(210 50% 50%)", {64, 128, 191}},
        {"hwb(150 20% 10%)", {51, 230, 140}},  {"hwb(45 40% 80%)", {85, 85, 85}},
        {"hsl(60 100% 50%)", {255, 255, 0}},   {"hwb(300 0% 0%)", {255, 0, 255}},
        {"hsl(39 100% 50%)", {255, 166, 0}},   {"hsl(0 0% 0%)", {0, 0, 0}}};
    for (const auto& [text, color] : others)
        EXPECT_EQ(drawing::parse_paint(text), (Paint{Paint::Kind::color, color})) << text;
    for (const std::string text : {"hsl(", "hsl(red)", "hsl(1 2)", "hsl(10foo 1% 1%)", "hwb()", "var(--fold)",
                                   "oklch(40% .2 20)", "rgb", "color(srgb 1 0 0)"})
        EXPECT_EQ(drawing::parse_paint(text), (Paint{Paint::Kind::other, {0, 0, 0}})) << text;
    EXPECT_EQ(drawing::parse_paint("none").kind, Paint::Kind::none);
    EXPECT_EQ(drawing::parse_paint("transparent").kind, Paint::Kind::none);
    EXPECT_EQ(drawing::parse_paint("url(#g) none").kind, Paint::Kind::other);
    EXPECT_EQ(drawing::parse_paint("currentColor").kind, Paint::Kind::other);
}

TEST(DrawingStyle, CurrentColourIsThatOfTheElement) {
    const auto color_of = [](const std::string& shapes) {
        Diagnostics diagnostics;
        const auto tracing = drawing::read_tracing({"drawing.svg", drawing(shapes)}, {}, diagnostics);
        return tracing && !tracing->lines.empty() ? tracing->lines.back().color : Color{1, 2, 3};
    };
    const std::string line = "<path fill='none' d='M0 0h5v5z'";
    EXPECT_EQ(color_of(line + " stroke='currentColor' color='#f00'/>"), (Color{255, 0, 0}));
    EXPECT_EQ(color_of("<g color='blue'>" + line + " style='stroke:currentcolor'/></g>"), (Color{0, 0, 255}));
    // The word is handed down, and not what it stands for further out.
    EXPECT_EQ(color_of("<g stroke='currentColor' color='blue'>" + line + " color='red'/></g>"),
              (Color{255, 0, 0}));
    EXPECT_EQ(color_of("<g stroke='currentColor' color='blue'>" + line + " stroke='#0f0' color='red'/></g>"),
              (Color{0, 255, 0}));
    EXPECT_EQ(color_of(line + " stroke='currentColor'/>"), (Color{0, 0, 0}));
}

// What a colour of a line says would be lost, and its line be cut.
TEST(DrawingStyle, ColoursThatAreNotReadAreToldOfOnceEach) {
    const auto reading =
        read_drawing(drawing("\n<rect width='5' height='5' stroke='color(srgb 1 0 0)'/>"
                             "\n<rect width='4' height='4' stroke='color(srgb 1 0 0)'/>"
                             "\n<rect width='3' height='3' stroke='lab(50% 40 60)'/>"
                             "\n<rect width='2' height='2' stroke='url(#g)'/>"
                             "\n<rect width='1' height='1' stroke='hsl(0 100% 50%)'/>"));
    EXPECT_EQ(reading.codes(), "3:1 color-not-read\n5:1 color-not-read\n");
    ASSERT_EQ(reading.findings.size(), 2U);
    EXPECT_EQ(reading.findings[0].message,
              "2 shapes are drawn in \"color(srgb 1 0 0)\", which is no colour that is read; that is taken "
              "for black, in which lines are cut");
    // A name says what they are.
    Diagnostics diagnostics;
    ReadOptions options;
    options.drawing.lines = {{"side", DrawnUse::cut}};
    const std::string named = "<rect class='side' width='5' height='5' stroke='lab(50% 40 60)'/>";
    drawing::read_parts({"drawing.svg", drawing(named)}, options, diagnostics);
    EXPECT_TRUE(diagnostics.sorted().empty());
}

// The writer's notation and the reader's are the same.
TEST(DrawingStyle, DashedLinesInTheColoursOfFoldsAreThoseFolds) {
    const std::map<Operation, LineKind> folds{{Operation::valley, LineKind::valley},
                                              {Operation::mountain, LineKind::mountain},
                                              {Operation::seam, LineKind::seam}};
    for (const auto& [operation, kind] : folds) {
        const std::string color = to_string(profile_table().front().pen(operation).color);
        const auto dashed =
            read_drawing(drawing("<rect width='50' height='50'/><path d='M10 10H40' stroke='" + color +
                                 "' stroke-dasharray='3,1'/>"));
        // A seam among no folds may be one.
        EXPECT_EQ(dashed.codes(), kind == LineKind::seam ? "2:31 folds-as-cuts\n" : "");
        const FlatPart& part = dashed.part();
        ASSERT_EQ(part.lines.size(), 1U);
        EXPECT_EQ(part.lines[0].kind, kind);
        EXPECT_TRUE(part.slits.empty());
        for (const std::string dashes : {"none", "0", "0 0"}) {
            const auto solid =
                read_drawing(drawing("<rect width='50' height='50'/><path d='M10 10H40' stroke='" + color +
                                     "' style='stroke-dasharray:" + dashes + "'/>"));
            EXPECT_TRUE(solid.part().lines.empty()) << dashes;
            EXPECT_EQ(solid.part().slits.size(), 1U) << dashes;
            // It is said of those in the colour of a fold.
            EXPECT_EQ(solid.codes(), kind == LineKind::seam ? "" : "2:31 folds-as-cuts\n") << dashes;
        }
    }
    const auto green = read_drawing(
        drawing("<rect width='50' height='50'/><path d='M10 10H40' stroke='green' stroke-dasharray='3,1'/>"));
    EXPECT_EQ(green.part().slits.size(), 1U);
    EXPECT_EQ(green.codes(), "2:31 folds-as-cuts\n");
    // A closed fold goes all the way round.
    const FlatPart closed = read_drawing(drawing("<rect width='50' height='50'/><path d='M10 10H40V40Z' "
                                                 "stroke='#f0f' stroke-dasharray='3mm'/>"))
                                .part();
    ASSERT_EQ(closed.lines.size(), 1U);
    EXPECT_EQ(closed.lines[0].points.size(), 4U);
}

}  // namespace
}  // namespace popup
