// What lines of a board promise.
#include "nest/board.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "popup/nest.h"

namespace popup {
namespace {

double number(std::mt19937& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

// Twelve pieces of six kinds with dents, one of them a frame.
NestJob stars(std::mt19937& random) {
    NestJob job;
    for (int k = 0; k < 6; ++k) {
        Polygon outline;
        const int corners = 5 + static_cast<int>(random() % 7);
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * (i + number(random, 0.0, 0.6)) / corners;
            const double radius = number(random, 8.0, 30.0);
            outline.outer.push_back(radius * Vec2{std::cos(angle), std::sin(angle)});
        }
        if (k == 5) {
            outline.outer = {{-30, -30}, {30, -30}, {30, 30}, {-30, 30}};
            outline.holes = {{{-25, -25}, {-25, 25}, {25, 25}, {25, -25}}};
        }
        job.kinds.push_back({{outline}, {Angle{}, Angle::degrees(90.0), Angle::degrees(37.5)}});
        job.items.push_back({k, -1, {}});
        job.items.push_back({k, -1, {}});
    }
    job.stock = {{190, 160, -1}};
    job.spacing = random() % 2 == 0 ? 0.0 : 1.5;
    return job;
}

// What a line promises is asked place by place, of the cost that knows nothing of lines.
TEST(NestBoard, APlaceOnALineCostsWhatItSaysAndLessThanTheBound) {
    std::mt19937 random(11);
    int free = 0;
    int moved = 0;
    for (int round = 0; round < 60; ++round) {
        const NestJob job = stars(random);
        const ShapeSet set = make_shapes(job);
        NoFitTable table(set.shapes, kSlack);
        std::vector<int> kinds;
        for (const NestItem& item : job.items) kinds.push_back(item.kind);
        Board board(set, table, kinds, {{190e6, 160e6}});
        const auto somewhere = [&](int item) {
            const std::vector<int>& shapes = board.shapes_of(item);
            Stand stand{0, shapes[random() % shapes.size()], 0.0, 0.0};
            const Board::Range range = board.range(stand.shape, 0);
            stand.x = std::round(number(random, range.x0, range.x1));
            stand.y = std::round(number(random, range.y0, range.y1));
            return stand;
        };
        for (int item = 1; item < board.items(); ++item) board.put(item, somewhere(item));
        for (int line = 0; line < 20; ++line) {
            const Stand old = somewhere(0);
            const bool level = line % 2 == 0;
            const Board::Range range = board.range(old.shape, 0);
            const double low = level ? range.x0 : range.y0;
            const double high = level ? range.x1 : range.y1;
            const Board::Along along = level ? Board::Along::x : Board::Along::y;
            const double now = board.cost(0, old, HUGE_VAL);
            Stand stand = old;
            const double found = board.best_on_line(0, stand, along, low, high, Board::Among::nearest, now);
            EXPECT_EQ(stand.shape, old.shape);
            EXPECT_EQ(level ? stand.y : stand.x, level ? old.y : old.x);
            const double at = level ? stand.x : stand.y;
            EXPECT_TRUE(low <= at && at <= high);
            EXPECT_LE(found, now);
            // An end is rounded to the grid: by half a step for each of the parts that meet there.
            EXPECT_NEAR(board.cost(0, stand, HUGE_VAL), found, 1e-6 * found + 8.0);
            if (found == 0.0) ++free;
            if (found > 0.0 && found < now) ++moved;
            if (found == 0.0) continue;
            for (int i = 0; i <= 400; ++i) {
                Stand other = old;
                (level ? other.x : other.y) = std::round(low + (high - low) * i / 400.0);
                EXPECT_GT(board.cost(0, other, HUGE_VAL), 0.0) << round << " " << line << " " << i;
            }
            // Of what must cost less than that there is nothing.
            Stand again = old;
            EXPECT_EQ(board.best_on_line(0, again, along, low, high, Board::Among::nearest, 0.5 * found),
                      0.5 * found);
            EXPECT_EQ(again.x, old.x);
            EXPECT_EQ(again.y, old.y);
        }
    }
    EXPECT_GT(free, 100);
    EXPECT_GT(moved, 100);
}

}  // namespace
}  // namespace popup
