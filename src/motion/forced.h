// Which plates the opening forces: the ways that the closed loops of a linkage leave open.
//
// At one pose, let the drives stand still and ask how plates could move all the same. The velocity of a rigid
// plate is a twist (ω, v). A hinge lets its two plates differ by a turn about its line only: with q a point
// of the line, u its direction and o any point,
//
//     twist_b - twist_a = λ s,   s = (u, u × (o - q)),
//
// and plates glued flat on each other have one twist. Round every closed loop these differences add up to
// nought: six equations Σ ± λ s = 0, the loop closures' Jacobian (J. M. McCarthy and G. S. Soh, Geometric
// Design of Linkages, 2nd ed., 2011, chapter 12). The dimension of its null space is the number of ways in
// which the plates may move, and a plate is forced when its twist is nought in all of the null space.
//
// Solved loop by loop (motion/rates.h), in the order of the hinges, so that what is forced becomes part of
// the ground before what stands on it is looked at: an element on forced ones is a system of three unknowns,
// however many elements stand below it. A rate λ that a loop leaves open stays an unknown until a later loop
// decides it, so a free plate that is bridged later becomes forced.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "popup/motion.h"

namespace popup {

// Sets the frames of all plates at a pose, counted from 0. False: it cannot be reached, and is left out.
using PoseAt = std::function<bool(std::size_t pose, std::span<Frame> frames)>;

// free_plates() of popup/motion.h, at poses that the caller knows: no joint is asked where its plates are.
// Later poses are asked for only when the first leaves plates free. A plate that no joint places is held by
// its hinges and glue alone. Precondition: at each pose the two sides of every hinge lie on each other.
std::vector<FreePlates> free_plates(const Assembly& assembly, std::size_t poses, const PoseAt& pose_at);

}  // namespace popup
