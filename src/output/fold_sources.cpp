#include "output/fold_sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/triangulate.h"
#include "base/nth.h"

namespace popup {
namespace {

// Of folds of which neither their line nor their pattern says how far they go.
constexpr double kUnsaidDeg = 90.0;
constexpr double kNearSourceMm = 0.5;
constexpr double kNearSourceShare = 1.0 / 400.0;
// Distances that differ by less are equal, mm.
constexpr double kEqualMm = 1e-5;
// Most corners are where they were.
constexpr double kNextMm = 1e-3;
constexpr std::size_t kMostAround = 200;

class Finder {
 public:
    Finder(const FoldMesh& mesh, const CarriedKeys& carried) : mesh_(mesh), from_(carried) {
        Box box;
        for (const Vec2 p : from_.corners) box.extend(p);
        far_ = std::max(kNearSourceMm, kNearSourceShare * std::max(box.width(), box.height()));
    }

    FoldSources run() {
        find_faces();
        find_vertices();
        find_edges();
        return std::move(out_);
    }

 private:
    [[nodiscard]] Vec2 corner(int number) const { return nth(from_.corners, number); }

    [[nodiscard]] Polygon face(int number) const {
        Polygon polygon;
        for (const int one : nth(from_.face_corners, number)) polygon.outer.push_back(corner(one));
        return polygon;
    }

    void find_faces() {
        out_.faces.assign(mesh_.face_plate.size(), -1);
        if (from_.face_corners.empty()) return;
        std::vector<Segment> diagonals;
        for (const std::vector<int>& ring : from_.face_corners) {
            Box box;
            for (const int one : ring) box.extend(corner(one));
            diagonals.push_back(box.empty() ? Segment{} : Segment{box.min, box.max});
        }
        const EdgeIndex boxes({}, diagonals);
        std::vector<int> found;
        for (std::size_t f = 0; f < out_.faces.size(); ++f) {
            const std::optional<Vec2> middle = middle_of(f);
            if (!middle) continue;
            boxes.query({*middle, *middle}, found);
            const auto holds = [&](int number) { return contains(face(number), *middle); };
            // Faces of a file may all lie on one another; then only the first are looked at.
            const auto last =
                found.begin() + static_cast<std::ptrdiff_t>(std::min(found.size(), kMostAround));
            const auto first = std::find_if(found.begin(), last, holds);
            if (first != last) out_.faces[f] = *first;
        }
    }

    // The middle of the face's largest triangle.
    [[nodiscard]] std::optional<Vec2> middle_of(std::size_t f) const {
        Polygon polygon;
        for (std::size_t i = mesh_.first[f]; i < mesh_.first[f + 1]; ++i)
            polygon.outer.push_back(mesh_.place(static_cast<int>(i)));
        const Triangulation cut = triangulate(polygon);
        double largest = 0.0;
        std::optional<Vec2> middle;
        for (const auto& t : cut.triangles) {
            const Vec2 a = cut.points[t[0]];
            const Vec2 b = cut.points[t[1]];
            const Vec2 c = cut.points[t[2]];
            const double size = cross(b - a, c - a);
            // Of equal ones up to rounding the first counts.
            if (size <= largest * (1.0 + 1e-9)) continue;
            largest = size;
            middle = 1.0 / 3.0 * (a + b + c);
        }
        return middle;
    }

    // Whether the file's face that the mesh's corner belongs to has all these corners.
    [[nodiscard]] bool in_own_face(int mesh_corner, std::span<const int> corners) const {
        const int source = nth(out_.faces, nth(mesh_.face, mesh_corner));
        if (source < 0) return false;
        const std::vector<int>& ring = nth(from_.face_corners, source);
        return std::all_of(corners.begin(), corners.end(),
                           [&](int one) { return std::find(ring.begin(), ring.end(), one) != ring.end(); });
    }

    // Of those found the one with the least distance, and among equals that of the own face, then the first.
    template <typename DistanceTo, typename CornersOf>
    [[nodiscard]] int nearest(const std::vector<int>& found, int mesh_corner, const DistanceTo& distance_to,
                              const CornersOf& corners_of) const {
        double least = std::numeric_limits<double>::infinity();
        for (const int one : found) least = std::min(least, distance_to(one));
        int best = -1;
        for (const int one : found) {
            if (distance_to(one) > std::min(least + kEqualMm, far_)) continue;
            if (best < 0) {
                best = one;  // mostly the only one: then no ring is walked
                continue;
            }
            if (in_own_face(mesh_corner, corners_of(best))) return best;
            if (in_own_face(mesh_corner, corners_of(one))) best = one;
        }
        return best;
    }

    // What `fits` of what lies around a point: next to it, or else as far as corners are moved.
    template <typename Fits>
    void query(const EdgeIndex& index, Vec2 p, const Fits& fits, std::vector<int>& found) const {
        for (const double reach : {kNextMm, far_}) {
            const Vec2 margin{reach, reach};
            index.query({p - margin, p + margin}, found);
            std::erase_if(found, [&](int one) { return !fits(one); });
            if (!found.empty()) return;
        }
    }

    void find_vertices() {
        std::vector<Segment> points;
        for (const Vec2 p : from_.corners) points.push_back({p, p});
        const EdgeIndex index({}, points);
        std::vector<int> found;
        for (const int at : mesh_.vertex_corner) {
            const Vec2 p = mesh_.place(at);
            query(
                index, p, [](int) { return true; }, found);
            const auto distance_to = [&](int one) { return distance(corner(one), p); };
            const auto corners_of = [](int one) { return std::array{one}; };
            out_.vertices.push_back(nearest(found, at, distance_to, corners_of));
        }
    }

    void find_edges() {
        std::vector<Segment> segments;
        for (const auto& ends : from_.edge_corners) segments.push_back({corner(ends[0]), corner(ends[1])});
        const EdgeIndex index({}, segments);
        std::vector<int> found;
        for (const int side : mesh_.edge_side) {
            const Vec2 a = mesh_.place(side);
            const Vec2 b = mesh_.place(mesh_.next(side));
            const Vec2 middle = 0.5 * (a + b);
            const auto lies_on = [&](int one) {
                return std::max(distance(a, nth(segments, one)), distance(b, nth(segments, one))) <= far_;
            };
            query(index, middle, lies_on, found);
            const auto distance_to = [&](int one) { return distance(middle, nth(segments, one)); };
            const auto corners_of = [this](int one) { return nth(from_.edge_corners, one); };
            out_.edges.push_back(nearest(found, side, distance_to, corners_of));
        }
    }

    const FoldMesh& mesh_;
    const CarriedKeys& from_;
    double far_ = kNearSourceMm;
    FoldSources out_;
};

}  // namespace

FoldSources fold_sources(const FoldMesh& mesh, const CarriedKeys& carried) {
    return Finder(mesh, carried).run();
}

std::optional<std::vector<std::array<int, 3>>> face_orders(const FoldMesh& mesh, const CarriedKeys& carried,
                                                           const FoldSources& sources,
                                                           std::string_view json) {
    const std::size_t count = carried.face_corners.size();
    if (mesh.face_plate.size() != count) return std::nullopt;
    std::vector<int> face_of(count, -1);  // by face of the file
    for (std::size_t f = 0; f < count; ++f) {
        const int source = sources.faces[f];
        if (source < 0 || nth(face_of, source) >= 0) return std::nullopt;
        nth(face_of, source) = static_cast<int>(f);
    }
    std::vector<std::array<int, 3>> orders;
    for (const auto& order : nlohmann::json::parse(json)) {
        const int above = order[0].get<int>();
        const int below = order[1].get<int>();
        Ring ring;
        for (const int corner : nth(carried.face_corners, below))
            ring.push_back(nth(carried.corners, corner));
        // Faces of the mesh are counter-clockwise.
        const int side = order[2].get<int>();
        orders.push_back({nth(face_of, above), nth(face_of, below), signed_area(ring) < 0.0 ? -side : side});
    }
    return orders;
}

std::vector<std::string> own_words(const CarriedKeys& carried, std::string_view key) {
    std::vector<std::string> words;
    for (const CarriedKeys::Member& member : carried.members) {
        if (member.key != key) continue;
        for (const auto& word : nlohmann::json::parse(member.json)) {
            if (word.is_string() && word.get<std::string>().find(':') != std::string::npos)
                words.push_back(word.get<std::string>());
        }
    }
    return words;
}

std::vector<double> asked_angles(const FoldMesh& mesh, const CreasePattern& creases) {
    // The lines as the edges of a file.
    CarriedKeys lines;
    std::vector<double> asked;
    for (const CreaseLine& line : creases.lines) {
        const bool folds = line.use != CreaseUse::cut && line.use != CreaseUse::flat;
        const double unsaid = line.use == CreaseUse::fold ? kUnsaidDeg : creases.fold_deg;
        const double deg = folds ? line.fold_deg.value_or(unsaid) : 0.0;
        const std::size_t count = line.points.size();
        for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i) {
            const int first = static_cast<int>(lines.corners.size());
            lines.corners.push_back(line.points[i]);
            lines.corners.push_back(line.points[(i + 1) % count]);
            lines.edge_corners.push_back({first, first + 1});
            asked.push_back(deg);
        }
    }
    std::vector<double> result;
    for (const int source : fold_sources(mesh, lines).edges)
        result.push_back(source < 0 ? 0.0 : nth(asked, source));
    return result;
}

}  // namespace popup
