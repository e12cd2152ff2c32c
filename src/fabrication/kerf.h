// The cuts of a piece moved out of the paper by half the width of what the tool burns away, so that the piece
// that falls out has the size it was drawn with.
//
// Terms: the kerf is the strip that the tool takes away, half of it on either side of its path. Waste is what
// a closed contour parts from the paper: all outside of the piece's edge, all inside of a hole.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/layout.h"
#include "popup/pattern.h"
#include "popup/profile.h"

namespace popup {

// Whole widths of the kerf, in mm: finite, not negative. 0, or under 0.0001 mm: contours stay as they are.
struct KerfWidths {
    double inner_mm = 0.0;  // of closed contours that lie inside another
    double outer_mm = 0.0;  // of closed contours at depth 0

    static KerfWidths of(const Profile& profile) {
        return {profile.pen(Operation::inner_cut).kerf_mm, profile.pen(Operation::outer_cut).kerf_mm};
    }
    [[nodiscard]] double at_depth(int depth) const { return depth == 0 ? outer_mm : inner_mm; }
};

// The cuts of the piece, moved by half the kerf into the waste: closed contours at even depth (0: the piece's
// edge) outwards, those at odd depth (holes) inwards. Open cuts stay where they are, for both of their sides
// are paper. `name` is what findings call the piece.
//
// Guarantees: as many contours, in their order, with their depths and directions; each starts at the corner
// its old start has become. Every edge moves in parallel. Corners stay corners (mitres), because the tool's
// path along a rounded one would leave the paper's corner just as sharp but take many short moves; where the
// paper has a corner under 60° the mitre would run far off, and is cut square at the distance of half a kerf.
// So are all corners of a contour whose mitres would meet across a narrow place.
// A path is nowhere nearer to its drawn contour than half the kerf, and never further than a whole one but in
// sharp corners of the waste. Those a round tool cannot reach into; they are left unfinished, without a word
// unless they are sharper than about 6°. Coordinates of moved contours are multiples of 1e-6 mm, which is
// also how exact they are. Where a kerf is 0 its contours are the same, bit by bit.
//
// Errors: `kerf-too-wide`, once a piece, for what the path can no longer make: a hole that vanishes or falls
// into several, a notch or a narrow place that closes, contours with waste between them nearer than the kerf.
// It names the narrowest of them (of the first 20) with its place on the piece, and says how many more
// contours have one. Places between two corners, where squares may meet as well, need up to 1.4 kerfs. What
// is lost is decided by moving each path back: a corner of the drawn contour that is then buried deeper than
// 0.01 mm is lost.
// Precondition: the contours do not cross. Cost: near linear in corners for contours of which level lines, or
// upright ones, meet few edges, and for smooth curves however fine their steps (fabrication/parallel_ring.h).
std::optional<std::vector<Contour>> compensated(const PatternPiece& piece, std::string_view name,
                                                const KerfWidths& kerf, Diagnostics& diagnostics);

// Does so with every piece of the layout, once a design however many copies there are. Where anything fails
// the layout stays as it was, and the answer is false.
// Errors: `kerf-too-wide`, at most 20 findings: for each piece as compensated() has it, and for the layout as
// check_kerf_distances() and check_moved_cuts() have it (fabrication/kerf_room.h), where cuts of neighbours
// would cross, or leave the sheet. Cost: near linear in corners of all designs, and in placements.
bool apply_kerf(Layout& layout, const KerfWidths& kerf, double spacing_mm, Diagnostics& diagnostics);

}  // namespace popup
