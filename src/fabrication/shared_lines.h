// Lines that lie on others, found and taken away, so that no machine follows a line twice.
#pragma once

#include <span>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/tolerances.h"
#include "popup/geometry.h"

namespace popup {

// What is left of a path.
struct PathPart {
    std::vector<Vec2> points;
    bool closed = false;
};

// Takes paths one after the other, and gives of each what lies on none before it, nor on itself.
class SharedLines {
 public:
    // Nothing, when all of it lies on earlier ones; the path itself, when nothing does; else open parts, in
    // its order. Where it runs back on itself, what it drew first stays. Cost: near linear in segments, where
    // few lie on others.
    std::vector<PathPart> left_of(std::span<const Vec2> points, bool closed);

 private:
    EdgeIndex taken_;
};

}  // namespace popup
