// Paper that hangs together in single points comes apart there, and none of it is lost.
#include "input/oa/come_apart.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/geometry/regions.h"
#include "support/random.h"

namespace popup {
namespace {

// What hangs on the rest by a point falls out as what hangs on nothing does.
TEST(ComeApart, PaperThatHangsByAPointComesApart) {
    // A corner on a corner, a corner on an edge, and a hole that touches its outline at two places.
    const Polygon on_corner{{{0, 0}, {10, 0}, {10, 10}, {20, 10}, {20, 20}, {10, 20}, {10, 10}, {0, 10}}, {}};
    const Polygon on_edge{{{0, 0}, {30, 0}, {30, 10}, {15, 0}, {0, 10}}, {}};
    const Polygon cut_through{{{0, 0}, {30, 0}, {30, 10}, {0, 10}}, {{{15, 0}, {10, 5}, {15, 10}, {20, 5}}}};
    for (const Polygon& region : {on_corner, on_edge, cut_through}) {
        const std::vector<Polygon> parts = oa::come_apart({region});
        ASSERT_EQ(parts.size(), 2U);
        EXPECT_NEAR(area(parts), area(std::vector<Polygon>{region}), 1e-9);
        for (const Polygon& part : parts) EXPECT_TRUE(part.holes.empty());
    }
    // A hole that touches its outline at one place parts nothing.
    const Polygon whole{{{0, 0}, {30, 0}, {30, 10}, {0, 10}}, {{{15, 0}, {10, 5}, {15, 8}, {20, 5}}}};
    EXPECT_EQ(oa::come_apart({whole}).size(), 1U);
    EXPECT_EQ(oa::come_apart({whole}).front().holes.size(), 1U);
}

TEST(ComeApart, IsAllThePaperOnce) {
    test::Random random(11);
    const auto box = [&](double most) {
        const auto at = [&](std::size_t n) { return static_cast<double>(random.below(n)); };
        const Vec2 low{at(12), at(12)};
        const Vec2 size{1.0 + at(static_cast<std::size_t>(most)), 1.0 + at(static_cast<std::size_t>(most))};
        // Of some a corner is cut off, so that corners stand on slanting edges, too.
        Ring ring{low, {low.x + size.x, low.y}, low + size, {low.x, low.y + size.y}};
        if (random.below(3) == 0) ring.erase(ring.begin() + 2);
        return Polygon{ring, {}};
    };
    for (int round = 0; round < 3000; ++round) {
        std::vector<Polygon> paper;
        std::vector<Polygon> gone;
        for (std::size_t i = 1 + random.below(4); i-- > 0;) paper.push_back(box(10));
        for (std::size_t i = random.below(7); i-- > 0;) gone.push_back(box(4));
        const std::vector<Polygon> regions = unite(subtract(paper, gone));
        const std::vector<Polygon> parts = oa::come_apart(regions);
        EXPECT_NEAR(area(parts), area(regions), 1e-4) << round;
        EXPECT_NEAR(area(unite(parts)), area(regions), 1e-4) << round;
        for (const Polygon& part : parts) {
            // What is cut off by no more than a hair's breadth around it is in one part with all the rest.
            EXPECT_EQ(offset({part}, -0.01, Corners::sharp).size(), 1U) << round;
        }
    }
}

}  // namespace
}  // namespace popup
