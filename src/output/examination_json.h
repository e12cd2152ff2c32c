// What the examination of a motion found, as JSON: the same members in the report and in the motion stage.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "popup/motion.h"

namespace popup {

// Members, in this order:
//   collisions: [{plates: [a, b], from_deg, to_deg, angle_deg, depth_mm, deepest_deg, excess_mm, longer,
//     at_fold, corner_mm: [x, y], point_mm: [x, y, z]}], angle_deg being to_deg, where the closing card first
//     meets the collision;
//   undecided_below_deg; decided_up_to_deg; undecided: [{plates, from_deg, to_deg}];
//   clearance: [{plates, from_deg, to_deg, least_mm, least_deg, point_mm}], null when it was not asked for;
//   protrusion_mm (the largest, 0 when there is none);
//   protrusions: [{plate, by_mm, direction: [x, y, z], point_mm, corner_mm}];
//   max_layers; layer_order: [plate …], null when there is none; layer_cycle: [plate …], left out when empty;
//   closed_thickness_mm, null when the paper's thickness is not known.
// The same members, all null, when there is no examination. Plates go by name. Rounded: angles to 0.001°
// (undecided_below_deg upwards, so that no more is claimed than was shown), lengths to 1e-4 mm, points to
// 0.001 mm, directions to 1e-6.
nlohmann::ordered_json examination_json(const Assembly& assembly,
                                        const std::optional<Examination>& examination);

// The plates that the opening does not force: [{plates: [plate …], free}], `free` being in how many ways.
nlohmann::ordered_json not_forced_json(const Assembly& assembly, const std::vector<FreePlates>& all);

// The values that a collision shows wherever it is told, rounded as above.
double told_deg(double angle_deg);
double told_mm(double length_mm);

}  // namespace popup
