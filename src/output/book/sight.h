// What of a folded or glued model is seen from where.
#pragma once

#include <span>
#include <vector>

#include "popup/assembly.h"
#include "popup/geometry.h"

namespace popup::book {

// Plates as they are placed, and how far each is washed out; below 0 it is not there.
struct Placed {
    const Assembly& assembly;
    std::span<const Frame> frames;
    std::span<const float> fades;
};

// Whether one of the plates that are there stands between a point and the eye. Those that the point lies in
// do not. Cost: that of a look at each plate.
bool is_hidden(const Placed& placed, Vec3 from, Vec3 eye);

// Of these directions to the eye, none of them upright, the first from which the most of the points are seen.
// Precondition: there is one.
Vec3 best_eye(const Placed& placed, std::span<const Vec3> points, std::span<const Vec3> eyes);

// Plates, ascending, that hide one of the points from that direction.
std::vector<int> hiding(const Placed& placed, std::span<const Vec3> points, Vec3 eye);

}  // namespace popup::book
