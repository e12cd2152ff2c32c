// Two numbers side by side: what any processor of 64 bits reckons at once, each as if it were alone, so that
// bits are those of one after the other.
#pragma once

#include <cstring>

namespace popup::folded {

using Two = double __attribute__((vector_size(2 * sizeof(double))));

inline Two load(const double* from) {
    Two two;
    std::memcpy(&two, from, sizeof(two));
    return two;
}

inline void store(double* to, Two two) { std::memcpy(to, &two, sizeof(two)); }

}  // namespace popup::folded
