// The freeform: any shape across a fold, cut from one sheet (Foldlings), drawn as an outline or as the points
// that a finger touched.
//
// A side fold lies where the shape, seen from its far end, first is wide enough for one; what is further out
// is not cut.
#include <array>

#include "mechanism/rows.h"
#include "mechanism/sheet_rows.h"

namespace popup {
namespace {

constexpr ParameterInfo kOutline = [] {
    ParameterInfo outline = kSheetOutline;
    outline.required = false;
    return outline;
}();
constexpr std::array<ParameterInfo, 8> kParameters{
    {kHalfColours[0],
     kHalfColours[1],
     kHalfColours[2],
     kHalfColours[3],
     kOutline,
     {.name = "touchpoints",
      .kind = ParameterKind::points,
      .about = "points that its border goes through in a smooth curve, in place of an outline",
      .page = PointPage::fold},
     kTopFold,
     kBottomFold}};

}  // namespace

const ElementRow kFreeform = {{.name = "freeform",
                               .code = -1,
                               .family = "freeform",
                               .inverted = false,
                               .glued = false,
                               .about = "any shape across a fold, cut from one sheet",
                               .points = {},
                               .partners = {},
                               .grounds = kFoundFold,
                               .parameters = kParameters,
                               .since = "3.0",
                               .measures = sheet::kMeasures},
                              sheet::span,
                              sheet::constrain,
                              sheet::fold_lines,
                              nullptr,
                              sheet::lower,
                              sheet::crossings,
                              sheet::measured,
                              [](Element& e, std::span<const double> v) { sheet::shape(e, v, {}); }};

}  // namespace popup
