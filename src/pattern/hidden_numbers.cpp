#include "pattern/hidden_numbers.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/nth.h"

namespace popup {
namespace {

double angle_of(Vec2 v) { return std::atan2(v.y, v.x); }

// From the back the base is seen in a mirror.
double side_of(const Rigid& how) { return how.back ? -1.0 : 1.0; }

Vec2 own_of(const Rigid& how, Vec2 on_base) {
    const Vec2 off = on_base - how.base_at;
    return how.own_at + dot(off, how.base_dir) * how.own_dir +
           side_of(how) * cross(how.base_dir, off) * left_of(how.own_dir);
}
Vec2 base_of(const Rigid& how, Vec2 own) {
    const Vec2 off = own - how.own_at;
    return how.base_at + dot(off, how.own_dir) * how.base_dir +
           side_of(how) * cross(how.own_dir, off) * left_of(how.base_dir);
}

// The largest text on what of the base's paper the piece covers.
std::optional<TextSpot> spot_on_covered(const Plate& base, const Plate& own, const Rigid& how,
                                        const std::string& text) {
    Polygon piece;
    for (const Vec2 p : own.outline.outer) piece.outer.push_back(base_of(how, p));
    for (const Ring& hole : own.outline.holes) {
        Ring& made = piece.holes.emplace_back();
        for (const Vec2 p : hole) made.push_back(base_of(how, p));
    }
    std::optional<TextSpot> best;
    for (const Polygon& part : intersect({base.outline}, {piece})) {
        const auto spot = place_on_plate(EdgeIndex(edges_of(part), {}), Drawing{EdgeIndex({}, {}), 0.0},
                                         bounds(part.outer), text);
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
    const std::optional<TextSpot> spot =
        target ? target
               : spot_on_covered(nth(in_.plates, glued.base_plate), nth(in_.plates, glued.plate), *how,
                                 glued.label);
    if (!spot) return std::nullopt;
    const double angle = angle_of(how->own_dir) + side_of(*how) * (spot->angle - angle_of(how->base_dir));
    return Label{LabelKind::piece, glued.label, own_of(*how, spot->at), spot->height, angle, !how->behind};
}

}  // namespace popup
