#include "folded/least_step.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/nth.h"
#include "folded/corrections.h"

namespace popup::folded {
namespace {

// Steps of work of an entry of the normal equations.
constexpr double kNormalSteps = 8.0;

Eigen::SparseMatrix<double> normal_of(const Eigen::SparseMatrix<double>& a,
                                      const Eigen::SparseMatrix<double>& b, double regular) {
    // As a matrix: what one entry costs where a row is empty is up to how much room Eigen has kept.
    Eigen::SparseMatrix<double> identity(a.rows(), a.rows());
    identity.setIdentity();
    Eigen::SparseMatrix<double> normal = a * b;
    normal += regular * identity;
    return normal;
}

// Products that make the normal equations of these columns' rows.
double products_of(const Eigen::SparseMatrix<double>& columns) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < columns.outerSize(); ++i) {
        const double here = columns.outerIndexPtr()[i + 1] - columns.outerIndexPtr()[i];
        sum += here * here;
    }
    return sum;
}

// By equation, its place in an order of least degree.
std::vector<int> order_of(const Eigen::SparseMatrix<double>& normal) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> from;
    Eigen::AMDOrdering<int>()(normal, from);
    std::vector<int> order(static_cast<std::size_t>(normal.cols()));
    for (Eigen::Index i = 0; i < normal.cols(); ++i) nth(order, from.indices()[i]) = static_cast<int>(i);
    return order;
}

// About what factors of so many products take where it is a sheet that hangs together, as wide as long; those
// of a band take less.
double usual_factor_steps(double products) { return products * std::sqrt(products); }

}  // namespace

std::optional<LeastStep::Matrix> LeastStep::arrange(const Matrix& across, const Matrix& back, double regular,
                                                    Work& work) {
    const double of_rows = products_of(across);
    const double of_unknowns = products_of(back);
    const double fewer = std::min(of_rows, of_unknowns);
    if (!work.has(usual_factor_steps(fewer))) return std::nullopt;
    const auto analysed = [](const Matrix& normal) {
        auto factors = std::make_unique<SparseFactors>();
        factors->analyse(normal, order_of(normal));
        return factors;
    };
    of_unknowns_ = of_unknowns < of_rows;
    product_work_ = kNormalSteps * fewer;
    if (!work.spend(product_work_)) return std::nullopt;
    Matrix normal = normal_equations(across, back, regular);
    factors_ = analysed(normal);
    // The others' factors may be smaller, which is only looked at where it is likely.
    const double others = std::max(of_rows, of_unknowns);
    if (usual_factor_steps(others) >= factors_->steps()) return normal;
    if (!work.spend(kNormalSteps * others)) return std::nullopt;
    of_unknowns_ = !of_unknowns_;
    Matrix other_normal = normal_equations(across, back, regular);
    std::unique_ptr<SparseFactors> other = analysed(other_normal);
    if (kNormalSteps * others + other->steps() >= product_work_ + factors_->steps()) {
        of_unknowns_ = !of_unknowns_;
        return normal;
    }
    factors_ = std::move(other);
    product_work_ = kNormalSteps * others;
    return other_normal;
}

LeastStep::Matrix LeastStep::normal_equations(const Matrix& across, const Matrix& back,
                                              double regular) const {
    return of_unknowns_ ? normal_of(back, across, regular) : normal_of(across, back, regular);
}

std::optional<Eigen::VectorXd> LeastStep::find(const std::vector<Eigen::Triplet<double>>& slopes,
                                               Eigen::Index unknowns, const Eigen::VectorXd& residual,
                                               double regular, Work& work) {
    Matrix across(residual.size(), unknowns);
    across.setFromTriplets(slopes.begin(), slopes.end());
    const Matrix back = across.transpose();
    std::optional<Matrix> normal;
    if (factors_ == nullptr) {
        normal = arrange(across, back, regular, work);
        if (!normal) factors_.reset();
        if (!normal) return std::nullopt;
    }
    if (!work.spend(product_work_ + factors_->steps())) return std::nullopt;
    if (!normal) normal = normal_equations(across, back, regular);
    if (!factors_->factorise(*normal)) return std::nullopt;
    Eigen::VectorXd by = Eigen::VectorXd::Zero(unknowns);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(residual.size());
    CorrectionRate rate;
    const int solutions = add_corrections(by, rate, kUntilRounding, [&](Eigen::VectorXd& correction) {
        const Eigen::VectorXd left = -residual - across * by;
        if (of_unknowns_) {
            correction = back * left - regular * by;
            factors_->solve(correction);
            return;
        }
        Eigen::VectorXd more = left - regular * loads;
        factors_->solve(more);
        loads += more;
        correction = back * more;
    });
    work.spend(2.0 * solutions * (factors_->entries() + static_cast<double>(slopes.size())));
    if (!by.allFinite()) return std::nullopt;
    return by;
}

}  // namespace popup::folded
