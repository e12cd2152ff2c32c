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

// A piece between two dashed lines belongs to both, and leaves no hole in the fold.
TEST(Dashes, BetweenTwoDashedLinesAreOfBoth) {
    const std::string other = "<path stroke-dasharray='4 2' d='M86 50H98'/>";
    const std::string told =
        " [1 short solid line a gap behind the end of a dashed line is taken for a dash of it]";
    const std::string piece = "<path d='M82 50H84'/>";
    EXPECT_EQ(lines_of(kDashed + piece + other), "dashed 20,50 84,50; dashed 84,50 98,50" + told);
    EXPECT_EQ(lines_of(other + "<path d='M84 50H82'/>" + kDashed),
              "dashed 82,50 98,50; dashed 20,50 82,50" + told);
    // Of two that lie on each other, the second ends where it is drawn.
    EXPECT_EQ(lines_of(kDashed + kDashed + piece), "dashed 20,50 84,50; dashed 20,50 80,50" + told);
}

// What else is drawn around a piece does not matter, nor in what order.
TEST(Dashes, AreFoundAmongManyOtherLines) {
    const std::string pieces = "<path d='M16 50H18'/><path d='M82 50H84'/>";
    const std::string joined = "dashed 16,50 84,50";
    const auto around = [&](const std::string& pen, double long_mm) {
        std::string text;
        for (int i = 0; i < 200; ++i)
            text += fmt::format("<path {} d='M81.5 {:.3f}h{}'/>", pen, 50.5 + i * 0.01, long_mm);
        return text;
    };
    for (const std::string& other : {around("stroke='#00f'", 1.0), around("stroke-width='3'", 1.0),
                                     around("class='cut'", 1.0), around("", 9.0)}) {
        EXPECT_NE(lines_of(other + kDashed + pieces).find(joined), std::string::npos) << other;
        EXPECT_NE(lines_of(kDashed + pieces + other).find(joined), std::string::npos) << other;
    }
    // A coarse line elsewhere, in another colour, crowds nothing.
    const std::string fine = "<path stroke-dasharray='.4 .2' d='M20 50H80'/><path d='M80.2 50h.2'/>";
    const std::string coarse = "<path stroke='#00f' stroke-dasharray='15' d='M5 90H95'/>";
    std::string dots;
    for (int i = 0; i < 100; ++i) dots += fmt::format("<path d='M{} 45v.2'/>", 78.0 + 0.04 * i);
    for (const std::string& all : {dots + fine + coarse, coarse + fine + dots})
        EXPECT_NE(lines_of(all).find("dashed 20,50 80.4,50"), std::string::npos) << all.size();
}

// Where so many may be pieces, none is, whichever comes first.
TEST(Dashes, AreNotToldFromHatching) {
    std::string hatching;
    for (int i = 0; i < 100; ++i) hatching += fmt::format("<path d='M{} 50.5v1'/>", 81.5 + 0.01 * i);
    const std::string piece = "<path d='M82 50H84'/>";
    EXPECT_NE(lines_of(hatching + kDashed + piece).find("dashed 20,50 80,50"), std::string::npos);
    EXPECT_NE(lines_of(kDashed + piece + hatching).find("dashed 20,50 80,50"), std::string::npos);
}

// Gaps of a dash array can be next to nothing; nothing is within one then.
TEST(Dashes, WithoutGapsToSpeakOfHaveNoPieces) {
    EXPECT_EQ(lines_of("<path stroke-dasharray='4 1e-20' d='M20 50H80'/><path d='M80 50H82'/>"),
              kAlone + "80,50 82,50");
    EXPECT_EQ(lines_of("<path stroke-dasharray='4 1e-300' d='M20 50H80'/><path d='M82 50H84'/>"),
              kAlone + "82,50 84,50");
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
