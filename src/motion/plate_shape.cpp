#include "motion/plate_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/geometry/ears.h"
#include "base/geometry/hull.h"
#include "base/geometry/regions.h"

namespace popup {
namespace {

// By their corners: neighbours in the list are neighbours on the plate, and what looks for the first place of
// all begins there.
void put_in_order(std::vector<Triangle2>& triangles) {
    const auto before = [](Vec2 p, Vec2 q) { return std::tie(p.x, p.y) < std::tie(q.x, q.y); };
    for (Triangle2& t : triangles)
        std::rotate(t.begin(), std::min_element(t.begin(), t.end(), before), t.end());
    std::sort(triangles.begin(), triangles.end(), [&](const Triangle2& s, const Triangle2& t) {
        return std::lexicographical_compare(s.begin(), s.end(), t.begin(), t.end(), before);
    });
}

void append(const Polygon& polygon, std::vector<Triangle2>& triangles) {
    const Triangulation found = quick_triangles(polygon);
    for (const auto& t : found.triangles) {
        triangles.push_back({found.points[t[0]], found.points[t[1]], found.points[t[2]]});
    }
}

// Outlines of more corners are narrowed strip by strip: the library joins the parts of one as often as it has
// notches, and looks at all of its corners each time.
constexpr std::size_t kManyCorners = 2000;
constexpr std::size_t kCornersPerStrip = 100;
constexpr double kMostRepeated = 3.0;  // of all edges: where more lie in several strips, strips are no help
constexpr double kOverlapMm = 1.0;     // of strips; far more than what is taken away
static_assert(kOverlapMm > 10.0 * kTouchMm);

// A box cut across into strips that are as wide.
struct Strips {
    Box box;
    bool upright = false;  // they lie above one another
    std::size_t count = 1;

    [[nodiscard]] double end(std::size_t strip) const {
        const double from = upright ? box.min.y : box.min.x;
        const double to = upright ? box.max.y : box.max.x;
        return from + (to - from) * static_cast<double>(strip) / static_cast<double>(count);
    }
    [[nodiscard]] Polygon between(double a, double b) const {
        return upright ? Polygon{{{box.min.x, a}, {box.max.x, a}, {box.max.x, b}, {box.min.x, b}}, {}}
                       : Polygon{{{a, box.min.y}, {b, box.min.y}, {b, box.max.y}, {a, box.max.y}}, {}};
    }
    // How many strips the edges lie in, added up.
    [[nodiscard]] double edges_in(const std::vector<Segment>& edges) const {
        const double width = (upright ? box.height() : box.width()) / static_cast<double>(count);
        double all = 0.0;
        for (const Segment& edge : edges) {
            const Vec2 along = edge.b - edge.a;
            all += 1.0 + (std::abs(upright ? along.y : along.x) + 2.0 * kOverlapMm) / width;
        }
        return all;
    }
};

// What of a region is at least kTouchMm inside it, in parts that may share edges. At notches the arcs of what
// is taken away are chords, so that too little is taken and not too much.
std::vector<Polygon> core_of(const Polygon& region, const Box& box) {
    const auto whole = [&] { return offset({region}, -kTouchMm, Corners::rounded); };
    const std::vector<Segment> edges = edges_of(region);
    if (edges.size() <= kManyCorners) return whole();
    const std::size_t count = edges.size() / kCornersPerStrip;
    Strips strips{box, false, count};
    const Strips upright{box, true, count};
    if (upright.edges_in(edges) < strips.edges_in(edges)) strips = upright;
    // Teeth that run across all strips would be in each of them.
    if (strips.edges_in(edges) > kMostRepeated * static_cast<double>(edges.size())) return whole();
    std::vector<Polygon> core;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = strips.end(i);
        const double b = strips.end(i + 1);
        const std::vector<Polygon> near =
            intersect({region}, {strips.between(a - kOverlapMm, b + kOverlapMm)});
        for (Polygon& part : intersect(offset(near, -kTouchMm, Corners::rounded), {strips.between(a, b)}))
            core.push_back(std::move(part));
    }
    return core;
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

Polygon reach_of(const Plate& plate) {
    if (!plate.rivet) return plate.outline;
    constexpr double kMoreMm = 0.005;
    double most = 0.0;
    for (const Vec2 p : plate.outline.outer) most = std::max(most, distance(p, *plate.rivet));
    // Where the rivet is beside it, it leaves a circle free.
    double least = 0.0;
    if (!contains({plate.outline.outer, {}}, *plate.rivet)) {
        least = most;
        for (const Segment& edge : edges_of({plate.outline.outer, {}}))
            least = std::min(least, distance(*plate.rivet, edge));
    }
    const auto circle = [&](double radius, int corners) {
        Ring ring;
        for (int i = 0; i < corners; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / corners;
            ring.push_back(*plate.rivet + radius * Vec2{std::cos(turn), std::sin(turn)});
        }
        return ring;
    };
    // The sides of the polygon round the outer circle touch it, those of the one in the inner circle are its
    // chords.
    const double half = std::acos(most / (most + kMoreMm));
    const int corners = std::max(8, static_cast<int>(std::ceil(std::numbers::pi / half)));
    Polygon swept{circle(most / std::cos(std::numbers::pi / corners), corners), {}};
    if (least > kMoreMm) {
        Ring hole = circle(least, corners);
        std::reverse(hole.begin(), hole.end());
        swept.holes.push_back(std::move(hole));
    }
    return swept;
}

PlateShape plate_shape(const Plate& plate, bool distances) {
    const Polygon reach = reach_of(plate);
    PlateShape shape;
    shape.hull = convex_hull(reach.outer);
    shape.box = bounds(reach.outer);
    shape.radius = 0.5 * std::min(shape.box.width(), shape.box.height());
    std::vector<Triangle2> whole;
    if (distances) append(reach, whole);
    std::vector<Triangle2> core;
    for (const Polygon& part : core_of(reach, shape.box)) append(part, core);
    shape.whole = Patches(std::move(whole));
    put_in_order(core);
    shape.core = Patches(std::move(core));
    shape.edges = EdgeIndex(edges_of(reach));
    shape.rings.push_back(reach.outer);
    for (const Ring& hole : reach.holes) shape.rings.push_back(hole);
    return shape;
}

}  // namespace popup
