#include "output/still/still.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/text/numbers.h"
#include "output/still/model.h"
#include "output/still/render.h"
#include "popup/assembly.h"

namespace popup {
namespace {

constexpr double kMostPixels = 100e6;
constexpr PictureSize kStillSize{800, 600};
constexpr double kBeyondDeg = 1e-6;

// "-front-90", of what more than one picture has.
std::string suffix_of(const StillOptions& options, View view, double opening_deg) {
    std::string suffix;
    if (options.views.size() > 1) suffix += fmt::format("-{}", kViewNames.at(static_cast<std::size_t>(view)));
    if (options.openings_deg.size() > 1) suffix += "-" + number_text(opening_deg, 3);
    return suffix;
}

// Cards that open less far are shown as far as they open.
void tell_beyond(std::span<const SceneCard> cards, const std::vector<double>& openings_deg,
                 Diagnostics& diagnostics) {
    double furthest = 0.0;
    for (const SceneCard& card : cards) {
        if (moves(*card.assembly)) furthest = std::max(furthest, card.assembly->sweep.to_deg);
    }
    if (furthest == 0.0) return;  // nothing moves
    std::vector<std::string> beyond;
    for (const double opening : openings_deg) {
        if (opening > furthest + kBeyondDeg) beyond.push_back(number_text(opening, 3) + "°");
    }
    if (beyond.empty()) return;
    diagnostics
        .remark("view-beyond", {},
                fmt::format("the view at {} shows {}°: nothing here opens further", fmt::join(beyond, ", "),
                            number_text(furthest, 3)))
        .hint("leave such openings out of --at; --opens says how far cards open");
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
    tell_beyond(cards, options.still.openings_deg, diagnostics);
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
