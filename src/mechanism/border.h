// The border of what is cut from one sheet: chords that know which curve they stand for, so that folds and
// other curves are met on the curve itself.
//
//     Border border;
//     if (border_of(path, border) != FlatteningFault::none) …
//     const LoopRepair mended = without_loops(border);      // where the line crosses itself
//     builder.add_curves(curves_of({&border, 1}));
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "popup/geometry.h"
#include "popup/path.h"

namespace popup {

// What an edge is for whoever divides the border: drawn, or one of the lines that it was divided by.
enum class EdgeOf { drawn, drive, side, centre };

// From where it begins to where the next edge does.
struct BorderEdge {
    Vec2 from;
    int curve = -1;             // of Border::cubics; -1: a line
    double t0 = 0.0, t1 = 0.0;  // of the curve
    EdgeOf of = EdgeOf::drawn;
};

struct Border {
    std::vector<BorderEdge> edges;  // closed: the last ends where the first begins
    std::vector<Cubic> cubics;

    [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 == edges.size() ? 0 : i + 1; }
    [[nodiscard]] Segment chord(std::size_t i) const { return {edges[i].from, edges[next(i)].from}; }
};

// The only subpath of a path, closed. An empty one gives no edges.
FlatteningFault border_of(const Subpath& subpath, Border& into);
Ring ring_of(const Border& border);
// Turns it round.
void reverse(Border& border);
// With each point replaced by what `map` makes of it. Precondition: the map is rigid.
template <typename Map>
Border mapped(const Border& border, const Map& map) {
    Border made = border;
    for (BorderEdge& edge : made.edges) edge.from = map(edge.from);
    for (Cubic& c : made.cubics) c = {map(c.from), map(c.control_1), map(c.control_2), map(c.to)};
    return made;
}
// What the chords of borders stand for, for Builder::add_curves(): with every corner that was put on a curve.
// Precondition: all have the same cubics, as parts of one border do.
std::vector<FlatCurve> curves_of(std::span<const Border> borders);
// The same line as a path of lines and cubics.
Path path_of(const Border& border);
// The least radius of curvature of its curves, and where; nullopt where all are lines. By samples on each
// chord, three of them.
struct TightSpot {
    double radius_mm = 0.0;
    Vec2 at;
};
std::optional<TightSpot> tightest(const Border& border);

// What was left out at places where a line crossed or touched itself.
struct DroppedLoop {
    Vec2 at;
    double area_mm2 = 0.0;
    double size_mm = 0.0;  // the longer side of its box
};
struct LoopRepair {
    std::vector<DroppedLoop> dropped;  // in the order in which they were found along the line
    bool hopeless = false;             // it crosses itself more often than anybody draws
};
// Makes the border one that touches itself nowhere: at each crossing, touch and stretch that is gone along
// twice, the loop of larger area is kept. Crossings are found on the curves where these cross, not only their
// chords. Counter-clockwise afterwards; fewer than three edges: nothing is left. Cost: near linear in edges a
// loop.
LoopRepair without_loops(Border& border);

}  // namespace popup
