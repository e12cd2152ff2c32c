// The digits of an assembly: each number is the one that its text says.
#include "assembly/settle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "output/emit.h"
#include "support/designs.h"
#include "support/random.h"

namespace popup {
namespace {

TEST(Settle, NumbersMoveByLessThanHalfAStep) {
    test::Random random(1);
    for (int i = 0; i < 100'000; ++i) {
        const double value = (random.unit() - 0.5) * std::pow(10.0, 12.0 * random.unit() - 6.0);
        const double once = settled(value, kLengthsPerMm);
        EXPECT_LE(std::abs(once - value), 0.5 / kLengthsPerMm + 2e-16 * std::abs(value));
        EXPECT_EQ(settled(once, kLengthsPerMm), once);
        // What JSON writes of it and reads again.
        EXPECT_EQ(nlohmann::json::parse(nlohmann::json(once).dump()).get<double>(), once);
    }
}

TEST(Settle, LargeNumbersAndOddOnesStayWhatTheyAre) {
    for (const double value : {1e300, -3.5e15, 1e18, HUGE_VAL})
        EXPECT_EQ(settled(value, kLengthsPerMm), value);
    EXPECT_TRUE(std::isnan(settled(NAN, kLengthsPerMm)));
    EXPECT_FALSE(std::signbit(settled(-1e-20, kLengthsPerMm)));
}

TEST(Settle, AnglesComeBackFromDegrees) {
    test::Random random(2);
    for (int i = 0; i < 100'000; ++i) {
        const double deg = settled_degrees(3.2 * random.unit());
        EXPECT_EQ(settled_degrees(radians_of(deg)), deg);
    }
    EXPECT_EQ(settled_degrees(radians_of(90.0)), 90.0);
}

// By the text, which has all numbers.
TEST(Settle, WhatIsAssembledIsSettled) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const test::Built built = test::build(test::generate(seed, 6));
        Assembly assembly = *built.assembly;
        const Vec2 corner = assembly.plates.back().outline.outer.front();
        settle_numbers(assembly);
        EXPECT_EQ(assembly.plates.back().outline.outer.front(), corner);
        EXPECT_EQ(emit_assembly(assembly), emit_assembly(*built.assembly));
    }
}

}  // namespace
}  // namespace popup
