// Scores that tell on the cut piece which way the paper is folded there.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "popup/geometry.h"
#include "popup/profile.h"

namespace popup {

// Whether scores of this fold have gaps: where folds are scored from one side, those that go away from who
// looks at that side. On fronts these are mountain folds, and those of tabs, whose front is glued; on backs
// they are valley folds. Scores from both sides need none: the paper folds away from each.
bool is_broken(Operation fold, const Profile& profile, ScoreSide side);

// Where a line lies in the fold that it is a part of.
struct FoldPart {
    double before = 0.0;  // mm of the fold before the line
    double whole = 0.0;   // mm of all of it; 0: the line has no length
    bool back = false;    // the line runs back along the fold
};

// A line of a fold, and whether the fold follows it from its second end to its first.
struct FoldWay {
    std::size_t line = 0;
    bool back = false;
};

// Curved folds are chains of chords: lines that meet end to end, no third one there, and turn by at most 30°
// are one fold. `lines`: of one operation on one piece. Each line that has a length is in one fold. Cost: n
// log n.
std::vector<std::vector<FoldWay>> folds_of(std::span<const Segment> lines);
// A part for each line.
std::vector<FoldPart> parts_of_folds(std::span<const Segment> lines);

// What is scored of a line of a fold that has gaps: in the middle of each 8 mm along the whole fold, or of
// what comes nearest to that, 1 mm is left out, and never more than a quarter. The ends of folds are scored.
// Empty: all of the line lies in a gap. Cost: linear in gaps. Precondition: the line has a length.
std::vector<Segment> broken_score(const Segment& line, const FoldPart& part);
// Of a line that is all of its fold.
std::vector<Segment> broken_score(const Segment& line);

}  // namespace popup
