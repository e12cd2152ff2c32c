// Two doubles at a time. Each is what it would be alone, to the last bit.
#pragma once

#include <algorithm>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace popup {

struct Two {
#ifdef __SSE2__
    __m128d both;
    static Two at(const double* values) { return {_mm_loadu_pd(values)}; }
    static Two alike(double value) { return {_mm_set1_pd(value)}; }
    static Two of(double first, double second) { return {_mm_set_pd(second, first)}; }
    friend Two operator-(Two a, Two b) { return {_mm_sub_pd(a.both, b.both)}; }
    friend Two operator*(Two a, Two b) { return {_mm_mul_pd(a.both, b.both)}; }
    friend Two operator/(Two a, Two b) { return {_mm_div_pd(a.both, b.both)}; }
    friend Two lesser(Two a, Two b) { return {_mm_min_pd(a.both, b.both)}; }
    friend Two greater(Two a, Two b) { return {_mm_max_pd(a.both, b.both)}; }
    [[nodiscard]] double first() const { return _mm_cvtsd_f64(both); }
    [[nodiscard]] double second() const { return _mm_cvtsd_f64(_mm_unpackhi_pd(both, both)); }
#else
    double one, other;
    static Two at(const double* values) { return {values[0], values[1]}; }
    static Two alike(double value) { return {value, value}; }
    static Two of(double first, double second) { return {first, second}; }
    friend Two operator-(Two a, Two b) { return {a.one - b.one, a.other - b.other}; }
    friend Two operator*(Two a, Two b) { return {a.one * b.one, a.other * b.other}; }
    friend Two operator/(Two a, Two b) { return {a.one / b.one, a.other / b.other}; }
    friend Two lesser(Two a, Two b) { return {std::min(a.one, b.one), std::min(a.other, b.other)}; }
    friend Two greater(Two a, Two b) { return {std::max(a.one, b.one), std::max(a.other, b.other)}; }
    [[nodiscard]] double first() const { return one; }
    [[nodiscard]] double second() const { return other; }
#endif
    [[nodiscard]] double least() const { return std::min(first(), second()); }
    [[nodiscard]] double most() const { return std::max(first(), second()); }
};

}  // namespace popup
