// What would keep two elements from colliding: tried out, not guessed.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "motion/linkage.h"
#include "motion/plate_shape.h"
#include "popup/motion.h"

namespace popup {

// An element moved along its parent fold, as if its points had been drawn there. Whether there is paper at
// the new place is not looked at.
struct Move {
    int joint = 0;           // which element
    Vec2 by;                 // mm, on the page of its left driving plate
    std::string_view along;  // what it moves along: "fold"
};

// How many poses of pairs may still be looked at in search of moves: cards differ a thousandfold in what a
// move costs.
struct MoveBudget {
    std::size_t poses = 30'000;
};

// The shortest move, to 0.02 mm and up to 100 mm, of one of two elements after which none of the pairs of
// plates (one of each element) is in contact at any angle, or lies on one another as lying.h says; none when
// there is no such move or the budget is used up before one is found. `linkage`: of the assembly. Cost: a few
// dozen times that of examining the pairs.
std::optional<Move> freeing_move(const Assembly& assembly, const Linkage& linkage,
                                 std::span<const PlateShape> shapes,
                                 std::span<const std::pair<int, int>> pairs, MoveBudget& budget);

// The shortest move, to 0.02 mm and up to 100 mm, of an element after which none of its plates sticks out of
// the closed card, and none that did not stick out before; none when there is no such move. `before`: what
// sticks out now. Cost: a few dozen times find_protrusions().
std::optional<Move> tucking_move(const Assembly& assembly, const Linkage& linkage, int joint,
                                 std::span<const Protrusion> before);

}  // namespace popup
