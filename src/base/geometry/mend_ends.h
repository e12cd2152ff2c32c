// Ends of lines that miss what they mean to meet.
#pragma once

#include <optional>
#include <vector>

#include "base/geometry/sheet_graph.h"

namespace popup {

// Ends are moved by no more than this, in mm, unless the caller says otherwise.
inline constexpr double kSnapMm = 0.5;
// Of moves up to this, in mm, nothing needs to be said: it is the rounding of a drawing.
inline constexpr double kSilentMm = 0.02;

struct EndTolerances {
    double snap_mm = kSnapMm;  // at least kSilentMm
    double one_point_mm = kOnePointMm;
    // Three and more ends of folds within snap_mm of each other, with no cut there, are one point.
    bool gathers_folds = false;
};

// An end of a line that was moved.
struct MovedEnd {
    int line = 0;
    bool last = false;  // of its ends
    Vec2 from, to;
};

// Moves ends that lie at no other line: two loose ends to where their lines meet, one end along its line to
// what it stops short of or runs over, else to what is nearest. Returns the graph of the lines, and appends
// the ends that moved, by line; nullopt when there are more crossings, or more that lies beside ends, than a
// drawing has.
//
//     std::vector<MovedEnd> moved;
//     const auto graph = mend_ends(lines, {}, moved);
std::optional<SheetGraph> mend_ends(std::vector<SheetLine>& lines, const EndTolerances& tolerances,
                                    std::vector<MovedEnd>& moved);

}  // namespace popup
