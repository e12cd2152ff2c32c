// Laws of folds (Folded of popup/joints.h) for tests.
#pragma once

#include <vector>

#include "popup/joints.h"

namespace popup::test {

// The law of a function, in ranges between these openings.
template <typename Function>
std::vector<Vec2> law_of(const std::vector<double>& ends, const Function& function) {
    std::vector<Vec2> law{{ends.front(), function(ends.front())}};
    for (std::size_t r = 0; r + 1 < ends.size(); ++r) {
        for (std::size_t i = 1; i <= Folded::kLawSteps; ++i) {
            const double x = ends[r] + (ends[r + 1] - ends[r]) * chebyshev_share(i);
            law.push_back({x, function(x)});
        }
    }
    return law;
}

}  // namespace popup::test
