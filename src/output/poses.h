// Cards of a model at an opening angle.
#pragma once

#include <algorithm>
#include <span>

#include "popup/diagnostics.h"
#include "popup/motion.h"
#include "popup/output.h"

namespace popup {

// Between two cards of a model, where they are widest.
inline constexpr double kCardGapMm = 20.0;

// The openings of all cards of a model together, 0° to 180° where there is none. A card stays as it is at the
// ends of its own sweep.
Sweep sweep_of(std::span<const SceneCard> cards);
// Where models rest: in the middle of the sweep; a card that opens to less than 180° at 90°, or as far open
// as it gets.
inline double rest_of(const Sweep& sweep) {
    const double middle = 0.5 * (sweep.from_deg + sweep.to_deg);
    return sweep.from_deg == 0.0 && middle < 90.0 ? std::min(sweep.to_deg, 90.0) : middle;
}

// Places the plates in closed form, as they are at the opening of the card's sweep that is nearest to the
// angle. Where a linkage cannot reach the angle: false, and the error `locks`, about its joint.
bool place_card(const Assembly& assembly, double angle_deg, std::span<Frame> frames,
                Diagnostics& diagnostics);

}  // namespace popup
