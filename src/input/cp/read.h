// Crease patterns as ORIPA, ORIHIME, Oriedita and others exchange them: .cp files.
#pragma once

#include <optional>
#include <string_view>

#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup::cp {

// One line of the pattern a line: "KIND X1 Y1 X2 Y2". Kinds are 1, an edge or a cut; 2, a mountain; 3, a
// valley; 4 and 0, no fold. y goes down the page, as those programs show it. Folds are folded by 180°. There
// is no unit: the longer side is made kSheetMm long (remark `cp-size`). Lines of no length are left out;
// empty lines, and what begins with "#", are disregarded.
//
// Errors, located: `cp-value`, of the first ten lines that have one, and `cp-no-pattern`. Cost: linear.
std::optional<CreasePattern> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);

inline constexpr double kSheetMm = 200.0;

// True of a text whose first line is one of a pattern.
bool recognises(std::string_view text);

}  // namespace popup::cp
