// What solve_shape() asks of the places of vertices, as equations and as their normal equations.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "folded/carton/point_system.h"
#include "folded/carton/shape.h"

namespace popup::folded {

// Places and residuals are vectors: x, y and z by vertex, and mm by condition, panels before merges before
// pairs.
class ShapeConditions {
 public:
    ShapeConditions(const Shape& shape, const ShapeJoins& joins);

    // What each condition is left open by.
    void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& left) const;
    // The derivatives J of conditions that are left open by `left`: J'J, and J' times `left`.
    void linearise(const Eigen::VectorXd& x, const Eigen::VectorXd& left, std::vector<double>& normal,
                   Eigen::VectorXd& slope) const;
    [[nodiscard]] std::pair<Solved::Worst, int> owner(Eigen::Index row) const;
    // Of these normal equations.
    [[nodiscard]] PointSystem& system() { return system_; }

 private:
    // Two corners at a distance.
    struct Side {
        Eigen::Index row = 0;
        int a = 0, b = 0;
        double wanted = 0.0;
        PointSystem::Block at_a, at_b, between;
    };
    // Shares of corners have the sum nought, in x, in y and in z: three rows. What they give to the normal
    // equations is the same wherever they are.
    struct Balance {
        Eigen::Index row = 0;
        std::array<int, 4> of{};
        std::array<double, 4> shares{};
        std::size_t count = 0;
    };
    // Three corners in the plane of three others, a row each.
    struct Plane {
        Eigen::Index row = 0;
        std::array<int, 3> ground{}, others{};
        double scale = 0.0;  // of products, to make distances of them
    };

    void add_panel(const Shape::Panel& panel, int number);
    void add_merge(const std::vector<int>& vertices, int number);
    void add_plane(const Shape& shape, std::pair<int, int> pair, int number);
    void take_rows(Eigen::Index count, Solved::Worst kind, int number);
    [[nodiscard]] std::vector<std::pair<int, int>> pairs() const;
    void add_plane_slopes(const Plane& plane, const Eigen::VectorXd& x, std::vector<double>& normal,
                          const Eigen::VectorXd& left, Eigen::VectorXd& slope) const;

    std::vector<Side> sides_;
    std::vector<Balance> balances_;
    std::vector<Plane> planes_;
    std::vector<std::pair<Solved::Worst, int>> owners_;  // by row
    PointSystem system_;
    std::vector<double> of_balances_;  // their part of the normal equations
};

}  // namespace popup::folded
