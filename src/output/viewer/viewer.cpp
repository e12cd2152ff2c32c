#include "output/viewer/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/text/base64.h"
#include "output/html_page.h"
#include "output/markup.h"
#include "output/viewer/page_files.h"
#include "output/viewer/scene_json.h"
#include "output/viewer/sections.h"

namespace popup {
namespace {

constexpr std::size_t kMostBytes = 400'000'000;

constexpr std::array<std::string_view, 5> kScripts{"scene.js", "poses.js", "camera.js", "draw.js", "page.js"};

std::string style() {
    std::string text = "\n";
    append_page_lines(text, page_file(viewer_files(), "viewer.css"));
    return text;
}

std::string script() {
    std::string text = "\n(() => {\n'use strict';\n";
    for (const std::string_view name : kScripts) append_page_lines(text, page_file(viewer_files(), name));
    text += "})();\n";
    return text;
}

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

}  // namespace

std::optional<ViewerFiles> make_viewer(const RunPage& page, const OutputOptions& options,
                                       Diagnostics& diagnostics) {
    const std::span<const SceneCard> cards = page.cards;
    POPUP_INVARIANT(!cards.empty() && options.duration_s > 0.0);
    const auto keys = choose_keys(cards, options, diagnostics);
    if (!keys) return std::nullopt;
    auto still = viewer_still(cards, options, diagnostics);
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
                               policy_source(code), policy_source(look))},
        {"version", POPUP_VERSION},
        {"title", as_markup(viewer_title(cards))},
        {"style", look},
        {"still", "data:image/webp;base64," + base64(still->webp)},
        {"still_text", still->text},
        {"sheet_count", std::to_string(sheets->packed.size())},
        {"sheets", sheets->html},
        {"finding_count", std::to_string(page.findings.size())},
        {"findings", findings},
        {"scene", std::move(scene)},
        {"script", code},
    }};
    return ViewerFiles{filled_page(page_file(viewer_files(), "page.html"), values), std::move(still->webp)};
}

std::optional<std::string> write_viewer(const RunPage& page, const OutputOptions& options,
                                        Diagnostics& diagnostics) {
    std::optional<ViewerFiles> files = make_viewer(page, options, diagnostics);
    if (!files) return std::nullopt;
    return std::move(files->page);
}

}  // namespace popup
