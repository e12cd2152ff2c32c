// Rings that neither cross nor touch each other or themselves: what they enclose is known without clipping. A
// clipper looks at every edge that is level with each corner; a sweep looks at the two beside it. So a
// drawing of many corners, almost always simple, costs n log n however many of its edges lie above each
// other.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/geometry/regions.h"

namespace popup {
namespace {

__extension__ using Wide = __int128;

bool before(const RingCorner& a, const RingCorner& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// On which side of a→b c lies: 1 on the left, -1 on the right, 0 on the line.
int side(const RingCorner& a, const RingCorner& b, const RingCorner& c) {
    const Wide turn = static_cast<Wide>(b.x - a.x) * (c.y - a.y) - static_cast<Wide>(b.y - a.y) * (c.x - a.x);
    return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

struct Edge {
    RingCorner left, right;  // the first end in the order of the sweep, and the last
    bool filled_above = false;
};

class Sweep {
 public:
    explicit Sweep(const std::vector<CornerRing>& rings) : rings_(rings), status_(Below{this}) {}

    std::optional<std::vector<bool>> run() {
        std::vector<Corner> corners;
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            const CornerRing& ring = rings_[r];
            const std::size_t first = edges_.size();
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const RingCorner& to = ring[i + 1 == ring.size() ? 0 : i + 1];
                const bool forward = before(ring[i], to);
                edges_.push_back({forward ? ring[i] : to, forward ? to : ring[i], false});
                corners.push_back({ring[i], r, i == 0 ? first + ring.size() - 1 : first + i - 1, first + i});
            }
        }
        std::sort(corners.begin(), corners.end(),
                  [](const Corner& a, const Corner& b) { return before(a.at, b.at); });
        for (std::size_t i = 1; i < corners.size(); ++i) {
            if (corners[i - 1].at == corners[i].at) return std::nullopt;
        }
        places_.assign(edges_.size(), status_.end());
        std::vector<bool> seen(rings_.size(), false);
        std::vector<bool> holes(rings_.size(), false);
        for (const Corner& corner : corners) {
            const bool begins = edges_[corner.in].left == corner.at;
            const bool other_begins = edges_[corner.out].left == corner.at;
            if (begins && other_begins) {
                const bool inside = open(corner.in, corner.out);
                if (!seen[corner.ring]) holes[corner.ring] = inside;
                seen[corner.ring] = true;
            } else if (begins || other_begins) {
                go_on(begins ? corner.out : corner.in, begins ? corner.in : corner.out);
            } else {
                close(corner.in, corner.out);
            }
            if (touched_) return std::nullopt;
        }
        return holes;
    }

 private:
    struct Corner {
        RingCorner at;
        std::size_t ring, in, out;  // the edges that lead to it and from it
    };
    // The order of edges from below where the sweep is.
    struct Below {
        Sweep* sweep;
        bool operator()(std::size_t a, std::size_t b) const { return sweep->below(a, b); }
    };
    using Status = std::set<std::size_t, Below>;
    using Place = Status::iterator;

    bool below(std::size_t a, std::size_t b) {
        if (a == b) return false;
        const Edge& one = edges_[a];
        const Edge& other = edges_[b];
        if (before(one.left, other.left)) return !lies_below(other, one);
        return lies_below(one, other);
    }
    // Whether what begins later, or in the same corner, lies below the other.
    bool lies_below(const Edge& later, const Edge& earlier) {
        const bool same = later.left == earlier.left;
        const int where = side(earlier.left, earlier.right, same ? later.right : later.left);
        touched_ = touched_ || where == 0;
        return where < 0;
    }

    void meet(Place a, Place b) {
        const Edge& one = edges_[*a];
        const Edge& other = edges_[*b];
        // Neighbours share a corner and nothing else: they are in no line, and what begins at one place was
        // compared.
        if (one.left == other.left) return;
        if (one.right == other.right) {
            touched_ = touched_ || side(one.left, one.right, other.left) == 0;
            return;
        }
        const bool apart =
            side(one.left, one.right, other.left) * side(one.left, one.right, other.right) > 0 ||
            side(other.left, other.right, one.left) * side(other.left, other.right, one.right) > 0;
        touched_ = touched_ || !apart;
    }
    void meet_neighbours(Place at) {
        if (at != status_.begin()) meet(std::prev(at), at);
        if (std::next(at) != status_.end()) meet(at, std::next(at));
    }

    // Whether the ring's first corner lies in what others enclose.
    bool open(std::size_t a, std::size_t b) {
        const Place one = status_.insert(a).first;
        const Place other = status_.insert(b).first;
        places_[a] = one;
        places_[b] = other;
        if (touched_) return false;
        const bool first_is_lower = below(a, b);
        const Place lower = first_is_lower ? one : other;
        const bool inside = lower != status_.begin() && edges_[*std::prev(lower)].filled_above;
        edges_[*lower].filled_above = !inside;
        edges_[first_is_lower ? b : a].filled_above = inside;
        meet_neighbours(one);
        meet_neighbours(other);
        return inside;
    }
    void go_on(std::size_t from, std::size_t to) {
        edges_[to].filled_above = edges_[from].filled_above;
        const Place behind = status_.erase(places_[from]);
        places_[to] = status_.insert(behind, to);
        if (!touched_) meet_neighbours(places_[to]);
    }
    void close(std::size_t a, std::size_t b) {
        status_.erase(places_[a]);
        const Place behind = status_.erase(places_[b]);
        if (behind != status_.begin() && behind != status_.end()) meet(std::prev(behind), behind);
    }

    const std::vector<CornerRing>& rings_;
    std::vector<Edge> edges_;
    Status status_;
    std::vector<Place> places_;
    bool touched_ = false;
};

}  // namespace

CornerRing without_straight_corners(const CornerRing& ring) {
    CornerRing made;
    const auto straight = [](const RingCorner& a, const RingCorner& b, const RingCorner& c) {
        if (side(a, b, c) != 0) return false;
        return static_cast<Wide>(b.x - a.x) * (c.x - b.x) + static_cast<Wide>(b.y - a.y) * (c.y - b.y) >= 0;
    };
    for (const RingCorner& p : ring) {
        if (!made.empty() && made.back() == p) continue;
        while (made.size() >= 2 && straight(made[made.size() - 2], made.back(), p)) made.pop_back();
        made.push_back(p);
    }
    while (made.size() > 1 && made.back() == made.front()) made.pop_back();
    while (made.size() >= 3 && straight(made[made.size() - 2], made.back(), made.front())) made.pop_back();
    std::size_t first = 0;
    while (made.size() - first >= 3 && straight(made.back(), made[first], made[first + 1])) ++first;
    made.erase(made.begin(), made.begin() + static_cast<std::ptrdiff_t>(first));
    if (made.size() < 3) made.clear();
    return made;
}

std::optional<std::vector<bool>> holes_of_simple_rings(const std::vector<CornerRing>& rings) {
    return Sweep(rings).run();
}

}  // namespace popup
