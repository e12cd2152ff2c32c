// Plates that go through paper just where it is folded.
//
// The two plates of a fold end at it. A third plate in whose plane the fold lies, as in a card that is its
// own mirror image, has nothing but their edge in common with either: no two of the three cross. And yet the
// paper is whole there, and where one side of the third plate lies between the two and the other does not, it
// goes through.
#pragma once

#include <span>
#include <vector>

#include "motion/plate_shape.h"
#include "popup/motion.h"

namespace popup {

// Of each such plate and fold a contact with either plate of the fold for each stretch of angles, to 0.001°.
// It has no depth, and `longer` is the plate that goes through. By a, b, from_deg. It counts where the fold
// lies in the plate's plane whatever the opening, and where for more than 0.02 mm of the fold there is paper
// on both its sides and the plate reaches 0.01 mm further. Looked at are angles 4° apart, finer where the
// card is nearly closed: what begins and ends between two is not found. Cost: one placement and plates times
// folds for up to 300 plates, else eight placements and near linear. Where a fold lies in a plate's plane, 52
// placements more, and 13 for each end of a stretch.
std::vector<Contact> find_through_folds(const Assembly& assembly, std::span<const PlateShape> shapes);

}  // namespace popup
