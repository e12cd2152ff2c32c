// The steps of one card: cutting and folding, gluing, and how it must open.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "output/book/book.h"

namespace popup::book {

// Its chapters: what is folded, the sub-assemblies, and the card. Steps are numbered through.
// Where no sheet marks what is glued to a back, they say how to find its place.
std::vector<Chapter> chapters_of(const SceneCard& card, std::size_t number, bool backs_are_marked);

// How it must open, what to look at when it does not, and what was found.
void add_opening(const SceneCard& card, std::size_t number, std::span<const Diagnostic> findings,
                 CardPart& part);

}  // namespace popup::book
