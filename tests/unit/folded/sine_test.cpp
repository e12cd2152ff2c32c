#include "folded/sine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "support/random.h"

namespace popup::folded {
namespace {

constexpr long double kUnit = std::numeric_limits<double>::epsilon();

// In units of the last place of what is expected.
long double off(double value, long double expected) {
    if (value == expected) return 0.0L;
    return std::abs(value - expected) / (kUnit * std::exp2(std::floor(std::log2(std::abs(expected)))));
}

std::vector<double> angles() {
    std::vector<double> result{0.0, 1e-300, 1e-9, -1e-9};
    for (int i = -64; i <= 64; ++i) {
        for (const double by : {-1e-9, 0.0, 1e-9}) result.push_back(std::numbers::pi / 8.0 * i + by);
    }
    test::Random random(2);
    for (int i = 0; i < 100'000; ++i) {
        const double most = std::pow(10.0, 13.0 * random.unit() - 8.0);
        result.push_back(most * (2.0 * random.unit() - 1.0));
    }
    return result;
}

TEST(Sine, IsRightToThreeUnitsOfTheLastPlace) {
    long double worst = 0.0L;
    for (const double angle : angles()) {
        const auto [sine, cosine] = sine_cosine(angle);
        const auto exact = static_cast<long double>(angle);
        worst = std::max({worst, off(sine, std::sin(exact)), off(cosine, std::cos(exact))});
    }
    EXPECT_LT(worst, 3.0L);
}

TEST(Sine, ManyAtOnceHaveTheSameBits) {
    std::vector<double> all = angles();
    if (all.size() % 2 == 0) all.push_back(1.0);  // the last is alone
    std::vector<SineCosine> found(all.size());
    sines_cosines(all, found);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto [sine, cosine] = sine_cosine(all[i]);
        ASSERT_EQ(found[i].sine, sine) << all[i];
        ASSERT_EQ(found[i].cosine, cosine) << all[i];
    }
}

TEST(Sine, AnglesComeBack) {
    long double worst = 0.0L;
    for (const double angle : angles()) {
        if (std::abs(angle) > 3.0) continue;
        const auto exact = static_cast<long double>(angle);
        const auto sine = static_cast<double>(std::sin(exact));
        const auto cosine = static_cast<double>(std::cos(exact));
        for (const double size : {1.0, 7.0})
            worst = std::max(worst, off(angle_of(size * sine, size * cosine),
                                        std::atan2(static_cast<long double>(size * sine),
                                                   static_cast<long double>(size * cosine))));
    }
    EXPECT_LT(worst, 3.0L);
    EXPECT_EQ(angle_of(0.0, 1.0), 0.0);
    EXPECT_EQ(angle_of(0.0, 0.0), 0.0);
    EXPECT_NEAR(angle_of(0.0, -1.0), std::numbers::pi, 1e-15);
}

// These numbers were made by one processor, and have to come from any.
TEST(Sine, IsTheSameEverywhere) {
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const auto [sine, cosine] = sine_cosine(0.007 * i - 3.0);
        sum = 0.5 * sum + sine + 3.0 * cosine + angle_of(sine, cosine);
    }
    EXPECT_EQ(sum, -0x1.4260b0a505d56p+3);
}

}  // namespace
}  // namespace popup::folded
