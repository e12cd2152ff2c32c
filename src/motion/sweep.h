// Which openings of a sweep the passes over a motion look at.
#pragma once

#include <array>

#include "popup/assembly.h"

namespace popup {

// How far from a flat closed state openings are looked at. A card of 100 mm is open by less than 0.02 mm
// there.
inline constexpr double kLeastOpeningDeg = 0.01;

// The smallest opening looked at: where everything lies in one plane at the beginning, plates that lie on one
// another are told apart just after it.
inline double least_opening(const Sweep& sweep) {
    return sweep.closed_flat ? sweep.from_deg + kLeastOpeningDeg : sweep.from_deg;
}

// The opening of a sweep that corresponds to `deg` of one from 0° to 180°.
inline double opening_at(const Sweep& sweep, double deg) {
    return sweep.from_deg + deg * ((sweep.to_deg - sweep.from_deg) / 180.0);
}

// Openings that have nothing to do with each other, of a sweep from 0° to 180°: what holds at all of them
// holds of the linkage, and not of one of its poses.
inline constexpr std::array kTellingDegs{37.3, 91.7, 143.9};

}  // namespace popup
