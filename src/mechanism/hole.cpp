// The hole: a cut-out through a whole sheet, the page and whatever is cut from it and lies there (Foldlings).
//
// It comes after what it goes through. Folds that it crosses are split.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/geometry/regions.h"
#include "mechanism/rows.h"
#include "mechanism/sheet_rows.h"

namespace popup {
namespace {

constexpr std::array<ParameterInfo, 1> kParameters{
    {{.name = "outline",
      .kind = ParameterKind::path,
      .about = "border of the hole, on the page that it goes through",
      .required = true,
      .page = PointPage::fold}}};
constexpr std::array<std::string_view, 2> kOtherNames{"cut-out", "window"};

bool constrain(Element& e) {
    const std::span<const Polygon> areas = areas_of(e, "outline");
    if (areas.size() == 1 && areas.front().holes.empty() && !constrain_border(e)) return false;
    for (const Polygon& part : areas_of(e, "outline")) {
        if (!part.holes.empty()) {
            e.failed("hole-off-piece",
                     "it has an island at " + at_mm(part.holes.front().front()) + ", which would fall out",
                     "draw it as one area, or as several beside one another");
            return false;
        }
        const Pierced pierced = e.paper->pierce(part.outer);
        if (pierced.code.empty()) continue;
        e.failed(pierced.code, pierced.what, pierced.hint);
        return false;
    }
    return true;
}

void lower(const Element& e, Builder& builder) {
    builder.add_curves(curves_of(e, "outline"));
    for (const Polygon& part : areas_of(e, "outline")) {
        // As the paper is now: what the parts before took is no longer there.
        const Pierced pierced = e.paper->pierce(part.outer);
        builder.add_window(e.site.left_page, part.outer, pierced.plates);
        for (const Pierced::Span& span : pierced.folds)
            builder.add_gone(span.fold, span.from, span.to, e.paint.id);
    }
}

}  // namespace

const ElementRow kHole = {{.name = "hole",
                           .code = -1,
                           .family = "hole",
                           .inverted = false,
                           .glued = false,
                           .about = "a cut-out through a page and what is cut from it",
                           .points = {},
                           .partners = {},
                           .grounds = {.fold = false, .page = true},
                           .parameters = kParameters,
                           .folds = {},
                           .since = "3.0",
                           .also = kOtherNames},
                          stands_on_no_fold,
                          constrain,
                          makes_no_folds,
                          nullptr,
                          lower};

}  // namespace popup
