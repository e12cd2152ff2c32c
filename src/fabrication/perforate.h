// Perforations of curved folds.
#pragma once

#include <span>
#include <vector>

#include "popup/profile.h"

namespace popup {

// The cuts of a perforated fold that is a chain of chords: what perforated() has for a line, along all of the
// chain. A cut that goes over a corner has that corner. Cost: linear in corners and cuts.
// Precondition: at least two points, and a length.
std::vector<std::vector<Vec2>> perforated_along(std::span<const Vec2> chain, const Perforation& perforation);

}  // namespace popup
