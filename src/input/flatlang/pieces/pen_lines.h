// What of a trail was drawn as part of a loop, and what was not.
#pragma once

#include <cstddef>
#include <vector>

#include "input/flatlang/pieces/outlines.h"
#include "input/flatlang/turtle/trail.h"

namespace popup::flatlang {

// Of each segment the face that it is on the outline of; none where it is on no outline.
struct PenLines {
    static constexpr int kOpen = -1;
    std::vector<int> face;  // one a segment
    std::size_t open = 0;   // how many are on none, those without a length not counted
    double open_inches = 0.0;
};

// A segment is on an outline where it is an edge of a loop that has an area, in either direction, also when
// it is drawn again. Preconditions: coordinates are finite; the outlines are the trail's. Cost: near linear.
PenLines sort_segments(const Trail& trail, const Outlines& outlines);

// Lines through these segments of a trail, in mm: those that follow one another are one. `numbers` ascend.
std::vector<std::vector<Vec3>> chained(const Trail& trail, const std::vector<std::size_t>& numbers);

}  // namespace popup::flatlang
