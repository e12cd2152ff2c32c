// Programs that ask for a card that cannot be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "popup/diagnostics.h"
#include "support/designs.h"

namespace popup {
namespace {

Reading run(const std::string& program, Diagnostics& diagnostics) {
    return read_source_text({"card.fl", program}, {}, diagnostics);
}

// "12:3 message (hint)" of the only finding.
std::string complaint(const std::string& program) {
    Diagnostics diagnostics;
    const Reading reading = run(program, diagnostics);
    EXPECT_FALSE(reading.design) << program;
    const auto all = diagnostics.sorted();
    EXPECT_EQ(all.size(), 1U) << program << "\n" << test::findings(diagnostics);
    if (all.empty()) return {};
    EXPECT_EQ(all[0].code, "flatlang-runtime");
    std::string text = fmt::format("{}:{} {}", all[0].place.line, all[0].place.column, all[0].message);
    for (const std::string& hint : all[0].hints) text += " (" + hint + ")";
    return text;
}

TEST(FlatLangCardErrors, WhatCannotBeIsSaidWhereItIsCalled) {
    struct Wrong {
        std::string program, says;
    };
    const std::string hint =
        " (the gutter is the .gutter of what popup() returns; an element has the folds .left, .centre and "
        ".right)";
    const std::vector<Wrong> table{
        {"popup()\n popup(8, 6)",
         "2:2 popup() was called before, on line 1 (a program makes one card; write another program for "
         "another "
         "card)"},
        {"step(1, [0, 0])", "1:1 step() has no card to go to (call popup() before it)"},
        {"named(1, \"a\")", "1:1 named() has no card to go to (call popup() before it)"},
        {"drawline(0, [0, 0], [1, 1])", "1:1 drawline() has no card to go to (call popup() before it)"},
        {"popup(8)", "1:1 popup() has a width and no height (popup(11, 8.5) is a sheet of letter paper)"},
        {"popup(nil)", "1:7 argument 1 of popup() is nil, where the page's width is expected"},
        {"popup(8, 6, 7)", "1:13 argument 3 of popup() is a number, where a colour is expected"},
        {"popup(8, -6)", "1:1 popup() is -6 inches high, and must be from 0.0393701 to 393.701"},
        {"popup(infinity, 6)", "1:1 popup() is inf inches wide, and must be from 0.0393701 to 393.701"},
        {"popup(8, 6, \"whit\")",
         "1:13 argument 3 of popup() is \"whit\", which is not a colour (perhaps 'white' is meant)"},
        {"popup(\"red\", \"red\", \"red\")",
         "1:1 popup() has more than two colours, of the page's left and right half"},
        {"popup() step(7, [0, 0])",
         "1:14 argument 1 of step() is a number, where a fold to stand on is expected" + hint},
        {"c = popup() step([0, 0], [1, 1])",
         "1:18 argument 1 of step() is a list, where a fold to stand on is expected" + hint},
        {"c = popup()\ns = step(c, [-1, 0], [-1, 1])\nbeak(s, [0, 0], [-0.5, 0.5])",
         "3:1 beak() is given an element to stand on, where one of its folds is expected" + hint},
        {"beak(popup(), [0, 1])",
         "1:1 beak() has 3 points, A, B (left), E (right), and 1 is given (of an even one give A, B alone: "
         "the "
         "right side then mirrors the left)"},
        {"tent(popup())",
         "1:1 tent() has 8 points, A (left), B (left), E (right), F (right), and on its own page G (left), H "
         "(left), K (right), L (right), and 0 are given (of an even one give A, B, G, H alone: the right "
         "side "
         "then mirrors the left)"},
        {"beak(popup(), [0, 1, 2], [-1, 0])",
         "1:15 argument 2 of beak() is a list of 3 numbers, where a point [x, y] is expected"},
        {"beak(popup(), [0, 1], [\"1\", 0])",
         "1:23 argument 3 of beak() has a text in a point, where numbers are expected (a point is [x, y], in "
         "inches)"},
        {"beak(popup(), [0, 1], [nil, 0])",
         "1:23 argument 3 of beak() has nil in a point, where numbers are expected (a point is [x, y], in "
         "inches)"},
        {"up() pitch(90) forward(1) beak(popup(), pos(), [-1, 0])",
         "1:27 beak() has a point 1 inches above the page in argument 2 (points of a card lie in its pages, "
         "where "
         "z is 0)"},
        {"beak(popup(), [0, 1], [-1, 0], 5)",
         "1:32 argument 4 of beak() is a number, where a point or a colour is expected (the points are A, B "
         "(left), "
         "E (right))"},
        {"beak(popup(), [0, 1], [-1, 0], \"red\", [1, 0])",
         "1:39 argument 5 of beak() is a list, where a colour is expected (the points are A, B (left), E "
         "(right))"},
        {"beak(popup(), [0, 1], [-1, 0], \"red\", \"red\", \"red\", \"red\", \"red\")",
         "1:1 beak() has more than four colours, of its left and right half and of their tabs"},
        {"beak(popup(), [0, 100000], [-1, 0])",
         "1:1 beak() has the point [0, 100000]; coordinates are at most 39370.1 inches"},
        {"x = sqrt(-1) beak(popup(), [0, x], [-1, 0])",
         "1:14 beak() has a point whose coordinate is not a number"},
        {"c = popup() painted(c, \"red\")",
         "1:21 argument 1 of painted() is an object, where an element of the card is expected"},
        {"painted(beak(popup(), [0, 1], [-1, 0]), 1)",
         "1:41 argument 2 of painted() is a number, where a colour is expected"},
        {"c = popup() named(c, \"a\")",
         "1:19 argument 1 of named() is an object, where an element of the card is expected"},
        {"e = beak(popup(), [0, 1], [-1, 0]) named(e, 3)",
         "1:45 argument 2 of named() is a number, where its name, a text, is expected"},
        {"e = beak(popup(), [0, 1], [-1, 0]) named(e, \"a b\")",
         "1:36 named() cannot give the name 'a b' (an id begins with a letter from A to Z or a to z, or "
         "\"_\", and goes on with such letters, digits, \"_\", \".\" and \"-\")"},
        {"e = beak(popup(), [0, 1], [-1, 0]) named(e, \"page\")",
         "1:36 named() cannot give the name 'page', which is kept for the base page"},
        {"e = beak(popup(), [0, 1], [-1, 0]) named(e, \"a\", 0.5)",
         "1:50 argument 3 of named() is a number, where a whole number, which is joined to the name, is "
         "expected"},
        {"c = popup() repeat (2) named(beak(c, [0, 1], [-1, 0]), \"a\") done",
         "1:24 named() cannot give the name 'a', which another element has (in a loop or function give a "
         "number "
         "besides, as in named(house, \"house\", 3) for house-3)"},
        {"c = popup() drawline(c, [0, 0])", "1:13 drawline() has at least 2 points, and 1 is given"},
        {"c = popup() drawline(nil, [0, 0], [1, 1])",
         "1:22 argument 1 of drawline() is nil, where the card, an element, a fold or a page's number is "
         "expected"},
        {"c = popup() drawline(1, [0, 0], [1, 1])",
         "1:13 drawline() is to draw on page 1, and the card has only page 0 so far (page 0 is the base "
         "page; each "
         "glued element adds one, its .page)"},
        {"c = popup() drawline(0.5, [0, 0], [1, 1])",
         "1:13 drawline() is to draw on page 0.5, and the card has only page 0 so far (page 0 is the base "
         "page; "
         "each glued element adds one, its .page)"},
        {"c = popup() drawline(c, [0, 0], [1, 1], -2)",
         "1:13 drawline() is -2 points thick, and must be from 0 to 1000"},
        {"c = popup() drawline(c, [0, 0], [1, 1], 2, 3)",
         "1:44 argument 5 of drawline() is a number, where a colour is expected (points come first, then one "
         "thickness and one colour)"},
        {"c = popup() drawline(c, [0, 0], [1, 1], \"red\", \"blue\")",
         "1:13 drawline() has more than one colour"},
        {"t = tent(popup(), [-1, -1], [-1, 1], [-2, -1], [-2, 1]) drawline(t.left, [-1, 0], [1, 0])",
         "1:57 drawline() crosses a seam, where one page ends and another begins (draw what lies on the left "
         "(x "
         "below 0) and on the right as two lines)"},
    };
    for (const Wrong& wrong : table) EXPECT_EQ(complaint(wrong.program), wrong.says) << wrong.program;
}

TEST(FlatLangCardErrors, SayWhichValueIsWrong) {
    EXPECT_EQ(complaint("c = popup(8, 6)\nbox(c, [-1, 0], [-1, 2], \"height\", \"tall\")"),
              "2:1 box() is given \"tall\" as height, where a length in inches is expected");
    EXPECT_EQ(complaint("c = popup(8, 6)\nbox(c, [-1, 0], [-1, 2], 1, \"ends\", \"up\")"),
              "2:1 box() is given \"up\" as ends, where one of in, out is expected");
    EXPECT_EQ(complaint("c = popup(8, 6)\nbox(c, [-1, 0], [-1, 2], \"height\")"),
              "2:1 box() ends with \"height\", which wants a value behind it");
}

TEST(FlatLangCardErrors, PointsThatMakeNoFoldsMakeAnElementWithoutThem) {
    EXPECT_EQ(
        complaint("c = popup()\ns = step(c, [0, 0], [0, 0])\nstep(s.left, [-1, 0], [-1, 1])"),
        "3:6 argument 1 of step() is nil, where a fold to stand on is expected (the gutter is the .gutter "
        "of what popup() returns; an element has the folds .left, .centre and .right)");
}

// A card is left as it was by a call that fails, and the program ends there.
TEST(FlatLangCardErrors, NothingIsMadeOfAProgramThatFails) {
    Diagnostics diagnostics;
    const Reading reading = run("c = popup() print(\"so far\") beak(c) print(\"no more\")", diagnostics);
    EXPECT_EQ(reading.printed, "so far\n");
    EXPECT_FALSE(reading.design);
    EXPECT_FALSE(reading.assembly);
    EXPECT_TRUE(diagnostics.has_errors());
}

}  // namespace
}  // namespace popup
