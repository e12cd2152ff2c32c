#include "folded/carton/shape.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/nth.h"

namespace popup::folded {
namespace {

using Vector = Eigen::VectorXd;
using Triplet = Eigen::Triplet<double>;

constexpr int kProjections = 400;
// Merged vertices and planes against panels, in projections.
constexpr double kJoinWeight = 4.0;
constexpr double kLeastDamping = 1e-12;
constexpr double kNoHope = 1e8;        // so much damping, and no step helps
constexpr double kStandsStill = 1e-3;  // a step gains less than this share
constexpr double kSmallStep = 1e-5;    // of the size

Vec3 place_of(const Vector& x, int vertex) {
    const Eigen::Index at = 3 * static_cast<Eigen::Index>(vertex);
    return {x[at], x[at + 1], x[at + 2]};
}

class Conditions {
 public:
    Conditions(const Shape& shape, const ShapeJoins& joins) : shape_(shape), joins_(joins) {}

    // What each condition is left open by, mm, and with `slopes` its derivatives.
    Vector evaluate(const Vector& x, std::vector<Triplet>* slopes) {
        residuals_.clear();
        owners_.clear();
        slopes_ = slopes;
        if (slopes_ != nullptr) slopes_->clear();
        for (std::size_t i = 0; i < shape_.panels.size(); ++i) {
            owner_ = {Solved::Worst::panel, static_cast<int>(i)};
            keep_rigid(x, shape_.panels[i]);
        }
        for (std::size_t i = 0; i < joins_.merged.size(); ++i) {
            owner_ = {Solved::Worst::merge, static_cast<int>(i)};
            merge(x, joins_.merged[i]);
        }
        for (std::size_t i = 0; i < joins_.in_a_plane.size(); ++i) {
            owner_ = {Solved::Worst::plane, static_cast<int>(i)};
            lay_in_plane(x, joins_.in_a_plane[i]);
        }
        return Eigen::Map<const Vector>(residuals_.data(), static_cast<Eigen::Index>(residuals_.size()));
    }

    // Of the last evaluation.
    [[nodiscard]] std::pair<Solved::Worst, int> owner(Eigen::Index row) const { return nth(owners_, row); }

 private:
    void add(double residual) {
        residuals_.push_back(residual);
        owners_.push_back(owner_);
    }
    // By the place of a vertex, of the condition that is added next.
    void slope(int vertex, Vec3 by) {
        if (slopes_ == nullptr) return;
        const int row = static_cast<int>(residuals_.size());
        slopes_->emplace_back(row, 3 * vertex, by.x);
        slopes_->emplace_back(row, 3 * vertex + 1, by.y);
        slopes_->emplace_back(row, 3 * vertex + 2, by.z);
    }

    void keep_rigid(const Vector& x, const Shape::Panel& panel) {
        static constexpr std::array<std::array<std::size_t, 2>, 3> kSides{{{0, 1}, {1, 2}, {2, 0}}};
        for (const auto& [i, j] : kSides) {
            const double wanted = distance(panel.flat[i], panel.flat[j]);
            const Vec3 way = place_of(x, panel.vertices[j]) - place_of(x, panel.vertices[i]);
            slope(panel.vertices[j], (1.0 / wanted) * way);
            slope(panel.vertices[i], (-1.0 / wanted) * way);
            add((dot(way, way) - wanted * wanted) / (2.0 * wanted));
        }
        const Vec2 u = panel.flat[1] - panel.flat[0];
        const Vec2 v = panel.flat[2] - panel.flat[0];
        const double whole = cross(u, v);
        for (std::size_t i = 3; i < panel.vertices.size(); ++i) {
            const Vec2 w = panel.flat[i] - panel.flat[0];
            const double s = cross(w, v) / whole;
            const double t = cross(u, w) / whole;
            const std::array<double, 4> shares{-(1.0 - s - t), -s, -t, 1.0};
            const std::array<int, 4> of{panel.vertices[0], panel.vertices[1], panel.vertices[2],
                                        panel.vertices[i]};
            Vec3 sum;
            for (std::size_t j = 0; j < 4; ++j) sum = sum + shares.at(j) * place_of(x, of.at(j));
            for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
                for (std::size_t j = 0; j < 4; ++j) slope(of.at(j), shares.at(j) * axis);
                add(dot(axis, sum));
            }
        }
    }

    void merge(const Vector& x, const std::vector<int>& vertices) {
        for (std::size_t i = 1; i < vertices.size(); ++i) {
            const Vec3 way = place_of(x, vertices[i]) - place_of(x, vertices[0]);
            for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
                slope(vertices[i], axis);
                slope(vertices[0], -axis);
                add(dot(axis, way));
            }
        }
    }

    // The distances of one panel's first corners from the plane of the larger one.
    void lay_in_plane(const Vector& x, std::pair<int, int> pair) {
        const auto area_of = [&](int panel) {
            const std::vector<Vec2>& flat = nth(shape_.panels, panel).flat;
            return std::abs(cross(flat[1] - flat[0], flat[2] - flat[0]));
        };
        if (area_of(pair.first) < area_of(pair.second)) std::swap(pair.first, pair.second);
        const Shape::Panel& ground = nth(shape_.panels, pair.first);
        const double scale = 1.0 / area_of(pair.first);
        const Vec3 at = place_of(x, ground.vertices[0]);
        const Vec3 u = place_of(x, ground.vertices[1]) - at;
        const Vec3 v = place_of(x, ground.vertices[2]) - at;
        const Shape::Panel& other = nth(shape_.panels, pair.second);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 w = place_of(x, other.vertices[i]) - at;
            const Vec3 by_u = scale * cross(v, w);
            const Vec3 by_v = scale * cross(w, u);
            const Vec3 by_w = scale * cross(u, v);
            slope(ground.vertices[1], by_u);
            slope(ground.vertices[2], by_v);
            slope(other.vertices[i], by_w);
            slope(ground.vertices[0], -(by_u + by_v + by_w));
            add(dot(by_w, w));
        }
    }

    const Shape& shape_;
    const ShapeJoins& joins_;
    std::vector<double> residuals_;
    std::vector<std::pair<Solved::Worst, int>> owners_;
    std::pair<Solved::Worst, int> owner_;
    std::vector<Triplet>* slopes_ = nullptr;
};

double most(const Vector& residuals) {
    return residuals.size() == 0 ? 0.0 : residuals.lpNorm<Eigen::Infinity>();
}

class Solver {
 public:
    Solver(const Shape& shape, const ShapeJoins& joins, const SolveOptions& options)
        : shape_(shape), joins_(joins), options_(options), conditions_(shape, joins) {
        start_.resize(3 * static_cast<Eigen::Index>(shape.at.size()));
        for (std::size_t i = 0; i < shape.at.size(); ++i) {
            const auto at = 3 * static_cast<Eigen::Index>(i);
            start_[at] = shape.at[i].x;
            start_[at + 1] = shape.at[i].y;
            start_[at + 2] = shape.at[i].z;
        }
    }

    Solved run() {
        Vector x = search(start_);
        double left = most(conditions_.evaluate(x, nullptr));
        bool projected = false;
        bool settled = settled_;
        if (left > enough()) {
            Vector second = search(project());
            if (const double other = most(conditions_.evaluate(second, nullptr)); other < left) {
                left = other;
                x = std::move(second);
                projected = true;
                settled = settled_;
            }
        }
        settled_ = settled;
        return told(x, projected);
    }

 private:
    [[nodiscard]] double enough() const { return options_.enough * options_.size_mm; }
    [[nodiscard]] double hold() const { return options_.hold * options_.hold; }

    Solved told(const Vector& x, bool projected) {
        const Vector residuals = conditions_.evaluate(x, nullptr);
        Solved result;
        for (std::size_t i = 0; i < shape_.at.size(); ++i)
            result.at.push_back(place_of(x, static_cast<int>(i)));
        result.residual_mm = most(residuals);
        result.closes = result.residual_mm <= enough();
        result.steps = steps_;
        result.projected = projected;
        result.settled = settled_ || result.closes;
        if (!result.closes) {
            Eigen::Index row = 0;
            residuals.cwiseAbs().maxCoeff(&row);
            std::tie(result.worst, result.number) = conditions_.owner(row);
        }
        return result;
    }

    // One step from x; false where none helps. `held`: the soft conditions count.
    bool step(Vector& x, double& damping, bool held, double& gain) {
        const Vector residuals = conditions_.evaluate(x, &slopes_);
        Eigen::SparseMatrix<double> jacobian(residuals.size(), x.size());
        jacobian.setFromTriplets(slopes_.begin(), slopes_.end());
        const Eigen::SparseMatrix<double> product = jacobian.transpose() * jacobian;
        Vector slope = jacobian.transpose() * residuals;
        const auto cost_of = [&](const Vector& at, const Vector& left) {
            double cost = left.squaredNorm();
            if (held) cost += hold() * (at - start_).squaredNorm();
            return cost;
        };
        if (held) slope += hold() * (x - start_);
        const double before = cost_of(x, residuals);
        Eigen::SparseMatrix<double> unit(x.size(), x.size());
        for (; damping < kNoHope; damping *= 8.0) {
            unit.setIdentity();
            for (Eigen::Index i = 0; i < x.size(); ++i) unit.coeffRef(i, i) = damping + (held ? hold() : 0.0);
            const Eigen::SparseMatrix<double> whole = product + unit;
            if (steps_ == 0 || !analysed_) {
                factors_.analyzePattern(whole);
                analysed_ = true;
            }
            factors_.factorize(whole);
            if (factors_.info() != Eigen::Success) continue;
            const Vector next = x - factors_.solve(slope);
            const double after = cost_of(next, conditions_.evaluate(next, nullptr));
            if (!(after < before)) continue;
            gain = 1.0 - after / before;
            moved_ = (next - x).lpNorm<Eigen::Infinity>();
            x = next;
            damping = std::max(kLeastDamping, damping / 8.0);
            return true;
        }
        return false;
    }

    Vector search(Vector x) {
        analysed_ = false;
        double damping = 1e-3;
        double gain = 1.0;
        int slow = 0;
        for (int i = 0; i < options_.steps_at_most && slow < 3; ++i, ++steps_) {
            if (!step(x, damping, true, gain)) break;
            slow = gain < kStandsStill ? slow + 1 : 0;
        }
        // The soft conditions have a share in every place: without them the rest closes to the last digit.
        damping = 1e-6;
        settled_ = true;
        slow = 0;
        for (int i = 0; i < options_.steps_at_most && slow < 5; ++i, ++steps_) {
            if (most(conditions_.evaluate(x, nullptr)) <= 1e-3 * enough()) break;
            if (!step(x, damping, false, gain)) break;
            // Where conditions are tangent, little is gained by steps that lead far nevertheless.
            slow = gain < kStandsStill && moved_ < kSmallStep * options_.size_mm ? slow + 1 : 0;
            settled_ = i + 1 < options_.steps_at_most;
        }
        return x;
    }

    using Matrix3X = Eigen::Matrix3Xd;
    struct Sums {
        Matrix3X places;
        Vector weights;
        void add(int vertex, const Eigen::Vector3d& place, double weight) {
            places.col(vertex) += weight * place;
            weights[vertex] += weight;
        }
    };

    static Matrix3X columns(const Matrix3X& all, const std::vector<int>& vertices) {
        Matrix3X some(3, static_cast<Eigen::Index>(vertices.size()));
        for (std::size_t i = 0; i < vertices.size(); ++i)
            some.col(static_cast<Eigen::Index>(i)) = all.col(vertices[i]);
        return some;
    }

    void project_panels(const Matrix3X& at, Sums& sums) const {
        for (const Shape::Panel& panel : shape_.panels) {
            const Matrix3X now = columns(at, panel.vertices);
            Matrix3X flat(3, now.cols());
            for (std::size_t i = 0; i < panel.flat.size(); ++i)
                flat.col(static_cast<Eigen::Index>(i)) << panel.flat[i].x, panel.flat[i].y, 0.0;
            const Eigen::Matrix4d best = Eigen::umeyama(flat, now, false);
            const Matrix3X fit = (best.topLeftCorner<3, 3>() * flat).colwise() + best.col(3).head<3>();
            for (std::size_t i = 0; i < panel.vertices.size(); ++i)
                sums.add(panel.vertices[i], fit.col(static_cast<Eigen::Index>(i)), 1.0);
        }
    }

    void project_joins(const Matrix3X& at, Sums& sums) const {
        for (const std::vector<int>& group : joins_.merged) {
            const Eigen::Vector3d mean = columns(at, group).rowwise().mean();
            for (const int vertex : group) sums.add(vertex, mean, kJoinWeight);
        }
        for (const auto& [a, b] : joins_.in_a_plane) {
            std::vector<int> both = nth(shape_.panels, a).vertices;
            const std::vector<int>& others = nth(shape_.panels, b).vertices;
            both.insert(both.end(), others.begin(), others.end());
            const Matrix3X now = columns(at, both);
            const Eigen::Vector3d mean = now.rowwise().mean();
            const Matrix3X about = now.colwise() - mean;
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(about * about.transpose());
            const Eigen::Vector3d normal = axes.eigenvectors().col(0);  // of the least eigenvalue
            for (const int vertex : both)
                sums.add(vertex, at.col(vertex) - normal * normal.dot(at.col(vertex) - mean), 1.0);
        }
    }

    [[nodiscard]] Vector project() const {
        const auto count = static_cast<Eigen::Index>(shape_.at.size());
        const Matrix3X begin = Eigen::Map<const Matrix3X>(start_.data(), 3, count);
        Matrix3X at = begin;
        for (int i = 0; i < kProjections; ++i) {
            Sums sums{Matrix3X::Zero(3, count), Vector::Zero(count)};
            project_panels(at, sums);
            project_joins(at, sums);
            for (Eigen::Index j = 0; j < count; ++j) {
                sums.add(static_cast<int>(j), begin.col(j), hold());
                at.col(j) = sums.places.col(j) / sums.weights[j];
            }
        }
        return Eigen::Map<const Vector>(at.data(), at.size());
    }

    const Shape& shape_;
    const ShapeJoins& joins_;
    const SolveOptions& options_;
    Conditions conditions_;
    Vector start_;
    std::vector<Triplet> slopes_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
    bool analysed_ = false;
    int steps_ = 0;
    double moved_ = 0.0;   // by the last step
    bool settled_ = true;  // the last search did not end because it had made all its steps
};

}  // namespace

Solved solve_shape(const Shape& shape, const ShapeJoins& joins, const SolveOptions& options) {
    return Solver(shape, joins, options).run();
}

}  // namespace popup::folded
