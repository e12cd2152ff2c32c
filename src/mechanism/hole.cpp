// The hole: a cut-out through a whole sheet, the page and whatever is cut from it and lies there (Foldlings).
//
// It comes after what it goes through. Folds that it crosses are split.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/geometry/regions.h"
#include "mechanism/drawn_lines.h"
#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/sheet_rows.h"
#include "mechanism/thin_places.h"

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
    const auto path = drawn_path(e);
    const bool one_line = path && path->subpaths().size() == 1;
    if (one_line ? !constrain_border(e) : !mend_holes(e, "outline", "its outline")) return false;
    std::optional<Pierced::Narrow> narrow;
    for (const Polygon& part : areas_of(e, "outline")) {
        if (!part.holes.empty()) {
            e.failed("hole-off-piece",
                     "it has an island at " + at_mm(part.holes.front().front()) + ", which would fall out",
                     "draw it as one area, or as several beside one another");
            return false;
        }
        const Pierced pierced = e.paper->pierce(part.outer);
        if (!pierced.code.empty()) {
            e.failed(pierced.code, pierced.what, pierced.hint);
            return false;
        }
        if (pierced.narrow && (!narrow || pierced.narrow->width_mm < narrow->width_mm))
            narrow = pierced.narrow;
    }
    if (narrow) tell_thin_between_holes(e, narrow->at, narrow->width_mm);
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

constexpr MeasureInfo kWidth{.name = "width", .about = "how wide it is", .share = 0.08};
constexpr MeasureInfo kHeight{.name = "height", .about = "how high it is", .share = 0.08};
constexpr std::array<MeasureInfo, 5> kMeasures{{measure::kX, measure::kY, kWidth, kHeight, measure::kTurnBy}};

std::vector<double> measured(const Element& e) {
    const Box box = measure::drawn_box(e, "outline", {});
    if (box.empty()) return {0.0, 0.0, 0.0, 0.0, 0.0};
    return {box.centre().x, box.centre().y, box.width(), box.height(), 0.0};
}

void shape(Element& e, std::span<const double> v) {
    const Box box = measure::drawn_box(e, "outline", {});
    const measure::Spot to{{v[0], v[1]}};
    if (box.empty()) {
        const auto page = e.arguments.front().page;
        e.arguments.front() = measure::ellipse(to, v[2], v[3]);
        e.arguments.front().page = page;
        return;
    }
    measure::place_drawn(e, {}, box, to, measure::scale_of(box.width(), box.height(), v[2], v[3]), v[4]);
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
                           .also = kOtherNames,
                           .measures = kMeasures,
                           .plates = {}},
                          stands_on_no_fold,
                          constrain,
                          makes_no_folds,
                          nullptr,
                          lower,
                          nullptr,
                          measured,
                          shape};

}  // namespace popup
