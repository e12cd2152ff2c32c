#include "motion/plate_shape.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <utility>

#include "base/hull.h"
#include "base/regions.h"
#include "base/triangulate.h"

namespace popup {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 2, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;

constexpr std::size_t kFew = 12;

bool touch(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

void append(const Polygon& polygon, std::vector<Triangle2>& triangles) {
    const Triangulation found = triangulate(polygon);
    for (const auto& t : found.triangles) {
        triangles.push_back({found.points[t[0]], found.points[t[1]], found.points[t[2]]});
    }
}

}  // namespace

struct Patches::Tree {
    bg::index::rtree<std::pair<TreeBox, int>, bg::index::rstar<8>> tree;
};

Patches::Patches(std::vector<Triangle2> triangles) : triangles_(std::move(triangles)) {
    boxes_.reserve(triangles_.size());
    for (const Triangle2& t : triangles_) {
        Box box;
        for (const Vec2 p : t) box.extend(p);
        boxes_.push_back(box);
    }
    if (triangles_.size() <= kFew) return;
    std::vector<std::pair<TreeBox, int>> entries;
    entries.reserve(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const Box& b = boxes_[i];
        entries.emplace_back(TreeBox{{b.min.x, b.min.y}, {b.max.x, b.max.y}}, static_cast<int>(i));
    }
    tree_ = std::make_unique<Tree>(Tree{decltype(Tree::tree)(entries.begin(), entries.end())});
}

Patches::Patches(Patches&&) noexcept = default;
Patches& Patches::operator=(Patches&&) noexcept = default;
Patches::~Patches() = default;

void Patches::query(const Box& box, std::vector<int>& found) const {
    found.clear();
    if (!tree_) {
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            if (touch(boxes_[i], box)) found.push_back(static_cast<int>(i));
        }
        return;
    }
    const TreeBox wanted{{box.min.x, box.min.y}, {box.max.x, box.max.y}};
    for (auto it = tree_->tree.qbegin(bg::index::intersects(wanted)); it != tree_->tree.qend(); ++it) {
        found.push_back(it->second);
    }
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
