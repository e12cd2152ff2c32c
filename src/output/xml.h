// The popup document in its canonical spelling.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "popup/output.h"

namespace popup {

class CheckedDesign;
struct Design;

// A document that schemas/popup.xsd accepts and that reads as the same design, in the design's own unit, with
// at most six decimals. Dropped structures and lines are left out. Never fails.
std::optional<std::string> write_xml(const CheckedDesign& design, const OutputOptions& options,
                                     Diagnostics& diagnostics);

// The same of a design that has not been checked. Precondition: its numbers are finite and its types known.
std::string write_document(const Design& design, std::string_view source = {});

}  // namespace popup
