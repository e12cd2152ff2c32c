// How far the folds between walls side by side go so that the walls meet around a tube.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "popup/geometry.h"

namespace popup::folded {

// Walls that meet in many shapes are taken to have one of these.
struct ClosingAngles {
    std::vector<double>
        deg;               // by wall: of the fold between it and the next, the last with the first; (0, 180)
    std::string_view why;  // of all shapes that they could have; empty: there is no choice
};

// Best first; empty: no shape is known in which walls so wide meet.
//
// * Each by the same share of 360°, where they meet so to a fiftieth of the way around; three walls as the
//   triangle has it. Then there are no others. Else
// * as a panel has it that closes an end: `of_end`, of fold_angles_of_end();
// * three or four walls with right angles between them, where one wall is left that goes straight back to the
//   first, as in boxes with a slanted wall; or three of which the first is as wide as the third, and the rest
//   on a circle, as in houses. Not where more than four walls make nearly a regular polygon;
// * all corners on a circle: the shape with the most room inside.
//
// Those of an end meet exactly, all others to what the widths miss. Cost: linear in walls.
std::vector<ClosingAngles> closing_angles(const std::vector<double>& widths,
                                          const std::optional<std::vector<double>>& of_end);

// The outer angles of a panel that hangs on the end of one of the walls by `fold`, by wall; nullopt unless it
// has as many sides as there are walls, as long as these are wide, in their order.
std::optional<std::vector<double>> fold_angles_of_end(const Ring& outline, const Segment& fold,
                                                      const std::vector<double>& widths, std::size_t wall);

// How far walls that are folded so are from meeting, mm.
double gap_of(const std::vector<double>& widths, const std::vector<double>& deg);

inline constexpr double kMeets = 0.02;  // of the way around: by boards walls miss one another

}  // namespace popup::folded
