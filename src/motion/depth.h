// How deep two plates are in each other.
#pragma once

#include "motion/nearness.h"

namespace popup {

// The shortest way, in mm, by which one of two plates must move square to itself or to the other until at
// most their edges touch. Plates that meet only near a corner or an edge have a way out round it: they are
// shallow, however far they reach beyond each other's planes. 0 when only their edges meet or nothing does,
// and when their planes are parallel.
//
// Cost: corners of both, times their logarithm, times the edges that a line parallel to the planes' common
// line meets.
double depth_mm(const PlateShape& a, const PlateShape& b, const Frame& b_in_a);

}  // namespace popup
