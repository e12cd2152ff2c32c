// Vertices of a folded shape moved, while its panels stay plane.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "folded/carton/edit_subject.h"
#include "folded/carton/vertices.h"
#include "popup/geometry.h"

namespace popup::folded {

inline constexpr double kLeastMove = 1e-9;     // mm: what moves by less stands still
inline constexpr double kLeastTriangle = 1.0;  // mm², twice its area: less than that is a line

// Three corners, by their places in `at`, that enclose a large triangle. At least one corner.
std::array<std::size_t, 3> wide_triple(const std::vector<Vec2>& at);

struct MovedVertices {
    std::vector<Vec3> by;  // by corner of the sheet cut apart; nought of those that are no vertices
    // By panel: 1: it has its shape from vertices; 0: it follows the crease it hangs on.
    std::vector<char> solved;
    std::vector<Vec3> normals;  // by panel that is solved: the front's way, unit; nought: it has no area
    // By vertex: it meets nothing, and follows the outline around it: the end of a flap's crease in the
    // middle of a straight edge, or a corner of one panel alone, unless one of that panel is to move.
    std::vector<char> loose;
    double bent_mm = 0.0;  // by how much the worst panel is not plane
    int worst = -1;        // that panel
};

// The moves with the least sum of squares that leave all panels plane. `subject` moves as it says, its exact
// corners to the last digit. Corners of a vertex that are a board apart move alike, but for as little as
// planes that turn need; those in one place stay in one. Newton steps to the nearest point at which the
// conditions hold, as they are there to the first order.
MovedVertices move_vertices(const Vertices& shape, const Subject& subject);

// The places of all corners on the sheet, unfolded anew from the largest panel of each piece that has not
// moved. `gape_mm`: how far corners of folds that close loops have two places; at which corner.
struct Unfolded {
    std::vector<Vec2> corners;
    double gape_mm = 0.0;
    int gapes_at = -1;
};
Unfolded unfold(const Vertices& shape, const MovedVertices& moved);

}  // namespace popup::folded
