#include "mechanism/thin_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/tolerances.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

// The edges of areas by their rings.
struct Rings {
    std::vector<Segment> edges;
    std::vector<std::size_t> ring;                           // of each edge
    std::vector<std::pair<std::size_t, std::size_t>> range;  // of each ring, its first edge and the one past
    std::vector<double> swept;  // of each edge: twice the area swept by the ring's edges before it

    void add(const Ring& points) {
        const std::size_t first = edges.size();
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Segment edge{points[i], points[i + 1 == points.size() ? 0 : i + 1]};
            edges.push_back(edge);
            ring.push_back(range.size());
            swept.push_back(sum);
            sum += cross(edge.a - points.front(), edge.b - points.front());
        }
        range.emplace_back(first, edges.size());
        whole.push_back(sum);
    }
    void add(const Polygon& polygon) {
        add(polygon.outer);
        for (const Ring& hole : polygon.holes) add(hole);
    }
    [[nodiscard]] bool neighbours(std::size_t i, std::size_t j) const {
        if (ring[i] != ring[j]) return false;
        const auto [first, past] = range[ring[i]];
        return j == i + 1 || (i == first && j + 1 == past);
    }
    // What the line from p on edge i to q on a later edge j of the same ring parts: along the ring from p to
    // q and straight back, and the rest. mm², by the ring's direction.
    [[nodiscard]] std::pair<double, double> parted(std::size_t i, Vec2 p, std::size_t j, Vec2 q) const {
        const Vec2 origin = edges[range[ring[i]].first].a;
        const auto turn = [&](Vec2 a, Vec2 b) { return cross(a - origin, b - origin); };
        const double to_p = swept[i] + turn(edges[i].a, p);
        const double to_q = swept[j] + turn(edges[j].a, q);
        const double one = to_q - to_p + turn(q, p);
        return {0.5 * one, 0.5 * (whole[ring[i]] - one)};
    }
    std::vector<double> whole;  // of each ring: twice its area
};

Vec2 nearest_on(const Segment& s, Vec2 p) {
    const Vec2 way = s.b - s.a;
    const double size = dot(way, way);
    return size == 0.0 ? s.a : lerp(s.a, s.b, std::clamp(dot(way, p - s.a) / size, 0.0, 1.0));
}

// Pairs of edges that are no neighbours and whose boxes come nearer than `within`, the lower number first;
// ends where `visit` says true.
template <typename Visit>
void near_pairs(const Rings& rings, double within, const Visit& visit) {
    const EdgeIndex index({}, rings.edges);
    std::vector<int> found;
    for (std::size_t i = 0; i < rings.edges.size(); ++i) {
        Box box;
        box.extend(rings.edges[i].a);
        box.extend(rings.edges[i].b);
        box.min = box.min - Vec2{within, within};
        box.max = box.max + Vec2{within, within};
        found.clear();
        index.query(box, found);
        for (const int number : found) {
            const auto j = static_cast<std::size_t>(number);
            if (j <= i || rings.neighbours(i, j)) continue;
            if (visit(i, j)) return;
        }
    }
}

}  // namespace

bool touching(const std::vector<Polygon>& areas) {
    Rings rings;
    for (const Polygon& one : areas) rings.add(one);
    bool found = false;
    near_pairs(rings, kOnGridLineMm, [&](std::size_t i, std::size_t j) {
        found = distance(rings.edges[i], rings.edges[j]) <= kOnGridLineMm;
        return found;
    });
    return found;
}

std::array<std::pair<Vec2, Vec2>, 4> end_spots(const Segment& one, const Segment& two) {
    return {{{one.a, nearest_on(two, one.a)},
             {one.b, nearest_on(two, one.b)},
             {nearest_on(one, two.a), two.a},
             {nearest_on(one, two.b), two.b}}};
}

std::optional<NarrowPlace> thinnest(const Polygon& piece, double below) {
    Rings rings;
    rings.add(piece);
    std::optional<NarrowPlace> best;
    near_pairs(rings, below, [&](std::size_t i, std::size_t j) {
        const Segment& one = rings.edges[i];
        const Segment& two = rings.edges[j];
        const bool at_hole = rings.ring[i] != rings.ring[j];
        for (const auto& [p, q] : end_spots(one, two)) {
            const double width = distance(p, q);
            if (width >= below || (best && width >= best->width_mm)) continue;
            if (!at_hole) {
                const auto [before, behind] = rings.parted(i, p, j, q);
                // Across paper both parts of an outer ring are paper, and one of a hole's: a tongue in it.
                const double least = rings.ring[i] == 0 ? std::min(before, behind) : std::max(before, behind);
                if (least < kLeastPaperMm2) continue;  // the tip of a corner
            }
            best = NarrowPlace{lerp(p, q, 0.5), width, at_hole};
        }
        return false;
    });
    return best;
}

namespace {

std::string thin_mm(double width_mm) {
    return width_mm < 0.01 ? fmt::format("{:.4f} mm", width_mm) : mm(width_mm);
}

}  // namespace

void tell_thin(Element& e, const Polygon& piece) {
    const auto thin = thinnest(piece, kTearsMm);
    if (!thin) return;
    const std::string width = thin_mm(thin->width_mm);
    e.warned("paper-too-thin",
             thin->at_hole ? fmt::format("only {} of paper is left beside a hole at {}; below {} it tears",
                                         width, at_mm(thin->at), mm(kTearsMm))
                           : fmt::format("its parts hang together by a neck of {} at {}; below {} it tears",
                                         width, at_mm(thin->at), mm(kTearsMm)),
             thin->at_hole ? "move the hole away from the edge, or let it open to the edge"
                           : "draw it wider there");
}

void tell_thin_between_holes(Element& e, Vec2 at, double width_mm) {
    e.warned("paper-too-thin",
             fmt::format("only {} of paper is left between it and another hole, at {}; below {} it tears",
                         thin_mm(width_mm), at_mm(at), mm(kTearsMm)),
             "move the two apart, or let one open to the other");
}

}  // namespace popup
