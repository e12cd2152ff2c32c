#include "output/orientation.h"

#include <algorithm>
#include <cmath>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "output/poses.h"

namespace popup {
namespace {

constexpr double kParallel = 0.99;     // cosine between a plate and a page
constexpr double kMostParallel = 0.6;  // of the paper that rises: from there on it is a stage
constexpr double kLiesOpenDeg = 130.0;

bool is_card(const Assembly& assembly) { return moves(assembly) && assembly.covers.size() > 1; }

// Of each plate, whether it is a cover, or lies flat on one or on what does.
std::vector<char> lying_on_covers(const Assembly& assembly) {
    constexpr char kUnknown = 2;
    std::vector<char> lies(assembly.plates.size(), kUnknown);
    for (const int cover : assembly.covers) nth(lies, cover) = 1;
    std::vector<int> way;
    for (std::size_t i = 0; i < lies.size(); ++i) {
        way.clear();
        int at = static_cast<int>(i);
        char found = 0;
        while (at >= 0 && (found = nth(lies, at)) == kUnknown) {
            way.push_back(at);
            const Plate& plate = nth(assembly.plates, at);
            found = 0;
            at = plate.lying != Lying::free ? plate.parent : -1;
        }
        for (const int plate : way) nth(lies, plate) = found;
    }
    return lies;
}

// The paper that rises from the card, in mm²: what is parallel to one of its pages, and the rest.
struct Risen {
    double parallel = 0.0, other = 0.0;
};
Risen risen(const Assembly& assembly, std::span<const Frame> frames) {
    const Vec3 ground = nth(frames, assembly.covers.back()).normal();
    const Vec3 wall = nth(frames, assembly.covers.front()).normal();
    const std::vector<char> lies = lying_on_covers(assembly);
    Risen sum;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (lies[i] != 0) continue;
        const Vec3 normal = frames[i].normal();
        const bool is_parallel =
            std::max(std::abs(dot(normal, ground)), std::abs(dot(normal, wall))) > kParallel;
        (is_parallel ? sum.parallel : sum.other) += std::abs(signed_area(assembly.plates[i].outline.outer));
    }
    return sum;
}

Orientation guessed(const Assembly& assembly) {
    if (!is_card(assembly)) return Orientation::flat;
    std::vector<Frame> frames(assembly.plates.size());
    Diagnostics unheard;  // whoever places the card next tells of it
    if (!place_card(assembly, rest_of(assembly.sweep), frames, unheard)) return Orientation::flat;
    const Risen paper = risen(assembly, frames);
    const double all = paper.parallel + paper.other;
    if (all > 0.0 && paper.parallel >= kMostParallel * all) return Orientation::stage;
    return all > 0.0 ? Orientation::flat : Orientation::upright;
}

// Directions of the scene, in the world of the plates; unit and square to each other.
struct Bearings {
    Vec3 right, away, up;
    [[nodiscard]] Vec3 turned(Vec3 v) const { return {dot(v, right), dot(v, away), dot(v, up)}; }
};

Bearings bearings_of(Orientation orientation, const Assembly& assembly, std::span<const Frame> frames) {
    switch (orientation) {
        case Orientation::upright:
            return {{1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}};
        case Orientation::stage: {
            const Frame& ground = nth(frames, assembly.covers.back());
            return {ground.axes[1], -ground.axes[0], ground.normal()};
        }
        case Orientation::guessed:
        case Orientation::flat:
            return {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    }
    broken_invariant("an orientation is one of its enumerators", __FILE__, __LINE__);
}

}  // namespace

Stance stance_of(const Assembly& assembly) {
    const Orientation said = assembly.orientation;
    const bool can_be = said == Orientation::stage ? is_card(assembly) : moves(assembly);
    if (said == Orientation::guessed || !can_be) return {guessed(assembly), true};
    return {said, false};
}

void stand(Orientation orientation, const Assembly& assembly, std::span<Frame> frames) {
    if (orientation != Orientation::flat) {
        const Bearings bearings = bearings_of(orientation, assembly, frames);
        for (Frame& frame : frames) {
            for (Vec3& axis : frame.axes) axis = bearings.turned(axis);
            frame.origin = bearings.turned(frame.origin);
        }
    }
    settle(assembly, frames);
}

void settle(const Assembly& assembly, std::span<Frame> frames) {
    if (!is_folded_sheet(assembly)) return;
    std::vector<std::size_t> root(frames.size());
    std::vector<double> low(frames.size(), HUGE_VAL);  // by root
    for (std::size_t i = 0; i < frames.size(); ++i) {
        root[i] = i;
        while (assembly.plates[root[i]].parent >= 0)
            root[i] = static_cast<std::size_t>(assembly.plates[root[i]].parent);
        double& lowest = low[root[i]];
        for (const Vec2 p : assembly.plates[i].outline.outer) lowest = std::min(lowest, frames[i].point(p).z);
    }
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i].origin.z -= low[root[i]];
}

std::vector<Stance> stances_of(std::span<const SceneCard> cards) {
    std::vector<Stance> stances;
    stances.reserve(cards.size());
    for (const SceneCard& card : cards) stances.push_back(stance_of(*card.assembly));
    return stances;
}

double best_opening(std::span<const SceneCard> cards, std::span<const Stance> stances) {
    const Sweep sweep = sweep_of(cards);
    const double rest = rest_of(sweep);
    bool all_lie = !cards.empty();
    for (std::size_t i = 0; i < cards.size(); ++i) {
        all_lie = all_lie && is_card(*cards[i].assembly) && stances[i].orientation == Orientation::flat;
    }
    return all_lie ? std::max(rest, std::min(kLiesOpenDeg, sweep.to_deg)) : rest;
}

}  // namespace popup
