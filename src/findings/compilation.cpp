// What a compilation says of itself.
#include <algorithm>

#include "popup/compile.h"

namespace popup {

std::string_view version() { return POPUP_VERSION; }

bool Compilation::has_errors() const {
    return run_diagnostics.has_errors() ||
           std::any_of(designs.begin(), designs.end(),
                       [](const CompiledDesign& one) { return one.diagnostics.has_errors(); });
}

bool Compilation::has_findings() const {
    return run_diagnostics.has_findings() ||
           std::any_of(designs.begin(), designs.end(),
                       [](const CompiledDesign& one) { return one.diagnostics.has_findings(); });
}

}  // namespace popup
