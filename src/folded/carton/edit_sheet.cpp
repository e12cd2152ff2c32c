#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "folded/carton/edit_subject.h"
#include "folded/carton/examine_edit.h"
#include "folded/carton/follow_lines.h"
#include "folded/carton/move_vertices.h"
#include "folded/carton/rough.h"
#include "folded/carton/turned_folds.h"
#include "folded/carton/vertices.h"
#include "popup/sheet_edit.h"

namespace popup {
namespace {

constexpr double kBendsMm = 1e-6;  // a panel that is less bent is plane
constexpr double kGapeMm = 1e-6;   // corners of loops that have two places
constexpr double kSamePanelMm = 1e-3;

// The points of a line with the corners that it goes through.
std::vector<Vec2> points_of(const EditedSheet::Line& line) {
    std::vector<Vec2> points;
    auto next = line.through.begin();
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        points.push_back(line.points[i]);
        for (; next != line.through.end() && next->first == static_cast<int>(i); ++next)
            points.push_back(next->second);
    }
    return points;
}

// The pattern with its lines where they went.
CreasePattern moved_pattern(const CreasePattern& pattern, const EditedSheet& edited) {
    CreasePattern made = pattern;
    made.lines.clear();
    for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
        CreaseLine line = pattern.lines[i];
        const EditedSheet::Line& to = edited.lines[i];
        if (to.parted.empty()) {
            line.points = points_of(to);
            if (!to.fold_deg.empty()) fold_by(line, to.fold_deg.front());
            made.lines.push_back(std::move(line));
            continue;
        }
        line.closed = false;
        for (std::size_t k = 0; k < to.parted.size(); ++k) {
            CreaseLine& one = made.lines.emplace_back(line);
            one.points = {to.parted[k].a, to.parted[k].b};
            if (k < to.fold_deg.size()) fold_by(one, to.fold_deg[k]);
        }
    }
    return made;
}

// Of a fold that ends at a corner.
Place place_at(const CreasePattern& pattern, const folded::Sheet& sheet, int corner) {
    for (const folded::Fold& fold : sheet.folds) {
        const bool ends_there =
            std::any_of(fold.stretches.begin(), fold.stretches.end(), [&](const folded::Stretch& one) {
                return distance(sheet.at(one.a), sheet.at(corner)) <= kGapeMm ||
                       distance(sheet.at(one.b), sheet.at(corner)) <= kGapeMm;
            });
        if (ends_there) return nth(pattern.lines, fold.line).place;
    }
    return {};
}

// What panels were called and are called now: those whose boxes have the same middle are the same.
std::vector<EditedSheet::Name> names_after(const CreasePattern& pattern, const folded::Vertices& shape,
                                           const folded::Sheet& sheet, const folded::RoughShape& after) {
    const auto middle = [](const folded::Sheet& of, int panel) {
        return bounds(of.outline_of(nth(of.panels, panel)).outer).centre();
    };
    std::vector<std::pair<Vec2, int>> middles;
    for (const int panel : after.tree.order) middles.emplace_back(middle(after.sheet, panel), panel);
    std::sort(middles.begin(), middles.end(), [](const auto& a, const auto& b) {
        return std::tuple(a.first.x, a.first.y, a.second) < std::tuple(b.first.x, b.first.y, b.second);
    });
    std::vector<EditedSheet::Name> names;
    for (const int panel : shape.tree().order) {
        const Vec2 at = middle(sheet, panel);
        auto one = std::lower_bound(middles.begin(), middles.end(), at.x - kSamePanelMm,
                                    [](const auto& row, double x) { return row.first.x < x; });
        for (; one != middles.end() && one->first.x <= at.x + kSamePanelMm; ++one) {
            if (distance(one->first, at) > kSamePanelMm) continue;
            names.push_back({shape.full_name_of(panel), nth(after.names, one->second),
                             folded::place_of(pattern, shape, panel)});
            break;
        }
    }
    return names;
}

}  // namespace

std::optional<EditedSheet> edit_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                      const std::vector<Join>& joins, const SheetEdit& edit,
                                      Diagnostics& diagnostics) {
    const auto shape = folded::vertices_of(pattern, options, joins, diagnostics);
    if (!shape) return std::nullopt;
    const auto subject = folded::subject_of(*shape, edit, diagnostics);
    if (!subject) return std::nullopt;
    const folded::MovedVertices moved = folded::move_vertices(*shape, *subject);
    const auto refuse = [&](Place place, std::string why, std::string hint) {
        diagnostics.error("edit-refused", place, std::move(why)).hint(std::move(hint));
        return std::nullopt;
    };
    if (moved.bent_mm > kBendsMm && moved.worst >= 0) {
        return refuse(
            folded::place_of(pattern, *shape, moved.worst),
            fmt::format("{} would have to bend, by {:.3g} mm", shape->name_of(moved.worst), moved.bent_mm),
            "move it along one of its panels, or its whole edge");
    }
    folded::Unfolded flat = folded::unfold(*shape, moved);
    if (flat.gape_mm > kGapeMm) {
        return refuse(
            place_at(pattern, shape->sheet(), flat.gapes_at),
            fmt::format("the panels around {} would not lie flat on the sheet: they miss each other by "
                        "{:.3g} mm",
                        shown_point(pattern.ruler, shape->sheet().at(flat.gapes_at)), flat.gape_mm),
            "around an inner corner the angles of the panels add up to 360°, and do so no more");
    }
    auto examined = folded::examine_edit(pattern, *shape, moved, std::move(flat.corners), diagnostics);
    if (!examined) return std::nullopt;
    EditedSheet made = folded::follow_lines(pattern, options, shape->sheet(), examined->sheet);
    made.turn_deg = examined->turn_deg;
    folded::turn_folds(pattern, options, *shape, *examined, made, diagnostics);
    folded::RoughShape rough{shape->sheet(), shape->tree(), shape->state().angles(), {}};
    made.before = folded::pattern_of(pattern, rough, rough.angles);
    rough.sheet = examined->sheet;
    made.after = folded::pattern_of(pattern, rough, examined->angles);
    const auto again = folded::rough_shape(moved_pattern(pattern, made), options, diagnostics);
    if (!again) return std::nullopt;
    made.names = names_after(pattern, *shape, examined->sheet, *again);
    return made;
}

}  // namespace popup
