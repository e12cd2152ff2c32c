#include "mechanism/silhouette.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "base/geometry/tolerances.h"
#include "mechanism/drawn_lines.h"
#include "mechanism/holes.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

// Ends of seams that an outline misses by no more are meant.
constexpr double kSnapMm = 0.5;
std::size_t next(std::size_t i, const Ring& ring) { return i + 1 == ring.size() ? 0 : i + 1; }

// The ring with a corner at p, which is on its border up to `tolerance`: the corner that is there, moved, or
// a new one. nullopt: the border is further away.
std::optional<std::size_t> put_corner(Ring& ring, Vec2 p, double tolerance) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        if (distance(ring[i], p) < distance(ring[nearest], p)) nearest = i;
    }
    if (distance(ring[nearest], p) <= tolerance) {
        ring[nearest] = p;
        return nearest;
    }
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (distance(p, Segment{ring[i], ring[next(i, ring)]}) > tolerance) continue;
        ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, p);
        return i + 1;
    }
    return std::nullopt;
}

// The ring begun at this corner.
void begin_at(Ring& ring, std::size_t corner) {
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(corner), ring.end());
}

double border_distance(const Ring& ring, Vec2 p) {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < ring.size(); ++i)
        least = std::min(least, distance(p, Segment{ring[i], ring[next(i, ring)]}));
    return least;
}

// Why a border does not have a seam; `away` of the end that is further from it.
struct SeamFault {
    std::string_view name;
    double away = 0.0;  // within the tolerance: the ends are on the border, what is between them is not
};

// Puts the seam into the border as one edge, whichever way round.
std::optional<SeamFault> put_seam(Ring& ring, const Segment& seam, std::string_view name, double tolerance) {
    if (seam.a == seam.b) return SeamFault{name, 0.0};
    const double away = std::max(border_distance(ring, seam.a), border_distance(ring, seam.b));
    if (!put_corner(ring, seam.a, tolerance)) return SeamFault{name, away};
    const auto b = put_corner(ring, seam.b, tolerance);
    if (!b) return SeamFault{name, away};
    const auto a = std::find(ring.begin(), ring.end(), seam.a);
    if (a == ring.end()) return SeamFault{name, 0.0};
    begin_at(ring, static_cast<std::size_t>(a - ring.begin()));
    const auto end = std::find(ring.begin(), ring.end(), seam.b) - ring.begin();
    const auto straight = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
        return std::all_of(ring.begin() + from, ring.begin() + to,
                           [&](Vec2 p) { return distance(p, seam) <= tolerance; });
    };
    if (straight(1, end)) {
        ring.erase(ring.begin() + 1, ring.begin() + end);
    } else if (straight(end + 1, std::ssize(ring))) {
        ring.erase(ring.begin() + end + 1, ring.end());
    } else {
        return SeamFault{name, 0.0};
    }
    return std::nullopt;
}

struct SilhouetteFault {
    std::string code, what, hint;
};

std::string_view divided_hint() {
    return "draw the outline so that the line of the centre fold crosses its border twice, once on each side";
}

// " at (…) mm, (…) mm", of many the first ones.
std::string places_of(const Ring& ring, const std::vector<FoldCrossing>& crossings) {
    constexpr std::size_t kShown = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(crossings.size(), kShown); ++i)
        text += (i == 0 ? ", at " : ", ") + at_mm(ring[crossings[i].corner]);
    return crossings.size() > kShown ? text + ", …" : text;
}

bool on_seam(const Segment& edge, const PieceLines& lines) {
    for (const Segment& seam : {lines.left_seam, lines.right_seam}) {
        if ((edge.a == seam.a && edge.b == seam.b) || (edge.a == seam.b && edge.b == seam.a)) return true;
    }
    return false;
}

std::optional<SilhouetteFault> divide(const Element& e, const PieceLines& lines, Silhouette& made) {
    const std::span<const Polygon> areas = areas_of(e, "outline");
    if (areas.size() != 1) {
        return SilhouetteFault{
            "outline-crosses",
            fmt::format("its outline encloses {} areas that do not hang together", areas.size()),
            "draw one area, with holes where it has any"};
    }
    Ring ring = areas.front().outer;
    const double tolerance = e.tolerances->rounding_mm;
    for (const auto& [seam, name] :
         {std::pair(lines.left_seam, lines.left_name), std::pair(lines.right_seam, lines.right_name)}) {
        const auto fault = put_seam(ring, seam, name, tolerance);
        if (!fault) continue;
        return SilhouetteFault{
            "outline-off-seam",
            fault->away > tolerance
                ? fmt::format("its outline passes an end of the seam {1} {0} away, and must go through it",
                              mm(fault->away), name)
                : fmt::format(
                      "its outline goes through both ends of the seam {}, but not straight between them",
                      name),
            fmt::format("draw it through both ends of {}, with a straight line between them", name)};
    }
    const std::vector<FoldCrossing> crossings = put_crossings(ring, {lines.centre_at, lines.centre_dir});
    if (crossings.size() != 2) {
        return SilhouetteFault{
            "outline-off-fold",
            fmt::format("the line of its centre fold crosses its outline {} times{}; it must cross it twice",
                        crossings.size(), places_of(ring, crossings)),
            std::string(divided_hint())};
    }
    made.centre = {ring[crossings[0].corner], ring[crossings[1].corner]};
    // The outline runs counter-clockwise, so from the end of the fold to its begin it is on the left.
    begin_at(ring, crossings[1].corner);
    const auto begin = std::find(ring.begin(), ring.end(), made.centre.a);
    made.halves.left.outer.assign(ring.begin(), begin + 1);
    made.halves.right.outer.assign(begin, ring.end());
    made.halves.right.outer.push_back(ring.front());
    const auto has = [](const Ring& half, const Segment& seam) {
        return std::find(half.begin(), half.end(), seam.a) != half.end() &&
               std::find(half.begin(), half.end(), seam.b) != half.end();
    };
    if (!has(made.halves.left.outer, lines.left_seam) || !has(made.halves.right.outer, lines.right_seam)) {
        return SilhouetteFault{"outline-off-fold",
                               "the line of its centre fold does not divide its outline between the seams",
                               std::string(divided_hint())};
    }
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Segment edge{ring[i], ring[next(i, ring)]};
        if (!on_seam(edge, lines)) made.halves.edges.push_back(edge);
    }
    return std::nullopt;
}

// How far the outline's point lies from this end that is meant for it: the nearest one. Where the outline
// goes through the end itself, only a point that it goes straight on to. Infinite: there is none.
double missed_by(const Element& e, Vec2 end) {
    const auto on_outline = [&](Vec2 p) {
        return std::ranges::any_of(areas_of(e, "outline"), [&](const Polygon& area) {
            return border_distance(area.outer, p) <= e.tolerances->rounding_mm;
        });
    };
    const bool met = on_outline(end);
    double least = HUGE_VAL;
    const auto look_at = [&](Vec2 p) {
        const double away = distance(p, end);
        if (away < least && away <= kSnapMm && (!met || on_outline(lerp(p, end, 0.5)))) least = away;
    };
    const Argument& drawn = e.arguments[*find_parameter(*e.info, "outline")];
    for (const Subpath& subpath : std::get<DrawnPath>(drawn.value).path.subpaths()) {
        look_at(subpath.start);
        for (const PathStep& step : subpath.steps) look_at(step.to);
    }
    return least;
}

// Moves no other points than those that were meant for an end.
void snap_to_seams(Element& e, const PieceLines& lines) {
    const double rounding = e.tolerances->rounding_mm;
    const std::array<Vec2, 4> ends{lines.left_seam.a, lines.left_seam.b, lines.right_seam.a,
                                   lines.right_seam.b};
    snap_path(e, "outline", ends, rounding);
    double most = 0.0;
    for (const Vec2 end : ends) {
        const double away = missed_by(e, end);
        if (away <= rounding || away > kSnapMm) continue;
        most = std::max(most, snap_path(e, "outline", {&end, 1}, away + kGridMm));
    }
    if (most <= rounding) return;
    e.repaired(
        "outline-snapped",
        fmt::format("points of its outline lie up to {} beside the ends of its seams; they were moved there",
                    mm(most)),
        fmt::format("draw the outline through the ends of {} and {}", lines.left_name, lines.right_name));
}

}  // namespace

bool has_silhouette(const Element& e) { return !areas_of(e, "outline").empty(); }

std::optional<Silhouette> silhouette_of(const Element& e, const PieceLines& lines) {
    Silhouette made;
    if (!has_silhouette(e) || divide(e, lines, made)) return std::nullopt;
    return made;
}

bool constrain_silhouette(Element& e, const PieceLines& lines) {
    snap_to_seams(e, lines);
    if (!mend_outline(e)) return false;
    Silhouette made;
    const auto fault = divide(e, lines, made);
    if (!fault) return true;
    e.failed(fault->code, fault->what, fault->hint);
    return false;
}

}  // namespace popup
