#include "base/geometry/triangulate.h"

// The C interface's shapes are the C++ library's: its triangulation by ear clipping, which that interface
// lacks, costs a tenth of the Delaunay one.
#define USE_UNSTABLE_GEOS_CPP_API
#include <geos/geom/Geometry.h>
#include <geos/triangulate/polygon/PolygonTriangulator.h>
#include <geos_c.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <type_traits>

#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"

namespace popup {
namespace {

// Share of the area by which triangles may miss their polygon, for rounding.
constexpr double kAreaError = 1e-9;
// Of more corners a boolean takes too long: its time grows with the square of a ring's.
constexpr std::size_t kManyCorners = 2000;
// The parts that one of many corners is sliced to: GEOS is quick with few, and they have no long thin
// triangles.
constexpr std::size_t kFewCorners = 50;

using Triangle = std::array<Vec2, 3>;

double twice_area(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

bool before(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

struct GeosContext {
    GEOSContextHandle_t handle = GEOS_init_r();
    GeosContext() = default;
    GeosContext(const GeosContext&) = delete;
    GeosContext& operator=(const GeosContext&) = delete;
    ~GeosContext() { GEOS_finish_r(handle); }
};

struct DestroyGeometry {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
};
using Geometry = std::unique_ptr<GEOSGeometry, DestroyGeometry>;

GEOSGeometry* geos_ring(GEOSContextHandle_t geos, const Ring& ring) {
    static_assert(sizeof(Vec2) == 2 * sizeof(double) && std::is_standard_layout_v<Vec2>);
    Ring closed = ring;
    closed.push_back(ring.front());
    GEOSCoordSequence* points =
        GEOSCoordSeq_copyFromBuffer_r(geos, &closed.front().x, static_cast<unsigned>(closed.size()), 0, 0);
    return points == nullptr ? nullptr : GEOSGeom_createLinearRing_r(geos, points);
}

Geometry geos_polygon(GEOSContextHandle_t geos, const Polygon& polygon) {
    std::vector<GEOSGeometry*> holes;
    for (const Ring& hole : polygon.holes) {
        if (hole.size() < 3) continue;
        GEOSGeometry* ring = geos_ring(geos, hole);
        if (ring != nullptr) holes.push_back(ring);
    }
    GEOSGeometry* shell = geos_ring(geos, polygon.outer);
    if (shell == nullptr) {
        for (GEOSGeometry* hole : holes) GEOSGeom_destroy_r(geos, hole);
        return Geometry(nullptr, {geos});
    }
    return Geometry(GEOSGeom_createPolygon_r(geos, shell, holes.data(), static_cast<unsigned>(holes.size())),
                    {geos});
}

// Appends GEOS's triangles of a valid geometry, counter-clockwise. False when GEOS gives up.
bool append_triangles(GEOSContextHandle_t geos, const GEOSGeometry* valid, std::vector<Triangle>& triangles) {
    Geometry all(nullptr, {geos});
    try {
        const auto* shape = reinterpret_cast<const geos::geom::Geometry*>(valid);
        auto parts = geos::triangulate::polygon::PolygonTriangulator::triangulate(shape);
        all.reset(reinterpret_cast<GEOSGeometry*>(parts.release()));
    } catch (const std::exception&) {
        return false;
    }
    if (!all) return false;
    const int count = GEOSGetNumGeometries_r(geos, all.get());
    for (int i = 0; i < count; ++i) {
        const GEOSGeometry* one = GEOSGetGeometryN_r(geos, all.get(), i);
        const GEOSCoordSequence* points = GEOSGeom_getCoordSeq_r(geos, GEOSGetExteriorRing_r(geos, one));
        std::array<Vec2, 4> corners;
        unsigned size = 0;
        if (points == nullptr || GEOSCoordSeq_getSize_r(geos, points, &size) == 0 || size != corners.size() ||
            GEOSCoordSeq_copyToBuffer_r(geos, points, &corners.front().x, 0, 0) == 0) {
            return false;
        }
        const double area = twice_area(corners[0], corners[1], corners[2]);
        if (area > 0.0) triangles.push_back({corners[0], corners[1], corners[2]});
        if (area < 0.0) triangles.push_back({corners[0], corners[2], corners[1]});
    }
    return true;
}

// The triangles of one polygon, or nothing when they do not add up to it.
std::optional<std::vector<Triangle>> by_geos(GEOSContextHandle_t geos, const Polygon& polygon) {
    Geometry shape = geos_polygon(geos, polygon);
    if (!shape) return std::nullopt;
    // Rings that touch themselves along an edge or in a point are not valid as they stand.
    if (GEOSisValid_r(geos, shape.get()) != 1) {
        shape.reset(GEOSMakeValid_r(geos, shape.get()));
        if (!shape) return std::nullopt;
    }
    std::vector<Triangle> triangles;
    if (!append_triangles(geos, shape.get(), triangles)) return std::nullopt;
    double covered = 0.0;
    for (const Triangle& t : triangles) covered += 0.5 * twice_area(t[0], t[1], t[2]);
    const double wanted = area(polygon);
    const Box box = bounds(polygon.outer);
    if (std::abs(covered - wanted) > kAreaError * (wanted + box.width() * box.height())) return std::nullopt;
    return triangles;
}

bool is_convex(const Polygon& polygon) {
    if (!polygon.holes.empty()) return false;
    const Ring& ring = polygon.outer;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (twice_area(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]) < 0.0) return false;
        // Seen from the first corner the others must come one after the other: no ring that goes round twice.
        if (i + 1 < n && twice_area(ring[0], ring[i], ring[i + 1]) < 0.0) return false;
    }
    return true;
}

Triangulation fan(const Ring& ring) {
    // Corners on a straight edge would make triangles without an area.
    Triangulation result;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (twice_area(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]) > 0.0)
            result.points.push_back(ring[i]);
    }
    for (std::uint32_t i = 2; i < result.points.size(); ++i) result.triangles.push_back({0, i - 1, i});
    return result;
}

std::size_t corners_of(const Polygon& polygon) {
    std::size_t count = polygon.outer.size();
    for (const Ring& hole : polygon.holes) count += hole.size();
    return count;
}

// A line across the box at the middle one of the polygon's corners, and how many edges it cuts.
struct Cut {
    double at = 0.0;
    std::size_t crossed = 0;
};
Cut middle_cut(const Polygon& polygon, double Vec2::*axis, double low, double high) {
    std::vector<double> values;
    values.reserve(corners_of(polygon));
    const auto each_ring = [&polygon](const auto& visit) {
        visit(polygon.outer);
        for (const Ring& hole : polygon.holes) visit(hole);
    };
    each_ring([&](const Ring& ring) {
        for (const Vec2& p : ring) values.push_back(p.*axis);
    });
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    Cut cut{*middle, 0};
    if (cut.at <= low || cut.at >= high) cut.at = 0.5 * (low + high);
    each_ring([&](const Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const double a = ring[i].*axis - cut.at;
            const double b = ring[(i + 1) % ring.size()].*axis - cut.at;
            if (a * b < 0.0) ++cut.crossed;
        }
    });
    return cut;
}

// Appends the two parts of a polygon on either side of an upright or level line, whichever cuts less. `many`:
// slice it if that can be done.
void halve(const Polygon& polygon, const Box& box, bool many, std::vector<Polygon>& parts) {
    const Cut upright = middle_cut(polygon, &Vec2::x, box.min.x, box.max.x);
    const Cut level = middle_cut(polygon, &Vec2::y, box.min.y, box.max.y);
    // A thin strip is cut across: along it a cut gains little and may fall on its own edge.
    const bool use_upright =
        box.height() <= 4.0 * kGridMm || (box.width() > 4.0 * kGridMm && upright.crossed <= level.crossed);
    if (many) {
        std::vector<Polygon> sliced = slice(polygon, use_upright);
        if (!sliced.empty()) {
            std::move(sliced.begin(), sliced.end(), std::back_inserter(parts));
            return;
        }
    }
    for (const bool second : {false, true}) {
        Box half{{box.min.x - 1.0, box.min.y - 1.0}, {box.max.x + 1.0, box.max.y + 1.0}};
        double& side = use_upright ? (second ? half.min.x : half.max.x) : (second ? half.min.y : half.max.y);
        side = use_upright ? upright.at : level.at;
        Polygon window;
        window.outer = {half.min, {half.max.x, half.min.y}, half.max, {half.min.x, half.max.y}};
        for (Polygon& part : intersect({polygon}, {window})) parts.push_back(std::move(part));
    }
}

Triangulation indexed(const std::vector<Triangle>& triangles) {
    Triangulation result;
    for (const Triangle& t : triangles) result.points.insert(result.points.end(), t.begin(), t.end());
    std::sort(result.points.begin(), result.points.end(), before);
    result.points.erase(std::unique(result.points.begin(), result.points.end()), result.points.end());
    for (const Triangle& t : triangles) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = std::lower_bound(result.points.begin(), result.points.end(), t.at(i), before);
            corners.at(i) = static_cast<std::uint32_t>(at - result.points.begin());
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        result.triangles.push_back(corners);
    }
    // GEOS makes no promise about its order.
    std::sort(result.triangles.begin(), result.triangles.end());
    return result;
}

}  // namespace

Triangulation triangulate(const Polygon& polygon, std::size_t uncut) {
    if (polygon.outer.size() < 3) return {};
    if (is_convex(polygon)) return fan(polygon.outer);

    const bool many = corners_of(polygon) > std::max(kManyCorners, uncut);
    if (many) uncut = std::min(uncut, kFewCorners);
    const GeosContext geos;
    std::vector<Triangle> triangles;
    std::vector<Polygon> pending{polygon};
    while (!pending.empty()) {
        const Polygon part = std::move(pending.back());
        pending.pop_back();
        if (is_convex(part)) {
            const Triangulation some = fan(part.outer);
            for (const auto& t : some.triangles) {
                triangles.push_back({some.points[t[0]], some.points[t[1]], some.points[t[2]]});
            }
            continue;
        }
        if (corners_of(part) <= uncut) {
            if (const auto some = by_geos(geos.handle, part)) {
                triangles.insert(triangles.end(), some->begin(), some->end());
                continue;
            }
        }
        const Box box = bounds(part.outer);
        if (std::max(box.width(), box.height()) > kSpeckMm) halve(part, box, many, pending);
    }
    return indexed(triangles);
}

}  // namespace popup
