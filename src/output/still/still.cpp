#include "output/still/still.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/text/numbers.h"
#include "output/still/model.h"
#include "output/still/render.h"

namespace popup {
namespace {

constexpr double kMostPixels = 100e6;
constexpr PictureSize kStillSize{800, 600};

// "-front-90", of what more than one picture has.
std::string suffix_of(const StillOptions& options, View view, double opening_deg) {
    std::string suffix;
    if (options.views.size() > 1) suffix += fmt::format("-{}", kViewNames.at(static_cast<std::size_t>(view)));
    if (options.openings_deg.size() > 1) suffix += "-" + number_text(opening_deg, 3);
    return suffix;
}

}  // namespace

std::optional<std::vector<SheetFile>> write_view_png(std::span<const SceneCard> cards,
                                                     const OutputOptions& options, Diagnostics& diagnostics) {
    StillOptions asked = options.still;
    const auto [width, height] = asked.size.value_or(kStillSize);
    if (static_cast<double>(width) * height > kMostPixels) {
        diagnostics
            .error("picture-too-large", {},
                   fmt::format("a view of {} × {} pixels; a picture has at most {:.0f} million", width,
                               height, kMostPixels / 1e6))
            .hint("choose a smaller --size");
        return std::nullopt;
    }
    still::Modeller modeller(cards, options.backs, options.still.paper_mm.value_or(0.0));
    if (asked.openings_deg.empty()) asked.openings_deg = {modeller.best_deg()};
    std::vector<SheetFile> files;
    for (const double opening : asked.openings_deg) {
        const std::optional<still::Model> model = modeller.at(opening, diagnostics);
        if (!model) return std::nullopt;
        for (const View view : asked.views) {
            SheetFile file{suffix_of(asked, view, opening), {}};
            if (!to_png(still::render(*model, still::framing_of(*model, view, width, height), width, height),
                        std::nullopt, file.bytes)) {
                diagnostics
                    .error("picture-failed", {}, "the PNG could not be made: there is no memory for it")
                    .hint("choose a smaller --size");
                return std::nullopt;
            }
            files.push_back(std::move(file));
        }
    }
    return files;
}

}  // namespace popup
