#include "output/viewer/viewer.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/base64.h"
#include "output/html_page.h"
#include "output/markup.h"
#include "output/still/model.h"
#include "output/viewer/page_files.h"
#include "output/viewer/page_parts.h"
#include "output/viewer/scene_json.h"
#include "output/viewer/sections.h"
#include "run/beside.h"

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

// What a page has of the cards alone.
struct ViewerModel {
    std::string scene;  // viewer_scene() as it stands in a page, without its sheets
    ViewerStill still;
};

std::optional<ViewerModel> model_of(std::span<const SceneCard> cards, const OutputOptions& options,
                                    Diagnostics& diagnostics) {
    const auto keys = choose_keys(cards, options, diagnostics);
    if (!keys) return std::nullopt;
    still::Modeller modeller(cards, options.backs, options.still.paper_mm.value_or(0.0));
    std::optional<ViewerStill> still = viewer_still(cards, modeller, diagnostics);
    if (!still) return std::nullopt;
    std::string scene = json_in_page(viewer_scene_text(viewer_scene(cards, *keys, modeller, options)));
    return ViewerModel{std::move(scene), std::move(*still)};
}

// `scene` is an object that is not empty.
std::string with_sheets(std::string scene, const std::vector<std::string>& packed) {
    scene.back() = ',';
    return scene + "\"sheets\":" + nlohmann::json(packed).dump() + "}";
}

}  // namespace

// What fails there is told when the page is written.
struct BegunPage : Beside<std::optional<ViewerModel>> {
    using Beside::Beside;
};

std::shared_ptr<BegunPage> begin_viewer(std::vector<SceneCard> cards, const OutputOptions& options) {
    const auto work = [cards = std::move(cards), options] {
        Diagnostics told_later;
        return model_of(cards, options, told_later);
    };
    return std::make_shared<BegunPage>(work, true);
}

std::optional<ViewerFiles> make_viewer(const RunPage& page, const OutputOptions& options,
                                       Diagnostics& diagnostics) {
    const std::span<const SceneCard> cards = page.cards;
    POPUP_INVARIANT(!cards.empty() && options.duration_s > 0.0);
    const auto sheets = viewer_sheets(page.layout, options, diagnostics);
    if (!sheets) return std::nullopt;
    std::optional<ViewerModel> model;
    if (page.begun) model = page.begun->take();
    // Where that failed, it says why here; and a run may have two such pages.
    if (!model) model = model_of(cards, options, diagnostics);
    if (!model) return std::nullopt;
    const std::string scene = with_sheets(std::move(model->scene), sheets->packed);
    if (!browsers_take(scene.size(), diagnostics)) return std::nullopt;
    ViewerStill& still = model->still;
    const FixedParts& fixed = fixed_parts();
    const std::string title = as_markup(viewer_title(cards));
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
        {"findings", viewer_findings(page.findings)},
        {"scene", scene},
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
