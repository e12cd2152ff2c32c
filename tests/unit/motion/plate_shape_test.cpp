// What of a plate is inside its edges, of outlines that are narrowed in parts.
#include "motion/plate_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/geometry/regions.h"

namespace popup {
namespace {

// A strip with teeth `deep` mm long, each of a few corners, and a hole under each.
Plate comb(int teeth, bool upright, double deep = 7.5) {
    Plate plate;
    const auto point = [upright](double x, double y) { return upright ? Vec2{-y, x} : Vec2{x, y}; };
    for (int i = 0; i < teeth; ++i) {
        const double x = 4.0 * i;
        for (const Vec2 p :
             {Vec2{x, 0.0}, Vec2{x + 1.0, 0.5 - deep}, Vec2{x + 2.5, -deep}, Vec2{x + 3.0, 0.0}})
            plate.outline.outer.push_back(point(p.x, p.y));
        plate.outline.holes.push_back({point(x + 1.0, 2.0), point(x + 1.5, 4.0), point(x + 2.5, 3.0)});
    }
    plate.outline.outer.push_back(point(4.0 * teeth, 6.0));
    plate.outline.outer.push_back(point(0.0, 6.0));
    return plate;
}

double area_of(const Triangle2& t) { return 0.5 * std::abs(cross(t[1] - t[0], t[2] - t[0])); }

TEST(PlateShape, OfManyCornersHasTheCoreOfTheWhole) {
    for (const bool upright : {false, true}) {
        const Plate plate = comb(700, upright);
        double expected = 0.0;
        for (const Polygon& part : offset({plate.outline}, -kTouchMm, Corners::rounded))
            expected += area(part);
        double found = 0.0;
        const PlateShape shape = plate_shape(plate);
        for (const Triangle2& t : shape.core.all()) {
            found += area_of(t);
            const Vec2 middle = 1.0 / 3.0 * (t[0] + t[1] + t[2]);
            EXPECT_TRUE(contains(plate.outline, middle)) << middle.x << ' ' << middle.y;
        }
        // Each strip rounds its corners to the grid of the library.
        EXPECT_NEAR(found, expected, 1e-5 * expected);
    }
}

// Teeth longer than all of them are wide run along the longer side.
TEST(PlateShape, OfAFringeIsNotCutAcrossItsTeeth) {
    for (const bool upright : {false, true}) {
        const Plate plate = comb(400, upright, 4000.0);
        const PlateShape shape = plate_shape(plate);
        EXPECT_LT(shape.core.all().size(), 20U * 400U);
    }
}

}  // namespace
}  // namespace popup
