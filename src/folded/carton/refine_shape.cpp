#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "folded/carton/rough.h"
#include "popup/refinement.h"

namespace popup {
namespace {

using folded::Closed;
using folded::Fold;
using folded::RoughShape;

constexpr double kDegree = std::numbers::pi / 180.0;
// A fold that the joins keep flat remains a fold.
constexpr double kLeastDeg = 1e-6;
constexpr double kSameTurnDeg = 1e-3;
constexpr double kAsLarge = 0.01;   // areas that differ by less are one
constexpr double kWithinMm = 0.02;  // precision of points within panels

CreaseLine line_like(const CreasePattern& pattern, int line, Segment at) {
    CreaseLine made;
    made.points = {at.a, at.b};
    made.place = nth(pattern.lines, line).place;
    made.name = nth(pattern.lines, line).name;
    return made;
}

std::string shown_deg(double deg) { return fmt::format("{:.1f}°", deg + 0.0); }

std::vector<Vec2> glued_panels(const RoughShape& rough, const std::vector<folded::PanelJoin>& joins,
                               const std::vector<Join>& asked) {
    std::vector<Vec2> found;
    for (std::size_t i = 0; i < joins.size(); ++i) {
        if (asked[i].kind != JoinKind::paste && asked[i].kind != JoinKind::glue) continue;
        const Polygon a = rough.sheet.outline_of(nth(rough.sheet.panels, joins[i].a));
        const Polygon b = rough.sheet.outline_of(nth(rough.sheet.panels, joins[i].b));
        found.push_back(inner_point(area(b) < area(a) * (1.0 - kAsLarge) ? b : a, kWithinMm).at);
    }
    return found;
}

void tell(const CreasePattern& pattern, const RefineOptions& options, const RoughShape& rough,
          const Closed& closed, Diagnostics& diagnostics) {
    if (closed.residual_mm > rough.enough_mm()) {
        const Join& join = nth(options.joins, closed.worst);
        const std::string what = options.joins.size() == 1
                                     ? std::string("the join cannot close while panels stay flat, and")
                                     : fmt::format(
                                           "{} joins cannot all close while panels stay flat; the worst, "
                                           "join {},",
                                           options.joins.size(), closed.worst + 1);
        const bool has_place = options.of_joins != nullptr && join.place.line > 0;
        (has_place ? *options.of_joins : diagnostics)
            .warning(
                "join-open", join.place,
                fmt::format("{} is left open by {}: {}", what, shown_gap(nth(closed.apart_mm, closed.worst)),
                            shown_join(join, pattern.ruler)))
            .hint("leave it out, or change the lengths that do not agree");
        return;
    }
    if (!closed.swings) return;
    const Fold& fold = nth(rough.sheet.folds, closed.turned);
    diagnostics
        .warning("join-swings", nth(pattern.lines, fold.line).place,
                 fmt::format("to close what is open by {}, the fold between {} and {} turns by {:.0f}°",
                             shown_gap(closed.were_apart_mm), nth(rough.names, fold.left),
                             nth(rough.names, fold.right), closed.turn / kDegree))
        .hint(
            "leave out joins of what lies upon each other a board apart, or join what says where that fold "
            "should be");
}

}  // namespace

void name_glue_flaps(const Refined& refined, Assembly& assembly) {
    for (const Vec2 at : refined.glued) {
        for (Plate& plate : assembly.plates) {
            if (!contains(plate.outline, at)) continue;
            if (plate.name.find(kGlueFlapName) == std::string::npos &&
                plate.name.find(kGlueCornerName) == std::string::npos)
                plate.name += fmt::format("-{}", kGlueFlapName);
            break;
        }
    }
}

CreasePattern folded::pattern_of(const CreasePattern& from, const RoughShape& rough,
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
            const double deg = std::abs(angles[i]) / kDegree;
            // The sign of nothing is that of how it was drawn.
            const CreaseUse drawn = nth(from.lines, fold.line).use;
            const bool is_mountain = deg <= kLeastDeg ? drawn == CreaseUse::mountain : angles[i] < 0.0;
            line.use = is_mountain ? CreaseUse::mountain : CreaseUse::valley;
            line.fold_deg = std::clamp(deg, kLeastDeg, 180.0);
            to.lines.push_back(std::move(line));
        }
    }
    return to;
}

FoldTurn folded::furthest_turn(const RoughShape& rough, const std::vector<double>& angles) {
    FoldTurn most;
    for (std::size_t i = 0; i < rough.sheet.folds.size(); ++i) {
        FoldTurn one{{}, rough.angles[i] / kDegree, angles[i] / kDegree};
        // Mirrored folds turn alike but for the last digits: the first of them is told.
        if (one.by_deg() <= most.by_deg() + kSameTurnDeg) continue;
        const Fold& fold = rough.sheet.folds[i];
        one.panels = {nth(rough.names, fold.left), nth(rough.names, fold.right)};
        if (one.panels[1] < one.panels[0]) std::swap(one.panels[0], one.panels[1]);
        most = std::move(one);
    }
    return most;
}

std::string shown_turn(const FoldTurn& turn) {
    if (turn.panels[0].empty()) return "no fold turns";
    const bool same_side = turn.from_deg * turn.to_deg >= 0.0;
    const auto shown = [&](double deg) { return shown_deg(same_side ? std::abs(deg) : deg); };
    return fmt::format("the fold {}+{} turns by {}, from {} to {}", turn.panels[0], turn.panels[1],
                       shown_deg(turn.by_deg()), shown(turn.from_deg), shown(turn.to_deg));
}

std::string shown_gap(double mm) {
    const int digits = static_cast<int>(std::floor(std::log10(std::max(mm, 1e-9))));
    return fmt::format("{:.{}f} mm", mm, std::clamp(2 - digits, 0, 9));
}

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
    refined.glued = glued_panels(*rough, *joins, options.joins);
    refined.apart_mm = closed.apart_mm;
    refined.residual_mm = closed.residual_mm;
    refined.closes = closed.residual_mm <= rough->enough_mm();
    refined.furthest = folded::furthest_turn(*rough, closed.angles);
    tell(pattern, options, *rough, closed, diagnostics);
    return refined;
}

}  // namespace popup
