// Which plates turn against which, about which line, and how far between two poses.
//
// The joints say which turns there are and what bounds them (motion/joints/joint.h). Here they become one net
// of plates: ways through it are what the examination of two plates goes along.
//
// A turn also turns back where its parent fold does. In designs that passed check() none does: no seam passes
// flat while its parent fold is bent by less than 180°.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motion/turn_law.h"
#include "popup/assembly.h"
#include "popup/units.h"

namespace popup {

// A JointTurn among those of the whole assembly.
struct Turn {
    int plate = -1;  // on whose page the line is
    int other = -1;  // or a twin of it; -1: the world
    Vec2 at, dir;    // a point of the line, and its direction (unit)
    // Numbers of turns. -1: as JointTurn::kNone.
    int opposite = -1;
    std::array<int, 2> sides{-1, -1};
    bool still = false;  // as JointTurn::still
    int law = -1;        // of Linkage::rate(); -1: it has none
};

// The bends of a turn at two angles.
struct Bends {
    double from = 0.0, to = 0.0;
    [[nodiscard]] double change() const { return to > from ? to - from : from - to; }
    // The same where it is less than half a turn: what is folded flat may be bent by a half turn to either
    // side, as rounding has it.
    [[nodiscard]] double nearer_change() const {
        return change() > std::numbers::pi ? 2.0 * std::numbers::pi - change() : change();
    }
    // Passes unfolded, or folded flat.
    [[nodiscard]] bool passes() const { return (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0); }
};

class Linkage {
 public:
    // `assembly` must outlive the linkage.
    explicit Linkage(const Assembly& assembly);

    [[nodiscard]] std::span<const Turn> turns() const { return turns_; }
    // Those of one joint: numbers from the first of the two up to the second.
    [[nodiscard]] std::pair<std::size_t, std::size_t> turns_of_joint(std::size_t joint) const {
        return {turns_begin_[joint],
                joint + 1 < turns_begin_.size() ? turns_begin_[joint + 1] : turns_.size()};
    }
    // Openings at which a law has another polynomial, ascending, each once: ranges that rate() is asked of
    // end there.
    [[nodiscard]] std::span<const double> range_ends() const { return range_ends_; }
    // Whether rate() knows all turns.
    [[nodiscard]] bool is_lawful() const { return is_lawful_; }
    // How fast a turn turns, from its other plate to its own; nullopt: that is not known.
    [[nodiscard]] std::optional<TurnRate> rate(int turn, double from_deg, double to_deg) const;
    // The joint that places a plate.
    [[nodiscard]] int joint_of(int plate) const { return joint_of_[static_cast<std::size_t>(plate)]; }
    [[nodiscard]] const Joint& element(int plate) const {
        return assembly_.joints[static_cast<std::size_t>(joint_of(plate))];
    }
    // The turn that moves a plate against the one it stands on, or the world. A plate that lies on another
    // moves by that one's.
    [[nodiscard]] int drive_turn(int plate) const { return drive_turn_[static_cast<std::size_t>(plate)]; }
    // The turn about the parent fold of a joint; -1 when it has none, or that is the opening of the card
    // itself.
    [[nodiscard]] int fold_turn(int joint) const { return fold_turn_[static_cast<std::size_t>(joint)]; }

    // The first of the plates that move as one body with this one, because it lies on them or their joints
    // are alike: tents, for instance, that stand beside one another on one fold with the same distances.
    [[nodiscard]] int twin(int plate) const { return twin_[static_cast<std::size_t>(plate)]; }

    // A short way from plate a to plate b, as turns from a's end on: a shortest one where all turns have
    // laws. Uses memory of the object: one caller at a time. Returns how many plates were looked at; with
    // laws those are remembered for the next ways from a, so that all ways from one plate take no more than
    // all plates.
    std::size_t way(int a, int b, std::vector<int>& turns);
    // The joints that must be placed, in order, to know where the plates and what they turn against are. One
    // caller at a time.
    void joints_under(std::span<const int> plates, std::vector<std::size_t>& joints);

    // How far a turn is bent from flat, radians in [-π, π]; 0 where that is no more than rounding, so that
    // what lies flat all the time passes nothing. 0 for turns against the world, too: they move with the
    // card.
    [[nodiscard]] double bend(int turn, std::span<const Frame> frames) const;

 private:
    struct Visit {
        int plate, turn, from;
    };
    void rise(std::size_t side, int plate, int turn, int from);
    void join_around();
    std::size_t way_up(int a, int b, std::vector<int>& turns);
    std::size_t way_around(int a, int b, std::vector<int>& turns);

    void add(std::size_t joint, std::map<std::pair<int, int>, int>& between);

    const Assembly& assembly_;
    std::vector<Turn> turns_;
    std::vector<std::size_t> turns_begin_;  // by joint
    std::vector<TurnLaw> laws_;
    bool is_lawful_ = true;
    std::vector<double> range_ends_;
    std::vector<int> joint_of_, drive_turn_, across_turn_, fold_turn_, twin_;
    std::vector<std::vector<int>> closing_turns_;  // by plate: of joints that do not place it
    // Plates that joint j needs stand from needs_begin_[j] to needs_begin_[j + 1].
    std::vector<int> needs_;
    std::vector<std::size_t> needs_begin_;
    std::vector<std::vector<int>> around_;  // of all that have laws: turns, by plate + 1
    int around_from_ = -2;                  // visits_[0] are of ways from this plate; -2: of none
    std::size_t around_done_ = 0;           // those of them whose turns have been followed
    std::array<std::vector<Visit>, 2> visits_;
    std::array<std::vector<int>, 2> seen_;  // by plate + 1: the visit, -1 for none
    std::vector<char> wanted_;              // by joint
    std::vector<int> open_;
};

// A bound, in radians, for how far a turn gets from where it is at one end of a range while the card goes to
// the other. `bends(turn)` gives the bends at both ends of any turn that travel_needs() names; `opening_deg`
// is the width of the range. π when nothing better is known.
template <typename BendsOf>
double travel(std::span<const Turn> turns, int index, double opening_deg, const BendsOf& bends) {
    constexpr double kPi = std::numbers::pi;
    const double opening = opening_deg * kPi / 180.0;
    const Turn& turn = turns[static_cast<std::size_t>(index)];
    if (turn.other < 0) return turn.still ? 0.0 : 0.5 * opening;
    if (turn.opposite < 0 || !bends(turn.opposite).passes()) return bends(index).change();
    // It may turn back in between. The four rates add up to nought, so it goes no further than the others
    // together.
    if (bends(index).passes()) return kPi;
    double sum = bends(turn.opposite).change();
    for (const int side : turn.sides) {
        if (side < 0) {
            sum += opening;
            continue;
        }
        const int opposite = turns[static_cast<std::size_t>(side)].opposite;
        if (opposite >= 0 && bends(opposite).passes()) return kPi;
        sum += bends(side).change();
    }
    return sum;
}

// Of a turn with a law, from the middle of a range to either of its ends, each half_deg away. `rate`: in the
// range.
inline double travel_by_law(const TurnRate& rate, double half_deg, const Bends& before, const Bends& after) {
    const double most = Angle::degrees(half_deg).rad() * rate.most;
    if (!rate.one_way || most > 0.5 * std::numbers::pi) return most;
    return std::max(before.nearer_change(), after.nearer_change());
}

// The same of any turn, from the middle of a range to either of its ends. `before`, `after`: the bends at the
// ends of its lower and of its upper half. A turn with a law may turn back.
template <typename BendsBefore, typename BendsAfter>
double travel_from_middle(const Linkage& linkage, int index, double from_deg, double to_deg,
                          const BendsBefore& before, const BendsAfter& after) {
    const double half_deg = 0.5 * (to_deg - from_deg);
    if (linkage.turns()[static_cast<std::size_t>(index)].law >= 0) {
        const TurnRate rate = *linkage.rate(index, from_deg, to_deg);
        return travel_by_law(rate, half_deg, before(index), after(index));
    }
    return std::max(travel(linkage.turns(), index, half_deg, before),
                    travel(linkage.turns(), index, half_deg, after));
}

// Calls `need(turn)` for each turn whose bends travel() of `index` may ask for.
template <typename Need>
void travel_needs(std::span<const Turn> turns, int index, const Need& need) {
    const Turn& turn = turns[static_cast<std::size_t>(index)];
    need(index);
    if (turn.opposite >= 0) need(turn.opposite);
    for (const int side : turn.sides) {
        if (side < 0) continue;
        need(side);
        const int opposite = turns[static_cast<std::size_t>(side)].opposite;
        if (opposite >= 0) need(opposite);
    }
}

}  // namespace popup
