#include "motion/passage.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "motion/cells.h"
#include "motion/joints/joint.h"

namespace popup {
namespace {

constexpr int kSteps = 72;  // of 2.5° where the sweep is one of 180°
constexpr double kTurn =
    5.0 * std::numbers::pi / 180.0;  // a plate that turns further is looked at in between
constexpr double kJumpDeg = 1e-6;    // who still turns that far in this, jumps
constexpr double kLockDeg = 1e-5;    // how exactly the angle of a lock is found

struct Pose {
    double deg = 0.0;
    std::vector<double> bends;
};

struct Walk {
    const Assembly& assembly;
    const Linkage& linkage;
    const Walked& walked;
    Diagnostics& diagnostics;
    std::vector<Frame> frames;
    std::size_t stuck = 0;

    bool place(double deg) {
        for (const std::size_t joint : walked.joints) {
            stuck = joint;
            if (!place_plates(assembly.joints[joint], Angle::degrees(deg), frames)) return false;
        }
        return true;
    }

    bool look(double deg, Pose& pose) {
        pose.deg = deg;
        if (!place(deg)) return false;
        pose.bends.resize(linkage.turns().size());
        for (const int turn : walked.turns)
            pose.bends[static_cast<std::size_t>(turn)] = linkage.bend(turn, frames);
        return true;
    }

    void locks(double reached, double missed) {
        std::size_t joint = stuck;
        while (reached >= 0.0 && missed - reached > kLockDeg) {
            const double middle = 0.5 * (reached + missed);
            if (place(middle)) {
                reached = middle;
            } else {
                missed = middle;
                joint = stuck;
            }
        }
        report_lock(assembly.joints[joint], reached, missed, diagnostics);
    }

    // The plate that turns furthest between two poses, and how far at most.
    [[nodiscard]] std::pair<double, int> furthest(const Pose& from, const Pose& to) const {
        std::pair<double, int> most{0.0, -1};
        const auto bends = [&](int n) {
            return Bends{from.bends[static_cast<std::size_t>(n)], to.bends[static_cast<std::size_t>(n)]};
        };
        for (const int plate : walked.plates) {
            const int turn = linkage.drive_turn(plate);
            // A law leads from everywhere to everywhere.
            if (linkage.turns()[static_cast<std::size_t>(turn)].law >= 0) continue;
            const double by = travel(linkage.turns(), turn, to.deg - from.deg, bends);
            if (by > most.first) most = {by, plate};
        }
        return most;
    }

    // Where a parent fold passes flat, its linkages have the least room.
    [[nodiscard]] bool passes_flat(const Pose& from, const Pose& to) const {
        return std::any_of(walked.parent_folds.begin(), walked.parent_folds.end(), [&](int fold) {
            const auto n = static_cast<std::size_t>(fold);
            return Bends{from.bends[n], to.bends[n]}.passes();
        });
    }

    bool jumps(int plate, double turn, double deg) {
        const Joint& joint = linkage.element(plate);
        diagnostics
            .error("jumps", joint.place,
                   fmt::format("\"{}\" jumps by {:.1f}° at an opening of {:.2f}°",
                               assembly.plates[static_cast<std::size_t>(plate)].name,
                               Angle::radians(turn).deg, deg))
            .hint("give its linkage more room: a wider piece, or a narrower V")
            .about(joint.name);
        return false;
    }

    bool pass(Pose from, const Pose& to) {
        std::vector<Pose> ahead{to};  // nearest last
        while (!ahead.empty()) {
            const double width = ahead.back().deg - from.deg;
            const auto [turn, plate] = furthest(from, ahead.back());
            const bool small = width <= kJumpDeg;
            if (turn <= kTurn ? small || !passes_flat(from, ahead.back()) : small) {
                if (turn > kTurn) return jumps(plate, turn, from.deg);
                from = std::move(ahead.back());
                ahead.pop_back();
                continue;
            }
            Pose middle;
            if (!look(0.5 * (from.deg + ahead.back().deg), middle)) {
                locks(from.deg, middle.deg);
                return false;
            }
            ahead.push_back(std::move(middle));
        }
        return true;
    }
};

void make_unique(std::vector<int>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

Walked walk_of_all(const Assembly& assembly, const Linkage& linkage) {
    Walked all;
    all.joints.resize(assembly.joints.size());
    all.plates.resize(assembly.plates.size());
    all.turns.resize(linkage.turns().size());
    std::iota(all.joints.begin(), all.joints.end(), std::size_t{0});
    std::iota(all.plates.begin(), all.plates.end(), 0);
    std::iota(all.turns.begin(), all.turns.end(), 0);
    for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
        const int fold = linkage.fold_turn(static_cast<int>(j));
        if (fold >= 0) all.parent_folds.push_back(fold);
    }
    return all;
}

Walked walk_of(const std::vector<int>& plates, const std::vector<int>& placed, Linkage& linkage) {
    Walked made;
    made.plates = plates;
    const auto turns = linkage.turns();
    for (const int plate : plates) {
        const auto need = [&](int turn) { made.turns.push_back(turn); };
        travel_needs(turns, linkage.drive_turn(plate), need);
        const int fold = linkage.fold_turn(linkage.joint_of(plate));
        if (fold < 0) continue;
        made.parent_folds.push_back(fold);
        made.turns.push_back(fold);
    }
    make_unique(made.parent_folds);
    make_unique(made.turns);
    std::vector<int> all = plates;
    all.insert(all.end(), placed.begin(), placed.end());
    for (const int turn : made.turns) {
        const Turn& one = turns[static_cast<std::size_t>(turn)];
        for (const int plate : {one.plate, one.other}) {
            if (plate >= 0) all.push_back(plate);
        }
    }
    make_unique(all);
    linkage.joints_under(all, made.joints);
    return made;
}

void report_lock(const Joint& joint, double reached_deg, double missed_deg, Diagnostics& diagnostics) {
    diagnostics
        .error("locks", joint.place,
               reached_deg < 0.0
                   ? fmt::format("\"{}\" locks: its linkage cannot reach an opening of {:.2f}°", joint.name,
                                 missed_deg)
                   : fmt::format("\"{}\" locks at {:.2f}°: its linkage does not let the card open further",
                                 joint.name, reached_deg))
        .hint("make its piece wider than the place it is glued to, or close its V")
        .about(joint.name);
}

bool passes_whole_way(const Assembly& assembly, const Linkage& linkage, const Walked& walked,
                      Diagnostics& diagnostics,
                      const std::function<void(double, std::span<const Frame>)>& seen) {
    Walk walk{assembly, linkage, walked, diagnostics, std::vector<Frame>(assembly.plates.size())};
    Pose here;
    const double least = least_opening(assembly.sweep);
    if (!walk.look(least, here)) {
        walk.locks(-1.0, least);
        return false;
    }
    seen(least, walk.frames);
    Pose next;
    for (int step = 1; step <= kSteps; ++step) {
        const double deg =
            assembly.sweep.from_deg + (assembly.sweep.to_deg - assembly.sweep.from_deg) * step / kSteps;
        if (!walk.look(deg, next)) {
            walk.locks(here.deg, deg);
            return false;
        }
        seen(deg, walk.frames);
        if (!walk.pass(std::move(here), next)) return false;
        here = std::move(next);
    }
    return true;
}

}  // namespace popup
