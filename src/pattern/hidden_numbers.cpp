#include "pattern/hidden_numbers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "base/geometry/edge_index.h"
#include "base/geometry/laid.h"
#include "base/geometry/regions.h"
#include "base/nth.h"

namespace popup {
namespace {

double angle_of(Vec2 v) { return std::atan2(v.y, v.x); }

Laid laid(const Rigid& how) { return {how.own_at, how.own_dir, how.base_at, how.base_dir, how.back}; }

// The largest text on what of the base's paper the piece covers.
std::optional<TextSpot> spot_on_covered(const Plate& base, const Plate& own, const Rigid& how,
                                        const std::string& text) {
    std::optional<TextSpot> best;
    for (const Polygon& part : intersect({base.outline}, {laid(how)(own.outline)})) {
        const auto spot = place_on_plate(EdgeIndex(edges_of(part), {}), Drawing{}, bounds(part.outer), text);
        if (spot && (!best || spot->height > best->height)) best = spot;
    }
    return best;
}

}  // namespace

HiddenNumbers::HiddenNumbers(const Assembly& assembly)
    : in_(assembly), how_(assembly.plates.size(), nullptr) {
    for (const Joint& joint : assembly.joints) {
        if (const Rigid* how = std::get_if<Rigid>(&joint.how)) nth(how_, how->plate) = how;
    }
}

std::optional<Label> HiddenNumbers::of(const GluedArea& glued, const std::optional<TextSpot>& target) const {
    const Rigid* how = nth(how_, glued.plate);
    if (how == nullptr || how->base != glued.base_plate || how->beside) return std::nullopt;
    std::string number = upright_number(glued.label);
    const std::optional<TextSpot> spot = target ? target
                                                : spot_on_covered(nth(in_.plates, glued.base_plate),
                                                                  nth(in_.plates, glued.plate), *how, number);
    if (!spot) return std::nullopt;
    // From the back the base is seen in a mirror.
    const double turned = spot->angle - angle_of(how->base_dir);
    const double angle = angle_of(how->own_dir) + (how->back ? -turned : turned);
    return Label{LabelKind::piece, std::move(number), laid(*how).inverse()(spot->at), spot->height, angle,
                 !how->behind};
}

}  // namespace popup
