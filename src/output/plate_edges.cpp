#include "output/plate_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/geometry/edge_index.h"

namespace popup {
namespace {

constexpr double kFoldEdgeMm = 0.05;
constexpr double kAlongFold = 0.01;  // sine of the angle between an edge and a fold that it lies on

bool is_along(const Segment& edge, const Segment& fold) {
    const Vec2 along = edge.b - edge.a;
    const Vec2 of_fold = fold.b - fold.a;
    return distance(lerp(edge.a, edge.b, 0.5), fold) < kFoldEdgeMm &&
           std::abs(cross(along, of_fold)) < kAlongFold * length(along) * length(of_fold) + 1e-12;
}

}  // namespace

std::vector<std::vector<Segment>> folds_of_plates(const Assembly& assembly) {
    std::vector<std::vector<Segment>> folds(assembly.plates.size());
    for (const Hinge& hinge : assembly.hinges) {
        if (hinge.glued) continue;
        folds.at(static_cast<std::size_t>(hinge.a)).push_back(hinge.a_line);
        folds.at(static_cast<std::size_t>(hinge.b)).push_back(hinge.b_line);
    }
    return folds;
}

PlateEdges edges_of(const Plate& plate, const std::vector<Segment>& folds) {
    PlateEdges edges;
    // A page may have folds by the thousand, and as many edges.
    const EdgeIndex index({}, folds);
    std::vector<int> near;
    const auto is_fold = [&](const Segment& edge) {
        constexpr Vec2 kReach{kFoldEdgeMm, kFoldEdgeMm};
        const Vec2 middle = lerp(edge.a, edge.b, 0.5);
        index.query({middle - kReach, middle + kReach}, near);
        return std::any_of(near.begin(), near.end(),
                           [&](int number) { return is_along(edge, index[number]); });
    };
    const auto take = [&](const Ring& ring) {
        const auto first = static_cast<std::uint32_t>(edges.points.size());
        const auto count = static_cast<std::uint32_t>(ring.size());
        edges.points.insert(edges.points.end(), ring.begin(), ring.end());
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::array<std::uint32_t, 2> ends{first + i, first + (i + 1) % count};
            const Segment edge{edges.points[ends[0]], edges.points[ends[1]]};
            (is_fold(edge) ? edges.folds : edges.cuts).push_back(ends);
        }
    };
    take(plate.outline.outer);
    for (const Ring& hole : plate.outline.holes) take(hole);
    return edges;
}

}  // namespace popup
