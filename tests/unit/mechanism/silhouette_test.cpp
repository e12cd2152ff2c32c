// Guarantees of drawn silhouettes: the piece is what was drawn, divided by its centre fold and glued along
// its seams; it moves as the one with straight edges does; and what cannot be divided is refused where it
// stands.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/geometry/regions.h"
#include "input/xml/read.h"
#include "popup/check.h"
#include "popup/motion.h"
#include "support/designs.h"
#include "support/random.h"

namespace popup::test {
namespace {

// G (-40, 30) and H (40, 30) with the apex E (0, 0), glued to a V of the same 50 mm.
constexpr std::string_view kVFold =
    "<outerpoints><point x='-30' y='40'/><point x='0' y='0'/><point x='30' y='40'/><point x='-40' y='30'/>"
    "<point x='0' y='0'/><point x='40' y='30'/><point x='20' y='70'/><point x='-20' y='70'/></outerpoints>";
// G (-30, -10), H (-30, 15), K (30, -10), L (30, 15).
constexpr std::string_view kTent =
    "<outerpoints><point x='-18' y='-10'/><point x='-18' y='15'/><point x='18' y='-10'/><point x='18' "
    "y='15'/>"
    "<point x='-30' y='-10'/><point x='-30' y='15'/><point x='30' y='-10'/><point x='30' "
    "y='15'/></outerpoints>";
// The same of 36 mm in all.
constexpr std::string_view kLayer =
    "<outerpoints><point x='-18' y='-10'/><point x='-18' y='15'/><point x='18' y='-10'/><point x='18' "
    "y='15'/>"
    "<point x='-18' y='-10'/><point x='-18' y='15'/><point x='18' y='-10'/><point x='18' "
    "y='15'/></outerpoints>";

struct Made {
    std::optional<Assembly> assembly;
    std::vector<Diagnostic> findings;
    std::string text;
    std::string fixed;  // the document, with its repairs
};

Made make(std::string_view type, std::string_view points, const std::string& outline,
          std::string_view more = "", std::string_view version = "3.0") {
    Made made;
    Diagnostics diagnostics("card.xml");
    const Source source{"card.xml", "<popup version='" + std::string(version) +
                                        "' units='mm'><mainpage width='200' height='200'/><structurelist>"
                                        "<structure type='" +
                                        std::string(type) + "' id='piece'>" + std::string(points) +
                                        (outline.empty() ? "" : "<outline d='" + outline + "'/>") +
                                        "<parentfold page='0'><begin x='0' y='-100'/><end x='0' y='100'/>"
                                        "</parentfold></structure>" +
                                        std::string(more) + "</structurelist></popup>"};
    const auto design = xml::read(source, {}, diagnostics);
    const auto checked = design ? check(*design, {}, diagnostics) : std::nullopt;
    if (checked) made.assembly = assemble(*checked, {}, diagnostics);
    if (checked) made.fixed = xml::patch(source, checked->design());
    made.findings = diagnostics.sorted();
    made.text = findings(diagnostics);
    return made;
}

const Plate& plate_named(const Assembly& assembly, std::string_view name) {
    const auto found = std::find_if(assembly.plates.begin(), assembly.plates.end(),
                                    [&](const Plate& plate) { return plate.name == name; });
    EXPECT_NE(found, assembly.plates.end()) << name;
    return *found;
}

bool has_edge(const Ring& ring, const Segment& edge) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Segment one{ring[i], ring[(i + 1) % ring.size()]};
        if ((one.a == edge.a && one.b == edge.b) || (one.a == edge.b && one.b == edge.a)) return true;
    }
    return false;
}

// By what it is made of: each half has its seam and the centre fold as edges, the lines that are cut go round
// the rest, and everything holds together at every degree.
// `within`: what chords of its curves leave out, at most.
void expect_divided(const Assembly& assembly, double area_mm2, double within = 0.02) {
    const Plate& left = plate_named(assembly, "piece/left");
    const Plate& right = plate_named(assembly, "piece/right");
    EXPECT_NEAR(area(left.outline) + area(right.outline), area_mm2, within);
    EXPECT_NEAR(area(unite({left.outline, right.outline})), area_mm2, within) << "the halves overlap";
    std::size_t hinges = 0;
    for (const Hinge& hinge : assembly.hinges) {
        for (const auto& [plate, line] :
             {std::pair(hinge.a, hinge.a_line), std::pair(hinge.b, hinge.b_line)}) {
            const Plate& one = assembly.plates.at(static_cast<std::size_t>(plate));
            if (!one.name.starts_with("piece/")) continue;
            EXPECT_TRUE(has_edge(one.outline.outer, line)) << one.name;
            ++hinges;
        }
    }
    EXPECT_EQ(hinges, 4U);
    double around = 0.0;
    for (const Plate* plate : {&left, &right}) {
        for (const Ring* ring : {&plate->outline.outer}) {
            for (std::size_t i = 0; i < ring->size(); ++i)
                around += distance((*ring)[i], (*ring)[(i + 1) % ring->size()]);
        }
        for (const Ring& hole : plate->outline.holes) {
            for (std::size_t i = 0; i < hole.size(); ++i)
                around += distance(hole[i], hole[(i + 1) % hole.size()]);
        }
    }
    for (const Hinge& hinge : assembly.hinges) {
        const bool own = assembly.plates.at(static_cast<std::size_t>(hinge.a)).name.starts_with("piece/") ||
                         assembly.plates.at(static_cast<std::size_t>(hinge.b)).name.starts_with("piece/");
        if (own) around -= distance(hinge.a_line.a, hinge.a_line.b) * (hinge.glued ? 1.0 : 2.0);
    }
    for (const Line& line : assembly.lines) {
        if (line.kind == LineKind::cut &&
            assembly.pieces.at(static_cast<std::size_t>(line.piece)).name == "piece")
            around -= distance(line.at.a, line.at.b);
    }
    EXPECT_NEAR(around, 0.0, 1e-6);

    MotionOptions options;
    for (int deg = 0; deg <= 180; ++deg) options.angles.push_back(Angle::degrees(deg));
    Diagnostics diagnostics;
    const auto motion = simulate(assembly, options, diagnostics);
    ASSERT_TRUE(motion) << findings(diagnostics);
    EXPECT_LE(motion->max_closure_mm, 1e-9);
    EXPECT_TRUE(motion->flat_closed);
}

// Each with an area that is known without the program.
struct Drawn {
    std::string name;
    std::string_view type, points;
    std::string outline;
    double area_mm2;
};
const std::vector<Drawn>& drawn() {
    constexpr double kPi = 3.14159265358979;
    static const std::vector<Drawn> all{
        {"v-fold with straight edges", "v-fold", kVFold, "M 0 0 L 40 30 L 40 80 L -40 80 L -40 30 Z",
         80 * 50 + 80 * 30 / 2.0},
        // Half a disc on the rectangle.
        {"v-fold with an arc", "v-fold", kVFold, "M 40 30 A 40 40 0 0 1 -40 30 L 0 0 Z",
         kPi * 1600 / 2 + 80 * 30 / 2.0},
        {"v-fold with two holes", "v-fold", kVFold,
         "M 0 0 L 40 30 V 80 H -40 V 30 Z M -20 50 h 10 v 10 h -10 Z M 10 50 h 8 v 8 h -8 Z",
         80 * 50 + 80 * 30 / 2.0 - 100 - 64},
        {"v-fold whose border goes on straight behind its seams", "v-fold", kVFold,
         "M 0 0 L 60 45 L 0 90 L -60 45 Z", 120 * 45},
        {"tent with round ends", "tent", kTent, "M -30 -10 A 30 30 0 0 1 30 -10 V 15 A 30 30 0 0 1 -30 15 Z",
         60 * 25 + kPi * 900},
        {"tent that is narrower between its seams", "tent", kTent,
         "M -30 -10 L -10 0 H 10 L 30 -10 V 15 L 10 5 H -10 L -30 15 Z", 20 * 5 + 2 * 20 * (25 + 5) / 2.0},
        {"layer", "layer", kLayer, "M -18 -10 L 0 -30 L 18 -10 V 15 L 0 25 L -18 15 Z",
         36 * 25 + 36 * 20 / 2.0 + 36 * 10 / 2.0},
    };
    return all;
}

TEST(Silhouette, ThePieceIsWhatWasDrawnDividedByItsFold) {
    for (const Drawn& one : drawn()) {
        SCOPED_TRACE(one.name);
        const Made made = make(one.type, one.points, one.outline);
        ASSERT_TRUE(made.assembly) << made.text;
        EXPECT_EQ(made.text, "");
        // Chords stray from an arc of at most 189 mm by 0.01 mm, two thirds of it in the mean.
        const bool curved = one.outline.find(" A ") != std::string::npos;
        expect_divided(*made.assembly, one.area_mm2, curved ? 1.3 : 0.02);
    }
}

TEST(Silhouette, ItMovesAsThePieceWithStraightEdges) {
    const Made round = make("v-fold", kVFold, "M 40 30 A 40 40 0 0 1 -40 30 L 0 0 Z");
    const Made straight = make("v-fold", kVFold, "M 0 0 L 40 30 L 20 70 L -20 70 L -40 30 Z");
    ASSERT_TRUE(round.assembly && straight.assembly);
    std::vector<Frame> a(4);
    std::vector<Frame> b(4);
    for (int deg = 0; deg <= 180; deg += 5) {
        ASSERT_TRUE(place(*round.assembly, Angle::degrees(deg), a));
        ASSERT_TRUE(place(*straight.assembly, Angle::degrees(deg), b));
        for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(distance(a[i].point({3, 5}), b[i].point({3, 5})), 1e-9);
    }
}

TEST(Silhouette, DrawnFromTheBackItIsMirroredWithItsPiece) {
    constexpr std::string_view kBack =
        "<outerpoints><point x='-30' y='40'/><point x='0' y='0'/><point x='30' y='40'/><point x='40' y='30'/>"
        "<point x='0' y='0'/><point x='-40' y='30'/><point x='-20' y='70'/><point x='20' "
        "y='70'/></outerpoints>";
    const Made made = make("v-fold", kBack, "M 0 0 L 40 30 L 55 80 L -40 80 L -40 30 Z");
    ASSERT_TRUE(made.assembly) << made.text;
    expect_divided(*made.assembly, 80 * 50 + 80 * 30 / 2.0 + 15 * 50 / 2.0);
    double reach = 0.0;
    for (const Vec2 p : plate_named(*made.assembly, "piece/left").outline.outer) reach = std::min(reach, p.x);
    EXPECT_EQ(reach, -55.0);
}

TEST(Silhouette, EndsNearTheSeamsAreSnappedOnceAndForAll) {
    const std::string near = "M 0.2 0.1 L 40.3 29.8 C 60 60 20 90 0 90 S -60 60 -39.7 30.2 Z";
    const Made made = make("v-fold", kVFold, near);
    ASSERT_TRUE(made.assembly) << made.text;
    ASSERT_EQ(made.findings.size(), 1U) << made.text;
    const Diagnostic& told = made.findings.front();
    EXPECT_EQ(told.code, "outline-snapped");
    EXPECT_NE(told.message.find("0.36 mm"), std::string::npos) << told.message;
    ASSERT_TRUE(told.change);
    EXPECT_NE(told.change->before.find("(40.3, 29.8)"), std::string::npos) << told.change->before;
    EXPECT_NE(told.change->after.find("(40, 30)"), std::string::npos) << told.change->after;
    // Curves end where the points went.
    EXPECT_EQ(made.assembly->curves.size(), 2U);
    Diagnostics again("card.xml");
    const auto design = xml::read({"card.xml", made.fixed}, {}, again);
    ASSERT_TRUE(design) << made.fixed;
    ASSERT_TRUE(check(*design, {}, again));
    EXPECT_EQ(findings(again), "") << made.fixed;
}

TEST(Silhouette, OthersStandOnItsCentreFoldAndAreCutFromIt) {
    // A beak on the v-fold's centre fold, whose apex is 30 mm above E.
    const std::string beak =
        "<structure type='inverted-beak' id='beak'><outerpoints><point page='1' x='0' y='30'/>"
        "<point page='1' x='-10' y='45'/><point page='1' x='10' y='45'/></outerpoints>"
        "<parentfold page='1'><begin x='0' y='0'/><end x='0' y='70'/></parentfold></structure>";
    const Made made = make("v-fold", kVFold, "M 40 30 A 40 40 0 0 1 -40 30 L 0 0 Z", beak);
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(made.text, "");
    const double whole = 3.14159265358979 * 800 + 80 * 30 / 2.0;
    const double left = area(plate_named(*made.assembly, "piece/left").outline);
    const double right = area(plate_named(*made.assembly, "piece/right").outline);
    EXPECT_LT(left + right, whole - 100.0);
    EXPECT_NEAR(left, right, 0.01);
}

struct Wrong {
    std::string outline;
    std::string_view code, said;
};

TEST(Silhouette, WhatCannotBeDividedIsRefusedWithItsNumbers) {
    for (const Wrong& wrong : std::vector<Wrong>{
             {"M 0 0 L 42 30 L 0 90 L -42 30 Z", "outline-off-seam", "of the seam G–E"},
             {"M 0 0 L 20 5 L 40 30 L 0 90 L -40 30 Z", "outline-off-seam", "not straight between them"},
             {"M 0 0 L 40 30 L 30 90 L 0 50 L -5 90 L 20 95 L 20 96 L -40 96 L -40 30 Z", "outline-off-fold",
              "times"},
             {"M 0 0 L 40 30 V 80 H -40 V 30 Z M -10 40 H 0 V 35 H 10 V 45 H 0 V 50 H -10 Z",
              "hole-off-piece", "runs along its centre fold"},
             {"M 0 0 L 40 30 V 80 H -40 V 30 Z M -5 40 h 10 v 39.5 h -10 Z", "hole-off-piece",
              "leaves 0.50 mm of its centre fold at one end"},
             {"M 0 0 L 40 30 V 80 H -40 V 30 Z M -5 40 H 5 V 50 H -5 V 48 H 3 V 42 H -5 Z", "hole-off-piece",
              "crosses its centre fold 4 times"},
             {"M 0 0 L 40 30 V 80 H -40 V 30 Z M -5 40 h 10 v 9 h -10 Z M -5 49.5 h 10 v 9 h -10 Z",
              "hole-off-piece", "leave 0.50 mm of its centre fold between them"},
             {"M 0 0 L 40 30 V 80 H -40 V 30 Z M 70 40 h 10 v 10 h -10 Z", "outline-crosses", "2 areas"}}) {
        SCOPED_TRACE(wrong.outline);
        const Made made = make("v-fold", kVFold, wrong.outline);
        const auto told = std::find_if(made.findings.begin(), made.findings.end(),
                                       [&](const Diagnostic& d) { return d.code == wrong.code; });
        ASSERT_NE(told, made.findings.end()) << made.text;
        EXPECT_EQ(told->severity, Severity::error);
        EXPECT_NE(told->message.find(wrong.said), std::string::npos) << told->message;
        EXPECT_FALSE(told->hints.empty());
    }
}

// However little of a hole lies outside: its corner would open the edge of the plate.
TEST(Silhouette, HolesMayNotReachTheEdge) {
    const std::string outline = "M 0 0 L 40 30 V 80 H -40 V 30 Z";
    const auto with_corner_at = [&](double y) {
        return make("v-fold",
                    fmt::format("{}<hole d='M 10 60 H 20 L 15.01 {:.4f} L 15 {:.4f} Z'/>", kVFold, y, y),
                    outline);
    };
    const Made thin = with_corner_at(79.99);
    EXPECT_TRUE(thin.assembly);
    EXPECT_TRUE(thin.text.starts_with("warning paper-too-thin: \"piece\": only 0.01 mm of paper"))
        << thin.text;
    for (const double y : {79.9995, 80.0, 80.01}) {
        const Made made = with_corner_at(y);
        EXPECT_FALSE(made.assembly) << y;
        EXPECT_NE(made.text.find("touches the edge of its piece at (15"), std::string::npos) << made.text;
        EXPECT_NE(made.text.find("error hole-off-piece"), std::string::npos) << made.text;
    }
}

// A hole across the centre fold takes as much from either half as lies there, and interrupts the fold.
TEST(Silhouette, HolesMayCrossTheCentreFold) {
    // Symmetric: the fold is the line x = 0 of the piece's page.
    const std::string outline = "M 0 0 L 40 30 V 80 H -40 V 30 Z";
    const std::string holes =
        "<hole d='M -6 40 H 10 V 52 H -6 Z M -20 60 h 5 v 5 h -5 Z M -3 60 L 4 60 L 0 70 Z'/>";
    const Made whole = make("v-fold", kVFold, outline);
    const Made made = make("v-fold", std::string(kVFold) + holes, outline);
    ASSERT_TRUE(whole.assembly && made.assembly) << made.text;
    EXPECT_EQ(made.text, "");
    const auto lost = [&](std::string_view name) {
        return area(plate_named(*whole.assembly, name).outline) -
               area(plate_named(*made.assembly, name).outline);
    };
    const double triangle_left = 0.5 * 3.0 * 10.0;
    const double triangle_right = 0.5 * 4.0 * 10.0;
    EXPECT_NEAR(lost("piece/left"), 6.0 * 12.0 + 25.0 + triangle_left, 1e-6);
    EXPECT_NEAR(lost("piece/right"), 10.0 * 12.0 + triangle_right, 1e-6);
    const Polygon& left = plate_named(*made.assembly, "piece/left").outline;
    const Polygon& right = plate_named(*made.assembly, "piece/right").outline;
    EXPECT_EQ(left.holes.size(), 1U);
    EXPECT_TRUE(right.holes.empty());
    EXPECT_NEAR(area(unite({left, right})), area(left) + area(right), 1e-6) << "the halves overlap";
    // What is left of the fold: 0 to 40, 52 to 60, 70 to 80.
    std::vector<std::pair<double, double>> folded;
    for (const Line& line : made.assembly->lines) {
        if (line.kind == LineKind::mountain) folded.emplace_back(line.at.a.y, line.at.b.y);
    }
    std::sort(folded.begin(), folded.end());
    ASSERT_EQ(folded.size(), 3U);
    const std::vector<std::pair<double, double>> wanted{{0.0, 40.0}, {52.0, 60.0}, {70.0, 80.0}};
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_NEAR(folded[i].first, wanted[i].first, 1e-6);
        EXPECT_NEAR(folded[i].second, wanted[i].second, 1e-6);
    }
}

TEST(Silhouette, HolesNeedNoDrawnOutline) {
    for (const auto& [type, points] : {std::pair("v-fold", kVFold), std::pair("tent", kTent)}) {
        const Made whole = make(type, points, "");
        const Made made = make(type, std::string(points) + "<hole d='M -4 6 H 4 V 12 H -4 Z'/>", "");
        ASSERT_TRUE(whole.assembly && made.assembly) << made.text;
        double lost = 0.0;
        for (const std::string_view half : {"piece/left", "piece/right"}) {
            lost += area(plate_named(*whole.assembly, half).outline) -
                    area(plate_named(*made.assembly, half).outline);
        }
        EXPECT_NEAR(lost, 8.0 * 6.0, 1e-6) << type;
    }
}

TEST(Silhouette, OlderDocumentsAreToldThatTheyHaveNone) {
    const Made made = make("v-fold", kVFold, "M 0 0 L 40 30 L 0 90 L -40 30 Z", "", "2.0");
    EXPECT_TRUE(made.assembly);
    ASSERT_EQ(made.findings.size(), 1U) << made.text;
    EXPECT_EQ(made.findings.front().code, "newer-element");
}

// Borders that wander at random between the seams.
TEST(Silhouette, RandomOutlinesAreDividedWhereverTheirFoldIs) {
    Random random(7);
    std::size_t divided = 0;
    for (int round = 0; round < 80; ++round) {
        std::string outline = "M 0 0 L 40 30";
        double sum = 0.0;  // twice the area, by the shoelace formula
        Vec2 before{40, 30};
        const int corners = 3 + static_cast<int>(random.below(12));
        // From the right seam to the left one, in polar angles about (0, 40).
        for (int i = 0; i <= corners; ++i) {
            const double angle = -0.2 + (3.14159265358979 + 0.4) * (i + 0.5) / (corners + 1.0);
            const double far = 15.0 + 40.0 * random.unit();
            Vec2 p{std::round(1e3 * far * std::cos(angle)) / 1e3,
                   std::round(1e3 * (40 + far * std::sin(angle))) / 1e3};
            outline += " L " + std::to_string(p.x) + " " + std::to_string(p.y);
            sum += cross(before, p);
            before = p;
        }
        sum += cross(before, {-40, 30});
        const Made made = make("v-fold", kVFold, outline + " L -40 30 Z");
        if (!made.assembly) continue;
        ++divided;
        SCOPED_TRACE(outline);
        const double whole = area(plate_named(*made.assembly, "piece/left").outline) +
                             area(plate_named(*made.assembly, "piece/right").outline);
        EXPECT_NEAR(whole, 0.5 * sum, 0.01);
        if (round % 20 == 0) expect_divided(*made.assembly, 0.5 * sum);
    }
    EXPECT_GT(divided, 40U);
}

}  // namespace
}  // namespace popup::test
