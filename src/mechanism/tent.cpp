// The tent: a piece of its own, glued along two seams parallel to the fold (thesis 5.4.3.5). Its width is the
// author's; its centre fold follows from folding flat.
#include <fmt/format.h>

#include "mechanism/rows.h"
#include "mechanism/silhouette.h"
#include "mechanism/site_lines.h"
#include "mechanism/two_seams.h"

namespace popup {
namespace {

bool constrain(Element& e) {
    if (!two_seams::constrain_page(e) || !two_seams::constrain_piece(e)) return false;
    const double least = two_seams::apart(e);
    const double wide = two_seams::width(e);
    if (wide >= least) return two_seams::constrain_outline(e);
    two_seams::set_width(e, least);
    if (least - wide <= e.tolerances->rounding_mm) return two_seams::constrain_outline(e);
    e.repaired(
        "tent-too-narrow",
        fmt::format("the piece is {} wide and its seams on the page are {} apart, so it would stop the "
                    "card from opening; it was widened to {}",
                    mm(wide), mm(least), mm(least)),
        "make the piece at least as wide as its seams are apart");
    return two_seams::constrain_outline(e);
}

void lower(const Element& e, Builder& builder) { two_seams::lower(e, builder, false); }

}  // namespace

const ElementRow kTent = {{"tent",
                           8,
                           "tent",
                           false,
                           true,
                           "a piece glued along two seams beside the fold",
                           two_seams::kPoints,
                           two_seams::kPartners,
                           {.seam = true},
                           kDrawnHalves},
                          two_seams::stands_on,
                          constrain,
                          two_seams::fold_lines,
                          two_seams::width,
                          lower};

}  // namespace popup
