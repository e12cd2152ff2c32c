// A first layout: pieces one by one, each where it reaches least far.
#pragma once

#include <vector>

#include "nest/task.h"

namespace popup {

struct Construction {
    Arrangement arrangement;
    std::vector<int> left_out;  // items for which there was no place: they lie over others
    double work = 0.0;          // what it took, in units
    bool alone = false;         // the first of them, a group, had a sheet of its own
    bool hopeless = false;      // for some of them there is no sheet that takes them: they have no stand
};

// Largest pieces first, each on the first sheet that has a place for it: on level lines, a few at the edges
// and `lines` at random heights, the leftmost place, in the turn that reaches least far. New sheets are taken
// from the stock, the largest first, as they are needed. `shake` (0 to 1) disturbs the order.
// Precondition: every item fits on some sheet of the stock, locks are sound.
Construction construct(NestTask& task, Dice& dice, int lines, double shake);

// Places the items on one sheet of this row, around what `arrangement` has there already, or changes nothing.
bool place_on(NestTask& task, Board& board, int sheet, const std::vector<int>& items, Dice& dice, int lines,
              std::vector<int>& turn_of_kind);

}  // namespace popup
