// The model as glTF 2.0: what moves, and what stands still.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "popup/output.h"

namespace popup {

// One scene of all cards: metres, +Y up. A card stands as stance_of() says, and its node's
// extras.orientation, with extras.orientation_guessed where nobody said it. Below that node (x, y, z) mm are
// at (x, y, z)/1000. Upright it is not turned: an open card faces +Z with its gutter along Y. Flat it is
// turned so that its open pages face +Y. A stage's ground faces +Y at all openings, its spine along X, so its
// node turns as the card opens. A card is a node, its plates are nodes below it in the hinge tree: a plate's
// node has its origin at the plate's pivot, so opening only turns it. Names and extras as the command line's
// documentation says. At rest the cards stand open as best_opening() has it. The animation
// `open` runs from closed to open in options.duration_s, the angle growing evenly; its extras.angles_deg
// lists the opening angle of every key. Keys are chosen so that between them, too, no fold opens by more
// than 0.05 mm (see keys.h). What lies on other paper is beside its place as Apart has it (apart.h): then the
// animation moves its node, too, at the keys at which it does. Several cards stand side by side along +X, 20
// mm apart at their widest. Drawn lines are parts of a plate's mesh, 0.02 mm before its front. Paper with a
// fill is bare and white from behind, unless options.backs; under options.edge_lines cut edges and folds are
// lines of the materials `edge` and `fold`. Plates that cross others are of one material, `collision`,
// whatever their paper, and their extras.collisions lists {with, from_deg, to_deg, depth_mm}.
//
// Plates that stand still are a node a piece, below the one of their source's name: as triangles, white where
// they have no fill, and the traces they were drawn with as lines, black
// ("trail"), all in space where they stand, z up. Nodes of pieces have their name in
// extras.part. Where nothing moves there is no animation.
//
// Lengths are rounded to 1e-6 mm and turns to 1e-9 before they become 32-bit numbers, so that the bytes do
// not depend on the processor. Errors: those of choose_keys(), and `model-too-large` for more than 2 GiB.
// Precondition: at least one card; has_model() of all assemblies, and motions of those that move. Cost:
// plates × keys.
std::optional<std::string> write_glb(std::span<const SceneCard> cards, const OutputOptions& options,
                                     Diagnostics& diagnostics);
// The same as text, with the numbers in a data URI.
std::optional<std::string> write_gltf(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace popup
