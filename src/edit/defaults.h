// What a new element is where no more is told than what it stands on: a card without findings, if that can
// be.
#pragma once

#include <string_view>
#include <vector>

#include "edit/session.h"

namespace popup::edit {

// Share of the size of a new element that lengths have which must be given, and have no standard.
inline constexpr double kHeightShare = 0.15;

// The form of a cut element that its fold wants: inverted ones stand on mountain folds.
const ElementInfo& form_on(const ElementInfo& info, const PageFold& fold);

// The length, in mm, of which a measure of a new element is a share: that of its fold, or more where its tabs
// and glued areas would be too small to hold.
double room_for(const ElementInfo& info, std::string_view measure, double fold_mm);

// How much smaller than elsewhere a measure of a new element is on that fold: 1 but for the piece of a pivot
// on a fold that the pivot's own strip closes on, where a larger piece reaches across that.
double smaller_on(const ElementInfo& info, std::string_view measure, const PageFold& fold);

// Puts what is glued on a plate in the middle of what is free there, in a size that fits. Its place stays
// where one of x and y is `given`, as each size does that is. In a card with errors everything stays.
// Cost: that of check() and assemble().
void put_on_plate(Session& session, Structure& made, const ElementInfo& info, const std::vector<bool>& given,
                  std::vector<double>& measures);

}  // namespace popup::edit
