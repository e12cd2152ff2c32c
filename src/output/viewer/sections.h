// What the viewer's page has beside the model: a picture of it, its sheets, and what was found.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/viewer/scene_json.h"
#include "popup/output.h"

namespace popup {

// The model before, or instead of, what the browser draws: 480 × 360 pixels.
struct ViewerStill {
    std::string jpeg;  // its file
    std::string text;  // for those who cannot see it
};

// The picture of the cards, which `modeller` is one of, at the opening where they are seen best. A JPEG: a
// WebP is a third smaller and takes ten times as long. Errors: `locks`; `picture-failed`, for want of memory.
std::optional<ViewerStill> viewer_still(std::span<const SceneCard> cards, still::Modeller& modeller,
                                        Diagnostics& diagnostics);

struct ViewerSheets {
    std::string html;                 // a figure a side, whose picture is number data-sheet of `packed`
    std::vector<std::string> packed;  // SVG documents, deflated (RFC 1950), in base 64
};

// The sheets as the SVG output draws them, prints and cuts together; null: there are none. Errors: those of
// write_svg().
std::optional<ViewerSheets> viewer_sheets(const Layout* layout, const OutputOptions& options,
                                          Diagnostics& diagnostics);

// Findings as a list.
std::string viewer_findings(std::span<const Diagnostic> findings);

// "castle.xml:4:5", by name only: pages are mailed. As markup.
std::string place_html(const std::string& file, Place place);

}  // namespace popup
