#include "support/brute_mesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <geos_c.h>

#include <algorithm>
#include <cmath>

#include "popup/diagnostics.h"

namespace popup::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;
using Face = Delaunay::Face_handle;

// Chords to a quarter circle where a shrunk outline goes round a corner: within 2 % of the circle.
constexpr int kQuarterChords = 4;

// Frees what GEOS makes, and aborts where it fails: a checker must not go on without a plate.
class Geos {
 public:
    Geos() : handle_(GEOS_init_r()) { POPUP_INVARIANT(handle_ != nullptr); }
    ~Geos() { GEOS_finish_r(handle_); }
    Geos(const Geos&) = delete;
    Geos& operator=(const Geos&) = delete;

    // All points further than `by` inside the polygon's edges, as polygons.
    [[nodiscard]] std::vector<Polygon> shrunk(const Polygon& polygon, double by) const {
        std::vector<GEOSGeometry*> holes;
        for (const Ring& hole : polygon.holes) holes.push_back(ring(hole));
        GEOSGeometry* whole = GEOSGeom_createPolygon_r(handle_, ring(polygon.outer), holes.data(),
                                                       static_cast<unsigned>(holes.size()));
        POPUP_INVARIANT(whole != nullptr);
        GEOSGeometry* inner = GEOSBufferWithStyle_r(handle_, whole, -by, kQuarterChords, GEOSBUF_CAP_ROUND,
                                                    GEOSBUF_JOIN_ROUND, 0.0);
        POPUP_INVARIANT(inner != nullptr);
        std::vector<Polygon> parts;
        for (int i = 0; i < GEOSGetNumGeometries_r(handle_, inner); ++i) {
            const GEOSGeometry* part = GEOSGetGeometryN_r(handle_, inner, i);
            if (GEOSisEmpty_r(handle_, part) != 0) continue;
            Polygon& made = parts.emplace_back();
            made.outer = points(GEOSGetExteriorRing_r(handle_, part));
            for (int k = 0; k < GEOSGetNumInteriorRings_r(handle_, part); ++k) {
                made.holes.push_back(points(GEOSGetInteriorRingN_r(handle_, part, k)));
            }
        }
        GEOSGeom_destroy_r(handle_, inner);
        GEOSGeom_destroy_r(handle_, whole);
        return parts;
    }

 private:
    [[nodiscard]] GEOSGeometry* ring(Ring points) const {
        points.push_back(points.front());
        auto* sequence =
            GEOSCoordSeq_copyFromBuffer_r(handle_, &points[0].x, static_cast<unsigned>(points.size()), 0, 0);
        GEOSGeometry* made = sequence ? GEOSGeom_createLinearRing_r(handle_, sequence) : nullptr;
        POPUP_INVARIANT(made != nullptr);
        return made;
    }
    [[nodiscard]] Ring points(const GEOSGeometry* ring) const {
        const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(handle_, ring);
        unsigned size = 0;
        POPUP_INVARIANT(sequence != nullptr && GEOSCoordSeq_getSize_r(handle_, sequence, &size) != 0);
        Ring result(size);
        POPUP_INVARIANT(GEOSCoordSeq_copyToBuffer_r(handle_, sequence, &result[0].x, 0, 0) != 0);
        result.pop_back();
        return result;
    }
    GEOSContextHandle_t handle_;
};

// By the even-odd rule over all rings.
bool inside(const std::vector<const Ring*>& rings, Vec2 p) {
    bool in = false;
    for (const Ring* ring : rings) {
        for (std::size_t i = 0, j = ring->size() - 1; i < ring->size(); j = i++) {
            const Vec2 a = (*ring)[i];
            const Vec2 b = (*ring)[j];
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
        }
    }
    return in;
}

enum : int { kUnseen, kSeen };  // of faces

double area_of(const Delaunay& delaunay, Face face) {
    return delaunay.is_infinite(face) ? 0.0 : delaunay.triangle(face).area();
}

Vec2 middle_of(Face face) {
    const auto at = [&](int i) { return face->vertex(i)->point() - CGAL::ORIGIN; };
    const Kernel::Vector_2 sum = at(0) + at(1) + at(2);
    return {sum.x() / 3.0, sum.y() / 3.0};
}

// All faces that can be reached from one without going over an edge of the outline; they lie on one side of
// it. Those without an area, whose middle tells nothing, come with their neighbours.
std::vector<Face> between_edges(const Delaunay& delaunay, Face from) {
    std::vector<Face> part{from};
    from->info() = kSeen;
    for (std::size_t n = 0; n < part.size(); ++n) {
        for (int i = 0; i < 3; ++i) {
            const Face next = part[n]->neighbor(i);
            if (next->info() != kUnseen || delaunay.is_constrained({part[n], i})) continue;
            next->info() = kSeen;
            part.push_back(next);
        }
    }
    return part;
}

}  // namespace

std::vector<Polygon> shrunk(const Polygon& polygon, double by) {
    const Geos geos;
    return geos.shrunk(polygon, by);
}

Mesh triangulated(const std::vector<Polygon>& polygons) {
    std::vector<const Ring*> rings;
    double wanted = 0.0;  // mm²
    for (const Polygon& polygon : polygons) {
        wanted += area(polygon);
        rings.push_back(&polygon.outer);
        for (const Ring& hole : polygon.holes) rings.push_back(&hole);
    }
    Delaunay delaunay;
    for (const Ring* ring : rings) {
        for (std::size_t i = 0, j = ring->size() - 1; i < ring->size(); j = i++) {
            const Kernel::Point_2 a((*ring)[j].x, (*ring)[j].y);
            const Kernel::Point_2 b((*ring)[i].x, (*ring)[i].y);
            if (a != b) delaunay.insert_constraint(a, b);
        }
    }
    Mesh mesh;
    for (const auto vertex : delaunay.finite_vertex_handles()) {
        vertex->info() = static_cast<int>(mesh.points.size());
        mesh.points.push_back({vertex->point().x(), vertex->point().y()});
    }
    double covered = 0.0;
    std::vector<Face> kept;
    for (const auto face : delaunay.all_face_handles()) face->info() = kUnseen;
    for (const auto face : delaunay.finite_face_handles()) {
        if (face->info() != kUnseen) continue;
        const std::vector<Face> part = between_edges(delaunay, face);
        const auto largest = std::max_element(part.begin(), part.end(), [&](Face a, Face b) {
            return area_of(delaunay, a) < area_of(delaunay, b);
        });
        const bool in = inside(rings, middle_of(*largest));
        for (const Face f : part) {
            if (!in || delaunay.is_infinite(f)) continue;
            kept.push_back(f);
            covered += area_of(delaunay, f);
        }
    }
    POPUP_INVARIANT(std::abs(covered - wanted) <= 1e-6 * (1.0 + wanted));
    for (const Face face : kept) {
        auto& corners = mesh.corners.emplace_back();
        double longest = 0.0;
        for (int i = 0; i < 3; ++i) {
            corners[static_cast<std::size_t>(i)] = face->vertex(i)->info();
            longest = std::max(longest, std::sqrt(delaunay.segment(face, i).squared_length()));
        }
        mesh.sliver.push_back(2.0 * area_of(delaunay, face) < kSliverMm * longest);
    }
    return mesh;
}

}  // namespace popup::test
