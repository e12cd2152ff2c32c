#include "findings/message_formats.h"

#include <algorithm>

#include "base/diagnostics/render_diagnostics.h"

namespace popup {
namespace {

std::string render_texts(const Findings& findings, const MessageStyle& style) {
    std::string text;
    const auto add = [&](const std::vector<Diagnostic>& told, std::string_view source) {
        PlaceFinder finder(source);
        for (const Diagnostic& one : told) text += render_text(one, finder, style.color);
    };
    for (const ToldFile& file : findings.files) add(file.told, file.text);
    add(findings.run, {});
    return text + style.summary;
}

std::string render_lines(const Findings& findings, const MessageStyle& style) {
    std::string text;
    const auto add = [&](const std::vector<Diagnostic>& told) {
        for (const Diagnostic& one : told) text += render_short(one, style.color);
    };
    for (const ToldFile& file : findings.files) add(file.told);
    add(findings.run);
    return text + style.summary;
}

std::string render_objects(const Findings& findings, const MessageStyle& /*style*/) {
    std::string text;
    const auto add = [&](const std::vector<Diagnostic>& told) {
        for (const Diagnostic& one : told) text += render_json(one);
    };
    for (const ToldFile& file : findings.files) add(file.told);
    add(findings.run);
    return text;
}

constexpr MessageFormat kFormats[] = {
    {"text", "for people, with the line of the source and hints", false, render_texts},
    {"short", "one line each", false, render_lines},
    {"json", "one object a line", true, render_objects},
    {"sarif", "a SARIF 2.1.0 log, for code scanning and editors", true, render_sarif},
    {"junit", "a JUnit report, a case a design", true, render_junit},
    {"github", "annotations of GitHub Actions", true, render_github},
};

}  // namespace

std::span<const MessageFormat> message_format_table() { return kFormats; }

const MessageFormat* find_message_format(std::string_view name) {
    const auto row = std::find_if(std::begin(kFormats), std::end(kFormats),
                                  [name](const MessageFormat& one) { return one.name == name; });
    return row == std::end(kFormats) ? nullptr : row;
}

}  // namespace popup
