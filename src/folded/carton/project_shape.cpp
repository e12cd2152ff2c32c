#include "folded/carton/project_shape.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/nth.h"

namespace popup::folded {
namespace {

using Vector = Eigen::VectorXd;
using Matrix3X = Eigen::Matrix3Xd;

constexpr int kProjections = 400;
// Merged vertices and planes against panels, in projections.
constexpr double kJoinWeight = 4.0;
// The sine of an angle, by axes as long as one another: so nearly in a line corners say nothing of how the
// panel is turned about it.
constexpr double kInLine = 1e-9;

struct Sums {
    Matrix3X places;
    Vector weights;
    void add(int vertex, const Eigen::Vector3d& place, double weight) {
        places.col(vertex) += weight * place;
        weights[vertex] += weight;
    }
};

Matrix3X columns(const Matrix3X& all, const std::vector<int>& vertices) {
    Matrix3X some(3, static_cast<Eigen::Index>(vertices.size()));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        some.col(static_cast<Eigen::Index>(i)) = all.col(vertices[i]);
    return some;
}

// A panel about its middle.
class Fit {
 public:
    explicit Fit(const Shape::Panel& panel) : panel_(panel), flat_(panel.flat) {
        Vec2 middle;
        for (const Vec2 one : flat_) middle = middle + one;
        middle = (1.0 / static_cast<double>(flat_.size())) * middle;
        for (Vec2& one : flat_) one = one - middle;
    }

    // Adds where the panel fits its corners best. What turns a flat figure are two axes in space, those
    // nearest to A = sum of place times corner': the first factor of the polar decomposition of A, A
    // (A'A)^(-1/2), which for two columns has a closed form.
    void add(const Matrix3X& at, Sums& sums) const {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (const int vertex : panel_.vertices) middle += at.col(vertex);
        middle /= static_cast<double>(flat_.size());
        Eigen::Vector3d a = Eigen::Vector3d::Zero();
        Eigen::Vector3d b = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < flat_.size(); ++i) {
            const Eigen::Vector3d way = at.col(panel_.vertices[i]) - middle;
            a += flat_[i].x * way;
            b += flat_[i].y * way;
        }
        const double aa = a.squaredNorm();
        const double bb = b.squaredNorm();
        const double ab = a.dot(b);
        const double root = a.cross(b).norm();  // of the determinant of A'A
        if (!(root > kInLine * (aa + bb))) return add_in_line(at, sums);
        const double scale = 1.0 / (root * std::sqrt(aa + bb + 2.0 * root));
        const Eigen::Vector3d x = scale * ((bb + root) * a - ab * b);
        const Eigen::Vector3d y = scale * ((aa + root) * b - ab * a);
        for (std::size_t i = 0; i < flat_.size(); ++i)
            sums.add(panel_.vertices[i], middle + flat_[i].x * x + flat_[i].y * y, 1.0);
    }

 private:
    // Any of the best will do.
    void add_in_line(const Matrix3X& at, Sums& sums) const {
        const Matrix3X now = columns(at, panel_.vertices);
        Matrix3X flat = Matrix3X::Zero(3, now.cols());
        for (std::size_t i = 0; i < flat_.size(); ++i)
            flat.col(static_cast<Eigen::Index>(i)).head<2>() << flat_[i].x, flat_[i].y;
        const Eigen::Matrix4d best = Eigen::umeyama(flat, now, false);
        const Matrix3X fit = (best.topLeftCorner<3, 3>() * flat).colwise() + best.col(3).head<3>();
        for (std::size_t i = 0; i < flat_.size(); ++i)
            sums.add(panel_.vertices[i], fit.col(static_cast<Eigen::Index>(i)), 1.0);
    }

    const Shape::Panel& panel_;
    std::vector<Vec2> flat_;
};

void project_joins(const Shape& shape, const ShapeJoins& joins, const Matrix3X& at, Sums& sums) {
    for (const std::vector<int>& group : joins.merged) {
        const Eigen::Vector3d mean = columns(at, group).rowwise().mean();
        for (const int vertex : group) sums.add(vertex, mean, kJoinWeight);
    }
    for (const auto& [a, b] : joins.in_a_plane) {
        std::vector<int> both = nth(shape.panels, a).vertices;
        const std::vector<int>& others = nth(shape.panels, b).vertices;
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

}  // namespace

Vector project_shape(const Shape& shape, const ShapeJoins& joins, const Vector& start, double hold) {
    const auto count = static_cast<Eigen::Index>(shape.at.size());
    const Matrix3X begin = Eigen::Map<const Matrix3X>(start.data(), 3, count);
    const std::vector<Fit> fits(shape.panels.begin(), shape.panels.end());
    Matrix3X at = begin;
    Sums sums;
    for (int i = 0; i < kProjections; ++i) {
        sums.places.setZero(3, count);
        sums.weights.setZero(count);
        for (const Fit& fit : fits) fit.add(at, sums);
        project_joins(shape, joins, at, sums);
        for (Eigen::Index j = 0; j < count; ++j) {
            sums.add(static_cast<int>(j), begin.col(j), hold);
            at.col(j) = sums.places.col(j) / sums.weights[j];
        }
    }
    return Eigen::Map<const Vector>(at.data(), at.size());
}

}  // namespace popup::folded
