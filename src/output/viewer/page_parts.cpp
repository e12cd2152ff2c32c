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
    for (const char c : json) {
        switch (c) {
            case '<':
                result += "\\u003c";
                break;
            case '>':
                result += "\\u003e";
                break;
            case '&':
                result += "\\u0026";
                break;
            default:
                result += c;
        }
    }
    return result;
}

}  // namespace popup
