#include "folded/carton/move_vertices.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "base/nth.h"

namespace popup::folded {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

constexpr int kMostSteps = 60;
constexpr double kPlane = 1e-11;    // of the sheet
constexpr double kRegular = 1e-12;  // conditions that say the same twice do no harm
constexpr double kBeside = 1e-3;    // its square: what a move costs, against one beside it

// Panels whose vertices are their own, but for those of the crease they hang on, follow that crease.
std::vector<char> find_solved(const Vertices& shape, const Subject& subject) {
    const std::vector<int>& order = shape.tree().order;
    const std::size_t count = order.size();
    std::vector<std::vector<int>> children(count);
    for (const int panel : order) {
        if (shape.parent(panel) >= 0) nth(children, shape.parent(panel)).push_back(panel);
    }
    // In depth first order what hangs on a panel follows it.
    std::vector<int> first(count, 0);
    std::vector<int> last(count, 0);
    int next = 0;
    for (const int root : order) {
        if (shape.parent(root) >= 0) continue;
        std::vector<std::pair<int, std::size_t>> open{{root, 0}};
        nth(first, root) = next++;
        while (!open.empty()) {
            auto& [panel, child] = open.back();
            if (child < nth(children, panel).size()) {
                const int down = nth(children, panel)[child++];
                nth(first, down) = next++;
                open.emplace_back(down, 0);
            } else {
                nth(last, panel) = next;
                open.pop_back();
            }
        }
    }
    std::vector<char> solved(count, 0);
    for (auto one = order.rbegin(); one != order.rend(); ++one) {
        const int panel = *one;
        const int up = shape.parent(panel);
        std::set<int> of_crease;
        if (up >= 0) {
            for (const Stretch& s : nth(shape.sheet().folds, nth(shape.tree().fold_of, panel)).stretches)
                of_crease.insert({shape.vertex_of(s.a), shape.vertex_of(s.b)});
        } else {
            nth(solved, panel) = 1;
        }
        for (const int corner : nth(shape.sheet().panels, panel).outer) {
            const int vertex = shape.vertex_of(corner);
            if (vertex < 0 || of_crease.contains(vertex)) continue;
            const std::vector<CornerOf>& members = nth(shape.members(), vertex);
            const bool own = std::all_of(members.begin(), members.end(), [&](CornerOf member) {
                return nth(first, member.panel) >= nth(first, panel) &&
                       nth(first, member.panel) < nth(last, panel);
            });
            if (!own || subject.vertices.contains(vertex)) nth(solved, panel) = 1;
        }
        if (nth(solved, panel) != 0 && up >= 0) nth(solved, up) = 1;
    }
    return solved;
}

// Whether a vertex of a panel lies between two others on a straight edge, those of a flap's crease aside.
bool lies_on_edge(const Vertices& shape, int panel, int vertex, const Fold& crease) {
    const std::vector<int>& named = shape.named(panel);
    const auto at =
        static_cast<std::size_t>(std::find_if(named.begin(), named.end(),
                                              [&](int corner) { return shape.vertex_of(corner) == vertex; }) -
                                 named.begin());
    if (at == named.size()) return false;
    const std::set<int> skipped{vertex, shape.vertex_of(crease.stretches.front().a),
                                shape.vertex_of(crease.stretches.back().b)};
    const auto next = [&](std::size_t step) {
        std::size_t i = at;
        do i = (i + step) % named.size();
        while (i != at && skipped.contains(shape.vertex_of(named[i])));
        return shape.sheet().at(named[i]);
    };
    const Vec2 a = next(named.size() - 1);
    const Vec2 b = next(1);
    const Vec2 p = shape.sheet().at(named[at]);
    const double size = distance(a, b);
    if (size <= shape.meet_mm()) return false;
    const double t = dot(p - a, b - a) / (size * size);
    return t > 0.0 && t < 1.0 && std::abs(cross(b - a, p - a)) <= shape.meet_mm() * size;
}

std::vector<char> find_loose(const Vertices& shape, const Subject& subject, const std::vector<char>& solved) {
    std::vector<char> loose(shape.members().size(), 0);
    for (std::size_t i = 0; i < loose.size(); ++i) {
        if (subject.vertices.contains(static_cast<int>(i))) continue;
        std::set<int> panels;
        for (const CornerOf& member : shape.members()[i]) panels.insert(member.panel);
        if (panels.size() != 2) continue;
        const auto is_flap_of = [&](int flap, int wall) {
            return nth(solved, flap) == 0 && nth(solved, wall) != 0 && shape.parent(flap) == wall &&
                   lies_on_edge(shape, wall, static_cast<int>(i),
                                nth(shape.sheet().folds, nth(shape.tree().fold_of, flap)));
        };
        if (is_flap_of(*panels.begin(), *panels.rbegin()) || is_flap_of(*panels.rbegin(), *panels.begin()))
            loose[i] = 1;
    }
    return loose;
}

// A vertex has a move, and each place in which it has corners one beside it, which costs far more.
class Mover {
 public:
    Mover(const Vertices& shape, const Subject& subject) : shape_(shape) {
        moved_.solved = find_solved(shape, subject);
        moved_.loose = find_loose(shape, subject, moved_.solved);
        free_follow(subject);
        vertex_by_.assign(shape.members().size(), Vec3{});
        vertex_unknown_.assign(shape.members().size(), -1);
        find_spots();
        for (const auto& [vertex, by] : subject.vertices) nth(vertex_by_, vertex) = by;
        std::vector<char> exact(spot_by_.size(), 0);
        for (const int corner : subject.exact) nth(exact, nth(spot_of_, corner)) = 1;
        for (std::size_t i = 0; i < moved_.solved.size(); ++i) {
            if (moved_.solved[i] != 0) add_panel(static_cast<int>(i), subject, exact);
        }
    }

    MovedVertices run() {
        const double enough = kPlane * shape_.sheet().size();
        for (int i = 0; i < kMostSteps; ++i) {
            const Vector residual = evaluate();
            if (residual.size() == 0 || unknowns_ == 0 || moved_.bent_mm <= enough) break;
            if (!step(residual)) break;
        }
        evaluate();
        moved_.by.assign(shape_.sheet().corners.size(), Vec3{});
        for (std::size_t i = 0; i < moved_.by.size(); ++i) {
            const auto corner = static_cast<int>(i);
            if (shape_.vertex_of(corner) >= 0) moved_.by[i] = by(corner);
        }
        find_normals();
        return std::move(moved_);
    }

 private:
    struct Plane {
        int panel = 0;
        std::array<int, 4> corners{};
    };

    // Corners that meet nothing follow the outline around them, unless one of the panel is to move.
    void free_follow(const Subject& subject) {
        std::set<int> asked;
        for (const auto& [vertex, by] : subject.vertices) {
            if (shape_.is_free(vertex)) asked.insert(nth(shape_.members(), vertex).front().panel);
        }
        for (std::size_t i = 0; i < moved_.loose.size(); ++i) {
            const auto vertex = static_cast<int>(i);
            if (shape_.is_free(vertex) && !asked.contains(shape_.members()[i].front().panel))
                moved_.loose[i] = 1;
        }
    }

    // Corners of a vertex that are in one place are one spot.
    void find_spots() {
        spot_of_.assign(shape_.sheet().corners.size(), -1);
        for (const std::vector<CornerOf>& members : shape_.members()) {
            const std::size_t first = spot_by_.size();
            std::vector<Vec3> places;
            for (const CornerOf member : members) {
                if (nth(spot_of_, member.corner) >= 0) continue;
                const Vec3 at = shape_.place(member.corner);
                std::size_t i = 0;
                while (i < places.size() && distance(places[i], at) > kMeetsMm) ++i;
                if (i == places.size()) {
                    places.push_back(at);
                    spot_by_.emplace_back();
                }
                nth(spot_of_, member.corner) = static_cast<int>(first + i);
            }
            for (std::size_t i = first; i < spot_by_.size(); ++i) alone_.push_back(places.size() == 1);
        }
        spot_unknown_.assign(spot_by_.size(), -1);
    }

    void add_panel(int panel, const Subject& subject, const std::vector<char>& exact) {
        std::vector<int> own;  // a corner of each spot
        std::set<int> seen;
        for (const int corner : nth(shape_.sheet().panels, panel).outer) {
            const int vertex = shape_.vertex_of(corner);
            if (vertex < 0 || nth(moved_.loose, vertex) != 0) continue;
            const int spot = nth(spot_of_, corner);
            if (!seen.insert(spot).second) continue;
            own.push_back(corner);
            if (!subject.vertices.contains(vertex) && nth(vertex_unknown_, vertex) < 0)
                nth(vertex_unknown_, vertex) = unknowns_++;
            if (!nth(alone_, spot) && nth(exact, spot) == 0 && nth(spot_unknown_, spot) < 0)
                nth(spot_unknown_, spot) = unknowns_++;
        }
        if (own.size() < 3) return;
        std::vector<Vec2> flat;
        flat.reserve(own.size());
        for (const int corner : own) flat.push_back(shape_.sheet().at(corner));
        const auto [a, b, c] = wide_triple(flat);
        if (std::abs(cross(flat[b] - flat[a], flat[c] - flat[a])) < kLeastTriangle) return;
        triples_.push_back({panel, {own[a], own[b], own[c], -1}});
        for (std::size_t k = 0; k < own.size(); ++k) {
            if (k != a && k != b && k != c) planes_.push_back({panel, {own[a], own[b], own[c], own[k]}});
        }
    }

    [[nodiscard]] Vec3 by(int corner) const {
        return nth(vertex_by_, shape_.vertex_of(corner)) + nth(spot_by_, nth(spot_of_, corner));
    }
    [[nodiscard]] Vec3 at(int corner) const { return shape_.place(corner) + by(corner); }

    // How far the fourth corner of each is from the plane of the first three, and the derivatives.
    Vector evaluate() {
        Vector residual(static_cast<Eigen::Index>(planes_.size()));
        slopes_.clear();
        moved_.bent_mm = 0.0;
        moved_.worst = -1;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const std::array<int, 4>& of = planes_[i].corners;
            const Vec3 u = at(of[1]) - at(of[0]);
            const Vec3 v = at(of[2]) - at(of[0]);
            const Vec3 w = at(of[3]) - at(of[0]);
            const double scale = 1.0 / std::max(length(cross(u, v)), 1e-3);
            const Vec3 by_u = scale * cross(v, w);
            const Vec3 by_v = scale * cross(w, u);
            const Vec3 by_w = scale * cross(u, v);
            const double off = dot(by_w, w);
            residual[static_cast<Eigen::Index>(i)] = off;
            if (std::abs(off) > moved_.bent_mm) {
                moved_.bent_mm = std::abs(off);
                moved_.worst = planes_[i].panel;
            }
            slope(i, of[1], by_u);
            slope(i, of[2], by_v);
            slope(i, of[3], by_w);
            slope(i, of[0], -(by_u + by_v + by_w));
        }
        return residual;
    }
    void slope(std::size_t row, int corner, Vec3 by) {
        slope_of(static_cast<int>(row), nth(vertex_unknown_, shape_.vertex_of(corner)), by);
        slope_of(static_cast<int>(row), nth(spot_unknown_, nth(spot_of_, corner)), kBeside * by);
    }
    void slope_of(int row, int column, Vec3 by) {
        if (column < 0) return;
        slopes_.emplace_back(row, 3 * column, by.x);
        slopes_.emplace_back(row, 3 * column + 1, by.y);
        slopes_.emplace_back(row, 3 * column + 2, by.z);
    }

    // To the least moves at which the conditions hold to the first order.
    bool step(const Vector& residual) {
        Matrix slopes(residual.size(), 3 * unknowns_);
        slopes.setFromTriplets(slopes_.begin(), slopes_.end());
        const Matrix transposed = slopes.transpose();
        Matrix normal = slopes * transposed;
        for (Eigen::Index i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += kRegular;
        const Eigen::SimplicialLDLT<Matrix> factors(normal);
        if (factors.info() != Eigen::Success) return false;
        Vector now(3 * unknowns_);
        each_unknown([&](Vec3 by, double scale, Eigen::Index column) {
            now[column] = by.x / scale;
            now[column + 1] = by.y / scale;
            now[column + 2] = by.z / scale;
            return by;
        });
        const Vector next = transposed * factors.solve(Vector(slopes * now - residual));
        if (!next.allFinite()) return false;
        each_unknown([&](Vec3, double scale, Eigen::Index column) {
            return scale * Vec3{next[column], next[column + 1], next[column + 2]};
        });
        return true;
    }
    template <typename Change>
    void each_unknown(const Change& change) {
        for (std::size_t i = 0; i < vertex_unknown_.size(); ++i) {
            if (vertex_unknown_[i] < 0) continue;
            vertex_by_[i] = change(vertex_by_[i], 1.0, 3 * static_cast<Eigen::Index>(vertex_unknown_[i]));
        }
        for (std::size_t i = 0; i < spot_unknown_.size(); ++i) {
            if (spot_unknown_[i] < 0) continue;
            spot_by_[i] = change(spot_by_[i], kBeside, 3 * static_cast<Eigen::Index>(spot_unknown_[i]));
        }
    }

    void find_normals() {
        moved_.normals.assign(moved_.solved.size(), Vec3{});
        for (const Plane& one : triples_) {
            const auto [a, b, c, none] = one.corners;
            const Sheet& sheet = shape_.sheet();
            const bool turned = cross(sheet.at(b) - sheet.at(a), sheet.at(c) - sheet.at(a)) < 0.0;
            const Vec3 way = cross(at(b) - at(a), at(c) - at(a));
            if (length(way) < kLeastTriangle * kLeastMove) continue;
            nth(moved_.normals, one.panel) = turned ? -unit(way) : unit(way);
        }
    }

    const Vertices& shape_;
    MovedVertices moved_;
    std::vector<Vec3> vertex_by_;      // by vertex
    std::vector<int> vertex_unknown_;  // by vertex; -1: it is given, or of no solved panel
    std::vector<int> spot_of_;         // by corner; -1: it is no vertex
    std::vector<Vec3> spot_by_;        // by spot, beside its vertex
    std::vector<char> alone_;          // by spot: its vertex has no other
    std::vector<int> spot_unknown_;    // by spot; -1: it moves as its vertex
    int unknowns_ = 0;
    std::vector<Plane> planes_;
    std::vector<Plane> triples_;  // by panel, of which the fourth corner is none
    std::vector<Eigen::Triplet<double>> slopes_;
};

}  // namespace

// Three corners, by their places in `at`, that enclose a large triangle.
std::array<std::size_t, 3> wide_triple(const std::vector<Vec2>& at) {
    std::array<std::size_t, 3> best{0, 0, 0};
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (distance(at[0], at[i]) > distance(at[0], at[best[1]])) best[1] = i;
    }
    const Vec2 way = at[best[1]] - at[0];
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (std::abs(cross(way, at[i] - at[0])) > std::abs(cross(way, at[best[2]] - at[0])) + 1e-9)
            best[2] = i;
    }
    return best;
}

MovedVertices move_vertices(const Vertices& shape, const Subject& subject) {
    return Mover(shape, subject).run();
}

}  // namespace popup::folded
