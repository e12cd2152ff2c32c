// The viewer's page as a live view shows it: a page without a card, and cards that are put into it as they
// are saved.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "popup/output.h"

namespace popup {

// The page of viewer.h without cards, sheets and findings, with a script more (live.js) that asks beside the
// page's own address for what is new. It is the same for all cards.
struct LivePage {
    std::string html;
    std::string policy;  // its CSP, as it stands in the page: connections go to its own server alone
};
LivePage live_page();

// What is put into the page, as JSON: {title, scene: as in scene_json.h}. What viewer.h says of pages holds,
// but that nothing is drawn here: there is no still. Errors: those of choose_keys(), and `model-too-large`.
// Precondition: as of write_viewer().
std::optional<std::string> live_model(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics);

// The sheets, as JSON: {count, html, packed: as ViewerSheets has them}; null: there are none, and html says
// so. Errors: those of write_svg().
std::optional<std::string> live_sheets(const Layout* layout, const OutputOptions& options,
                                       Diagnostics& diagnostics);

// Findings as a list, as pages of viewer.h have it.
std::string live_findings(std::span<const Diagnostic> findings);

// An error, and the text of the file that it is in (empty: unknown), which has to outlive it.
struct LiveError {
    Diagnostic found;
    std::string_view text;
};

// Errors as a list, each with its place, its line and what would mend it; at most ten, and how many more.
std::string live_trouble(std::span<const LiveError> errors);

}  // namespace popup
