// Guarantees of the motion: rigid plates, closed seams, flat when closed, no jumps, and the same result as a
// solver that shares nothing with the closed form.
#include "popup/motion.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/designs.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

std::vector<Angle> whole_degrees() {
    std::vector<Angle> angles;
    for (int deg = 0; deg <= 180; ++deg) angles.push_back(Angle::degrees(deg));
    return angles;
}

std::vector<Frame> frames_at(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames)) << deg;
    return frames;
}

int plate(const Assembly& assembly, const std::string& name) {
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        if (assembly.plates[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << "no plate " << name;
    return 0;
}

// A v-fold about the origin with the V's half angles a and b and a piece of the angle sum, seams `seam` long.
std::vector<Vec2> v_fold(double a, double b, double sum, double seam = 60.0) {
    const Vec2 e{0, -40};
    const Vec2 g = e + rotated({0, seam}, 0.5 * sum * kDeg);
    const Vec2 h = e + rotated({0, seam}, -0.5 * sum * kDeg);
    return {rotated({0, seam}, a * kDeg),
            {0, 0},
            rotated({0, seam}, -b * kDeg),
            g,
            e,
            h,
            h + Vec2{0, 60},
            g + Vec2{0, 60}};
}

double angle_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)) / kDeg; }

// The direction of the centre fold of element e1 (shared by its plates), seen from both.
std::pair<Vec3, Vec3> centre_directions(const Assembly& assembly, const std::vector<Frame>& frames) {
    const auto& bars = std::get<FourBar>(assembly.joints.back().how);
    return {frames[static_cast<std::size_t>(bars.left.plate)].direction(bars.left.own_centre),
            frames[static_cast<std::size_t>(bars.right.plate)].direction(bars.right.own_centre)};
}

TEST(Motion, BasePlanesAreExactWhenClosedAndWhenOpen) {
    const Built built = build(card());
    const auto closed = frames_at(*built.assembly, 0);
    EXPECT_EQ(closed[0].point({-10, 5}), (Vec3{0, 5, 10}));
    EXPECT_EQ(closed[1].point({10, 5}), (Vec3{0, 5, 10}));
    const auto open = frames_at(*built.assembly, 180);
    EXPECT_EQ(open[0].point({-10, 5}), (Vec3{-10, 5, 0}));
    EXPECT_EQ(open[1].point({10, 5}), (Vec3{10, 5, 0}));
    const auto half = frames_at(*built.assembly, 90);
    EXPECT_NEAR(half[1].point({10, 0}).x, 10 * std::sin(45 * kDeg), 1e-12);
    EXPECT_NEAR(half[1].point({10, 0}).z, 10 * std::cos(45 * kDeg), 1e-12);
}

TEST(Motion, SeamsOfGeneratedDesignsStayClosedAndPlatesRigid) {
    for (int seed = 1; seed <= test::sanitized_count(40); ++seed) {
        SCOPED_TRACE(seed);
        const Built built = build(generate(static_cast<std::uint64_t>(seed), 14));
        ASSERT_TRUE(built.assembly);
        Diagnostics diagnostics;
        MotionOptions options;
        options.angles = whole_degrees();
        const auto motion = simulate(*built.assembly, options, diagnostics);
        ASSERT_TRUE(motion) << findings(diagnostics);
        EXPECT_LE(motion->max_closure_mm, 1e-9);
        EXPECT_TRUE(motion->flat_closed);
        EXPECT_LE(motion->flat_error_deg, 1e-6);
        for (const double deg : {0.0, 1.0, 45.0, 179.0, 180.0}) {
            for (const Frame& f : frames_at(*built.assembly, deg)) {
                for (std::size_t i = 0; i < 3; ++i) {
                    EXPECT_NEAR(length(f.axes[i]), 1.0, 1e-13);
                    EXPECT_NEAR(dot(f.axes[i], f.axes[(i + 1) % 3]), 0.0, 1e-13);
                }
                EXPECT_NEAR(dot(cross(f.axes[0], f.axes[1]), f.axes[2]), 1.0, 1e-13);
            }
        }
    }
}

TEST(Motion, OpenCardOfCutElementsIsTheFlatPattern) {
    Design design = card();
    add(design, "step", {{-40, -30}, {-40, 30}, {25, -20}, {25, 35}});
    add(design, "beak", {{0, 90}, {-20, 60}, {25, 70}});
    const Built built = build(design);
    for (const Frame& frame : frames_at(*built.assembly, 180)) {
        const Vec3 p = frame.point({12, 34});
        EXPECT_NEAR(p.x, 12, 1e-12);
        EXPECT_NEAR(p.y, 34, 1e-12);
        EXPECT_NEAR(p.z, 0, 1e-12);
    }
}

// The pair of GEOMETRY: a = 60, b = 50 and a piece of 150. On a valley fold only g = 70, h = 80 lies flat
// inside.
TEST(Motion, AsymmetricVFoldOnAValleyClosesInsideTheCard) {
    Design design = card();
    add(design, "v-fold", v_fold(60, 50, 150));
    const Built built = build(design);
    const auto& bars = std::get<FourBar>(built.assembly->joints.back().how);
    EXPECT_NEAR(bars.left.far / kDeg, 70, 1e-9);
    EXPECT_NEAR(bars.right.far / kDeg, 80, 1e-9);
    for (int deg = 0; deg <= 180; ++deg) {
        const auto frames = frames_at(*built.assembly, deg);
        const auto [from_left, from_right] = centre_directions(*built.assembly, frames);
        EXPECT_LT(length(from_left - from_right), 1e-12) << deg;
        // Spherical distances measured in space, from base directions computed here.
        const double s = std::sin(0.5 * deg * kDeg);
        const double c = std::cos(0.5 * deg * kDeg);
        const Vec3 l{-std::sin(60 * kDeg) * s, std::cos(60 * kDeg), std::sin(60 * kDeg) * c};
        const Vec3 r{std::sin(50 * kDeg) * s, std::cos(50 * kDeg), std::sin(50 * kDeg) * c};
        EXPECT_NEAR(angle_between(l, from_left), 70, 1e-6) << deg;
        EXPECT_NEAR(angle_between(r, from_left), 80, 1e-6) << deg;
        EXPECT_GE(from_left.z, -1e-12) << "in front of the page at " << deg;
    }
    const auto closed = centre_directions(*built.assembly, frames_at(*built.assembly, 0)).first;
    EXPECT_NEAR(closed.x, 0, 1e-12);
    EXPECT_NEAR(angle_between(closed, {0, 1, 0}), 130, 1e-9);
}

TEST(Motion, AsymmetricVFoldOnAMountainClosesBeyondTheFold) {
    Design design = card();
    add(design, "step", {{-60, -60}, {-60, 60}, {60, -60}, {60, 60}});
    add(design, "v-fold", v_fold(60, 50, 150, 30));
    const Built built = build(design);
    const auto& bars = std::get<FourBar>(built.assembly->joints.back().how);
    EXPECT_NEAR(bars.left.far / kDeg, 80, 1e-9) << "g - a = h - b";
    EXPECT_NEAR(bars.right.far / kDeg, 70, 1e-9);
    for (int deg = 0; deg <= 180; ++deg) {
        const auto frames = frames_at(*built.assembly, deg);
        const auto [from_left, from_right] = centre_directions(*built.assembly, frames);
        EXPECT_LT(length(from_left - from_right), 1e-12) << deg;
        EXPECT_GE(from_left.z, -1e-12) << deg;
    }
}

TEST(Motion, MirroredDesignMovesMirrored) {
    Design design = card();
    add(design, "v-fold", v_fold(65, 45, 160));
    add(design, "step", {{-40, -90}, {-40, -60}, {25, -85}, {25, -62}});
    Design mirror = design;
    const std::vector<std::vector<std::size_t>> partner{{2, 1, 0, 5, 4, 3, 7, 6}, {2, 3, 0, 1}};
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t i = 0; i < partner[k].size(); ++i) {
            const Vec2 p = design.structures[k].points[partner[k][i]].at;
            mirror.structures[k].points[i].at = {-p.x, p.y};
        }
    }
    const Built a = build(design);
    const Built b = build(mirror);
    for (const double deg : {0.0, 3.0, 60.0, 140.0, 180.0}) {
        const auto fa = frames_at(*a.assembly, deg);
        const auto fb = frames_at(*b.assembly, deg);
        for (const std::string id : {"page", "e1", "e2"}) {
            const Vec3 p = fa[static_cast<std::size_t>(plate(*a.assembly, id + "/left"))].point({-7, 11});
            const Vec3 q = fb[static_cast<std::size_t>(plate(*b.assembly, id + "/right"))].point({7, 11});
            EXPECT_NEAR(p.x, -q.x, 1e-10) << id << " " << deg;
            EXPECT_NEAR(p.y, q.y, 1e-10);
            EXPECT_NEAR(p.z, q.z, 1e-10);
        }
    }
}

// a = b = 80°: with a piece of 200° it lies flat on the open card, with 201° it stops before.
TEST(Motion, TooWideAPieceLocksAndSaysSo) {
    Design design = card();
    add(design, "v-fold", v_fold(80, 80, 185));
    Built built = build(design);
    const auto widen = [&](double sum) {
        auto& bars = std::get<FourBar>(built.assembly->joints.back().how);
        for (Bar* bar : {&bars.left, &bars.right}) {
            const double side = cross(bar->own_seam, bar->own_centre) < 0 ? -1.0 : 1.0;
            bar->own_centre = rotated(bar->own_seam, side * 0.5 * sum * kDeg);
        }
    };
    std::vector<Frame> frames(built.assembly->plates.size());
    widen(200);
    EXPECT_TRUE(place(*built.assembly, Angle::degrees(180), frames));
    EXPECT_NEAR(centre_directions(*built.assembly, frames).first.z, 0.0, 1e-6);
    widen(201);
    int stuck = -1;
    EXPECT_TRUE(place(*built.assembly, Angle::degrees(140), frames));
    EXPECT_FALSE(place(*built.assembly, Angle::degrees(180), frames, &stuck));
    EXPECT_EQ(stuck, static_cast<int>(built.assembly->joints.size()) - 1);
    built.assembly->hinges.clear();  // they still tell of the narrower piece
    Diagnostics diagnostics;
    EXPECT_FALSE(simulate(*built.assembly, {}, diagnostics));
    // sin² g / sin² a = 1 - cos² of half the angle at which it locks.
    const double share = std::sin(100.5 * kDeg) / std::sin(80 * kDeg);
    const double expected = 2.0 * std::asin(share) / kDeg;
    EXPECT_NE(findings(diagnostics).find(fmt::format("error locks: \"e1\" locks at {:.2f}°", expected)),
              std::string::npos)
        << findings(diagnostics) << expected;
}

TEST(Motion, TightTentLiesFlatOnTheOpenCard) {
    Design design = card();
    add(design, "tent",
        {{-30, -30}, {-30, 30}, {40, -30}, {40, 30}, {-35, -30}, {-35, 30}, {35, -30}, {35, 30}});
    const Built built = build(design);
    const auto frames = frames_at(*built.assembly, 180);
    EXPECT_NEAR(std::abs(frames[static_cast<std::size_t>(plate(*built.assembly, "e1/left"))].normal().z), 1.0,
                1e-9);
    Diagnostics diagnostics;
    EXPECT_TRUE(simulate(*built.assembly, {}, diagnostics)) << findings(diagnostics);
}

TEST(Motion, ClosedFormAgreesWithPlacementByDistances) {
    const std::vector<std::pair<std::string, std::vector<Vec2>>> elements{
        {"step", {{-40, -30}, {-40, 30}, {25, -20}, {25, 35}}},
        {"beak", {{0, -20}, {-40, 20}, {25, 30}}},
        {"angled-step", {{-20, 0}, {-40, 40}, {20, 0}, {40, 40}}},
        {"v-fold", v_fold(60, 50, 150)},
        {"tent", {{-30, -30}, {-30, 30}, {40, -30}, {40, 30}, {-50, -30}, {-50, 30}, {60, -30}, {60, 30}}}};
    for (const auto& [type, points] : elements) {
        SCOPED_TRACE(type);
        Design design = card();
        add(design, type, points);
        const Built built = build(design);
        IterativePlacer placer(*built.assembly, 200000, 1e-9);
        std::vector<Frame> other(built.assembly->plates.size());
        for (int deg = 10; deg <= 170; deg += 10) {
            placer.place(Angle::degrees(deg), other);
            const auto frames = frames_at(*built.assembly, deg);
            for (std::size_t i = 0; i < frames.size(); ++i) {
                for (const Vec2 p : built.assembly->plates[i].outline.outer) {
                    EXPECT_LT(distance(frames[i].point(p), other[i].point(p)), 1e-4) << deg;
                }
            }
        }
    }
}

TEST(Motion, WrongMirrorSolutionNeverAppearsOnElementsFarOutOfThePage) {
    // A v-fold carried far out of the page by another, with cut elements on its centre fold and seam.
    Design design = card();
    add(design, "v-fold", v_fold(70, 70, 190, 80));
    add(design, "tent", {{-8, -10}, {-8, 10}, {8, -10}, {8, 10}, {-12, -10}, {-12, 10}, {12, -10}, {12, 10}},
        {0, -40}, {0, 60}, 1);
    const Built built = build(design);
    const auto on_front = [&](double deg) {
        const auto frames = frames_at(*built.assembly, deg);
        const auto& base = frames[static_cast<std::size_t>(plate(*built.assembly, "e1/left"))];
        const auto& tent = frames[static_cast<std::size_t>(plate(*built.assembly, "e2/left"))];
        // A point of the tent's ridge, seen from the plate it stands on: in front of it.
        return dot(base.normal(), tent.point({0, 0}) - base.point({0, 0}));
    };
    for (int deg = 2; deg <= 180; ++deg) EXPECT_GT(on_front(deg), 0.0) << deg;
}

}  // namespace
}  // namespace popup::test
