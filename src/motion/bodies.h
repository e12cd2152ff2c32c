// Plates that never move against each other.
#pragma once

#include <vector>

#include "popup/assembly.h"

namespace popup {

// By plate, the body that it is part of, known by its first plate: plates that are glued flat on one another,
// or lie beside one another in one plane, are one body. What turns on a rivet is not part of what it is on.
// Cost: linear in joints and plates.
//
//     const std::vector<int> body = bodies_of(assembly);
//     if (body[0] == body[3]) ...  // whatever the opening, plate 3 lies on plate 0 as it does now
std::vector<int> bodies_of(const Assembly& assembly);

}  // namespace popup
