// What no layout can do better than: pieces that cannot share a sheet, and how short the last one gets.
#pragma once

#include <vector>

#include "nest/task.h"

namespace popup {

// Whether, wherever a piece of kind `a` and one of kind `b` stand on a sheet of the stock, a part of one
// overlaps one of the other. A no may be wrong (see `covers`).
bool must_part(NestTask& task, int a, int b);

// Whether the sheets of `layout` but one could hold the area of the pieces and of the spacing between them,
// which sticks out of the sheet by half, and there are not as many pieces as sheets that must part.
bool could_be_fewer(NestTask& task, const Arrangement& layout);

// Of each item, whether it is known to lie on the last sheet of every layout on these rows whose last sheet
// is shorter than that of `layout`: 1 if so. Of pieces too wide for it, no two of which share a sheet, there
// are as many as other sheets, and it shares none with them. A page that takes a sheet of its own is the
// usual case. All 0 where there are locks, or more than some hundred items.
std::vector<char> known_last(NestTask& task, const Arrangement& layout);

// How short the last of sheets of these rows is at the least, in steps: its share of the area, and the widest
// piece that lies on no other. `on_last` comes from known_last(), or is empty.
double least_length(const NestTask& task, const std::vector<int>& rows, const std::vector<char>& on_last);

}  // namespace popup
