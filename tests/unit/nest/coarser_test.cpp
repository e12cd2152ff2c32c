// Outlines of fewer corners hold those that they stand for.
#include "nest/coarser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "base/geometry/regions.h"
#include "nest/inside.h"
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

GridRing ring_of_spikes(int spikes, double wide, double high) {
    Ring ring{{0.0, 0.0}};
    for (int i = 0; i < spikes; ++i) {
        const double x = wide * i;
        ring.insert(ring.end(), {{x + 0.3 * wide, -high}, {x + 0.6 * wide, high}, {x + wide, 0.0}});
    }
    ring.insert(ring.end(), {{wide * spikes, 4.0 * high}, {0.0, 4.0 * high}});
    return turned_ring(ring, {});
}

// Long rows of spikes have much edge for their area: more of it may be gained, until few corners are left.
TEST(NestParts, OfManyCornersMoreMayBeGained) {
    const GridRegion fine{ring_of_spikes(1000, 1.8, 40.0), {}};
    Coarsening how;
    how.most_added = 1e-4 * 288e3 * 1e12;
    how.furthest = 3.6e6;
    how.encloses = true;
    const GridRegion less = coarser(fine, how);
    how.many = 500;
    how.most_added_of_many = 0.3 * 288e3 * 1e12;
    const GridRegion more = coarser(fine, how);
    EXPECT_GT(less.outer.size(), 500U);
    EXPECT_LE(more.outer.size(), 500U);
    EXPECT_TRUE(is_inside(fine, less));
    EXPECT_TRUE(is_inside(fine, more));
    EXPECT_TRUE(is_inside(less, more));
    EXPECT_FALSE(is_inside(less, fine));
}

// The same by looking at each edge and each corner.
bool is_inside_by_all(const GridRegion& region, const GridRegion& other) {
    const auto edges = [](const GridRegion& of) {
        std::vector<std::pair<GridPoint, GridPoint>> all;
        const auto add = [&](const GridRing& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i)
                all.emplace_back(ring[i] + ring[i],
                                 ring[(i + 1) % ring.size()] + ring[(i + 1) % ring.size()]);
        };
        add(of.outer);
        for (const GridRing& hole : of.holes) add(hole);
        return all;
    };
    const auto on = [](GridPoint a, GridPoint p, GridPoint b) {
        return cross(b - a, p - a) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
               std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
    };
    const auto own = edges(region);
    const auto others = edges(other);
    // By the even-odd rule, edges included.
    const auto holds = [&](const std::vector<std::pair<GridPoint, GridPoint>>& all, GridPoint p) {
        bool inside = false;
        for (const auto& [a, b] : all) {
            if (on(a, p, b)) return true;
            if ((a.y <= p.y) != (b.y <= p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y)) inside = !inside;
        }
        return inside;
    };
    for (const auto& [p, q] : own) {
        for (const auto& [a, b] : others) {
            if (cross_each_other(p, q, a, b) || (a != p && a != q && on(p, a, q))) return false;
        }
        if (!holds(others, {(p.x + q.x) / 2, (p.y + q.y) / 2})) return false;
    }
    // A hole of the other in the region would be missing of it.
    return std::all_of(other.holes.begin(), other.holes.end(), [&](const GridRing& hole) {
        return std::all_of(hole.begin(), hole.end(), [&](GridPoint p) {
            return !holds(own, p + p) || std::any_of(own.begin(), own.end(), [&](const auto& edge) {
                return on(edge.first, p + p, edge.second);
            });
        });
    });
}

// Stars of all sorts on a coarse grid, where many corners and edges meet, with and without a hole.
TEST(NestParts, WhatIsInsideIsWhatEachEdgeSays) {
    std::mt19937 random(4);
    const auto star = [&](int corners, double size, GridPoint at, bool clockwise) {
        GridRing ring;
        for (int i = 0; i < corners; ++i) {
            const double angle = (clockwise ? -2.0 : 2.0) * std::numbers::pi * i / corners;
            const double r = size * number(random, 0.5, 1.0);
            const GridPoint p{at.x + std::llround(r * std::cos(angle)),
                              at.y + std::llround(r * std::sin(angle))};
            if (ring.empty() || ring.back() != p) ring.push_back(p);
        }
        if (ring.front() == ring.back()) ring.pop_back();
        return ring;
    };
    int inside = 0;
    constexpr int kRounds = 3000;
    for (int round = 0; round < kRounds; ++round) {
        const GridPoint middle{static_cast<GridLength>(random() % 5), static_cast<GridLength>(random() % 5)};
        GridRegion region{star(5 + round % 40, 24.0, middle, false), {}};
        GridRegion other{star(5 + round % 60, round % 3 == 0 ? 30.0 : 50.0, {}, false), {}};
        if (round % 4 >= 2) region.holes.push_back(star(9, 8.0, middle, true));
        if (round % 2 == 1) other.holes.push_back(star(7, 6.0, {}, true));
        const bool expected = is_inside_by_all(region, other);
        EXPECT_EQ(is_inside(region, other), expected) << round;
        if (expected) ++inside;
    }
    EXPECT_GT(inside, kRounds / 10);
    EXPECT_LT(inside, kRounds * 9 / 10);
}

}  // namespace
}  // namespace popup
