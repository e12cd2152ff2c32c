// Outlines of fewer corners hold those that they stand for.
#include "nest/coarser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/geometry/regions.h"
#include "nest/shapes.h"

namespace popup {
namespace {

double number(std::mt19937& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

// Coarser shapes hold the fine ones: no corner of the fine one is outside by more than rounding.
TEST(NestParts, CoarserRegionsOnlyGrow) {
    std::mt19937 random(9);
    for (int round = 0; round < 60; ++round) {
        Polygon polygon;
        const int corners = 40 + round;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners;
            polygon.outer.push_back((40 + 8 * std::sin(5 * angle) + number(random, -0.2, 0.2)) *
                                    Vec2{std::cos(angle), std::sin(angle)});
        }
        const GridRegion fine = turned_outline({polygon}, {})[0];
        const double most = 1e-3 * area(polygon) * 1e12;
        const GridRegion rough = coarser(fine, {most, 0.2e6});
        EXPECT_LT(rough.outer.size(), fine.outer.size());
        Polygon grown;
        for (const GridPoint p : rough.outer) grown.outer.push_back({from_grid(p.x), from_grid(p.y)});
        EXPECT_LE(area(grown), area(polygon) * 1.0011);
        for (const Vec2 p : polygon.outer) {
            double away = HUGE_VAL;
            for (std::size_t i = 0; i < grown.outer.size(); ++i)
                away = std::min(
                    away, distance(p, Segment{grown.outer[i], grown.outer[(i + 1) % grown.outer.size()]}));
            EXPECT_TRUE(contains(grown, p) || away <= 2e-6) << away;
        }
    }
}

// Whether two segments have a point in common that is inside both; doubled coordinates, by integers.
bool cross_each_other(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
    const auto side = [](GridPoint p, GridPoint q, GridPoint r) {
        const Wide value = cross(q - p, r - p);
        return value > 0 ? 1 : value < 0 ? -1 : 0;
    };
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

// An outline of very many corners, smooth, rough or toothed, is inside the one that encloses it: no edges
// cross, and its corners are in it or on it.
TEST(NestParts, WhatEnclosesAnOutlineHoldsAllOfIt) {
    std::mt19937 random(15);
    for (const int form : {0, 1, 2}) {
        Polygon polygon;
        const int corners = 2400;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners;
            const double rough = form == 1 ? number(random, -0.05, 0.05) : 0.0;
            const double tooth = form == 2 && i / 2 % 2 == 0 ? 1.5 : 0.0;
            polygon.outer.push_back((40 + 8 * std::sin(5 * angle) + rough + tooth) *
                                    Vec2{std::cos(angle), std::sin(angle)});
        }
        const GridRegion fine = turned_outline({polygon}, Angle::degrees(17.0 * form))[0];
        Coarsening how;
        how.most_added = 2.5e-4 * area(polygon) * 1e12;
        how.furthest = 0.2e6;
        how.encloses = true;
        how.narrow = 1.0e6;
        const GridRegion rough = coarser(fine, how);
        EXPECT_LT(rough.outer.size() * 5, fine.outer.size()) << form;
        EXPECT_TRUE(is_inside(fine, rough)) << form;
        EXPECT_FALSE(is_inside(rough, fine)) << form;
        const GridRing& out = rough.outer;
        for (std::size_t i = 0; i < fine.outer.size(); ++i) {
            const GridPoint p = fine.outer[i];
            const GridPoint q = fine.outer[(i + 1) % fine.outer.size()];
            bool inside = false;
            for (std::size_t k = 0; k < out.size(); ++k) {
                const GridPoint a = out[k];
                const GridPoint b = out[(k + 1) % out.size()];
                ASSERT_FALSE(cross_each_other(p, q, a, b)) << form << ", edge " << i;
                const Wide side = cross(b - a, p - a);
                const bool level = std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
                                   std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
                if (side == 0 && level) {
                    inside = true;
                    break;
                }
                if ((a.y <= p.y) != (b.y <= p.y) && (side > 0) == (b.y > a.y)) inside = !inside;
            }
            EXPECT_TRUE(inside) << form << ", corner " << i;
        }
    }
}

}  // namespace
}  // namespace popup
