// Folds that have other angles after an edit than the drawing gives them.
#pragma once

#include <vector>

#include "folded/carton/examine_edit.h"
#include "folded/carton/vertices.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/sheet_edit.h"

namespace popup::folded {

// Gives the lines of `made`, which stand where they go, the angles of folds that turn further, or less far,
// than in `shape`, and tells of the most (`folds-turn`). Angles are not given where the options end the
// motion before its end, and to lines whose folds differ while what they cut goes apart. Cost: linear in
// folds, times those of one line.
void turn_folds(const CreasePattern& pattern, const FoldOptions& options, const Vertices& shape,
                const ExaminedEdit& examined, EditedSheet& made, Diagnostics& diagnostics);

}  // namespace popup::folded
