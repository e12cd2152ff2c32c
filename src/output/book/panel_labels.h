// The names of panels or pieces on a drawing of a book: where each has room, and numbers in place of the
// others.
#pragma once

#include <string>

#include "output/book/figure.h"

namespace popup::book {

// So that no label of the drawing lies on another, however it is shown on a page of a book: a name that is
// wider than its room, or has none, becomes its brief, and without a brief a number, which goes to the first
// of its places that is free; beside briefs, which are numbers of pieces, and where only letters are wanted,
// it becomes a letter. Short names come first; one that leaves a number no place becomes a number, too. What
// still has no place is left out. Returns what the numbers are, such as "In the drawing: 1 = lid-ear, 2 =
// l-15."; empty: there are none. The same names at the same places have the same numbers. Cost: labels
// squared, and so again for each name that gives way.
std::string settle_labels(Figure& figure);

}  // namespace popup::book
