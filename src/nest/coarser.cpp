#include "nest/coarser.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "base/nth.h"

namespace popup {
namespace {

double square_of(GridPoint a) {
    return static_cast<double>(a.x) * static_cast<double>(a.x) +
           static_cast<double>(a.y) * static_cast<double>(a.y);
}

int side_of(GridPoint a, GridPoint b, GridPoint c) {
    const Wide value = cross(b - a, c - a);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

// Corners by where they are: cells of a grid with a few corners each.
class CornerGrid {
 public:
    // A cell is as wide as so many edges are long, on average: a few edges later most are much longer. It is
    // no wider than what holds a few corners where they are spread evenly: notches have long edges, and their
    // corners close together.
    CornerGrid(double perimeter, const GridBox& box, std::size_t corners) {
        constexpr double kEdges = 16.0;
        constexpr double kSpread = 2.0;
        const auto count = static_cast<double>(corners + 1);
        const double area = static_cast<double>(box.x1 - box.x0) * static_cast<double>(box.y1 - box.y0);
        const double size = std::min(kEdges * perimeter / count, kSpread * std::sqrt(area / count));
        size_ = std::max<GridLength>(1, std::llround(size));
    }
    void insert(int corner, GridPoint p) { cells_[key(cell(p.x), cell(p.y))].push_back(corner); }
    void erase(int corner, GridPoint p) { std::erase(cells_[key(cell(p.x), cell(p.y))], corner); }
    // Whether a corner in the box satisfies the condition.
    template <class Condition>
    [[nodiscard]] bool any(const GridBox& box, const Condition& condition) const {
        for (GridLength x = cell(box.x0); x <= cell(box.x1); ++x) {
            for (GridLength y = cell(box.y0); y <= cell(box.y1); ++y) {
                const auto found = cells_.find(key(x, y));
                if (found != cells_.end() &&
                    std::any_of(found->second.begin(), found->second.end(), condition)) {
                    return true;
                }
            }
        }
        return false;
    }

 private:
    [[nodiscard]] GridLength cell(GridLength x) const { return x >= 0 ? x / size_ : -1 - (-1 - x) / size_; }
    static std::uint64_t key(GridLength x, GridLength y) {
        return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFU);
    }

    GridLength size_ = 1;
    std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

// Rings being made coarser, the inside on their left. Corners are numbered ring by ring.
class Coarsener {
 public:
    Coarsener(std::vector<GridRing>& rings, const Coarsening& how) : rings_(rings), how_(how) {
        for (const GridRing& ring : rings) {
            const auto first = static_cast<int>(corners_.size());
            const auto n = static_cast<int>(ring.size());
            for (int i = 0; i < n; ++i) {
                corners_.push_back({ring[index(i)], first + (i + n - 1) % n, first + (i + 1) % n,
                                    static_cast<int>(sizes_.size())});
            }
            sizes_.push_back(ring.size());
        }
        left_ = corners_.size();
        double perimeter = 0.0;
        for (const Corner& corner : corners_) perimeter += std::sqrt(square_of(at(corner.next) - corner.at));
        GridBox box;
        for (const Corner& corner : corners_) box.extend(corner.at);
        grid_.emplace(perimeter, box, corners_.size());
        for (int i = 0; i < static_cast<int>(corners_.size()); ++i) grid_->insert(i, at(i));
    }

    // A step is looked at again only when the corners that make it have changed, and once more before it is
    // taken: an area that was empty may have got a corner.
    void run() {
        if (how_.narrow > 0.0) fill_bays();
        for (int i = 0; i < static_cast<int>(corners_.size()); ++i) {
            if (!corners_[index(i)].gone) look_at(i);
        }
        double added = 0.0;
        while (!queue_.empty()) {
            const Offer offer = queue_.top();
            queue_.pop();
            Corner& corner = corners_[index(offer.corner)];
            if (corner.gone || offer.version != corner.version) continue;
            const double most = left_ > how_.many ? how_.most_added_of_many : how_.most_added;
            if (added + offer.added > most) break;
            const Step now = best_at(offer.corner);
            if (!now.possible || now.added > offer.added) {
                set_step(offer.corner, now);
                continue;
            }
            added += now.added;
            apply(now, offer.corner);
        }
        write();
    }

 private:
    struct Corner {
        GridPoint at;
        int before, next;
        int ring;
        int version = 0;
        bool gone = false;
    };
    struct Step {
        bool possible = false;
        bool edge = false;  // a corner instead of the edge that begins here; else this corner is dropped
        GridPoint corner;
        double added = 0.0;
    };
    struct Offer {
        double added;
        int corner;
        int version;
        friend bool operator<(const Offer& a, const Offer& b) {
            return std::tie(b.added, b.corner) < std::tie(a.added, a.corner);
        }
    };

    [[nodiscard]] GridPoint at(int i) const { return corners_[index(i)].at; }
    [[nodiscard]] int next(int i) const { return corners_[index(i)].next; }
    [[nodiscard]] int before(int i) const { return corners_[index(i)].before; }
    [[nodiscard]] std::size_t size_of(int i) const { return sizes_[index(corners_[index(i)].ring)]; }

    void look_at(int i) { set_step(i, best_at(i)); }
    void set_step(int i, const Step& step) {
        const int version = ++corners_[index(i)].version;
        if (step.possible) queue_.push({step.added, i, version});
    }

    [[nodiscard]] Step best_at(int i) const {
        const Step drop = notch(i);
        const Step meet = short_edge(i);
        if (!drop.possible) return meet;
        return meet.possible && meet.added < drop.added ? meet : drop;
    }

    // Whether any corner but these lies in the triangle, edges included.
    [[nodiscard]] bool is_empty(GridPoint a, GridPoint b, GridPoint c) const {
        GridBox box;
        for (const GridPoint p : {a, b, c}) box.extend(p);
        return !grid_->any(box, [&](int corner) {
            const GridPoint p = at(corner);
            if (p == a || p == b || p == c) return false;
            return side_of(a, b, p) >= 0 && side_of(b, c, p) >= 0 && side_of(c, a, p) >= 0;
        });
    }

    [[nodiscard]] Step notch(int i) const {
        if (size_of(i) <= 3) return {};
        const GridPoint a = at(before(i));
        const GridPoint b = at(i);
        const GridPoint c = at(next(i));
        const double twice = -static_cast<double>(cross(b - a, c - b));
        if (twice < 0.0) return {};
        if (twice > 0.0 && !is_empty(a, c, b)) return {};
        return {true, false, {}, 0.5 * twice};
    }

    [[nodiscard]] Step short_edge(int i) const {
        if (size_of(i) <= 4) return {};
        const GridPoint a = at(before(i));
        const GridPoint b = at(i);
        const GridPoint c = at(next(i));
        const GridPoint d = at(next(next(i)));
        if (side_of(a, b, c) <= 0 || side_of(b, c, d) <= 0) return {};
        const auto turn = static_cast<double>(cross(b - a, d - c));
        if (turn <= 0.0) return {};  // the neighbours do not meet beyond the edge
        const double along = static_cast<double>(cross(c - b, d - c)) / turn;
        GridPoint corner{b.x + std::llround(along * static_cast<double>(b.x - a.x)),
                         b.y + std::llround(along * static_cast<double>(b.y - a.y))};
        if (how_.encloses && !move_out(a, b, c, d, corner)) return {};
        const double twice = static_cast<double>(cross(c - b, corner - b)) * -1.0;
        if (twice < 0.0 || twice * twice > how_.furthest * how_.furthest * square_of(c - b)) return {};
        if (square_of(corner - b) > 16.0 * how_.furthest * how_.furthest) return {};
        if (!is_empty(b, corner, c)) return {};
        if (how_.encloses && !(is_empty(a, corner, b) && is_empty(c, corner, d))) return {};
        return {true, true, corner, 0.5 * twice};
    }

    // A place of the grid near the corner from which a and d are seen past b and c: what it spans holds them.
    static bool move_out(GridPoint a, GridPoint b, GridPoint c, GridPoint d, GridPoint& corner) {
        for (const GridLength reach : {0, 1, 2}) {
            for (GridLength x = -reach; x <= reach; ++x) {
                for (GridLength y = -reach; y <= reach; ++y) {
                    const GridPoint p = corner + GridPoint{x, y};
                    if (side_of(a, p, b) < 0 || side_of(p, d, c) < 0) continue;
                    corner = p;
                    return true;
                }
            }
        }
        return false;
    }

    void drop(int i) {
        Corner& corner = corners_[index(i)];
        grid_->erase(i, corner.at);
        corner.gone = true;
        corners_[index(corner.before)].next = corner.next;
        corners_[index(corner.next)].before = corner.before;
        --sizes_[index(corner.ring)];
        --left_;
    }

    void apply(const Step& step, int i) {
        int middle = before(i);
        if (step.edge) {
            grid_->erase(i, at(i));
            corners_[index(i)].at = step.corner;
            grid_->insert(i, step.corner);
            drop(next(i));
            middle = i;
        } else {
            drop(i);
        }
        // Steps see up to two corners ahead and one behind.
        int k = middle;
        for (int back = 0; back < 3; ++back) k = before(k);
        for (std::size_t count = std::min<std::size_t>(size_of(middle), 7); count > 0; --count, k = next(k))
            look_at(k);
    }

    // Bays between two corners that see each other over a narrow mouth, with nothing else in it. What is in
    // the bay is the ring's own, which is dropped, or another ring, which the mouth shuts in: there must be
    // none outside.
    void fill_bays() {
        constexpr int kLongest = 48;  // corners in a bay
        for (int i = 0; i < static_cast<int>(corners_.size()); ++i) {
            if (corners_[index(i)].gone || corners_[index(i)].ring != 0) continue;
            int far = -1;
            int k = next(next(i));
            for (int count = 2; count < kLongest && k != i; ++count, k = next(k)) {
                if (square_of(at(k) - at(i)) <= how_.narrow * how_.narrow && is_bay(i, k)) far = k;
            }
            if (far < 0 || size_of(i) < kLongest + 3) continue;
            while (next(i) != far) drop(next(i));
        }
    }

    // Whether all between the two is left of the line through them, and nothing else touches the mouth.
    [[nodiscard]] bool is_bay(int i, int far) const {
        const GridPoint a = at(i);
        const GridPoint b = at(far);
        GridBox box;
        box.extend(a);
        box.extend(b);
        for (int k = next(i); k != far; k = next(k)) {
            if (side_of(a, b, at(k)) < 0) return false;
            box.extend(at(k));
        }
        // Corners near the bay that are not its own must be outside of the mouth's line or beyond its sides;
        // a long edge could cross the mouth only by coming out of the bay, past one of its corners.
        return !grid_->any(box, [&](int corner) {
            const GridPoint p = at(corner);
            if (p == a || p == b || side_of(a, b, p) < 0) return false;
            for (int k = next(i); k != far; k = next(k)) {
                if (k == corner) return false;
            }
            return in_bay(i, far, p);
        });
    }

    // Whether p is inside the ring that the bay and its mouth make, or on it.
    [[nodiscard]] bool in_bay(int i, int far, GridPoint p) const {
        bool inside = false;
        for (int k = i;; k = next(k)) {
            const GridPoint a = at(k);
            const GridPoint b = k == far ? at(i) : at(next(k));
            const int s = side_of(a, b, p);
            if (s == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
                std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y)) {
                return true;
            }
            if ((a.y <= p.y) != (b.y <= p.y) && (s > 0) == (b.y > a.y)) inside = !inside;
            if (k == far) return inside;
        }
    }

    void write() {
        std::size_t first = 0;
        for (GridRing& ring : rings_) {
            const std::size_t n = ring.size();
            ring.clear();
            for (std::size_t i = first; i < first + n; ++i) {
                if (!corners_[i].gone) ring.push_back(corners_[i].at);
            }
            first += n;
        }
    }

    std::vector<GridRing>& rings_;
    const Coarsening& how_;
    std::vector<Corner> corners_;
    std::vector<std::size_t> sizes_;  // of rings
    std::size_t left_ = 0;            // corners that are not gone
    std::optional<CornerGrid> grid_;
    std::priority_queue<Offer> queue_;
};

}  // namespace

GridRegion coarser(const GridRegion& region, const Coarsening& how) {
    std::vector<GridRing> rings{region.outer};
    rings.insert(rings.end(), region.holes.begin(), region.holes.end());
    Coarsener(rings, how).run();
    GridRegion result{std::move(rings[0]), {}};
    for (std::size_t i = 1; i < rings.size(); ++i) {
        if (rings[i].size() >= 3) result.holes.push_back(std::move(rings[i]));
    }
    return result;
}

}  // namespace popup
