// The polygon: a border of lines across a fold, cut from one sheet (Foldlings).
//
// Where its far edges run along the fold these are its side folds; else the side fold cuts its tips off.
// Curves are taken as of a freeform.
#include <array>

#include "mechanism/rows.h"
#include "mechanism/sheet_rows.h"

namespace popup {
namespace {

constexpr std::array<ParameterInfo, 7> kParameters{{kHalfColours[0], kHalfColours[1], kHalfColours[2],
                                                    kHalfColours[3], kSheetOutline, kTopFold, kBottomFold}};

// A gable: its far edges run along the fold.
constexpr std::array<Vec2, 6> kFresh{
    {{-0.5, -0.3}, {0.0, -0.5}, {0.5, -0.3}, {0.5, 0.3}, {0.0, 0.5}, {-0.5, 0.3}}};

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
                              .since = "3.0",
                              .measures = sheet::kMeasures},
                             sheet::span,
                             sheet::constrain,
                             sheet::fold_lines,
                             nullptr,
                             sheet::lower,
                             sheet::crossings,
                             sheet::measured,
                             [](Element& e, std::span<const double> v) { sheet::shape(e, v, kFresh); }};

}  // namespace popup
