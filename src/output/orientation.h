// How what a model shows stands: as its author says, or as it is guessed to be meant.
#pragma once

#include <span>
#include <vector>

#include "popup/assembly.h"
#include "popup/output.h"

namespace popup {

struct Stance {
    Orientation orientation = Orientation::flat;  // never `guessed`
    bool is_guessed = true;
};

// What the assembly says; else, from its plates where models rest (rest_of()):
//
// * a card with at least three fifths of the paper that rises from it parallel to one of its pages, as steps
//   and boxes are, is a stage. What is glued flat on a page does not rise from it;
// * a card from which nothing rises stands upright;
// * other cards lie flat, even those that open to 90° alone: what rises from them is seen from above else. So
//   do folded sheets and what nothing moves, in whose drawings z is up.
//
// Only what has two covers can be a stage, and what nothing moves lies flat whatever it says. Cost: one
// placing of the plates.
Stance stance_of(const Assembly& assembly);
std::vector<Stance> stances_of(std::span<const SceneCard> cards);

// Turns all plates of a card to where whoever looks at the scene finds them: x to the right, y away, z up. A
// stage turns with its ground, the last of the covers; the others turn alike at all openings. A folded sheet
// settles.
void stand(Orientation orientation, const Assembly& assembly, std::span<Frame> frames);

// Moves each part of a folded sheet that hangs together up or down until it stands on the ground, z = 0. So
// what is half folded floats at no opening, and as it moves the ground stays where it is. Nothing else is
// moved. Cost: linear in corners.
void settle(const Assembly& assembly, std::span<Frame> frames);

// At which opening the cards are seen best, in pictures, in the viewer, and where models rest: as rest_of()
// has it, and 130° open, or as far as they get, where all cards lie flat.
double best_opening(std::span<const SceneCard> cards, std::span<const Stance> stances);

}  // namespace popup
