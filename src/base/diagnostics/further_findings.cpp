#include "base/diagnostics/further_findings.h"

#include <charconv>
#include <string_view>
#include <utility>

namespace popup {
namespace {

std::string message_of(const FurtherFindings& further) {
    return std::to_string(further.count) + " more " + std::string(to_string(further.severity)) +
           (further.count == 1 ? " of this kind is not shown" : "s of this kind are not shown");
}

}  // namespace

Diagnostic further_findings(std::string code, std::string file, const FurtherFindings& further) {
    return {Severity::remark, std::move(code), std::move(file), {}, message_of(further), {}, {}, {}, {}};
}

std::optional<FurtherFindings> further_of(const Diagnostic& diagnostic) {
    if (diagnostic.severity != Severity::remark || diagnostic.place != Place{}) return std::nullopt;
    const std::string& text = diagnostic.message;
    std::size_t count = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), count).ec != std::errc() || count == 0)
        return std::nullopt;
    for (const Severity severity : {Severity::remark, Severity::warning, Severity::error}) {
        if (text == message_of({count, severity})) return FurtherFindings{count, severity};
    }
    return std::nullopt;
}

Severity told_severity(const Diagnostic& diagnostic) {
    if (diagnostic.severity != Severity::remark) return diagnostic.severity;
    const auto further = further_of(diagnostic);
    return further ? further->severity : diagnostic.severity;
}

}  // namespace popup
