// The one line that stands for findings that were counted and not kept.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "popup/diagnostics.h"

namespace popup {

struct FurtherFindings {
    std::size_t count = 0;  // ≥ 1
    Severity severity = Severity::error;
};

// A remark on the file as a whole: "150 more warnings of this kind are not shown".
Diagnostic further_findings(std::string code, std::string file, const FurtherFindings& further);

// What such a remark stands for; nothing for any other diagnostic.
std::optional<FurtherFindings> further_of(const Diagnostic& diagnostic);

// The severity that it counts with: of such a remark, that of the findings that are not shown.
Severity told_severity(const Diagnostic& diagnostic);

}  // namespace popup
