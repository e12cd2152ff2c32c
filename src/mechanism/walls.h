// Walls that stand upright on a fold's two planes, in their bisector: what the box and the floating layer
// share. On the fold's page A B is the foot of the left wall, E F that of the right one: two_seams.h.
#pragma once

#include "mechanism/element.h"

namespace popup::walls {

// The points, and what they are called.
inline constexpr std::array<PointInfo, 4> kPoints{{{"A", PointPage::fold, 'L'},
                                                   {"B", PointPage::fold, 'L'},
                                                   {"E", PointPage::fold, 'R'},
                                                   {"F", PointPage::fold, 'R'}}};
inline constexpr std::array<int, 4> kPartners{2, 3, 0, 1};

inline constexpr ParameterInfo kHeight{.name = "height",
                                       .kind = ParameterKind::length,
                                       .about = "height of its walls on the open card",
                                       .required = true,
                                       .least = 1.0,
                                       .most = 1000.0};

// Both feet on paper for certain: nothing of them is left to be mended.
bool feet_fit(const Element& e);

// A wall on its side of the fold. `foot` is a point of its foot, own_at the same on its own page; there
// own_along runs along the fold and own_across up. Its plate is for the caller to fill in.
Upright upright(const Site& site, Side side, SitePoint foot, Vec2 own_at, Vec2 own_along, Vec2 own_across);

// A foot's line on the page of its side, along the fold.
Segment foot_line(const Element& e, Side side, double from, double to);

}  // namespace popup::walls
