// The parts of one owner of lines: of all lines that have none, or of one piece of a sheet.
#pragma once

#include <vector>

#include "parts/flat_parts.h"
#include "parts/tracing.h"
#include "parts/work.h"
#include "popup/diagnostics.h"

namespace popup::drawing {

struct OwnedLines {
    std::vector<const TracedLine*> lines;
    std::vector<const TracedFill*> fills;
    std::vector<const TracedText*> texts;
};

// Every outermost contour of these lines, with what lies in it. Names may be missing or equal. Empty when
// there is no contour, or after an error.
std::vector<FlatPart> make_parts_of(const Tracing& tracing, int owner, const OwnedLines& owned, Work& work,
                                    Diagnostics& diagnostics);

}  // namespace popup::drawing
