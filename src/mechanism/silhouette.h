// Drawn silhouettes: glued pieces whose free edges are an outline that the author drew.
//
// The outline has the piece's seams on its border and is divided by its centre fold:
//
//     if (has_silhouette(e) && !constrain_silhouette(e, lines)) return false;   // in constrain()
//     const Silhouette drawn = silhouette_of(e, lines).value();                 // in lower()
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "mechanism/element.h"
#include "mechanism/shapes.h"

namespace popup {

// The parameters of rows of such elements.
inline constexpr std::array<ParameterInfo, 6> kDrawnHalves{
    {kHalfColours[0],
     kHalfColours[1],
     kHalfColours[2],
     kHalfColours[3],
     {.name = "outline",
      .kind = ParameterKind::path,
      .about = "shape of the piece, on its own page, in place of its straight free edges",
      .since = "3.0"},
     {.name = "hole",
      .kind = ParameterKind::path,
      .about = "holes of the piece, on its own page; they may cross its centre fold",
      .since = "3.0"}}};

// What an outline must have, on the piece's own page.
struct PieceLines {
    Segment left_seam, right_seam;
    std::string_view left_name, right_name;  // "G–E"
    Vec2 centre_at, centre_dir;              // a point of the centre fold, and its direction (unit)
};

// Rings run counter-clockwise, and each has the centre fold as one edge. The left half has the left seam. Its
// holes are for mechanism/holes.h.
struct Silhouette {
    Halves halves;
    Segment centre;  // along PieceLines::centre_dir
};

bool has_silhouette(const Element& e);
// The piece as drawn; nullopt where the outline is not as it must be, or there is none.
std::optional<Silhouette> silhouette_of(const Element& e, const PieceLines& lines);

// Snaps points of the outline to the ends of seams that it misses by at most 0.5 mm (`outline-snapped`),
// mends where it crosses itself (mend_outline()), then looks whether it is as it must be; false after
// failed(): `outline-crosses` where it is not one area, `outline-off-seam`, or `outline-off-fold`.
bool constrain_silhouette(Element& e, const PieceLines& lines);

}  // namespace popup
