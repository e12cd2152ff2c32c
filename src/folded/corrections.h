// Solutions that are corrected until only rounding is left.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace popup::folded {

// Adds to `solution` what `correct` writes, which sees the solution as it is, until the next correction would
// be of the size of rounding, or one is not half as large as that before it, which is left out then: of
// corrections that only follow rounding there is no end. The first is added whatever it is: if it is not
// finite, neither is the solution. Entries are of the size of 1, and what is less than rounding beside a
// thousandth of that is not looked for. Returns how often `correct` was asked.
template <typename Correct>
int add_corrections(Eigen::VectorXd& solution, const Correct& correct) {
    constexpr int kMost = 12;
    constexpr double kSmaller = 0.5;
    constexpr double kRounding = 1e-16;
    constexpr double kLeast = 1e-3;
    Eigen::VectorXd correction(solution.size());
    double before = HUGE_VAL;
    for (int i = 0; i < kMost; ++i) {
        correct(correction);
        const double size = correction.lpNorm<Eigen::Infinity>();
        if (i > 0 && !(size < kSmaller * before)) return i + 1;
        solution += correction;
        // Each is as small beside that before it as the next will be beside it.
        const double next = size * (size / before);
        if (i > 0 && next <= kRounding * std::fmax(kLeast, solution.lpNorm<Eigen::Infinity>())) return i + 1;
        before = size;
    }
    return kMost;
}

}  // namespace popup::folded
