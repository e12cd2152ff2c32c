// The files that the original interpreter wrote; for comparison only.
#pragma once

#include <string>
#include <vector>

#include "input/flatlang/turtle/trail.h"

namespace popup::flatlang {

// HP-GL of all polygons, each turned into its own plane, on shelves 12 inches wide; with `part_mode`, in
// place on top of each other. 1016 units an inch, truncated. A polygon whose first three points lie on a line
// is a line, as it was there.
std::string original_hpgl(const Trail& trail, bool part_mode);

// What its PDF held: lines in points (72 an inch) on a page of whole points. Its shelves were 12 points wide,
// with 0.1 between them.
struct OriginalLaser {
    int width = 0, height = 0;
    std::vector<Segment> lines;
};
OriginalLaser original_laser(const Trail& trail, bool part_mode);

}  // namespace popup::flatlang
