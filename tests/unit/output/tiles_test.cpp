#include "output/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "output/tile_parts.h"
#include "support/random.h"

namespace popup {
namespace {

constexpr TileOptions kA4{210.0, 297.0, 10.0};

struct Example {
    Box area;
    TileOptions paper;
    bool across = false;
};

Example random_example(test::Random& random) {
    Example one;
    one.paper.margin_mm = 5.0 + 20.0 * random.unit();
    const double margins = 2.0 * one.paper.margin_mm;
    one.paper.width_mm = margins + 30.0 + 300.0 * random.unit();
    one.paper.height_mm = margins + 30.0 + 300.0 * random.unit();
    one.area.min = {100.0 * random.unit(), 100.0 * random.unit()};
    one.area.max = one.area.min + Vec2{2000.0 * random.unit(), 2000.0 * random.unit()};
    one.across = random.below(2) == 1;
    return one;
}

template <typename Use>
void each_tile(const TileGrid& grid, Use use) {
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) use(row, column);
    }
}

bool holds(const Box& box, Vec2 p) {
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y;
}

TEST(Tiles, EveryPointIsSeenOnceOnSomePage) {
    test::Random random(1);
    for (int i = 0; i < 300; ++i) {
        const Example one = random_example(random);
        const TileGrid grid = tile_grid(one.area, one.paper, one.across);
        double seen = 0.0;
        each_tile(grid, [&](int row, int column) {
            const Box box = grid.seen(row, column);
            EXPECT_GT(box.width(), 0.0);
            EXPECT_GT(box.height(), 0.0);
            seen += box.width() * box.height();
        });
        EXPECT_NEAR(seen, one.area.width() * one.area.height(), 1e-6 * seen + 1e-9);
        for (int k = 0; k < 20; ++k) {
            const Vec2 p{std::lerp(one.area.min.x, one.area.max.x, random.unit()),
                         std::lerp(one.area.min.y, one.area.max.y, random.unit())};
            int times = 0;
            each_tile(grid, [&](int row, int column) {
                if (!holds(grid.seen(row, column), p)) return;
                ++times;
                EXPECT_TRUE(holds(grid.tile(row, column), p));
            });
            EXPECT_EQ(times, 1);
        }
    }
}

TEST(Tiles, NeighboursOverlapByFiveMillimetresAndAllFitTheirPages) {
    test::Random random(2);
    for (int i = 0; i < 300; ++i) {
        const Example one = random_example(random);
        const TileGrid grid = tile_grid(one.area, one.paper, one.across);
        EXPECT_EQ(grid.page_width_mm > grid.page_height_mm, one.across);
        EXPECT_LE(grid.width_mm, grid.page_width_mm - 2.0 * one.paper.margin_mm + 1e-6);
        EXPECT_LE(grid.height_mm, grid.page_height_mm - 2.0 * one.paper.margin_mm + 1e-6);
        each_tile(grid, [&](int row, int column) {
            const Box box = grid.tile(row, column);
            EXPECT_NEAR(box.width(), grid.width_mm, 1e-9);
            EXPECT_NEAR(box.height(), grid.height_mm, 1e-9);
            if (column > 0) {
                EXPECT_NEAR(grid.tile(row, column - 1).max.x - box.min.x, 5.0, 1e-9);
            }
            if (row > 0) {
                EXPECT_NEAR(box.max.y - grid.tile(row - 1, column).min.y, 5.0, 1e-9);
            }
        });
        const Box last = grid.tile(grid.rows - 1, grid.columns - 1);
        EXPECT_EQ(grid.tile(0, 0).min.x, one.area.min.x);
        EXPECT_EQ(grid.tile(0, 0).max.y, one.area.max.y);
        EXPECT_EQ(last.max.x, one.area.max.x);
        EXPECT_EQ(last.min.y, one.area.min.y);
    }
}

// The length that so many tiles of this size cover.
double covered(int tiles, double size) { return size + (tiles - 1) * (size - 5.0); }

TEST(Tiles, HaveNoMoreRowsAndColumnsThanCoverTheArea) {
    test::Random random(3);
    for (int i = 0; i < 300; ++i) {
        const Example one = random_example(random);
        const TileGrid grid = tile_grid(one.area, one.paper, one.across);
        const double width = grid.page_width_mm - 2.0 * one.paper.margin_mm;
        const double height = grid.page_height_mm - 2.0 * one.paper.margin_mm;
        EXPECT_GE(covered(grid.columns, width), one.area.width() - 1e-5);
        EXPECT_GE(covered(grid.rows, height), one.area.height() - 1e-5);
        if (grid.columns > 1) {
            EXPECT_LT(covered(grid.columns - 1, width), one.area.width());
        }
        if (grid.rows > 1) {
            EXPECT_LT(covered(grid.rows - 1, height), one.area.height());
        }
    }
}

TEST(Tiles, AnAreaAsLargeAsThePageInsideItsMarginsIsOneTile) {
    const TileGrid fits = tile_grid({{3.0, 4.0}, {193.0, 281.0}}, kA4, false);
    EXPECT_EQ(fits.tiles(), 1.0);
    EXPECT_NEAR(fits.left_mm(), 10.0, 1e-9);
    EXPECT_NEAR(fits.top_mm(), 10.0, 1e-9);
    EXPECT_EQ(tile_grid({{3.0, 4.0}, {193.1, 281.0}}, kA4, false).columns, 2);
    EXPECT_EQ(tile_grid({{3.0, 4.0}, {193.0, 281.1}}, kA4, false).rows, 2);
    EXPECT_EQ(tile_grid({{3.0, 4.0}, {3.0, 4.0}}, kA4, false).tiles(), 1.0);
}

TEST(Tiles, AnAreaBeyondAllMeasureHasManyTilesAndNoOverflow) {
    const TileGrid grid = tile_grid({{0.0, 0.0}, {1e15, 1e15}}, kA4, false);
    EXPECT_EQ(grid.tiles(), 1e18);
}

TEST(Tiles, RowsHaveLettersAndColumnsNumbers) {
    EXPECT_EQ(tile_name(0, 0), "A1");
    EXPECT_EQ(tile_name(1, 3), "B4");
    EXPECT_EQ(row_name(25), "Z");
    EXPECT_EQ(row_name(26), "AA");
    EXPECT_EQ(row_name(27 * 26 - 1), "ZZ");
    EXPECT_EQ(row_name(27 * 26), "AAA");
}

TEST(Tiles, PaperMustHaveThreeCentimetresInsideItsMargins) {
    const auto finds = [](TileOptions tile) {
        OutputOptions options;
        options.tile = tile;
        Diagnostics told;
        const bool can = can_tile(options, told);
        EXPECT_EQ(can, !told.has_errors());
        return told.has_errors() ? told.sorted().front().message : std::string();
    };
    EXPECT_EQ(finds(kA4), "");
    EXPECT_EQ(finds({50.0, 50.0, 10.0}), "");
    EXPECT_EQ(
        finds({40.0, 60.5, 10.0}),
        "pages of 40 × 60.5 mm have 20 × 40.5 mm inside a margin of 10 mm; tiles, which overlap by 5 mm, "
        "need 30 mm each way");
    EXPECT_EQ(finds({210.0, 297.0, 4.5}),
              "a margin of 4.5 mm has no room for the labels of tiles, which need 5 mm");
}

TEST(Tiles, DoNotGoWithWhatNeedsItsSheetInOnePiece) {
    const auto refused = [](auto change) {
        OutputOptions options;
        options.tile = kA4;
        change(options);
        Diagnostics told;
        return !can_tile(options, told) && told.sorted().front().code == "tiles-impossible";
    };
    EXPECT_FALSE(refused([](OutputOptions&) {}));
    EXPECT_TRUE(refused([](OutputOptions& options) { options.backs = true; }));
    EXPECT_TRUE(refused([](OutputOptions& options) { options.print_and_cut = true; }));
    EXPECT_TRUE(refused([](OutputOptions& options) { options.score_side = ScoreSide::both; }));
    EXPECT_TRUE(refused([](OutputOptions& options) { options.profile = *find_profile("lightburn"); }));
    EXPECT_TRUE(refused([](OutputOptions& options) { options.profile = *find_profile("print-and-cut"); }));
}

// --- what is on which tile

// A drawing of 1000 × 1000 mm with one shape.
SheetDrawing drawn(const std::vector<Ring>& rings, Operation operation, bool filled, double width_mm) {
    SheetDrawing drawing;
    drawing.width_mm = drawing.height_mm = 1000.0;
    SheetShape& shape = drawing.shapes.emplace_back();
    shape.operation = operation;
    shape.filled = filled;
    shape.width_mm = width_mm;
    shape.runs = rings.size();
    for (const Ring& ring : rings) {
        drawing.runs.push_back({drawing.points.size(), ring.size(), true});
        drawing.points.insert(drawing.points.end(), ring.begin(), ring.end());
    }
    drawing.layers.push_back({"all", operation, operation, 0, 1, 0, 0});
    return drawing;
}

Ring square(double low, double high) { return {{low, low}, {high, low}, {high, high}, {low, high}}; }

TEST(TileParts, ATileWithinAFrameIsEmptyAndOneWithinAnAreaIsNot) {
    const Box area{{0.0, 0.0}, {1000.0, 1000.0}};
    const TileGrid grid = tile_grid(area, {120.0, 120.0, 10.0}, false);
    ASSERT_EQ(grid.columns, 11);
    const auto used = [&](const SheetDrawing& drawing) {
        const std::vector<SheetPart> parts = tile_parts(grid, drawing);
        return std::count_if(parts.begin(), parts.end(), [](const SheetPart& p) { return !p.empty(); });
    };
    EXPECT_EQ(used(drawn({square(1, 999)}, Operation::outer_cut, false, 0.25)), 40);
    EXPECT_EQ(used(drawn({square(1, 999)}, Operation::fill, true, 0.0)), 121);
    // A hole that leaves the outermost tiles, and reaches into the next ones.
    EXPECT_EQ(used(drawn({square(1, 999), square(50, 950)}, Operation::fill, true, 0.0)), 40);
    // By the rule of letters two rings that run alike have no hole.
    EXPECT_EQ(used(drawn({square(1, 999), square(50, 950)}, Operation::draw, true, 0.0)), 121);
    EXPECT_EQ(used(drawn({}, Operation::fill, true, 0.0)), 0);
}

// By hand: whether a segment comes within `reach` of a box.
bool comes_near(const Segment& segment, const Box& box, double reach) {
    if (holds(box, segment.a) || holds(box, segment.b)) return true;
    const Ring corners{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    for (std::size_t i = 0; i < 4; ++i) {
        if (distance(segment, Segment{corners[i], corners[(i + 1) % 4]}) <= reach) return true;
    }
    return false;
}

TEST(TileParts, ALineIsOnEveryTileThatItPassesAndOnHardlyAnyOther) {
    test::Random random(4);
    for (int i = 0; i < 200; ++i) {
        const auto somewhere = [&] { return Vec2{1000.0 * random.unit(), 1000.0 * random.unit()}; };
        const SheetDrawing drawing = drawn({{somewhere(), somewhere()}}, Operation::outer_cut, false, 0.5);
        const Segment segment{drawing.points[0], drawing.points[1]};
        const TileGrid grid = tile_grid(drawn_box(drawing), {150.0, 90.0, 10.0}, i % 2 == 0);
        const std::vector<SheetPart> parts = tile_parts(grid, drawing);
        each_tile(grid, [&](int row, int column) {
            const bool is_on = !parts[grid.index(row, column)].empty();
            if (comes_near(segment, grid.tile(row, column), 0.25)) {
                EXPECT_TRUE(is_on);
            }
            // Row by row the reach counts along both axes.
            if (is_on) {
                EXPECT_TRUE(comes_near(segment, grid.tile(row, column), 1.5));
            }
        });
    }
}

TEST(TileParts, TheBoxOfADrawingCountsLineWidthsAndEndsWithTheSheet) {
    const Box box = drawn_box(drawn({square(100, 200)}, Operation::outer_cut, false, 0.5));
    EXPECT_EQ(box.min, (Vec2{99.75, 99.75}));
    EXPECT_EQ(box.max, (Vec2{200.25, 200.25}));
    const Box cut = drawn_box(drawn({square(-5, 1200)}, Operation::fill, true, 0.0));
    EXPECT_EQ(cut.min, (Vec2{0.0, 0.0}));
    EXPECT_EQ(cut.max, (Vec2{1000.0, 1000.0}));
    EXPECT_TRUE(drawn_box(drawn({}, Operation::fill, true, 0.0)).empty());
}

}  // namespace
}  // namespace popup
