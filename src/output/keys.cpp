#include "output/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "base/text/numbers.h"
#include "output/orientation.h"
#include "output/poses.h"

namespace popup {
namespace {

// Halving goes on until hinges stay this close at the angles looked at: less than what is promised for all.
constexpr double kAimMm = 0.4 * kMostOpeningMm;
// Keys nearer than this could fall on one 32-bit time.
constexpr double kLeastStepDeg = 180.0 / (1 << 21);
constexpr int kAngleDecimals = 7;
// An interval shorter than this is looked at in its middle only, where a smooth motion strays most.
constexpr double kShortDeg = 3.0;
// A turn takes 16 bytes of the file, and some 130 of memory while it is written.
constexpr double kMostTurns = 1 << 24;
constexpr double kMostTurnsRefined = 1 << 23;
constexpr double kMostKeys = 100'000;

struct Pose {
    double angle_deg = 0.0;
    std::vector<Quaternion> turns;
};

void record(const Pose& pose, Track& track) {
    const std::size_t before = track.turns.size();
    const std::size_t count = pose.turns.size();
    track.angles_deg.push_back(pose.angle_deg);
    for (std::size_t i = 0; i < count; ++i) {
        const Quaternion& q = pose.turns[i];
        double product = 1.0;
        if (before > 0) {
            const auto& last = track.turns[before - count + i];
            product = last[0] * q[0] + last[1] * q[1] + last[2] * q[2] + last[3] * q[3];
        }
        std::array<float, 4> turn{};
        // 0.0 - x, not -x: a zero stays without a sign.
        for (std::size_t k = 0; k < 4; ++k) {
            turn.at(k) = static_cast<float>(product < 0.0 ? 0.0 - q.at(k) : q.at(k));
        }
        track.turns.push_back(turn);
    }
}

// One card's poses by the closed form, and how it looks between them.
class CardPoses {
 public:
    CardPoses(const Assembly& assembly, Diagnostics& diagnostics)
        : assembly_(assembly), diagnostics_(diagnostics), frames_(assembly.plates.size()) {}

    // False, with an error, when the card does not get to its middle.
    bool start() {
        if (!place_at(rest_of(assembly_.sweep))) return false;
        tree_ = hinge_tree(assembly_, frames_);
        for (const Hinge& hinge : assembly_.hinges) {
            // Where one plate hangs on the other's hinge there is nothing to open.
            const bool in_tree = assembly_.plates[static_cast<std::size_t>(hinge.a)].parent == hinge.b ||
                                 assembly_.plates[static_cast<std::size_t>(hinge.b)].parent == hinge.a;
            if (!in_tree) loops_.push_back(&hinge);
        }
        return true;
    }

    bool pose_at(double angle_deg, Pose& pose) {
        if (!place_at(angle_deg)) return false;
        pose.angle_deg = angle_deg;
        pose.turns.resize(frames_.size());
        local_turns(assembly_, frames_, pose.turns);
        return true;
    }

    // Whether some hinge opens further than we aim at when a viewer goes from one pose to the other.
    bool opens_between(const Pose& from, const Pose& to) {
        if (loops_.empty()) return false;
        interpolate(from.turns, to.turns, middle_);
        if (opens(middle_)) return true;
        if (to.angle_deg - from.angle_deg < kShortDeg) return false;
        interpolate(from.turns, middle_, quarter_);
        if (opens(quarter_)) return true;
        interpolate(middle_, to.turns, quarter_);
        return opens(quarter_);
    }

    [[nodiscard]] const HingeTree& tree() const { return tree_; }

 private:
    bool place_at(double angle_deg) { return place_card(assembly_, angle_deg, frames_, diagnostics_); }

    static void interpolate(std::span<const Quaternion> a, std::span<const Quaternion> b,
                            std::vector<Quaternion>& result) {
        result.resize(a.size());
        for (std::size_t i = 0; i < a.size(); ++i) result[i] = halfway(a[i], b[i]);
    }

    bool opens(std::span<const Quaternion> turns) {
        compose(assembly_, tree_, turns, frames_);
        const auto apart = [this](const Hinge& hinge, Vec2 a, Vec2 b) {
            const Vec3 gap = frames_[static_cast<std::size_t>(hinge.a)].point(a) -
                             frames_[static_cast<std::size_t>(hinge.b)].point(b);
            return dot(gap, gap) > kAimMm * kAimMm;
        };
        for (const Hinge* hinge : loops_) {
            if (apart(*hinge, hinge->a_line.a, hinge->b_line.a) ||
                apart(*hinge, hinge->a_line.b, hinge->b_line.b)) {
                return true;
            }
        }
        return false;
    }

    const Assembly& assembly_;
    Diagnostics& diagnostics_;
    std::vector<Frame> frames_;
    std::vector<Quaternion> middle_, quarter_;
    std::vector<const Hinge*> loops_;
    HingeTree tree_;
};

// Adds the angles of `more` (ascending) that are not next to one already there.
void merge(std::vector<double>& angles, const std::vector<double>& more) {
    std::vector<double> added;
    for (const double angle : more) {
        const auto above = std::lower_bound(angles.begin(), angles.end(), angle);
        if (above != angles.end() && *above - angle < kLeastStepDeg) continue;
        if (above != angles.begin() && angle - *(above - 1) < kLeastStepDeg) continue;
        if (!added.empty() && angle - added.back() < kLeastStepDeg) continue;
        added.push_back(angle);
    }
    const auto old_size = static_cast<std::ptrdiff_t>(angles.size());
    angles.insert(angles.end(), added.begin(), added.end());
    std::inplace_merge(angles.begin(), angles.begin() + old_size, angles.end());
}

// The angles asked for, before any refinement; nothing when there are too many.
std::optional<std::vector<double>> asked_angles(std::span<const SceneCard> cards,
                                                const OutputOptions& options, double best_deg, double plates,
                                                Diagnostics& diagnostics) {
    const Sweep range = sweep_of(cards);
    std::vector<double> angles{range.from_deg, range.to_deg};
    merge(angles, {rest_of(range)});
    merge(angles, {best_deg});
    for (const SceneCard& card : cards) {
        if (!moves(*card.assembly)) continue;
        std::vector<double> sampled;
        for (const Angle angle : card.motion->angles) sampled.push_back(rounded(angle.deg, kAngleDecimals));
        merge(angles, sampled);
        merge(angles, {rest_of(card.assembly->sweep)});
    }
    const double wanted = options.fps > 0.0 ? std::ceil(options.fps * options.duration_s) : 0.0;
    const double most = std::min(kMostKeys, kMostTurns / std::max(plates, 1.0));
    const double keys = std::max(wanted, static_cast<double>(angles.size()));
    if (!(keys <= most)) {
        diagnostics
            .error("model-too-large", {},
                   fmt::format(
                       "the animation would have {:.0f} keys for {:.0f} plates, {:.0f} keys are the most",
                       keys, plates, std::floor(most)))
            .hint("ask for fewer angles or fewer keys a second, or write fewer designs into one model");
        return std::nullopt;
    }
    std::vector<double> grid;
    for (std::uint32_t i = 1; i < static_cast<std::uint32_t>(wanted); ++i) {
        grid.push_back(
            rounded(range.from_deg + (range.to_deg - range.from_deg) * i / wanted, kAngleDecimals));
    }
    merge(angles, grid);
    return angles;
}

struct Refined {
    Track track;
    bool coarse = false;  // there was no room for all keys
};

// Halves the intervals of `angles` until nothing opens between. At most `most` keys, or as many as are given.
std::optional<Refined> refine(CardPoses& card, const std::vector<double>& angles, std::size_t most) {
    Refined result;
    Pose here;
    if (!card.pose_at(angles.front(), here)) return std::nullopt;
    record(here, result.track);
    std::vector<Pose> ahead;  // nearest last
    std::vector<Pose> spare;  // memory to use again
    const auto push = [&](double angle_deg) {
        ahead.push_back({});
        if (!spare.empty()) {
            std::swap(ahead.back(), spare.back());
            spare.pop_back();
        }
        return card.pose_at(angle_deg, ahead.back());
    };
    for (std::size_t i = 1; i < angles.size(); ++i) {
        if (!push(angles[i])) return std::nullopt;
        while (!ahead.empty()) {
            const Pose& next = ahead.back();
            const double step = next.angle_deg - here.angle_deg;
            const std::size_t keys = result.track.angles_deg.size() + ahead.size() + (angles.size() - 1 - i);
            if (step >= 2.5 * kLeastStepDeg && card.opens_between(here, next)) {
                if (keys < most) {
                    if (!push(rounded(0.5 * (here.angle_deg + next.angle_deg), kAngleDecimals)))
                        return std::nullopt;
                    continue;
                }
                result.coarse = true;
            }
            std::swap(here, ahead.back());
            spare.push_back(std::move(ahead.back()));
            ahead.pop_back();
            record(here, result.track);
        }
    }
    return result;
}

// The track at all angles, which include its own.
std::optional<Track> extended(CardPoses& card, Track track, const std::vector<double>& angles) {
    if (track.angles_deg.size() == angles.size()) return track;
    const std::size_t plates = track.turns.size() / track.angles_deg.size();
    Track result;
    result.turns.reserve(plates * angles.size());
    Pose pose;
    pose.turns.resize(plates);
    std::size_t next = 0;
    for (const double angle : angles) {
        if (next < track.angles_deg.size() && track.angles_deg[next] == angle) {
            pose.angle_deg = angle;
            for (std::size_t i = 0; i < plates; ++i) {
                const auto& turn = track.turns[next * plates + i];
                pose.turns[i] = {turn[0], turn[1], turn[2], turn[3]};
            }
            ++next;
        } else if (!card.pose_at(angle, pose)) {
            return std::nullopt;
        }
        record(pose, result);
    }
    return result;
}

Track iterative_track(const Assembly& assembly, const std::vector<double>& angles) {
    IterativePlacer placer(assembly);
    std::vector<Frame> frames(assembly.plates.size());
    Track track;
    Pose pose;
    pose.turns.resize(frames.size());
    for (const double angle : angles) {
        placer.place(Angle::degrees(angle), frames);
        pose.angle_deg = angle;
        local_turns(assembly, frames, pose.turns);
        record(pose, track);
    }
    return track;
}

}  // namespace

void frames_at_key(const Assembly& assembly, const HingeTree& tree, const Track& track, std::size_t key,
                   std::span<Frame> frames) {
    std::vector<Quaternion> turns(frames.size());
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const auto& turn = track.turns[key * turns.size() + i];
        turns[i] = {turn[0], turn[1], turn[2], turn[3]};
    }
    compose(assembly, tree, turns, frames);
}

std::optional<Keys> choose_keys(std::span<const SceneCard> cards, const OutputOptions& options,
                                Diagnostics& diagnostics) {
    Keys keys;
    keys.tracks.resize(cards.size());
    keys.trees.resize(cards.size());
    double plates = 0.0;
    std::vector<std::size_t> moving;
    for (std::size_t i = 0; i < cards.size(); ++i) {
        if (!moves(*cards[i].assembly)) continue;
        moving.push_back(i);
        plates += static_cast<double>(cards[i].assembly->plates.size());
    }
    keys.stances = stances_of(cards);
    keys.best_deg = best_opening(cards, keys.stances);
    if (moving.empty()) return keys;
    const auto angles = asked_angles(cards, options, keys.best_deg, plates, diagnostics);
    if (!angles) return std::nullopt;
    const auto most =
        static_cast<std::size_t>(std::min(kMostKeys, kMostTurnsRefined / std::max(plates, 1.0)));

    keys.angles_deg = *angles;
    keys.range = sweep_of(cards);
    std::vector<CardPoses> poses;
    bool coarse = false;
    for (const std::size_t i : moving) {
        CardPoses& one = poses.emplace_back(*cards[i].assembly, diagnostics);
        if (!one.start()) return std::nullopt;
        auto refined = refine(one, *angles, most);
        if (!refined) return std::nullopt;
        coarse = coarse || refined->coarse;
        std::vector<double> all;
        std::set_union(keys.angles_deg.begin(), keys.angles_deg.end(), refined->track.angles_deg.begin(),
                       refined->track.angles_deg.end(), std::back_inserter(all));
        keys.angles_deg = std::move(all);
        keys.trees[i] = one.tree();
        keys.tracks[i] = std::move(refined->track);
    }
    for (std::size_t n = 0; n < moving.size(); ++n) {
        const std::size_t i = moving[n];
        if (cards[i].motion->solver == Solver::iterative) {
            keys.tracks[i] = iterative_track(*cards[i].assembly, keys.angles_deg);
            continue;
        }
        auto track = extended(poses[n], std::move(keys.tracks[i]), keys.angles_deg);
        if (!track) return std::nullopt;
        keys.tracks[i] = std::move(*track);
    }
    if (coarse) {
        diagnostics
            .warning(
                "model-coarse", {},
                fmt::format(
                    "the animation has {} keys for {:.0f} plates, too few to keep every fold within {} mm",
                    keys.angles_deg.size(), plates, kMostOpeningMm))
            .hint("write fewer designs into one model, or check the size of the pages");
    }
    return keys;
}

}  // namespace popup
