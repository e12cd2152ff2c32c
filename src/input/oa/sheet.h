// Which part of the unfolded sheet lies in which plane: the rules of webOAcard.
//
// Depths, heights and the x and y of the sheet are those of input/origamic/folds.h.
//
//     const std::optional<Sheet> sheet = lay_out_sheet(*card, diagnostics);
//     for (const Region& region : sheet->regions) ...
//
// The rules: what of a face lies below the floor (x > depth) or outside of the card is not there. Holes cut
// faces and pulls of less depth, and of the same depth those that are older or have no time. Faces and pulls
// of one depth are one. From each upper edge of a face that runs along the gutter a plate runs back
// horizontally, as wide as the edge, until the back; from the lower edge of an opening in it as wide as the
// opening. Of a text only the topmost edges do, and of a pull only edges of openings. What stands further
// out, or lies in its way, ends it; what it is cut off from its edge by does not count. Where several would
// have the same paper, what lies has it before what stands, the higher before the lower and the nearer before
// the farther; back and floor have the rest.
#pragma once

#include <optional>
#include <vector>

#include "input/oa/card.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup::oa {

// A connected part of the sheet in one plane.
struct Region {
    bool upright = false;  // parallel to the back, else to the floor
    double offset = 0.0;   // its depth, or its height; 0 of back and floor
    Polygon area;
    int face = -1;         // Face::number of what it was made for; -1: back and floor
    bool top = false;      // it runs back from that face
    double cut_mm2 = 0.0;  // of back and floor: so much of it lies where faces have holes
};

struct Sheet {
    // Back, floor, then standing ones from the farthest to the nearest, then lying ones from the lowest up.
    // They do not overlap, and cover the card together, but for a grid's step along their edges.
    std::vector<Region> regions;
};

// Repair: `oa-snapped`, of lower edges that miss what they would stand on by up to half a millimetre.
// Remarks: `oa-clipped`, of faces that lie partly outside of the card. Warning: `oa-hidden`, of faces nothing
// is left of. nullopt and `document-too-large` where faces overlap too much. Cost: near linear in corners, as
// long as each plate meets few others.
std::optional<Sheet> lay_out_sheet(const Card& card, Diagnostics& diagnostics);

}  // namespace popup::oa
