#include "motion/linkage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace popup {
namespace {

std::pair<int, int> ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// Where a plate, or the world (-1), stands among the nodes of a way.
std::size_t node(int plate) { return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(plate) + 1); }

// Equal for joints whose plates move alike: what drives them, how, and from where on the fold. Where a
// parallel linkage stands along its fold makes no difference.
using Likeness = std::array<long long, 10>;
Likeness likeness(const Joint& joint) {
    const auto whole = [](double value) { return std::llround(value * 1e9); };
    const Bar& l = joint.left;
    const Bar& r = joint.right;
    const Vec2 at = joint.parallel ? Vec2{} : l.fold_at;
    return {static_cast<long long>(joint.kind) * 2 + (joint.parallel ? 1 : 0),
            l.drive,
            r.drive,
            whole(l.near),
            whole(l.far),
            whole(r.near),
            whole(r.far),
            whole(at.x),
            whole(at.y),
            joint.parallel ? 0 : whole(std::atan2(l.fold_dir.y, l.fold_dir.x))};
}

}  // namespace

Linkage::Linkage(const Assembly& assembly) : assembly_(assembly) {
    const std::size_t plates = assembly.plates.size();
    joint_of_.assign(plates, -1);
    drive_turn_.assign(plates, -1);
    centre_turn_.assign(plates, -1);
    fold_turn_.assign(assembly.joints.size(), -1);
    for (auto& seen : seen_) seen.assign(plates + 1, -1);
    wanted_.assign(assembly.joints.size(), 0);
    twin_.resize(plates);
    for (std::size_t i = 0; i < plates; ++i) twin_[i] = static_cast<int>(i);
    std::map<std::pair<int, int>, int> between;  // the turn of two plates
    std::map<Likeness, std::size_t> alike;
    for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
        const Joint& joint = assembly.joints[j];
        const auto left = static_cast<std::size_t>(joint.left.plate);
        const int first = static_cast<int>(turns_.size());
        joint_of_[left] = static_cast<int>(j);
        drive_turn_[left] = first;
        if (joint.kind == JointKind::drive) {
            turns_.push_back({joint.left.plate, -1, joint.left.fold_at, joint.left.fold_dir, -1, {-1, -1}});
            continue;
        }
        const auto right = static_cast<std::size_t>(joint.right.plate);
        joint_of_[right] = static_cast<int>(j);
        drive_turn_[right] = first + 1;
        centre_turn_[left] = centre_turn_[right] = first + 2;
        const auto drives = between.find(ordered(joint.left.drive, joint.right.drive));
        const int fold = drives == between.end() ? -1 : drives->second;
        fold_turn_[j] = fold;
        const Bar& l = joint.left;
        const Bar& r = joint.right;
        const Joint& like = assembly.joints[alike.try_emplace(likeness(joint), j).first->second];
        twin_[left] = like.left.plate;
        twin_[right] = like.right.plate;
        turns_.push_back({l.plate, twin(l.drive), l.own_at, l.own_seam, first + 1, {fold, first + 2}});
        turns_.push_back({r.plate, twin(r.drive), r.own_at, r.own_seam, first, {fold, first + 2}});
        Turn centre{l.plate, r.plate, l.own_at, l.own_centre, fold, {first, first + 1}};
        if (joint.parallel) {
            centre.at = l.own_at + l.far * l.own_centre;
            centre.dir = l.own_seam;
        }
        turns_.push_back(centre);
        between[ordered(l.plate, l.drive)] = first;
        between[ordered(r.plate, r.drive)] = first + 1;
        between[ordered(l.plate, r.plate)] = first + 2;
    }
}

void Linkage::rise(std::size_t side, int plate, int turn, int from) {
    int& seen = seen_.at(side)[node(plate)];
    if (seen >= 0) return;
    seen = static_cast<int>(visits_.at(side).size());
    visits_.at(side).push_back({plate, turn, from});
}

void Linkage::way(int a, int b, std::vector<int>& turns) {
    turns.clear();
    rise(0, a, -1, -1);
    rise(1, b, -1, -1);
    std::array<std::size_t, 2> done{0, 0};
    int meeting = a == b ? a : -2;
    // Both ends climb, level by level, until they meet; every way up ends at the world.
    while (meeting == -2) {
        for (std::size_t side = 0; side < 2 && meeting == -2; ++side) {
            const std::size_t level = visits_.at(side).size();
            for (; done.at(side) < level && meeting == -2; ++done.at(side)) {
                const Visit at = visits_.at(side)[done.at(side)];
                if (at.plate < 0) continue;
                const auto plate = static_cast<std::size_t>(at.plate);
                for (const int turn : {centre_turn_[plate], drive_turn_[plate]}) {
                    if (turn < 0) continue;
                    const Turn& t = turns_[static_cast<std::size_t>(turn)];
                    const int to = t.plate == at.plate ? t.other : t.plate;
                    rise(side, to, turn, static_cast<int>(done.at(side)));
                    if (seen_.at(1 - side)[node(to)] >= 0) {
                        meeting = to;
                        break;
                    }
                }
            }
        }
    }
    const auto walk = [&](std::size_t side) {
        for (int at = seen_.at(side)[node(meeting)]; at > 0;) {
            const Visit& visit = visits_.at(side)[static_cast<std::size_t>(at)];
            turns.push_back(visit.turn);
            at = visit.from;
        }
    };
    walk(0);
    std::reverse(turns.begin(), turns.end());
    walk(1);
    for (std::size_t side = 0; side < 2; ++side) {
        for (const Visit& visit : visits_.at(side)) seen_.at(side)[node(visit.plate)] = -1;
        visits_.at(side).clear();
    }
}

void Linkage::joints_under(std::span<const int> plates, std::vector<std::size_t>& joints) {
    joints.clear();
    open_.clear();
    const auto want = [this](int plate) {
        const int joint = joint_of(plate);
        if (wanted_[static_cast<std::size_t>(joint)] != 0) return;
        wanted_[static_cast<std::size_t>(joint)] = 1;
        open_.push_back(joint);
    };
    for (const int plate : plates) want(plate);
    while (!open_.empty()) {
        const auto joint = static_cast<std::size_t>(open_.back());
        open_.pop_back();
        joints.push_back(joint);
        if (assembly_.joints[joint].kind == JointKind::drive) continue;
        for (const int drive : {assembly_.joints[joint].left.drive, assembly_.joints[joint].right.drive}) {
            want(drive);
            want(twin(drive));
        }
    }
    std::sort(joints.begin(), joints.end());
    for (const std::size_t joint : joints) wanted_[joint] = 0;
}

double Linkage::bend(int turn, std::span<const Frame> frames) const {
    const Turn& t = turns_[static_cast<std::size_t>(turn)];
    if (t.other < 0) return 0.0;
    const Frame& own = frames[static_cast<std::size_t>(t.plate)];
    const Frame& other = frames[static_cast<std::size_t>(t.other)];
    const Vec3 n = own.normal();
    const Vec3 m = other.normal();
    return std::atan2(dot(own.direction(t.dir), cross(m, n)), dot(m, n));
}

}  // namespace popup
