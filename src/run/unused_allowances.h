// Allowances that were for nothing.
#pragma once

#include <set>
#include <string_view>

#include "popup/diagnostics.h"

namespace popup {

// Adds an `unused-allow` warning for each allowance that no finding was concerned by, but for codes of
// `unasked`, which nothing was looked at for. These warnings can be allowed like others; an allowance for
// them is never told of. Precondition: everything has been looked at, and apply_allowances() has been called.
void tell_unused_allowances(Diagnostics& diagnostics, const std::set<std::string_view>& unasked);

}  // namespace popup
