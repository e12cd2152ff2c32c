// Where and whether drawings draw, as styles, conditions and uses say it: each beside the same drawing in
// plain attributes.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "input/drawing/transform.h"
#include "popup/compile.h"
#include "popup/language.h"
#include "support/drawings.h"

namespace popup {
namespace {

using test::bounds;
using test::drawing;
using test::read_drawing;

// The boxes of all parts, and the findings.
std::string parts_of(const std::string& body) {
    const auto reading = read_drawing(drawing(body));
    std::string made = reading.codes();
    if (!reading.list) return made;
    for (const FlatPart& part : reading.parts()) {
        const Box box = bounds(part);
        for (const double v : {box.min.x, box.min.y, box.max.x, box.max.y})
            made += std::to_string(static_cast<long>(1000.0 * v + 0.5)) + " ";
        made += "\n";
    }
    return made;
}

TEST(DrawingPlaces, StylesPlaceShapesAsAttributesDo) {
    const std::string plain = "<rect x='10' y='20' width='30' height='20'/>";
    for (const std::string same :
         {"<rect style='x:10px;y:20;width:30px;height:20px'/>",
          "<style>rect{x:10;y:20;width:30;height:20}</style><rect x='1' y='2' width='3' height='4'/>",
          "<path style=\"d:path('M10 20h30v20h-30z')\"/>",
          "<path d='M0 0h1v1z' style='d:path(\"M10 20h30v20h-30z\")'/>",
          "<rect style='transform:translate(10px,20px)' width='30' height='20'/>",
          "<style>.a{transform:translateX(10px) translateY(20px)}</style><rect class='a' width='30' "
          "height='20'/>",
          "<g transform='translate(99)' style='transform:translate(10px,20px)'><rect width='30' "
          "height='20'/></g>",
          "<rect x='10' y='20' width='30' height='20' transform='rotate(.5turn)' transform-origin='25 30'/>",
          "<rect x='60' y='20' width='30' height='20' transform='scale(-1 1)' transform-origin='center'/>",
          "<rect x='10' y='60' width='30' height='20' style='transform:scaleY(-1);transform-origin:left "
          "50%'/>"}) {
        EXPECT_EQ(parts_of(same), parts_of(plain)) << same;
    }
    EXPECT_EQ(parts_of("<rect x='20' y='15' width='20' height='30' style='transform:rotate(90deg);"
                       "transform-origin:30px 30px'/>"),
              parts_of("<rect x='15' y='20' width='30' height='20'/>"));
    EXPECT_EQ(parts_of("<rect x='5' width='30' height='20' style='width:auto'/>"),
              parts_of("<rect x='5' width='30' height='20'/>"));
}

TEST(DrawingPlaces, TheRootHasItsSizeInItsStyle) {
    const std::string body = "<path fill='none' stroke='red' d='M1 1h4v4h-4z'/></svg>";
    const auto of = [&](const std::string& size) {
        const auto reading = read_drawing("<svg " + size + " viewBox='0 0 10 10'>" + body);
        return reading.list ? bounds(reading.part()).max.x : -1.0;
    };
    EXPECT_NEAR(of("style='width:100mm;height:100mm'"), 50.0, 1e-6);
    for (const std::string style : {"width:100%;height:auto", "width:100vw;height:100vh",
                                    "width:calc(100% - 1px)", "width:fit-content;max-width:1rem"})
        EXPECT_NEAR(of("width='20mm' style='" + style + "'"), 10.0, 1e-6) << style;
}

TEST(DrawingPlaces, OriginsAreReadInAllTheirSpellings) {
    using drawing::parse_origin;
    const Vec2 view{100, 80};
    const std::vector<std::pair<std::string, Vec2>> all{{"10 20", {10, 20}},
                                                        {"10,20", {10, 20}},
                                                        {"10px 1in", {10, 96}},
                                                        {"center", {50, 40}},
                                                        {"left", {0, 40}},
                                                        {"top", {50, 0}},
                                                        {"bottom right", {100, 80}},
                                                        {"25% 50%", {25, 40}},
                                                        {"right 10px", {100, 10}},
                                                        {"top 10px", {10, 0}},
                                                        {"10px bottom 3px", {10, 80}},
                                                        {"center left", {0, 40}}};
    for (const auto& [text, wanted] : all) {
        const auto read = parse_origin(text, view);
        ASSERT_TRUE(read) << text;
        EXPECT_EQ(*read, wanted) << text;
    }
    for (const std::string text : {"", "left left", "top bottom", "1 zz", "a"})
        EXPECT_FALSE(parse_origin(text, view)) << text;
}

TEST(DrawingPlaces, WhatIsNotReadIsTold) {
    EXPECT_EQ(parts_of("<rect width='30' height='20' style='rotate:45deg'/>").substr(0, 18),
              "2:1 style-ignored\n");
    const std::string rect = "<rect width='30' height='20'/>";
    // What CSS has beyond lengths leaves the attributes as they are.
    for (const std::string style :
         {"transform:matrix3d(1)", "transform:translate(50%)", "width:calc(1px + 1mm)", "height:50vh",
          "transform:scale(1);transform-origin:calc(1px) 0", "d:none;x:1rem"}) {
        EXPECT_EQ(parts_of("<rect width='30' height='20' style='" + style + "'/>"),
                  "2:1 style-ignored\n" + parts_of(rect))
            << style;
    }
    for (const std::string style :
         {"transform:initial", "transform:none", "transform:unset", "transform:translateZ(0)",
          "transform:translate3d(0,0,0)", "scale:1;rotate:0deg;translate:none", "transform-box:fill-box",
          "transform:scale(1);transform-origin:inherit", "--w:30px;width:var(--w)", "x:var(--no, 0px)"}) {
        EXPECT_EQ(parts_of("<rect width='30' height='20' style='" + style + "'/>"), parts_of(rect)) << style;
    }
    EXPECT_EQ(
        parts_of(
            "<rect width='30' height='20' transform='translate(5)' style='transform:perspective(9px)'/>"),
        "2:1 style-ignored\n" + parts_of("<rect x='5' width='30' height='20'/>"));
    EXPECT_EQ(parts_of("<rect width='30' height='20' transform='turn(5)'/>"), "2:30 bad-transform\n");
    EXPECT_EQ(parts_of("<style>svg rect{x:30px}</style><rect width='30' height='20'/>"),
              "1:1 style-ignored\n" + parts_of(rect));
    EXPECT_EQ(parts_of("<rect width='30' height='20' style='transform-box:view-box;scale:none'/>"),
              parts_of("<rect width='30' height='20'/>"));
    for (const std::string sheet :
         {"<style>@import url('a.css');</style>", "<style>.g{fill:none;.b{stroke:red}}</style>"})
        EXPECT_EQ(parts_of(sheet + "<rect width='30' height='20'/>").substr(0, 18), "1:1 style-ignored\n")
            << sheet;
    const auto linked = read_drawing(
        "<?xml-stylesheet href='a.css'?><svg width='9mm' height='9mm'>"
        "<path stroke='red' d='M0 0h9v9z'/></svg>");
    EXPECT_EQ(linked.codes(), "1:32 style-ignored\n");
}

TEST(DrawingPlaces, SheetsForOthersSayNothingAndAreTold) {
    const std::string plain = parts_of("<rect width='30' height='20'/>");
    for (const std::string other : {"media='print'", "type='text/less'"}) {
        EXPECT_EQ(parts_of("<style " + other + ">rect{display:none}</style><rect width='30' height='20'/>"),
                  "1:1 style-ignored\n" + plain);
    }
    for (const std::string ours : {"type='text/css' media='screen, print'", "media='screen and (color)'"})
        EXPECT_EQ(parts_of("<style " + ours + ">rect{width:30px}</style><rect height='20'/>"), plain);
}

TEST(DrawingPlaces, ASwitchDrawsTheFirstThatHolds) {
    const std::string small = "<rect width='10' height='10'/>";
    const std::string large = "<rect width='30' height='20'/>";
    const auto with = [](const std::string& condition, const std::string& shape) {
        return "<g " + condition + ">" + shape + "</g>";
    };
    const std::string hidden = "hidden-shape\n";
    EXPECT_EQ(parts_of("<switch>" + large + small + "</switch>"), parts_of(large));
    EXPECT_EQ(parts_of("<switch>" + with("systemLanguage='de, fr'", small) +
                       with("systemLanguage='fr,en-GB'", large) + small + "</switch>"),
              "2:9 " + hidden + parts_of(large));
    EXPECT_EQ(
        parts_of("<switch><foreignObject requiredExtensions='http://ns.adobe.com/AdobeIllustrator/10.0/' "
                 "width='1' height='1'/>" +
                 with("", large) + "</switch>"),
        parts_of(large));
    EXPECT_EQ(parts_of(large + with("systemLanguage='de'", small)), "2:31 " + hidden + parts_of(large));
    // Each use of it anew.
    EXPECT_EQ(parts_of("<switch id='s'>" + small + large + "</switch><use href='#s' x='50'/>"),
              parts_of(small + "<rect x='50' width='10' height='10'/>"));
}

TEST(DrawingPlaces, AUseSaysHowLargeASvgIs) {
    const std::string defs =
        "<defs><svg id='s' width='20' height='15' viewBox='0 0 40 30'><rect width='40' "
        "height='30'/></svg></defs>";
    EXPECT_EQ(parts_of(defs + "<use href='#s' x='5'/>"), parts_of("<rect x='5' width='20' height='15'/>"));
    EXPECT_EQ(parts_of(defs + "<use href='#s' x='5' width='60' height='45'/>"),
              parts_of("<rect x='5' width='60' height='45'/>"));
    EXPECT_EQ(parts_of("<svg width='0'><rect width='9' height='9'/></svg><rect width='30' height='20'/>"),
              parts_of("<rect width='30' height='20'/>"));
}

TEST(DrawingPlaces, WhatCannotBeSeenIsNotCut) {
    const std::string seen = "<rect width='50' height='50'/>";
    for (const std::string unseen : {"opacity='0'", "stroke-opacity='0'", "stroke='rgba(1,2,3,0)'",
                                     "stroke='#0000'", "stroke='rgb(1 2 3 / 0%)'"}) {
        EXPECT_EQ(parts_of(seen + "<rect fill='none' x='60' width='9' height='9' " + unseen + "/>"),
                  parts_of(seen))
            << unseen;
    }
    EXPECT_EQ(parts_of(seen + "<g opacity='0'><rect x='60' width='9' height='9'/></g>"), parts_of(seen));
    EXPECT_NE(parts_of(seen + "<rect fill='none' x='60' width='9' height='9' opacity='.01'/>"),
              parts_of(seen));
}

TEST(DrawingPlaces, OnlyFillsInAColourArePrinted) {
    const auto of = [](const std::string& fill) {
        const auto reading =
            read_drawing(drawing("<rect width='50' height='50'/><rect stroke='none' x='10' y='10' "
                                 "width='9' height='9' " +
                                 fill + "/>"));
        return reading.codes() + std::to_string(reading.list ? reading.part().fills.size() : 99);
    };
    EXPECT_EQ(of("fill='#ff0'"), "1");
    EXPECT_EQ(of("fill='url(#g)'"), "2:31 fill-not-printed\n0");
    EXPECT_EQ(of("fill='lab(1 2 3)'"), "2:31 fill-not-printed\n0");
    EXPECT_EQ(of("fill='#ff0' fill-opacity='0'"), "0");
    // Nobody prints contours.
    EXPECT_EQ(
        read_drawing("<svg width='90mm' height='90mm'><rect width='50' height='50' fill='url(#g)'/></svg>")
            .codes(),
        "");
    EXPECT_EQ(of("fill='#ffff0000'"), "0");
}

TEST(DrawingPlaces, AGroupSaysHowFarItsFoldsGo) {
    const auto angles = [](const std::string& fold) {
        CompileOptions options;
        options.read.drawing.as = DrawnAs::folded;
        options.until = Stage::design;
        const std::string text =
            "<svg width='100mm' height='100mm' viewBox='0 0 100 100' fill='none'>"
            "<path stroke='#000' d='M0 0H100V100H0Z'/>" +
            fold + "</svg>";
        const CompiledDesign one = compile({Source{"a.svg", text}}, options, {}).designs.front();
        std::string made;
        for (const Diagnostic& told : one.diagnostics.sorted()) {
            if (told.severity == Severity::error) made += std::string(told.code) + " ";
        }
        if (!one.creases) return made;
        for (const CreaseLine& line : one.creases->lines) {
            if (line.use != CreaseUse::cut)
                made += line.fold_deg ? std::to_string(static_cast<int>(*line.fold_deg)) + " " : "- ";
        }
        return made;
    };
    const std::string line = "<path stroke='#0000ff' stroke-dasharray='3' d='M50 0V100' ";
    EXPECT_EQ(angles("<g data-fold-angle='60'>" + line + "/></g>"), "60 ");
    EXPECT_EQ(angles("<g data-fold-angle='60'><g data-fold-angle='30'>" + line + "/></g></g>"), "30 ");
    EXPECT_EQ(angles("<g data-fold-angle='60'><g data-fold-angle='auto'>" + line + "/></g></g>"), "- ");
    EXPECT_EQ(angles("<g data-fold-angle='60'>" + line + "data-fold-angle='45'/></g>"), "45 ");
    EXPECT_EQ(angles("<defs>" + line + "id='l'/></defs><use href='#l' data-fold-angle='20'/>"), "20 ");
    EXPECT_EQ(angles("<g data-fold-angle='60 20'>" + line + "/></g>"), "bad-number ");
}

}  // namespace
}  // namespace popup
