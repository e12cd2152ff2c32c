// The layer, also called a strap: a piece glued along two seams parallel to the
// fold that is exactly as wide as they are apart, so that it lies flat on the
// open card (Glassner, section 4).
//
// With p, q the seams' distances from the fold, its sides are s1 = q and s2 =
// p: over a valley fold it moves as a parallelogram, and its centre fold stays
// parallel to the fold, displaced by q − p. A mountain fold that it is wrapped
// round holds it only with p = q: then it lies on its planes at every angle.
#include <fmt/format.h>

#include <algorithm>

#include "mechanism/rows.h"
#include "mechanism/silhouette.h"
#include "mechanism/site_lines.h"
#include "mechanism/two_seams.h"

namespace popup {
namespace {

using namespace two_seams;

constexpr std::array<std::string_view, 1> kOtherNames{"strap"};

// As wide as the seams are apart, neither less nor more.
void make_flat(Element& e) {
    const double wide = width(e);
    const double wanted = apart(e);
    set_width(e, wanted);
    if (std::abs(wide - wanted) <= e.tolerances->rounding_mm) return;
    e.repaired("layer-width",
               fmt::format("the piece is {} wide and its seams on the page are {} "
                           "apart, where a layer lies "
                           "flat on the open card; it was made {} wide",
                           mm(wide), mm(wanted), mm(wanted)),
               "make the piece as wide as its seams are apart, or make it a tent");
}

bool constrain(Element& e) {
    const auto stand = [](Element& layer) {
        if (layer.site.mountain) make_even(layer, "mountain fold, which hold it only at the same distance");
        return true;
    };
    if (!constrain_page(e, stand,
                        "there is no paper under both of its seams at the same distance from the fold"))
        return false;
    if (!constrain_piece(e)) return false;
    make_flat(e);
    return constrain_outline(e);
}

void lower(const Element& e, Builder& builder) { two_seams::lower(e, builder, !e.site.mountain); }

}  // namespace

const ElementRow kLayer = {{.name = "layer",
                            .code = -1,
                            .family = "layer",
                            .inverted = false,
                            .glued = true,
                            .about = "a piece glued along two seams beside the "
                                     "fold that lies flat on the open card",
                            .points = kPoints,
                            .partners = kPartners,
                            .grounds = {.seam = true},
                            .parameters = kDrawnHalves,
                            .since = "3.0",
                            .also = kOtherNames,
                            .measures = kMeasures},
                           stands_on,
                           constrain,
                           fold_lines,
                           width,
                           lower,
                           nullptr,
                           measured,
                           [](Element& e, std::span<const double> v) { shape(e, v, v[2]); }};

}  // namespace popup
