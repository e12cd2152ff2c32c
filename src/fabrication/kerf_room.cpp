#include "fabrication/kerf_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "base/geometry/near_boxes.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "base/nth.h"
#include "base/text/numbers.h"

namespace popup {
namespace {

// What overlaps by less has rounded corners on the grid, or is a line that two edges share.
constexpr double kCutsOverlapMm = 2e-3;

// The next larger number with three digits, for hints: what they say must do.
std::string at_least(double mm) { return number_text(std::ceil(mm * 1e3 - 1e-6) / 1e3, 3); }

// How far apart pieces must be kept so that the cuts of neighbours do not cross. 0 where none has one.
double least_spacing(const Layout& layout, const KerfWidths& kerf) {
    std::vector<int> pieces_on(layout.sheets.size(), 0);
    for (const Placement& placement : layout.placements) {
        const auto sheet = static_cast<std::size_t>(placement.sheet);
        if (sheet >= pieces_on.size()) pieces_on.resize(sheet + 1, 0);
        ++pieces_on[sheet];
    }
    const double mixed = 0.5 * (kerf.outer_mm + kerf.inner_mm);
    double least = 0.0;
    for (const Placement& placement : layout.placements) {
        if (nth(pieces_on, placement.sheet) < 2) continue;
        least = std::max(least, kerf.outer_mm);
        if (mixed <= least) continue;
        const Pattern& pattern = nth(layout.designs, placement.design).pattern;
        const PatternPiece& piece = nth(pattern.pieces, placement.piece);
        const bool has_hole = std::any_of(piece.cuts.begin(), piece.cuts.end(),
                                          [](const Contour& c) { return c.closed && c.depth % 2 == 1; });
        if (has_hole) least = mixed;
    }
    return least;
}

// A piece on its sheet, with what its moved cuts enclose.
struct Laid {
    const Placement* placement = nullptr;
    Box box;
    std::vector<Polygon> regions;
};

std::vector<Polygon> moved_by(const Placement& placement, std::vector<Polygon> regions) {
    const auto move = [&placement](Ring& ring) {
        for (Vec2& p : ring) p = placement.apply(p);
    };
    for (Polygon& polygon : regions) {
        move(polygon.outer);
        for (Ring& hole : polygon.holes) move(hole);
    }
    return regions;
}

// All pieces as they lie, in the order of the placements.
std::vector<Laid> laid_pieces(const Layout& layout, const std::vector<std::vector<Contour>>& moved) {
    std::vector<std::vector<std::vector<Polygon>>> regions(layout.designs.size());
    std::size_t next = 0;
    for (std::size_t d = 0; d < regions.size(); ++d) {
        for (std::size_t p = 0; p < layout.designs[d].pattern.pieces.size(); ++p) {
            std::vector<Ring> rings;
            for (const Contour& cut : moved.at(next++)) {
                if (cut.closed) rings.push_back(cut.points);
            }
            regions[d].push_back(filled(rings, FillRule::even_odd));
        }
    }
    std::vector<Laid> laid;
    laid.reserve(layout.placements.size());
    for (const Placement& placement : layout.placements) {
        Laid one{&placement, {}, moved_by(placement, nth(nth(regions, placement.design), placement.piece))};
        for (const Polygon& polygon : one.regions) {
            for (const Vec2 p : polygon.outer) one.box.extend(p);
        }
        laid.push_back(std::move(one));
    }
    return laid;
}

bool cross(const Laid& a, const Laid& b) {
    const std::vector<Polygon> shared = intersect(a.regions, b.regions);
    return std::any_of(shared.begin(), shared.end(), [](const Polygon& polygon) {
        return 2.0 * area(polygon) > kCutsOverlapMm * perimeter(polygon.outer);
    });
}

// The pairs of neighbours whose cuts cross: how many, and the first of them.
struct Crossings {
    std::size_t count = 0;
    std::pair<const Placement*, const Placement*> first;
};

Crossings find_crossings(const std::vector<Laid>& laid) {
    std::vector<const Laid*> drawn;
    std::vector<SpaceBox> boxes;  // one sheet over the other
    for (const Laid& one : laid) {
        if (one.box.empty()) continue;
        const double sheet = one.placement->sheet;
        drawn.push_back(&one);
        boxes.push_back({{one.box.min.x, one.box.min.y, sheet}, {one.box.max.x, one.box.max.y, sheet}});
    }
    Crossings found;
    for (const auto& [a, b] : near_pairs(boxes, SIZE_MAX)) {
        if (!cross(*nth(drawn, a), *nth(drawn, b))) continue;
        if (found.count++ == 0) found.first = {nth(drawn, a)->placement, nth(drawn, b)->placement};
    }
    return found;
}

std::string others(std::size_t count, std::string_view one, std::string_view several) {
    if (count < 2) return {};
    return fmt::format("; so {} {} more {}", count == 2 ? "does" : "do", count - 1,
                       count == 2 ? one : several);
}

bool tell_of_neighbours(const Layout& layout, double widest, double spacing_mm, const std::vector<Laid>& laid,
                        Diagnostics& diagnostics) {
    const Crossings found = find_crossings(laid);
    if (found.count == 0) return false;
    diagnostics
        .error(
            "kerf-too-wide", {},
            fmt::format("the cuts of pieces \"{}\" and \"{}\", which lie {} mm apart on sheet {}, cross: at "
                        "sharp corners they are moved by more than half the kerf of {} mm{}",
                        layout.piece_name(*found.first.first), layout.piece_name(*found.first.second),
                        number_text(spacing_mm, 3), found.first.first->sheet + 1, number_text(widest, 3),
                        others(found.count, "pair", "pairs")))
        .hint(fmt::format("take a --spacing of {} mm, which is enough for all corners",
                          at_least(2.0 * widest)));
    return true;
}

bool tell_of_margin(const Layout& layout, double kerf, const std::vector<Laid>& laid,
                    Diagnostics& diagnostics) {
    double most = 0.0;
    std::size_t count = 0;
    const Placement* worst = nullptr;
    for (const Laid& one : laid) {
        if (one.box.empty()) continue;
        const LayoutSheet& sheet = nth(layout.sheets, one.placement->sheet);
        const double beyond = std::max({-one.box.min.x, -one.box.min.y, one.box.max.x - sheet.width_mm,
                                        one.box.max.y - sheet.height_mm});
        if (beyond <= kCutsOverlapMm) continue;
        ++count;
        if (beyond > most) {
            most = beyond;
            worst = one.placement;
        }
    }
    if (worst == nullptr) return false;
    diagnostics
        .error("kerf-too-wide", {},
               fmt::format(
                   "the cut of piece \"{}\" runs {} mm beyond the edge of sheet {}: at sharp corners it is "
                   "moved by more than half the kerf of {} mm{}",
                   layout.piece_name(*worst), number_text(most, 3), worst->sheet + 1, number_text(kerf, 3),
                   others(count, "piece", "pieces")))
        .hint(fmt::format("take a --margin of {} mm, which is enough for all corners", at_least(kerf)));
    return true;
}

}  // namespace

std::size_t check_kerf_distances(const Layout& layout, const KerfWidths& kerf, double spacing_mm,
                                 Diagnostics& diagnostics) {
    std::size_t findings = 0;
    const double least = least_spacing(layout, kerf);
    if (spacing_mm < least - kGridMm) {
        ++findings;
        diagnostics
            .error("kerf-too-wide", {},
                   fmt::format("pieces are laid as near to each other as {} mm, and the cuts of neighbours, "
                               "moved for the kerf, need {} mm",
                               number_text(spacing_mm, 3), number_text(least, 3)))
            .hint(fmt::format("take a --spacing of at least {} mm", at_least(least)));
    }
    if (!layout.placements.empty() && layout.margin_mm < 0.5 * kerf.outer_mm - kGridMm) {
        ++findings;
        diagnostics
            .error("kerf-too-wide", {},
                   fmt::format(
                       "the margin of {} mm has no room for cuts that are moved out by half a kerf of {} mm",
                       number_text(layout.margin_mm, 3), number_text(kerf.outer_mm, 3)))
            .hint(fmt::format("take a --margin of at least {} mm", at_least(0.5 * kerf.outer_mm)));
    }
    return findings;
}

std::size_t check_moved_cuts(const Layout& layout, const KerfWidths& kerf, double spacing_mm,
                             const std::vector<std::vector<Contour>>& moved, Diagnostics& diagnostics) {
    const double widest = std::max(kerf.outer_mm, kerf.inner_mm);
    const bool near = spacing_mm < 2.0 * widest;
    const bool at_edge = layout.margin_mm < kerf.outer_mm;
    if (!near && !at_edge) return 0;
    const std::vector<Laid> laid = laid_pieces(layout, moved);
    std::size_t findings = 0;
    if (near && tell_of_neighbours(layout, widest, spacing_mm, laid, diagnostics)) ++findings;
    if (at_edge && tell_of_margin(layout, kerf.outer_mm, laid, diagnostics)) ++findings;
    return findings;
}

}  // namespace popup
