// Solutions that are corrected until only rounding is left.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace popup::folded {

// How large a correction is at most beside the one before it, as far as some factors have shown.
struct CorrectionRate {
    double most = 0.0;
    bool known = false;
};

constexpr int kUntilRounding = 12;  // corrections: more than are ever needed

// Adds to `solution` what `correct` writes, which sees the solution as it is, until the next correction would
// be of the size of rounding, or one is not half as large as that before it, which is left out then: of
// corrections that only follow rounding there is no end. The first is added whatever it is: if it is not
// finite, neither is the solution. What solutions are added to is of the size of 1, and less than rounding
// beside that is not looked for. `rate`: of what was solved with the same factors before; a small step near
// the end needs no second look then. `most`: corrections, for who corrects what is left on his own. Returns
// how often `correct` was asked.
template <typename Correct>
int add_corrections(Eigen::VectorXd& solution, CorrectionRate& rate, int most, const Correct& correct) {
    constexpr double kSmaller = 0.5;
    constexpr double kRounding = 1e-16;
    Eigen::VectorXd correction(solution.size());
    double before = HUGE_VAL;
    for (int i = 0; i < most; ++i) {
        correct(correction);
        const double size = correction.lpNorm<Eigen::Infinity>();
        if (i > 0 && !(size < kSmaller * before)) return i + 1;
        solution += correction;
        if (i > 0) {
            rate.most = std::fmax(rate.most, size / before);
            rate.known = true;
        }
        // Each is as small beside that before it as the next will be beside it.
        const double next = size * (i > 0 ? size / before : rate.known ? rate.most : kSmaller);
        if (next <= kRounding * std::fmax(1.0, solution.lpNorm<Eigen::Infinity>())) return i + 1;
        before = size;
    }
    return most;
}

}  // namespace popup::folded
