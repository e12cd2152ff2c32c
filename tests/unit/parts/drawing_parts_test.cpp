// From the lines of a drawing to its parts: contours out of single lines, what lies in what, names, and
// sheets of our own read back.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "base/geometry/regions.h"
#include "output/svg.h"
#include "parts/contours.h"
#include "parts/joining.h"
#include "popup/compile.h"
#include "support/drawings.h"
#include "support/prints.h"
#include "support/random.h"
#include "support/run_program.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::area;
using test::drawing;
using test::popupc;
using test::read_drawing;
using test::ScratchDirectory;

constexpr double kPi = std::numbers::pi;
const fs::path kSamples = fs::path(POPUP_SOURCE_DIR) / "samples";

std::vector<std::string> names(const test::ReadDrawing& reading) {
    std::vector<std::string> all;
    for (const FlatPart& part : reading.parts()) all.push_back(part.name);
    return all;
}

using test::Random;

// --- joining

TEST(Joining, ContoursOfShuffledSingleLinesCloseWhateverTheirOrderAndDirection) {
    Random random(7);
    for (int round = 0; round < 50; ++round) {
        // Stars far from each other, each side one line whose ends are a little off.
        std::vector<drawing::OpenLine> lines;
        std::vector<double> areas;
        const std::size_t stars = 1 + random.below(6);
        for (std::size_t star = 0; star < stars; ++star) {
            const std::size_t corners = 3 + random.below(20);
            Ring ring;
            for (std::size_t i = 0; i < corners; ++i) {
                const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(corners);
                ring.push_back(Vec2{100.0 * static_cast<double>(star), 0.0} +
                               rotated({20.0 + 20.0 * random.unit(), 0.0}, angle));
            }
            areas.push_back(signed_area(ring));
            for (std::size_t i = 0; i < corners; ++i) {
                const auto off = [&](Vec2 p) {
                    return p + rotated({0.004 * random.unit(), 0.0}, 7.0 * random.unit());
                };
                drawing::OpenLine line{{off(ring[i]), off(ring[(i + 1) % corners])}, static_cast<int>(star)};
                if (random.below(2) == 0) std::swap(line.points[0], line.points[1]);
                lines.push_back(line);
            }
        }
        for (std::size_t i = lines.size(); i > 1; --i) std::swap(lines[i - 1], lines[random.below(i)]);
        const drawing::Joined joined = drawing::join_lines(std::move(lines));
        ASSERT_EQ(joined.lines.size(), stars);
        EXPECT_TRUE(joined.doubled.empty());
        for (std::size_t i = 0; i < stars; ++i) {
            ASSERT_TRUE(joined.lines[i].closed);
            EXPECT_NEAR(std::abs(signed_area(joined.lines[i].points)), areas[i], 2.0);
            EXPECT_EQ(joined.lines[i].elements, std::vector<int>{static_cast<int>(i)});
        }
    }
}

TEST(Joining, DeadEndsDoNotKeepAContourFromClosing) {
    // A square of four lines with a slit from each corner inwards, and one that goes on straight.
    std::vector<drawing::OpenLine> lines{
        {{{0, 0}, {10, 0}}, 0}, {{{10, 0}, {10, 10}}, 1}, {{{10, 10}, {0, 10}}, 2}, {{{0, 10}, {0, 0}}, 3},
        {{{0, 0}, {3, 3}}, 4},  {{{3, 3}, {4, 3}}, 5},    {{{10, 0}, {14, 0}}, 6},  {{{8, 8}, {10, 10}}, 7}};
    const drawing::Joined joined = drawing::join_lines(lines);
    std::vector<std::pair<bool, double>> made;
    for (const drawing::JoinedLine& line : joined.lines)
        made.emplace_back(line.closed, drawing::length_of(line.points));
    ASSERT_EQ(made.size(), 4U);
    EXPECT_TRUE(made[0].first);
    EXPECT_NEAR(made[0].second, 30.0, 1e-9);
    for (std::size_t i = 1; i < made.size(); ++i) EXPECT_FALSE(made[i].first);
    EXPECT_NEAR(made[1].second, std::sqrt(18.0) + 1.0, 1e-9);
}

TEST(Joining, LoopsThatMeetInAPointAreContoursOfTheirOwn) {
    const drawing::Joined joined = drawing::join_lines({{{{0, 0}, {10, 0}, {5, 5}}, 0},
                                                        {{{5, 5}, {0, 0}}, 1},
                                                        {{{5, 5}, {0, 10}, {10, 10}}, 2},
                                                        {{{10, 10}, {5, 5}}, 3}});
    ASSERT_EQ(joined.lines.size(), 2U);
    for (const drawing::JoinedLine& line : joined.lines) {
        EXPECT_TRUE(line.closed);
        EXPECT_NEAR(std::abs(signed_area(line.points)), 25.0, 1e-9);
    }
}

TEST(Joining, EndsFurtherApartThanTheToleranceStayApart) {
    EXPECT_FALSE(
        drawing::join_lines({{{{0, 0}, {10, 0}}, 0}, {{{10.03, 0}, {5, 5}, {0, 0}}, 1}}).lines[0].closed);
    EXPECT_TRUE(
        drawing::join_lines({{{{0, 0}, {10, 0}}, 0}, {{{10.015, 0}, {5, 5}, {0, 0}}, 1}}).lines[0].closed);
}

// --- contours

TEST(Contours, AreSortedByWhatTheyLieIn) {
    // Rings of squares in one another, in mixed order, and one beside.
    std::vector<ClosedLine> lines;
    const auto square = [&](double x, double y, double half) {
        lines.push_back(
            {{{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}},
             {static_cast<int>(lines.size())}});
    };
    square(0, 0, 10);
    square(0, 0, 40);
    square(0, 0, 20);
    square(100, 0, 5);
    square(0, 0, 30);
    square(35, 35, 2);
    Work work;
    const auto contours = sort_contours(lines, work);
    ASSERT_TRUE(contours);
    std::map<int, std::pair<int, int>> by_element;  // depth, and element of the root
    for (const ClosedContour& one : contours->all) {
        by_element[one.elements[0]] = {one.depth,
                                       contours->all[static_cast<std::size_t>(one.root)].elements[0]};
    }
    const std::map<int, std::pair<int, int>> expected{{0, {3, 1}}, {1, {0, 1}}, {2, {2, 1}},
                                                      {3, {0, 3}}, {4, {1, 1}}, {5, {1, 1}}};
    EXPECT_EQ(by_element, expected);
}

TEST(Contours, ThatTouchOrAreAHairOffDoNotOverlap) {
    const auto reading = read_drawing(
        drawing("<rect x='0' width='20' height='20'/><rect x='20' width='20' height='20'/>"
                "<rect x='39.995' width='20' height='20'/><rect x='30' y='20' width='20' height='20'/>"
                "<rect x='0' y='5' width='10' height='10'/><rect x='32' y='32.005' width='10' height='8'/>"));
    EXPECT_EQ(reading.codes(), "");
    ASSERT_EQ(reading.parts().size(), 4U);
    // A hole that shares an edge is a notch, and the shared edge is no longer one.
    EXPECT_NEAR(area(reading.part(0)), 300.0, 1e-3);
    EXPECT_EQ(reading.part(0).paper.size(), 1U);
    EXPECT_TRUE(reading.part(0).paper[0].holes.empty());
    EXPECT_EQ(reading.part(0).paper[0].outer.size(), 8U);
}

// A contour that pokes over the one it lies in, or over one beside it, is paper that nothing else has.
TEST(Contours, ThatPokeOverOthersByAHairKeepOffTheirPaper) {
    Random random(17);
    std::size_t regions = 0;
    for (int round = 0; round < 60; ++round) {
        // In a window of 40 x 40: islands over its lower edge, and over each other.
        const double poke = 0.001 + 0.008 * random.unit();
        const double angle = 360.0 * random.unit();
        const double x = 12.0 + 2.0 * random.unit();
        const auto island = [&](double from, double to, double low, double high) {
            return fmt::format("<path d='M{0:.4f} {2:.4f}H{1:.4f}V{3:.4f}H{0:.4f}Z'/>", from, to, low, high);
        };
        const auto reading = read_drawing(
            drawing(fmt::format("<g transform='translate(50 50) rotate({:.4f})'>{}{}{}{}</g>", angle,
                                island(0, 60, 0, 60), island(10, 50, 10, 50), island(x, x + 8, 10 - poke, 20),
                                island(x + 8 - poke, x + 20, 10 - poke, 25))));
        ASSERT_EQ(reading.parts().size(), 1U);
        const std::vector<Polygon>& paper = reading.part(0).paper;
        regions += paper.size();
        const double alone = area(reading.part(0));
        EXPECT_NEAR(popup::area(unite(paper)), alone, 1e-4) << round;
        // Each island is there, but for what it poked.
        EXPECT_NEAR(alone, 60.0 * 60.0 - 40.0 * 40.0 + 8.0 * 10.0 + 12.0 * 15.0, 0.5) << round;
    }
    EXPECT_EQ(regions, 180U);
}

TEST(Contours, ThatOverlapPartlyAreRefusedWithBothPlaces) {
    const auto reading =
        read_drawing(drawing("<rect width='20' height='20'/>\n<circle cx='20' cy='10' r='5'/>"));
    EXPECT_FALSE(reading.list);
    EXPECT_EQ(reading.codes(), "2:1 contours-overlap\n");
    EXPECT_NE(reading.findings[0].message.find("by 39.2"), std::string::npos) << reading.findings[0].message;
    ASSERT_EQ(reading.findings[0].related.size(), 1U);
    EXPECT_EQ(reading.findings[0].related[0].place, (Place{3, 1}));
    // A sliver as thin as rounding is none; a fiftieth of a millimetre more is one.
    EXPECT_TRUE(
        read_drawing(drawing("<rect width='20' height='20'/><rect x='19.98' width='20' height='20'/>")).list);
    EXPECT_FALSE(
        read_drawing(drawing("<rect width='20' height='20'/><rect x='19.96' width='20' height='20'/>")).list);
}

TEST(Contours, HolesThatOverlapAreOneHoleAndAWarning) {
    const auto reading =
        read_drawing(drawing("<rect width='50' height='50'/><rect x='10' y='10' width='20' height='10'/>"
                             "<rect x='20' y='10' width='20' height='10'/>"));
    EXPECT_EQ(reading.codes(), "2:31 holes-overlap\n");
    ASSERT_EQ(reading.parts().size(), 1U);
    EXPECT_NEAR(area(reading.part()), 2500.0 - 300.0, 1e-6);
    EXPECT_EQ(reading.part().paper[0].holes.size(), 1U);
}

TEST(Contours, ThatCrossThemselvesAreUnitedWithAWarning) {
    // A pentagram: by directions its middle is inside.
    const auto reading = read_drawing(drawing("<path d='M50 10L73.5 82.4L11.96 37.6H88.04L26.5 82.4Z'/>"));
    EXPECT_EQ(reading.codes(), "2:1 contour-crosses-itself\n");
    ASSERT_EQ(reading.parts().size(), 1U);
    EXPECT_EQ(reading.part().paper[0].outer.size(), 10U);
    EXPECT_TRUE(reading.part().paper[0].holes.empty());
    // A figure eight is two contours.
    const auto eight = read_drawing(drawing("<path d='M10 10L40 40V10L10 40Z'/>"));
    EXPECT_EQ(eight.codes(), "2:1 contour-crosses-itself\n");
    ASSERT_EQ(eight.parts().size(), 2U);
    EXPECT_NEAR(area(eight.part(0)) + area(eight.part(1)), 450.0, 1e-6);
    // One that only touches itself is as it is.
    EXPECT_EQ(read_drawing(drawing("<path d='M10 10H30V20H20V30H30V40H10Z'/>")).codes(), "");
}

TEST(Contours, DrawnTwiceAreCutOnce) {
    const std::string rect = "<rect x='5' y='5' width='30' height='20'/>";
    for (const std::string other :
         {"<rect x='5' y='5' width='30' height='20' fill='blue'/>", "<path d='M35 25H5V5H35Z'/>",
          "<path d='M35.005 25H5V15V5H35Z'/>", "<path d='M5 5V25M5 25H35M35 25V5M35 5H5'/>",
          "<path d='M5 15V25H20'/>"}) {
        const auto reading = read_drawing(drawing(rect + other));
        EXPECT_EQ(reading.codes().substr(4), " doubled-line\n") << other << reading.codes();
        ASSERT_TRUE(reading.list);
        ASSERT_EQ(reading.parts().size(), 1U) << other;
        EXPECT_NEAR(area(reading.part()), 600.0, 0.2);
        EXPECT_TRUE(reading.part().slits.empty()) << other;
    }
}

TEST(Contours, EdgesThatPartsOfSingleLinesShareAreNotLost) {
    // Two squares drawn with one line between them: one contour around both, and a cut that divides it.
    const auto reading =
        read_drawing(drawing("<path d='M10 10H30M30 10H50M50 10V30M50 30H30M30 30H10M10 30V10M30 10V30'/>"));
    ASSERT_TRUE(reading.list);
    ASSERT_EQ(reading.parts().size(), 1U);
    EXPECT_NEAR(area(reading.part()), 800.0, 1e-6);
    EXPECT_EQ(reading.part().slits.size(), 1U);
    EXPECT_EQ(reading.codes(), "2:1 part-divided\n");
}

// --- parts

TEST(Parts, AreTheOutermostContoursWithAllThatLiesInThem) {
    const auto reading =
        read_drawing(drawing("<circle id='rim' cx='30' cy='30' r='25'/><circle cx='30' cy='30' r='20'/>"
                             "<circle id='island' cx='30' cy='30' r='10'/><circle cx='30' cy='30' r='5'/>"
                             "<path d='M24 30H22'/><rect id='other' x='60' y='10' width='10' height='10'/>"));
    EXPECT_EQ(reading.codes(), "");
    EXPECT_EQ(names(reading), (std::vector<std::string>{"rim", "other"}));
    const FlatPart& rim = reading.part();
    ASSERT_EQ(rim.paper.size(), 2U);
    EXPECT_NEAR(area(rim), kPi * (625.0 - 400.0 + 100.0 - 25.0), 2.0);
    EXPECT_EQ(rim.slits.size(), 1U);
}

TEST(Parts, OpenLinesAreSlitsOfThePartsTheyLieIn) {
    const auto reading = read_drawing(
        drawing("<rect x='10' y='10' width='30' height='30'/><rect x='50' y='10' width='30' height='30'/>"
                "<path d='M20 20H30V25'/><line x1='10' y1='35' x2='20' y2='35'/>\n"
                "<path d='M30 30H60'/>\n<path d='M5 60H90'/>"));
    EXPECT_EQ(reading.codes(), "3:1 line-outside\n4:1 line-outside\n");
    ASSERT_EQ(reading.parts().size(), 2U);
    ASSERT_EQ(reading.part(0).slits.size(), 3U);
    ASSERT_EQ(reading.part(1).slits.size(), 1U);
    double length = 0.0;
    for (const auto& slit : reading.part(0).slits) length += drawing::length_of(slit);
    EXPECT_NEAR(length, 15.0 + 10.0 + 10.0, 0.05);
    EXPECT_NE(reading.findings[0].message.find("10.0"), std::string::npos) << reading.findings[0].message;
}

TEST(Parts, ThatACutDividesAreToldOf) {
    const std::string rect = "<rect x='10' y='10' width='30' height='30'/>";
    EXPECT_EQ(read_drawing(drawing(rect + "<path d='M10 20H40'/>")).codes(), "2:45 part-divided\n");
    EXPECT_EQ(read_drawing(drawing(rect + "<path d='M10 20H39'/>")).codes(), "");
    // From the rim to a hole is no division.
    EXPECT_EQ(read_drawing(drawing(rect + "<circle cx='25' cy='25' r='5'/><path d='M10 25H20'/>")).codes(),
              "");
    // A fold may well go from edge to edge.
    EXPECT_EQ(
        read_drawing(drawing(rect + "<path d='M10 20H40' stroke='#f0f' stroke-dasharray='2'/>")).codes(), "");
}

TEST(Parts, LinesThereAndBackAreSlits) {
    const auto reading = read_drawing(drawing("<rect width='30' height='30'/><path d='M5 5H20Z'/>"));
    EXPECT_EQ(reading.codes(), "");
    ASSERT_EQ(reading.parts().size(), 1U);
    EXPECT_EQ(reading.part().slits.size(), 1U);
}

TEST(Parts, AreNamedByElementLabelGroupOrNumber) {
    const auto reading = read_drawing(
        drawing("<rect id='lid' inkscape:label='x' width='5' height='5'/>"
                "<rect inkscape:label='a base &amp; more' x='10' width='5' height='5'/>"
                "<g id='sides'><rect x='20' width='5' height='5'/><rect x='30' width='5' height='5'/></g>"
                "<rect x='40' width='5' height='5'/><rect id='part-5' x='50' width='5' height='5'/>"
                "<g id='lines'><line x1='60' x2='65'/><path d='M65 0L60 5'/><path d='M60 5V0'/></g>"
                "<line x1='70' x2='75'/><path id='side' d='M75 0L70 5V0'/>"));
    EXPECT_EQ(reading.codes(), "");
    EXPECT_EQ(names(reading), (std::vector<std::string>{"lid", "a base & more", "sides", "sides~2",
                                                        "part-5~2", "part-5", "lines", "part-8"}));
}

TEST(Parts, PaintedShapesArePartsWhereNothingIsStroked) {
    const auto reading = read_drawing(
        "<svg width='100mm' height='100mm' viewBox='0 0 100 100'><path id='c' d='M10 10H40V40H10'/>"
        "<path id='ring' fill='red' fill-rule='evenodd' d='M50 10H80V40H50ZM60 20H70V30H60Z'/></svg>");
    EXPECT_EQ(reading.codes(), "");
    EXPECT_EQ(names(reading), (std::vector<std::string>{"c", "ring"}));
    EXPECT_NEAR(area(reading.part(1)), 800.0, 1e-6);
    EXPECT_TRUE(reading.part(1).fills.empty());  // the paint is the shape
    const auto mixed = read_drawing(
        "<svg width='100mm' height='100mm' viewBox='0 0 100 100'><rect fill='none' stroke='red' width='5' "
        "height='5'/>\n<path d='M10 10H40V40H10'/></svg>");
    EXPECT_EQ(mixed.codes(), "2:1 shape-outside\n");
    EXPECT_EQ(mixed.parts().size(), 1U);
}

TEST(Parts, ADrawingWithoutAContourIsAnError) {
    EXPECT_EQ(read_drawing(drawing("")).codes(), "0:0 no-contours\n");
    const auto open = read_drawing(drawing("<path d='M10 10H40V40H10'/>"));
    EXPECT_EQ(open.findings.at(0).code, "no-contours");
    ASSERT_EQ(open.findings[0].hints.size(), 2U);
    EXPECT_NE(open.findings[0].hints[1].find("30.00 mm wide"), std::string::npos);
    EXPECT_NE(open.findings[0].hints[0].find("1 open line"), std::string::npos);
    const auto invisible = read_drawing(drawing("<rect width='5' height='5' stroke='none'/>"));
    ASSERT_EQ(invisible.findings.at(0).hints.size(), 1U);
}

TEST(Parts, AFrameAroundAllIsRemarkedOn) {
    const auto reading =
        read_drawing(drawing("<rect width='100' height='100'/><rect x='10' y='10' width='5' height='5'/>"
                             "<rect x='20' y='10' width='5' height='5'/>"));
    EXPECT_EQ(reading.codes(), "2:1 page-frame\n");
    EXPECT_EQ(reading.parts().size(), 1U);
}

// Discs with holes in the manner of a sieve: as many, as large and as deep as can be said beforehand.
TEST(Parts, OfManyContoursHaveTheAreasTheyShould) {
    std::string body;
    for (int i = 0; i < 30; ++i) {
        for (int j = 0; j < 30; ++j) {
            const double x = 1.6 + 3.2 * i;
            const double y = 1.6 + 3.2 * j;
            body += fmt::format("<circle cx='{0}' cy='{1}' r='1.5'/><circle cx='{0}' cy='{1}' r='{2}'/>", x,
                                y, 0.5 + 0.01 * ((7 * i + 13 * j) % 50));
        }
    }
    const auto reading = read_drawing(drawing(body));
    EXPECT_EQ(reading.codes(), "");
    ASSERT_EQ(reading.parts().size(), 900U);
    for (const FlatPart& part : reading.parts()) {
        ASSERT_EQ(part.paper.size(), 1U);
        ASSERT_EQ(part.paper[0].holes.size(), 1U);
        const double hole = std::sqrt(std::abs(signed_area(part.paper[0].holes[0])) / kPi);
        EXPECT_NEAR(area(part), kPi * (2.25 - hole * hole), 0.1);
    }
}

TEST(Parts, WorkWithoutBoundInReasonIsRefused) {
    // Long lines to and fro across each other.
    std::string body;
    for (int i = 0; i < 20000; ++i) {
        body += fmt::format("<path d='M0 {}L100 {}L100 {}Z'/>", 0.001 * i, 100 - 0.001 * i, 99.9 - 0.001 * i);
    }
    const auto reading = read_drawing(drawing(body));
    EXPECT_FALSE(reading.list);
    EXPECT_EQ(reading.codes(), "0:0 document-too-large\n");
}

// --- as pieces

TEST(PartPattern, PiecesHaveCutsFromTheInsideOutAndTheirNames) {
    const auto reading = read_drawing(
        drawing("<rect id='plate' x='10' y='10' width='60' height='60'/><circle cx='40' cy='40' r='10'/>"
                "<circle cx='40' cy='40' r='5'/><path d='M15 15H25'/>"
                "<path d='M15 60H65M15 60H40' stroke='#f0f' stroke-dasharray='2'/>"));
    Diagnostics diagnostics;
    const auto pattern = make_pattern(assembly_of(*reading.list), {}, diagnostics);
    ASSERT_TRUE(pattern);
    const PatternPiece& piece = pattern->pieces.at(0);
    EXPECT_EQ(piece.name, "plate");
    ASSERT_EQ(piece.cuts.size(), 4U);
    const auto size = [](const Contour& cut) { return bounds(cut.points).width(); };
    EXPECT_NEAR(size(piece.cuts[0]), 10.0, 0.01);
    EXPECT_GT(signed_area(piece.cuts[0].points), 0.0);
    EXPECT_LT(signed_area(piece.cuts[1].points), 0.0);
    EXPECT_FALSE(piece.cuts[2].closed);
    EXPECT_NEAR(size(piece.cuts[3]), 60.0, 1e-6);
    EXPECT_TRUE(piece.cuts[3].closed);
    ASSERT_EQ(piece.lines.size(), 1U);  // nothing is folded twice
    EXPECT_EQ(piece.lines[0].kind, LineKind::valley);
    ASSERT_EQ(piece.labels.size(), 1U);
    EXPECT_EQ(piece.labels[0].text, "plate");
    EXPECT_TRUE(contains(piece.silhouette.at(0), piece.labels[0].at));
    EXPECT_EQ(piece.silhouette.size(), 2U);
    EXPECT_NEAR(piece.bounds.width(), 60.0, 1e-6);
}

// --- sheets of this program

// Every sample, compiled to sheets and read back: the same pieces, with the same paper, folds, cuts, colours
// and texts.
TEST(RoundTrip, SheetsOfEverySampleReadBackAreTheSamePieces) {
    CompileOptions options;
    options.motion.examine = false;
    int seen = 0;
    for (const auto& entry : fs::directory_iterator(kSamples)) {
        // Of a drawing pictures are not read.
        if (entry.path().extension() != ".xml" || entry.path().stem() == "harbour") continue;
        ++seen;
        SCOPED_TRACE(entry.path().filename().string());
        const Compilation run =
            compile({Source{entry.path().string(), test::read_file(entry.path())}}, options, {});
        ASSERT_TRUE(run.layout);
        std::map<std::string, const PatternPiece*> pieces;
        for (const PatternPiece& piece : run.layout->designs[0].pattern.pieces) pieces[piece.name] = &piece;
        Diagnostics diagnostics;
        const auto sheets = write_svg(*run.layout, {}, diagnostics);
        ASSERT_TRUE(sheets);
        std::size_t found = 0;
        for (const auto& [suffix, sheet] : *sheets) {
            const auto reading = read_drawing(sheet);
            EXPECT_EQ(reading.codes(), "");
            ASSERT_TRUE(reading.list);
            for (const FlatPart& part : reading.parts()) {
                ++found;
                ASSERT_TRUE(pieces.contains(part.name)) << part.name;
                const PatternPiece& piece = *pieces[part.name];
                double paper = 0.0;
                for (const Polygon& one : piece.silhouette) paper += popup::area(one);
                EXPECT_NEAR(area(part), paper, 0.05) << part.name;
                const auto drawn = [&](LineKind kind) {
                    double sum = 0.0;
                    for (const FlatLine& line : part.lines) {
                        if (line.kind == kind) sum += drawing::length_of(line.points);
                    }
                    for (const PatternLine& line : piece.lines) {
                        if (line.kind == kind && !line.glued_on) sum -= distance(line.at.a, line.at.b);
                    }
                    return sum;
                };
                for (const LineKind kind : {LineKind::mountain, LineKind::valley, LineKind::seam}) {
                    EXPECT_NEAR(drawn(kind), 0.0, 0.01) << part.name << " " << to_string(kind);
                }
                double cut = 0.0;
                for (const Contour& one : piece.cuts) {
                    cut += drawing::length_of(one.points);
                    if (one.closed) cut -= 0.0 - distance(one.points.back(), one.points.front());
                }
                const auto again = make_pattern(assembly_of(FlatParts{{part}, {}}), {}, diagnostics);
                for (const Contour& one : again->pieces[0].cuts) {
                    cut -= drawing::length_of(one.points);
                    if (one.closed) cut -= distance(one.points.back(), one.points.front());
                }
                EXPECT_NEAR(cut, 0.0, 0.05) << part.name;
                // What is glued to a back is shown there alone.
                const auto shown = [](const auto& all) {
                    return static_cast<std::size_t>(
                        std::count_if(all.begin(), all.end(), [](const auto& one) { return !one.on_back; }));
                };
                EXPECT_EQ(part.texts.size(), shown(piece.labels)) << part.name;
                EXPECT_EQ(part.fills.size(), test::prints_of<Area>(piece.prints).size()) << part.name;
                // Where another piece is glued on nothing is folded: that is a line to look at.
                const auto places = std::count_if(piece.lines.begin(), piece.lines.end(),
                                                  [](const PatternLine& line) { return line.glued_on; });
                EXPECT_EQ(part.strokes.size(), test::prints_of<Stroke>(piece.prints).size() +
                                                   shown(piece.targets) + static_cast<std::size_t>(places))
                    << part.name;
            }
        }
        EXPECT_EQ(found, run.layout->placements.size());
    }
    EXPECT_GE(seen, 12);
}

// What a machine marks for gluing is no cut when the sheet is read again.
TEST(RoundTrip, MarksOfMachinesAreNotCut) {
    const auto read_with = [](MarksOn where) {
        CompileOptions options;
        options.motion.examine = false;
        options.output.profile = *find_profile("lightburn");
        options.output.profile.marks_on = where;
        const std::string path = kSamples / "house.xml";
        const Compilation run = compile({Source{path, test::read_file(path)}}, options, {});
        Diagnostics diagnostics;
        std::vector<std::size_t> counts{0, 0, 0, 0};
        const auto sheets = write_svg(*run.layout, options.output, diagnostics).value();
        for (const auto& [suffix, sheet] : sheets) {
            counts[3] += sheet.size();
            const test::ReadDrawing reading = read_drawing(sheet);
            counts[0] += reading.parts().size();
            for (const FlatPart& part : reading.parts()) {
                counts[1] += part.slits.size();
                for (const Polygon& paper : part.paper) counts[2] += paper.holes.size();
            }
        }
        return counts;
    };
    const std::vector<std::size_t> marked = read_with(MarksOn::front);
    const std::vector<std::size_t> bare = read_with(MarksOn::none);
    EXPECT_GE(bare[0], 6U);
    EXPECT_EQ(marked[0], bare[0]);
    EXPECT_EQ(marked[1], bare[1]);
    EXPECT_EQ(marked[2], bare[2]);
    EXPECT_GT(marked[3], bare[3]);
}

TEST(RoundTrip, CopiesAndSeveralDesignsKeepTheirNames) {
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", kSamples / "boat.xml", kSamples / "flower.xml", "--copies", "2", "--sheet",
                      "a0", "-o", scratch / "a.svg"})
                  .exit,
              0);
    const auto reading = read_drawing(test::read_file(scratch / "a.svg"));
    EXPECT_EQ(reading.codes(), "");
    const std::vector<std::string> all = names(reading);
    const std::set<std::string> unique(all.begin(), all.end());
    EXPECT_EQ(unique.size(), all.size());
    for (const std::string name : {"boat:page", "boat:page~2", "flower:page", "flower:page~2", "boat:jib"}) {
        EXPECT_TRUE(unique.contains(name)) << name;
    }
}

// --- the program

TEST(DrawingRun, SheetsAndReportAreWrittenAndModelsAreRefused) {
    const ScratchDirectory scratch;
    test::RunOptions options;
    options.directory = scratch.path();
    test::write_file(scratch / "parts.svg", test::read_file(kSamples / "parts.svg"));
    EXPECT_EQ(popupc({"check", "parts.svg"}, options).err, "");
    ASSERT_EQ(
        popupc({"build", "parts.svg", "-o", "sheets.svg", "-o", "sheets.pdf", "-o", "run.json"}, options)
            .exit,
        0);
    const auto report = nlohmann::json::parse(test::read_file(scratch / "run.json"));
    const auto& input = report.at("inputs").at(0);
    EXPECT_EQ(input.at("elements"), 0);
    EXPECT_EQ(input.at("plates"), 0);
    EXPECT_EQ(input.at("pieces"), report.at("layout").at("placements").size());
    EXPECT_TRUE(input.at("motion").is_null());
    for (const std::string refused : {"a.glb", "a.gltf", "a.xml"}) {
        const auto result = popupc({"build", "parts.svg", "-o", "b.svg", "-o", refused}, options);
        EXPECT_EQ(result.exit, 2);
        EXPECT_NE(result.err.find("parts.svg: this describes flat parts"), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(refused), std::string::npos) << result.err;
        EXPECT_FALSE(fs::exists(scratch / "b.svg"));
    }
    for (const std::string stage : {"design", "motion"}) {
        EXPECT_EQ(popupc({"build", "parts.svg", "--emit", stage}, options).exit, 2) << stage;
    }
    for (const std::string stage : {"assembly", "pattern", "layout"}) {
        const auto result = popupc({"build", "parts.svg", "--emit", stage}, options);
        EXPECT_EQ(result.exit, 0) << stage;
        EXPECT_TRUE(nlohmann::json::accept(result.out));
    }
    for (const std::string how : {"--diff", "--in-place"}) {
        EXPECT_EQ(popupc({"fix", how, "parts.svg"}, options).exit, 2) << how;
    }
    EXPECT_EQ(test::read_file(scratch / "parts.svg"), test::read_file(kSamples / "parts.svg"));
}

TEST(DrawingRun, CardsAndDrawingsShareSheetsAndStandardInputIsTold) {
    const ScratchDirectory scratch;
    test::RunOptions options;
    options.directory = scratch.path();
    options.input = test::read_file(kSamples / "parts.svg");
    const auto result =
        popupc({"build", "-", kSamples / "boat.xml", "--sheet", "a1", "--to", "svg", "-o", "-"}, options);
    ASSERT_EQ(result.exit, 0) << result.err;
    EXPECT_NE(result.out.find("stdin:whale"), std::string::npos);
    EXPECT_NE(result.out.find("boat:page"), std::string::npos);
    // A second reading of what was written has the same pieces.
    test::RunOptions again;
    again.input = result.out;
    EXPECT_EQ(popupc({"check", "-"}, again).exit, 0);
    EXPECT_EQ(popupc({"check", "--from", "xml", "-"}, again).exit, 1);
}

}  // namespace
}  // namespace popup
