#include "folded/bend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/geometry/cells.h"
#include "base/geometry/triangulate.h"
#include "base/nth.h"

namespace popup::folded {
namespace {

// Panels of more corners, as curves have them, are not divided.
constexpr std::size_t kMostCorners = 2000;
// An end of a flat line this near to a corner, as a share of the sheet, is there.
constexpr double kAtCorner = 1.0 / 400.0;
// A corner this near to a line, as a share of its length, lies on it.
constexpr double kOnWay = 1e-6;
// Steps of work: of a pair of corners of a panel that is divided, of a corner that is looked at, and of a
// diagonal that may be turned.
constexpr double kCornerSteps = 20.0;
constexpr double kLookSteps = 10.0;
constexpr double kTurnSteps = 1000.0;
// A diagonal is turned only for one that is better by more than rounding.
constexpr double kClearlyBetter = 1e-9;

using Triangle = std::array<int, 3>;  // corners of the sheet, counter-clockwise
using Side = std::pair<int, int>;     // from corner to corner

// Corners found by where they are.
class Corners {
 public:
    Corners(const std::vector<Vec2>& corners, double reach) : corners_(corners), reach_(reach) {
        for (std::size_t i = 0; i < corners.size(); ++i)
            cells_[cell(corners[i])].push_back(static_cast<int>(i));
    }

    // The nearest within reach; -1: none.
    [[nodiscard]] int at(Vec2 p, Work& work) const {
        int best = -1;
        double nearest = reach_;
        const PlaneCell middle = cell(p);
        for (std::int64_t x = middle.x - 1; x <= middle.x + 1; ++x) {
            for (std::int64_t y = middle.y - 1; y <= middle.y + 1; ++y) {
                const auto found = cells_.find({x, y});
                if (found == cells_.end()) continue;
                if (!work.spend(kLookSteps * static_cast<double>(found->second.size()))) return -1;
                for (const int corner : found->second) {
                    const double away = distance(nth(corners_, corner), p);
                    if (away > nearest || (away == nearest && best >= 0)) continue;
                    nearest = away;
                    best = corner;
                }
            }
        }
        return best;
    }

 private:
    [[nodiscard]] PlaneCell cell(Vec2 p) const {
        return {static_cast<std::int64_t>(std::floor(p.x / reach_)),
                static_cast<std::int64_t>(std::floor(p.y / reach_))};
    }

    const std::vector<Vec2>& corners_;
    double reach_;
    std::unordered_map<PlaneCell, std::vector<int>, PlaneCellHash> cells_;
};

class Divider {
 public:
    Divider(const Sheet& sheet, const CreasePattern& pattern, Work& work) : sheet_(sheet), work_(work) {
        const Corners corners(sheet.corners, kAtCorner * sheet.size());
        for (const CreaseLine& line : pattern.lines) {
            if (line.use != CreaseUse::flat) continue;
            for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
                const int a = corners.at(line.points[i], work);
                const int b = corners.at(line.points[i + 1], work);
                if (a >= 0 && b >= 0 && a != b) {
                    drawn_[a].push_back(b);
                    drawn_[b].push_back(a);
                }
            }
        }
    }

    void divide(const Panel& panel) {
        std::size_t corners = panel.outer.size();
        for (const std::vector<int>& hole : panel.holes) corners += hole.size();
        if (corners < 4 || corners > kMostCorners) return;
        const auto count = static_cast<double>(corners);
        if (!work_.spend(kCornerSteps * count * count)) return;
        if (!panel.holes.empty()) {
            divide_further(panel.outer, panel.holes);
            return;
        }
        std::vector<std::vector<int>> open{panel.outer};
        while (!open.empty()) {
            std::vector<int> ring = std::move(open.back());
            open.pop_back();
            const auto [from, to] = drawn_in(ring);
            if (work_.is_spent()) return;
            if (to == 0) {
                divide_further(ring, {});
                continue;
            }
            bends_.push_back({ring[from], ring[to]});
            const auto at = [&ring](std::size_t i) { return ring.begin() + static_cast<std::ptrdiff_t>(i); };
            std::vector<int> rest(ring.begin(), at(from + 1));
            rest.insert(rest.end(), at(to), ring.end());
            open.emplace_back(at(from), at(to + 1));
            open.push_back(std::move(rest));
        }
    }

    [[nodiscard]] std::vector<Stretch> take() { return std::move(bends_); }

 private:
    // A line that is drawn as flat between two corners of the ring that are no neighbours; {0, 0}: none.
    [[nodiscard]] std::pair<std::size_t, std::size_t> drawn_in(const std::vector<int>& ring) const {
        if (drawn_.empty() || ring.size() < 4) return {0, 0};
        std::map<int, std::size_t> place;
        for (std::size_t i = 0; i < ring.size(); ++i) place.emplace(ring[i], i);
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto lines = drawn_.find(ring[i]);
            if (lines == drawn_.end()) continue;
            for (const int other : lines->second) {
                if (!work_.spend(kLookSteps)) return {0, 0};
                const auto found = place.find(other);
                if (found == place.end() || found->second < i + 2) continue;
                if (i == 0 && found->second + 1 == ring.size()) continue;
                if (!work_.spend(kLookSteps * static_cast<double>(ring.size()))) return {0, 0};
                if (leads_inwards(ring, i, found->second) && meets_no_side(ring, i, found->second))
                    return {i, found->second};
            }
        }
        return {0, 0};
    }

    // True if no side of the ring lies across the way from corner i to corner k. Flat lines may be drawn over
    // cuts.
    [[nodiscard]] bool meets_no_side(const std::vector<int>& ring, std::size_t i, std::size_t k) const {
        const std::size_t count = ring.size();
        const Vec2 a = sheet_.at(ring[i]);
        const Vec2 b = sheet_.at(ring[k]);
        for (std::size_t m = 0; m < count; ++m) {
            const std::size_t n = (m + 1) % count;
            const Vec2 p = sheet_.at(ring[m]);
            const Vec2 q = sheet_.at(ring[n]);
            if (m == i || m == k) continue;
            // A corner on the way would leave a triangle without an area.
            if (std::abs(cross(b - a, p - a)) <= kOnWay * dot(b - a, b - a) && dot(p - a, p - b) < 0.0)
                return false;
            if (n == i || n == k) continue;
            const bool parts_line = cross(b - a, p - a) * cross(b - a, q - a) <= 0.0;
            const bool parts_side = cross(q - p, a - p) * cross(q - p, b - p) <= 0.0;
            if (parts_line && parts_side) return false;
        }
        return true;
    }

    // Whether the way from corner i to corner k begins inside the ring.
    [[nodiscard]] bool leads_inwards(const std::vector<int>& ring, std::size_t i, std::size_t k) const {
        const std::size_t count = ring.size();
        const Vec2 at = sheet_.at(ring[i]);
        const Vec2 in = sheet_.at(ring[(i + count - 1) % count]) - at;
        const Vec2 out = sheet_.at(ring[(i + 1) % count]) - at;
        const Vec2 way = sheet_.at(ring[k]) - at;
        const bool left_of_out = cross(out, way) > 0.0;
        const bool right_of_in = cross(way, in) > 0.0;
        return cross(out, in) > 0.0 ? left_of_out && right_of_in : left_of_out || right_of_in;
    }

    // Into triangles, with diagonals turned until none has wider angles (Lawson).
    void divide_further(const std::vector<int>& outer, const std::vector<std::vector<int>>& holes) {
        std::map<std::pair<double, double>, int> number;
        const auto ring_of = [&](const std::vector<int>& corners) {
            Ring ring;
            ring.reserve(corners.size());
            for (const int corner : corners) {
                ring.push_back(sheet_.at(corner));
                number.emplace(std::pair{ring.back().x, ring.back().y}, corner);
            }
            return ring;
        };
        Polygon polygon{ring_of(outer), {}};
        for (const std::vector<int>& hole : holes) polygon.holes.push_back(ring_of(hole));
        const Triangulation found = triangulate(polygon, kMostCorners);
        std::vector<Triangle> triangles;
        for (const auto& one : found.triangles) {
            Triangle triangle{};
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec2 p = found.points[one.at(i)];
                const auto known = number.find({p.x, p.y});
                if (known == number.end()) return;
                triangle.at(i) = known->second;
            }
            triangles.push_back(triangle);
        }
        turn_diagonals(triangles);
        std::map<Side, int> sides;
        for (const Triangle& t : triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                const int a = t.at(i);
                const int b = t.at((i + 1) % 3);
                if (sides.contains({b, a})) bends_.push_back({b, a});
                sides[{a, b}] = 0;
            }
        }
    }

    // Corners within a circle through the others make narrow angles.
    void turn_diagonals(std::vector<Triangle>& triangles) const {
        std::map<Side, std::size_t> of;  // the triangle on the left of a side
        std::vector<Side> open;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Side side{triangles[i].at(k), triangles[i].at((k + 1) % 3)};
                of[side] = i;
                if (side.first < side.second) open.push_back(side);
            }
        }
        // Each turn brings the triangles nearer to the best ones; the count is for rounding.
        std::size_t left = 4 * triangles.size() * triangles.size() + 16;
        while (!open.empty() && left-- > 0 && work_.spend(kTurnSteps)) {
            const auto [a, b] = open.back();
            open.pop_back();
            const auto here = of.find({a, b});
            const auto there = of.find({b, a});
            if (here == of.end() || there == of.end()) continue;
            const std::size_t one = here->second;
            const std::size_t other = there->second;
            const int c = third(triangles[one], a, b);
            const int d = third(triangles[other], a, b);
            if (angle_at(c, a, b) + angle_at(d, a, b) <= std::numbers::pi + kClearlyBetter) continue;
            of.erase(here);
            of.erase({b, a});
            triangles[one] = {a, d, c};
            triangles[other] = {d, b, c};
            of[{a, d}] = of[{d, c}] = of[{c, a}] = one;
            of[{d, b}] = of[{b, c}] = of[{c, d}] = other;
            open.insert(open.end(), {{a, d}, {d, b}, {b, c}, {c, a}});
        }
    }

    static int third(const Triangle& t, int a, int b) {
        for (const int corner : t) {
            if (corner != a && corner != b) return corner;
        }
        return a;
    }

    [[nodiscard]] double angle_at(int corner, int a, int b) const {
        const Vec2 at = sheet_.at(corner);
        const Vec2 u = sheet_.at(a) - at;
        const Vec2 v = sheet_.at(b) - at;
        return std::abs(std::atan2(cross(u, v), dot(u, v)));
    }

    const Sheet& sheet_;
    Work& work_;
    std::map<int, std::vector<int>> drawn_;  // from corner to corner
    std::vector<Stretch> bends_;
};

}  // namespace

std::optional<Bent> bend_panels(const CreasePattern& pattern, const FoldOptions& options, const Sheet& sheet,
                                const Paths& paths, Work& work) {
    std::vector<char> bends(sheet.panels.size(), 0);
    for (const Cluster& cluster : paths.clusters) {
        if (cluster.reached > 0.0 || cluster.given_up) continue;
        for (const int number : cluster.folds) {
            const Fold& fold = nth(sheet.folds, number);
            nth(bends, fold.left) = nth(bends, fold.right) = 1;
        }
    }
    if (std::none_of(bends.begin(), bends.end(), [](char one) { return one != 0; })) return std::nullopt;
    Divider divider(sheet, pattern, work);
    for (std::size_t i = 0; i < bends.size(); ++i) {
        if (bends[i] != 0) divider.divide(sheet.panels[i]);
    }
    const std::vector<Stretch> diagonals = divider.take();
    if (diagonals.empty() || work.is_spent()) return std::nullopt;
    Diagnostics told;  // once more what the sheet without bends has told
    std::optional<Sheet> divided = make_sheet(pattern, options, told, diagonals);
    if (!divided) return std::nullopt;
    Bent bent;
    bent.paths = find_paths(*divided, {options.closure_mm}, work);
    if (!(bent.paths.reached > 0.0)) return std::nullopt;
    bent.sheet = std::move(*divided);
    return bent;
}

}  // namespace popup::folded
