// Guarantees of pivots and discs: what of the paper they take, how they move, and how far a disc reaches.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/geometry/regions.h"
#include "motion/plate_shape.h"
#include "popup/motion.h"
#include "support/designs.h"

namespace popup::test {
namespace {

// As wide as its seams are apart, up to the top of the card: its centre fold is the line x = 10 of its page.
const std::string kStrap =
    "<structure type='strap' id='strap'><outerpoints><point x='-30' y='15'/><point x='-30' y='75'/>"
    "<point x='40' y='15'/><point x='40' y='75'/><point x='-30' y='0'/><point x='-30' y='60'/>"
    "<point x='40' y='0'/><point x='40' y='60'/></outerpoints>"
    "<parentfold page='0'><begin x='0' y='-75'/><end x='0' y='75'/></parentfold></structure>";

std::string pivot(std::string_view side, std::string_view b, std::string_view e, std::string_view h,
                  std::string_view outline) {
    return "<structure type='pivot' id='flag' side='" + std::string(side) +
           "'><outerpoints><point x='10' y='30'/>" + std::string(b) + std::string(e) +
           "<point x='0' y='0'/><point x='0' y='" + std::string(h) + "'/></outerpoints><outline d='" +
           std::string(outline) +
           "'/><parentfold page='1'><begin x='10' y='0'/><end x='10' y='60'/></parentfold></structure>";
}
const std::string kAtTheEdge =
    pivot("left", "<point x='-12.5' y='60'/>", "<point x='32.5' y='60'/>", "37.5", "M 1 2 L 20 24 L 2 36 Z");

std::vector<Polygon> of_piece(const Assembly& assembly, const std::string& piece) {
    std::vector<Polygon> all;
    for (const Plate& plate : assembly.plates) {
        if (assembly.pieces[static_cast<std::size_t>(plate.piece)].name == piece)
            all.push_back(plate.outline);
    }
    return all;
}

TEST(Pivot, AtTheEdgeOfAStrapCutsNothing) {
    const FromXml plain = from_xml(kStrap);
    const FromXml made = from_xml(kStrap + kAtTheEdge);
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(made.text, "");
    // The strap's paper is shared out among its plates and the beak's; nothing is lost, nothing doubled.
    const std::vector<Polygon> before = unite(of_piece(*plain.assembly, "strap"));
    const std::vector<Polygon> plates = of_piece(*made.assembly, "strap");
    EXPECT_EQ(plates.size(), 4U);
    double sum = 0.0;
    for (const Polygon& one : plates) {
        sum += area(one);
        for (const Ring& hole : one.holes) EXPECT_TRUE(hole.empty());
    }
    EXPECT_NEAR(sum, 60.0 * 70.0, 1e-9);
    EXPECT_NEAR(area(unite(plates)), area(before), 1e-6);
    std::size_t cuts_before = 0;
    for (const Line& line : plain.assembly->lines) cuts_before += line.kind == LineKind::cut ? 1U : 0U;
    std::size_t cuts = 0;
    for (const Line& line : made.assembly->lines) cuts += line.kind == LineKind::cut ? 1U : 0U;
    EXPECT_EQ(cuts, cuts_before + 3) << "those of the flag alone";
    // The fold ends at the apex.
    for (const Line& line : made.assembly->lines) {
        if (line.kind != LineKind::mountain || line.at.a.x != 10.0 || line.at.b.x != 10.0) continue;
        EXPECT_NEAR(std::max(line.at.a.y, line.at.b.y), 30.0, 1e-9);
    }
}

TEST(Pivot, InsideAStrapIsABeak) {
    const FromXml made = from_xml(kStrap + pivot("right", "<point x='-8' y='48'/>", "<point x='28' y='48'/>",
                                                 "25.4558441", "M -1 2 L -14 14 L -1 24 Z"));
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(made.text, "");
    std::size_t cuts = 0;
    for (const Line& line : made.assembly->lines) {
        const bool across = line.at.a.y == 48.0 && line.at.b.y == 48.0;
        cuts += line.kind == LineKind::cut && across ? 1U : 0U;
    }
    EXPECT_EQ(cuts, 1U);
    double sum = 0.0;
    for (const Polygon& one : of_piece(*made.assembly, "strap")) sum += area(one);
    EXPECT_NEAR(sum, 60.0 * 70.0, 1e-9);
}

// The piece moves with its plane, and its G–H stays on the side fold, which is the strap's, too.
TEST(Pivot, SwingsAboutItsSideFold) {
    const FromXml made = from_xml(kStrap + kAtTheEdge);
    ASSERT_TRUE(made.assembly) << made.text;
    const std::size_t flag = made.plate("flag");
    const std::size_t plane = made.plate("flag/left");
    const std::size_t strap = made.plate("strap/left");
    std::vector<Frame> frames(made.assembly->plates.size());
    for (int deg = 0; deg <= 180; ++deg) {
        ASSERT_TRUE(place(*made.assembly, Angle::degrees(deg), frames));
        EXPECT_LT(distance(frames[flag].point({0, 0}), frames[strap].point({10, 30})), 1e-6) << deg;
        EXPECT_LT(distance(frames[flag].point({0, 37.5}), frames[strap].point({-12.5, 60})), 1e-6) << deg;
        EXPECT_LT(length(frames[flag].normal() - frames[plane].normal()), 1e-9) << deg;
    }
    // Flat on the open card, and in the plane of the closed one.
    EXPECT_NEAR(frames[flag].normal().z, 1.0, 1e-9);
    ASSERT_TRUE(place(*made.assembly, Angle::degrees(0), frames));
    EXPECT_NEAR(std::abs(frames[flag].normal().x), 1.0, 1e-9);
}

std::string disc(std::string_view attributes, std::string_view rivet, std::string_view more = "") {
    return "<structure type='disc' id='disc' " + std::string(attributes) +
           "><outerpoints><point x='50' y='10'/>" + std::string(rivet) + "</outerpoints>" +
           std::string(more) + "<parentplate page='0' x='50' y='10'/></structure>";
}

TEST(Disc, ReachesAsFarAsItsCornersTurn) {
    // Its rivet is on it, then beside the middle of a ring.
    for (const std::string& structures :
         {disc("", "<point x='50' y='0'/>", "<outline d='M -3 -15 H 3 L 1 30 H -1 Z'/>"),
          disc("radius='22'", "<point x='58' y='2'/>")}) {
        const FromXml made = from_xml(structures);
        ASSERT_TRUE(made.assembly) << made.text;
        const Plate& plate = made.assembly->plates.back();
        ASSERT_TRUE(plate.rivet);
        const Polygon reach = reach_of(plate);
        double most = 0.0;
        for (const Vec2 p : plate.outline.outer) most = std::max(most, distance(p, *plate.rivet));
        for (int deg = 0; deg < 360; deg += 7) {
            for (const Vec2 p : plate.outline.outer) {
                const Vec2 at = *plate.rivet + rotated(p - *plate.rivet, deg * std::numbers::pi / 180.0);
                EXPECT_TRUE(contains(reach, *plate.rivet + 0.9999 * (at - *plate.rivet))) << deg;
            }
        }
        for (const Vec2 p : reach.outer) EXPECT_LE(distance(p, *plate.rivet), most + 0.0051);
    }
}

TEST(Disc, LooksThroughItsWindow) {
    const FromXml made = from_xml(
        disc("radius='30'", "<point x='50' y='10'/>", "<window page='0' d='M 40 20 H 60 V 32 H 40 Z'/>"));
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(made.text, "");
    const std::size_t plate = made.plate("disc");
    const Plate& page = made.assembly->plates[made.plate("page/right")];
    EXPECT_EQ(made.assembly->plates[plate].lying, Lying::on_back);
    std::vector<Frame> frames(made.assembly->plates.size());
    ASSERT_TRUE(place(*made.assembly, Angle::degrees(77), frames));
    const Frame& under = frames[made.plate("page/right")];
    EXPECT_LT(length(frames[plate].normal() - under.normal()), 1e-12) << "its front looks through it";
    EXPECT_LT(distance(frames[plate].point({0, 0}), under.point({50, 10})), 1e-9);
    // The window and the rivet's hole are gone from the page, and the same hole from the disc.
    ASSERT_EQ(page.outline.holes.size(), 2U);
    const double hole = std::numbers::pi * 1.5 * 1.5;
    EXPECT_NEAR(area(page.outline), 100.0 * 150.0 - 20.0 * 12.0 - hole, 0.05);
    EXPECT_NEAR(area(made.assembly->plates[plate].outline), std::numbers::pi * 900.0 - hole, 1.3);
}

TEST(Disc, TurnsOneWayByHand) {
    const FromXml made = from_xml(disc("radius='30'", "<point x='50' y='10'/>"));
    ASSERT_TRUE(made.assembly) << made.text;
    const auto free = free_plates(*made.assembly);
    ASSERT_EQ(free.size(), 1U);
    EXPECT_EQ(free[0].ways, 1);
    EXPECT_EQ(free[0].plates, (std::vector<int>{static_cast<int>(made.plate("disc"))}));
}

// What a later element would stand on, or be glued to, is looked at with the window gone.
TEST(Disc, ItsWindowCarriesNothing) {
    const std::string with_window =
        disc("radius='30'", "<point x='50' y='10'/>", "<window page='0' d='M 40 20 H 60 V 32 H 40 Z'/>");
    const FromXml made =
        from_xml(with_window +
                 "<structure type='attached-plane' id='leaf'><outerpoints><point x='45' y='22'/>"
                 "<point x='45' y='30'/><point x='0' y='0'/><point x='0' y='8'/></outerpoints>"
                 "<outline d='M 0 0 H 10 V 8 H 0 Z'/><parentplate page='0' x='70' y='60'/>"
                 "</structure>");
    EXPECT_FALSE(made.assembly);
    EXPECT_NE(made.text.find("only 0.0 mm² of it lie on its plate"), std::string::npos) << made.text;
}

}  // namespace
}  // namespace popup::test
