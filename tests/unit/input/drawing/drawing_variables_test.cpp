// Custom properties of CSS, and var(), held against what the specification and browsers make of them.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "input/drawing/style.h"
#include "input/drawing/variables.h"
#include "popup/language.h"
#include "support/drawings.h"

namespace popup {
namespace {

using drawing::Variables;
using drawing::VariableTexts;
using test::drawing;
using test::read_drawing;

// What a value says with these variables; "-" where it says nothing.
std::string said(const VariableTexts& declared, const std::string& text) {
    return Variables().within(declared).put_into(text).value_or("-");
}

TEST(DrawingVariables, ArePutIntoValues) {
    const VariableTexts set{{"--a", "1"}, {"--b", "var(--a) 2"}, {"--empty", ""}, {"--A", "other"}};
    EXPECT_EQ(said(set, "red"), "red");
    EXPECT_EQ(said(set, "var(--a)"), "1");
    EXPECT_EQ(said(set, "VAR( --a )"), "1");
    EXPECT_EQ(said(set, "var(--b) var(--a)"), "1 2 1");
    EXPECT_EQ(said(set, "rgb(var(--a) 0 0)"), "rgb(1 0 0)");
    EXPECT_EQ(said(set, "var(--A)"), "other");  // names have case
    EXPECT_EQ(said(set, "var(--empty)"), "");
    EXPECT_EQ(said(set, "no-var(--a) 'var(--a)'"), "no-var(--a) 'var(--a)'");
}

TEST(DrawingVariables, HaveFallbacks) {
    const VariableTexts set{{"--a", "1"}, {"--lost", "var(--x)"}};
    EXPECT_EQ(said(set, "var(--x)"), "-");
    EXPECT_EQ(said(set, "var(--x, blue)"), "blue");
    EXPECT_EQ(said(set, "var(--a, blue)"), "1");
    EXPECT_EQ(said(set, "var(--x, var(--y, var(--a)))"), "1");
    EXPECT_EQ(said(set, "var(--x, var(--y))"), "-");
    EXPECT_EQ(said(set, "var(--x, 3, 1)"), "3, 1");  // what stands behind the first comma
    EXPECT_EQ(said(set, "var(--x, rgb(1, 2, 3))"), "rgb(1, 2, 3)");
    EXPECT_EQ(said(set, "var(--x,)"), "");
    // One that names what is not set is not set itself.
    EXPECT_EQ(said(set, "var(--lost, blue)"), "blue");
    for (const char* text : {"var(", "var()", "var(a)", "var(--)", "var(--a", "var(--x, (", "var(--a b)"})
        EXPECT_EQ(said(set, text), "-") << text;
}

TEST(DrawingVariables, ThatNeedThemselvesAreNotSet) {
    const VariableTexts set{{"--self", "var(--self)"},    {"--self2", "var(--self2, red)"},
                            {"--p", "var(--q)"},          {"--q", "var(--r, red)"},
                            {"--r", "var(--p)"},          {"--behind", "var(--p, green)"},
                            {"--x", "var(--y) var(--w)"}, {"--y", "var(--x)"},
                            {"--w", "var(--y, red)"}};
    for (const char* name : {"--self", "--self2", "--p", "--q", "--r", "--x", "--y", "--w"})
        EXPECT_EQ(said(set, std::string("var(") + name + ", blue)"), "blue") << name;
    // What only leads to a circle is in none.
    EXPECT_EQ(said(set, "var(--behind)"), "green");
}

TEST(DrawingVariables, AreInherited) {
    const Variables root = Variables().within({{"--a", "1"}, {"--b", "var(--a)"}, {"--c", "3"}});
    const Variables below = root.within({{"--a", "2"}, {"--c", "initial"}});
    EXPECT_EQ(below.put_into("var(--a)").value_or("-"), "2");
    // What it was made of holds where it was declared.
    EXPECT_EQ(below.put_into("var(--b)").value_or("-"), "1");
    EXPECT_EQ(below.put_into("var(--c)").value_or("-"), "-");
    EXPECT_EQ(root.put_into("var(--c)").value_or("-"), "3");
    EXPECT_EQ(below.within({{"--a", "inherit"}}).put_into("var(--a)").value_or("-"), "2");
    EXPECT_EQ(below.within({{"--a", "Unset"}}).put_into("var(--a)").value_or("-"), "2");
    // A circle hides what is inherited.
    EXPECT_EQ(below.within({{"--a", "var(--a)"}}).put_into("var(--a)").value_or("-"), "-");
}

TEST(DrawingVariables, ThatGrowWithoutEndAreNotSet) {
    VariableTexts set{{"--v0", "1 2 3 4 5 6 7 8"}};
    for (int i = 1; i < 60; ++i) {
        const std::string before = "var(--v" + std::to_string(i - 1) + ")";
        set["--v" + std::to_string(i)] = before + before;
    }
    EXPECT_EQ(said(set, "var(--v3)").size(), 8U * 15U);
    EXPECT_EQ(said(set, "var(--v59)"), "-");
    constexpr std::size_t kDeep = 100'000;
    std::string deep;
    for (std::size_t i = 0; i < kDeep; ++i) deep += "var(--n,";
    deep += "1" + std::string(kDeep, ')');
    EXPECT_EQ(said(set, deep), "-");
}

Color color_of(const std::string& shapes) {
    Diagnostics diagnostics;
    const auto tracing = drawing::read_tracing({"drawing.svg", drawing(shapes)}, {}, diagnostics);
    return tracing && !tracing->lines.empty() ? tracing->lines.back().color : Color{1, 2, 3};
}

TEST(DrawingVariables, HoldInAllOfTheCascade) {
    const Color blue{0, 0, 255};
    const std::string line = "<path fill='none' d='M0 0h5v5z' ";
    EXPECT_EQ(color_of("<style>:root{--f:blue}path{stroke:var(--f)}</style>" + line + "/>"), blue);
    EXPECT_EQ(color_of("<style>svg{--f:#00f}.v{stroke:var(--f)}</style>" + line + "class='v'/>"), blue);
    EXPECT_EQ(color_of("<style>*{--f:red}.v{--f:blue}</style>" + line + "class='v' stroke='var(--f)'/>"),
              blue);
    EXPECT_EQ(color_of(line + "style='--f: blue; stroke: var(--f)'/>"), blue);
    EXPECT_EQ(color_of("<g style='--f:blue'>" + line + "stroke='var(--f)'/></g>"), blue);
    EXPECT_EQ(color_of("<g style='--f:blue' stroke='var(--f)'>" + line + "style='--f:red'/></g>"), blue);
    EXPECT_EQ(color_of("<style>.v{--f:red}</style><g style='--f:green'>" + line +
                       "class='v' style='--f:blue;stroke:var(--f)'/></g>"),
              blue);
    EXPECT_EQ(color_of("<style>.v{--f:blue!important}</style>" + line +
                       "class='v' style='--f:red;stroke:var(--f)'/>"),
              blue);
    EXPECT_EQ(color_of(line + "color='blue' style='--f:currentColor;stroke:var(--f)'/>"), blue);
    EXPECT_EQ(
        color_of("<defs>" + line + "id='p' stroke='var(--f)'/></defs><use href='#p' style='--f:blue'/>"),
        blue);
    EXPECT_EQ(color_of(line + "style='--h:240;stroke:hsl(var(--h) 100% 50%)'/>"), blue);
    EXPECT_EQ(color_of(line + "style=\"--i:url('data:a;b');stroke:blue\"/>"), blue);
    // Without a value it is the inherited one, fallback or not.
    EXPECT_EQ(color_of("<g stroke='blue'>" + line + "stroke='var(--none)'/></g>"), blue);
    EXPECT_EQ(color_of("<g stroke='blue'>" + line + "style='stroke:unset'/></g>"), blue);
    EXPECT_EQ(color_of("<g stroke='blue'>" + line + "style='stroke:INHERIT'/></g>"), blue);
}

TEST(DrawingVariables, HoldForDashesAndWidths) {
    Diagnostics diagnostics;
    const auto tracing = drawing::read_tracing(
        {"drawing.svg",
         drawing("<style>:root{--dash:3 1;--w:.5}</style><path fill='none' stroke='red' "
                 "stroke-dasharray='var(--dash)' stroke-width='var(--w, 2)' d='M0 0h5v5z'/>"
                 "<g stroke-dasharray='2'><path fill='none' stroke='red' "
                 "style='stroke-dasharray:initial;stroke-width:var(--n,2)' d='M0 0h5v5z'/></g>")},
        {}, diagnostics);
    ASSERT_TRUE(tracing && tracing->lines.size() == 2);
    EXPECT_GT(tracing->lines[0].dash_mm, 0.0);
    EXPECT_EQ(tracing->lines[1].dash_mm, 0.0);
    EXPECT_DOUBLE_EQ(4.0 * tracing->lines[0].width_mm, tracing->lines[1].width_mm);
}

TEST(DrawingVariables, ThatAreNotSetAreToldOf) {
    const auto reading =
        read_drawing(drawing("\n<g stroke='none'><rect width='5' height='5' stroke='var(--fold)'/></g>"
                             "\n<rect width='4' height='4' stroke='red' stroke-dasharray='var(--dash)'/>"
                             "\n<rect width='3' height='3' stroke='red' stroke-dasharray='var(--dash)'/>"));
    EXPECT_EQ(reading.codes(), "3:18 color-not-read\n4:1 style-ignored\n");
    ASSERT_EQ(reading.findings.size(), 2U);
    EXPECT_EQ(
        reading.findings[0].message,
        "1 shape is drawn in \"var(--fold)\", which is not set in this drawing; that is taken for black, "
        "in which lines are cut");
    EXPECT_EQ(reading.findings[1].message,
              "the variable --dash is not set where 2 values need it, so these are left out");
}

TEST(DrawingVariables, OfTooManyElementsAreRefused) {
    std::string rule = "<style>.a{";
    for (int i = 0; i < 2000; ++i) rule += "--v" + std::to_string(i) + ":1;";
    rule += "}</style>";
    for (int i = 0; i < 600; ++i) rule += "<g class='a'/>";
    const auto reading = read_drawing(drawing(rule));
    ASSERT_EQ(reading.findings.size(), 1U);
    EXPECT_EQ(reading.findings[0].code, "document-too-large");
}

}  // namespace
}  // namespace popup
