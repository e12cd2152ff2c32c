// The files that the original interpreter wrote, as texts; for comparison only.
#pragma once

#include <string>

#include "input/flatlang/trail.h"

namespace popup::flatlang {

// HP-GL of all polygons, each turned into its own plane, on shelves 12 inches wide; with `part_mode`, in
// place on top of each other. 1016 units an inch, truncated. A polygon whose first three points lie on a line
// is a line, as it was there.
std::string original_hpgl(const Trail& trail, bool part_mode);

}  // namespace popup::flatlang
