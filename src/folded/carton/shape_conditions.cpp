#include "folded/carton/shape_conditions.h"

#include <algorithm>
#include <cmath>

#include "base/nth.h"

namespace popup::folded {
namespace {

Vec3 place_of(const Eigen::VectorXd& x, int vertex) {
    const Eigen::Index at = 3 * static_cast<Eigen::Index>(vertex);
    return {x[at], x[at + 1], x[at + 2]};
}

void add_to(Eigen::VectorXd& x, int vertex, Vec3 by) {
    const Eigen::Index at = 3 * static_cast<Eigen::Index>(vertex);
    x[at] += by.x;
    x[at + 1] += by.y;
    x[at + 2] += by.z;
}

// The sides of a panel's first triangle.
constexpr std::array<std::array<std::size_t, 2>, 3> kSides{{{0, 1}, {1, 2}, {2, 0}}};

}  // namespace

ShapeConditions::ShapeConditions(const Shape& shape, const ShapeJoins& joins) : system_(0, {}) {
    for (std::size_t i = 0; i < shape.panels.size(); ++i) add_panel(shape.panels[i], static_cast<int>(i));
    for (std::size_t i = 0; i < joins.merged.size(); ++i) add_merge(joins.merged[i], static_cast<int>(i));
    for (std::size_t i = 0; i < joins.in_a_plane.size(); ++i)
        add_plane(shape, joins.in_a_plane[i], static_cast<int>(i));
    system_ = PointSystem(static_cast<int>(shape.at.size()), pairs());
    for (Side& side : sides_) {
        side.at_a = system_.block(side.a, side.a);
        side.at_b = system_.block(side.b, side.b);
        side.between = system_.block(side.a, side.b);
    }
    of_balances_ = system_.nought();
    for (const Balance& one : balances_) {
        for (std::size_t i = 0; i < one.count; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                const bool twice = i != j && one.of.at(i) == one.of.at(j);
                PointSystem::add_units(of_balances_, system_.block(one.of.at(i), one.of.at(j)),
                                       (twice ? 2.0 : 1.0) * one.shares.at(i) * one.shares.at(j));
            }
        }
    }
}

std::pair<Solved::Worst, int> ShapeConditions::owner(Eigen::Index row) const { return nth(owners_, row); }

void ShapeConditions::take_rows(Eigen::Index count, Solved::Worst kind, int number) {
    owners_.resize(owners_.size() + static_cast<std::size_t>(count), {kind, number});
}

void ShapeConditions::add_panel(const Shape::Panel& panel, int number) {
    for (const auto& [i, j] : kSides) {
        Side& side = sides_.emplace_back();
        side.row = static_cast<Eigen::Index>(owners_.size());
        side.a = panel.vertices[i];
        side.b = panel.vertices[j];
        side.wanted = distance(panel.flat[i], panel.flat[j]);
        take_rows(1, Solved::Worst::panel, number);
    }
    const Vec2 u = panel.flat[1] - panel.flat[0];
    const Vec2 v = panel.flat[2] - panel.flat[0];
    const double whole = cross(u, v);
    for (std::size_t i = 3; i < panel.vertices.size(); ++i) {
        const Vec2 w = panel.flat[i] - panel.flat[0];
        const double s = cross(w, v) / whole;
        const double t = cross(u, w) / whole;
        balances_.push_back({static_cast<Eigen::Index>(owners_.size()),
                             {panel.vertices[0], panel.vertices[1], panel.vertices[2], panel.vertices[i]},
                             {-(1.0 - s - t), -s, -t, 1.0},
                             4});
        take_rows(3, Solved::Worst::panel, number);
    }
}

void ShapeConditions::add_merge(const std::vector<int>& vertices, int number) {
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        balances_.push_back({static_cast<Eigen::Index>(owners_.size()),
                             {vertices[i], vertices[0], 0, 0},
                             {1.0, -1.0, 0.0, 0.0},
                             2});
        take_rows(3, Solved::Worst::merge, number);
    }
}

// The distances of one panel's first corners from the plane of the larger one.
void ShapeConditions::add_plane(const Shape& shape, std::pair<int, int> pair, int number) {
    const auto area_of = [&](int panel) {
        const std::vector<Vec2>& flat = nth(shape.panels, panel).flat;
        return std::abs(cross(flat[1] - flat[0], flat[2] - flat[0]));
    };
    if (area_of(pair.first) < area_of(pair.second)) std::swap(pair.first, pair.second);
    const std::vector<int>& ground = nth(shape.panels, pair.first).vertices;
    const std::vector<int>& others = nth(shape.panels, pair.second).vertices;
    planes_.push_back({static_cast<Eigen::Index>(owners_.size()),
                       {ground[0], ground[1], ground[2]},
                       {others[0], others[1], others[2]},
                       1.0 / area_of(pair.first)});
    take_rows(3, Solved::Worst::plane, number);
}

std::vector<std::pair<int, int>> ShapeConditions::pairs() const {
    std::vector<std::pair<int, int>> pairs;
    const auto add_all = [&pairs](const int* vertices, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (vertices[i] != vertices[j]) pairs.emplace_back(vertices[i], vertices[j]);
            }
        }
    };
    for (const Side& side : sides_) {
        if (side.a != side.b) pairs.emplace_back(side.a, side.b);
    }
    for (const Balance& one : balances_) add_all(one.of.data(), one.count);
    for (const Plane& plane : planes_) {
        for (const int other : plane.others) {
            const std::array<int, 4> all{plane.ground[0], plane.ground[1], plane.ground[2], other};
            add_all(all.data(), all.size());
        }
    }
    return pairs;
}

void ShapeConditions::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& left) const {
    left.resize(static_cast<Eigen::Index>(owners_.size()));
    for (const Side& side : sides_) {
        const Vec3 way = place_of(x, side.b) - place_of(x, side.a);
        left[side.row] = (dot(way, way) - side.wanted * side.wanted) / (2.0 * side.wanted);
    }
    for (const Balance& one : balances_) {
        Vec3 sum;
        for (std::size_t i = 0; i < one.count; ++i) sum = sum + one.shares.at(i) * place_of(x, one.of.at(i));
        left.segment<3>(one.row) << sum.x, sum.y, sum.z;
    }
    for (const Plane& plane : planes_) {
        const Vec3 at = place_of(x, plane.ground[0]);
        const Vec3 normal =
            plane.scale * cross(place_of(x, plane.ground[1]) - at, place_of(x, plane.ground[2]) - at);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 w = place_of(x, plane.others.at(i)) - at;
            left[plane.row + static_cast<Eigen::Index>(i)] = dot(normal, w);
        }
    }
}

void ShapeConditions::linearise(const Eigen::VectorXd& x, const Eigen::VectorXd& left,
                                std::vector<double>& normal, Eigen::VectorXd& slope) const {
    normal = of_balances_;
    slope.setZero(x.size());
    for (const Side& side : sides_) {
        const Vec3 by = (1.0 / side.wanted) * (place_of(x, side.b) - place_of(x, side.a));
        add_to(slope, side.b, left[side.row] * by);
        add_to(slope, side.a, -left[side.row] * by);
        PointSystem::add(normal, side.at_a, by, by);
        PointSystem::add(normal, side.at_b, by, by);
        PointSystem::add(normal, side.between, -by, by);
    }
    for (const Balance& one : balances_) {
        const Vec3 open{left[one.row], left[one.row + 1], left[one.row + 2]};
        for (std::size_t i = 0; i < one.count; ++i) add_to(slope, one.of.at(i), one.shares.at(i) * open);
    }
    for (const Plane& plane : planes_) add_plane_slopes(plane, x, normal, left, slope);
}

void ShapeConditions::add_plane_slopes(const Plane& plane, const Eigen::VectorXd& x,
                                       std::vector<double>& normal, const Eigen::VectorXd& left,
                                       Eigen::VectorXd& slope) const {
    const Vec3 at = place_of(x, plane.ground[0]);
    const Vec3 u = place_of(x, plane.ground[1]) - at;
    const Vec3 v = place_of(x, plane.ground[2]) - at;
    const Vec3 by_w = plane.scale * cross(u, v);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 w = place_of(x, plane.others.at(i)) - at;
        const Vec3 by_u = plane.scale * cross(v, w);
        const Vec3 by_v = plane.scale * cross(w, u);
        const std::array<int, 4> of{plane.ground[1], plane.ground[2], plane.others.at(i), plane.ground[0]};
        const std::array<Vec3, 4> by{by_u, by_v, by_w, -(by_u + by_v + by_w)};
        for (std::size_t j = 0; j < of.size(); ++j) {
            add_to(slope, of.at(j), left[plane.row + static_cast<Eigen::Index>(i)] * by.at(j));
            for (std::size_t k = 0; k < of.size(); ++k) {
                // Either of a pair; both where the corner of the one panel is one of the other, too.
                if (j < k && of.at(j) != of.at(k)) continue;
                PointSystem::add(normal, system_.block(of.at(j), of.at(k)), by.at(j), by.at(k));
            }
        }
    }
}

}  // namespace popup::folded
