// The closed card: what sticks out of it, and how its plates lie on one another.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "motion/plate_shape.h"
#include "motion/recall.h"
#include "popup/motion.h"

namespace popup {

// Protrusions are those of find_protrusions(). The layers are told apart at the least opening, where plates
// that lie on one another in the closed card stand apart and have not moved. Preconditions: the assembly has
// covers and closes flat; the joints reach both angles. Shapes by plate. Cost: n log n in triangles, and in
// pairs of plates that lie over one another. `recall`: where little has changed only the pairs there are
// looked at, with one result; null: all are.
ClosedCard closed_card(const Assembly& assembly, std::span<const PlateShape> shapes,
                       std::optional<double> paper_mm, Recall* recall = nullptr);

}  // namespace popup
