// The smallest step that brings residuals to nought, to the first order.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "folded/sparse_factors.h"
#include "folded/work.h"

namespace popup::folded {

// With slopes J and a small `regular` d the least x with J x = -r is
//
//     -Jᵀ (J Jᵀ + d)⁻¹ r  =  -(Jᵀ J + d)⁻¹ Jᵀ r
//
// and is found from as many equations as there are residuals or unknowns: those of fewer products, or the
// others if these are not too many to look at them and their factors are smaller. Which they are, and their
// order, is looked for once for all questions. Cost: that of the factors, and linear in the numbers of
// residuals and unknowns, whether a slope says anything of them or not.
class LeastStep {
 public:
    // Slopes as entries (row: residual, column: unknown), in the same order in each question: values alone
    // may differ. nullopt if the equations cannot be solved, or if `work`, which pays for it, does not do.
    std::optional<Eigen::VectorXd> find(const std::vector<Eigen::Triplet<double>>& slopes,
                                        Eigen::Index unknowns, const Eigen::VectorXd& residual,
                                        double regular, Work& work);

 private:
    using Matrix = Eigen::SparseMatrix<double>;
    // The equations, of which all but the values stay; nullopt if the work does not do for it.
    std::optional<Matrix> arrange(const Matrix& across, const Matrix& back, double regular, Work& work);
    [[nodiscard]] Matrix normal_equations(const Matrix& across, const Matrix& back, double regular) const;

    std::unique_ptr<SparseFactors> factors_;  // none before the first question
    bool of_unknowns_ = false;
    double product_work_ = 0.0;  // to make the normal equations
};

}  // namespace popup::folded
