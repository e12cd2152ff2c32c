// Curves of DXF as paths: arcs, bulges, splines. All in the coordinates of their entity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/path.h"

namespace popup::dxf {

// Continues `path`, which stands at the arc's beginning: centre + cos(t) u + sin(t) v for t, in radians, from
// `from` to `to`, and exactly to `end`. Cubics of 30° at most, which stray from it by less than a
// two-millionth of the radius.
void add_arc(Path& path, Vec2 centre, Vec2 u, Vec2 v, double from, double to, Vec2 end);

// Continues `path` to `to` by the arc of a polyline: `bulge` is the tangent of a quarter of its angle,
// positive where it runs counter-clockwise, 0 of a line.
void add_bulge(Path& path, double bulge, Vec2 to);

// A B-spline, or without controls the curve through points that it was made of.
struct Spline {
    int degree = 3;
    bool closed = false;          // of one through points: it ends smoothly where it begins
    std::vector<double> knots;    // as many as controls, and degree + 1 more
    std::vector<double> weights;  // one a control, or none
    std::vector<Vec2> controls;
    std::vector<Vec2> through;
    std::optional<Vec2> first_way, last_way;  // tangents of one through points
};
inline constexpr int kMostDegree = 25;

// Appends the spline: exactly up to third degree without weights, else within a millionth of its size. One
// through points is the cubic spline of them with chord lengths for parameters, natural at ends without a
// tangent. Returns what is wrong with it, a sentence without its full stop; empty: nothing. Cost: linear in
// controls.
std::string add_spline(const Spline& spline, Path& path);

}  // namespace popup::dxf
