#include "motion/poses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/joints/joint.h"

namespace popup {
namespace {

constexpr std::size_t kMostNumbers = 64;
constexpr std::size_t kMostFrames = 500'000;  // of all numbers, so that memory stays small

}  // namespace

Poses::Poses(const Assembly& assembly, const Linkage& linkage) : assembly_(assembly), linkage_(linkage) {
    const std::size_t room = kMostFrames / std::max<std::size_t>(assembly.plates.size(), 1);
    kept_.resize(std::clamp<std::size_t>(room, 1, kMostNumbers));
}

void Poses::forget(Pose& pose) const {
    pose.frames.resize(assembly_.plates.size());
    pose.joints.assign(assembly_.joints.size(), unknown);
    pose.bends.assign(linkage_.turns().size(), std::numeric_limits<double>::quiet_NaN());
}

void Poses::begin(double from_deg, double to_deg) {
    if (from_deg == from_deg_ && to_deg == to_deg_) return;
    from_deg_ = from_deg;
    to_deg_ = to_deg;
    for (const std::size_t number : used_) kept_[number].joints.clear();
    used_.clear();
}

bool Poses::place(std::size_t number, double deg, std::span<const std::size_t> joints) {
    now_ = &kept_[number];
    if (number == 0) {
        now_->frames.resize(assembly_.plates.size());
        now_->bends.clear();
        return std::all_of(joints.begin(), joints.end(), [&](std::size_t joint) {
            return place_plates(assembly_.joints[joint], Angle::degrees(deg), now_->frames);
        });
    }
    if (now_->joints.empty()) {
        forget(*now_);
        used_.push_back(number);
    }
    return std::all_of(joints.begin(), joints.end(), [&](std::size_t joint) {
        State& state = now_->joints[joint];
        if (state == unknown) {
            state = place_plates(assembly_.joints[joint], Angle::degrees(deg), now_->frames) ? placed
                                                                                             : out_of_reach;
        }
        return state == placed;
    });
}

double Poses::bend(int turn) {
    if (now_->bends.empty()) return linkage_.bend(turn, now_->frames);
    double& kept = now_->bends[static_cast<std::size_t>(turn)];
    if (std::isnan(kept)) kept = linkage_.bend(turn, now_->frames);
    return kept;
}

}  // namespace popup
