// What a machine marks so that pieces can be glued: on which side, and how targets are shown.
#pragma once

#include <vector>

#include "popup/pattern.h"
#include "popup/profile.h"

namespace popup {

// Ticks in the corners of a glue target, a little inside it, so that what is glued there covers them: one
// line a corner, along both of its edges. An outline with under three corners is shown by dashes along it.
std::vector<std::vector<Vec2>> target_ticks(const Ring& outline);

// Whether this side of the sheet has the targets and the numbers of tabs, or the names of pieces, of which
// nothing glued covers those on the front; or of them only what is on the back of the paper and covered
// there: targets of pieces that are glued on from behind, and the numbers of pieces that are glued flat.
bool marks_joints(MarksOn where, ScoreSide side, bool back);
bool marks_names(MarksOn where, ScoreSide side, bool back);
bool marks_covered_backs(MarksOn where, ScoreSide side, bool back);

}  // namespace popup
