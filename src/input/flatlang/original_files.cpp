#include "input/flatlang/original_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "popup/geometry.h"

namespace popup::flatlang {

namespace {

constexpr double units_an_inch = 1016.0;
constexpr double sheet_width = 12.0;
constexpr double gap = 0.1;

Vec3 unit_or_zero(Vec3 a) {
    const double size = length(a);
    return size != 0.0 ? (1.0 / size) * a : Vec3{};
}

// In the axes of its first edge and of the plane of its first three points; from its first point, or not.
std::vector<Vec2> turned_flat(const std::vector<Vec3>& points, bool from_first) {
    const Vec3 u = unit_or_zero(points[1] - points[0]);
    const Vec3 w = unit_or_zero(cross(points[1] - points[0], points[2] - points[0]));
    const Vec3 v = unit_or_zero(cross(w, u));
    const Vec3 origin = from_first ? points[0] : Vec3{};
    std::vector<Vec2> flat;
    flat.reserve(points.size());
    for (const Vec3 point : points) flat.push_back({dot(u, point - origin), dot(v, point - origin)});
    return flat;
}

// Towards zero, within 32 bits.
int units(double inches) {
    const double value = std::trunc(units_an_inch * inches);
    if (std::isnan(value)) return 0;
    return static_cast<int>(std::clamp(value, static_cast<double>(std::numeric_limits<int>::min()),
                                       static_cast<double>(std::numeric_limits<int>::max())));
}

}  // namespace

std::string original_hpgl(const Trail& trail, bool part_mode) {
    std::vector<std::vector<Vec2>> loops;
    loops.reserve(trail.polygons.size());
    Box all;
    for (const TrailPolygon& polygon : trail.polygons) {
        loops.push_back(turned_flat(polygon.points, !part_mode));
        for (const Vec2 point : loops.back()) all.extend(point);
    }
    fmt::memory_buffer out;
    const auto write = [&out](const char* pen, Vec2 to) {
        fmt::format_to(std::back_inserter(out), "{} {} {}\n", pen, units(to.x), units(to.y));
    };
    fmt::format_to(std::back_inserter(out), "IN\nPA\nSP3\n\n");
    Vec2 shelf;
    double shelf_height = 0.0;
    Vec2 last_start;
    for (std::vector<Vec2>& loop : loops) {
        Box box;
        for (Vec2& point : loop) {
            point = point - all.min;
            box.extend(point);
        }
        if (shelf.x + box.width() > sheet_width) {
            shelf = {0.0, shelf.y + shelf_height + gap};
            shelf_height = 0.0;
        }
        if (!part_mode) {
            for (Vec2& point : loop) point = point + shelf;
        }
        last_start = loop.front();
        for (std::size_t i = 0; i < loop.size(); ++i) write(i == 0 ? "PU" : "PD", loop[i]);
        write("PD", last_start);
        shelf.x += box.width() + gap;
        shelf_height = std::max(shelf_height, box.height());
    }
    if (!loops.empty()) write("PU", last_start);
    return fmt::to_string(out);
}

}  // namespace popup::flatlang
