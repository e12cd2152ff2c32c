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
// apart, their lower edges on y = 0, with the fold angles of where the motion ends (edges_foldAngle; none
// where that is not known); a fold that its loops keep flat has the angle that its pattern asks for, so that
// programs that bend paper fold it. Each sampled angle of any card's motion makes one more frame, which
// inherits all but places and fold angles: the cards as they stand in the world at that angle
// ("popupc:angle_deg"), placed in closed form whatever the motion's solver, several cards side by side along
// x, 20 mm apart at their widest. Without sampled angles there is the crease pattern alone.
//
// Faces are plates, counter-clockwise seen from the paper's front; FOLD has no holes in faces, so a plate
// with holes is several triangles with edges between them that are never folded. "faces_popupc:plate" and
// "faces_popupc:piece" name each face's plate and piece, the card's prefix before the name. The mesh is an
// orientable manifold: M and V edges (the assembly's folds) and those within plates have two faces, B edges
// one. Faces share a vertex only where a way from one to the other over such edges holds the paper together
// there, so in every folded frame each vertex has one place. Where folds of two plates' edges overlap in
// part, both edges are split. The two sides of a slit are B edges of their own, with vertices of their own
// but for the ends at which the paper holds together. So is a glued seam's edge of its piece: F and U are
// creases between two faces, and a seam is neither, because what it is glued to is another paper, mostly in
// the middle of a face. No edge is shorter than 1e-6 mm. Tabs, colours, drawn lines and slits within one
// plate are left out. Fold angles are positive for valleys and negative for mountains; those of all other
// edges are 0, but for F edges along which panels bend (Sweep::bends), in folded frames.
//
// FoldDialect::simulator, the default, is what Origami Simulator, Rabbit Ear and most others fold without
// more: they build hinges of M, V and F edges alone, and read the key frame alone. Edges within plates are F,
// and a fold that does not say which way it goes has the letter of the way that it went. No more is lost by
// it, because whoever reads F and J keeps both flat.
//
// FoldDialect::strict uses all letters of FOLD 1.2: edges within plates are J, folds that do not say which
// way they go U, with an angle of 0. Slits are C edges with their two faces, on vertices that both share, as
// on the sheet. Where there are any, frame 1 is the pattern with its slits open, and folded frames inherit
// from that, because folded a slit's sides have two places.
//
// Of a pattern that was read from a FOLD file its other keys are written, too (SceneCard::creases,
// CarriedKeys): members as they stood; columns with the value of the element in the same place, null where
// there is none (output/fold_sources.h); faceOrders in numbers of this file, if each face of the one is a
// face of the other and the card has no order of its own. file_title and frame_title are those of the file;
// of file_classes, frame_classes and frame_attributes those with a colon follow popupc's. Of several cards in
// one file none of it is written. Remark: `fold-left-out`, of keys and frames of the file that are not.
//
// Where nothing moves, and it is known of each plate where it stands, one frame has the plates there. It has
// "faceOrders" if the order of plates that lie on one another is known (Assembly::layers).
//
// Errors: `locks` where a linkage cannot reach an angle; `model-too-large` for files of more than about 2 GB.
// Preconditions: at least one card; assemblies are present, motions may be missing. Cost: vertices × angles,
// sorting, and pairs of layers.
std::optional<std::string> write_fold(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace popup
