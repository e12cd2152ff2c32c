// Each question is put to the kind that the joint is of.
#include "motion/joints/joint.h"

#include <cmath>

namespace popup {

JointPlates plates_of(const Joint& joint) {
    return std::visit([](const auto& how) { return plates_of(how); }, joint.how);
}

JointTurns turns_of(const Joint& joint) {
    return std::visit([](const auto& how) { return turns_of(how); }, joint.how);
}

bool place_plates(const Joint& joint, Angle theta, std::span<Frame> frames) {
    return std::visit([&](const auto& how) { return place_plates(how, theta, frames); }, joint.how);
}

Likeness likeness(const Joint& joint) {
    Likeness result = std::visit([](const auto& how) { return likeness(how); }, joint.how);
    if (!result.empty()) result.push_back(static_cast<long long>(joint.how.index()));
    return result;
}

std::optional<Slid> slid(const Joint& joint, double mm) {
    return std::visit([mm](const auto& how) { return slid(how, mm); }, joint.how);
}

std::optional<Parallelism> parallelism(const Joint& joint) {
    return std::visit([](const auto& how) { return parallelism(how); }, joint.how);
}

std::optional<std::string> fault_of(const Joint& joint) {
    return std::visit([](const auto& how) { return fault_of(how); }, joint.how);
}

namespace {

// What the text of an assembly keeps of a unit, with room for one who wrote nine digits of it.
constexpr double kUnit = 1e-8;
constexpr double kLengthMm = 1e-6;

}  // namespace

bool is_unit(Vec2 direction) { return std::abs(length(direction) - 1.0) <= kUnit; }
bool same_length(double a, double b) { return std::abs(a - b) <= kLengthMm; }
bool same_angle(double a, double b) { return std::abs(a - b) <= kUnit; }
bool are_square(Vec2 a, Vec2 b) { return std::abs(dot(a, b)) <= kUnit; }

long long to_compare(double value) { return std::llround(value * 1e9); }

}  // namespace popup
