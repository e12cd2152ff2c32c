// Joints: small bridges in a piece's outer cut, which hold it in its sheet until it is broken out.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/geometry/edge_index.h"
#include "fabrication/shared_lines.h"
#include "popup/geometry.h"

namespace popup {

// One path of a piece's outer cut; the last point of a closed one joins the first.
struct OuterCut {
    std::span<const Vec2> points;
    bool closed = true;
};

struct JointedCuts {
    std::vector<std::vector<PathPart>> parts;  // of each path, in its order
    std::size_t joints = 0;
};

// Leaves gaps of `gap_mm` in the paths of one piece, the middles of which are spread over the length of them
// all: one for each 150 mm, but two at least. Each lies where the path is straight, if it is so anywhere
// near, as far from corners, ends of paths and the lines of `torn` as may be, up to 5 mm, and never nearer
// to them than half a millimetre, nor to another gap than 2 mm. Where there is no such place there are fewer,
// or none. Paths without a gap stay as they are. Cost: near linear in points and in joints.
JointedCuts with_joints(std::span<const OuterCut> paths, double gap_mm, const EdgeIndex& torn);

}  // namespace popup
