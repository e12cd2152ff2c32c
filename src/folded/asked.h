// Which angles a drawing asks for, and shapes that close at just these.
#pragma once

#include "folded/path.h"

namespace popup::folded {

// Angles that differ by more are others, degrees: those of a drawing are rounded.
inline constexpr double kOtherAngleDeg = 1.0;

// Whether the pattern or the options say how far this fold goes. Else it goes as far as all do.
bool is_asked(const CreasePattern& pattern, const FoldOptions& options, const Fold& fold);

// Adds an `angle-not-found` remark for each angle of the options that is for no fold of the pattern.
void tell_unused_angles(const CreasePattern& pattern, const FoldOptions& options, Diagnostics& diagnostics);

// Sets of folds that leave the flat sheet and end elsewhere, though every one of their angles is asked for,
// and all loops close at these: they end as asked. There `paths` follow the way that was found for as long as
// no fold goes beyond its angle, and in the last part of the motion, of kJump of it, each fold goes straight
// to its angle, while the loops are open: a way was not found (Cluster::jumps_from). False: there is no such
// set, and nothing is changed. Cost: that of a few steps of closure.
bool end_as_asked(const CreasePattern& pattern, const FoldOptions& options, const Sheet& sheet, Paths& paths,
                  Work& work);

inline constexpr double kJump = 1.0 / 64.0;

}  // namespace popup::folded
