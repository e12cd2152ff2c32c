// What would keep two elements from colliding, or from lying on one another: tried out, not guessed.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motion/linkage.h"
#include "motion/plate_shape.h"
#include "popup/motion.h"

namespace popup {

// An element moved along its parent fold, as if its points had been drawn there, by whole hundredths.
struct ElementMove {
    int joint = 0;           // which element
    Vec2 by;                 // mm, on the page of its left driving plate
    std::string_view along;  // what it moves along: "fold"
};

// How many poses of pairs may still be looked at in search of moves: cards differ a thousandfold in what a
// move costs.
struct MoveBudget {
    std::size_t poses = 30'000;
};

// Whether what was tried with plates can be had of the design, as MotionOptions has it; empty: yes.
using MoveTest = std::function<bool(const std::string& element, Vec2 by)>;

// The shortest move, up to 100 mm, of one of two elements after which none of the pairs of plates (one of
// each element) is in contact at any angle, or lies on one another as lying.h says: to 0.02 mm, and where
// plates graze after a shorter one, up to twice as far as it takes to be clear of that. What is moved stays
// on its paper, meets no other plates and lies on none that it does not meet or lie on as it is, and lets
// nothing more stick out of the closed card. Where a third element is in the way, the move goes past it, too.
// None when there is no such move or the budget is used up before one is found. `linkage`: of the assembly;
// `contacts`: all of it as it is; `lies_nowhere`: what is moved may then lie on nothing, nor may what is not,
// if that can be had; `holds` is asked of what passes all this. Cost: that of examining the pairs, and what
// comes near them, a few times, and a glance at some thirty poses for each of a few dozen trials; as often
// again for each third element.
std::optional<ElementMove> freeing_move(const Assembly& assembly, const Linkage& linkage,
                                        std::span<const PlateShape> shapes,
                                        std::span<const std::pair<int, int>> pairs,
                                        std::span<const Contact> contacts, MoveBudget& budget,
                                        const MoveTest& holds = {}, bool lies_nowhere = false);

// All pairs of a plate of one element with one of another.
std::vector<std::pair<int, int>> pairs_between(const Assembly& assembly, int joint, int other);

// The shortest move, to 0.02 mm and up to 100 mm, of an element after which none of its plates sticks out of
// the closed card, and none that did not stick out before; it stays on its paper and meets nothing new. None
// when there is no such move. `before`: what sticks out now. Cost: a few dozen times find_protrusions(), and
// examining what comes near the element.
std::optional<ElementMove> tucking_move(const Assembly& assembly, const Linkage& linkage,
                                        std::span<const PlateShape> shapes, int joint,
                                        std::span<const Protrusion> before, std::span<const Contact> contacts,
                                        MoveBudget& budget, const MoveTest& holds = {});

}  // namespace popup
