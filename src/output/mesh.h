// A plate as flat triangles: its paper, and what is drawn on it.
#pragma once

#include <cstdint>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// Triangles of one colour in the plane of the plate, counter-clockwise seen from the front.
struct MeshPart {
    Color color;
    bool drawn = false;        // a drawn line, which lies on the paper's front; else the paper
    std::vector<Vec2> points;  // mm from the plate's pivot
    std::vector<std::uint32_t> indices;
};

// The paper first (white where the plate has no fill), then its drawn lines, one part a colour in the order
// of their first use: each line as wide as it is drawn, with round ends and corners, cut off at the plate's
// outline. Where lines of several colours cross, only the last is there, so that no two parts overlap; plates
// with more than fifty crossings a line are left as they are. Parts without triangles are left out. Cost:
// near linear in the corners of the outline and of the lines, times the colours of lines at the outline.
std::vector<MeshPart> plate_mesh(const Plate& plate);

}  // namespace popup
