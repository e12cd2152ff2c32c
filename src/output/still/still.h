// Still pictures of the model, for who wants to see a card before paper is cut. No display, no GPU.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "popup/output.h"

namespace popup {

// One PNG a view and opening, as options.still says. Where there are several, files have the view, the
// opening or both in their names: "card-front-90.view.png". All cards of a run stand side by side.
//
// Hidden surfaces are right to a hundredth of a millimetre; prints lie on their paper, and plates that are
// glued flat, or folded flat in a known order, a paper's thickness apart; closed cards are shown 1.5 degrees
// open. Edges are smooth (nine samples a pixel, added up in linear light). Light comes over the
// viewer's left shoulder and throws soft shadows, on the ground too. Seen in perspective, everything is in
// the picture, with a margin.
//
// Cards stand as stance_of() says: as a stage, with the right page on the ground and the left one a back
// wall, upright, or as they lie on a table. Sheets that are folded stand as they are drawn, their largest
// panel on the ground.
//
// The same bytes on every machine, with the same versions of libpng, zlib and FreeType. Errors:
// `picture-too-large` (more than 100 million pixels), `picture-failed`, `locks` where a linkage cannot reach
// an opening. Remark: `view-beyond`, of openings that no card reaches; they are shown as far as one does.
// Cost: a triangulation of the plates, then by picture its pixels, and plates times the rows that
// they cover. Memory: 3 bytes a pixel, and 6 MB.
std::optional<std::vector<SheetFile>> write_view_png(std::span<const SceneCard> cards,
                                                     const OutputOptions& options, Diagnostics& diagnostics);

}  // namespace popup
