#include "pattern/chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>

namespace popup {
namespace {

double number(std::mt19937& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

std::vector<Segment> edges(const Ring& ring) {
    std::vector<Segment> result;
    for (std::size_t i = 0; i < ring.size(); ++i) result.push_back({ring[i], ring[(i + 1) % ring.size()]});
    return result;
}

std::vector<Segment> edges(const Contour& contour) {
    auto result = edges(contour.points);
    if (!contour.closed) result.pop_back();
    return result;
}

// -----------------------------------------------------------------------------------------------------

using Unit = std::tuple<int, int, int>;  // a unit edge of the square grid: x, y, 0 right or 1 up

void count_units(const Segment& s, std::map<Unit, int>& units) {
    const Vec2 step = unit(s.b - s.a);
    const int steps = static_cast<int>(std::lround(distance(s.a, s.b)));
    for (int k = 0; k < steps; ++k) {
        const Vec2 low = s.a + (k + 0.5) * step;
        const bool right = std::abs(step.x) > 0.5;
        const double x = right ? std::floor(low.x) : std::round(low.x);
        const double y = right ? std::round(low.y) : std::floor(low.y);
        ++units[{static_cast<int>(x), static_cast<int>(y), right ? 0 : 1}];
    }
}

TEST(Chains, ChainsUseEveryStretchOfCutExactlyOnceHoweverItWasDoubled) {
    std::mt19937 random(5);
    for (int round = 0; round < 100; ++round) {
        std::vector<TaggedSegment> segments;
        std::map<Unit, int> wanted;
        for (int i = 0; i < 40; ++i) {
            const Vec2 a{static_cast<double>(random() % 12), static_cast<double>(random() % 12)};
            const double size = 1 + static_cast<double>(random() % 5);
            Segment s{a, a + (random() % 2 == 0 ? Vec2{size, 0} : Vec2{0, size})};
            if (random() % 2 == 0) std::swap(s.a, s.b);
            const Vec2 noise{number(random, -1e-7, 1e-7), number(random, -1e-7, 1e-7)};
            segments.push_back({{s.a + noise, s.b - noise}, 0});
            count_units(s, wanted);
        }
        for (auto& [key, count] : wanted) count = 1;
        std::map<Unit, int> got;
        for (const Contour& contour : chained(merged(segments))) {
            for (const Segment& s : edges(contour)) count_units(s, got);
        }
        EXPECT_EQ(got, wanted);
        got.clear();
        for (const Contour& contour : cut_paths(segments)) {
            for (const Segment& s : edges(contour)) count_units(s, got);
        }
        EXPECT_EQ(got, wanted) << "as paths of cuts";
    }
}

TEST(Chains, ChainsAreAsFewAsTheLooseEndsAllow) {
    std::mt19937 random(9);
    for (int round = 0; round < 100; ++round) {
        // Random segments between random points: nothing is in line, so every point keeps its ends.
        std::vector<Vec2> points;
        for (int i = 0; i < 12; ++i) points.push_back({number(random, 0, 100), number(random, 0, 100)});
        std::set<std::pair<int, int>> pairs;
        for (int i = 0; i < 20; ++i) {
            const int a = static_cast<int>(random() % 12);
            const int b = static_cast<int>(random() % 12);
            if (a != b) pairs.insert({std::min(a, b), std::max(a, b)});
        }
        std::vector<TaggedSegment> segments;
        std::vector<int> degree(12, 0);
        for (const auto& [a, b] : pairs) {
            segments.push_back(
                {{points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]}, 0});
            ++degree[static_cast<std::size_t>(a)];
            ++degree[static_cast<std::size_t>(b)];
        }
        const auto odd = std::count_if(degree.begin(), degree.end(), [](int d) { return d % 2 == 1; });
        std::size_t open = 0;
        std::size_t used = 0;
        for (const Contour& contour : chained(segments)) {
            open += contour.closed ? 0 : 1;
            used += edges(contour).size();
            // No path passes a point twice.
            std::set<std::pair<double, double>> seen;
            for (const Vec2 p : contour.points) EXPECT_TRUE(seen.insert({p.x, p.y}).second);
        }
        EXPECT_LE(open, static_cast<std::size_t>(odd / 2));
        EXPECT_EQ(used, segments.size());
    }
}

TEST(Chains, SquaresThatTouchStayContoursOfTheirOwn) {
    std::vector<TaggedSegment> segments;
    for (const Vec2 corner : {Vec2{0, 0}, Vec2{10, 10}}) {
        const Ring ring{corner, corner + Vec2{10, 0}, corner + Vec2{10, 10}, corner + Vec2{0, 10}};
        for (const Segment& s : edges(ring)) segments.push_back({s, 0});
    }
    const auto contours = chained(segments);
    ASSERT_EQ(contours.size(), 2U);
    for (const Contour& contour : contours) {
        EXPECT_TRUE(contour.closed);
        EXPECT_DOUBLE_EQ(std::abs(signed_area(contour.points)), 100.0);
    }
}

TEST(CutPaths, AnOutlineIsClosedWhereASlitGoesStraightOnFromAnEdge) {
    const Ring outline{{10, 10}, {50, 10}, {50, 20}, {90, 20}, {90, 70}, {10, 70}};
    std::vector<TaggedSegment> cuts;
    for (const Segment& s : edges(outline)) cuts.push_back({s, 0});
    cuts.push_back({{{50, 20}, {50, 25}}, 0});
    // A slit that ends square on an edge parts it into two, which are in line.
    cuts.erase(cuts.begin());
    cuts.push_back({{{10, 10}, {30, 10}}, 0});
    cuts.push_back({{{30, 10}, {50, 10}}, 0});
    cuts.push_back({{{30, 10}, {30, 15}}, 0});
    const auto paths = cut_paths(cuts);
    ASSERT_EQ(paths.size(), 3U);
    int closed = 0;
    for (const Contour& path : paths) {
        if (!path.closed) {
            EXPECT_EQ(path.points.size(), 2U);
            continue;
        }
        ++closed;
        EXPECT_DOUBLE_EQ(std::abs(signed_area(path.points)), std::abs(signed_area(outline)));
        EXPECT_EQ(path.points.size(), outline.size()) << "no corners where it is straight";
    }
    EXPECT_EQ(closed, 1);
}

TEST(CutPaths, HolesThatTouchInACornerStayContoursOfTheirOwn) {
    std::vector<TaggedSegment> cuts;
    for (const Ring& ring :
         {Ring{{30, 30}, {50, 30}, {50, 50}, {30, 50}}, Ring{{50, 50}, {60, 50}, {60, 60}, {50, 60}}}) {
        for (const Segment& s : edges(ring)) cuts.push_back({s, 0});
    }
    const auto paths = cut_paths(cuts);
    ASSERT_EQ(paths.size(), 2U);
    std::vector<double> areas;
    for (const Contour& path : paths) {
        EXPECT_TRUE(path.closed);
        areas.push_back(std::abs(signed_area(path.points)));
    }
    std::sort(areas.begin(), areas.end());
    EXPECT_DOUBLE_EQ(areas[0], 100.0);
    EXPECT_DOUBLE_EQ(areas[1], 400.0);
}

TEST(Chains, InnerContoursComeBeforeTheOnesAroundThem) {
    std::mt19937 random(2);
    std::vector<TaggedSegment> segments;
    for (int i = 0; i < 5; ++i) {
        const double r = 50 - 8 * i;
        for (const Segment& s : edges(Ring{{-r, -r}, {r, -r}, {r, r}, {-r, r}})) segments.push_back({s, 0});
    }
    segments.push_back({{{-1, 0}, {1, 0}}, 0});   // a slit in the middle
    segments.push_back({{{46, 0}, {46, 5}}, 0});  // and one between the outer two
    std::shuffle(segments.begin(), segments.end(), random);
    const auto contours = chained(merged(segments));
    ASSERT_EQ(contours.size(), 7U);
    std::vector<double> sizes;
    for (const Contour& contour : contours) sizes.push_back(bounds(contour.points).width());
    EXPECT_EQ(sizes.front(), 2.0);
    EXPECT_TRUE(std::is_sorted(sizes.begin() + 1, sizes.begin() + 4));
    EXPECT_EQ(sizes[6], 100.0);
    for (std::size_t i = 0; i < contours.size(); ++i) {
        for (std::size_t j = i + 1; j < contours.size(); ++j) {
            if (!contours[i].closed) continue;
            EXPECT_FALSE(contains({contours[i].points, {}}, contours[j].points[0]));
        }
    }
    EXPECT_GT(signed_area(contours[6].points), 0.0);
    EXPECT_LT(signed_area(contours[4].points), 0.0);
}

TEST(Chains, WithoutLeavesWhatIsNotCovered) {
    const auto left = without({{{{0, 0}, {10, 0}}, 1}, {{{0, 1}, {10, 1}}, 2}},
                              std::vector<Segment>{{{7, 0}, {3, 0}}, {{9, 0}, {12, 0}}, {{5, -1}, {5, 3}}});
    ASSERT_EQ(left.size(), 3U);
    EXPECT_EQ(left[0].tag, 2);
    std::multiset<double> sizes;
    for (const TaggedSegment& s : left) sizes.insert(distance(s.at.a, s.at.b));
    EXPECT_EQ(sizes, (std::multiset<double>{2, 3, 10}));
}

}  // namespace
}  // namespace popup
