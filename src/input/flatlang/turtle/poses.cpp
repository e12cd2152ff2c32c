#include "input/flatlang/turtle/poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace popup::flatlang {

namespace {

// `a` turns towards `b`.
void turn_towards(Vec3& a, Vec3& b, double cosine, double sine) {
    const Vec3 turned = cosine * a + sine * b;
    b = cosine * b - sine * a;
    a = turned;
}

Vec3 from_axes(const Pose& pose, Vec3 v) { return v.x * pose.right + v.y * pose.heading + v.z * pose.up; }
Vec3 to_axes(const Pose& pose, Vec3 v) { return {dot(pose.right, v), dot(pose.heading, v), dot(pose.up, v)}; }

}  // namespace

void move(Pose& pose, double inches) { pose.at = pose.at + inches * pose.heading; }

void turn(Pose& pose, Axis axis, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    switch (axis) {
        case Axis::right:
            turn_towards(pose.heading, pose.up, cosine, sine);
            return;
        case Axis::heading:
            turn_towards(pose.up, pose.right, cosine, sine);
            return;
        case Axis::up:
            turn_towards(pose.right, pose.heading, cosine, sine);
            return;
    }
}

Pose change_of_2008(const Pose& from, const Pose& to) {
    constexpr std::size_t size = 4;
    using Matrix = std::array<std::array<double, size>, size>;
    const auto matrix = [](const Pose& pose) {
        return Matrix{{{pose.right.x, pose.heading.x, pose.up.x, pose.at.x},
                       {pose.right.y, pose.heading.y, pose.up.y, pose.at.y},
                       {pose.right.z, pose.heading.z, pose.up.z, pose.at.z},
                       {0, 0, 0, 1}}};
    };
    Matrix lu = matrix(from);
    Matrix inverse{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    for (std::size_t column = 0; column < size; ++column) {
        for (std::size_t row = 0; row < size; ++row) {
            for (std::size_t i = 0; i < std::min(row, column); ++i)
                lu[row][column] -= lu[row][i] * lu[i][column];
        }
        std::size_t largest = column;
        for (std::size_t row = column + 1; row < size; ++row) {
            if (std::fabs(lu[row][column]) > std::fabs(lu[largest][column])) largest = row;
        }
        std::swap(lu[largest], lu[column]);
        std::swap(inverse[largest], inverse[column]);
        for (std::size_t row = column + 1; row < size; ++row) lu[row][column] /= lu[column][column];
    }
    for (std::size_t column = 0; column < size; ++column) {
        for (std::size_t row = column + 1; row < size; ++row) {
            for (std::size_t i = 0; i < size; ++i) inverse[row][i] -= inverse[column][i] * lu[row][column];
        }
    }
    for (std::size_t column = size; column-- > 0;) {
        for (double& value : inverse[column]) value /= lu[column][column];
        for (std::size_t row = 0; row < column; ++row) {
            for (std::size_t i = 0; i < size; ++i) inverse[row][i] -= inverse[column][i] * lu[row][column];
        }
    }
    const Matrix there = matrix(to);
    Matrix product{};
    for (std::size_t row = 0; row < size; ++row) {
        for (std::size_t column = 0; column < size; ++column) {
            for (std::size_t i = 0; i < size; ++i) product[row][column] += inverse[row][i] * there[i][column];
        }
    }
    const auto column = [&product](std::size_t i) {
        return Vec3{product[0][i], product[1][i], product[2][i]};
    };
    return {column(3), column(0), column(1), column(2)};
}

Pose change(const Pose& from, const Pose& to) {
    return {to_axes(from, to.at - from.at), to_axes(from, to.right), to_axes(from, to.heading),
            to_axes(from, to.up)};
}

void apply(Pose& pose, const Pose& change) {
    pose = {pose.at + from_axes(pose, change.at), from_axes(pose, change.right),
            from_axes(pose, change.heading), from_axes(pose, change.up)};
}

void square_up(Pose& pose) {
    const Pose fresh;
    const double heading = length(pose.heading);
    const Vec3 ahead = heading > 0.0 && std::isfinite(heading) ? (1.0 / heading) * pose.heading : Vec3{};
    const Vec3 aside = pose.right - dot(pose.right, ahead) * ahead;
    const double right = length(aside);
    if (ahead == Vec3{} || !(right > 0.0 && std::isfinite(right))) {
        pose = {pose.at, fresh.right, fresh.heading, fresh.up};
        return;
    }
    pose.heading = ahead;
    pose.right = (1.0 / right) * aside;
    pose.up = cross(pose.right, pose.heading);
}

void keep_square(Pose& pose) {
    constexpr double noticeable = 1e-13;
    const auto off = [](double is, double should_be) { return std::fabs(is - should_be) > noticeable; };
    if (off(dot(pose.right, pose.right), 1) || off(dot(pose.heading, pose.heading), 1) ||
        off(dot(pose.up, pose.up), 1) || off(dot(pose.right, pose.heading), 0) ||
        off(dot(pose.heading, pose.up), 0) || off(dot(pose.up, pose.right), 0)) {
        square_up(pose);
    }
}

}  // namespace popup::flatlang
