// The steps of a folded sheet: which panels are folded after one another, and what is glued between.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "output/book/book.h"

namespace popup::book {

// The chapters of a sheet whose folding is known (folding_steps() is not empty): one a piece that is folded,
// its steps those of folding_steps(), in their order. Creases that end flat are told of in the first step of
// their piece, and flaps are glued after the step that lays them down. `number` is the card's in the run;
// steps are numbered from steps + 1 on, and `steps` is the last one's number then.
std::vector<Chapter> sheet_chapters(const SceneCard& card, std::size_t number, int& steps);

// "Score the folds between a and b, c and d, fold them once, and open them again: they stay flat when it
// stands." Empty: the piece has no creases that end flat.
std::string flat_creases(const Assembly& assembly, int piece);

}  // namespace popup::book
