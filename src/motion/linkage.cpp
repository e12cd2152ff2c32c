#include "motion/linkage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/joints/joint.h"

namespace popup {
namespace {

constexpr double kFlatRad = 1e-9;

std::pair<int, int> ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// Where a plate, or the world (-1), stands among the nodes of a way.
std::size_t node(int plate) { return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(plate) + 1); }

}  // namespace

Linkage::Linkage(const Assembly& assembly) : assembly_(assembly) {
    const std::size_t plates = assembly.plates.size();
    joint_of_.assign(plates, -1);
    drive_turn_.assign(plates, -1);
    across_turn_.assign(plates, -1);
    closing_turns_.resize(plates);
    fold_turn_.assign(assembly.joints.size(), -1);
    for (auto& seen : seen_) seen.assign(plates + 1, -1);
    wanted_.assign(assembly.joints.size(), 0);
    twin_.resize(plates);
    for (std::size_t i = 0; i < plates; ++i) twin_[i] = static_cast<int>(i);
    std::map<std::pair<int, int>, int> between;  // the turn of two plates
    std::map<Likeness, JointPlates> alike;
    for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
        JointPlates own = plates_of(assembly.joints[j]);
        needs_begin_.push_back(needs_.size());
        needs_.insert(needs_.end(), own.needs.begin(), own.needs.end());
        for (const PlacedPlate& one : own.places) {
            joint_of_[static_cast<std::size_t>(one.plate)] = static_cast<int>(j);
            if (one.lying != Lying::free) twin_[static_cast<std::size_t>(one.plate)] = twin(one.parent);
        }
        if (Likeness key = likeness(assembly.joints[j]); !key.empty()) {
            const auto [like, first] = alike.try_emplace(std::move(key), own);
            for (std::size_t i = 0; i < own.places.size() && !first; ++i) {
                twin_[static_cast<std::size_t>(own.places[i].plate)] = like->second.places[i].plate;
            }
        }
        add(j, between);
    }
    needs_begin_.push_back(needs_.size());
    std::sort(range_ends_.begin(), range_ends_.end());
    range_ends_.erase(std::unique(range_ends_.begin(), range_ends_.end()), range_ends_.end());
    if (is_lawful_) join_around();
}

// The turns of a joint, and how its plates are reached by them.
void Linkage::add(std::size_t number, std::map<std::pair<int, int>, int>& between) {
    const Joint& joint = assembly_.joints[number];
    const JointTurns own = turns_of(joint);
    const int first = static_cast<int>(turns_.size());
    turns_begin_.push_back(turns_.size());
    int parent = -1;
    if (own.stands_on[0] >= 0) {
        const auto fold = between.find(ordered(own.stands_on[0], own.stands_on[1]));
        if (fold != between.end()) parent = fold->second;
    }
    fold_turn_[number] = parent;
    const auto overall = [&](int turn) {
        if (turn == JointTurn::kParent) return parent;
        return turn == JointTurn::kNone ? -1 : first + turn;
    };
    for (const JointTurn& t : own.turns) {
        const bool inside = t.other >= 0 && joint_of(t.other) == static_cast<int>(number);
        turns_.push_back({t.plate,
                          t.other < 0 || inside ? t.other : twin(t.other),
                          t.at,
                          t.dir,
                          overall(t.opposite),
                          {overall(t.sides[0]), overall(t.sides[1])},
                          t.still,
                          t.law.empty() ? -1 : static_cast<int>(laws_.size())});
        if (t.law.empty() && !t.still) is_lawful_ = false;
        if (!t.law.empty()) {
            laws_.emplace_back(t.law);
            const auto ends = laws_.back().ends();
            range_ends_.insert(range_ends_.end(), ends.begin(), ends.end());
        }
        if (t.other >= 0 && joint_of(t.plate) != static_cast<int>(number)) {
            for (const int plate : {t.plate, t.other})
                closing_turns_[static_cast<std::size_t>(plate)].push_back(static_cast<int>(turns_.size()) -
                                                                          1);
        }
        if (t.other >= 0) between[ordered(t.plate, t.other)] = static_cast<int>(turns_.size()) - 1;
    }
    const JointPlates plates = plates_of(joint);
    for (std::size_t i = 0; i < plates.places.size(); ++i) {
        const auto plate = static_cast<std::size_t>(plates.places[i].plate);
        drive_turn_[plate] = overall(own.ways[i].up);
        across_turn_[plate] = overall(own.ways[i].across);
        if (plates.places[i].lying == Lying::free) continue;
        drive_turn_[plate] = drive_turn(plates.places[i].parent);
    }
}

void Linkage::rise(std::size_t side, int plate, int turn, int from) {
    int& seen = seen_.at(side)[node(plate)];
    if (seen >= 0) return;
    seen = static_cast<int>(visits_.at(side).size());
    visits_.at(side).push_back({plate, turn, from});
}

// By plate, and the world: the turns that lead away from it, also those up from others.
void Linkage::join_around() {
    around_.resize(joint_of_.size() + 1);
    for (std::size_t i = 0; i < joint_of_.size(); ++i) {
        const auto plate = static_cast<int>(i);
        around_[node(plate)].insert(around_[node(plate)].end(), closing_turns_[i].begin(),
                                    closing_turns_[i].end());
        for (const int turn : {across_turn_[i], drive_turn_[i]}) {
            if (turn < 0) continue;
            const Turn& t = turns_[static_cast<std::size_t>(turn)];
            around_[node(plate)].push_back(turn);
            around_[node(t.plate == plate ? t.other : t.plate)].push_back(turn);
        }
    }
}

std::size_t Linkage::way(int a, int b, std::vector<int>& turns) {
    turns.clear();
    return is_lawful_ ? way_around(a, b, turns) : way_up(a, b, turns);
}

// Level by level around a, as far as that was not done yet.
std::size_t Linkage::way_around(int a, int b, std::vector<int>& turns) {
    std::vector<Visit>& visits = visits_[0];
    std::vector<int>& seen = seen_[0];
    if (a != around_from_) {
        for (const Visit& visit : visits) seen[node(visit.plate)] = -1;
        visits.clear();
        around_from_ = a;
        around_done_ = 0;
        rise(0, a, -1, -1);
    }
    const std::size_t before = visits.size();
    for (; seen[node(b)] < 0 && around_done_ < visits.size(); ++around_done_) {
        const Visit at = visits[around_done_];
        for (const int turn : around_[node(at.plate)]) {
            const Turn& t = turns_[static_cast<std::size_t>(turn)];
            rise(0, t.plate == at.plate ? t.other : t.plate, turn, static_cast<int>(around_done_));
        }
    }
    for (int at = seen[node(b)]; at > 0;) {
        const Visit& visit = visits[static_cast<std::size_t>(at)];
        turns.push_back(visit.turn);
        at = visit.from;
    }
    std::reverse(turns.begin(), turns.end());
    return visits.size() - before;
}

std::size_t Linkage::way_up(int a, int b, std::vector<int>& turns) {
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
                const auto go = [&](int turn) {
                    if (turn < 0 || meeting != -2) return;
                    const Turn& t = turns_[static_cast<std::size_t>(turn)];
                    const int to = t.plate == at.plate ? t.other : t.plate;
                    rise(side, to, turn, static_cast<int>(done.at(side)));
                    if (seen_.at(1 - side)[node(to)] >= 0) meeting = to;
                };
                for (const int turn : closing_turns_[plate]) go(turn);
                go(across_turn_[plate]);
                go(drive_turn_[plate]);
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
    const std::size_t looked = visits_[0].size() + visits_[1].size();
    for (std::size_t side = 0; side < 2; ++side) {
        for (const Visit& visit : visits_.at(side)) seen_.at(side)[node(visit.plate)] = -1;
        visits_.at(side).clear();
    }
    return looked;
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
        for (std::size_t i = needs_begin_[joint]; i < needs_begin_[joint + 1]; ++i) {
            want(needs_[i]);
            want(twin(needs_[i]));
        }
    }
    std::sort(joints.begin(), joints.end());
    for (const std::size_t joint : joints) wanted_[joint] = 0;
}

std::optional<TurnRate> Linkage::rate(int turn, double from_deg, double to_deg) const {
    const Turn& t = turns_[static_cast<std::size_t>(turn)];
    if (t.law >= 0) return laws_[static_cast<std::size_t>(t.law)].rate(from_deg, to_deg);
    if (t.still) return TurnRate{};
    return std::nullopt;
}

double Linkage::bend(int turn, std::span<const Frame> frames) const {
    const Turn& t = turns_[static_cast<std::size_t>(turn)];
    if (t.other < 0) return 0.0;
    const Frame& own = frames[static_cast<std::size_t>(t.plate)];
    const Frame& other = frames[static_cast<std::size_t>(t.other)];
    const Vec3 n = own.normal();
    const Vec3 m = other.normal();
    const double bend = std::atan2(dot(own.direction(t.dir), cross(m, n)), dot(m, n));
    return std::abs(bend) < kFlatRad ? 0.0 : bend;
}

}  // namespace popup
