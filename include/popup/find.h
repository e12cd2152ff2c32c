// Findings of a design, for who needs nothing else of it: an editor.
#pragma once

#include "popup/compile.h"

namespace popup {

// As compile_further() up to Stage::pattern, but for the pattern, which is not made: its findings are those
// of judge_tabs(). Options::until is not looked at.
void find_further(CompiledDesign& one, const CompileOptions& options);

}  // namespace popup
