// Where two plates cross in one pose, held against what can be said by hand.
#include "motion/crossing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/plate_shape.h"
#include "popup/assembly.h"

namespace popup {
namespace {

PlateShape shape_of(Ring outer) {
    Plate plate;
    plate.outline.outer = std::move(outer);
    return plate_shape(plate);
}

// b's page turned about the y axis that both pages have.
Frame turned(double angle) {
    Frame frame;
    frame.axes = {Vec3{std::cos(angle), 0.0, std::sin(angle)}, Vec3{0.0, 1.0, 0.0},
                  Vec3{-std::sin(angle), 0.0, std::cos(angle)}};
    return frame;
}

// Two plates that turn about a long edge of one, and cross in a short stretch behind its end: the search for
// the point furthest inside must not be spent on the edge.
TEST(Crossing, IsFoundBehindTheEndOfAnEdgeThatRunsAlongTheLine) {
    constexpr double kTip = 0.05;
    // The edge is x = 0 up to y = 200; beyond, there is paper on both sides.
    const Ring drawn{{0.0, 0.0}, {10.0, 0.0}, {10.0, 240.0}, {-10.0, 240.0}, {-10.0, 200.0}, {0.0, 200.0}};
    Ring mirrored;
    for (auto p = drawn.rbegin(); p != drawn.rend(); ++p) mirrored.push_back({-p->x, p->y});
    // A tip that reaches a little over the end.
    const PlateShape b =
        shape_of({{-5.0, 0.0}, {5.0, 0.0}, {5.0, 200.0}, {0.0, 200.0 + kTip}, {-5.0, 200.0}});
    // From (0, y) to the end of a's edge it is y - 200, to the sides of b's tip (200 + tip - y) * cosine.
    const double cosine = 5.0 / std::hypot(5.0, kTip);
    const double furthest = kTip * cosine / (1.0 + cosine);
    for (const Ring& outline : {drawn, mirrored}) {
        const PlateShape a = shape_of(outline);
        for (const double angle : {0.3, 1.0, 1.6, 2.8}) {
            const auto found = CrossingTest()(a, b, turned(angle));
            ASSERT_TRUE(found) << angle;
            EXPECT_NEAR(found->inside_mm, furthest, 0.02 * furthest + 1e-4) << angle;
            EXPECT_GE(found->inside_at_most_mm, furthest - 1e-9) << angle;
            EXPECT_LE(found->inside_at_most_mm, 1.1 * furthest) << angle;
            EXPECT_NEAR(found->sine, std::abs(std::sin(angle)), 1e-12);
        }
    }
}

// Along the edge alone they touch, and no point is inside.
TEST(Crossing, IsNoneInsideWhereAnEdgeRunsAlongTheLine) {
    const PlateShape a = shape_of({{0.0, 0.0}, {10.0, 0.0}, {10.0, 200.0}, {0.0, 200.0}});
    const PlateShape b = shape_of({{-5.0, -10.0}, {5.0, -10.0}, {5.0, 210.0}, {-5.0, 210.0}});
    for (const double angle : {0.3, 1.6, 2.8}) {
        const auto found = CrossingTest()(a, b, turned(angle));
        if (!found) continue;
        EXPECT_LE(found->inside_mm, 1e-6);
        EXPECT_LE(found->inside_at_most_mm, 1e-6);
        EXPECT_FALSE(found->firm());
    }
}

}  // namespace
}  // namespace popup
