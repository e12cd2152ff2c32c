#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "folded/carton/move_vertices.h"

namespace popup::folded {
namespace {

// A rigid motion of the sheet.
struct Rigid2 {
    Vec2 from, to;
    double c = 1.0, s = 0.0;
    // That brings the middle of a line to that of another, and its direction to the other's.
    static Rigid2 of(Segment before, Segment after) {
        const Vec2 u = before.b - before.a;
        const Vec2 v = after.b - after.a;
        const double size = length(u) * length(v);
        // A line that only shifted turns nothing, to the last digit.
        if (size < 1e-12 || length(v - u) < 1e-12) return {before.a, after.a};
        return {lerp(before.a, before.b, 0.5), lerp(after.a, after.b, 0.5), dot(u, v) / size,
                cross(u, v) / size};
    }
    [[nodiscard]] Vec2 operator()(Vec2 p) const {
        const Vec2 d = p - from;
        return to + Vec2{c * d.x - s * d.y, s * d.x + c * d.y};
    }
};

// What of a line's growth is before a point of it: all of it is in the middle third.
double grown(double t) { return std::clamp(3.0 * t - 1.0, 0.0, 1.0); }

class Unfolder {
 public:
    Unfolder(const Vertices& shape, const MovedVertices& moved)
        : shape_(shape), moved_(moved), sheet_(shape.sheet()) {
        out_.corners = sheet_.corners;
        known_.assign(sheet_.corners.size(), 0);
        beside_.resize(sheet_.panels.size());
        for (const int panel : shape.tree().order) {
            const int up = shape.parent(panel);
            if (up < 0) continue;
            const int fold = nth(shape.tree().fold_of, panel);
            nth(beside_, panel).emplace_back(up, fold);
            nth(beside_, up).emplace_back(panel, fold);
        }
        for (const int corner : inner_corners()) inner_.insert(corner);
    }

    Unfolded run() {
        std::vector<char> done(sheet_.panels.size(), 0);
        for (const int root : roots()) {
            std::vector<std::pair<int, int>> open{{root, -1}};
            nth(done, root) = 1;
            for (std::size_t i = 0; i < open.size(); ++i) {
                const auto [panel, fold] = open[i];
                place(panel, fold);
                for (const auto& [next, by] : nth(beside_, panel)) {
                    if (std::exchange(nth(done, next), 1) == 0) open.emplace_back(next, by);
                }
            }
        }
        return std::move(out_);
    }

 private:
    [[nodiscard]] Vec3 by(int corner) const { return nth(moved_.by, corner); }
    [[nodiscard]] bool is_vertex(int corner) const {
        const int vertex = shape_.vertex_of(corner);
        return vertex >= 0 && nth(moved_.loose, vertex) == 0;
    }
    [[nodiscard]] bool stays(int panel) const {
        const std::vector<int>& named = shape_.named(panel);
        return nth(moved_.solved, panel) != 0 && std::all_of(named.begin(), named.end(), [&](int corner) {
                   return length(by(corner)) < kLeastMove;
               });
    }
    [[nodiscard]] double size_of(int panel) const {
        return area(sheet_.outline_of(nth(sheet_.panels, panel)));
    }

    // By piece: the largest panel that does not move, else that on which the others hang.
    [[nodiscard]] std::vector<int> roots() const {
        std::vector<int> best(sheet_.cuts.size(), -1);
        std::vector<double> size(sheet_.cuts.size(), 0.0);
        for (const int panel : shape_.tree().order) {
            const int piece = nth(sheet_.panels, panel).piece;
            int& own = nth(best, piece);
            if (own < 0) own = panel;
            if (!stays(panel) || size_of(panel) <= nth(size, piece) * (1.0 + 1e-9)) continue;
            nth(size, piece) = size_of(panel);
            own = panel;
        }
        std::erase(best, -1);
        return best;
    }

    // Of slits that are no edge of a panel.
    [[nodiscard]] std::vector<int> inner_corners() const {
        std::set<int> edges;
        for (const Panel& panel : sheet_.panels) {
            edges.insert(panel.outer.begin(), panel.outer.end());
            for (const std::vector<int>& hole : panel.holes) edges.insert(hole.begin(), hole.end());
        }
        std::vector<int> found;
        for (const std::vector<int>& own : shape_.corners()) {
            for (const int corner : own) {
                if (!edges.contains(corner)) found.push_back(corner);
            }
        }
        return found;
    }

    void set(int corner, Vec2 at) {
        if (std::exchange(nth(known_, corner), 1) == 0) {
            nth(out_.corners, corner) = at;
        } else if (const double apart = distance(nth(out_.corners, corner), at); apart > out_.gape_mm) {
            out_.gape_mm = apart;
            out_.gapes_at = corner;
        }
    }

    void place(int panel, int fold) {
        const std::vector<int>& named = shape_.named(panel);
        const Panel& own = nth(sheet_.panels, panel);
        Rigid2 motion;
        if (nth(moved_.solved, panel) != 0 && named.size() >= 3) {
            motion = place_solved(panel, fold);
        } else if (fold >= 0) {
            motion = motion_by(fold);
        }
        place_outline(own.outer, motion);
        place_rest(panel, motion);
    }

    [[nodiscard]] Rigid2 motion_by(int fold) const {
        const Segment before = sheet_.line_of(nth(sheet_.folds, fold));
        const std::vector<Stretch>& way = nth(sheet_.folds, fold).stretches;
        return Rigid2::of(before, {nth(out_.corners, way.front().a), nth(out_.corners, way.back().b)});
    }

    // The corners that are vertices, from their places in space.
    Rigid2 place_solved(int panel, int fold) {
        std::vector<int> own;
        std::vector<Vec2> flat;
        for (const int corner : nth(sheet_.panels, panel).outer) {
            if (!is_vertex(corner)) continue;
            own.push_back(corner);
            flat.push_back(sheet_.at(corner));
        }
        if (flat.size() < 3) return fold >= 0 ? motion_by(fold) : Rigid2{};
        const auto [a, b, c] = wide_triple(flat);
        const double whole = cross(flat[b] - flat[a], flat[c] - flat[a]);
        if (std::abs(whole) < kLeastTriangle) return fold >= 0 ? motion_by(fold) : Rigid2{};
        // A panel whose vertices move alike keeps its shape to the last digit.
        const bool rigid = std::all_of(own.begin(), own.end(), [&](int corner) {
            return length(by(corner) - by(own.front())) < kLeastMove;
        });
        std::vector<Vec2> now = flat;
        if (!rigid) {
            const auto at = [&](std::size_t i) { return shape_.place(own[i]) + by(own[i]); };
            const Vec3 x = unit(at(b) - at(a));
            Vec3 z = unit(cross(x, at(c) - at(a)));
            if (whole < 0.0) z = -z;
            const Vec3 y = cross(z, x);
            for (std::size_t i = 0; i < own.size(); ++i)
                now[i] = {dot(at(i) - at(a), x), dot(at(i) - at(a), y)};
        }
        const auto [one, other] = held(own, fold);
        const Segment there = fold >= 0 ? Segment{nth(out_.corners, own[one]), nth(out_.corners, own[other])}
                                        : Segment{flat[one], flat[other]};
        const Rigid2 motion = Rigid2::of({now[one], now[other]}, there);
        for (std::size_t i = 0; i < own.size(); ++i) set(own[i], motion(now[i]));
        return Rigid2::of({flat[one], flat[other]}, there);
    }

    // The two corners by which a panel is laid down: the ends of the fold it hangs on, else of its longest
    // line that does not move, else of its longest.
    [[nodiscard]] std::pair<std::size_t, std::size_t> held(const std::vector<int>& own, int fold) const {
        if (fold >= 0) {
            const std::vector<Stretch>& way = nth(sheet_.folds, fold).stretches;
            const auto a = std::find(own.begin(), own.end(), way.front().a);
            const auto b = std::find(own.begin(), own.end(), way.back().b);
            if (a != own.end() && b != own.end())
                return {static_cast<std::size_t>(a - own.begin()), static_cast<std::size_t>(b - own.begin())};
        }
        std::pair<std::size_t, std::size_t> best{0, own.size() - 1};
        double most = -1.0;
        bool still = false;
        for (std::size_t i = 0; i < own.size(); ++i) {
            const std::size_t j = (i + 1) % own.size();
            const bool stands = length(by(own[i])) < kLeastMove && length(by(own[j])) < kLeastMove;
            const double size = distance(sheet_.at(own[i]), sheet_.at(own[j]));
            if (stands < still || (stands == still && size <= most * (1.0 + 1e-12))) continue;
            still = stands;
            most = size;
            best = {i, j};
        }
        return best;
    }

    // Corners between those that are known, beside the line between these.
    void place_outline(const std::vector<int>& ring, const Rigid2& motion) {
        std::vector<std::size_t> fixed;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (nth(known_, ring[i]) != 0) fixed.push_back(i);
        }
        if (fixed.size() < 2) {
            for (const int corner : ring) set_if_new(corner, motion(sheet_.at(corner)));
            return;
        }
        std::vector<std::pair<int, Vec2>> made;
        for (std::size_t k = 0; k < fixed.size(); ++k) {
            const std::size_t begin = fixed[k];
            const std::size_t end = fixed[(k + 1) % fixed.size()];
            const Segment before{sheet_.at(ring[begin]), sheet_.at(ring[end])};
            const Segment after{nth(out_.corners, ring[begin]), nth(out_.corners, ring[end])};
            const double was = distance(before.a, before.b);
            const double is = distance(after.a, after.b);
            for (std::size_t i = (begin + 1) % ring.size(); i != end; i = (i + 1) % ring.size()) {
                const Vec2 p = sheet_.at(ring[i]);
                Vec2 to = after.a + (p - before.a);
                if (was > 1e-6 && is > 1e-6) {
                    const Vec2 u = (1.0 / was) * (before.b - before.a);
                    const Vec2 v = (1.0 / is) * (after.b - after.a);
                    const double t = dot(u, p - before.a) / was;
                    if (length(v - u) < 1e-12) {
                        to = p + (after.a - before.a) + (grown(t) * (is - was)) * u;
                    } else {
                        const double across = cross(u, p - before.a);
                        to = after.a + (t * was + grown(t) * (is - was)) * v + across * left_of(v);
                    }
                }
                made.emplace_back(ring[i], to);
            }
        }
        for (const auto& [corner, to] : made) set_if_new(corner, to);
    }
    void set_if_new(int corner, Vec2 at) {
        if (nth(known_, corner) == 0) set(corner, at);
    }

    // Holes, and slits in the middle, go as a whole with the vertices that are near them.
    void place_rest(int panel, const Rigid2& motion) {
        const Panel& own = nth(sheet_.panels, panel);
        for (const std::vector<int>& hole : own.holes) place_group(panel, hole, motion);
        std::map<int, std::vector<int>> next;
        for (const Stretch cut : nth(sheet_.cuts, own.piece)) {
            if (!inner_.contains(cut.a) && !inner_.contains(cut.b)) continue;
            next[cut.a].push_back(cut.b);
            next[cut.b].push_back(cut.a);
        }
        for (const int corner : nth(shape_.corners(), panel)) {
            if (!inner_.contains(corner) || nth(known_, corner) != 0) continue;
            std::vector<int> group{corner};
            std::set<int> seen{corner};
            for (std::size_t i = 0; i < group.size(); ++i) {
                for (const int other : next[group[i]]) {
                    if (inner_.contains(other) && seen.insert(other).second) group.push_back(other);
                }
            }
            place_group(panel, group, motion);
        }
    }

    // As the affine map that is nearest to the moves of the panel's vertices moves its middle: what moves
    // back comes back.
    void place_group(int panel, const std::vector<int>& group, const Rigid2& motion) {
        Vec2 middle;
        for (const int corner : group)
            middle = middle + (1.0 / static_cast<double>(group.size())) * sheet_.at(corner);
        Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
        Eigen::Matrix<double, 3, 2> moves = Eigen::Matrix<double, 3, 2>::Zero();
        int count = 0;
        for (const int corner : nth(sheet_.panels, panel).outer) {
            if (!is_vertex(corner)) continue;
            const Vec2 from = sheet_.at(corner) - middle;
            const Vec2 by = nth(out_.corners, corner) - motion(sheet_.at(corner));
            const Eigen::Vector3d row(1.0, from.x, from.y);
            sums += row * row.transpose();
            moves += row * Eigen::RowVector2d(by.x, by.y);
            ++count;
        }
        Vec2 shift;
        if (count > 0) {
            const Eigen::Matrix<double, 3, 2> map = sums.completeOrthogonalDecomposition().solve(moves);
            shift = {map(0, 0), map(0, 1)};
        }
        if (length(shift) < kLeastMove) shift = {};
        for (const int corner : group) set_if_new(corner, motion(sheet_.at(corner)) + shift);
    }

    const Vertices& shape_;
    const MovedVertices& moved_;
    const Sheet& sheet_;
    Unfolded out_;
    std::vector<char> known_;                               // by corner
    std::vector<std::vector<std::pair<int, int>>> beside_;  // by panel: panels, and the fold between
    std::set<int> inner_;
};

}  // namespace

Unfolded unfold(const Vertices& shape, const MovedVertices& moved) { return Unfolder(shape, moved).run(); }

}  // namespace popup::folded
