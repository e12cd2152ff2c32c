// Crease patterns in FOLD, the JSON format for folded paper of Demaine, Ku and Lang, versions 1.0 to 1.2
// (https://github.com/edemaine/fold, doc/spec.md).
#pragma once

#include <optional>
#include <string_view>

#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup::fold {

// Reads one frame of a file: ReadOptions::frame, or the root, or if that is folded and another is a crease
// pattern, the first that is (remark `fold-frame`). A frame inherits from its parent what it does not say.
//
// Corners must lie in one plane: of equal z, or of equal y as where y goes up, and then -z is up the page.
// Edges are edges_vertices, or where these are missing the sides of
// faces_vertices; what they are is edges_assignment: B and C cuts, M and V folds, U a fold that does not say
// which way, F and J no folds, or the same as small letters. Without assignments edges of one face are cuts
// and others are folds; without faces those around everything are cuts. Fold angles are edges_foldAngle, or
// as version 1.0 has it edges_foldAngles, in degrees; M and V without an angle are folded by 180°, as are
// those with 0 in frames that are flat; where others are folded, these are scored and lie flat. Coordinates
// in a unit (frame_unit) are taken by it; others have none, and the longer side of the pattern is made
// kSheetMm long (remark `fold-size`). What the file says beside is taken along (CreasePattern::carried).
//
// Errors, located: `fold-syntax`, `fold-value`, `fold-no-pattern`, `document-too-large`. Cost: linear.
std::optional<CreasePattern> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);

// Of patterns without a unit.
inline constexpr double kSheetMm = 200.0;

// True of a text that begins as one of FOLD.
bool recognises(std::string_view text);

}  // namespace popup::fold
