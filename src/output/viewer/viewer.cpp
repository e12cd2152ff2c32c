#include "output/viewer/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/system/digest.h"
#include "base/text/base64.h"
#include "output/markup.h"
#include "output/viewer/page_files.h"
#include "output/viewer/scene_json.h"
#include "output/viewer/sections.h"

namespace popup {
namespace {

constexpr std::size_t kMostBytes = 400'000'000;

constexpr std::array<std::string_view, 5> kScripts{"scene.js", "poses.js", "camera.js", "draw.js", "page.js"};

std::string_view file_named(std::string_view name) {
    for (const PageFile& file : viewer_files()) {
        if (file.name == name) return file.text;
    }
    POPUP_INVARIANT(false && "a file of the viewer is missing");
    return {};
}

// Without indentation, empty lines, and lines that are comments.
void append_lines(std::string& text, std::string_view source) {
    while (!source.empty()) {
        const std::size_t end = std::min(source.find('\n'), source.size() - 1);
        std::string_view line = source.substr(0, end + 1);
        source.remove_prefix(end + 1);
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size() - 1));
        if (line != "\n" && !line.starts_with("//") && !line.starts_with("/*")) text += line;
    }
}

std::string style() {
    std::string text = "\n";
    append_lines(text, file_named("viewer.css"));
    return text;
}

std::string script() {
    std::string text = "\n(() => {\n'use strict';\n";
    for (const std::string_view name : kScripts) append_lines(text, file_named(name));
    text += "})();\n";
    return text;
}

// What stands in a policy for exactly this text.
std::string source_of(std::string_view text) { return "'sha256-" + base64(sha256_bytes(text)) + "'"; }

// JSON that cannot end the element it stands in, nor begin a comment there: these letters are in its strings
// only.
std::string escaped_json(std::string_view json) {
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

// The template with "{{name}}" replaced; what is put in is not looked at again.
std::string filled(std::string_view page, std::span<const std::pair<std::string_view, std::string>> values) {
    std::string result;
    while (true) {
        const std::size_t open = page.find("{{");
        result += page.substr(0, open);
        if (open == std::string_view::npos) return result;
        const std::size_t close = page.find("}}", open);
        const std::string_view name = page.substr(open + 2, close - open - 2);
        bool known = false;
        for (const auto& [key, text] : values) {
            if (key != name) continue;
            result += text;
            known = true;
        }
        POPUP_INVARIANT(known);
        page.remove_prefix(close + 2);
    }
}

}  // namespace

std::optional<std::string> write_viewer(const RunPage& page, const OutputOptions& options,
                                        Diagnostics& diagnostics) {
    const std::span<const SceneCard> cards = page.cards;
    POPUP_INVARIANT(!cards.empty() && options.duration_s > 0.0);
    const auto keys = choose_keys(cards, options, diagnostics);
    if (!keys) return std::nullopt;
    const auto still = viewer_still(cards, options, diagnostics);
    if (!still) return std::nullopt;
    const auto sheets = viewer_sheets(page.layout, options, diagnostics);
    if (!sheets) return std::nullopt;
    const std::string findings = viewer_findings(page.findings);
    nlohmann::ordered_json data = viewer_scene(cards, *keys, still->start, options);
    data["sheets"] = sheets->packed;
    std::string scene = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    if (scene.size() > kMostBytes) {
        diagnostics
            .error(
                "model-too-large", {},
                fmt::format("the page would be {:.0f} MB, {:.0f} MB are the most",
                            1e-6 * static_cast<double>(scene.size()), 1e-6 * static_cast<double>(kMostBytes)))
            .hint(
                "ask for fewer angles or fewer keys a second, take smaller pictures, or write fewer designs "
                "into one page");
        return std::nullopt;
    }
    scene = escaped_json(scene);
    const std::string look = style();
    const std::string code = script();
    const std::array<std::pair<std::string_view, std::string>, 12> values{{
        {"policy", fmt::format("default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri "
                               "'none'; form-action 'none'",
                               source_of(code), source_of(look))},
        {"version", POPUP_VERSION},
        {"title", as_markup(viewer_title(cards))},
        {"style", look},
        {"still", still->address},
        {"still_text", still->text},
        {"sheet_count", std::to_string(sheets->packed.size())},
        {"sheets", sheets->html},
        {"finding_count", std::to_string(page.findings.size())},
        {"findings", findings},
        {"scene", std::move(scene)},
        {"script", code},
    }};
    return filled(file_named("page.html"), values);
}

}  // namespace popup
