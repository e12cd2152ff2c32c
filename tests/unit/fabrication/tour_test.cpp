// Tours: against nearest neighbours and optima that this test finds on its own.
#include "fabrication/tour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Random;

struct Instance {
    std::vector<std::vector<Vec2>> paths;
    std::vector<bool> closed;
    Vec2 from;

    // Refers to the instance.
    [[nodiscard]] std::vector<Stop> stops() const {
        std::vector<Stop> all;
        for (std::size_t i = 0; i < paths.size(); ++i) all.push_back({paths[i], closed[i]});
        return all;
    }
};

Vec2 anywhere(Random& random) { return {200.0 * random.unit(), 300.0 * random.unit()}; }

// Lines of 2 to 6 corners and contours of 3 to 12, up to `size` mm wide.
Instance random_instance(std::uint64_t seed, std::size_t stops, double size) {
    Random random(seed);
    Instance made;
    made.from = seed % 2 == 0 ? Vec2{} : anywhere(random);
    for (std::size_t i = 0; i < stops; ++i) {
        const bool closed = random.below(2) == 0;
        const std::size_t corners = closed ? 3 + random.below(10) : 2 + random.below(5);
        const Vec2 at = anywhere(random);
        std::vector<Vec2> path;
        for (std::size_t k = 0; k < corners; ++k)
            path.push_back(at + size * Vec2{random.unit() - 0.5, random.unit() - 0.5});
        made.paths.push_back(path);
        made.closed.push_back(closed);
    }
    return made;
}

// One way to follow a stop: where that begins and ends.
struct Way {
    std::size_t stop = 0;
    Vec2 begin;
    Vec2 end;
};

std::vector<Way> ways_of(const Instance& instance) {
    std::vector<Way> ways;
    for (std::size_t i = 0; i < instance.paths.size(); ++i) {
        const std::vector<Vec2>& path = instance.paths[i];
        if (instance.closed[i]) {
            for (const Vec2 p : path) ways.push_back({i, p, p});
        } else {
            ways.push_back({i, path.front(), path.back()});
            ways.push_back({i, path.back(), path.front()});
        }
    }
    return ways;
}

double nearest_neighbour_length(const Instance& instance) {
    const std::vector<Way> ways = ways_of(instance);
    std::vector<bool> done(instance.paths.size(), false);
    double sum = 0.0;
    Vec2 at = instance.from;
    for (std::size_t step = 0; step < instance.paths.size(); ++step) {
        const Way* best = nullptr;
        for (const Way& way : ways) {
            if (done[way.stop]) continue;
            if (best == nullptr || distance(at, way.begin) < distance(at, best->begin)) best = &way;
        }
        sum += distance(at, best->begin);
        at = best->end;
        done[best->stop] = true;
    }
    return sum;
}

// The shortest of all tours: over sets of stops that are done and ways to have done the last (Held and Karp
// 1962).
double shortest_length(const Instance& instance) {
    const std::vector<Way> ways = ways_of(instance);
    const std::size_t sets = std::size_t{1} << instance.paths.size();
    constexpr double kNever = std::numeric_limits<double>::infinity();
    std::vector<std::vector<double>> least(sets, std::vector<double>(ways.size(), kNever));
    for (std::size_t w = 0; w < ways.size(); ++w)
        least[std::size_t{1} << ways[w].stop][w] = distance(instance.from, ways[w].begin);
    for (std::size_t set = 1; set < sets; ++set) {
        for (std::size_t last = 0; last < ways.size(); ++last) {
            if (least[set][last] == kNever) continue;
            for (std::size_t w = 0; w < ways.size(); ++w) {
                const std::size_t bit = std::size_t{1} << ways[w].stop;
                if ((set & bit) != 0) continue;
                double& sum = least[set | bit][w];
                sum = std::min(sum, least[set][last] + distance(ways[last].end, ways[w].begin));
            }
        }
    }
    return *std::min_element(least.back().begin(), least.back().end());
}

// Every stop once, each begun where it may be; returns the way between them.
double expect_tour(const Instance& instance, const std::vector<Visit>& visits) {
    EXPECT_EQ(visits.size(), instance.paths.size());
    std::vector<int> seen(instance.paths.size(), 0);
    double sum = 0.0;
    Vec2 at = instance.from;
    for (const Visit& visit : visits) {
        if (visit.stop >= seen.size()) {
            ADD_FAILURE() << "there is no stop " << visit.stop;
            return HUGE_VAL;
        }
        EXPECT_EQ(++seen[visit.stop], 1) << "stop " << visit.stop;
        const std::vector<Vec2>& path = instance.paths[visit.stop];
        if (instance.closed[visit.stop]) {
            if (visit.corner >= path.size()) {
                ADD_FAILURE() << "there is no corner " << visit.corner;
                return HUGE_VAL;
            }
            EXPECT_FALSE(visit.reversed);
            sum += distance(at, path[visit.corner]);
            at = path[visit.corner];
        } else {
            EXPECT_EQ(visit.corner, 0U);
            sum += distance(at, visit.reversed ? path.back() : path.front());
            at = visit.reversed ? path.front() : path.back();
        }
    }
    return sum;
}

TEST(Tour, VisitsEveryStopOnceAndIsNeverLongerThanByNearestNeighbours) {
    for (std::uint64_t seed = 0; seed < test::sanitized_count<std::uint64_t>(300); ++seed) {
        SCOPED_TRACE(seed);
        const std::size_t count = seed < 200 ? seed % 20 : 30 + seed;
        const Instance instance = random_instance(seed, count, seed % 3 == 0 ? 100.0 : 5.0);
        const std::vector<Stop> stops = instance.stops();
        const std::vector<Visit> visits = tour(stops, instance.from);
        const double way = expect_tour(instance, visits);
        EXPECT_LE(way, nearest_neighbour_length(instance) + 1e-9);
        EXPECT_NEAR(way_between(stops, visits, instance.from), way, 1e-9);
    }
}

TEST(Tour, OfOneStopBeginsWhereItIsNearest) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE(seed);
        const Instance instance = random_instance(seed, 1, 100.0);
        EXPECT_NEAR(expect_tour(instance, tour(instance.stops(), instance.from)), shortest_length(instance),
                    1e-5);
    }
    EXPECT_TRUE(tour({}, {}).empty());
}

// Of a contour with very many corners only some are looked at for the order, but all for where to begin.
TEST(Tour, BeginsFineContoursWhereTheWayIsShortest) {
    Instance instance;
    std::vector<Vec2> circle;
    for (int i = 0; i < 1000; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 1000;
        circle.push_back({100.0 + 50.0 * std::cos(angle), 80.0 + 50.0 * std::sin(angle)});
    }
    instance.paths = {circle, {{100.0, 200.0}, {110.0, 200.0}}};
    instance.closed = {true, false};
    instance.from = {3.0, 7.0};
    EXPECT_NEAR(expect_tour(instance, tour(instance.stops(), instance.from)), shortest_length(instance),
                1e-5);
}

// So few that all stops are near each other: there is no part of the tour to turn round that would help.
TEST(Tour, OfFourLinesCannotBeMendedByTurningAPartRound) {
    for (std::uint64_t seed = 0; seed < test::sanitized_count<std::uint64_t>(300); ++seed) {
        SCOPED_TRACE(seed);
        Instance instance = random_instance(seed, 4, 60.0);
        instance.closed.assign(4, false);
        const std::vector<Stop> stops = instance.stops();
        const std::vector<Visit> visits = tour(stops, instance.from);
        const double way = expect_tour(instance, visits);
        for (std::ptrdiff_t first = 0; first < 4; ++first) {
            for (std::ptrdiff_t last = first; last < 4; ++last) {
                std::vector<Visit> turned = visits;
                std::reverse(turned.begin() + first, turned.begin() + last + 1);
                for (std::ptrdiff_t i = first; i <= last; ++i)
                    turned[static_cast<std::size_t>(i)].reversed ^= true;
                EXPECT_GE(expect_tour(instance, turned), way - 1e-5);
            }
        }
    }
}

TEST(Tour, OfFewStopsIsOnAverageCloseToTheShortest) {
    double sum = 0.0;
    double by_nearest = 0.0;
    int instances = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE(seed);
        const Instance instance = random_instance(seed, 4 + seed % 4, seed % 2 == 0 ? 60.0 : 5.0);
        const double shortest = shortest_length(instance);
        const double way = expect_tour(instance, tour(instance.stops(), instance.from));
        EXPECT_GE(way, shortest - 1e-9);
        sum += way / shortest;
        by_nearest += nearest_neighbour_length(instance) / shortest;
        ++instances;
    }
    // Nearest neighbours alone come to 1.085, the tours to 1.023.
    EXPECT_GE(by_nearest / instances, 1.07);
    EXPECT_LE(sum / instances, 1.04);
}

TEST(Tour, OfManyStopsIsShorterThanByNearestNeighbours) {
    double sum = 0.0;
    double by_nearest = 0.0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Instance instance = random_instance(seed, 500, 2.0);
        sum += expect_tour(instance, tour(instance.stops(), instance.from));
        by_nearest += nearest_neighbour_length(instance);
    }
    EXPECT_LE(sum, 0.92 * by_nearest);
}

// The shortest tour of n random places in an area A is about 0.7124 √(nA) long (Johnson, McGeoch and Rothberg
// 1996).
TEST(Tour, OfTwentyThousandStopsIsWithinAQuarterOfTheShortest) {
    const std::size_t stops = test::sanitized_count<std::size_t>(20000, 5);
    const Instance instance = random_instance(7, stops, 1e-3);
    const double way = expect_tour(instance, tour(instance.stops(), instance.from));
    const double shortest = 0.7124 * std::sqrt(static_cast<double>(stops) * 200.0 * 300.0);
    EXPECT_GE(way, 0.9 * shortest);
    EXPECT_LE(way, 1.25 * shortest);
}

// Stops on top of each other, and of one corner: there is nothing to choose by.
TEST(Tour, TakesStopsThatAreAllAlike) {
    Instance instance;
    for (int i = 0; i < 100; ++i) {
        instance.paths.push_back(i % 2 == 0 ? std::vector<Vec2>{{5, 5}, {5, 5}} : std::vector<Vec2>{{5, 5}});
        instance.closed.push_back(i % 2 != 0);
    }
    EXPECT_NEAR(expect_tour(instance, tour(instance.stops(), {})), std::hypot(5.0, 5.0), 1e-9);
}

TEST(Tour, IsTheSameTwice) {
    for (const bool grid : {false, true}) {
        Instance instance = random_instance(3, 400, 2.0);
        // A grid is full of ways that are equally long.
        for (std::size_t i = 0; grid && i < instance.paths.size(); ++i) {
            const std::size_t row = i / 20;
            const Vec2 at{10.0 * static_cast<double>(i % 20), 10.0 * static_cast<double>(row)};
            instance.paths[i] = {at, at + Vec2{5, 0}, at + Vec2{5, 5}, at + Vec2{0, 5}};
            instance.closed[i] = true;
        }
        const Instance copy = instance;
        const std::vector<Visit> a = tour(instance.stops(), instance.from);
        const std::vector<Visit> b = tour(copy.stops(), copy.from);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].stop, b[i].stop);
            EXPECT_EQ(a[i].reversed, b[i].reversed);
            EXPECT_EQ(a[i].corner, b[i].corner);
        }
    }
}

}  // namespace
}  // namespace popup
