// Several cards in one model: where each stands.
#pragma once

#include <span>
#include <vector>

#include "output/keys.h"
#include "popup/output.h"

namespace popup {

// How far each card is moved along +X, in mm: the first and one that is alone not at all, each other one so
// that it stands kCardGapMm beside the one before where both are widest at any of their keys. Rounded to
// 1e-6 mm. Cost: corners × keys of cards that are not alone.
std::vector<double> card_shifts(std::span<const SceneCard> cards, const Keys& keys);

}  // namespace popup
