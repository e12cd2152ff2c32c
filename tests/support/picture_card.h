// A card of 40 pieces of all glued kinds with ten pictures, to see what such a card costs.
#pragma once

#include <string>

#include "popup/compile.h"

namespace popup::test {

inline constexpr int kCardPieces = 40;
inline constexpr int kCardPictures = 10;

// The card as a document: five groups along the gutter of a layer with an attached plane on it, a v-fold, a
// box, a floating layer, a tent, a pivot and a disc, with drawn outlines, holes, texts and areas. Its
// pictures are "1.png" to "10.png": two cover the pages, three each are on layers and, levelled to one
// horizon, on v-folds, and two more on v-folds as they are. Nothing of it collides, and `check` has remarks
// alone: of the discs and floating layers, which the opening does not force.
std::string picture_card();

// The files of its pictures, of 400 × 300 pixels: numbers from 1.
std::string card_picture(int number);

// A compile of it that finds its pictures in memory, each drawn once a process; its sheets are a press's, of
// 1000 × 700 mm.
CompileOptions picture_card_options();

}  // namespace popup::test
