// The polygon: a border of lines across a fold, cut from one sheet (Foldlings).
//
// Where its far edges run along the fold these are its side folds; else the side fold cuts its tips off.
#include <algorithm>
#include <array>

#include "mechanism/rows.h"
#include "mechanism/sheet_rows.h"

namespace popup {
namespace {

constexpr std::array<ParameterInfo, 5> kParameters{
    {kSheetColours[0], kSheetColours[1], kSheetOutline, kTopFold, kBottomFold}};

bool constrain(Element& e) {
    const auto border = drawn_border(e);
    if (border && !border->cubics.empty()) {
        e.failed("polygon-curved", "its outline has curves, and a polygon is drawn with lines",
                 "make it a freeform");
        return false;
    }
    return sheet::constrain(e);
}

}  // namespace

const ElementRow kPolygon = {{.name = "polygon",
                              .code = -1,
                              .family = "polygon",
                              .inverted = false,
                              .glued = false,
                              .about = "a shape of straight lines across a fold, cut from one sheet",
                              .points = {},
                              .partners = {},
                              .grounds = kFoundFold,
                              .parameters = kParameters,
                              .since = "3.0"},
                             sheet::span,
                             constrain,
                             sheet::fold_lines,
                             nullptr,
                             sheet::lower,
                             sheet::crossings};

}  // namespace popup
