// Whether there is room on the sheets for cuts that are moved for the kerf: between neighbours, and in the
// margin.
#pragma once

#include <cstddef>
#include <vector>

#include "fabrication/kerf.h"
#include "popup/layout.h"

namespace popup {

// Whether pieces that share a sheet are at least a kerf apart, and the margin is at least half a kerf of
// outer cuts wide. Of a piece in the hole of another, the hole's kerf counts for half. It is not known which
// pieces lie in holes: any with a hole may have one there. Returns how many findings there are. Errors:
// `kerf-too-wide`, with the --spacing or --margin that would do.
std::size_t check_kerf_distances(const Layout& layout, const KerfWidths& kerf, double spacing_mm,
                                 Diagnostics& diagnostics);

// Whether no moved cut crosses that of a neighbour, or leaves its sheet. That can happen at distances that
// check_kerf_distances() finds wide enough: at a sharp corner the cut runs up to a whole kerf away from the
// paper (compensated()). Cuts that touch, or overlap by less than 0.002 mm, are good.
// `moved` has the cuts of each piece as compensated() gives them, of all pieces of the first design, then of
// the second. Returns how many findings there are: at most one for neighbours and one for the margin, each
// with its worst place.
// Errors: `kerf-too-wide`, with the --spacing or --margin that would do.
// Cost: nothing where pieces are two kerfs apart, and the margin is a kerf wide; else near linear in corners
// for pieces whose boxes meet few others.
std::size_t check_moved_cuts(const Layout& layout, const KerfWidths& kerf, double spacing_mm,
                             const std::vector<std::vector<Contour>>& moved, Diagnostics& diagnostics);

}  // namespace popup
