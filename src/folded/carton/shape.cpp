#include "folded/carton/shape.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "folded/carton/project_shape.h"
#include "folded/carton/shape_conditions.h"

namespace popup::folded {
namespace {

using Vector = Eigen::VectorXd;

constexpr double kLeastDamping = 1e-12;
constexpr double kNoHope = 1e8;        // so much damping, and no step helps
constexpr double kStandsStill = 1e-3;  // a step gains less than this share
constexpr double kSmallStep = 1e-5;    // of the size

double most(const Vector& residuals) {
    return residuals.size() == 0 ? 0.0 : residuals.lpNorm<Eigen::Infinity>();
}

Vec3 place_of(const Vector& x, std::size_t vertex) {
    const auto at = 3 * static_cast<Eigen::Index>(vertex);
    return {x[at], x[at + 1], x[at + 2]};
}

class Solver {
 public:
    Solver(const Shape& shape, const ShapeJoins& joins, const SolveOptions& options)
        : shape_(shape), joins_(joins), options_(options), conditions_(shape, joins) {
        start_.resize(3 * static_cast<Eigen::Index>(shape.at.size()));
        for (std::size_t i = 0; i < shape.at.size(); ++i)
            start_.segment<3>(3 * static_cast<Eigen::Index>(i)) << shape.at[i].x, shape.at[i].y,
                shape.at[i].z;
    }

    Solved run() {
        Found found = search(start_);
        bool projected = false;
        if (most(found.left) > enough()) {
            if (Found second = search(project_shape(shape_, joins_, start_, hold()));
                most(second.left) < most(found.left)) {
                found = std::move(second);
                projected = true;
            }
        }
        return told(found, projected);
    }

 private:
    // Places, and what they leave open.
    struct Found {
        Vector x;
        Vector left;
        bool settled = true;  // the search did not end because it had made all its steps
    };

    [[nodiscard]] double enough() const { return options_.enough * options_.size_mm; }
    [[nodiscard]] double hold() const { return options_.hold * options_.hold; }

    [[nodiscard]] Solved told(const Found& found, bool projected) const {
        Solved result;
        for (std::size_t i = 0; i < shape_.at.size(); ++i) result.at.push_back(place_of(found.x, i));
        result.residual_mm = most(found.left);
        result.closes = result.residual_mm <= enough();
        result.steps = steps_;
        result.projected = projected;
        result.settled = found.settled || result.closes;
        if (!result.closes) {
            Eigen::Index row = 0;
            found.left.cwiseAbs().maxCoeff(&row);
            std::tie(result.worst, result.number) = conditions_.owner(row);
        }
        return result;
    }

    // One step; false where none helps. `held`: the soft conditions count.
    bool step(Found& at, double& damping, bool held, double& gain) {
        conditions_.linearise(at.x, at.left, normal_, slope_);
        const auto cost_of = [&](const Vector& x, const Vector& left) {
            double cost = left.squaredNorm();
            if (held) cost += hold() * (x - start_).squaredNorm();
            return cost;
        };
        if (held) slope_ += hold() * (at.x - start_);
        const double before = cost_of(at.x, at.left);
        for (; damping < kNoHope; damping *= 8.0) {
            if (!conditions_.system().factorize(normal_, damping + (held ? hold() : 0.0))) continue;
            next_.x = slope_;
            conditions_.system().solve(next_.x);
            next_.x = at.x - next_.x;
            conditions_.evaluate(next_.x, next_.left);
            const double after = cost_of(next_.x, next_.left);
            if (!(after < before)) continue;
            gain = 1.0 - after / before;
            moved_ = (next_.x - at.x).lpNorm<Eigen::Infinity>();
            std::swap(at.x, next_.x);
            std::swap(at.left, next_.left);
            damping = std::max(kLeastDamping, damping / 8.0);
            return true;
        }
        return false;
    }

    Found search(Vector from) {
        Found at{std::move(from), {}};
        conditions_.evaluate(at.x, at.left);
        double damping = 1e-3;
        double gain = 1.0;
        int slow = 0;
        for (int i = 0; i < options_.steps_at_most && slow < 3; ++i, ++steps_) {
            if (!step(at, damping, true, gain)) break;
            slow = gain < kStandsStill ? slow + 1 : 0;
        }
        // The soft conditions have a share in every place: without them the rest closes to the last digit.
        damping = 1e-6;
        slow = 0;
        for (int i = 0; i < options_.steps_at_most && slow < 5; ++i, ++steps_) {
            if (most(at.left) <= 1e-3 * enough()) break;
            if (!step(at, damping, false, gain)) break;
            // Where conditions are tangent, little is gained by steps that lead far nevertheless.
            slow = gain < kStandsStill && moved_ < kSmallStep * options_.size_mm ? slow + 1 : 0;
            at.settled = i + 1 < options_.steps_at_most;
        }
        return at;
    }

    const Shape& shape_;
    const ShapeJoins& joins_;
    const SolveOptions& options_;
    ShapeConditions conditions_;
    Vector start_;
    std::vector<double> normal_;  // of the step that is being made, as are these
    Vector slope_;
    Found next_;
    int steps_ = 0;
    double moved_ = 0.0;  // by the last step
};

}  // namespace

Solved solve_shape(const Shape& shape, const ShapeJoins& joins, const SolveOptions& options) {
    return Solver(shape, joins, options).run();
}

}  // namespace popup::folded
