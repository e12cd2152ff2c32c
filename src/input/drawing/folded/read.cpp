#include "input/drawing/folded/read.h"

#include <cmath>
#include <utility>

#include "base/nth.h"
#include "input/drawing/card/lines.h"

namespace popup::drawing::folded {
namespace {

constexpr double kFoldedDeg = 180.0;
constexpr Color kSimulatorMountain{255, 0, 0};
constexpr Color kSimulatorValley{0, 0, 255};
// Less opacity is hardly a fold, and none says nothing.
constexpr double kLeastOpacity = 1e-3;

CreaseUse use_of(unsigned ink) {
    switch (ink) {
        case kMountain:
            return CreaseUse::mountain;
        case kValley:
            return CreaseUse::valley;
        case kFold:
            return CreaseUse::fold;
        default:
            return CreaseUse::cut;
    }
}

// As Origami Simulator has it.
std::optional<double> angle_of(const TracedLine& line) {
    if (line.color != kSimulatorMountain && line.color != kSimulatorValley) return std::nullopt;
    if (line.named != Named::nothing || line.dash != Dash::none || line.opacity.value_or(0.0) < kLeastOpacity)
        return std::nullopt;
    return kFoldedDeg * *line.opacity;
}

void fold(CreaseLine& crease, const TracedLine& line, bool own_sheet) {
    if (crease.use == CreaseUse::cut) return;
    if (!line.fold_deg) {
        if (crease.use != CreaseUse::fold && !own_sheet) crease.fold_deg = angle_of(line);
        return;
    }
    fold_by(crease, *line.fold_deg);
}

}  // namespace

std::optional<CreasePattern> read(const Tracing& tracing, const Source& source, Diagnostics& diagnostics) {
    card::CardLines drawn = card::card_lines(tracing, diagnostics);
    if (diagnostics.has_errors_as_given()) return std::nullopt;
    CreasePattern pattern;
    pattern.file = source.name;
    pattern.stem = source.stem();
    pattern.ruler = tracing.ruler;
    pattern.curves = tracing.curves;
    pattern.lines.reserve(drawn.lines.size());
    for (std::size_t i = 0; i < drawn.lines.size(); ++i) {
        SheetLine& line = drawn.lines[i];
        CreaseLine crease{std::move(line.points), line.closed, use_of(line.ink)};
        fold(crease, *drawn.drawn_by[i], tracing.own_sheet);
        crease.place = nth(tracing.elements, line.element).place;
        crease.name = to_string(drawn.drawn_by[i]->color);
        pattern.lines.push_back(std::move(crease));
    }
    return pattern;
}

}  // namespace popup::drawing::folded
