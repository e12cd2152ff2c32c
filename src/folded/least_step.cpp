#include "folded/least_step.h"

#include <Eigen/SparseCholesky>
#include <cmath>

#include "base/nth.h"
#include "folded/corrections.h"

namespace popup::folded {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Steps of work of an entry of the normal equations.
constexpr double kNormalSteps = 8.0;

// Says what its factors take, once the pattern has been analysed.
class CountedLdlt : public Eigen::SimplicialLDLT<Matrix> {
 public:
    [[nodiscard]] double steps() const {
        double sum = 0.0;
        for (Eigen::Index i = 0; i < m_nonZerosPerCol.size(); ++i) {
            const double below = m_nonZerosPerCol[i] + 1.0;
            sum += below * below;
        }
        return sum;
    }
};

}  // namespace

std::optional<Eigen::VectorXd> least_step(const std::vector<Eigen::Triplet<double>>& slopes,
                                          Eigen::Index unknowns, const Eigen::VectorXd& residual,
                                          double regular, Work& work) {
    std::vector<double> rows_of(static_cast<std::size_t>(unknowns), 0.0);
    for (const Eigen::Triplet<double>& entry : slopes) nth(rows_of, entry.col()) += 1.0;
    double entries = 0.0;
    for (const double rows : rows_of) entries += rows * rows;
    // Factors of what hangs together like a sheet, and of what all hangs together, take about this much.
    if (!work.has(std::pow(entries, 1.5)) || !work.spend(kNormalSteps * entries)) return std::nullopt;
    Matrix across(residual.size(), unknowns);
    across.setFromTriplets(slopes.begin(), slopes.end());
    const Matrix transposed = across.transpose();
    Matrix normal = across * transposed;
    for (Eigen::Index i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += regular;
    CountedLdlt solver;
    solver.analyzePattern(normal);
    if (!work.spend(solver.steps())) return std::nullopt;
    solver.factorize(normal);
    if (solver.info() != Eigen::Success) return std::nullopt;
    Eigen::VectorXd by = Eigen::VectorXd::Zero(unknowns);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(residual.size());
    add_corrections(by, [&](Eigen::VectorXd& correction) {
        const Eigen::VectorXd left = -residual - across * by - regular * loads;
        const Eigen::VectorXd more = solver.solve(left);
        loads += more;
        correction = transposed * more;
    });
    if (!by.allFinite()) return std::nullopt;
    return by;
}

}  // namespace popup::folded
