// Plates of a folded sheet that lie on one another while it stands still, and on which side of each other.
//
// Plates without thickness that lie in one plane have no sides there: which is the inner one is only said by
// the way on which they came, or by what a box is made like.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "motion/plate_shape.h"
#include "popup/assembly.h"

namespace popup {

// Two plates that lie on one another.
struct Touching {
    Vec2 of_a, of_b;      // a place where they do, on the page of either: the middle of what they share
    int side = 0;         // of a on which b is: 1 before its front, -1 behind it, 0 not known
    bool wished = false;  // the side is what the box is made like, and nothing has come there yet
};
// By pair, the smaller number first.
using TouchingPlates = std::map<std::pair<int, int>, Touching>;

// Which side of a the point of b is on that touches it, and of b the point of a; 0: neither for certain, or
// they are no longer before one another.
int side_of(const PlateShape& a, const PlateShape& b, const Frame& b_in_a, Vec2 of_a, Vec2 of_b);

using PlateFrames = std::vector<Frame>;  // by plate; empty: the joints do not get there
// At a share of the sweep.
PlateFrames frames_at(const Assembly& assembly, double share);

// Pairs that lie in one plane to 0.02 mm and share more than a square millimetre of it, but for those that
// share a fold, which keeps them apart. Their sides are not known. Cost: n log n in plates, and in pairs that
// are near each other.
TouchingPlates touching_plates(const Assembly& assembly, std::span<const PlateShape> shapes,
                               std::span<const Frame> frames);

// Whether what touches when the sweep begins leaves to the sides that it is on, as far as these are known.
bool leave_to_their_sides(const Assembly& assembly, std::span<const PlateShape> shapes,
                          const TouchingPlates& touching);
// What touches when the sweep ends, from what touches when it begins: on the sides on which it came, or where
// it has lain all the way on those that it has.
TouchingPlates touching_at_end(const Assembly& assembly, std::span<const PlateShape> shapes,
                               const TouchingPlates& touching);

// Gives those of a closed box the sides on which a box has them: the smaller plate lies on the side of the
// larger that looks to the middle of all panels. What lies on a wall that is folded in over itself lies
// between the two. Plates as large as each other, and a plane that goes through that middle, say nothing.
void wish_sides(const Assembly& assembly, std::span<const Frame> frames, TouchingPlates& touching);

}  // namespace popup
