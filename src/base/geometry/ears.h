// Rings of few corners as triangles, quickly.
#pragma once

#include <optional>

#include "base/geometry/triangulate.h"

namespace popup {

// Triangles of a polygon without holes, by cutting off ears: what triangulate() promises, and corners in the
// ring's order; round and round, so that few of them are long. Each triangle is what the ring goes round
// before it and does not after it, so that those that turn counter-clockwise cover a ring that does not cross
// itself, each place once, whichever are cut off. nullopt: it has holes, more than 200 corners, no ear is
// found where it touches itself, or the triangles do not add up to it; triangulate() knows. Cost: corners
// times those that point inwards, at worst times corners again.
std::optional<Triangulation> clip_ears(const Polygon& polygon);
// The same where it can be done, which is most often and takes a tenth of the time; else triangulate().
Triangulation quick_triangles(const Polygon& polygon);

}  // namespace popup
