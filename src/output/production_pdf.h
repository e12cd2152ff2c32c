// Cut sheets as PDF for print shops that print and cut: what is printed in process colours, what is done to
// the paper in spot colours and in layers that say what they are for.
#pragma once

#include <optional>
#include <vector>

#include "popup/output.h"

namespace popup {

// Whether a pen that draws has a spot colour.
bool has_spot_colors(const Profile& profile);

// Like write_pdf() (pdf.h), for such profiles: one document of all sheets, a page a sheet view; with
// print_and_cut one of the prints and one of the cuts. PDF 1.6, MediaBox and TrimBox the sheet, coordinates
// in 1/10000 point (0.00004 mm). The same bytes with the same versions of qpdf, zlib and FreeType; no date
// unless SOURCE_DATE_EPOCH is set.
//
// Colours: only DeviceCMYK and Separation are used, so that the plates are those of the process colours that
// occur and one a spot name. Process colours are made from sRGB by K = 1 - max(r, g, b) and
// C = (1 - K - r) / (1 - K), likewise M and Y: black is K alone, greys too. That is for telling things apart,
// no colour management. A pen's spot colour takes what its operation draws in full tint, the own colours of
// fills and drawn lines too, and overprints, so that nothing below it is knocked out; for screens and proofs
// its alternate is the pen's colour, of several pens with one spot name the first's. Spots named All or None
// have the meaning that PDF gives these names; profiles read from files have none.
//
// Letters are outlines, whatever the profile says of text.
//
// Layers: an optional content group a layer of the profile in which something is drawn, the same on all
// pages, on, in the order of operations. Those of folds, cuts and glue targets say in GTS_Metadata which
// processing step of the group Structural they are (ISO 19593-1): Cutting of slits and cuts, Creasing of
// valley folds and seams, ReverseCreasing of mountain folds, Perforating, Gluing. A layer that holds several
// such steps is a group a step, all of its name.
//
// Errors: `font-missing`, `pdf-page-size`, `pdf-failed`, `reference-too-long`. Cost: near linear in what lies
// on the sheets; a document is held in memory.
std::optional<std::vector<SheetFile>> write_production_pdf(const Layout& layout, const OutputOptions& options,
                                                           Diagnostics& diagnostics);

}  // namespace popup
