// The tent: a piece of its own, glued along two seams parallel to the fold (thesis 5.4.3.5). Its width is the
// author's; its centre fold follows from folding flat.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

// The open card lies flat, and over it stands a triangle on the seams: with the width of the piece W, the
// seams p and q away from the fold and d = p + q, its height is h with (W/d)² = 1 + h²/(pq).
constexpr MeasureInfo kHeight{
    .name = "height", .about = "how high its centre fold stands above the open card", .share = 0.15};
constexpr std::array<MeasureInfo, 10> kMeasures = [] {
    std::array<MeasureInfo, 10> all{};
    std::copy(two_seams::kMeasures.begin(), two_seams::kMeasures.begin() + 4, all.begin());
    all[4] = kHeight;
    std::copy(two_seams::kMeasures.begin() + 4, two_seams::kMeasures.end(), all.begin() + 5);
    return all;
}();

// p q, of measures with width and offset.
double product(double width, double offset) { return 0.25 * width * width - offset * offset; }

std::vector<double> measured(const Element& e) {
    std::vector<double> made = two_seams::measured(e);
    const double ratio = two_seams::width(e) / made[2];
    // Below 0 where the piece is too narrow to let the card open.
    const double square = (ratio * ratio - 1.0) * product(made[2], made[3]);
    made.insert(made.begin() + 4, std::copysign(std::sqrt(std::abs(square)), square));
    return made;
}

void shape(Element& e, std::span<const double> v) {
    std::vector<double> shared(v.begin(), v.end());
    shared.erase(shared.begin() + 4);
    const double square = 1.0 + v[4] * std::abs(v[4]) / product(v[2], v[3]);
    two_seams::shape(e, shared, v[2] * std::sqrt(std::max(0.0, square)));
}

}  // namespace

const ElementRow kTent = {{.name = "tent",
                           .code = 8,
                           .family = "tent",
                           .inverted = false,
                           .glued = true,
                           .about = "a piece glued along two seams beside the fold",
                           .points = two_seams::kPoints,
                           .partners = two_seams::kPartners,
                           .grounds = {.seam = true},
                           .parameters = kDrawnHalves,
                           .measures = kMeasures},
                          two_seams::stands_on,
                          constrain,
                          two_seams::fold_lines,
                          two_seams::width,
                          lower,
                          nullptr,
                          measured,
                          shape};

}  // namespace popup
