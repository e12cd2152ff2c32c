#include "output/viewer/live.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/diagnostics/render_diagnostics.h"
#include "output/html_page.h"
#include "output/markup.h"
#include "output/still/model.h"
#include "output/viewer/page_files.h"
#include "output/viewer/page_parts.h"
#include "output/viewer/scene_json.h"
#include "output/viewer/sections.h"

namespace popup {
namespace {

constexpr std::size_t kMostErrors = 10;

std::string error_html(const LiveError& one) {
    const Diagnostic& found = one.found;
    std::string html = fmt::format("<li><p><code>{}</code> {} <code class=\"code\">[{}]</code></p>",
                                   place_html(found.file, found.place), told_html(found.message), found.code);
    PlaceFinder source(one.text);
    const std::string excerpt = render_excerpt(found.place, source);
    if (!excerpt.empty()) html += "<pre tabindex=\"0\">" + as_markup(excerpt) + "</pre>";
    for (const Related& other : found.related) {
        html += fmt::format("<p>with <code>{}</code> {}</p>", place_html(found.file, other.place),
                            told_html(other.text));
    }
    for (const std::string& hint : found.hints) {
        html += fmt::format("<p class=\"hint\">hint: {}</p>", told_html(hint));
    }
    return html + "</li>\n";
}

}  // namespace

LivePage live_page() {
    // Where a card opens and closes the page has its slider from the beginning.
    nlohmann::ordered_json scene = viewer_scene({}, {}, still::Modeller({}, false), {});
    scene["opening"] = {{"from_deg", 0}, {"to_deg", 180}, {"rest_deg", 90}, {"seconds", 4}};
    const std::string style = viewer_style(std::array<std::string_view, 2>{"viewer.css", "live.css"});
    std::vector<std::string_view> names(kViewerScripts.begin(), kViewerScripts.end());
    names.emplace_back("live.js");
    const std::string script = viewer_script(names);
    LivePage page;
    page.policy = viewer_policy(script, style, "; connect-src 'self'");
    const std::array<std::pair<std::string_view, std::string>, 11> values{{
        {"head", page_head(page.policy, "popupc view", style)},
        {"title", "popupc view"},
        {"live", "\n" + std::string(page_file(viewer_files(), "live.html"))},
        {"still", "alt=\"\" hidden"},
        {"no_script", "The live view is drawn by a script, and scripts are switched off here."},
        {"sheet_count", "0"},
        {"sheets", ""},
        {"finding_count", "0"},
        {"findings", ""},
        {"scene", json_in_page(scene.dump())},
        {"script", script},
    }};
    page.html = filled_page(page_file(viewer_files(), "page.html"), values);
    return page;
}

std::optional<std::string> live_model(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics) {
    const auto keys = choose_keys(cards, options, diagnostics);
    if (!keys) return std::nullopt;
    const still::Modeller modeller(cards, options.backs);
    const nlohmann::ordered_json model{{"title", viewer_title(cards)},
                                       {"scene", viewer_scene(cards, *keys, modeller, options)}};
    std::string text = viewer_scene_text(model);
    if (!browsers_take(text.size(), diagnostics)) return std::nullopt;
    return text;
}

std::optional<std::string> live_sheets(const Layout* layout, const OutputOptions& options,
                                       Diagnostics& diagnostics) {
    const auto sheets = viewer_sheets(layout, options, diagnostics);
    if (!sheets) return std::nullopt;
    const nlohmann::ordered_json told{
        {"count", sheets->packed.size()}, {"html", sheets->html}, {"packed", sheets->packed}};
    return told.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string live_findings(std::span<const Diagnostic> findings) { return viewer_findings(findings); }

std::string live_trouble(std::span<const LiveError> errors) {
    std::string html = "<ul>\n";
    for (const LiveError& one : errors.first(std::min(errors.size(), kMostErrors))) html += error_html(one);
    html += "</ul>\n";
    if (errors.size() > kMostErrors) {
        html += fmt::format("<p>and {} more, which the findings have</p>\n", errors.size() - kMostErrors);
    }
    return html;
}

}  // namespace popup
