// Triangles by cutting off ears: each place once, and what cannot be done so is left to others.
#include "base/geometry/ears.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "support/random.h"

namespace popup {
namespace {

double twice_area_of(const Triangulation& all, const std::array<std::uint32_t, 3>& t) {
    return cross(all.points[t[1]] - all.points[t[0]], all.points[t[2]] - all.points[t[0]]);
}

// A ring round the origin whose corners lie at any distance from it.
Ring star(test::Random& random, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / corners;
        ring.push_back((1.0 + 19.0 * random.unit()) * Vec2{std::cos(turn), std::sin(turn)});
    }
    return ring;
}

// Even-odd, by a ray to the right.
bool lies_in(const Ring& ring, Vec2 p) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i];
        const Vec2 b = ring[(i + 1) % ring.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

TEST(Ears, CoverEachPlaceOfARingOnceAndNothingElse) {
    test::Random random(11);
    for (int round = 0; round < 300; ++round) {
        const Ring ring = star(random, 4 + round % 60);
        const auto ears = clip_ears({ring, {}});
        ASSERT_TRUE(ears.has_value()) << round;
        ASSERT_EQ(ears->triangles.size() + 2, ears->points.size());
        for (const auto& t : ears->triangles) EXPECT_GT(twice_area_of(*ears, t), 0.0);
        for (int i = 0; i < 200; ++i) {
            const Vec2 p{40.0 * random.unit() - 20.0, 40.0 * random.unit() - 20.0};
            const auto count =
                std::count_if(ears->triangles.begin(), ears->triangles.end(), [&](const auto& t) {
                    return lies_in({ears->points[t[0]], ears->points[t[1]], ears->points[t[2]]}, p);
                });
            EXPECT_EQ(count, lies_in(ring, p) ? 1 : 0) << round;
        }
    }
}

// One cut beside the other would give a fan: what asks where triangles are would find all of them everywhere.
TEST(Ears, AreNoFan) {
    Ring ring;
    for (int i = 0; i < 128; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / 128;
        ring.push_back(20.0 * Vec2{std::cos(turn), std::sin(turn)});
    }
    ring.push_back({19.0, 0.0});
    const auto ears = clip_ears({ring, {}});
    ASSERT_TRUE(ears.has_value());
    double boxes = 0.0;
    for (const auto& t : ears->triangles) {
        Box box;
        for (const std::uint32_t corner : t) box.extend(ears->points[corner]);
        boxes += box.width() * box.height();
    }
    // Of a fan they would cover it more than thirty times.
    EXPECT_LT(boxes, 8.0 * std::numbers::pi * 20.0 * 20.0);
}

TEST(Ears, LeaveOutCornersOnStraightEdges) {
    const auto ears = clip_ears({{{0, 0}, {5, 0}, {10, 0}, {10, 10}, {5, 2}, {0, 10}}, {}});
    ASSERT_TRUE(ears.has_value());
    EXPECT_EQ(ears->points.size(), 5U);
    EXPECT_EQ(ears->triangles.size(), 3U);
}

TEST(Ears, KeepACornerThatIsDoubled) {
    const auto ears = clip_ears({{{0, 0}, {10, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}, {}});
    ASSERT_TRUE(ears.has_value());
    EXPECT_EQ(ears->points.size(), 4U);
    double area = 0.0;
    for (const auto& t : ears->triangles) area += 0.5 * twice_area_of(*ears, t);
    EXPECT_DOUBLE_EQ(area, 100.0);
}

TEST(Ears, AreNotLookedForWhereThereAreHolesOrNoArea) {
    const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    EXPECT_FALSE(clip_ears({square, {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}}}).has_value());
    EXPECT_FALSE(clip_ears({{{0, 0}, {10, 0}, {5, 0}}, {}}).has_value());
    EXPECT_FALSE(clip_ears({Ring(square.rbegin(), square.rend()), {}}).has_value());
}

}  // namespace
}  // namespace popup
