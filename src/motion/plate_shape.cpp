#include "motion/plate_shape.h"

#include <algorithm>
#include <utility>

#include "base/geometry/hull.h"
#include "base/geometry/regions.h"
#include "base/geometry/triangulate.h"

namespace popup {
namespace {

void append(const Polygon& polygon, std::vector<Triangle2>& triangles) {
    const Triangulation found = triangulate(polygon);
    for (const auto& t : found.triangles) {
        triangles.push_back({found.points[t[0]], found.points[t[1]], found.points[t[2]]});
    }
}

}  // namespace

Patches::Patches(std::vector<Triangle2> triangles) : triangles_(std::move(triangles)) {
    std::vector<Segment> diagonals;
    diagonals.reserve(triangles_.size());
    for (const Triangle2& t : triangles_) {
        Box box;
        for (const Vec2 p : t) box.extend(p);
        diagonals.push_back({box.min, box.max});
    }
    boxes_ = EdgeIndex({}, diagonals);
}

PlateShape plate_shape(const Plate& plate) {
    PlateShape shape;
    shape.hull = convex_hull(plate.outline.outer);
    shape.box = bounds(plate.outline.outer);
    shape.radius = 0.5 * std::min(shape.box.width(), shape.box.height());
    std::vector<Triangle2> whole;
    append(plate.outline, whole);
    std::vector<Triangle2> core;
    // At notches the arcs of what is taken away are chords, so that too little is taken and not too much.
    for (const Polygon& part : offset({plate.outline}, -kTouchMm, Corners::rounded)) append(part, core);
    shape.whole = Patches(std::move(whole));
    shape.core = Patches(std::move(core));
    shape.edges = EdgeIndex(edges_of(plate.outline));
    shape.rings.push_back(plate.outline.outer);
    for (const Ring& hole : plate.outline.holes) shape.rings.push_back(hole);
    return shape;
}

}  // namespace popup
