#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/nth.h"
#include "folded/carton/rough.h"
#include "popup/refinement.h"

namespace popup {
namespace {

using folded::Closed;
using folded::Fold;
using folded::PanelJoin;
using folded::RoughShape;

constexpr double kDegree = std::numbers::pi / 180.0;
// A fold that the joins keep flat remains a fold.
constexpr double kLeastDeg = 1e-6;

CreaseLine line_like(const CreasePattern& pattern, int line, Segment at) {
    CreaseLine made;
    made.points = {at.a, at.b};
    made.place = nth(pattern.lines, line).place;
    made.name = nth(pattern.lines, line).name;
    return made;
}

// The sheet as lines, its folds at these angles.
CreasePattern pattern_of(const CreasePattern& from, const RoughShape& rough,
                         const std::vector<double>& angles) {
    CreasePattern to = from;
    to.lines.clear();
    for (const std::vector<folded::Stretch>& piece : rough.sheet.cuts) {
        for (const folded::Stretch cut : piece)
            to.lines.push_back(line_like(from, 0, rough.sheet.segment(cut)));
    }
    for (std::size_t i = 0; i < rough.sheet.folds.size(); ++i) {
        const Fold& fold = rough.sheet.folds[i];
        for (const folded::Stretch stretch : fold.stretches) {
            CreaseLine line = line_like(from, fold.line, rough.sheet.segment(stretch));
            line.use = angles[i] < 0.0 ? CreaseUse::mountain : CreaseUse::valley;
            line.fold_deg = std::clamp(std::abs(angles[i]) / kDegree, kLeastDeg, 180.0);
            to.lines.push_back(std::move(line));
        }
    }
    return to;
}

}  // namespace

std::string shown_join(const Join& join, const Ruler& ruler) {
    std::string text(kJoinKindNames.at(static_cast<std::size_t>(join.kind)));
    for (std::size_t i = 0; i < join.parts.size(); ++i) {
        const JoinPart& part = join.parts[i];
        text += (i == 0 ? " " : ", ") + part.panel;
        if (join.kind == JoinKind::merge) text += " " + shown_point(ruler, part.corner);
    }
    return text;
}

std::optional<Refined> refine_shape(const CreasePattern& pattern, const RefineOptions& options,
                                    Diagnostics& diagnostics) {
    const auto rough = folded::rough_shape(pattern, options.fold, diagnostics);
    if (!rough) return std::nullopt;
    Diagnostics& of_joins = options.of_joins != nullptr ? *options.of_joins : diagnostics;
    const auto joins = folded::resolve(*rough, options.joins, pattern, of_joins);
    if (!joins) return std::nullopt;
    Refined refined;
    refined.enough_mm = rough->enough_mm();
    if (joins->empty()) {
        refined.pattern = pattern_of(pattern, *rough, rough->angles);
        refined.residual_mm = rough->state().gape();
        refined.closes = refined.residual_mm <= rough->enough_mm();
        return refined;
    }
    const Closed closed = folded::close_joins(rough->state(), *joins, true);
    refined.pattern = pattern_of(pattern, *rough, closed.angles);
    refined.apart_mm = closed.apart_mm;
    refined.residual_mm = closed.residual_mm;
    refined.closes = closed.residual_mm <= rough->enough_mm();
    if (!refined.closes) {
        diagnostics
            .warning(
                "join-open", {},
                fmt::format("{} joins cannot all close while panels stay flat; the worst is left open by "
                            "{:.2f} mm: {}",
                            joins->size(), nth(closed.apart_mm, closed.worst),
                            shown_join(nth(options.joins, closed.worst), pattern.ruler)))
            .hint("leave it out, or change the lengths that do not agree");
    }
    return refined;
}

}  // namespace popup
