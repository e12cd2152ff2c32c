#include "lsp/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace popup::lsp {

std::span<const Service> service_table() {
    static const std::array kRows{xml_service(), flatlang_service()};
    return kRows;
}

const Service* find_service(std::string_view language) {
    const std::span<const Service> rows = service_table();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const Service& one) { return one.language == language; });
    return row == rows.end() ? nullptr : &*row;
}

std::string code_markdown(const CodeInfo& code) {
    return fmt::format("**{}**: {}\n\n{}", code.code, code.summary, code.explanation);
}

std::string finding_markdown(const Diagnostic& diagnostic) {
    std::string text = fmt::format("{}: {}", to_string(diagnostic.severity), diagnostic.message);
    for (const std::string& hint : diagnostic.hints) text += fmt::format("\n\n*Hint:* {}", hint);
    if (const CodeInfo* code = find_code(diagnostic.code)) text += "\n\n" + code_markdown(*code);
    return text;
}

}  // namespace popup::lsp
