// The popup XML document as an input language.
#pragma once

#include <optional>
#include <string>

#include "popup/language.h"

namespace popup::xml {

// The row's functions, as language.h promises them.
Reading read_document(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
// The design alone.
std::optional<Design> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
std::string patch(const Source& source, const Design& design);

}  // namespace popup::xml
