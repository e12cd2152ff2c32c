// Guarantees of levelled horizons: on the open card every point of the row is at its height, and over the
// centre fold the picture is one. The heights are worked out here, from the angles that the cards are drawn
// with, and not with the frames that the levelling uses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/geometry/regions.h"
#include "input/xml/read.h"
#include "popup/check.h"
#include "popup/image.h"
#include "popup/motion.h"
#include "support/designs.h"
#include "support/pictures.h"
#include "support/random.h"

namespace popup::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::string number(double value) { return fmt::format("{:.9f}", value); }

// A v-fold whose centre fold runs up its page from (0, 0): the V's halves are `alpha` and `beta` from the
// fold's direction, the piece's `gamma` and `eta` from the centre fold.
struct VFold {
    double alpha = 60.0, beta = 60.0;
    double gamma = 78.0, eta = 78.0;
    double arm = 50.0, high = 60.0;

    [[nodiscard]] static Vec2 at(double length, double deg) {
        return {length * std::sin(deg * kDegree), length * std::cos(deg * kDegree)};
    }
    [[nodiscard]] std::string structure(const std::string& id = "v") const {
        const Vec2 g = at(arm, -gamma);
        const Vec2 h = at(arm, eta);
        std::string text = "<structure type='v-fold' id='" + id + "'><outerpoints>";
        for (const Vec2 p :
             {at(arm, -alpha), Vec2{}, at(arm, beta), g, Vec2{}, h, Vec2{h.x, high}, Vec2{g.x, high}})
            text += "<point x='" + number(p.x) + "' y='" + number(p.y) + "'/>";
        return text +
               "</outerpoints><parentfold><begin x='0' y='-90'/><end x='0' y='90'/></parentfold></structure>";
    }
    // How high a point of the page is on the open card. The centre fold has known angles with both seams,
    // which lie on the base: that fixes its direction. Each half is spanned by the fold and its seam.
    [[nodiscard]] double height(Vec2 p, bool left) const {
        const Vec2 a = at(1.0, -alpha);
        const Vec2 b = at(1.0, beta);
        const double on_a = std::cos(gamma * kDegree);
        const double on_b = std::cos(eta * kDegree);
        const double det = cross(a, b);
        const Vec2 flat{(on_a * b.y - on_b * a.y) / det, (a.x * on_b - b.x * on_a) / det};
        const double up = std::sqrt(1.0 - dot(flat, flat));
        const Vec2 seam = left ? at(1.0, -gamma) : at(1.0, eta);
        // p = s (0, 1) + t seam
        return (p.y - p.x / seam.x * seam.y) * up;
    }
};

ReadOptions with_picture() {
    ReadOptions options;
    options.program.read_file = [](const std::string& name) -> std::optional<Source> {
        return Source{name, png_of(40, 20)};
    };
    return options;
}

struct Made {
    std::optional<Assembly> drawn, levelled;
    std::string text;
};

Made make(const std::string& structures, const std::string& prints, const AssembleOptions& options = {}) {
    Made made;
    Diagnostics diagnostics;
    const auto design =
        xml::read({"card.xml",
                   "<popup version='3.0' units='mm'><mainpage width='240' height='190'/>"
                   "<structurelist>" +
                       structures + "</structurelist><drawnlinelist>" + prints + "</drawnlinelist></popup>"},
                  with_picture(), diagnostics);
    const auto checked = design ? check(*design, {}, diagnostics) : std::nullopt;
    if (checked) {
        made.drawn = assemble(*checked, {}, diagnostics);
        made.levelled = assemble(*checked, options, diagnostics);
        level_horizons(*made.levelled, diagnostics);
    }
    made.text = findings(diagnostics);
    return made;
}

const Image* image_on(const Assembly& assembly, std::string_view plate) {
    for (const Plate& one : assembly.plates) {
        if (one.name != plate) continue;
        for (const Print& print : one.prints) {
            if (const auto* image = std::get_if<Image>(&print)) return image;
        }
    }
    return nullptr;
}

Vec2 pixel_at(const Image& image, Vec2 p) {
    const double scale = 1.0 / cross(image.place.x, image.place.y);
    const Vec2 from = p - image.place.origin;
    return {scale * cross(from, image.place.y), scale * cross(image.place.x, from)};
}

// A picture whose horizon is a quarter of its height above its lower edge.
std::string picture(const std::string& more,
                    const std::string& at = "x='-70' y='-10' width='140' height='70'") {
    return "<image page='1' href='sea.png' " + at + " " + more + "/>";
}

TEST(Horizon, RowsOfBothHalvesAreLevelAndAtTheirHeight) {
    Random random(20260101);
    const auto between = [&random](double least, double most) {
        return least + (most - least) * random.unit();
    };
    int seen = 0;
    for (int round = 0; round < 60; ++round) {
        VFold fold;
        fold.alpha = between(40.0, 75.0);
        fold.beta = fold.alpha + between(-6.0, 6.0);
        // It folds flat when a + g = b + h.
        const double sum = fold.alpha + between(64.0, 92.0);
        fold.gamma = sum - fold.alpha;
        fold.eta = sum - fold.beta;
        if (fold.gamma < fold.beta + 12.0 || fold.eta < fold.alpha + 12.0) continue;
        const double turn = between(-12.0, 12.0);
        const double height = between(5.0, 40.0);
        SCOPED_TRACE(fmt::format("{} {} {} {} turned {}", fold.alpha, fold.beta, fold.gamma, fold.eta, turn));
        const Made made =
            make(fold.structure(),
                 picture(fmt::format("rotate='{}' horizon='0.25' horizonheight='{}'", turn, height)));
        ASSERT_TRUE(made.levelled) << made.text;
        EXPECT_EQ(made.text, "");
        for (const bool left : {true, false}) {
            const Image* image = image_on(*made.levelled, left ? "v/left" : "v/right");
            ASSERT_NE(image, nullptr);
            EXPECT_FALSE(image->horizon);
            for (int x = 0; x <= 40; ++x) {
                // 20 rows: a quarter above the lower edge is 15 rows below the upper one.
                EXPECT_NEAR(fold.height(image->place.point({static_cast<double>(x), 15.0}), left), height,
                            1e-5);
            }
        }
        // Over the centre fold, coordinate by coordinate: the same pixels meet.
        const Image* left = image_on(*made.levelled, "v/left");
        const Image* right = image_on(*made.levelled, "v/right");
        for (int i = 0; i <= 60; ++i) {
            const Vec2 p{0.0, static_cast<double>(i)};
            EXPECT_LT(distance(pixel_at(*left, p), pixel_at(*right, p)), 1e-5);
        }
        // Off the fold they do not: the test can fail.
        EXPECT_GT(distance(pixel_at(*left, {30.0, 30.0}), pixel_at(*right, {30.0, 30.0})), 0.1);
        ++seen;
    }
    EXPECT_GT(seen, 30);
}

TEST(Horizon, WithoutAHeightThePointsOfTheFoldStay) {
    const VFold fold;
    const Made made = make(fold.structure(), picture("horizon='0.25'"));
    ASSERT_TRUE(made.levelled) << made.text;
    for (const std::string_view plate : {"v/left", "v/right"}) {
        const Image* before = image_on(*made.drawn, plate);
        const Image* after = image_on(*made.levelled, plate);
        ASSERT_TRUE(before != nullptr && after != nullptr);
        for (int i = 0; i <= 60; ++i) {
            const Vec2 p{0.0, static_cast<double>(i)};
            EXPECT_LT(distance(pixel_at(*before, p), pixel_at(*after, p)), 1e-6);
        }
        const double first = fold.height(after->place.point({0.0, 15.0}), plate == "v/left");
        EXPECT_NEAR(fold.height(after->place.point({40.0, 15.0}), plate == "v/left"), first, 1e-5);
    }
}

TEST(Horizon, OfTheWholeCardLevelsEveryPicture) {
    const VFold fold;
    AssembleOptions all;
    all.horizon_mm = 25.0;
    const std::string with_row = picture("horizon='0.25'");
    const std::string without = picture("");
    {
        const Made made = make(fold.structure(), with_row, all);
        ASSERT_TRUE(made.levelled) << made.text;
        const Image* image = image_on(*made.levelled, "v/right");
        EXPECT_NEAR(fold.height(image->place.point({33.0, 15.0}), false), 25.0, 1e-5);
    }
    {
        // Which row is the horizon is not known: all rows are level, at the height that they have on the
        // fold.
        const Made made = make(fold.structure(), without, all);
        ASSERT_TRUE(made.levelled) << made.text;
        const Image* before = image_on(*made.drawn, "v/right");
        const Image* after = image_on(*made.levelled, "v/right");
        for (double row = 0.0; row <= 20.0; row += 2.0) {
            const double high = fold.height(before->place.point({20.0, row}), false);
            for (double x = 0.0; x <= 40.0; x += 8.0)
                EXPECT_NEAR(fold.height(after->place.point({x, row}), false), high, 1e-5);
        }
    }
    // The height of the picture's own goes first.
    const Made own = make(fold.structure(), picture("horizon='0.25' horizonheight='12'"), all);
    const Image* image = image_on(*own.levelled, "v/left");
    EXPECT_NEAR(fold.height(image->place.point({3.0, 15.0}), true), 12.0, 1e-5);
}

// On the base, and on what lies flat on the open card, nothing changes.
TEST(Horizon, FlatPlatesKeepTheirPictureAndSaySo) {
    const Made made = make(VFold{}.structure(),
                           "<image page='0' href='sea.png' x='-90' y='-80' width='180' horizon='0.5'/>");
    ASSERT_TRUE(made.levelled) << made.text;
    EXPECT_NE(made.text.find("horizon-flat"), std::string::npos) << made.text;
    EXPECT_NE(made.text.find("\"page/left\""), std::string::npos) << made.text;
    for (const std::string_view plate : {"page/left", "page/right"}) {
        const Image* image = image_on(*made.levelled, plate);
        ASSERT_NE(image, nullptr);
        EXPECT_EQ(image->place.origin, (Vec2{-90.0, 10.0}));
        EXPECT_EQ(image->place.x, (Vec2{4.5, 0.0}));
        EXPECT_FALSE(image->horizon);
    }
}

TEST(Horizon, RowsAlongTheFoldStayAsTheyAre) {
    const Made made = make(VFold{}.structure(), picture("rotate='90' horizon='0.5' horizonheight='20'",
                                                        "x='40' y='-10' width='70' height='80'"));
    ASSERT_TRUE(made.levelled) << made.text;
    EXPECT_NE(made.text.find("horizon-upright"), std::string::npos) << made.text;
    EXPECT_EQ(image_on(*made.levelled, "v/left")->place, image_on(*made.drawn, "v/left")->place);
}

// A piece of one plate has no centre fold: its picture is sheared along the line of steepest rise.
TEST(Horizon, ASinglePlateIsLevelledByItself) {
    const VFold fold;
    const std::string leaf =
        "<structure type='attached-plane' id='leaf'><outerpoints><point page='1' x='10' y='20'/>"
        "<point page='1' x='14' y='40'/><point x='0' y='0'/><point x='0' y='20.396078'/></outerpoints>"
        "<outline d='M 0 0 H 30 V 20.396078 H 0 Z'/><parentplate page='1' x='15' y='30'/></structure>";
    const Made made = make(fold.structure() + leaf,
                           "<image page='2' href='sea.png' x='-2' y='-4' width='60' "
                           "rotate='7' horizon='0.25' horizonheight='30'/>");
    ASSERT_TRUE(made.levelled) << made.text;
    const Image* image = image_on(*made.levelled, made.levelled->plates.back().name);
    ASSERT_NE(image, nullptr);
    // The leaf's page lies on the plate's: (0, 0) on (10, 20), (0, 20.4) on (14, 40).
    const Vec2 up = unit(Vec2{4.0, 20.0});
    const Vec2 right = right_of(up);
    for (double x = 0.0; x <= 40.0; x += 4.0) {
        const Vec2 on_leaf = image->place.point({x, 15.0});
        EXPECT_NEAR(fold.height(Vec2{10.0, 20.0} + on_leaf.x * right + on_leaf.y * up, false), 30.0, 1e-4);
    }
}

// Plates that are folded to the halves: the picture goes on over the folds between, level there too. Heights
// are those of the frames here, for these plates are in the angle of nothing that is drawn.
TEST(Horizon, GoesOnOverPlatesThatAreCutFromThePiece) {
    const VFold fold;
    const std::string beak =
        "<structure type='inverted-beak' id='beak'><outerpoints><point x='0' y='20'/><point x='-12' y='34'/>"
        "<point x='12' y='34'/></outerpoints><parentfold page='1'><begin x='0' y='0'/><end x='0' y='60'/>"
        "</parentfold></structure>";
    const Made made = make(fold.structure() + beak, picture("horizon='0.25' horizonheight='27'"));
    ASSERT_TRUE(made.levelled) << made.text;
    EXPECT_EQ(made.text, "");
    const Assembly& assembly = *made.levelled;
    std::vector<Frame> frames(assembly.plates.size());
    ASSERT_TRUE(place(assembly, Angle::degrees(180), frames));
    int seen = 0;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Image* image = image_on(assembly, assembly.plates[i].name);
        if (image == nullptr) continue;
        ++seen;
        for (double x = 0.0; x <= 40.0; x += 4.0)
            EXPECT_NEAR(frames[i].point(image->place.point({x, 15.0})).z, 27.0, 1e-5)
                << assembly.plates[i].name;
    }
    EXPECT_EQ(seen, 4) << "two halves, and two of the beak";
    int met = 0;
    for (const Hinge& hinge : assembly.hinges) {
        const Image* a = image_on(assembly, assembly.plates[static_cast<std::size_t>(hinge.a)].name);
        const Image* b = image_on(assembly, assembly.plates[static_cast<std::size_t>(hinge.b)].name);
        if (hinge.glued || a == nullptr || b == nullptr) continue;
        double worst = 0.0;
        for (const double t : {0.0, 0.5, 1.0}) {
            const Vec2 p = lerp(hinge.a_line.a, hinge.a_line.b, t);
            worst = std::max(worst, distance(pixel_at(*a, p), pixel_at(*b, p)));
        }
        met += worst < 1e-5 ? 1 : 0;
    }
    // Four plates round a point have four folds, of which three lead from one to the next.
    EXPECT_GE(met, 3);
}

// A picture that the shear takes onto a plate is there, and one that it takes off is not.
TEST(Horizon, GoesToThePlatesThatItShowsOn) {
    const VFold fold;
    // Drawn to the left of the fold and at its foot, out of the piece.
    const Made off = make(fold.structure(), picture("horizon='0.25' horizonheight='70'",
                                                    "x='-20' y='0' width='10' height='5'"));
    ASSERT_TRUE(off.levelled) << off.text;
    EXPECT_EQ(image_on(*off.levelled, "v/left"), nullptr);
    EXPECT_EQ(image_on(*off.levelled, "v/right"), nullptr);
    const Made on = make(fold.structure(), picture("horizon='0.25' horizonheight='30'",
                                                   "x='-20' y='-40' width='10' height='5'"));
    ASSERT_TRUE(on.levelled) << on.text;
    for (const Plate& plate : on.drawn->plates) {
        if (plate.name != "v/left") continue;
        EXPECT_TRUE(intersect(shown_regions(*image_on(*on.drawn, "v/left")), {plate.outline}).empty())
            << "it was out of the piece";
    }
    EXPECT_NE(image_on(*on.levelled, "v/left"), nullptr);
}

}  // namespace
}  // namespace popup::test
