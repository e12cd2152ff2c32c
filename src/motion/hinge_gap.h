// How far a fold or seam is open.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "popup/assembly.h"

namespace popup {

// The larger distance between the two images of one of its ends, mm.
inline double gap_of(const Hinge& hinge, std::span<const Frame> frames) {
    const Frame& a = frames[static_cast<std::size_t>(hinge.a)];
    const Frame& b = frames[static_cast<std::size_t>(hinge.b)];
    return std::max(distance(a.point(hinge.a_line.a), b.point(hinge.b_line.a)),
                    distance(a.point(hinge.a_line.b), b.point(hinge.b_line.b)));
}

}  // namespace popup
