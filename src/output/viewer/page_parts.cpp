#include "output/viewer/page_parts.h"

#include <fmt/format.h>

#include "output/html_page.h"
#include "output/viewer/page_files.h"

namespace popup {

std::string viewer_style(std::span<const std::string_view> names) {
    std::string text = "\n";
    for (const std::string_view name : names) append_page_lines(text, page_file(viewer_files(), name));
    return text;
}

std::string viewer_script(std::span<const std::string_view> names) {
    std::string text = "\n(() => {\n'use strict';\n";
    for (const std::string_view name : names) append_page_lines(text, page_file(viewer_files(), name));
    text += "})();\n";
    return text;
}

std::string viewer_policy(std::string_view script, std::string_view style, std::string_view more) {
    return fmt::format(
        "default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri 'none'; form-action "
        "'none'{}",
        policy_source(script), policy_source(style), more);
}

std::string json_in_page(std::string_view json) {
    std::string result;
    result.reserve(json.size() + json.size() / 64);
    std::size_t kept = 0;  // up to here
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (c != '<' && c != '>' && c != '&') continue;
        result += json.substr(kept, i - kept);
        result += c == '<' ? "\\u003c" : c == '>' ? "\\u003e" : "\\u0026";
        kept = i + 1;
    }
    result += json.substr(kept);
    return result;
}

}  // namespace popup
