// Plates as one mesh of faces, edges and vertices that holds together where the paper does.
#pragma once

#include <cstddef>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// Faces by their corners. A corner's number is also that of the side from it to the next corner of its face.
struct FoldMesh {
    std::vector<Vec2> points;        // on the pages, each once a page
    std::vector<std::size_t> first;  // corners of face f are those from first[f] to first[f + 1]
    std::vector<int> face_plate;
    std::vector<int> face;           // of each corner
    std::vector<int> point;          // of each corner
    std::vector<int> twin;           // of each side: the one on the other side of its edge; -1: none
    std::vector<char> letter;        // of each side, as FOLD has it
    std::vector<int> vertex;         // of each corner
    std::vector<int> vertex_corner;  // of each vertex: its first corner
    std::vector<int> edge_side;      // of each edge: its side, or the first of the two

    // The corner after this one, round its face: where its side ends.
    [[nodiscard]] int next(int corner) const;
    [[nodiscard]] Vec2 place(int corner) const;  // on its page
    [[nodiscard]] int plate(int corner) const;
};

enum class FoldSlits {
    open,   // their sides are edges of their own, with vertices that come apart when the paper is folded
    drawn,  // they are edges, C, between their two sides, as on the sheet
};

// One face a plate, in the order of the pieces and their plates; of a plate with holes its triangles. Corners
// of a piece within 2e-6 mm of each other are one point, so that no side is shorter; where faces have no room
// for three corners left they are left out. Two sides are twins, with the letter M or V (U where the assembly
// has no line for it), where they lie on a fold that is a hinge of their plates, and J within a plate; both
// are split before, so that twins have the same ends. All others have the letter B. Corners are the same
// vertex where twins lead from one to the other. With FoldSlits::drawn, sides of a piece that lie on each
// other are twins, too, with the letter C, split where corners lie on them, and all corners of a piece in one
// place are one vertex. The answer depends on the assembly alone. Cost: near linear in corners for plates
// whose folds come near few edges.
FoldMesh fold_mesh(const Assembly& assembly, FoldSlits slits = FoldSlits::open);

}  // namespace popup
