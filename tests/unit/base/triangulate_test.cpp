#include "base/geometry/triangulate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <numbers>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"

namespace popup {
namespace {

Ring rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring backwards(Ring ring) {
    std::reverse(ring.begin(), ring.end());
    return ring;
}

Ring corners(const Triangulation& t, std::size_t i) {
    return {t.points.at(t.triangles[i][0]), t.points.at(t.triangles[i][1]), t.points.at(t.triangles[i][2])};
}

// By the boolean library: nothing of the polygon is left over, nothing lies outside, and the areas add up, so
// that no two triangles overlap.
void expect_cover(const Polygon& polygon, const char* what) {
    const Triangulation result = triangulate(polygon);
    std::vector<Polygon> triangles;
    double sum = 0.0;
    for (std::size_t i = 0; i < result.triangles.size(); ++i) {
        triangles.push_back({corners(result, i), {}});
        const double one = signed_area(triangles.back().outer);
        EXPECT_GT(one, 0.0) << what << ": triangle " << i << " is not counter-clockwise";
        sum += one;
    }
    EXPECT_NEAR(sum, area(polygon), 1e-6 * (1.0 + area(polygon))) << what;
    double left_over = 0.0;
    for (const Polygon& rest : subtract({polygon}, triangles)) left_over += area(rest);
    double outside = 0.0;
    for (const Polygon& rest : subtract(triangles, {polygon})) outside += area(rest);
    EXPECT_NEAR(left_over, 0.0, 1e-4) << what;
    EXPECT_NEAR(outside, 0.0, 1e-4) << what;
}

Polygon sieve(int rows) {
    Polygon result;
    result.outer = rectangle(0, 0, 10.0 * rows, 10.0 * rows);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < rows; ++j) {
            const double x = 10.0 * i + 3.0;
            const double y = 10.0 * j + 3.0 + 0.25 * (i % 3);
            result.holes.push_back(backwards(rectangle(x, y, x + 4, y + 4)));
        }
    }
    return result;
}

TEST(Triangulate, ConvexPolygonsAreCoveredCounterClockwise) {
    expect_cover({rectangle(-3, -2, 5, 4), {}}, "rectangle");
    expect_cover({{{0, 0}, {4, 0}, {2, 3}}, {}}, "triangle");
    EXPECT_EQ(triangulate({rectangle(0, 0, 1, 1), {}}).triangles.size(), 2U);
}

TEST(Triangulate, CornersOnStraightEdgesMakeNoTrianglesWithoutArea) {
    expect_cover({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 2}, {1.5, 2}, {0, 2}, {0, 1}}, {}}, "convex");
    expect_cover({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 2}, {1.5, 1}, {0, 2}, {0, 1}}, {}}, "concave");
}

TEST(Triangulate, ConcavePolygonsAndHolesAreCovered) {
    expect_cover({{{0, 0}, {10, 0}, {10, 10}, {5, 2}, {0, 10}}, {}}, "notch");
    expect_cover({{{0, 0}, {10, 0}, {10, 10}, {4, 10}, {4, 8}, {8, 8}, {8, 2}, {2, 2}, {2, 10}, {0, 10}}, {}},
                 "hook");
    expect_cover(
        {rectangle(0, 0, 10, 10), {backwards(rectangle(2, 2, 4, 8)), backwards(rectangle(6, 1, 7, 9))}},
        "holes");
    expect_cover(sieve(5), "sieve");
}

TEST(Triangulate, RingsThatTouchAreCovered) {
    // A hole that touches the outline in a corner, two holes that touch, and an outline that touches itself.
    expect_cover({rectangle(0, 0, 10, 10), {{{0, 5}, {4, 7}, {4, 3}}}}, "hole at the edge");
    expect_cover({rectangle(0, 0, 10, 10), {{{2, 5}, {5, 7}, {5, 3}}, {{5, 5}, {8, 7}, {8, 3}}}},
                 "two holes");
    expect_cover({rectangle(0, 0, 10, 10), {{{2, 5}, {5, 7}, {5, 3}}, {{5, 7}, {8, 7}, {8, 3}}}},
                 "holes at a corner");
    expect_cover({{{0, 0}, {5, 4}, {10, 0}, {10, 10}, {5, 4}, {0, 10}}, {}}, "touches itself");
}

TEST(Triangulate, PolygonsWithoutAreaGiveNothing) {
    EXPECT_TRUE(triangulate({}).triangles.empty());
    EXPECT_TRUE(triangulate({{{0, 0}, {1, 1}}, {}}).triangles.empty());
    EXPECT_TRUE(triangulate({{{0, 0}, {1, 0}, {2, 0}}, {}}).triangles.empty());
}

TEST(Triangulate, TheSamePolygonGivesTheSameTriangles) {
    const Triangulation a = triangulate(sieve(12));
    const Triangulation b = triangulate(sieve(12));
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Triangulate, PagesWithManyCutOutsAreCovered) { expect_cover(sieve(30), "900 holes"); }

// A ring that winds in and out, with holes between: lines through it cut it into many parts.
Polygon coil(int corners) {
    Polygon result;
    for (int i = 0; i < corners; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / corners;
        const double radius = 100.0 + 25.0 * std::sin(40.0 * turn) + 0.01 * std::sin(977.0 * turn);
        result.outer.push_back({radius * std::cos(turn), radius * std::sin(turn)});
    }
    for (int i = 0; i < 40; ++i) {
        const double turn = 2.0 * std::numbers::pi * (i + 0.25) / 40;
        const Vec2 at{110.0 * std::cos(turn), 110.0 * std::sin(turn)};
        Ring ring;
        for (int k = 0; k < 30; ++k) {
            const double round = -2.0 * std::numbers::pi * k / 30;
            ring.push_back(at + 2.0 * Vec2{std::cos(round), std::sin(round)});
        }
        result.holes.push_back(std::move(ring));
    }
    return result;
}

TEST(Triangulate, RingsOfManyThousandCornersAreCovered) { expect_cover(coil(9000), "coil"); }

TEST(Slice, ThePartsAreThePolygonAndMeetOnlyOnALine) {
    // Teeth that a line cuts off, each with a hole on either side of it, and a coil.
    Polygon teeth{{{200.0, -10.0}, {200.0, 310.0}, {195.0, 310.0}}, {}};
    for (int i = 100; i-- > 0;) {
        const double y = 3.0 * i;
        for (const Vec2 p : {Vec2{190.0, y + 2.5}, {0.02 * i, y + 2.0}, {0.01 * i, y + 0.5}, {190.0, y}})
            teeth.outer.push_back(p);
        for (const double x : {50.0, 180.0})
            teeth.holes.push_back({{x, y + 1.0}, {x + 2.0, y + 1.5}, {x + 3.0 + 0.01 * i, y + 1.0}});
    }
    teeth.outer.push_back({195.0, -10.0});
    struct {
        Polygon whole;
        bool upright;
        std::size_t least;
    } const cases[] = {{coil(3000), false, 2}, {coil(3000), true, 2}, {teeth, true, 101}, {teeth, false, 2}};
    for (const auto& [whole, upright, least] : cases) {
        const std::vector<Polygon> parts = slice(whole, upright);
        ASSERT_GE(parts.size(), least);
        std::size_t holes = 0;
        for (const Polygon& part : parts) {
            EXPECT_GT(signed_area(part.outer), 0.0);
            holes += part.holes.size();
        }
        EXPECT_LE(holes, whole.holes.size());
        // The sum of the areas and the union alike: so no two have an area in common. An edge that is cut
        // moves by the grid.
        double edges = 0.0;
        for (const Segment& edge : edges_of(whole)) edges += distance(edge.a, edge.b);
        const double rounding = 1e-6 * edges;
        EXPECT_NEAR(area(parts), area(whole), rounding);
        EXPECT_NEAR(area(subtract({whole}, parts)), 0.0, rounding);
        EXPECT_NEAR(area(subtract(parts, {whole})), 0.0, rounding);
    }
}

TEST(Slice, HolesTouchedByTheirRingOnTheLineAreLeftToABoolean) {
    // The hole touches the ring from inside along the edge that the level line cuts.
    const Polygon touching{{{0, 0}, {10, 0}, {10, 10}, {7, 10}, {3, 10}, {0, 10}},
                           {{{0, 4}, {0, 6}, {4, 6}, {4, 4}}}};
    EXPECT_TRUE(slice(touching, false).empty());
    EXPECT_EQ(slice({touching.outer, {{{1, 4}, {1, 6}, {4, 6}, {4, 4}}}}, false).size(), 2U);
}

TEST(Triangulate, CombsOfLongTeethAreCovered) {
    Polygon comb;
    for (int i = 0; i < 600; ++i) {
        comb.outer.push_back({i % 2 == 0 ? 0.0 : 1000.0, 0.01 * i});
    }
    comb.outer.push_back({1001, 6});
    comb.outer.push_back({1001, -1});
    comb.outer.push_back({0, -1});
    if (signed_area(comb.outer) < 0) comb.outer = backwards(comb.outer);
    expect_cover(comb, "comb");
}

TEST(LongTriangulate, CostIsNearLinear) {
    const auto milliseconds = [](int rows) {
        const Polygon polygon = sieve(rows);
        const auto start = std::chrono::steady_clock::now();
        EXPECT_FALSE(triangulate(polygon).triangles.empty());
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    };
    milliseconds(20);
    // Sixteen times the holes: a square law would give a factor of 256.
    const double small = milliseconds(25);
    const double large = milliseconds(100);
    EXPECT_LT(large, 80.0 * small) << small << " ms and " << large << " ms";
}

}  // namespace
}  // namespace popup
