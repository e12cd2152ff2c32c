// The steps of one card: cutting and folding, and gluing.
#pragma once

#include <cstddef>
#include <vector>

#include "output/book/book.h"

namespace popup::book {

// Its chapters: what is folded, the sub-assemblies, and the card. Steps are numbered through.
// Where no sheet marks what is glued to a back, they say how to find its place.
std::vector<Chapter> chapters_of(const SceneCard& card, std::size_t number, bool backs_are_marked);

}  // namespace popup::book
