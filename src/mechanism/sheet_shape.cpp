#include "mechanism/sheet_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mechanism/divide.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

// The fold crosses the border so near to the middle that both sides are as wide.
constexpr double kEvenMm = 1e-6;

Vec2 turned(Vec2 p) { return {-p.x, -p.y}; }

// Begun with its edge along the fold.
void begin_at_drive(Border& border) {
    const auto drive = std::find_if(border.edges.begin(), border.edges.end(),
                                    [](const BorderEdge& edge) { return edge.of == EdgeOf::drive; });
    std::rotate(border.edges.begin(), drive, border.edges.end());
}

Border part_with_drive(const Division& division) {
    const std::vector<bool> have = division.with(EdgeOf::drive);
    Border part = division.part(static_cast<int>(std::find(have.begin(), have.end(), true) - have.begin()));
    begin_at_drive(part);
    return part;
}

bool is_line_at(const Border& border, std::size_t i, double level, double slack) {
    const Segment chord = border.chord(i);
    return border.edges[i].curve < 0 && border.edges[i].of == EdgeOf::drawn &&
           std::abs(chord.a.y - level) <= slack && std::abs(chord.b.y - level) <= slack;
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

// Side folds of one side that lies above the fold: those of its edges that lie on the level are put together
// to one each; what is shorter than the least stays a cut. False: there is none.
bool put_stretches(Border& border, double level) {
    Border made;
    made.cubics = border.cubics;
    bool any = false;
    for (std::size_t i = 0; i < border.edges.size();) {
        const auto on_level = [&](std::size_t k) {
            const Segment chord = border.chord(k);
            return std::abs(chord.a.y - level) <= kOnLevelMm && std::abs(chord.b.y - level) <= kOnLevelMm;
        };
        if (!on_level(i)) {
            made.edges.push_back(border.edges[i]);
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end + 1 < border.edges.size() && on_level(end + 1)) ++end;
        const Vec2 from = border.edges[i].from;
        const bool folds = distance(from, border.chord(end).b) >= kLeastEdgeMm - 0.02;
        any = any || folds;
        made.edges.push_back({{from.x, level}, -1, 0.0, 0.0, folds ? EdgeOf::side : EdgeOf::drawn});
        i = end + 1;
        if (i < border.edges.size()) border.edges[i].from.y = level;
    }
    border = std::move(made);
    return any;
}

// One side of the fold, seen with that side above it: what its side fold leaves of it.
std::optional<SheetFault> truncate(const Element& e, Border& side, std::optional<double>& level,
                                   std::string_view name) {
    level_far_lines(side, *e.tolerances);
    double far = 0.0;
    for (const BorderEdge& edge : side.edges) far = std::max(far, edge.from.y);
    if (level) {
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
    side = part_with_drive(divide(side, *level, EdgeOf::side));
    if (put_stretches(side, *level)) return std::nullopt;
    return SheetFault{
        "degenerate",
        fmt::format("its {} fold, {} from the fold, is nowhere {} long", name, mm(*level), mm(kLeastEdgeMm)),
        fmt::format("move it to where the outline is wider, or leave {} out", name)};
}

// The wider side of the fold divided by the centre fold, and the narrower one with what it is level with.
struct Panels {
    std::vector<Border> far;  // that hang on the side fold of the wider side; by the longest stretch of it
    Border near;              // the rest, over the fold to the other side fold
};

// Joined along the fold.
Border joined_along_fold(Border a, Border b) {
    begin_at_drive(a);
    begin_at_drive(b);
    Border made;
    made.cubics = a.cubics;
    made.edges.assign(a.edges.begin() + 1, a.edges.end());
    made.edges.insert(made.edges.end(), b.edges.begin() + 1, b.edges.end());
    return made;
}

bool has(const Border& border, EdgeOf kind) {
    return std::any_of(border.edges.begin(), border.edges.end(),
                       [&](const BorderEdge& edge) { return edge.of == kind; });
}

// Whether each chord is folded: parts that hang on the side fold are folded against the rest, and every other
// part is level with what it hangs on, seen from the part over the fold.
std::vector<bool> folded_chords(const Division& division) {
    const std::vector<bool> hangs = division.with(EdgeOf::side);
    const std::vector<bool> drive = division.with(EdgeOf::drive);
    std::vector<std::vector<std::size_t>> at(division.parts());
    for (std::size_t i = 0; i < division.chords.size(); ++i) {
        at[static_cast<std::size_t>(division.chords[i].above)].push_back(i);
        at[static_cast<std::size_t>(division.chords[i].below)].push_back(i);
    }
    std::vector<char> far(division.parts(), -1);
    const auto root = static_cast<std::size_t>(std::find(drive.begin(), drive.end(), true) - drive.begin());
    far[root] = 0;
    std::vector<std::size_t> todo{root};
    while (!todo.empty()) {
        const std::size_t part = todo.back();
        todo.pop_back();
        for (const std::size_t chord : at[part]) {
            const Division::Chord& one = division.chords[chord];
            const auto other =
                static_cast<std::size_t>(static_cast<std::size_t>(one.above) == part ? one.below : one.above);
            if (far[other] >= 0) continue;
            far[other] = hangs[other] ? 1 : far[part];
            todo.push_back(other);
        }
    }
    std::vector<bool> folded;
    for (const Division::Chord& one : division.chords)
        folded.push_back(far[static_cast<std::size_t>(one.above)] !=
                         far[static_cast<std::size_t>(one.below)]);
    return folded;
}

double longest(const Border& border, EdgeOf kind) {
    double most = 0.0;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        const Segment chord = border.chord(i);
        if (border.edges[i].of == kind) most = std::max(most, distance(chord.a, chord.b));
    }
    return most;
}

double leftmost(const Border& border) {
    double least = HUGE_VAL;
    for (const BorderEdge& edge : border.edges) least = std::min(least, edge.from.x);
    return least;
}

// `wide` lies above the fold, and its centre fold at `centre` > 0.
std::optional<Panels> panels_of(const Border& wide, const Border& narrow, double centre) {
    const Division division = divide(wide, centre, EdgeOf::centre);
    std::vector<int> group_of;
    std::vector<Border> groups = division.joined(folded_chords(division), group_of);
    Panels made;
    for (Border& group : groups) {
        if (has(group, EdgeOf::drive))
            made.near = joined_along_fold(std::move(group), narrow);
        else
            made.far.push_back(std::move(group));
    }
    if (made.near.edges.empty() || made.far.empty()) return std::nullopt;
    // What is joined again has the border that it had: corners remain where chords ended.
    for (const Border& one : made.far) {
        if (!has(one, EdgeOf::side) || !has(one, EdgeOf::centre)) return std::nullopt;
    }
    std::stable_sort(made.far.begin(), made.far.end(), [](const Border& a, const Border& b) {
        return std::pair(-longest(a, EdgeOf::side), leftmost(a)) <
               std::pair(-longest(b, EdgeOf::side), leftmost(b));
    });
    return made;
}

// Both sides meet in the fold itself.
void fold_in_the_middle(Border& side) {
    for (BorderEdge& edge : side.edges) {
        if (edge.of == EdgeOf::drive) edge.of = EdgeOf::centre;
    }
}

// A stretch of a fold, of which plate it is an edge.
struct Stretch {
    std::size_t which;
    Segment line;  // in site coordinates, along the fold
    std::size_t plate, other;
};

// Folds of one kind, the longest of those of the first plate first, then as they lie.
void sort_stretches(std::vector<Stretch>& stretches, std::size_t own) {
    std::stable_sort(stretches.begin(), stretches.end(),
                     [](const Stretch& a, const Stretch& b) { return a.line.a.x < b.line.a.x; });
    auto first = stretches.end();
    for (auto it = stretches.begin(); it != stretches.end(); ++it) {
        if (it->plate != own && it->other != own) continue;
        if (first == stretches.end() || it->line.b.x - it->line.a.x > first->line.b.x - first->line.a.x)
            first = it;
    }
    std::rotate(stretches.begin(), first, first + 1);
}

}  // namespace

std::vector<std::pair<double, double>> on_fold(const Border& border) {
    std::vector<std::pair<double, double>> made;
    for (const Division::Chord& chord : divide(border, 0.0, EdgeOf::drive).chords)
        made.emplace_back(chord.from, chord.to);
    return made;
}

std::optional<SheetFault> shape_of(const Element& e, const Border& border, const SideFolds& given,
                                   SheetShape& into) {
    const Division halves = divide(border, 0.0, EdgeOf::drive);
    if (halves.chords.size() != 1) {
        return SheetFault{
            "outline-off-fold",
            fmt::format("its outline crosses the line of its parent fold {} times; it must cross it twice",
                        2 * halves.chords.size()),
            "draw it across the fold, so that it lies on both sides of it in one part each"};
    }
    // Of either side it is looked at with that side above the fold.
    Border upper = halves.part(halves.chords[0].above);
    Border lower = mapped(halves.part(halves.chords[0].below), turned);
    begin_at_drive(upper);
    begin_at_drive(lower);
    std::optional<double> p = given.left;
    std::optional<double> q = given.right;
    if (auto fault = truncate(e, upper, p, "top")) return fault;
    if (auto fault = truncate(e, lower, q, "bottom")) return fault;

    const double centre = *p - *q;
    const bool far_left = centre >= 0.0;
    std::vector<Border> plates;  // left, right, and more on the wider side
    if (std::abs(centre) <= kEvenMm) {
        fold_in_the_middle(upper);
        fold_in_the_middle(lower);
        plates = {upper, mapped(lower, turned)};
    } else {
        const Border& wide = far_left ? upper : lower;
        const Border narrow = mapped(far_left ? lower : upper, turned);
        auto panels = panels_of(wide, narrow, std::abs(centre));
        if (!panels) {
            return SheetFault{"outline-off-fold",
                              "its centre fold does not divide its outline into two halves",
                              "draw it so that the paper goes on from the side fold to the fold"};
        }
        if (!far_left) {
            panels->near = mapped(panels->near, turned);
            for (Border& one : panels->far) one = mapped(one, turned);
        }
        plates = {far_left ? panels->far.front() : panels->near,
                  far_left ? panels->near : panels->far.front()};
        plates.insert(plates.end(), panels->far.begin() + 1, panels->far.end());
    }

    into = {};
    const auto page = [&](Vec2 at) { return e.site.on_page(Side::left, {at.x, at.y}); };
    const auto line = [&](const Segment& s) { return Segment{page(s.a), page(s.b)}; };
    std::vector<std::vector<Stretch>> folds(3);
    SlitShape& slit = into.slit;
    slit.more_on = far_left ? Side::left : Side::right;
    for (std::size_t i = 0; i < plates.size(); ++i) {
        const bool is_left = i == 0 || (i > 1 && far_left);
        Ring ring;
        for (std::size_t k = 0; k < plates[i].edges.size(); ++k) {
            const Segment chord = plates[i].chord(k);
            ring.push_back(page(chord.a));
            const Segment up = chord.a.x <= chord.b.x ? chord : Segment{chord.b, chord.a};
            switch (plates[i].edges[k].of) {
                case EdgeOf::drawn:
                    slit.cuts.push_back(line(chord));
                    break;
                case EdgeOf::drive:
                    break;
                case EdgeOf::side:
                    // A side fold of the wider side lies above, one of the narrower side below.
                    if (is_left)
                        folds[kLeftFold].push_back({kLeftFold, up, i, i});
                    else
                        folds[kRightFold].push_back({kRightFold, up, i, i});
                    break;
                case EdgeOf::centre:
                    // Each lies between one of the wider side and the one plate of the other.
                    if ((far_left && is_left) || (!far_left && !is_left))
                        folds[kCentreFold].push_back({kCentreFold, up, far_left ? i : 0, far_left ? 1 : i});
                    break;
            }
        }
        if (i == 0)
            slit.left = std::move(ring);
        else if (i == 1)
            slit.right = std::move(ring);
        else
            slit.more.push_back(std::move(ring));
    }
    if (std::any_of(folds.begin(), folds.end(), [](const auto& of_kind) { return of_kind.empty(); })) {
        return SheetFault{"outline-off-fold", "its centre fold does not divide its outline into two halves",
                          "draw it so that the paper goes on from the side fold to the fold"};
    }
    sort_stretches(folds[kLeftFold], 0);
    sort_stretches(folds[kCentreFold], far_left ? 0 : 1);
    sort_stretches(folds[kRightFold], 1);
    into.folds = slit_folds(e.site, line(folds[kLeftFold][0].line), line(folds[kCentreFold][0].line),
                            line(folds[kRightFold][0].line));
    for (const auto& of_kind : folds) {
        for (std::size_t i = 1; i < of_kind.size(); ++i)
            slit.more_folds.push_back(
                {of_kind[i].which, line(of_kind[i].line), of_kind[i].plate, of_kind[i].other});
    }
    // From the fold along the border and back to it.
    const auto gone = [&](const Border& side, bool is_lower) {
        Ring path;
        for (std::size_t i = 1; i <= side.edges.size(); ++i) {
            const Vec2 at = side.edges[i % side.edges.size()].from;
            path.push_back(page(is_lower ? turned(at) : at));
        }
        return path;
    };
    slit.gone_left = gone(upper, false);
    slit.gone_right = gone(lower, true);
    slit.span = {halves.chords[0].from, halves.chords[0].to};
    slit.parallel = true;
    const Vec2 along = e.site.left.dir;
    const SitePoint left{halves.chords[0].from, *p};
    const SitePoint right{halves.chords[0].from, *q};
    slit.left_bar =
        parallel_bar(e.site, Side::left, left, e.site.on_page(Side::left, left), along, right_of(along), *q);
    slit.right_bar = parallel_bar(e.site, Side::right, right, e.site.on_page(Side::right, right), along,
                                  left_of(along), *p);
    std::vector<Border> on_page;
    for (const Border& one : plates) on_page.push_back(mapped(one, page));
    into.curves = curves_of(on_page);
    return std::nullopt;
}

}  // namespace popup
