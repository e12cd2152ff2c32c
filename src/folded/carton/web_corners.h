// Corners of trays that are closed by a web: between two walls the sheet goes on, and a diagonal folds it in
// half.
#pragma once

#include <array>
#include <vector>

#include "folded/sheet.h"

namespace popup::folded {

// Five folds around an inner corner, four of one kind and the diagonal of the other, between two walls that
// are square there and the equal halves of the web.
struct WebCorner {
    int loop = 0;                // of the sheet
    std::array<int, 2> walls{};  // folds between the base and the walls, which go to a right angle
    std::array<int, 2> webs{};   // folds between the walls and the halves of the web
    int diagonal = 0;
    // How far `webs` go so that the walls meet, radians in (0, π): the web stands inside then, folded flat,
    // and halves the angle between them.
    double web_angle = 0.0;
};

// Cost: linear in loops.
std::vector<WebCorner> find_web_corners(const Sheet& sheet);

// Folds of web corners for which neither the pattern nor the options say how far they go: diagonals go to
// half a turn, and those beside them as far as it takes. All of a corner stay as they are if one of them is
// said to go otherwise. Told: the remark `web-corners`.
void fold_web_corners(const CreasePattern& pattern, const FoldOptions& options, Sheet& sheet,
                      Diagnostics& diagnostics);

}  // namespace popup::folded
