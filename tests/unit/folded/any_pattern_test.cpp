// Patterns that nobody drew with care: whatever is in them, folding ends, and what is shown hangs together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/motion.h"
#include "support/designs.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

const int kPatterns = test::sanitized_count(200, 20);
constexpr int kMany = 10'000;
// Of so many patterns one is put in an order.
constexpr int kOrdered = 8;
// Of the sheet: what panels may gape in any state.
constexpr double kGape = 1e-6;

double between(test::Random& random, double low, double high) { return low + (high - low) * random.unit(); }

CreaseUse any_use(test::Random& random, unsigned cuts) {
    if (random.below(100) < cuts) return CreaseUse::cut;
    switch (random.below(8)) {
        case 0:
            return CreaseUse::fold;
        case 1:
            return CreaseUse::flat;
        default:
            return random.below(2) == 0 ? CreaseUse::mountain : CreaseUse::valley;
    }
}

void add_line(CreasePattern& pattern, test::Random& random, Vec2 a, Vec2 b, CreaseUse use) {
    // Lines as people draw them: twice, too short, beside what they mean to meet.
    if (random.below(20) == 0) pattern.lines.push_back({{a, b}, false, use});
    if (random.below(20) == 0) a = a + between(random, 0.0, 0.01) * (b - a);
    if (random.below(20) == 0) b = b + Vec2{between(random, -0.4, 0.4), between(random, -0.4, 0.4)};
    CreaseLine line{{a, b}, false, use};
    if (use != CreaseUse::cut && random.below(6) == 0) line.fold_deg = between(random, 1.0, 180.0);
    pattern.lines.push_back(std::move(line));
}

// A grid whose corners are moved at random, with or without diagonals.
CreasePattern grid(test::Random& random) {
    CreasePattern pattern;
    const int columns = 1 + static_cast<int>(random.below(6));
    const int rows = 1 + static_cast<int>(random.below(6));
    const double moved = random.below(2) == 0 ? 0.0 : between(random, 0.0, 6.0);
    const auto cuts = static_cast<unsigned>(random.below(40));
    std::vector<Vec2> corners;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const Vec2 by{between(random, -moved, moved), between(random, -moved, moved)};
            const bool on_border = i == 0 || j == 0 || i == columns || j == rows;
            corners.push_back(Vec2{20.0 * i, 20.0 * j} + (on_border ? Vec2{} : by));
        }
    }
    const auto at = [&](int i, int j) { return corners[static_cast<std::size_t>(j * (columns + 1) + i)]; };
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const auto draw = [&](int i2, int j2, bool border) {
                if (!border && random.below(12) == 0) return;
                const CreaseUse use = border ? CreaseUse::cut : any_use(random, cuts);
                add_line(pattern, random, at(i, j), at(i2, j2), use);
            };
            if (i < columns) draw(i + 1, j, j == 0 || j == rows);
            if (j < rows) draw(i, j + 1, i == 0 || i == columns);
            if (i < columns && j < rows && random.below(3) == 0) draw(i + 1, j + 1, false);
        }
    }
    return pattern;
}

// Lines across a sheet, and holes in it.
CreasePattern lines_across(test::Random& random) {
    CreasePattern pattern;
    pattern.lines.push_back({{{0, 0}, {120, 0}, {120, 90}, {0, 90}}, true, CreaseUse::cut});
    for (std::size_t i = random.below(8); i > 0; --i) {
        const Vec2 a{between(random, -10, 130), random.below(2) == 0 ? 0.0 : between(random, -5, 95)};
        const Vec2 b{between(random, -10, 130), random.below(2) == 0 ? 90.0 : between(random, -5, 95)};
        add_line(pattern, random, a, b, any_use(random, 15));
    }
    for (std::size_t i = random.below(4); i > 0; --i) {
        const Vec2 middle{between(random, 10, 110), between(random, 10, 80)};
        const int corners = 3 + static_cast<int>(random.below(20));
        Ring ring;
        for (int k = 0; k < corners; ++k) {
            const double way = 2.0 * std::numbers::pi * k / corners;
            ring.push_back(middle + between(random, 3.0, 12.0) * Vec2{std::cos(way), std::sin(way)});
        }
        const CreaseUse use = random.below(3) == 0 ? any_use(random, 50) : CreaseUse::cut;
        pattern.lines.push_back({ring, true, use});
    }
    return pattern;
}

// A corner of so many folds at any angles.
CreasePattern star(test::Random& random) {
    CreasePattern pattern;
    pattern.lines.push_back({{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, true, CreaseUse::cut});
    const std::size_t folds = 2 + random.below(7);
    for (std::size_t i = 0; i < folds; ++i) {
        const double way = between(random, 0.0, 2.0 * std::numbers::pi);
        const Vec2 to{std::cos(way), std::sin(way)};
        const double reach = 50.0 / std::max(std::abs(to.x), std::abs(to.y));
        add_line(pattern, random, {}, reach * to, any_use(random, 5));
    }
    return pattern;
}

CreasePattern any_pattern(std::uint64_t seed) {
    test::Random random(seed);
    CreasePattern pattern;
    switch (random.below(5)) {
        case 0:
            pattern = star(random);
            break;
        case 1:
        case 2:
            pattern = lines_across(random);
            break;
        default:
            pattern = grid(random);
    }
    pattern.fold_deg = random.below(2) == 0 ? 90.0 : 180.0;
    return pattern;
}

// The largest distance between what the plates beside a fold make of its ends.
double torn(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames));
    double largest = 0.0;
    for (const Hinge& hinge : assembly.hinges) {
        const Frame& a = frames[static_cast<std::size_t>(hinge.a)];
        const Frame& b = frames[static_cast<std::size_t>(hinge.b)];
        for (const Vec2 p : {hinge.a_line.a, hinge.a_line.b})
            largest = std::max(largest, distance(a.point(p), b.point(p)));
    }
    return largest;
}

struct Count {
    int folded = 0, bent = 0, part = 0, refused = 0;
};

void expect_whole(int first, int count) {
    Count seen;
    for (int seed = first; seed < first + count; ++seed) {
        const CreasePattern pattern = any_pattern(static_cast<std::uint64_t>(seed));
        Diagnostics diagnostics("any");
        auto assembly = fold_sheet(pattern, {}, diagnostics);
        if (!assembly) {
            ++seen.refused;
            EXPECT_TRUE(diagnostics.has_errors()) << seed;
            continue;
        }
        // Loops stay closed in an order as well.
        if (seed % kOrdered == 0) order_folds(*assembly, {}, diagnostics);
        Box box;
        for (const Plate& plate : assembly->plates) {
            for (const Vec2 p : plate.outline.outer) box.extend(p);
        }
        const Sweep& sweep = assembly->sweep;
        test::Random random(static_cast<std::uint64_t>(seed));
        for (int i = 0; i <= 6; ++i) {
            const double share = i == 0 ? 0.0 : i == 1 ? 1.0 : random.unit();
            const double deg = sweep.from_deg + share * (sweep.to_deg - sweep.from_deg);
            EXPECT_LE(torn(*assembly, deg), kGape * std::max(box.width(), box.height()))
                << "pattern " << seed << " at " << deg << "°\n"
                << test::findings(diagnostics);
        }
        ++(sweep.bends ? seen.bent : sweep.from_deg > 0.0 ? seen.part : seen.folded);
    }
    testing::Test::RecordProperty("folded", seen.folded);
    testing::Test::RecordProperty("bent", seen.bent);
    testing::Test::RecordProperty("part", seen.part);
    testing::Test::RecordProperty("refused", seen.refused);
    EXPECT_GT(seen.folded, count / 10);
    EXPECT_GT(seen.bent, count / 50);
}

TEST(AnyPattern, IsFoldedWholeOrRefused) { expect_whole(1, kPatterns); }

// In halves, which may run side by side.
TEST(LongAnyPattern, OfTheFirstHalfIsFoldedWholeOrRefused) { expect_whole(1, kMany / 2); }
TEST(LongAnyPattern, OfTheSecondHalfIsFoldedWholeOrRefused) { expect_whole(kMany / 2 + 1, kMany / 2); }

}  // namespace
}  // namespace popup
