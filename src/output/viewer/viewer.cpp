#include "output/viewer/viewer.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/text/base64.h"
#include "output/html_page.h"
#include "output/markup.h"
#include "output/still/model.h"
#include "output/viewer/page_files.h"
#include "output/viewer/page_parts.h"
#include "output/viewer/scene_json.h"
#include "output/viewer/sections.h"

namespace popup {
namespace {

// What is the same in all pages of models: a gallery writes hundreds.
struct FixedParts {
    std::string style = viewer_style(std::array<std::string_view, 1>{"viewer.css"});
    std::string script = viewer_script(kViewerScripts);
    std::string policy = viewer_policy(script, style);
};
const FixedParts& fixed_parts() {
    static const FixedParts kParts;
    return kParts;
}

}  // namespace

std::optional<ViewerFiles> make_viewer(const RunPage& page, const OutputOptions& options,
                                       Diagnostics& diagnostics) {
    const std::span<const SceneCard> cards = page.cards;
    POPUP_INVARIANT(!cards.empty() && options.duration_s > 0.0);
    const auto keys = choose_keys(cards, options, diagnostics);
    if (!keys) return std::nullopt;
    still::Modeller modeller(cards, options.backs, options.still.paper_mm.value_or(0.0));
    const auto drawing = begin_viewer_still(cards, modeller, options.threads, diagnostics);
    if (!drawing) return std::nullopt;
    const auto sheets = viewer_sheets(page.layout, options, diagnostics);
    if (!sheets) return std::nullopt;
    const std::string findings = viewer_findings(page.findings);
    nlohmann::ordered_json data = viewer_scene(cards, *keys, modeller, options);
    data["sheets"] = sheets->packed;
    const auto scene = viewer_scene_text(data, diagnostics);
    if (!scene) return std::nullopt;
    const FixedParts& fixed = fixed_parts();
    const std::string title = as_markup(viewer_title(cards));
    ViewerStill still = drawing->get();
    if (still.jpeg.empty()) {
        diagnostics.error("picture-failed", {},
                          "the page's picture could not be made: there is no memory for it");
        return std::nullopt;
    }
    const std::array<std::pair<std::string_view, std::string>, 11> values{{
        {"head", page_head(fixed.policy, title, fixed.style)},
        {"title", title},
        {"live", ""},
        {"still",
         fmt::format("alt=\"{}\" src=\"data:image/jpeg;base64,{}\"", still.text, base64(still.jpeg))},
        {"no_script",
         "The model moves by a script, and scripts are switched off here. This is a picture of it."},
        {"sheet_count", std::to_string(sheets->packed.size())},
        {"sheets", sheets->html},
        {"finding_count", std::to_string(page.findings.size())},
        {"findings", findings},
        {"scene", json_in_page(*scene)},
        {"script", fixed.script},
    }};
    return ViewerFiles{filled_page(page_file(viewer_files(), "page.html"), values), std::move(still.jpeg)};
}

std::optional<std::string> write_viewer(const RunPage& page, const OutputOptions& options,
                                        Diagnostics& diagnostics) {
    std::optional<ViewerFiles> files = make_viewer(page, options, diagnostics);
    if (!files) return std::nullopt;
    return std::move(files->page);
}

}  // namespace popup
