#include "base/geometry/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "base/geometry/edge_index.h"

namespace popup {
namespace {

Polygon box(double x0, double y0, double x1, double y1) {
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

bool covered(const std::vector<Polygon>& polygons, Vec2 p) {
    return std::any_of(polygons.begin(), polygons.end(),
                       [p](const Polygon& one) { return contains(one, p); });
}

// A star-shaped polygon about a random centre.
Polygon random_star(std::mt19937& random) {
    const auto number = [&random](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
    };
    const Vec2 centre{number(0.0, 100.0), number(0.0, 100.0)};
    const int corners = 3 + static_cast<int>(random() % 12);
    Polygon star;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * 3.141592653589793 * (i + number(0.0, 0.8)) / corners;
        star.outer.push_back(centre + number(2.0, 25.0) * Vec2{std::cos(angle), std::sin(angle)});
    }
    return star;
}

double edge_distance(const std::vector<Polygon>& polygons, Vec2 p) {
    double best = HUGE_VAL;
    for (const Polygon& polygon : polygons) {
        for (const Segment& edge : edges_of(polygon)) best = std::min(best, distance(p, edge));
    }
    return best;
}

TEST(Regions, BooleansAgreeWithPointwiseLogicOnRandomPolygons) {
    std::mt19937 random(7);
    for (int round = 0; round < 40; ++round) {
        std::vector<Polygon> a;
        std::vector<Polygon> b;
        for (int i = 0; i < 3; ++i) {
            a.push_back(random_star(random));
            b.push_back(random_star(random));
        }
        if (round % 2 == 1) std::reverse(a[0].outer.begin(), a[0].outer.end());  // any orientation is taken
        const auto either = unite({a[0], a[1], a[2], b[0], b[1], b[2]});
        const auto both = intersect(a, b);
        const auto without = subtract(a, b);
        for (int i = 0; i < 200; ++i) {
            const Vec2 p{static_cast<double>(random() % 100000) / 1000.0,
                         static_cast<double>(random() % 100000) / 1000.0};
            if (std::min(edge_distance(a, p), edge_distance(b, p)) < 1e-5) continue;
            EXPECT_EQ(covered(either, p), covered(a, p) || covered(b, p));
            EXPECT_EQ(covered(both, p), covered(a, p) && covered(b, p));
            EXPECT_EQ(covered(without, p), covered(a, p) && !covered(b, p));
        }
    }
}

// A single ring, its holes and what is taken out of it, wherever they lie: most of these rings are apart, and
// such need no clipper.
TEST(Regions, OneRingAndItsHolesAgreeWithPointwiseLogicToo) {
    std::mt19937 random(21);
    int apart = 0;
    for (int round = 0; round < 400; ++round) {
        const Polygon ring = random_star(random);
        const Vec2 middle = 0.5 * (bounds(ring.outer).min + bounds(ring.outer).max);
        std::vector<Polygon> holes;
        for (int i = 0; i < 3; ++i) {
            Polygon hole = random_star(random);
            // Most in the ring, some round it, and some beside it.
            const double size = round % 5 == 0 ? 3.0 : 0.1;
            const Vec2 at = middle + Vec2{4.0 * (i - 1), round % 7 == 0 ? 60.0 : 0.0};
            const Vec2 own = 0.5 * (bounds(hole.outer).min + bounds(hole.outer).max);
            for (Vec2& p : hole.outer) p = at + size * (p - own);
            holes.push_back(std::move(hole));
        }
        const auto left = subtract({ring}, holes);
        const auto twice = unite({ring});
        const auto once = filled({ring.outer}, FillRule::non_zero);
        if (left.size() == 1 && left[0].holes.size() == 3) ++apart;
        for (int i = 0; i < 100; ++i) {
            const Vec2 p{static_cast<double>(random() % 130000) / 1000.0 - 15.0,
                         static_cast<double>(random() % 130000) / 1000.0 - 15.0};
            if (std::min(edge_distance({ring}, p), edge_distance(holes, p)) < 1e-5) continue;
            EXPECT_EQ(covered(left, p), contains(ring, p) && !covered(holes, p)) << round;
            EXPECT_EQ(covered(twice, p), contains(ring, p)) << round;
            EXPECT_EQ(covered(once, p), contains(ring, p)) << round;
        }
    }
    EXPECT_GT(apart, 40);
}

// What runs round a small region far outside of it still goes round it.
TEST(Regions, ASmallPartOfALongCoilIsThatPart) {
    Polygon coil;
    constexpr int kCorners = 900;
    const auto at = [](int i, double more) {
        const double turn = 2.0 * 3.141592653589793 * i / 120.0;
        return Vec2{50.0, 50.0} + (1.0 + 0.05 * i + more) * Vec2{std::cos(turn), std::sin(turn)};
    };
    for (int i = 0; i < kCorners; ++i) coil.outer.push_back(at(i, 3.0));
    for (int i = kCorners; i-- > 0;) coil.outer.push_back(at(i, 0.0));
    coil.holes.push_back({at(200, 1.0), at(200, 2.0), at(203, 1.5)});
    std::mt19937 random(11);
    for (int round = 0; round < 100; ++round) {
        const Vec2 p{static_cast<double>(random() % 100), static_cast<double>(random() % 100)};
        const Polygon part = round % 2 == 0 ? box(p.x, p.y, p.x + 6.0, p.y + 4.0) : random_star(random);
        const auto both = round % 4 < 2 ? intersect({coil}, {part}) : intersect({part}, {coil});
        const Box around = bounds(part.outer);
        for (int i = 0; i < 100; ++i) {
            const Vec2 q{around.min.x + around.width() * static_cast<double>(random() % 1000) / 1000.0,
                         around.min.y + around.height() * static_cast<double>(random() % 1000) / 1000.0};
            if (std::min(edge_distance({coil}, q), edge_distance({part}, q)) < 1e-5) continue;
            EXPECT_EQ(covered(both, q), contains(coil, q) && contains(part, q)) << round;
        }
    }
}

TEST(Regions, ResultsHaveHolesClockwiseAndOutersCounterClockwise) {
    const auto frame = subtract({box(0, 0, 10, 10)}, {box(2, 2, 8, 8)});
    ASSERT_EQ(frame.size(), 1U);
    ASSERT_EQ(frame[0].holes.size(), 1U);
    EXPECT_GT(signed_area(frame[0].outer), 0.0);
    EXPECT_LT(signed_area(frame[0].holes[0]), 0.0);
    EXPECT_DOUBLE_EQ(area(frame[0]), 64.0);
}

TEST(Regions, AHoleBelongsToTheSmallestRingAroundIt) {
    const auto target = subtract({box(0, 0, 50, 50)}, {box(5, 5, 45, 45)});
    auto rings = subtract({box(10, 10, 40, 40)}, {box(20, 20, 30, 30)});
    rings.push_back(target.at(0));
    rings.push_back(box(22, 22, 25, 25));
    const auto result = unite(rings);
    ASSERT_EQ(result.size(), 3U);
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_EQ(result[i].holes.size(), 1U);
        EXPECT_TRUE(contains({result[i].outer, {}}, result[i].holes[0][0]));
    }
    EXPECT_DOUBLE_EQ(area(result), 2500.0 - 1600.0 + 900.0 - 100.0 + 9.0);
}

// Rounded to the grid, the corners of a hole on a slanting edge may lie on either side of it.
TEST(Regions, AHoleOnASlantingEdgeBelongsToTheRingThatItIsIn) {
    std::mt19937 random(4);
    int holes = 0;
    for (int round = 0; round < 300; ++round) {
        // Two rings with a gap of 1 mm between them, along lines that are nearly upright.
        const double lean = static_cast<double>(random() % 20000) * 1e-6 - 0.01;
        const auto at = [lean](double x, double y) { return on_grid({x + lean * y / 70.0, y}); };
        // The left one goes on below the right one: its box holds the other.
        const Polygon left{{{-105, -20}, {0, -20}, {0, -5}, {-43, -5}, at(-43, 0), at(-43, 70), at(-105, 70)},
                           {}};
        const Polygon right{{at(-42, 0), {0, 0}, {0, 70}, at(-42, 70)}, {}};
        const double low = 10.0 + static_cast<double>(random() % 40000) * 1e-3;
        const Polygon notch{{at(-42, low), {-37, low}, {-37, low + 3}, at(-42, low + 3)}, {}};
        const std::vector<Polygon> what = intersect({notch}, {left, right});
        const std::vector<Polygon> made = subtract({left, right}, what);
        ASSERT_EQ(made.size(), 2U);
        double sum = 0.0;
        for (const Polygon& one : made) {
            sum += area(one);
            for (const Ring& hole : one.holes) {
                const Vec2 middle = 0.5 * (bounds(hole).min + bounds(hole).max);
                EXPECT_TRUE(contains(Polygon{one.outer, {}}, middle)) << round;
                ++holes;
            }
        }
        EXPECT_NEAR(sum, area(left) + area(right) - area(notch), 1e-3) << round;
    }
    EXPECT_GT(holes, 10);  // the others are notches
}

TEST(Regions, ResultsDoNotDependOnTheOrderOfTheInput) {
    std::mt19937 random(11);
    std::vector<Polygon> parts;
    parts.reserve(12);
    for (int i = 0; i < 12; ++i) parts.push_back(random_star(random));
    const auto forwards = unite(parts);
    std::reverse(parts.begin(), parts.end());
    for (Polygon& part : parts) std::rotate(part.outer.begin(), part.outer.begin() + 1, part.outer.end());
    const auto backwards = unite(parts);
    ASSERT_EQ(forwards.size(), backwards.size());
    EXPECT_NEAR(area(forwards), area(backwards), 1e-6);
    for (std::size_t i = 0; i < forwards.size(); ++i) {
        EXPECT_LT(distance(forwards[i].outer[0], backwards[i].outer[0]), 1e-5);
    }
}

TEST(Regions, SharedEdgesVanishInAUnion) {
    const auto whole = unite({box(0, 0, 1, 10), box(1, 0, 2, 3), box(1, 3, 2, 10)});
    ASSERT_EQ(whole.size(), 1U);
    EXPECT_EQ(whole[0].outer.size(), 4U);
    EXPECT_TRUE(whole[0].holes.empty());
    EXPECT_EQ(whole[0].outer[0], (Vec2{0, 0}));
}

TEST(Regions, NothingStaysNothing) {
    EXPECT_TRUE(unite({}).empty());
    EXPECT_TRUE(subtract({}, {box(0, 0, 1, 1)}).empty());
    EXPECT_TRUE(intersect({box(0, 0, 1, 1)}, {}).empty());
    EXPECT_TRUE(offset({}, 1.0, Corners::sharp).empty());
    EXPECT_TRUE(unite({{{{0, 0}, {1, 0}, {2, 0}}, {}}}).empty());  // a line has no area
}

TEST(Regions, OffsetKeepsItsDistance) {
    const auto grown = offset({box(0, 0, 10, 10)}, 2.0, Corners::rounded);
    ASSERT_EQ(grown.size(), 1U);
    for (const Segment& edge : edges_of(grown[0])) {
        for (const Segment& old : edges_of(box(0, 0, 10, 10))) EXPECT_GE(distance(edge, old), 2.0 - 0.0101);
    }
    EXPECT_NEAR(area(grown), 100.0 + 80.0 + 4.0 * 3.141592653589793, 0.1);
    EXPECT_DOUBLE_EQ(area(offset({box(0, 0, 10, 10)}, 2.0, Corners::sharp)), 196.0);
    EXPECT_DOUBLE_EQ(area(offset({box(0, 0, 10, 10)}, -2.0, Corners::sharp)), 36.0);
    EXPECT_TRUE(offset({box(0, 0, 10, 10)}, -5.0, Corners::sharp).empty());
}

TEST(Regions, ClippedLinesLieInTheAreaAndTheRestDoesNot) {
    std::mt19937 random(3);
    for (int round = 0; round < 60; ++round) {
        const auto areas = subtract({random_star(random)}, {random_star(random)});
        if (areas.empty()) continue;
        const Polygon& area = areas[0];
        std::vector<Vec2> line;
        line.reserve(6);
        for (int i = 0; i < 6; ++i) {
            line.push_back(
                {static_cast<double>(random() % 1000) / 10.0, static_cast<double>(random() % 1000) / 10.0});
        }
        const auto parts = clip_line(line, area);
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            for (int k = 0; k < 50; ++k) {
                const Vec2 p = lerp(line[i], line[i + 1], (k + 0.5) / 50.0);
                if (edge_distance({area}, p) < 1e-4) continue;
                double off = HUGE_VAL;
                for (const auto& part : parts) {
                    for (std::size_t j = 0; j + 1 < part.size(); ++j) {
                        off = std::min(off, distance(p, Segment{part[j], part[j + 1]}));
                    }
                }
                if (contains(area, p)) {
                    EXPECT_LT(off, 1e-9);
                } else {
                    EXPECT_GT(off, 1e-5);
                }
            }
        }
    }
}

TEST(Regions, OfCornersInOnePlaceOneStays) {
    const Ring corners{{0, 0}, {26, 0}, {23, 10}, {3, 10}};
    for (std::size_t doubled = 0; doubled < corners.size(); ++doubled) {
        for (std::size_t first = 0; first <= corners.size(); ++first) {
            Ring ring = corners;
            ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(doubled), corners[doubled]);
            std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first), ring.end());
            const Ring made = tidied(ring, 1e-4);
            EXPECT_EQ(made.size(), 4U);
            EXPECT_NEAR(signed_area(made), 230.0, 1e-9);
        }
    }
}

TEST(Regions, ALineThatHardlyLeavesAnEdgeEndsWithIt) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angles(-3.2, 3.2);
    std::uniform_int_distribution<int> steps(-5, 5);
    for (int round = 0; round < 400; ++round) {
        const double angle = angles(random);
        const auto on_page = [&](double x, double y) { return on_grid(rotated({x, y}, angle)); };
        const Polygon area{{on_page(0, 0), on_page(50, 0), on_page(40, -10), on_page(10, -10)}, {}};
        // Along its upper edge and 10 mm on, off by a few steps of the grid at either end of the edge.
        const double from = 1e-6 * steps(random);
        const double to = 1e-6 * steps(random);
        const double slope = (to - from) / 50.0;
        const std::vector<Vec2> line{rotated({-10, from - 10 * slope}, angle),
                                     rotated({60, from + 60 * slope}, angle)};
        for (const std::vector<Vec2>& part : clip_line(line, area)) {
            for (const Vec2 p : part) {
                const double along = rotated(p, -angle).x;
                EXPECT_GT(along, -1.0) << round;
                EXPECT_LT(along, 51.0) << round;
            }
        }
    }
}

TEST(Regions, ClippingKeepsDirectionAndCornersOfTheLine) {
    const std::vector<Vec2> line{{-5, 5}, {5, 5}, {5, 3}, {15, 3}, {15, 1}, {-5, 1}};
    const auto parts = clip_line(line, box(0, 0, 10, 10));
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0], (std::vector<Vec2>{{0, 5}, {5, 5}, {5, 3}, {10, 3}}));
    EXPECT_EQ(parts[1], (std::vector<Vec2>{{10, 1}, {0, 1}}));
}

TEST(Regions, ALineOnTheEdgeIsInTheArea) {
    const auto parts = clip_line({{-5, 10}, {15, 10}}, box(0, 0, 10, 10));
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0], (std::vector<Vec2>{{0, 10}, {10, 10}}));
    EXPECT_TRUE(clip_line({{-5, 10.001}, {15, 10.001}}, box(0, 0, 10, 10)).empty());
    EXPECT_TRUE(clip_line({{-5, 5}, {0, 10}, {5, 15}}, box(0, 0, 10, 10)).empty());  // touches a corner only
}

TEST(Regions, TidiedRingsLoseOnlyWhatIsWithinTheTolerance) {
    const Ring ring{{0, 0}, {5, 1e-5}, {10, 0}, {10, 10}, {10, 10.00001}, {5, 10}, {5, 20}, {5, 10}, {0, 10}};
    EXPECT_EQ(tidied(ring, 1e-4).size(), 4U);
    EXPECT_NEAR(signed_area(tidied(ring, 1e-4)), 100.0, 1e-3);
    EXPECT_EQ(tidied({{0, 0}, {5, 1}, {10, 0}, {10, 10}, {0, 10}}, 1e-4).size(), 5U);
    EXPECT_TRUE(tidied({{0, 0}, {10, 0}, {5, 1e-6}}, 1e-4).empty());
}

TEST(EdgeIndex, AnswersAsALookAtEverySegmentWould) {
    std::mt19937 random(19);
    std::vector<Segment> segments;
    for (int i = 0; i < 300; ++i) {
        const auto number = [&random] { return static_cast<double>(random() % 10000) / 100.0; };
        const Vec2 a{number(), number()};
        segments.push_back({a, a + Vec2{number() / 10.0 - 5.0, number() / 10.0 - 5.0}});
    }
    EdgeIndex index(std::vector<Segment>(segments.begin(), segments.begin() + 200));
    for (std::size_t i = 200; i < segments.size(); ++i) index.insert(segments[i], false);
    index.remove(17);
    std::vector<int> found;
    for (int round = 0; round < 100; ++round) {
        const Vec2 p{static_cast<double>(random() % 10000) / 100.0,
                     static_cast<double>(random() % 10000) / 100.0};
        double nearest = 9.0;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            if (i != 17) nearest = std::min(nearest, distance(p, segments[i]));
        }
        EXPECT_DOUBLE_EQ(index.clearance(p, 9.0), nearest);
        EXPECT_EQ(index.is_within(p, 1.0), nearest < 1.0);
        index.query({p, p + Vec2{10, 10}}, found);
        std::vector<int> expected;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const Segment& s = segments[i];
            if (i != 17 && std::max(s.a.x, s.b.x) >= p.x && std::min(s.a.x, s.b.x) <= p.x + 10 &&
                std::max(s.a.y, s.b.y) >= p.y && std::min(s.a.y, s.b.y) <= p.y + 10) {
                expected.push_back(static_cast<int>(i));
            }
        }
        EXPECT_EQ(found, expected);
    }
}

TEST(Regions, FilledTellsRingsByTheirDirectionsOrByHowManyThereAre) {
    const Ring outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    const Ring inner{{2, 2}, {5, 2}, {5, 5}, {2, 5}};
    const Ring turned(inner.rbegin(), inner.rend());
    const auto filled_area = [](const std::vector<Ring>& rings, FillRule rule) {
        double sum = 0.0;
        for (const Polygon& one : filled(rings, rule)) sum += area(one);
        return sum;
    };
    EXPECT_DOUBLE_EQ(filled_area({outer, inner}, FillRule::even_odd), 91.0);
    EXPECT_DOUBLE_EQ(filled_area({outer, inner}, FillRule::non_zero), 100.0);
    EXPECT_DOUBLE_EQ(filled_area({outer, turned}, FillRule::non_zero), 91.0);
    const Ring eight{{0, 0}, {10, 10}, {10, 0}, {0, 10}};  // both lobes
    EXPECT_DOUBLE_EQ(filled_area({eight}, FillRule::even_odd), 50.0);
    EXPECT_DOUBLE_EQ(filled_area({eight}, FillRule::non_zero), 50.0);
    EXPECT_TRUE(filled({}, FillRule::non_zero).empty());
    EXPECT_TRUE(filled({{{0, 0}, {1, 1}}}, FillRule::non_zero).empty());
}

// Rings that do not meet are told apart without the clipper; what it makes of them one by one is the same.
TEST(Regions, FilledMakesOfSimpleRingsWhatTheClipperDoes) {
    std::mt19937 random(11);
    for (int round = 0; round < 30; ++round) {
        std::vector<Ring> rings;
        for (int cell = 0; cell < 6; ++cell) {
            const Vec2 centre{200.0 * cell, 0.0};
            const int corners = 5 + static_cast<int>(random() % 40);
            Ring star;  // its centre sees all of it, so that it does not meet itself made smaller
            for (int i = 0; i < corners; ++i) {
                const double angle = 2.0 * 3.141592653589793 * i / corners;
                star.push_back((20.0 + static_cast<double>(random() % 60)) *
                               Vec2{std::cos(angle), std::sin(angle)});
            }
            for (double share = 1.0; share > 0.1; share *= 0.6) {  // each in the one before
                Ring ring;
                for (const Vec2 p : star) ring.push_back(on_grid(centre + share * p));
                ring.push_back(ring.back());                           // doubled
                ring.push_back(lerp(ring.back(), ring.front(), 0.5));  // nearly or wholly straight
                if (random() % 2 == 0) std::reverse(ring.begin(), ring.end());
                rings.push_back(ring);
            }
        }
        std::shuffle(rings.begin(), rings.end(), random);
        std::vector<Polygon> expected;
        for (const Ring& ring : rings) {
            const std::vector<Polygon> one = unite({{ring, {}}});
            std::vector<Polygon> either = subtract(expected, one);
            for (Polygon& rest : subtract(one, expected)) either.push_back(std::move(rest));
            expected = unite(either);
        }
        const std::vector<Polygon> made = filled(rings, FillRule::even_odd);
        ASSERT_EQ(made.size(), expected.size());
        for (std::size_t i = 0; i < made.size(); ++i) {
            EXPECT_EQ(made[i].outer, expected[i].outer);
            EXPECT_EQ(made[i].holes, expected[i].holes);
        }
    }
}

// Rings that touch in a corner, along an edge, or cross, are left to the clipper.
TEST(SimpleRings, AreTheOnesOfWhichNoTwoEdgesMeet) {
    const CornerRing square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    const auto holes = [](const std::vector<CornerRing>& rings) { return holes_of_simple_rings(rings); };
    EXPECT_EQ(holes({square}), std::vector<bool>({false}));
    EXPECT_EQ(holes({{{2, 2}, {4, 2}, {4, 4}}, square, {{11, 0}, {12, 0}, {12, 20}}}),
              std::vector<bool>({true, false, false}));
    EXPECT_EQ(holes({{{3, 3}, {5, 3}, {4, 4}}, {{2, 2}, {7, 2}, {4, 7}}, square}),
              std::vector<bool>({false, true, false}));
    const std::vector<std::pair<const char*, CornerRing>> meeting{
        {"corner in corner", {{10, 10}, {20, 10}, {20, 20}}},
        {"corner on edge", {{10, 5}, {20, 0}, {20, 10}}},
        {"corner on edge, from within", {{0, 5}, {5, 2}, {5, 7}}},
        {"edge on edge", {{10, 2}, {20, 2}, {20, 8}, {10, 8}}},
        {"across", {{5, -5}, {6, -5}, {6, 15}}},
        {"the same", square}};
    for (const auto& [name, other] : meeting) {
        EXPECT_EQ(holes({square, other}), std::nullopt) << name;
        EXPECT_EQ(holes({other, square}), std::nullopt) << name;
    }
    EXPECT_EQ(holes({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}), std::nullopt);                  // an eight
    EXPECT_EQ(holes({{{0, 0}, {10, 0}, {5, 0}, {5, 5}}}), std::nullopt);                     // a spike
    EXPECT_EQ(holes({{{0, 0}, {5, 9}, {10, 0}, {10, 20}, {5, 9}, {0, 20}}}), std::nullopt);  // a waist
    EXPECT_EQ(without_straight_corners({{5, 0}, {10, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}),
              CornerRing({{10, 0}, {10, 10}, {0, 10}, {0, 0}}));
    EXPECT_TRUE(without_straight_corners({{0, 0}, {5, 0}, {10, 0}}).size() < 3);
}

TEST(EdgeIndex, WindingCountsRingsAndNothingElse) {
    for (const Vec2 size : {Vec2{100, 10}, Vec2{10, 100}}) {  // both ways the ray may run
        EdgeIndex index(edges_of(box(0, 0, size.x, size.y)));
        for (const Segment& edge : edges_of(box(2, 2, 5, 5))) index.insert({edge.b, edge.a}, true);
        index.insert({{6, 0}, {7, size.y}}, false);
        EXPECT_EQ(index.winding({1, 1}), 1);
        EXPECT_EQ(index.winding({3, 3}), 0);
        EXPECT_EQ(index.winding({-1, 3}), 0);
        EXPECT_EQ(index.winding({3, -1}), 0);
        EXPECT_EQ(index.winding({8, 8}), 1);
        EXPECT_EQ(index.winding({2.5, 7}), 1);
    }
}

}  // namespace
}  // namespace popup
