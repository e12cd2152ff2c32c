// A plate that is folded from another by a law of its own, and folds that close the loops of such plates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/joints/joint.h"

namespace popup {
namespace {

constexpr std::size_t kSteps = Folded::kLawSteps;
// So far may an opening of a law lie from its Chebyshev point, as a share of its range.
constexpr double kOffPoint = 1e-6;

bool is_straight(const std::vector<Vec2>& law) { return law.size() == 2; }

// Of Folded and LoopFold.
template <typename Kind>
JointTurn turn_about(const Kind& how) {
    JointTurn turn;
    turn.plate = how.plate;
    turn.other = how.base;
    turn.at = how.at;
    turn.dir = how.dir;
    turn.law = how.law;
    return turn;
}

std::optional<std::string> fault_of_law(const std::vector<Vec2>& law) {
    if (law.size() < 2 || (!is_straight(law) && (law.size() - 1) % kSteps != 0))
        return fmt::format("law_deg has {} points; it has 2, or 1 and a multiple of {}", law.size(), kSteps);
    for (std::size_t i = 0; i + 1 < law.size(); ++i) {
        if (!(law[i].x < law[i + 1].x))
            return fmt::format("law_deg goes from an opening of {:g} to one of {:g}: they must rise",
                               law[i].x, law[i + 1].x);
    }
    if (is_straight(law)) return std::nullopt;
    for (std::size_t first = 0; first + kSteps < law.size(); first += kSteps) {
        const double begin = law[first].x;
        const double width = law[first + kSteps].x - begin;
        for (std::size_t i = 1; i < kSteps; ++i) {
            const double want = begin + width * chebyshev_share(i);
            if (std::abs(law[first + i].x - want) <= kOffPoint * width) continue;
            return fmt::format("law_deg has a point at an opening of {:g}, where the Chebyshev point is {:g}",
                               law[first + i].x, want);
        }
    }
    return std::nullopt;
}

template <typename Kind>
std::optional<std::string> fault_about(const Kind& how) {
    if (!is_unit(how.dir)) return "dir is no unit vector";
    if (how.plate == how.base) return "plate and base are one plate";
    return fault_of_law(how.law);
}

}  // namespace

double chebyshev_share(std::size_t i) {
    return 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(kSteps));
}

double fold_angle_deg(const std::vector<Vec2>& law, double opening_deg) {
    if (opening_deg <= law.front().x) return law.front().y;
    if (opening_deg >= law.back().x) return law.back().y;
    if (is_straight(law)) {
        const double t = (opening_deg - law[0].x) / (law[1].x - law[0].x);
        return law[0].y + t * (law[1].y - law[0].y);
    }
    std::size_t range = 0;
    std::size_t ranges = (law.size() - 1) / kSteps;
    while (ranges > 1) {  // the last range that begins before the opening
        const std::size_t half = ranges / 2;
        if (law[(range + half) * kSteps].x <= opening_deg) {
            range += half;
            ranges -= half;
        } else {
            ranges = half;
        }
    }
    const Vec2* points = &law[range * kSteps];
    double above = 0.0;
    double below = 0.0;
    for (std::size_t i = 0; i <= kSteps; ++i) {
        const double off = opening_deg - points[i].x;
        if (off == 0.0) return points[i].y;
        const double weight = (i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == kSteps ? 0.5 : 1.0) / off;
        above += weight * points[i].y;
        below += weight;
    }
    return above / below;
}

JointPlates plates_of(const Folded& how) {
    return {{{how.plate, how.base, how.at, Lying::free}}, {how.base}};
}

JointPlates plates_of(const LoopFold& how) { return {{}, {how.plate, how.base}}; }

JointTurns turns_of(const Folded& how) {
    JointTurns result;
    result.turns.push_back(turn_about(how));
    result.ways.push_back({0, JointTurn::kNone});
    return result;
}

JointTurns turns_of(const LoopFold& how) {
    JointTurns result;
    result.turns.push_back(turn_about(how));
    return result;
}

bool place_plates(const Folded& how, Angle theta, std::span<Frame> frames) {
    const Frame& base = frames[static_cast<std::size_t>(how.base)];
    const double angle = Angle::degrees(fold_angle_deg(how.law, theta.deg)).rad();
    // Made square and unit again, for in a long chain of folds rounding would grow from one to the next.
    const Vec3 along = unit(base.direction(how.dir));
    const Vec3 left = unit(cross(base.normal(), along));
    const Vec3 front = cross(along, left);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const Vec3 own_left = c * left + s * front;
    const auto image = [&](Vec2 d) { return dot(d, how.dir) * along + cross(how.dir, d) * own_left; };
    Frame& own = frames[static_cast<std::size_t>(how.plate)];
    own.axes = {image({1, 0}), image({0, 1}), cross(along, own_left)};
    own.origin = base.point(how.at) - own.direction(how.at);
    return true;
}

Likeness likeness(const Folded& /*how*/) { return {}; }

// Its law is that of one place on the sheet.
std::optional<Slid> slid(const Folded& /*how*/, double /*mm*/) { return std::nullopt; }

std::optional<Parallelism> parallelism(const Folded& /*how*/) { return std::nullopt; }

bool place_plates(const LoopFold& /*how*/, Angle /*theta*/, std::span<Frame> /*frames*/) { return true; }

Likeness likeness(const LoopFold& /*how*/) { return {}; }

std::optional<Slid> slid(const LoopFold& /*how*/, double /*mm*/) { return std::nullopt; }

std::optional<Parallelism> parallelism(const LoopFold& /*how*/) { return std::nullopt; }

std::optional<std::string> fault_of(const Folded& how) { return fault_about(how); }
std::optional<std::string> fault_of(const LoopFold& how) { return fault_about(how); }

}  // namespace popup
