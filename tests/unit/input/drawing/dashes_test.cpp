// Dashed lines that a drawing has in pieces are whole; what only looks like a piece stays what it is.
#include "input/drawing/dashes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "input/drawing/read.h"
#include "support/drawings.h"

namespace popup {
namespace {

// "dashed 10,50 90,50; solid …": the open lines of a drawing, and what is told of joined ones.
std::string lines_of(const std::string& body) {
    Diagnostics diagnostics("drawing.svg");
    const auto tracing =
        drawing::read_tracing(Source{"drawing.svg", test::drawing(body)}, ReadOptions{}, diagnostics);
    if (!tracing) return "nothing";
    std::string text;
    for (const drawing::TracedLine& line : tracing->lines) {
        text += fmt::format("{}{}", text.empty() ? "" : "; ",
                            line.dash == drawing::Dash::none ? "solid" : "dashed");
        for (const Vec2 p : line.points) text += fmt::format(" {:g},{:g}", p.x, 100.0 - p.y);
    }
    for (const Diagnostic& one : diagnostics.sorted()) text += " [" + one.message + "]";
    return text;
}

// A dash of 4 mm and a gap of 2 mm.
const std::string kDashed = "<path stroke-dasharray='4 2' d='M20 50H80'/>";
const std::string kAlone = "dashed 20,50 80,50; solid ";

TEST(Dashes, OfALineThatIsDrawnInPiecesAreOneLine) {
    const std::string both =
        "dashed 16,50 84,50 [2 short solid lines a gap behind the end of a dashed line are taken for dashes "
        "of "
        "it]";
    EXPECT_EQ(lines_of(kDashed + "<path d='M16 50H18'/><path d='M82 50H84'/>"), both);
    // Whatever the direction of the pieces, and where they stand in the drawing.
    EXPECT_EQ(
        lines_of("<path d='M84 50H82'/><g><path d='M18 50.02H16'/></g>" + kDashed),
        "dashed 16,50.02 84,50 [2 short solid lines a gap behind the end of a dashed line are taken for "
        "dashes of it]");
    // A dash alone is as long as its gap.
    EXPECT_EQ(
        lines_of("<path stroke-dasharray='3' d='M20 50H80'/><path d='M83 50H86'/>"),
        "dashed 20,50 86,50 [1 short solid line a gap behind the end of a dashed line is taken for a dash "
        "of it]");
    // Lengths are those of the drawing, whatever its units.
    EXPECT_EQ(
        lines_of("<g transform='scale(10)' stroke-width='0.1'><path stroke-dasharray='.4 .2' d='M2 5H8'/>"
                 "<path d='M8.2 5H8.4'/></g>"),
        "dashed 20,50 84,50 [1 short solid line a gap behind the end of a dashed line is taken for a dash "
        "of it]");
}

TEST(Dashes, AroundACornerBelongToBothLines) {
    EXPECT_EQ(
        lines_of(kDashed + "<path stroke-dasharray='4 2' d='M84 54V80'/><path d='M82 50H84V52'/>"),
        "dashed 20,50 84,50; dashed 84,50 84,80 [2 short solid lines a gap behind the end of a dashed line "
        "are taken for dashes of it]");
    // Of a corner that one line only ends at, the other leg stays.
    EXPECT_EQ(
        lines_of(kDashed + "<path d='M82 50H84V52'/>"),
        "dashed 20,50 84,50; solid 84,50 84,52 [1 short solid line a gap behind the end of a dashed line "
        "is taken for a dash of it]");
}

TEST(Dashes, AreNoLinesThatAreElsewhereOrOtherwiseDrawn) {
    EXPECT_EQ(lines_of(kDashed + "<path d='M80 50H84'/>"), kAlone + "80,50 84,50");  // a slit at its end
    EXPECT_EQ(lines_of(kDashed + "<path d='M82 50H88'/>"), kAlone + "82,50 88,50");  // longer than a dash
    EXPECT_EQ(lines_of(kDashed + "<path d='M84 50H88'/>"), kAlone + "84,50 88,50");  // too far
    EXPECT_EQ(lines_of(kDashed + "<path d='M82 51H84'/>"), kAlone + "82,51 84,51");  // beside it
    EXPECT_EQ(lines_of(kDashed + "<path d='M82 50V52'/>"), kAlone + "82,50 82,52");  // across
    EXPECT_EQ(lines_of(kDashed + "<path d='M76 50H78'/>"), kAlone + "76,50 78,50");  // on it
    EXPECT_EQ(lines_of(kDashed + "<path class='cut' d='M82 50H84'/>"), kAlone + "82,50 84,50");
    EXPECT_EQ(lines_of(kDashed + "<path stroke='#00f' d='M82 50H84'/>"), kAlone + "82,50 84,50");
    EXPECT_EQ(lines_of(kDashed + "<path stroke-width='3' d='M82 50H84'/>"), kAlone + "82,50 84,50");
    EXPECT_EQ(lines_of(kDashed + "<path d='M82 50H83V51H84'/>"), kAlone + "82,50 83,50 83,51 84,51");
}

}  // namespace
}  // namespace popup
