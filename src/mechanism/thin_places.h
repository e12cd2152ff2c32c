// Where paper is so thin that it tears, or hangs on a point.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "mechanism/element.h"

namespace popup {

// Paper narrower than this tears where it is cut, and a laser burns it away.
inline constexpr double kTearsMm = 0.5;

// Less cannot be held between two fingers.
inline constexpr double kLeastPaperMm2 = 4.0;

// Whether edges of these areas that are no neighbours touch each other, up to the grid. Cost: near linear.
bool touching(const std::vector<Polygon>& areas);

// Points of two segments, each an end of one and what is nearest to it on the other: of segments that are
// apart two of these are as near as the segments are.
std::array<std::pair<Vec2, Vec2>, 4> end_spots(const Segment& one, const Segment& two);

struct NarrowPlace {
    Vec2 at;  // its middle
    double width_mm = 0.0;
    bool at_hole = false;  // between a hole and an edge or another hole; else parts hang together there
};
// The narrowest place of a piece below `below` mm: a neck with at least 4 mm² of paper on both of its sides,
// or the paper beside a hole. The tips of corners are none. Straight edges are looked at at their ends. Cost:
// near linear in edges, for drawings whose edges lie apart.
std::optional<NarrowPlace> thinnest(const Polygon& piece, double below);

// Warns of the narrowest place of a drawn piece below kTearsMm (`paper-too-thin`).
void tell_thin(Element& e, const Polygon& piece);

// Warns of what is left between a hole and another, so wide, below kTearsMm, at `at` (likewise).
void tell_thin_between_holes(Element& e, Vec2 at, double width_mm);

}  // namespace popup
