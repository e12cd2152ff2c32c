// Whether a crease pattern folds flat: every fold by half a turn, all panels in one plane, one on the other.
//
// Another question than how a sheet moves: many patterns fold flat whose panels must bend on the way.
//
//     const std::optional<FlatFolding> flat = fold_flat(pattern, {}, diagnostics);
//     if (flat) fmt::print("{} panels in up to {} layers\n", flat->panels, flat->layers);
#pragma once

#include <cstddef>
#include <optional>

#include "popup/assembly.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"

namespace popup {

struct FlatFolding {
    std::size_t panels = 0;
    std::size_t overlaps = 0;  // pairs of panels that lie on each other
    std::size_t layers = 0;    // the most panels on one place
    // The sheet as it lies: plates stand in the plane z = 0, the largest of each piece where it is drawn.
    // Assembly::layers has all pairs that lie on each other. Folds are the mountains and valleys that the
    // order makes them, by half a turn.
    Assembly assembly;
};

// Looks for the flat state of a crease pattern, whatever angles it asks for, and for an order of its layers.
// Folds that do not say which way they go may go either way; cuts and slits are edges of panels; pieces lie
// side by side. Corners that miss Kawasaki's condition, and lines that miss being straight, by less than 0.1°
// are taken as what they were meant to be.
//
// Told with their places, beside what fold_sheet() tells of lines: warnings `flat-odd` (an inner corner of an
// odd number of folds), `flat-angles` (Kawasaki's theorem), `flat-kinds` (Maekawa's), `flat-loop` (panels do
// not meet again around a hole), `flat-order` (no order of the layers; with panels that have none among
// themselves), `flat-undecided` (too much to look at). nullopt if anything but the last is told, or the lines
// are no sheet. The last has no order and is no proof of none. A sheet that folds flat is told of as a
// remark, `folds-flat`; corners that were moved are told as `corners-refined`. Cost: near linear in the lines
// that the panels' edges make where they lie; at most cubic in the panels that lie on one place; the search
// stops after 60 million steps, which take some seconds.
std::optional<FlatFolding> fold_flat(const CreasePattern& pattern, const FoldOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace popup
