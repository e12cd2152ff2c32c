#include "mechanism/sheet_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace popup {

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

bool put_stretches(Border& border, const DirectedLine& line) {
    Border made;
    made.cubics = border.cubics;
    bool any = false;
    for (std::size_t i = 0; i < border.edges.size();) {
        const auto on_line = [&](std::size_t k) {
            const Segment chord = border.chord(k);
            return std::abs(cross(line.dir, chord.a - line.at)) <= kOnLineMm &&
                   std::abs(cross(line.dir, chord.b - line.at)) <= kOnLineMm;
        };
        if (!on_line(i)) {
            made.edges.push_back(border.edges[i]);
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end + 1 < border.edges.size() && on_line(end + 1)) ++end;
        const Vec2 from = border.edges[i].from;
        const bool folds = distance(from, border.chord(end).b) >= kLeastEdgeMm - 0.02;
        any = any || folds;
        const auto onto = [&](Vec2 p) { return line.at + dot(line.dir, p - line.at) * line.dir; };
        made.edges.push_back({onto(from), -1, 0.0, 0.0, folds ? EdgeOf::side : EdgeOf::drawn});
        i = end + 1;
        if (i < border.edges.size()) border.edges[i].from = onto(border.edges[i].from);
    }
    border = std::move(made);
    return any;
}

namespace {

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

}  // namespace

std::optional<Panels> panels_of(const Border& wide, const Border& narrow, const DirectedLine& centre) {
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
    for (const Border& one : made.far) {
        if (!has(one, EdgeOf::side) || !has(one, EdgeOf::centre)) return std::nullopt;
    }
    std::stable_sort(made.far.begin(), made.far.end(), [](const Border& a, const Border& b) {
        return std::pair(-longest(a, EdgeOf::side), leftmost(a)) <
               std::pair(-longest(b, EdgeOf::side), leftmost(b));
    });
    return made;
}

namespace {

// A stretch of a fold, of which plates it is an edge.
struct Stretch {
    std::size_t which;
    Segment line;  // in site coordinates
    std::size_t plate, other;
};

double size_of(const Stretch& stretch) { return distance(stretch.line.a, stretch.line.b); }

// The longest of those of the plate first, the others as they lie.
void sort_stretches(std::vector<Stretch>& stretches, std::size_t own) {
    std::stable_sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
        return std::pair(a.line.a.x, a.line.a.y) < std::pair(b.line.a.x, b.line.a.y);
    });
    auto first = stretches.end();
    for (auto it = stretches.begin(); it != stretches.end(); ++it) {
        if (it->plate != own && it->other != own) continue;
        if (first == stretches.end() || size_of(*it) > size_of(*first)) first = it;
    }
    std::rotate(stretches.begin(), first, first + 1);
}

}  // namespace

namespace {

// Without corners in the middle of a straight cut, where it crosses a line that is no fold.
void drop_straight_corners(Border& border) {
    constexpr double kStraight = 1e-9;  // mm beside the line
    const auto is_cut = [](const BorderEdge& edge) { return edge.of == EdgeOf::drawn && edge.curve < 0; };
    std::vector<BorderEdge> kept;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        if (!kept.empty() && is_cut(kept.back()) && is_cut(border.edges[i])) {
            const Vec2 from = kept.back().from;
            const Vec2 to = border.chord(i).b;
            const Vec2 at = border.edges[i].from;
            if (distance(at, Segment{from, to}) <= kStraight && dot(at - from, to - at) > 0.0) continue;
        }
        kept.push_back(border.edges[i]);
    }
    border.edges = std::move(kept);
}

}  // namespace

std::optional<SheetFault> finish(const Element& e, const SheetParts& parts,
                                 const std::function<bool(const Segment&)>& along, CutShape& into) {
    into = {};
    const auto page = [&](Vec2 at) { return e.site.on_page(Side::left, {at.x, at.y}); };
    const auto line = [&](const Segment& s) { return Segment{page(s.a), page(s.b)}; };
    std::vector<std::vector<Stretch>> folds(kThreeFolds.size());
    SlitShape& slit = into.slit;
    const bool far_left = parts.far_left;
    slit.more_on = far_left ? Side::left : Side::right;
    for (std::size_t i = 0; i < parts.plates.size(); ++i) {
        Border plate = parts.plates[i];
        drop_straight_corners(plate);
        const bool is_left = i == 0 || (i > 1 && far_left);
        Ring ring;
        for (std::size_t k = 0; k < plate.edges.size(); ++k) {
            const Segment chord = plate.chord(k);
            ring.push_back(page(chord.a));
            const Segment up = along(chord) ? chord : Segment{chord.b, chord.a};
            switch (plate.edges[k].of) {
                case EdgeOf::drawn:
                    slit.cuts.push_back(line(chord));
                    break;
                case EdgeOf::drive:
                    break;
                case EdgeOf::side: {
                    const std::size_t which = is_left ? kLeftFold : kRightFold;
                    folds[which].push_back({which, up, i, i});
                    break;
                }
                case EdgeOf::centre:
                    // Each lies between one of the wider side and the one plate of the other: it is told
                    // once.
                    if (far_left == is_left)
                        folds[kCentreFold].push_back({kCentreFold, up, far_left ? i : 0, far_left ? 1 : i});
                    break;
            }
        }
        if (i > 1)
            slit.more.push_back(std::move(ring));
        else
            (i == 0 ? slit.left : slit.right) = std::move(ring);
    }
    if (std::any_of(folds.begin(), folds.end(), [](const auto& of_kind) { return of_kind.empty(); }))
        return not_divided();
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
    const auto gone = [&](Border side) {
        drop_straight_corners(side);
        Ring path;
        for (std::size_t i = 1; i <= side.edges.size(); ++i)
            path.push_back(page(side.edges[i % side.edges.size()].from));
        return path;
    };
    slit.gone_left = gone(parts.upper);
    slit.gone_right = gone(parts.lower);
    slit.span = parts.span;
    std::vector<Border> on_page;
    for (const Border& one : parts.plates) on_page.push_back(mapped(one, page));
    into.curves = curves_of(on_page);
    return std::nullopt;
}

SheetFault not_divided() {
    return {"outline-off-fold", "its centre fold does not divide its outline into two halves",
            "draw it so that the paper goes on from the side folds to the fold"};
}

void fold_in_the_middle(Border& side) {
    for (BorderEdge& edge : side.edges) {
        if (edge.of == EdgeOf::drive) edge.of = EdgeOf::centre;
    }
}

}  // namespace popup
