// The smallest step that brings residuals to nought, to the first order.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "folded/work.h"

namespace popup::folded {

// Of slopes given as entries (row: residual, column: unknown) the least x with slopes x = -residual, by the
// normal equations with `regular` on their diagonal. nullopt if they cannot be solved, or if `work`, which
// pays for it, does not do.
std::optional<Eigen::VectorXd> least_step(const std::vector<Eigen::Triplet<double>>& slopes,
                                          Eigen::Index unknowns, const Eigen::VectorXd& residual,
                                          double regular, Work& work);

}  // namespace popup::folded
