// The steps of one card: cutting and folding, gluing, and how it must open.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "output/book/book.h"

namespace popup::book {

// Its chapters: what is folded, the sub-assemblies, and the card. Steps are numbered through.
std::vector<Chapter> chapters_of(const SceneCard& card, std::size_t number);

// How it must open, what to look at when it does not, and what was found.
void add_opening(const SceneCard& card, std::size_t number, std::span<const Diagnostic> findings,
                 CardPart& part);

}  // namespace popup::book
