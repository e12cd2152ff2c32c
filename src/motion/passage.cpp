#include "motion/passage.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "motion/cells.h"

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
    Diagnostics& diagnostics;
    std::vector<Frame> frames;
    int stuck = 0;

    bool look(double deg, Pose& pose) {
        pose.deg = deg;
        if (!place(assembly, Angle::degrees(deg), frames, &stuck)) return false;
        pose.bends.resize(linkage.turns().size());
        for (std::size_t i = 0; i < pose.bends.size(); ++i)
            pose.bends[i] = linkage.bend(static_cast<int>(i), frames);
        return true;
    }

    void locks(double reached, double missed) {
        int joint = stuck;
        while (reached >= 0.0 && missed - reached > kLockDeg) {
            const double middle = 0.5 * (reached + missed);
            if (place(assembly, Angle::degrees(middle), frames, &stuck)) {
                reached = middle;
            } else {
                missed = middle;
                joint = stuck;
            }
        }
        report_lock(assembly.joints[static_cast<std::size_t>(joint)], reached, missed, diagnostics);
    }

    // The plate that turns furthest between two poses, and how far at most.
    [[nodiscard]] std::pair<double, int> furthest(const Pose& from, const Pose& to) const {
        std::pair<double, int> most{0.0, -1};
        const auto bends = [&](int n) {
            return Bends{from.bends[static_cast<std::size_t>(n)], to.bends[static_cast<std::size_t>(n)]};
        };
        for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
            const int turn = linkage.drive_turn(static_cast<int>(i));
            // A law leads from everywhere to everywhere.
            if (linkage.turns()[static_cast<std::size_t>(turn)].law >= 0) continue;
            const double by = travel(linkage.turns(), turn, to.deg - from.deg, bends);
            if (by > most.first) most = {by, static_cast<int>(i)};
        }
        return most;
    }

    // Where a parent fold passes flat, its linkages have the least room.
    [[nodiscard]] bool passes_flat(const Pose& from, const Pose& to) const {
        for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
            const int fold = linkage.fold_turn(static_cast<int>(j));
            if (fold < 0) continue;
            const auto n = static_cast<std::size_t>(fold);
            if (Bends{from.bends[n], to.bends[n]}.passes()) return true;
        }
        return false;
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

}  // namespace

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

bool passes_whole_way(const Assembly& assembly, const Linkage& linkage, Diagnostics& diagnostics,
                      const std::function<void(double, std::span<const Frame>)>& seen) {
    Walk walk{assembly, linkage, diagnostics, std::vector<Frame>(assembly.plates.size())};
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
