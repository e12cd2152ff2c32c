// Guarantees of pieces that are glued flat on a plate: where they lie at every angle, what of them is glued,
// and that what sticks out is examined.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "input/xml/read.h"
#include "popup/check.h"
#include "popup/motion.h"
#include "popup/pattern.h"
#include "support/designs.h"
#include "support/restored.h"

namespace popup::test {
namespace {

// On the right half of a v-fold, which has the page 1.
constexpr std::string_view kTrunk =
    "<structure type='v-fold' id='trunk'><outerpoints><point x='-22' y='22'/><point x='0' y='0'/>"
    "<point x='22' y='22'/><point x='-28.219496' y='13.101909'/><point x='0' y='0'/>"
    "<point x='28.219496' y='13.101909'/><point x='12' y='66'/><point x='-12' y='66'/></outerpoints>"
    "<parentfold page='0'><begin x='0' y='-75'/><end x='0' y='75'/></parentfold></structure>";

// A piece whose page is turned by a quarter against the plate's: A–B upwards, G–H to the right.
std::string leaf(std::string_view attributes, std::string_view outline, std::string_view more = "") {
    return "<structure type='attached-plane' id='leaf' " + std::string(attributes) +
           "><outerpoints><point page='1' x='4' y='34'/><point page='1' x='4' y='54'/><point x='5' y='7'/>"
           "<point x='25' y='7'/></outerpoints><outline d='" +
           std::string(outline) + "'/>" + std::string(more) +
           "<parentplate page='1' x='6' y='44'/></structure>";
}

constexpr std::string_view kSquare =
    "M 5 7 H 25 V -3 H 5 Z";  // to the right of G–H: away from the centre fold

// Seen from the back, left of A–B is where right of it is from the front.
FromXml square_leaf_on(const std::string& side) {
    return from_xml(std::string(kTrunk) +
                    leaf("side='" + side + "'", side == "front" ? kSquare : "M 5 7 H 25 V 17 H 5 Z"));
}

TEST(AttachedPlane, LiesOnItsPlateAtEveryAngleOnEitherSide) {
    for (const std::string side : {"front", "back"}) {
        SCOPED_TRACE(side);
        const FromXml made = square_leaf_on(side);
        ASSERT_TRUE(made.assembly) << made.text;
        EXPECT_EQ(made.text, "");
        const std::size_t plate = made.assembly->plates.size() - 1;
        const auto& base = made.assembly->joints.back();
        const int base_plate = plates_of(base).places[0].parent;
        EXPECT_EQ(made.assembly->plates[static_cast<std::size_t>(base_plate)].name, "trunk/right");
        std::vector<Frame> frames(made.assembly->plates.size());
        const double way = side == "front" ? 1.0 : -1.0;
        for (int deg = 0; deg <= 180; ++deg) {
            ASSERT_TRUE(place(*made.assembly, Angle::degrees(deg), frames));
            const Frame& under = frames[static_cast<std::size_t>(base_plate)];
            const Frame& own = frames[plate];
            EXPECT_LT(distance(own.point({5, 7}), under.point({4, 34})), 1e-9) << deg;
            EXPECT_LT(distance(own.point({25, 7}), under.point({4, 54})), 1e-9) << deg;
            // The corner lies 10 mm beside the line, away from the centre fold.
            EXPECT_LT(distance(own.point({25, 7 - 10 * way}), under.point({14, 54})), 1e-9) << deg;
            EXPECT_LT(length(own.normal() - way * under.normal()), 1e-12) << deg;
        }
        Diagnostics diagnostics;
        MotionOptions options;
        const auto motion = simulate(*made.assembly, options, diagnostics);
        ASSERT_TRUE(motion) << findings(diagnostics);
        EXPECT_EQ(findings(diagnostics), "");
        EXPECT_LE(motion->flat_error_deg, 1e-6);
        // It lies next to its plate in the closed card, on the side it is glued to.
        ASSERT_TRUE(motion->examination->closed.order);
        const std::vector<int>& order = *motion->examination->closed.order;
        const auto at = [&](int number) {
            return std::find(order.begin(), order.end(), number) - order.begin();
        };
        ASSERT_TRUE(place(*made.assembly, Angle::degrees(0), frames));
        const double up = dot(frames[static_cast<std::size_t>(base_plate)].normal(), frames[0].normal());
        EXPECT_EQ(at(static_cast<int>(plate)) - at(base_plate), up * way > 0.0 ? 1 : -1);
    }
}

// The piece's part on the plate, 1 mm away from the plate's edges, is the target on it.
TEST(AttachedPlane, ItsGlueAreaIsWhatLiesOnThePlateOrWhatIsGiven) {
    const FromXml all = from_xml(std::string(kTrunk) + leaf("", kSquare));
    ASSERT_TRUE(all.assembly) << all.text;
    ASSERT_EQ(all.assembly->glued_areas.size(), 1U);
    // The plate's edge goes from (28.22, 13.10) to (12, 66); the square from x = 4 to 14 and y = 34 to 54.
    const double good = area(all.assembly->glued_areas[0].on_base);
    EXPECT_NEAR(good, 200.0, 2.0);
    Diagnostics diagnostics;
    const auto pattern = make_pattern(*all.assembly, {}, diagnostics);
    ASSERT_TRUE(pattern);
    double targets = 0.0;
    for (const GlueTarget& target : pattern->pieces[1].targets) targets += area({target.outline, {}});
    EXPECT_NEAR(targets, good, 1e-6);
    EXPECT_TRUE(
        std::any_of(pattern->pieces[1].labels.begin(), pattern->pieces[1].labels.end(),
                    [](const Label& label) { return label.kind == LabelKind::target && label.text == "2"; }));
    const FromXml given =
        from_xml(std::string(kTrunk) + leaf("", kSquare, "<glue d='M 5 36 h 6 v 6 h -6 z'/>"));
    ASSERT_TRUE(given.assembly) << given.text;
    EXPECT_NEAR(area(given.assembly->glued_areas[0].on_base), 36.0, 1e-6);
}

// Where it is glued nobody sees it: face to face with that on the plate, and read from the same side.
TEST(AttachedPlane, ItsNumberIsHiddenOverThatOfItsTarget) {
    for (const std::string side : {"front", "back"}) {
        SCOPED_TRACE(side);
        const FromXml made = square_leaf_on(side);
        ASSERT_TRUE(made.assembly) << made.text;
        Diagnostics diagnostics;
        const auto pattern = make_pattern(*made.assembly, {}, diagnostics);
        ASSERT_TRUE(pattern);
        EXPECT_FALSE(pattern->pieces[0].hidden_number);
        EXPECT_FALSE(pattern->pieces[1].hidden_number);
        const std::optional<Label>& own = pattern->pieces[2].hidden_number;
        ASSERT_TRUE(own);
        EXPECT_EQ(own->text, "2");
        EXPECT_TRUE(own->on_back);
        const std::vector<Label>& labels = pattern->pieces[1].labels;
        const auto target = std::find_if(labels.begin(), labels.end(), [](const Label& one) {
            return one.kind == LabelKind::target && one.text == "2";
        });
        ASSERT_NE(target, labels.end());
        EXPECT_EQ(target->on_back, side == "back");
        EXPECT_EQ(own->height_mm, target->height_mm);
        std::vector<Frame> frames(made.assembly->plates.size());
        ASSERT_TRUE(place(*made.assembly, Angle::degrees(70), frames));
        const int base = plates_of(made.assembly->joints.back()).places[0].parent;
        const Frame& under = frames[static_cast<std::size_t>(base)];
        const auto read_along = [](const Label& one) {
            return Vec2{std::cos(one.angle), std::sin(one.angle)};
        };
        EXPECT_LT(distance(frames.back().point(own->at), under.point(target->at)), 1e-9);
        EXPECT_LT(length(frames.back().direction(read_along(*own)) - under.direction(read_along(*target))),
                  1e-9);
    }
}

TEST(AttachedPlane, WhatCannotHoldIsRefusedWithItsNumbers) {
    EXPECT_EQ(from_xml(std::string(kTrunk) + leaf("", "M 5 7 h 4 v -4 h -4 z")).text,
              "error does-not-fit: \"leaf\": only 16.0 mm² of it lie on its plate, 1.00 mm away from folds "
              "and edges; "
              "25 mm² are the least that holds\n");
    EXPECT_EQ(from_xml(std::string(kTrunk) + leaf("", kSquare, "<glue d='M -9 36 h 18 v 6 h -18 z'/>")).text,
              "error does-not-fit: \"leaf\": 78.0 mm² of its glue area of 108.0 mm² lie beside the plate or "
              "beside the "
              "piece\n");
    EXPECT_EQ(from_xml(std::string(kTrunk) + leaf("", "M 5 7 h 9 v -9 h -9 z M 16 7 h 9 v -9 h -9 z")).text,
              "error outline-crosses: \"leaf\": its outline encloses 2 areas that do not hang together\n");
}

// What hangs below the seam goes through the page, although both hang on one hinge.
TEST(AttachedPlane, WhatSticksOutIsExaminedAsDrawn) {
    const FromXml made = from_xml(std::string(kTrunk) + leaf("", "M -40 7 H 25 V -3 H -40 Z"));
    ASSERT_TRUE(made.assembly) << made.text;
    Diagnostics diagnostics;
    const auto motion = simulate(*made.assembly, {}, diagnostics);
    ASSERT_TRUE(motion);
    EXPECT_FALSE(motion->examination->contacts.empty());
    EXPECT_NE(findings(diagnostics).find("warning collision: "), std::string::npos) << findings(diagnostics);
}

// A stack of pieces on pieces: each on the front of the one before it.
TEST(AttachedPlane, OneStandsOnAnotherToAnyDepth) {
    std::string all(kTrunk);
    all += leaf("", kSquare);
    for (int n = 3; n < 11; ++n) {
        const std::string page = std::to_string(n - 1);
        all += "<structure type='attached-plane'><outerpoints><point page='" + page +
               "' x='8' y='5'/><point page='" + page +
               "' x='20' y='5'/><point x='8' y='5'/><point x='20' y='5'/></outerpoints>"
               "<outline d='M 5 7 H 25 V -3 H 5 Z'/><parentplate page='" +
               page + "' x='15' y='2'/></structure>";
    }
    const FromXml made = from_xml(all);
    ASSERT_TRUE(made.assembly) << made.text;
    Diagnostics diagnostics;
    const auto motion = simulate(*made.assembly, {}, diagnostics);
    ASSERT_TRUE(motion) << findings(diagnostics);
    EXPECT_EQ(findings(diagnostics), "");
    ASSERT_TRUE(motion->examination->closed.order);
    // Nine pieces lie on one another in the order in which they were glued, one way or the other.
    std::vector<int> pieces;
    for (const int plate : *motion->examination->closed.order) {
        if (plate >= 4) pieces.push_back(plate);
    }
    EXPECT_TRUE(std::is_sorted(pieces.begin(), pieces.end()) ||
                std::is_sorted(pieces.rbegin(), pieces.rend()));
}

// Curves that are drawn reach the sheet as curves, also of a piece that was turned over.
TEST(AttachedPlane, CurvesOfItsOutlineAreTheAssemblys) {
    constexpr std::string_view kRound = "M 5 7 H 25 C 32 0 20 -8 15 -6 S 0 0 5 7 Z";
    for (const std::string side : {"front", "back"}) {
        const FromXml made = from_xml(std::string(kTrunk) + leaf("side='" + side + "'", kRound));
        ASSERT_TRUE(made.assembly) << made.text;
        EXPECT_EQ(made.assembly->curves.size(), 2U);
        const Plate& piece = made.assembly->plates.back();
        const Restored restored = made.assembly->curves.restored(piece.outline.outer, true, false);
        std::size_t curves = 0;
        for (const CurveStep& step : restored.steps) curves += step.curve ? 1 : 0;
        EXPECT_EQ(curves, 2U) << side;
        EXPECT_LE(strays(piece.outline.outer, true, restored), 0.0105);
    }
}

}  // namespace
}  // namespace popup::test
