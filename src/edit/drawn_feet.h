// The outline of a drawing, and what of it can be stood on seams.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "popup/path.h"

namespace popup::edit {

// Corners of a drawing that miss ends of seams by no more are meant.
inline constexpr double kMeantMm = 0.5;
// What is no further from the end of a drawing, in shares of its height or width, lies on its edge there.
inline constexpr double kEdgeShare = 0.005;

// A step of a path; of a line from and to are all that counts.
struct DrawnStep {
    Cubic line;
    bool curve = false;
};
using DrawnOutline = std::vector<DrawnStep>;  // it ends where it begins

// A point of an outline: on its n-th step, from its beginning (0) to its end (1).
struct OutlineMark {
    std::size_t step = 0;
    double t = 0.0;
    Vec2 at;
};
// What becomes glue: the outline from the first to the last of them.
struct Foot {
    OutlineMark begin, end;
};

// An affine map of the plane.
struct PlaneMap {
    Vec2 x{1.0, 0.0}, y{0.0, 1.0}, origin;
    Vec2 operator()(Vec2 p) const { return p.x * x + p.y * y + origin; }
};
// Turns a–b into the direction of p–q and puts its middle on theirs, `scale` times as large. Precondition:
// neither a–b nor p–q is a point.
PlaneMap onto(Vec2 a, Vec2 b, Vec2 p, Vec2 q, double scale);

DrawnOutline outline_of(const Subpath& line);
DrawnOutline reversed(const DrawnOutline& outline);
DrawnOutline mapped(const DrawnOutline& outline, const std::function<Vec2(Vec2)>& map);
Box box_of(const DrawnOutline& outline);      // of all its points, not of its corners and controls
double area_of(const DrawnOutline& outline);  // positive when it runs counter-clockwise
// The steps from one mark to another, in the outline's direction; all round from a mark to itself.
DrawnOutline between(const DrawnOutline& outline, const OutlineMark& from, const OutlineMark& to);
// How far a foot goes above the line through its ends, seen with the first end on the left, and below it.
std::pair<double, double> strays(const DrawnOutline& outline, const Foot& foot);

// Feet of outlines that run counter-clockwise, with y up, `box` their box.
// Three corners with straight lines between them that lie as the chain does, once they are as large; or a
// wide V at the lower end, whose lines the chain takes the place of. A line may have any number of points, no
// further from it than `within`.
std::optional<Foot> corner_of(const DrawnOutline& outline, const Box& box, std::span<const Vec2> chain,
                              double within);
// The straight edge at the lower end: what lies there from the left to the right, no more than `within` above
// the lowest point.
std::optional<Foot> base_of(const DrawnOutline& outline, const Box& box, double within);
// Where a drawing that is round below is cut, so that it stands: if possible where it has no gap.
std::optional<Foot> cut_of(const DrawnOutline& outline, const Box& box);
// The straight edge at the left end, from above to below; at the right end, from below to above; each no more
// than `within` beside the outermost point.
std::optional<Foot> left_edge(const DrawnOutline& outline, double within);
std::optional<Foot> right_edge(const DrawnOutline& outline, double within);
// How far what the chain takes the place of reaches beyond it: what is lost of the drawing. The chain runs
// as the outline does.
double lost_beyond(const DrawnOutline& outline, const Foot& foot, std::span<const Vec2> chain);

}  // namespace popup::edit
