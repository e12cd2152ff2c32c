// The folds of a piece as lines to draw: a curved fold is one line, though the pattern has it in chords.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "popup/pattern.h"
#include "popup/profile.h"

namespace popup {

struct FoldToDraw {
    std::vector<Vec2> points;                   // at least two, of the piece
    std::size_t first = 0;                      // the least number of its lines in PatternPiece::lines
    int plate = -1;                             // -1: its lines are of several
    std::optional<double> fold_angle = {};      // none: not known, or its lines differ
    std::vector<std::vector<Vec2>> parts = {};  // what is scored of it where scores have gaps
};

// The folds and seams of a piece that an operation draws, in the order of their first lines. Lines that meet
// end to end and turn by little are one (folds_of, fabrication/broken_score.h). Machines follow it in one go;
// elsewhere a fold ends where its plate or its angle changes, because sheets are read back with both. Lines
// without a length are left out. Cost: n log n.
std::vector<FoldToDraw> folds_to_draw(const PatternPiece& piece, Operation operation, const Profile& profile);

// The same, with their parts: what broken_score() leaves of them, as one line where it goes over a corner.
std::vector<FoldToDraw> broken_folds(const PatternPiece& piece, Operation operation, const Profile& profile);

}  // namespace popup
