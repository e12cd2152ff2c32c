#include "mechanism/sheet_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mechanism/sheet_parts.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

// The fold crosses the border so near to the middle that both sides are as wide.
constexpr double kEvenMm = 1e-6;

// A side fold goes inwards by these steps until it is long enough, by a little.
constexpr double kStepMm = 0.02;
constexpr int kMostSteps = 100;

Vec2 turned(Vec2 p) { return {-p.x, -p.y}; }

// Lines that rise by more than this share of their length run off a side fold, however short they are: the
// shortest side fold rises by as much where rounding put its ends. What rises by less than the other is
// level.
constexpr double kMostRise = 0.01;
constexpr double kRunsLevelMm = 1e-4;

bool is_line_at(const Border& border, std::size_t i, double level, double slack) {
    const Segment chord = border.chord(i);
    return border.edges[i].curve < 0 && border.edges[i].of == EdgeOf::drawn &&
           std::abs(chord.a.y - level) <= slack && std::abs(chord.b.y - level) <= slack &&
           std::abs(chord.b.y - chord.a.y) <= std::max(kRunsLevelMm, kMostRise * distance(chord.a, chord.b));
}

// Lines that run along the fold up to rounding, at the far end of the border, run along it.
void level_far_lines(Border& border, const Tolerances& tolerances) {
    double far = 0.0;
    for (const BorderEdge& edge : border.edges) far = std::max(far, edge.from.y);
    std::optional<double> level;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        const Segment chord = border.chord(i);
        const double rise = std::abs(chord.b.y - chord.a.y);
        const double size = distance(chord.a, chord.b);
        const double slack = std::max(tolerances.rounding_mm, size * tolerances.rounding_deg * kDegree);
        if (size < kLeastEdgeMm || rise > slack || !is_line_at(border, i, far, slack)) continue;
        level = std::max(level.value_or(0.0), 0.5 * (chord.a.y + chord.b.y));
    }
    if (!level) return;
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        const double size = distance(border.chord(i).a, border.chord(i).b);
        if (!is_line_at(border, i, *level,
                        std::max(tolerances.rounding_mm, size * tolerances.rounding_deg * kDegree)))
            continue;
        corners.push_back(i);
        corners.push_back(border.next(i));
    }
    for (const std::size_t i : corners) border.edges[i].from.y = *level;
}

// One side of the fold, seen with that side above it: what its side fold leaves of it.
std::optional<SheetFault> truncate(const Element& e, Border& side, std::optional<double>& level,
                                   std::string_view name) {
    level_far_lines(side, *e.tolerances);
    double far = 0.0;
    for (const BorderEdge& edge : side.edges) far = std::max(far, edge.from.y);
    const bool given = level.has_value();
    if (given) {
        if (*level > far + e.tolerances->rounding_mm) {
            return SheetFault{"outline-off-fold",
                              fmt::format("its {0} fold is to lie {1} from the fold, and the outline reaches "
                                          "only {2} out there",
                                          name, mm(*level), mm(far)),
                              fmt::format("make {} smaller than that, or leave it out", name)};
        }
        for (std::size_t i = 0; i < side.edges.size(); ++i) {
            if (!is_line_at(side, i, *level, e.tolerances->rounding_mm)) continue;
            side.edges[i].from.y = *level;
            side.edges[side.next(i)].from.y = *level;
        }
    } else {
        level = highest_wide(side, kLeastEdgeMm);
    }
    const double least = e.tolerances->min_length_mm;
    if (!level || *level < least) {
        return SheetFault{
            "degenerate",
            fmt::format("on the {} of the fold it is nowhere {} wide at {} or more from the fold, and so "
                        "nothing holds it there",
                        name == "top" ? "left" : "right", mm(kLeastEdgeMm), mm(least)),
            "draw it wider there, or further over the fold"};
    }
    // Widths were those between chords. On a curve that is nearly level it takes a little more.
    const int most_steps = given ? 0 : kMostSteps;
    for (int step = 0; step <= most_steps && *level >= least; ++step, *level -= kStepMm) {
        Border there = part_with_drive(divide(side, level_line(*level), EdgeOf::side));
        if (!put_stretches(there, level_line(*level))) continue;
        side = std::move(there);
        return std::nullopt;
    }
    return SheetFault{
        "degenerate",
        fmt::format("its {} fold, {} from the fold, is nowhere {} long", name, mm(*level), mm(kLeastEdgeMm)),
        fmt::format("move it to where the outline is wider, or leave {} out", name)};
}

}  // namespace

std::vector<std::pair<double, double>> on_fold(const Border& border) {
    std::vector<std::pair<double, double>> made;
    for (const Division::Chord& chord : divide(border, level_line(0.0), EdgeOf::drive).chords)
        made.emplace_back(chord.from, chord.to);
    return made;
}

SheetFault crosses_otherwise(std::size_t chords) {
    return {"outline-off-fold",
            fmt::format("its outline crosses the line of its parent fold {} times; it must cross it twice",
                        2 * chords),
            "draw it across the fold, so that it lies on both sides of it in one part each"};
}

std::optional<SheetFault> shape_of(const Element& e, const Border& border, const SideFolds& given,
                                   CutShape& into) {
    const Division halves = divide(border, level_line(0.0), EdgeOf::drive);
    if (halves.chords.size() != 1) return crosses_otherwise(halves.chords.size());
    // Either side is looked at with that side above the fold.
    Border upper = halves.part(halves.chords[0].above);
    Border lower = mapped(halves.part(halves.chords[0].below), turned);
    begin_at_drive(upper);
    begin_at_drive(lower);
    std::optional<double> p = given.left;
    std::optional<double> q = given.right;
    if (auto fault = truncate(e, upper, p, "top")) return fault;
    if (auto fault = truncate(e, lower, q, "bottom")) return fault;

    const double centre = *p - *q;
    // What is taken from the page has the corners of the plates.
    upper = with_corners_on(upper, level_line(centre));
    lower = with_corners_on(lower, level_line(-centre));
    SheetParts parts;
    parts.upper = upper;
    parts.lower = mapped(lower, turned);
    parts.span = {halves.chords[0].from, halves.chords[0].to};
    parts.far_left = centre >= 0.0;
    if (std::abs(centre) <= kEvenMm) {
        parts.plates = {parts.upper, parts.lower};
        for (Border& plate : parts.plates) fold_in_the_middle(plate);
    } else if (parts.far_left) {
        auto panels = panels_of(parts.upper, parts.lower, level_line(centre));
        if (!panels) return not_divided();
        parts.plates = {panels->far.front(), panels->near};
        parts.plates.insert(parts.plates.end(), panels->far.begin() + 1, panels->far.end());
    } else {
        auto panels = panels_of(lower, mapped(parts.upper, turned), level_line(-centre));
        if (!panels) return not_divided();
        panels->far.insert(panels->far.begin(), panels->near);
        for (const Border& plate : panels->far) parts.plates.push_back(mapped(plate, turned));
    }
    if (auto fault = finish(
            e, parts, [](const Segment& s) { return s.a.x <= s.b.x; }, into))
        return fault;
    SlitShape& slit = into.slit;
    slit.parallel = true;
    const Vec2 along = e.site.left.dir;
    const SitePoint left{parts.span.first, *p};
    const SitePoint right{parts.span.first, *q};
    slit.left_bar =
        parallel_bar(e.site, Side::left, left, e.site.on_page(Side::left, left), along, right_of(along), *q);
    slit.right_bar = parallel_bar(e.site, Side::right, right, e.site.on_page(Side::right, right), along,
                                  left_of(along), *p);
    return std::nullopt;
}

}  // namespace popup
