// Bounds of motion over a range, against the motion itself.
#include "motion/drift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/joints/joint.h"
#include "motion/turn_law.h"
#include "support/laws.h"
#include "support/random.h"

namespace popup {
namespace {

using test::law_of;
using test::Random;

constexpr double kPi = 3.14159265358979323846;

double radians(double degrees) { return degrees * kPi / 180.0; }

TEST(TurnLaw, KnowsTheDerivatives) {
    // A polynomial of the twelfth degree, and its derivatives by hand: x^12 over [-1, 1], shifted.
    const std::vector<Vec2> law = law_of({20.0, 80.0}, [](double deg) {
        const double x = (deg - 50.0) / 30.0;
        return 40.0 * std::pow(x, 12.0) + 10.0 * x;
    });
    const TurnLaw turns(law);
    for (double deg = 21.0; deg < 79.0; deg += 0.7) {
        const double x = (deg - 50.0) / 30.0;
        const TurnRate rate = turns.rate(deg - 0.01, deg + 0.01);
        EXPECT_NEAR(rate.at_middle, (480.0 * std::pow(x, 11.0) + 10.0) / 30.0, 1e-9);
        const double second = std::abs(40.0 * 132.0 * std::pow(x, 10.0)) / 900.0 * 180.0 / kPi;
        EXPECT_GE(rate.change, second * (1.0 - 1e-9));
        // The third derivative, times half a range of 0.02 degrees, is what it is at most above it.
        EXPECT_LE(rate.change, second + radians(0.01) * 1.01 * 40.0 * 1320.0 / 27000.0 * 3300.0);
    }
    EXPECT_EQ(turns.rate(0.0, 10.0).most, 0.0);
    EXPECT_EQ(turns.rate(90.0, 100.0).most, 0.0);
}

TEST(TurnLaw, GoesStraightBetweenTwoPoints) {
    const TurnLaw turns(std::vector<Vec2>{{0.0, 90.0}, {180.0, 0.0}});
    const TurnRate rate = turns.rate(10.0, 30.0);
    EXPECT_DOUBLE_EQ(rate.at_middle, -0.5);
    EXPECT_DOUBLE_EQ(rate.most, 0.5);
    EXPECT_EQ(rate.change, 0.0);
    EXPECT_TRUE(rate.one_way);
}

TEST(TurnLaw, KnowsWhereALawMayTurnBack) {
    const auto angle = [](double x) { return 50.0 * std::sin(x * kPi / 90.0); };
    const std::vector<Vec2> law = law_of({0.0, 90.0, 180.0}, angle);
    const TurnLaw turns(law);
    int sure = 0;
    for (double from = 0.0; from < 180.0; from += 2.5) {
        const double to = from + 2.5;
        const TurnRate rate = turns.rate(from, to);
        // It turns back at 45 and 135 degrees.
        const bool turns_back = (from <= 45.0 && 45.0 < to) || (from <= 135.0 && 135.0 < to);
        EXPECT_FALSE(turns_back && rate.one_way) << from;
        sure += rate.one_way ? 1 : 0;
        for (double x = from; x < to; x += 0.01) {
            const double slope = (fold_angle_deg(law, x + 0.005) - fold_angle_deg(law, x - 0.005)) / 0.01;
            EXPECT_LE(std::abs(slope), rate.most + 1e-3) << x;
        }
    }
    EXPECT_GE(sure, 60);  // of 72
}

// Folds on one another, each with a law; the first stands on a plate that stands still.
struct Chain {
    std::vector<Joint> joints;
    [[nodiscard]] std::vector<Frame> at(double deg) const {
        std::vector<Frame> frames(joints.size());
        for (const Joint& joint : joints) EXPECT_TRUE(place_plates(joint, Angle::degrees(deg), frames));
        return frames;
    }
};

Chain random_chain(Random& random, int length) {
    Chain chain;
    chain.joints.push_back({"", {}, Still{0}});
    // Now and then all lines meet in one point, as around a corner.
    const bool corner = random.below(3) == 0;
    for (int i = 1; i <= length; ++i) {
        Folded how;
        how.plate = i;
        how.base = i - 1;
        const double way = random.unit() * 2.0 * kPi;
        how.at = corner ? Vec2{30.0, 40.0} : Vec2{100.0 * random.unit(), 100.0 * random.unit()};
        how.dir = {std::cos(way), std::sin(way)};
        const double swing = (i % 2 == 0 ? 1.0 : -1.0) * (60.0 + 60.0 * random.unit());
        const double wave = 20.0 * random.unit();
        how.law = law_of({0.0, 60.0, 180.0}, [&](double x) {
            return swing * (1.0 - x / 180.0) + wave * std::sin(x * kPi / 60.0);
        });
        chain.joints.push_back({"", {}, how});
    }
    return chain;
}

TEST(Drift, BoundsHowFarPointsMove) {
    Random random(42);
    double tightest = 1e300;
    double by_turns = 0.0;
    double by_drift = 0.0;
    for (int round = 0; round < 200; ++round) {
        const Chain chain = random_chain(random, 1 + static_cast<int>(random.below(12)));
        const std::size_t last = chain.joints.size() - 1;
        const double half = 0.1 + 3.0 * random.unit();
        const double middle =
            random.below(2) == 0 ? 60.0 - half - 50.0 * random.unit() : 60.0 + half + 110.0 * random.unit();
        const double from = middle - half;
        const double to = middle + half;
        const std::vector<Frame> frames = chain.at(middle);
        Drift drift(radians(half));
        double sum = 0.0;
        for (std::size_t i = 1; i <= last; ++i) {
            const auto& how = std::get<Folded>(chain.joints[i].how);
            const TurnRate rate = TurnLaw(how.law).rate(from, to);
            drift.turn(frames[i].point(how.at), frames[i].direction(how.dir), rate, 1.0);
            sum += radians(half) * rate.most;
        }
        const Vec2 point{200.0 * random.unit() - 50.0, 200.0 * random.unit() - 50.0};
        const double bound = drift.of(frames[last].point(point));
        double furthest = 0.0;
        double turned = 0.0;
        for (int k = 0; k <= 40; ++k) {
            const std::vector<Frame> there = chain.at(from + (to - from) * k / 40.0);
            furthest = std::max(furthest, distance(there[last].point(point), frames[last].point(point)));
            // The angle of the turn from here to there, by its trace.
            double trace = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                trace += dot(there[last].axes.at(axis), frames[last].axes.at(axis));
            turned = std::max(turned, std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0)));
        }
        EXPECT_LE(furthest, bound * (1.0 + 1e-9) + 1e-9) << round;
        EXPECT_LE(turned, drift.turns() + 1e-6) << round;
        if (furthest > 1e-6) tightest = std::min(tightest, bound / furthest);
        by_turns += sum;
        by_drift += drift.turns();
    }
    // The bound is of use: sometimes it is met, and chains turn far less than their folds.
    EXPECT_LT(tightest, 1.05);
    EXPECT_LT(by_drift, 0.8 * by_turns);
}

}  // namespace
}  // namespace popup
