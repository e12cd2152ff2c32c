// Documents with their repairs written into them.
#pragma once

#include <optional>
#include <string>

#include "popup/compile.h"

namespace popup {

// The document with the repairs of `one`, and those of what these uncover, until nothing is left to repair;
// so a second time finds nothing to do. Of a drawing that is read as a card: the document that it becomes.
// nullopt when that does not come to an end. Preconditions: `one` was compiled with these options up to
// Stage::check or further, without errors; `language` is that of its source, and can be written back or is
// drawn. Cost: some readings, checks and simulations without an examination.
std::optional<std::string> mended_document(const CompiledDesign& one, const Language& language,
                                           const CompileOptions& options);

}  // namespace popup
