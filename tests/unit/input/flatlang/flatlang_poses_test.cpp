// Where FlatLang's turtle stands, and which way it faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "input/flatlang/turtle/turtle.h"

namespace popup::flatlang {
namespace {

constexpr std::uint64_t plenty = 1'000'000;

// Turned by matrices, one after the other.
class NaiveWalk {
 public:
    void forward(double d) {
        for (std::size_t i = 0; i < 3; ++i) at_[i] += d * frame_[i][1];
    }
    // About axis `axis` of its own, right-handed.
    void turn(std::size_t axis, double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        const std::size_t a = (axis + 1) % 3;
        const std::size_t b = (axis + 2) % 3;
        Matrix turned = frame_;
        for (std::size_t i = 0; i < 3; ++i) {
            turned[i][a] = std::cos(angle) * frame_[i][a] + std::sin(angle) * frame_[i][b];
            turned[i][b] = std::cos(angle) * frame_[i][b] - std::sin(angle) * frame_[i][a];
        }
        frame_ = turned;
    }
    [[nodiscard]] Pose pose() const {
        const auto column = [this](std::size_t c) { return Vec3{frame_[0][c], frame_[1][c], frame_[2][c]}; };
        return {{at_[0], at_[1], at_[2]}, column(0), column(1), column(2)};
    }

 private:
    using Matrix = std::array<std::array<double, 3>, 3>;
    std::array<double, 3> at_{};
    Matrix frame_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

double apart(const Pose& a, const Pose& b) {
    return std::max({distance(a.at, b.at), distance(a.right, b.right), distance(a.heading, b.heading),
                     distance(a.up, b.up)});
}

TEST(FlatlangPoses, PosesAreThoseOfTurnsMultipliedAlsoOnBranches) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        Turtle turtle(seed % 2 == 0, plenty);
        NaiveWalk walk;
        std::vector<NaiveWalk> at_marks;
        for (int i = 0; i < 600; ++i) {
            const double amount = static_cast<double>(random() % 2001) / 7.0 - 140.0;
            switch (random() % 7) {
                case 0:
                case 1:
                    turtle.forward(amount / 100);
                    walk.forward(amount / 100);
                    break;
                case 2:
                    turtle.left(amount);
                    walk.turn(2, amount);
                    break;
                case 3:
                    turtle.roll(amount);
                    walk.turn(1, amount);
                    break;
                case 4:
                    turtle.pitch(amount);
                    walk.turn(0, amount);
                    break;
                case 5:
                    turtle.mark(std::to_string(at_marks.size()));
                    at_marks.push_back(walk);
                    break;
                case 6: {
                    if (at_marks.empty()) break;
                    const std::size_t mark = random() % at_marks.size();
                    if (turtle.back_to(std::to_string(mark))) walk = at_marks[mark];
                    break;
                }
            }
            if (random() % 4 != 0) continue;
            ASSERT_LT(apart(turtle.pose(), walk.pose()), 1e-9) << seed << " " << i;
        }
        EXPECT_LT(apart(turtle.trail().last, walk.pose()), 1e-9);
    }
}

TEST(FlatlangPoses, PosesAreWhatTheDrawingSaysAfterAnyReplacement) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        std::mt19937 random(seed);
        Turtle turtle(false, plenty);
        const std::array<std::string, 3> names{"a", "b", "c"};
        for (int i = 0; i < 300; ++i) {
            switch (random() % 8) {
                case 0:
                    turtle.forward(1);
                    break;
                case 1:
                    turtle.left(30);
                    break;
                case 2:
                    turtle.pitch(50);
                    break;
                case 3:
                case 4:
                    turtle.mark(names[random() % 3]);
                    break;
                case 5:
                    turtle.back_to(names[random() % 3]);
                    break;
                case 6:
                    turtle.begin_replacement(names[random() % 3], names[random() % 3], random() % 4 == 0);
                    turtle.roll(20);
                    turtle.forward(0.5);
                    if (random() % 2 == 0) turtle.mark(names[random() % 3]);
                    turtle.end_replacement();
                    break;
                case 7:
                    turtle.draw_to({1, 2, 3}, 0.5);
                    break;
            }
            if (random() % 3 != 0) continue;
            ASSERT_LT(apart(turtle.pose(), turtle.trail().last), 1e-9) << seed;
        }
    }
}

TEST(FlatlangPoses, PosesStaySquareOverAMillionTurns) {
    Turtle turtle(false, plenty);
    for (int i = 0; i < 1'000'000; ++i) {
        switch (i % 3) {
            case 0:
                turtle.left(0.1F);
                break;
            case 1:
                turtle.roll(37.3F);
                break;
            case 2:
                turtle.pitch(-121.7F);
                break;
        }
    }
    const Pose pose = turtle.pose();
    EXPECT_NEAR(length(pose.right), 1, 1e-12);
    EXPECT_NEAR(length(pose.heading), 1, 1e-12);
    EXPECT_NEAR(dot(pose.right, pose.heading), 0, 1e-12);
    EXPECT_LT(distance(cross(pose.right, pose.heading), pose.up), 1e-12);
}

TEST(FlatlangPoses, FacingALotAddsUpNoErrors) {
    for (const bool as_2008 : {false, true}) {
        Turtle turtle(as_2008, plenty);
        turtle.left(33);
        turtle.pitch(21);
        turtle.roll(54);
        const Pose wanted = turtle.pose();
        for (int i = 0; i < 1000; ++i) {
            turtle.left(7);
            turtle.face(wanted);
        }
        EXPECT_LT(apart(turtle.pose(), wanted), 1e-9);
        EXPECT_EQ(turtle.trail().segments.size(), 0U);
    }
}

TEST(FlatlangPoses, FacingWhatIsNoFrameFacesTheNearest) {
    Turtle turtle(false, plenty);
    Pose askew;
    askew.heading = {0, 0, 2};
    askew.right = {1, 0, 1};
    askew.up = {5, 5, 5};
    turtle.face(askew);
    EXPECT_LT(apart(turtle.pose(), {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}), 1e-9);
    askew.heading = {};
    turtle.face(askew);
    EXPECT_LT(apart(turtle.pose(), {}), 1e-9);
}

}  // namespace
}  // namespace popup::flatlang
