// The model as a FOLD file: its crease pattern, and the card folded at every angle of the motion.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "popup/output.h"

namespace popup {

// FOLD 1.2, the JSON format for folded paper of Demaine, Ku and Lang (https://github.com/edemaine/fold,
// doc/spec.md). Lengths are millimetres and angles degrees, both rounded to six decimals.
//
// The key frame is the crease pattern in the plane: all pieces of all cards side by side along x, 10 mm
// apart, their lower edges on y = 0. Each sampled angle of any card's motion makes one more frame, which
// inherits all but places and fold angles: the cards as they stand in the world at that angle
// ("popupc:angle_deg"), placed in closed form whatever the motion's solver, several cards side by side along
// x, 20 mm apart at their widest. Without sampled angles there is the crease pattern alone.
//
// Faces are plates, counter-clockwise seen from the paper's front; FOLD has no holes in faces, so a plate
// with holes is several triangles with join edges (J) between them. "faces_popupc:plate" and
// "faces_popupc:piece" name each face's plate and piece, the card's prefix before the name. The mesh is an
// orientable manifold: M and V edges (the assembly's folds) and J edges have two faces, B edges one. Faces
// share a vertex only where a way from one to the other over such edges holds the paper together there, so in
// every folded frame each vertex has one place. Where folds of two plates' edges overlap in part, both edges
// are split. The two sides of a slit are B edges of their own, with vertices of their own but for the ends
// at which the paper holds together. So is a glued seam's edge of its piece: FOLD's C stands for several B
// edges at one place of the pattern, F and U for creases between two faces, and a seam is neither, because
// what it is glued to is another paper, mostly in the middle of a face. No edge is shorter than 1e-6 mm.
// Tabs, colours and drawn lines are left out. Fold angles are positive for valleys and negative for
// mountains; those of B and J edges are 0.
//
// Errors: `locks` where a linkage cannot reach an angle; `model-too-large` for files of more than about 2 GB.
// Preconditions: at least one card; assemblies are present (motions may be missing), stills are not. Cost:
// vertices × angles, and sorting.
std::optional<std::string> write_fold(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace popup
