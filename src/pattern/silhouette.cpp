#include "pattern/silhouette.h"

#include <algorithm>

#include "base/geometry/regions.h"

namespace popup {
namespace {

constexpr double kHairMm = 2e-5;

bool is_hair(const Ring& ring) {
    double around = 0.0;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
        around += distance(ring[j], ring[i]);
    return std::abs(signed_area(ring)) <= 0.5 * kHairMm * around;
}

void clean(std::vector<Polygon>& regions) {
    for (Polygon& region : regions) {
        region.outer = tidied(region.outer, 0.5 * kHairMm);
        for (Ring& hole : region.holes) hole = tidied(hole, 0.5 * kHairMm);
        std::erase_if(region.holes, [](const Ring& hole) { return hole.empty() || is_hair(hole); });
    }
    std::erase_if(regions,
                  [](const Polygon& region) { return region.outer.empty() || is_hair(region.outer); });
}

}  // namespace

std::vector<Polygon> silhouette_of(const std::vector<Polygon>& regions) {
    std::vector<Polygon> whole = regions.size() == 1 ? regions : unite(regions);
    if (whole.size() > 1) {
        // Corners that rounding has pushed off a neighbour's edge leave hairs between plates.
        whole = offset(offset(whole, kHairMm, Corners::sharp), -kHairMm, Corners::sharp);
    }
    clean(whole);
    return whole;
}

}  // namespace popup
