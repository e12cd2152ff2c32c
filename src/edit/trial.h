// Documents with an edit that is tried out, and whether it makes anything worse.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "popup/assembly.h"
#include "popup/compile.h"
#include "popup/diagnostics.h"

namespace popup::edit {

// Whether edits of its text can be tried: it is a document that people write, and that was checked.
bool can_be_tried(const CompiledDesign& design, const CompileOptions& options);

// The options for a compilation of which only the findings count: nothing is tried out for their hints, no
// examination is remembered, and no progress is told.
CompileOptions without_hints(CompileOptions options);

// The source, read, checked and assembled as in a compilation. nullopt: that cannot be.
std::optional<Assembly> assembled(const Source& source, const CompileOptions& options, Diagnostics& found);

// How many warnings and errors there are of a code for an element, but for those about allowances.
using FindingCounts = std::map<std::pair<std::string, std::string>, int>;
FindingCounts count_findings(const Diagnostics& found);
// Whether there are more of any than there were.
bool finds_more(const FindingCounts& before, const FindingCounts& after);

}  // namespace popup::edit
