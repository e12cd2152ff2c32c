// The steps of a folded sheet: which panels are folded after one another, and what is glued between.
#pragma once

#include <cstddef>
#include <vector>

#include "output/book/book.h"

namespace popup::book {

// The chapters of a sheet whose folding is known (folding_steps() is not empty): one a piece that is folded,
// its steps those of folding_steps(), in their order. Flaps are glued after the step that lays them down.
// `number` is the card's in the run; steps are numbered from steps + 1 on, and `steps` is the last one's
// number then.
std::vector<Chapter> sheet_chapters(const SceneCard& card, std::size_t number, int& steps);

}  // namespace popup::book
