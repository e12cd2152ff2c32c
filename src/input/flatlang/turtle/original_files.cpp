#include "input/flatlang/turtle/original_files.h"

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
constexpr double points_an_inch = 72.0;
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

// Each loop flat, times `scale`, where it was put: on shelves, or with `part_mode` in place.
std::vector<std::vector<Vec2>> laid_out(const Trail& trail, bool part_mode, double scale) {
    std::vector<std::vector<Vec2>> loops;
    loops.reserve(trail.polygons.size());
    Box all;
    for (const TrailPolygon& polygon : trail.polygons) {
        loops.push_back(turned_flat(polygon.points, !part_mode));
        for (const Vec2 point : loops.back()) all.extend(point);
    }
    Vec2 shelf;
    double shelf_height = 0.0;
    for (std::vector<Vec2>& loop : loops) {
        Box box;
        for (Vec2& point : loop) {
            point = scale * (point - all.min);
            box.extend(point);
        }
        if (shelf.x + box.width() > sheet_width) {
            shelf = {0.0, shelf.y + shelf_height + gap};
            shelf_height = 0.0;
        }
        if (!part_mode) {
            for (Vec2& point : loop) point = point + shelf;
        }
        shelf.x += box.width() + gap;
        shelf_height = std::max(shelf_height, box.height());
    }
    return loops;
}

// Towards zero, within 32 bits.
int whole(double number) {
    const double value = std::trunc(number);
    if (std::isnan(value)) return 0;
    return static_cast<int>(std::clamp(value, static_cast<double>(std::numeric_limits<int>::min()),
                                       static_cast<double>(std::numeric_limits<int>::max())));
}

}  // namespace

std::string original_hpgl(const Trail& trail, bool part_mode) {
    const std::vector<std::vector<Vec2>> loops = laid_out(trail, part_mode, 1.0);
    fmt::memory_buffer out;
    const auto write = [&out](const char* pen, Vec2 to) {
        fmt::format_to(std::back_inserter(out), "{} {} {}\n", pen, whole(units_an_inch * to.x),
                       whole(units_an_inch * to.y));
    };
    fmt::format_to(std::back_inserter(out), "IN\nPA\nSP3\n\n");
    for (const std::vector<Vec2>& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) write(i == 0 ? "PU" : "PD", loop[i]);
        write("PD", loop.front());
    }
    // Plotters drew the last line only when another command came.
    if (!loops.empty()) write("PU", loops.back().front());
    return fmt::to_string(out);
}

OriginalLaser original_laser(const Trail& trail, bool part_mode) {
    constexpr Vec2 offset{2, 2};
    constexpr double margin = 10;
    OriginalLaser laser;
    Vec2 far;
    for (const std::vector<Vec2>& loop : laid_out(trail, part_mode, points_an_inch)) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            far = {std::max(far.x, loop[i].x), std::max(far.y, loop[i].y)};
            laser.lines.push_back({loop[i] + offset, loop[(i + 1) % loop.size()] + offset});
        }
    }
    laser.width = whole(whole(far.x) + margin);
    laser.height = whole(whole(far.y) + margin);
    return laser;
}

}  // namespace popup::flatlang
