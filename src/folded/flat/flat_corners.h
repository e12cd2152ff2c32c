// What an inner corner of a crease pattern must be for the paper round it to fold flat.
#pragma once

#include <cstddef>

#include "folded/sheet.h"
#include "popup/diagnostics.h"

namespace popup::folded {

// How far the angles round a corner may be off Kawasaki's condition, in degrees, and still be meant so.
inline constexpr double kKawasakiOffDeg = 0.1;

struct FlatCorner {
    std::size_t folds = 0;
    // Kawasaki: of the angles between the folds, taken in turn, every other one adds up to 180°. Of an odd
    // number of folds, and where a fold passes through: 180.
    double every_other_deg = 180.0;
    // Maekawa: mountains and valleys differ in number by two. `open` may be either.
    int mountains = 0, valleys = 0, open = 0;

    [[nodiscard]] bool even() const { return folds % 2 == 0; }
    [[nodiscard]] bool angles_fit() const;
    [[nodiscard]] bool kinds_fit() const;
};

// Precondition: `loop` goes round a corner.
FlatCorner flat_corner(const Sheet& sheet, const Loop& loop);

// Whether all inner corners, of which there is one at least, are such: needed for the sheet to fold flat, and
// not enough. Cost: near linear in the folds.
bool corners_fold_flat(const Sheet& sheet);

// Names --flat in the hint of a finding on a sheet whose corners are such.
void ask_flat(const Sheet& sheet, Diagnostic& told);

}  // namespace popup::folded
