#include "folded/sine.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "folded/two.h"

namespace popup::folded {
namespace {

// A quarter turn in three parts: of the first two, products with whole numbers up to a million are exact
// (Cody and Waite, Software Manual for the Elementary Functions, 1980).
constexpr double kQuarter = 0x1.921fb544p+0;
constexpr double kQuarterNext = 0x1.0b4611a6p-34;
constexpr double kQuarterLast = 0x1.3198a2e037073p-69;

// What is added to a number far below it leaves it whole: the nearest one, as the C library's nearbyint()
// finds it with a call.
constexpr double kWhole = 0x1.8p52;

// Taylor's series, up to an eighth of a turn: what is left out is below 1e-19. Of one number, or of two.
template <typename Number>
Number sine_near(Number x) {
    const Number z = x * x;
    Number sum = 1.0 / 355687428096000.0 + z * (-1.0 / 121645100408832000.0);
    sum = -1.0 / 1307674368000.0 + z * sum;
    sum = 1.0 / 6227020800.0 + z * sum;
    sum = -1.0 / 39916800.0 + z * sum;
    sum = 1.0 / 362880.0 + z * sum;
    sum = -1.0 / 5040.0 + z * sum;
    sum = 1.0 / 120.0 + z * sum;
    sum = -1.0 / 6.0 + z * sum;
    return x + x * z * sum;
}

template <typename Number>
Number cosine_near(Number x) {
    const Number z = x * x;
    Number sum = -1.0 / 6402373705728000.0 + z * (1.0 / 2432902008176640000.0);
    sum = 1.0 / 20922789888000.0 + z * sum;
    sum = -1.0 / 87178291200.0 + z * sum;
    sum = 1.0 / 479001600.0 + z * sum;
    sum = -1.0 / 3628800.0 + z * sum;
    sum = 1.0 / 40320.0 + z * sum;
    sum = -1.0 / 720.0 + z * sum;
    sum = 1.0 / 24.0 + z * sum;
    const Number half = 0.5 * z;
    const Number most = 1.0 - half;
    // What the difference has lost to rounding comes back.
    return most + (((1.0 - most) - half) + z * z * sum);
}

// In quarter turns, and what is left of the angle.
template <typename Number>
struct Reduced {
    Number quarters, rest;

    explicit Reduced(Number angle) {
        quarters = angle * (2.0 / std::numbers::pi) + kWhole;
        quarters = quarters - kWhole;
        rest = ((angle - quarters * kQuarter) - quarters * kQuarterNext) - quarters * kQuarterLast;
    }
};

SineCosine turned(double quarters, double s, double c) {
    switch (static_cast<long long>(quarters) & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace

SineCosine sine_cosine(double angle) {
    const Reduced<double> by(angle);
    return turned(by.quarters, sine_near(by.rest), cosine_near(by.rest));
}

void sines_cosines(std::span<const double> angles, std::span<SineCosine> to) {
    std::size_t i = 0;
    for (; i + 2 <= angles.size(); i += 2) {
        const Reduced<Two> by(load(&angles[i]));
        const Two s = sine_near(by.rest);
        const Two c = cosine_near(by.rest);
        for (std::size_t k = 0; k < 2; ++k) to[i + k] = turned(by.quarters[k], s[k], c[k]);
    }
    if (i < angles.size()) to[i] = sine_cosine(angles[i]);
}

double angle_of(double sine, double cosine) {
    // As far as the C library says the same everywhere, and the rest from the sine of what is left.
    const double nearly = static_cast<float>(std::atan2(sine, cosine));
    const SineCosine at = sine_cosine(nearly);
    const double size = std::sqrt(sine * sine + cosine * cosine);
    return size > 0.0 ? nearly + (sine * at.cosine - cosine * at.sine) / size : nearly;
}

}  // namespace popup::folded
