// How a card must open, or a folded sheet look: the last page of the steps.
#pragma once

#include <cstddef>
#include <span>

#include "output/book/book.h"

namespace popup::book {

// How it must open, what to look at when it does not, and what was found.
void add_opening(const SceneCard& card, std::size_t number, std::span<const Diagnostic> findings,
                 CardPart& part);

}  // namespace popup::book
