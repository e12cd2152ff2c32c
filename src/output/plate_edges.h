// The edges of a plate's outline, as models show them: which are folds, and which were cut.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "popup/assembly.h"

namespace popup {

struct PlateEdges {
    std::vector<Vec2> points;  // of the outline and then of its holes, mm on the plate's page
    std::vector<std::array<std::uint32_t, 2>> cuts, folds;  // both ends of each edge, as numbers of points
};

// By plate: the lines on it that it turns about. Hinges that are glued are none. Cost: linear.
std::vector<std::vector<Segment>> folds_of_plates(const Assembly& assembly);

// An edge is a fold where it lies along one of `folds`, within 0.05 mm and 0.6°. Cost: edges × folds.
PlateEdges edges_of(const Plate& plate, const std::vector<Segment>& folds);

}  // namespace popup
