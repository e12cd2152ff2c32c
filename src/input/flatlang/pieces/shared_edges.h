// Where faces meet along edges in space.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "parts/work.h"
#include "popup/geometry.h"

namespace popup::flatlang {

// Points and lines this near to each other, in mm, are one.
inline constexpr double kMeetMm = 0.01;
// Folds and slits shorter than this, in mm, are none.
inline constexpr double kShortestMm = 0.5;

// An edge of a face, in mm.
struct FaceEdge {
    Vec3 from, to;
    int face = 0;
};

// A stretch of a line along which two faces, and no third, have an edge.
struct SharedStretch {
    int a = 0, b = 0;  // a < b
    Vec3 from, to;     // at least kShortestMm apart
    // The face's edge runs from `from` to `to`; else the other way.
    bool along_a = true, along_b = true;
};

// All stretches, by a, then b, then as they lie along their lines. Edges are compared as lines: they need not
// have ends in common. Nullopt when the work left does not do. Cost: near linear where few edges come near
// each other.
std::optional<std::vector<SharedStretch>> find_shared(std::span<const FaceEdge> edges, Work& work);

}  // namespace popup::flatlang
