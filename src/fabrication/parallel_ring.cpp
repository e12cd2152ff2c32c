#include "fabrication/parallel_ring.h"

#include <cmath>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/tolerances.h"

namespace popup {
namespace {

// Of the way to where moved edges meet, in |delta|: beyond it a corner of the paper is under 60°.
constexpr double kMostMitre = 2.0;
// The same where edges grow shorter: 1.42 at a right angle.
constexpr double kMostNotch = 1.42;
constexpr double kNearerMm = 3.0 * kGridMm;  // two roundings of corners, and room for one

double on_grid(double value) { return std::round(value * kPerMm) / kPerMm; }

// Where each corner goes.
std::optional<Ring> moved_corners(const Ring& ring, double delta) {
    const std::size_t n = ring.size();
    Ring moved;
    moved.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 in = ring[i] - ring[(i + n - 1) % n];
        const Vec2 out = ring[(i + 1) % n] - ring[i];
        if (!(length(in) > kGridMm) || !(length(out) > kGridMm)) return std::nullopt;
        const Vec2 out_a = right_of(unit(in));
        const Vec2 out_b = right_of(unit(out));
        const double straight = 1.0 + dot(out_a, out_b);  // 2: no turn; 0: turned about
        const bool parts = cross(out_a, out_b) * delta > 0.0;
        const double most = parts ? kMostMitre : kMostNotch;
        // The mitre is √(2 / straight) long.
        if (!(straight * most * most > 2.0)) return std::nullopt;
        const Vec2 to = ring[i] + (delta / straight) * (out_a + out_b);
        moved.push_back({on_grid(to.x), on_grid(to.y)});
    }
    return moved;
}

bool edges_keep_their_way(const Ring& ring, const Ring& moved) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t next = (i + 1) % ring.size();
        if (!(dot(moved[next] - moved[i], ring[next] - ring[i]) > 0.0)) return false;
    }
    return true;
}

bool stays_clear(const Ring& ring, const Ring& moved, double half) {
    std::vector<Segment> edges;
    edges.reserve(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    const EdgeIndex index(std::move(edges));
    const double least = half - kNearerMm;
    const Vec2 reach{least, least};
    std::vector<int> near;
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const Segment edge{moved[i], moved[(i + 1) % moved.size()]};
        Box box;
        box.extend(edge.a);
        box.extend(edge.b);
        index.query({box.min - reach, box.max + reach}, near);
        for (const int number : near) {
            if (distance(edge, index[number]) < least) return false;
        }
    }
    return true;
}

}  // namespace

std::optional<Ring> moved_edge_by_edge(const Ring& ring, double delta) {
    const double half = std::abs(delta);
    if (ring.size() < 3 || !(half > kNearerMm)) return std::nullopt;
    std::optional<Ring> moved = moved_corners(ring, delta);
    if (!moved || !edges_keep_their_way(ring, *moved) || !stays_clear(ring, *moved, half))
        return std::nullopt;
    return moved;
}

}  // namespace popup
