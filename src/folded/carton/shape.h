// Panels in space as the places of their corners, and constraints between these: the refinement of Folding
// Cartons (section 4.2).
//
//     const Solved solved = solve_shape(shape, {{{0, 7}}, {{2, 5}}}, {.size_mm = 300.0});
//     if (!solved.closes) fmt::print("{:.2f} mm are left\n", solved.residual_mm);
#pragma once

#include <utility>
#include <vector>

#include "popup/geometry.h"

namespace popup::folded {

struct Shape {
    // The same corners in space, as numbers of `at`, and on the flat sheet, mm: at least three. The first
    // three enclose an area, the larger the better.
    struct Panel {
        std::vector<int> vertices;
        std::vector<Vec2> flat;
    };
    std::vector<Vec3> at;  // where the search begins; corners that panels share hold them together
    std::vector<Panel> panels;
};

struct ShapeJoins {
    std::vector<std::vector<int>> merged;         // vertices that are to be in one place
    std::vector<std::pair<int, int>> in_a_plane;  // panels
};

struct SolveOptions {
    double size_mm = 0.0;     // of the sheet; > 0
    double enough = 1e-9;     // of the size: conditions that are left open by no more are closed
    double hold = 1e-3;       // the weight of vertices where they began (the paper's w)
    int steps_at_most = 120;  // of each of the two searches
};

struct Solved {
    enum class Worst { nothing, panel, merge, plane };
    std::vector<Vec3> at;      // by vertex
    bool closes = false;       // all conditions hold to `enough`
    double residual_mm = 0.0;  // by how much the worst is left open
    Worst worst = Worst::nothing;
    int number = -1;         // of that panel, merge or pair
    int steps = 0;           // of Levenberg-Marquardt
    bool projected = false;  // it took projections to come near
    bool settled = true;     // false: it might come nearer still, but has made all its steps
};

// Looks for the places nearest to where the vertices began at which
//
// * every panel has its flat shape: the distances between its first three corners, and every further one
//   where these three have it. That is rigidity and coplanarity in as many conditions as a panel's corners
//   have freedoms too many, most of them linear;
// * merged vertices are in one place;
// * the corners of two panels lie in one plane.
//
// Levenberg-Marquardt on all of them with all vertices held softly: the paper holds those that no join
// concerns, but the others may drift far where a join says little. Then the same with every vertex held where
// it is, which takes the bias of the soft conditions out again and converges faster than linearly where the
// conditions can all hold. Where that does not close, it begins again behind rounds
// of projections (Bouaziz et al., Shape-Up, 2012: panels to their best fit, vertices to their mean, planes by
// the eigenvectors of the covariance); the better of both counts. Where neither closes, `at` is a compromise
// in least squares, in which panels are stretched, too. Cost: that of a sparse factorisation a step.
Solved solve_shape(const Shape& shape, const ShapeJoins& joins, const SolveOptions& options);

}  // namespace popup::folded
