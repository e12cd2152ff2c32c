// The attached plane: a flat piece of any shape glued on a plate, with which it moves (Glassner, section 6).
//
// The line G–H of the piece lies on the line A–B of the plate. What of the piece lies on the plate's paper, 1
// mm away from its folds and edges, is glued, or the area that is given; the rest may stick out of it, and of
// the card.
#include <array>

#include "mechanism/attach.h"
#include "mechanism/rows.h"

namespace popup {
namespace {

enum { A, B };  // of `on`

constexpr std::array<PointInfo, 4> kPoints{{{"A", PointPage::fold, '-'},
                                            {"B", PointPage::fold, '-'},
                                            {"G", PointPage::extra, '-'},
                                            {"H", PointPage::extra, '-'}}};
constexpr std::array<int, 4> kPartners{0, 1, 2, 3};
constexpr std::array<std::string_view, 2> kSides{"front", "back"};
constexpr std::array<ParameterInfo, 4> kParameters{{kAttachedColor,
                                                    kAttachedOutline,
                                                    kAttachedGlue,
                                                    {.name = "side",
                                                     .kind = ParameterKind::choice,
                                                     .about = "on which side of the plate it is glued",
                                                     .words = kSides}}};

Bed bed_of(const Element& e) {
    return {e.site.segment(Side::left, e.on[A], e.on[B]), choice_of(e, "side") == kSides[1],
            [&e](double inset) { return e.paper->paper(Side::left, inset); }};
}

bool constrain(Element& e) {
    const Bed bed = bed_of(e);
    return constrain_line(e, bed, "A–B") && constrain_attached(e, bed);
}

void lower(const Element& e, Builder& builder) { lower_attached(e, bed_of(e), builder, e.site.left_plate); }

}  // namespace

const ElementRow kAttachedPlane = {
    {.name = "attached-plane",
     .code = -1,
     .family = "attached-plane",
     .inverted = false,
     .glued = true,
     .about = "a flat piece of any shape glued on a plate, with which it moves",
     .points = kPoints,
     .partners = kPartners,
     .grounds = {.fold = false, .plate = true},
     .parameters = kParameters,
     .folds = {},
     .since = "3.0"},
    stands_on_no_fold,
    constrain,
    makes_no_folds,
    drawn_from_front,
    lower};

}  // namespace popup
