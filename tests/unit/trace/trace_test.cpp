// Traced outlines against the pixels that they were traced from, looked at by other means: curves are walked
// along by their formula, pixels are painted anew by counting crossings, and Boost says what is a polygon.
#include "popup/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "support/random.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

const int kRounds = sanitized_count(10);

PixelMask mask_from(int width, int height, std::vector<std::uint8_t> inside) {
    PixelMask mask;
    mask.width = width;
    mask.height = height;
    mask.inside = std::move(inside);
    return mask;
}

// '#' is the figure.
PixelMask drawn(const std::vector<std::string>& rows, int times = 1) {
    std::vector<std::uint8_t> inside;
    for (const std::string& row : rows) {
        for (int again = 0; again < times; ++again) {
            for (const char one : row)
                inside.insert(inside.end(), static_cast<std::size_t>(times), one == '#');
        }
    }
    return mask_from(static_cast<int>(rows.front().size()) * times, static_cast<int>(rows.size()) * times,
                     std::move(inside));
}

std::uint8_t at(const PixelMask& mask, int x, int y) {
    if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) return 0;
    return mask.inside[static_cast<std::size_t>(y * mask.width + x)];
}

struct Disc {
    double x, y, r;
    bool hole;
};
// Discs over one another, each painted or taken away.
PixelMask blobs(int size, const std::vector<Disc>& discs) {
    std::vector<std::uint8_t> inside;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            std::uint8_t one = 0;
            for (const Disc& disc : discs) {
                if (std::hypot(x + 0.5 - disc.x, y + 0.5 - disc.y) < disc.r) one = disc.hole ? 0 : 1;
            }
            inside.push_back(one);
        }
    }
    return mask_from(size, size, std::move(inside));
}

PixelMask random_blobs(Random& random, int size, double speckles) {
    std::vector<Disc> discs;
    const std::size_t count = 2 + random.below(8);
    for (std::size_t i = 0; i < count; ++i) {
        discs.push_back({random.unit() * size, random.unit() * size, size * (0.05 + 0.25 * random.unit()),
                         i > 0 && random.below(3) == 0});
    }
    PixelMask mask = blobs(size, discs);
    for (std::uint8_t& one : mask.inside) {
        if (random.unit() < speckles) one = 1 - one;
    }
    return mask;
}

Vec2 on_curve(Vec2 a, const PathStep& step, double t) {
    const double s = 1 - t;
    if (!step.curve) return s * a + t * step.to;
    return s * s * s * a + 3 * s * s * t * step.control_1 + 3 * s * t * t * step.control_2 +
           t * t * t * step.to;
}

// Points along a subpath, its first once.
std::vector<Vec2> walked(const Subpath& subpath, int steps) {
    std::vector<Vec2> points;
    Vec2 from = subpath.start;
    for (const PathStep& step : subpath.steps) {
        for (int i = 0; i < steps; ++i) points.push_back(on_curve(from, step, 1.0 * i / steps));
        from = step.to;
    }
    if (distance(from, subpath.start) > 0) {
        for (int i = 0; i < steps; ++i) points.push_back(lerp(from, subpath.start, 1.0 * i / steps));
    }
    return points;
}

// How far p is from the nearest edge between figure and ground; `reach` where none is nearer.
double from_border(const PixelMask& mask, Vec2 p, int reach) {
    double least = reach;
    const int cx = static_cast<int>(std::floor(p.x));
    const int cy = static_cast<int>(std::floor(mask.height - p.y));
    for (int y = cy - reach; y <= cy + reach; ++y) {
        for (int x = cx - reach; x <= cx + reach; ++x) {
            const double top = mask.height - y;
            if (at(mask, x, y) != at(mask, x - 1, y))
                least = std::min(least, distance(p, Segment{{1.0 * x, top}, {1.0 * x, top - 1}}));
            if (at(mask, x, y) != at(mask, x, y - 1))
                least = std::min(least, distance(p, Segment{{1.0 * x, top}, {x + 1.0, top}}));
        }
    }
    return least;
}

// The farther of the two ways: from the curves to the borders of pixels, and from these to the curves.
double hausdorff(const PixelMask& mask, const Traced& traced, double pixel_mm) {
    double most = 0;
    std::vector<std::vector<Vec2>> columns(static_cast<std::size_t>(mask.width) + 3);
    for (const TracedShape& shape : traced.shapes) {
        for (const Subpath& subpath : shape.path.subpaths()) {
            for (const Vec2 p : walked(subpath, 64)) {
                const Vec2 pixel = (1 / pixel_mm) * p;
                most = std::max(most, from_border(mask, pixel, 4));
                columns[static_cast<std::size_t>(std::clamp(pixel.x + 1, 0.0, mask.width + 2.0))].push_back(
                    pixel);
            }
        }
    }
    const auto to_curves = [&columns](Vec2 p) {
        double least = 8;
        const auto column = static_cast<std::ptrdiff_t>(p.x + 1);
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(column - 3, 0);
             k <= column + 3 && k < static_cast<std::ptrdiff_t>(columns.size()); ++k) {
            for (const Vec2 q : columns[static_cast<std::size_t>(k)]) least = std::min(least, distance(p, q));
        }
        return least;
    };
    for (int y = 0; y <= mask.height; ++y) {
        for (int x = 0; x <= mask.width; ++x) {
            if (at(mask, x, y) != at(mask, x - 1, y))
                most = std::max(most, to_curves({1.0 * x, mask.height - y - 0.5}));
            if (at(mask, x, y) != at(mask, x, y - 1))
                most = std::max(most, to_curves({x + 0.5, 1.0 * mask.height - y}));
        }
    }
    return most;
}

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Region = bg::model::polygon<Point, false>;

Region region_of(const TracedShape& shape) {
    Region region;
    for (std::size_t i = 0; i < shape.path.subpaths().size(); ++i) {
        std::vector<Vec2> points = walked(shape.path.subpaths()[i], 16);
        points.push_back(points.front());
        if (i > 0) region.inners().emplace_back();
        for (const Vec2 p : points) {
            const Point point(p.x, p.y);
            if (i == 0) {
                region.outer().push_back(point);
            } else {
                region.inners().back().push_back(point);
            }
        }
    }
    return region;
}

// Each shape is a polygon whose holes lie in it, and no two have paper in common.
void expect_sound(const Traced& traced) {
    std::vector<Region> regions;
    for (const TracedShape& shape : traced.shapes) {
        regions.push_back(region_of(shape));
        std::string why;
        EXPECT_TRUE(bg::is_valid(regions.back(), why)) << why;
    }
    for (std::size_t i = 0; i < regions.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_FALSE(bg::intersects(regions[i], regions[k])) << i << ' ' << k;
    }
}

TraceOptions pixels_of_a_tenth() {
    TraceOptions options;
    options.pixel_mm = 0.1;
    options.simplify_mm = 0.02;
    options.min_feature_mm = 0.0;
    return options;
}

Traced traced(const PixelMask& mask, const TraceOptions& options) {
    Diagnostics diagnostics("picture.png");
    std::optional<Traced> result = trace_outlines(mask, options, diagnostics);
    EXPECT_TRUE(result.has_value());
    return result.value_or(Traced{});
}

std::vector<std::string> messages(const PixelMask& mask, const TraceOptions& options) {
    Diagnostics diagnostics("picture.png");
    trace_outlines(mask, options, diagnostics);
    std::vector<std::string> all;
    for (const Diagnostic& one : diagnostics.sorted()) all.push_back(one.code + ": " + one.message);
    return all;
}

void expect_same_area(const PixelMask& mask, const Traced& result) {
    const auto pixels = std::count(mask.inside.begin(), mask.inside.end(), 1);
    double area = 0;
    double length = 0;
    for (const TracedShape& shape : result.shapes) {
        const Region region = region_of(shape);
        area += bg::area(region);
        length += bg::perimeter(region);
    }
    // Less than a quarter of a pixel along all of the border.
    EXPECT_NEAR(area, 0.01 * static_cast<double>(pixels), 0.25 * 0.1 * length);
}

TEST(Trace, StaysWithinAPixelOfThePixels) {
    Random random(18);
    for (int round = 0; round < kRounds * 4; ++round) {
        // A disc with a hole in each quarter.
        std::vector<Disc> discs;
        for (int i = 0; i < 4; ++i) {
            const double r = 10 + 18 * random.unit();
            const Vec2 at{30 + 60.0 * (i % 2) + random.unit(), 30 + 60.0 * (i / 2) + random.unit()};
            discs.push_back({at.x, at.y, r, false});
            discs.push_back({at.x, at.y + 0.2 * r, 0.6 * r, true});
        }
        const PixelMask mask = blobs(120, discs);
        const Traced result = traced(mask, pixels_of_a_tenth());
        EXPECT_LE(hausdorff(mask, result, 0.1), 1.0) << round;
        EXPECT_EQ(result.shapes.size(), 4U);
        expect_sound(result);
        expect_same_area(mask, result);
    }
}

// Where discs meet there are tips of single pixels, which curves cut short.
TEST(Trace, CutsTipsShortByLessThanThreePixels) {
    Random random(18);
    for (int round = 0; round < kRounds * 6; ++round) {
        const PixelMask mask = random_blobs(random, 120, 0.0);
        if (std::count(mask.inside.begin(), mask.inside.end(), 1) == 0) continue;
        const Traced result = traced(mask, pixels_of_a_tenth());
        EXPECT_LE(hausdorff(mask, result, 0.1), 2.5) << round;
        expect_sound(result);
        expect_same_area(mask, result);
    }
}

// Where noise leaves necks and gaps of single pixels, curves would cross.
TEST(Trace, NeitherCrossesNorTouchesWhateverTheNoise) {
    Random random(7);
    std::size_t holes = 0;
    std::size_t islands = 0;
    for (int round = 0; round < kRounds * 15; ++round) {
        const PixelMask mask =
            random_blobs(random, 20 + static_cast<int>(random.below(40)), 0.02 * (round % 20));
        if (std::count(mask.inside.begin(), mask.inside.end(), 1) == 0) continue;
        TraceOptions options = pixels_of_a_tenth();
        options.simplify_mm = round % 3 == 0 ? 0.3 : 0.02;
        const Traced result = traced(mask, options);
        expect_sound(result);
        if (options.simplify_mm < 0.1) {
            EXPECT_LE(hausdorff(mask, result, 0.1), 2.5) << round;
        }
        islands += result.shapes.size() - 1;
        for (const TracedShape& shape : result.shapes) {
            holes += shape.path.subpaths().size() - 1;
            for (std::size_t i = 0; i < shape.path.subpaths().size(); ++i) {
                const double turn = signed_area(walked(shape.path.subpaths()[i], 16));
                EXPECT_GT(i == 0 ? turn : -turn, 0.0);
            }
        }
    }
    // There are holes and islands in every picture, on average.
    const auto pictures = static_cast<std::size_t>(kRounds) * 15;
    EXPECT_GT(holes, pictures);
    EXPECT_GT(islands, pictures);
}

TEST(Trace, NestsHolesAndIslands) {
    const PixelMask mask = blobs(200, {{100, 100, 90, false},
                                       {100, 100, 70, true},
                                       {100, 100, 50, false},
                                       {100, 100, 30, true},
                                       {100, 100, 10, false}});
    const Traced result = traced(mask, pixels_of_a_tenth());
    ASSERT_EQ(result.shapes.size(), 3U);
    std::vector<double> areas;
    for (const TracedShape& shape : result.shapes) areas.push_back(bg::area(region_of(shape)));
    std::ranges::sort(areas);
    EXPECT_NEAR(areas[0], M_PI, 0.1);
    EXPECT_NEAR(areas[1], 16 * M_PI, 0.25);
    EXPECT_NEAR(areas[2], 32 * M_PI, 0.25);
    expect_sound(result);
    EXPECT_DOUBLE_EQ(result.width_mm, 20.0);
}

TEST(Trace, MakesFewCurvesOfACircle) {
    const Traced result = traced(blobs(400, {{200, 200, 180, false}}), pixels_of_a_tenth());
    ASSERT_EQ(result.shapes.size(), 1U);
    const std::vector<PathStep>& steps = result.shapes[0].path.subpaths()[0].steps;
    EXPECT_LT(steps.size(), 40U);
    EXPECT_TRUE(std::ranges::all_of(steps, [](const PathStep& step) { return step.curve; }));
}

TEST(Trace, KeepsTheCornersOfASquare) {
    const Traced result =
        traced(drawn({".....", ".###.", ".###.", ".###.", "....."}, 20), pixels_of_a_tenth());
    ASSERT_EQ(result.shapes.size(), 1U);
    for (const Vec2 corner : {Vec2{2, 2}, Vec2{8, 2}, Vec2{8, 8}, Vec2{2, 8}}) {
        double least = 1;
        for (const Vec2 p : walked(result.shapes[0].path.subpaths()[0], 64))
            least = std::min(least, distance(p, corner));
        EXPECT_LE(least, 0.05);
    }
}

TEST(Trace, LooksAtFinePicturesAsCoarselyAsTheToleranceAllows) {
    const PixelMask mask = blobs(1000, {{500, 480, 400, false}, {650, 500, 90, true}});
    TraceOptions options;
    options.pixel_mm = 0.01;
    options.simplify_mm = 0.2;
    const Traced result = traced(mask, options);
    ASSERT_EQ(result.shapes.size(), 1U);
    EXPECT_EQ(result.shapes[0].path.subpaths().size(), 2U);
    for (const Vec2 p : walked(result.shapes[0].path.subpaths()[0], 64))
        EXPECT_NEAR(distance(p, Vec2{5.0, 5.2}), 4.0, 0.2);
    expect_sound(result);
}

TEST(Trace, TellsWhatIsTooSmall) {
    const PixelMask mask = drawn({"..........", ".######.#.", ".######...", ".##.###...", ".######...",
                                  "..........", "#......##.", ".......##."},
                                 4);
    TraceOptions options;
    options.pixel_mm = 0.1;
    options.min_feature_mm = 0.5;
    EXPECT_EQ(
        messages(mask, options),
        (std::vector<std::string>{
            "trace-specks: left out 2 specks smaller than a square of 0.5 mm; the largest has 0.16 mm²",
            "trace-holes-filled: filled 1 hole smaller than a square of 0.5 mm; the largest has 0.16 mm²"}));
    options.largest = true;
    EXPECT_EQ(
        messages(mask, options).back(),
        "trace-others: left out 1 shape beside the largest, which has 3.84 mm²; the largest of them has "
        "0.64 mm²");
    EXPECT_EQ(traced(mask, options).shapes.size(), 1U);
    options.min_feature_mm = 5.0;
    EXPECT_EQ(
        messages(mask, options),
        (std::vector<std::string>{"trace-empty: all 4 shapes in the picture are smaller than a square of "
                                  "5 mm; the largest has 3.68 mm²"}));
}

TEST(Trace, TellsOfThinPaper) {
    // Two squares of 2 mm, and a bridge between them of 0.4 mm; beside them a bar of 0.4 mm.
    const PixelMask mask =
        drawn({"............", ".#####......", ".#####......", ".#####.#####", ".###########", ".#####.#####",
               ".......#####", ".......#####", "............", "############"},
              4);
    TraceOptions options;
    options.pixel_mm = 0.1;
    options.min_feature_mm = 1.0;
    const Traced result = traced(mask, options);
    ASSERT_EQ(result.necks.size(), 1U);
    EXPECT_NEAR(result.necks[0].width_mm, 0.4, 0.1);
    EXPECT_NEAR(result.necks[0].at.x, 2.6, 0.3);
    EXPECT_NEAR(result.necks[0].at.y, 2.2, 0.21);
    EXPECT_EQ(result.thin_shapes, 1U);
    EXPECT_EQ(messages(mask, options).size(), 2U);
    options.min_feature_mm = 0.3;
    EXPECT_TRUE(messages(mask, options).empty());
}

PixelMask filled(int width, int height, const std::function<bool(double, double)>& inside) {
    PixelMask mask;
    mask.width = width;
    mask.height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) mask.inside.push_back(inside(x + 0.5, y + 0.5) ? 1 : 0);
    }
    return mask;
}

// Steps of pixels make tips wider and narrower on their way, and a bar is a pixel wider or narrower than it
// was drawn.
TEST(Trace, TakesNoTipForANeck) {
    TraceOptions options;
    options.pixel_mm = 0.1;
    options.min_feature_mm = 1.0;
    for (int i = 0; i < 20; ++i) {
        const double lean = 0.021 * i;
        const PixelMask tip = filled(300, 460, [&](double x, double y) {
            return y > 10.0 &&
                   std::abs(x - 60.0 - lean * y) < std::max(2.0, 25.0 * (1.0 - (y - 10.0) / 440.0)) &&
                   y < 450.0;
        });
        EXPECT_EQ(messages(tip, options), std::vector<std::string>{}) << lean;
    }
    for (const int wide : {10, 12}) {
        const PixelMask bar = filled(200, 100, [&](double x, double y) {
            return y > 10.0 && y < 90.0 && x > 10.0 && x < 190.0 &&
                   (x < 60.0 || x > 140.0 || (y > 50.0 && y < 50.0 + wide));
        });
        EXPECT_EQ(messages(bar, options), std::vector<std::string>{}) << wide;
    }
}

// Where a pixel is a large part of the least width, necks are told all the same.
TEST(Trace, TellsOfNecksOfOnePixel) {
    TraceOptions options;
    options.min_feature_mm = 1.0;
    for (const double pixel_mm : {0.5, 0.25}) {
        options.pixel_mm = pixel_mm;
        const int side = static_cast<int>(1.5 / pixel_mm);
        const PixelMask mask = filled(2 * side + 6, side + 2, [&](double x, double y) {
            const bool in_square = y > 1.0 && y < side + 1.0 &&
                                   ((x > 1.0 && x < side + 1.0) || (x > side + 4.0 && x < 2.0 * side + 4.0));
            return in_square || (y > 2.0 && y < 3.0 && x > 1.0 && x < side + 5.0);
        });
        const Traced result = traced(mask, options);
        EXPECT_EQ(result.necks.size(), 1U) << pixel_mm;
    }
}

ImagePixels grey(int width, const std::vector<int>& values, int alpha = 255) {
    ImagePixels pixels;
    pixels.width = width;
    pixels.height = static_cast<int>(values.size()) / width;
    pixels.opaque = alpha == 255;
    for (const int value : values) {
        for (int channel = 0; channel < 3; ++channel) pixels.rgba.push_back(static_cast<std::uint8_t>(value));
        pixels.rgba.push_back(static_cast<std::uint8_t>(alpha));
    }
    return pixels;
}

TEST(TraceMask, SeparatesDarkFromLightByTheirHistogram) {
    const PixelMask two = mask_of(grey(2, {0, 255, 255, 0}), {});
    EXPECT_EQ(two.threshold, 128);
    EXPECT_EQ(two.inside, (std::vector<std::uint8_t>{1, 0, 0, 1}));
    const PixelMask greys = mask_of(grey(3, {10, 20, 30, 200, 210, 220}), {});
    EXPECT_EQ(greys.threshold, 115);
    const PixelMask turned = mask_of(grey(3, {10, 20, 30, 200, 210, 220}), {.threshold = 25, .invert = true});
    EXPECT_EQ(turned.inside, (std::vector<std::uint8_t>{0, 0, 1, 1, 1, 1}));
}

TEST(TraceMask, TakesOpacityWhereSomePixelsAreClear) {
    ImagePixels pixels = grey(2, {0, 0, 255, 255});
    pixels.opaque = false;
    pixels.rgba[3] = 127;
    pixels.rgba[11] = 128;
    pixels.rgba[15] = 0;
    const PixelMask mask = mask_of(pixels, {});
    EXPECT_TRUE(mask.by_alpha);
    EXPECT_EQ(mask.inside, (std::vector<std::uint8_t>{0, 1, 1, 0}));
}

// As the corners of a window in a screenshot.
TEST(TraceMask, AFewClearPixelsAreNoGround) {
    std::vector<int> values(400, 255);
    for (int i = 150; i < 200; ++i) values[static_cast<std::size_t>(i)] = 0;
    ImagePixels pixels = grey(20, values);
    pixels.opaque = false;
    pixels.rgba[3] = 0;
    pixels.rgba[4 * 399 + 3] = 254;
    const PixelMask mask = mask_of(pixels, {});
    EXPECT_FALSE(mask.by_alpha);
    EXPECT_TRUE(mask.few_clear);
    EXPECT_EQ(std::count(mask.inside.begin(), mask.inside.end(), 1), 50);
    EXPECT_EQ(mask.inside[0], 0) << "clear is white";
    EXPECT_EQ(messages(mask, pixels_of_a_tenth()).front().substr(0, 16), "trace-few-clear:");
    // All of one colour: there is nothing to see but where it is clear.
    ImagePixels plain = grey(20, std::vector<int>(400, 255));
    plain.opaque = false;
    plain.rgba[3] = 0;
    EXPECT_TRUE(mask_of(plain, {}).by_alpha);
}

TEST(TraceMask, KnowsPicturesOfOneValue) {
    EXPECT_TRUE(mask_of(grey(1, {255}), {}).even);
    EXPECT_TRUE(mask_of(grey(2, {7, 7, 7, 7}), {}).even);
    EXPECT_EQ(
        messages(mask_of(grey(1, {255}), {}), {}),
        std::vector<std::string>{"trace-empty: nothing in the picture is dark enough to be the figure"});
    // One pixel is a figure where it is large enough.
    TraceOptions options;
    options.pixel_mm = 10.0;
    const Traced one = traced(mask_of(grey(1, {0}), {.threshold = 100}), options);
    ASSERT_EQ(one.shapes.size(), 1U);
    expect_sound(one);
}

// One pixel wide: smooth curves would leave a needle of a part of it.
TEST(Trace, KeepsThinStrokesWhole) {
    const std::string empty(40, '.');
    std::vector<std::string> bar(40, empty);
    std::vector<std::string> cross(40, empty);
    for (std::size_t i = 3; i < 37; ++i) {
        bar[i][5] = '#';
        cross[i][20] = cross[20][i] = '#';
    }
    TraceOptions options;
    options.pixel_mm = 1.0;
    for (const auto& [rows, pixels] : {std::pair(bar, 34.0), std::pair(cross, 67.0)}) {
        const Traced result = traced(drawn(rows), options);
        ASSERT_EQ(result.shapes.size(), 1U);
        expect_sound(result);
        const Region region = region_of(result.shapes[0]);
        EXPECT_NEAR(bg::area(region), pixels, 0.1 * pixels);
        Box box;
        for (const Vec2 p : walked(result.shapes[0].path.subpaths()[0], 16)) box.extend(p);
        EXPECT_NEAR(box.height(), 34.0, 1.0);
    }
}

TEST(Trace, RefusesNoise) {
    Random random(3);
    std::vector<std::uint8_t> inside(std::size_t{2000} * 2000);
    for (std::uint8_t& one : inside) one = static_cast<std::uint8_t>(random.below(2));
    TraceOptions options = pixels_of_a_tenth();
    const std::vector<std::string> told = messages(mask_from(2000, 2000, std::move(inside)), options);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_TRUE(told[0].starts_with("trace-too-complex: the outlines go along ")) << told[0];
}

TEST(Trace, WritesADrawingInMillimetres) {
    const std::string svg = svg_of(traced(drawn({"...", ".#.", "..."}, 10), pixels_of_a_tenth()));
    EXPECT_NE(svg.find("width=\"3mm\" height=\"3mm\" viewBox=\"0 0 3 3\""), std::string::npos) << svg;
    EXPECT_NE(svg.find("<path id=\"shape-1\" fill=\"none\" stroke=\"#000000\""), std::string::npos) << svg;
}

}  // namespace
}  // namespace popup::test
