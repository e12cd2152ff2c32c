#include "run/unused_allowances.h"

#include <vector>

namespace popup {
namespace {

constexpr std::string_view kUnused = "unused-allow";

void tell(Diagnostics& diagnostics, const Allowance& one) {
    const std::string where = !one.within           ? "in this document"
                              : one.element.empty() ? "of this element"
                                                    : "of \"" + one.element + "\"";
    diagnostics
        .warning(kUnused, one.place, "there is no " + one.code + " " + where + " that this could allow")
        .hint("take " + one.code + " out of the comment, or the comment away")
        .about(one.element);
}

}  // namespace

void tell_unused_allowances(Diagnostics& diagnostics, const std::set<std::string_view>& unasked) {
    // A copy, since what is told may use an allowance.
    const std::vector<Allowance> all = diagnostics.allowances();
    for (const Allowance& one : all) {
        if (!one.used && one.code != kUnused && !unasked.contains(one.code)) tell(diagnostics, one);
    }
    diagnostics.apply_allowances();
}

}  // namespace popup
