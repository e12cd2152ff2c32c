// What the angled elements (beak, angled step, v-fold) share: an apex on the fold and two sides that open
// from it.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>

#include "mechanism/element.h"

namespace popup {

// Projects the apex onto the fold; a repair where it was off by more than rounding. False, after failed(),
// when the fold is not there.
bool put_apex_on_fold(Element& element, std::size_t point, std::string_view letter);

// Reports that a side is too short or too flat. Always false.
bool angled_degenerate(Element& element, std::string_view line, double size, double angle);

// Turns the sides in alike until they open by at most `limit_deg` about the apex; a repair. The last index of
// each list gives the side's angle. False after failed().
bool close_opening(Element& element, double apex_s, int dir, std::initializer_list<std::size_t> left,
                   std::initializer_list<std::size_t> right, double limit_deg);

constexpr double kWidestSlit = 175.0;  // degrees: the bisector of the sides vanishes at 180°
// True when the sides through `left` and `right` open by no more than that.
bool opens_within(const Element& element, double apex_s, int dir, std::size_t left, std::size_t right);

// The centre fold of a beak or angled step on the flat page: g = b, h = a.
struct SlitCentre {
    Vec2 at;   // the apex
    Vec2 dir;  // unit
    // Where it meets the segment p–q.
    [[nodiscard]] std::optional<Vec2> meet(Vec2 p, Vec2 q) const;
};
SlitCentre slit_centre(const Site& site, double apex_s, int dir, SitePoint left, SitePoint right);

}  // namespace popup
