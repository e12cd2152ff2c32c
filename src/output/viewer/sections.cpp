#include "output/viewer/sections.h"

#include <fmt/format.h>

#include <utility>

#include "base/text/base64.h"
#include "base/text/numbers.h"
#include "output/jpeg.h"
#include "output/markup.h"
#include "output/sheet_drawing.h"
#include "output/still/model.h"
#include "output/still/render.h"
#include "output/svg.h"
#include "output/viewer/deflate.h"

namespace popup {
namespace {

constexpr PictureSize kSize{480, 360};
constexpr int kQuality = 80;  // of 1 to 100
constexpr double kDpi = 96.0;
constexpr int kDecimals = 2;

std::string finding_html(const Diagnostic& one) {
    const std::string_view severity = to_string(one.severity);
    std::string html = fmt::format("<li><span class=\"{0}\">{0}</span> {1} <code>{2} [{3}]</code>", severity,
                                   told_html(one.message), place_html(one.file, one.place), one.code);
    std::string more;
    if (one.change && !one.change->after.empty()) {
        more += fmt::format("<li>was {}, now {}</li>", told_html(one.change->before),
                            told_html(one.change->after));
    }
    for (const Related& other : one.related) {
        more += fmt::format("<li>with {} {}</li>", place_html(one.file, other.place), told_html(other.text));
    }
    for (const std::string& hint : one.hints) more += fmt::format("<li>{}</li>", told_html(hint));
    if (!more.empty()) html += "<ul>" + more + "</ul>";
    return html + "</li>\n";
}

}  // namespace

std::string place_html(const std::string& file, Place place) {
    std::string text = file.empty() ? "popupc" : file.substr(file.rfind('/') + 1);
    if (place.line > 0) text += fmt::format(":{}", place.line);
    if (place.line > 0 && place.column > 0) text += fmt::format(":{}", place.column);
    return told_html(text);
}

std::optional<ViewerStill> viewer_still(std::span<const SceneCard> cards, still::Modeller& modeller,
                                        Diagnostics& diagnostics) {
    const double opening_deg = modeller.best_deg();
    const std::optional<still::Model> model = modeller.at(opening_deg, diagnostics);
    if (!model) return std::nullopt;
    ViewerStill still{{}, "A picture of the model"};
    if (moves(*cards.front().assembly))
        still.text += fmt::format(", open at {} degrees", number_text(opening_deg, 1));
    const still::Framing framing = still::framing_of(*model, View::iso, kSize.width, kSize.height);
    if (to_jpeg(still::render(*model, framing, kSize.width, kSize.height), kQuality, kDpi, still.jpeg))
        return still;
    diagnostics.error("picture-failed", {},
                      "the page's picture could not be made: there is no memory for it");
    return std::nullopt;
}

std::optional<ViewerSheets> viewer_sheets(const Layout* layout, const OutputOptions& options,
                                          Diagnostics& diagnostics) {
    ViewerSheets sheets;
    if (layout == nullptr) {
        sheets.html = "<p>There are no sheets.</p>\n";
        return sheets;
    }
    OutputOptions whole = options;
    whole.print_and_cut = false;
    const auto views = views_of(*layout, whole, diagnostics);
    if (!views) return std::nullopt;
    const auto files = write_svg(*layout, whole, diagnostics);
    if (!files) return std::nullopt;
    const std::size_t count = layout->sheets.size();
    for (std::size_t i = 0; i < files->size(); ++i) {
        const SheetView& view = views->at(i);
        const LayoutSheet& sheet = layout->sheets.at(static_cast<std::size_t>(view.sheet));
        const std::string name =
            fmt::format("Sheet {} of {}{}, {} × {} mm", view.sheet + 1, count, view.back ? ", its back" : "",
                        number_text(sheet.width_mm, kDecimals), number_text(sheet.height_mm, kDecimals));
        sheets.html += fmt::format(
            "<figure><figcaption>{0}</figcaption><img data-sheet=\"{1}\" alt=\"{0}\"></figure>\n", name, i);
        sheets.packed.push_back(base64(deflated((*files)[i].bytes)));
    }
    sheets.html +=
        "<noscript><p>A script shows the sheets, and scripts are switched off here.</p></noscript>\n";
    return sheets;
}

std::string viewer_findings(std::span<const Diagnostic> findings) {
    if (findings.empty()) return "<p>Nothing was found.</p>\n";
    std::string html = "<ul class=\"findings\">\n";
    for (const Diagnostic& one : findings) html += finding_html(one);
    return html + "</ul>\n";
}

}  // namespace popup
