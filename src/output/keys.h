// Where an animation has its keys.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "output/hinge_tree.h"
#include "output/orientation.h"
#include "popup/output.h"

namespace popup {

// What a scene promises of the time between two keys, where a viewer interpolates every hinge on its own.
inline constexpr double kMostOpeningMm = 0.05;

// One card's turns at ascending opening angles; entry k * plates + i is plate i's at angles_deg[k].
struct Track {
    std::vector<double> angles_deg;
    std::vector<std::array<float, 4>> turns;
};

// Where a viewer puts the plates at the key of this number.
void frames_at_key(const Assembly& assembly, const HingeTree& tree, const Track& track, std::size_t key,
                   std::span<Frame> frames);

// Key angles for all cards at once, ascending and distinct in 32 bits, and each card's turns at them. The
// angles are the ends and the middle of the sweep (0, 90 and 180), where the cards are seen best, every
// sampled angle of every card (those nearer than 1e-4 degrees to another may be left out), with options.fps >
// 0 as many more as give that many keys a second, and what it takes, found by halving, so that no hinge opens
// by more than kMostOpeningMm at any angle in between as a viewer composes the plates. Consecutive turns of a
// plate never have a negative product, so that interpolation goes the short way. The angles are chosen by the
// closed form, whatever the solver; turns are each card's own solver's. Errors: `locks` where a linkage
// cannot reach an angle between the sampled ones; `model-too-large` for more turns than a file may hold.
// Warning: `model-coarse` when there was no room for all keys wanted. Where nothing moves there are no keys.
// Cost: plates × keys.
struct Keys {
    Sweep range;  // of all cards: angles_deg begin and end with it
    std::vector<double> angles_deg;
    std::vector<Track> tracks;     // one a card, all with the same angles; empty for what does not move
    std::vector<HingeTree> trees;  // likewise
    std::vector<Stance> stances;   // of all cards, whether they move or not
    double best_deg = 90.0;        // best_opening() of them
};
std::optional<Keys> choose_keys(std::span<const SceneCard> cards, const OutputOptions& options,
                                Diagnostics& diagnostics);

}  // namespace popup
