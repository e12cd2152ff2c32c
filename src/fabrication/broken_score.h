// Scores that tell on the cut piece which way the paper is folded there.
#pragma once

#include <vector>

#include "popup/geometry.h"
#include "popup/profile.h"

namespace popup {

// Whether scores of this fold have gaps: where folds are scored from one side, those that go away from who
// looks at that side. On fronts these are mountain folds, and those of tabs, whose front is glued; on backs
// they are valley folds. Scores from both sides need none: the paper folds away from each.
bool is_broken(Operation fold, const Profile& profile, ScoreSide side);

// What is scored of a line that has gaps: in the middle of each 8 mm, or of what comes nearest to that, 1 mm
// is left out, and never more than a quarter. The ends are scored. Cost: linear in gaps.
// Precondition: the line has a length.
std::vector<Segment> broken_score(const Segment& line);

}  // namespace popup
