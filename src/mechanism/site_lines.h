// Angles and crossings of an element's lines, in site and page coordinates, and numbers in messages.
#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mechanism/site.h"

namespace popup {

constexpr double kDegree = std::numbers::pi / 180.0;

inline Side other(Side side) { return side == Side::left ? Side::right : Side::left; }

// Angle between the direction `dir` (+1 or -1) along the fold and the line from the apex to p; in (0, π) for
// w > 0.
double angle_at(double apex_s, int dir, SitePoint p);
// p turned about the apex so that its angle_at becomes `angle`, at the same distance.
SitePoint at_angle(double apex_s, int dir, SitePoint p, double angle);
// Where the line from l (left of the fold) to r (right of it) crosses the fold.
double crossing(SitePoint l, SitePoint r);
// The point of the line l–r whose distance from the fold, on l's side, is w (negative: beyond the fold).
SitePoint along_cut(SitePoint l, SitePoint r, double w);

// Where segments a and b cross properly, if they do.
std::optional<Vec2> proper_crossing(const Segment& a, const Segment& b);
// The first self-crossing of a ring of a few points, in words ("G–I crosses E–H at (1.00, 2.00) mm"); empty:
// none.
std::string self_crossing(const Ring& ring, std::span<const std::string_view> letters);

// "12.34 mm", "5.67°", "(1.20, 3.40) mm"; never "-0.00".
std::string at_mm(Vec2 p);
std::string mm(double value);
std::string degrees(double radians);

}  // namespace popup
