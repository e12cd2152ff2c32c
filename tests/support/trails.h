// Trails as a turtle draws them, for tests of what is made of them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "input/flatlang/turtle/trail.h"

namespace popup::test {

// Lengths in inches.
class TrailMaker {
 public:
    TrailMaker() { trail.parts.push_back({}); }

    void part(const std::string& name) {
        const int line = static_cast<int>(trail.parts.size()) + 1;
        trail.parts.push_back({name, {line, 1}});
    }
    // A loop drawn in this order with the pen down, and what the turtle finds of it.
    void loop(const std::vector<Vec3>& points) {
        for (std::size_t i = 0; i < points.size(); ++i) line(points[i], points[(i + 1) % points.size()]);
        std::vector<Vec3> newest_first(points.rbegin(), points.rend());
        trail.polygons.push_back({std::move(newest_first), current()});
    }
    void line(Vec3 from, Vec3 to) { trail.segments.push_back({from, to, current()}); }
    void rectangle(Vec3 corner, Vec3 along, Vec3 aside) {
        loop({corner, corner + along, corner + along + aside, corner + aside});
    }
    void square(double x, double y, double side) { rectangle({x, y, 0}, {side, 0, 0}, {0, side, 0}); }

    flatlang::Trail trail;

 private:
    [[nodiscard]] int current() const { return static_cast<int>(trail.parts.size()) - 1; }
};

}  // namespace popup::test
