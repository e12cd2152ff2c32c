// Pieces that are glued flat, and what can only be glued when they are there.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "gluing/bonds.h"

namespace popup {

// Of each piece, those on the same ground (`order` has its bearers) that must lie there before it: flat ones
// out of which a wall of it rises, for they could not be laid down round the wall; and of two flat ones that
// lie over one another, over more than 1 mm² and on one side of one plate, the one that the assembly names
// first. A wall is a plate that stands along more than 1 mm of its seam inside of the flat one's paper, 0.5
// mm away from its edges, and does not lie flat itself; discs that turn are not meant. No circle, unless the
// assembly has a piece that is glued flat on two plates. Cost: n log n in plates and tabs, and in pairs that
// are near each other, 200 earlier ones of a flat piece at most.
std::map<int, std::set<int>> flat_before(const Assembly& assembly, const std::vector<Bond>& bonds,
                                         const GluingOrder& order, const GluePoses& poses);

}  // namespace popup
