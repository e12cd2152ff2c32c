// The turtle of FlatLang: where it goes, what its shapes and replacements draw, and which loops are polygons.
#include "input/flatlang/turtle.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "input/flatlang/original_files.h"
#include "input/flatlang/polygons.h"

namespace popup::flatlang {
namespace {

constexpr std::uint64_t plenty = 1'000'000;

std::string text(Vec3 p) {
    const auto number = [](double v) {
        std::string digits = fmt::format("{:.4f}", v);
        digits.erase(digits.find_last_not_of('0') + 1);
        if (digits.back() == '.') digits.pop_back();
        return digits == "-0" ? "0" : digits;
    };
    return number(p.x) + " " + number(p.y) + " " + number(p.z);
}

// "0 0 0 > 0 1 0": a line each; a step that goes on where the last ended begins with ">".
std::string segments(const Trail& trail) {
    std::string out;
    std::string last;
    for (const TrailSegment& segment : trail.segments) {
        const std::string from = text(segment.from);
        if (from != last) out += (out.empty() ? "" : "\n") + from;
        last = text(segment.to);
        out += " > " + last;
        if (segment.part != 0) out += " [" + trail.parts[static_cast<std::size_t>(segment.part)].name + "]";
    }
    return out;
}

std::string polygons(const Trail& trail) {
    std::string out;
    for (const TrailPolygon& polygon : trail.polygons) {
        if (!out.empty()) out += "\n";
        if (polygon.part != 0) out += trail.parts[static_cast<std::size_t>(polygon.part)].name + ": ";
        for (std::size_t i = 0; i < polygon.points.size(); ++i) {
            out += (i == 0 ? "" : ", ") + text(polygon.points[i]);
        }
    }
    return out;
}

std::string pose(const Pose& pose) {
    return text(pose.at) + " | " + text(pose.right) + " | " + text(pose.heading) + " | " + text(pose.up);
}

void square(Turtle& turtle, double side) {
    for (int i = 0; i < 4; ++i) {
        turtle.forward(side);
        turtle.left(90);
    }
}

TEST(FlatlangTurtle, ANewTurtleStandsAtTheOriginAndHeadsAlongY) {
    Turtle turtle(false, plenty);
    EXPECT_EQ(pose(turtle.pose()), "0 0 0 | 1 0 0 | 0 1 0 | 0 0 1");
    EXPECT_TRUE(turtle.trail().segments.empty());
    EXPECT_EQ(turtle.trail().parts.size(), 1U);
}

TEST(FlatlangTurtle, TurnsAreRightHandedAboutItsOwnAxes) {
    Turtle turtle(false, plenty);
    turtle.forward(1);
    turtle.left(90);
    turtle.forward(1);
    EXPECT_EQ(text(turtle.pose().at), "-1 1 0");
    turtle.left(-90);
    turtle.roll(90);
    turtle.left(90);
    turtle.forward(1);
    EXPECT_EQ(text(turtle.pose().at), "-1 1 1");
    turtle.left(-90);
    turtle.roll(-90);
    turtle.pitch(90);
    turtle.forward(1);
    EXPECT_EQ(text(turtle.pose().at), "-1 1 2");
    turtle.pitch(-90);
    turtle.forward(-2);
    turtle.left(30);
    turtle.roll(20);
    turtle.pitch(10);
    turtle.forward(1.5);
    EXPECT_EQ(pose(turtle.pose()),
              "-1.6615 0.3238 2.2448 | 0.8138 0.4698 -0.342 | -0.441 0.8826 0.1632 | 0.3785 0.018 0.9254");
    EXPECT_EQ(pose(turtle.trail().last), pose(turtle.pose()));
}

TEST(FlatlangTurtle, GoingBackGrowsABranchFromTheNearestMarkAbove) {
    Turtle turtle(false, plenty);
    turtle.mark("a");
    turtle.forward(1);
    turtle.mark("b");
    turtle.left(45);
    turtle.forward(1);
    EXPECT_TRUE(turtle.back_to("b"));
    turtle.left(-45);
    turtle.forward(1);
    EXPECT_TRUE(turtle.back_to("a"));
    turtle.left(90);
    turtle.forward(2);
    EXPECT_FALSE(turtle.back_to("b"));
    turtle.forward(0.5);
    turtle.mark("a");
    turtle.forward(1);
    EXPECT_TRUE(turtle.back_to("a"));
    turtle.left(90);
    turtle.forward(1);
    EXPECT_EQ(segments(turtle.trail()),
              "0 0 0 > 0 1 0 > -0.7071 1.7071 0\n"
              "0 1 0 > 0.7071 1.7071 0\n"
              "0 0 0 > -2 0 0 > -2.5 0 0 > -3.5 0 0\n"
              "-2.5 0 0 > -2.5 -1 0");
    EXPECT_EQ(pose(turtle.trail().last), "-2.5 -1 0 | -1 0 0 | 0 -1 0 | 0 0 1");
}

TEST(FlatlangTurtle, APolygonIsALoopOfTheTrailNewestPointFirst) {
    Turtle turtle(false, plenty);
    square(turtle, 1);
    turtle.pen(false);
    turtle.forward(3);
    turtle.pen(true);
    square(turtle, 2);
    EXPECT_EQ(polygons(turtle.trail()), "-1 0 0, -1 1 0, 0 1 0, 0 0 0\n-2 3 0, -2 5 0, 0 5 0, 0 3 0");
}

}  // namespace
}  // namespace popup::flatlang
