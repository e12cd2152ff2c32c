// A crease pattern as panels, the folds between them, and the loops that these make.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/geometry/sheet_graph.h"
#include "popup/crease_pattern.h"

namespace popup::folded {

// A stretch of a line between two corners of the sheet.
struct Stretch {
    int a = 0, b = 0;
};

// All stretches of one line between the same two panels: they are folded together.
struct Fold {
    int left = 0, right = 0;         // panels, seen along the stretches
    std::vector<Stretch> stretches;  // along the line, all in one direction; at least one
    unsigned ink = kFold;            // of Ink: what the pattern says which way it is folded
    double target = 0.0;             // how far in the end, radians; positive for valleys. 0: not known
    int line = 0;                    // of the pattern: the first that drew it; of bends one of its panel
    [[nodiscard]] bool is_bend() const { return ink == kBend; }
};

// One fold on the way around a loop.
struct Step {
    int fold = 0;
    double sign = 1.0;  // 1: from its right panel to its left one
};

// A way from panel to panel that comes back to where it began: around an inner corner, or around a hole.
struct Loop {
    std::vector<Step> steps;  // at least one
    Vec2 at;                  // the corner; the middle of the hole
    int corner_number = -1;   // of the sheet, where `corner` is true
    double size = 0.0;        // of what the folds reach, mm; > 0
    bool corner = false;      // all folds meet in `at`: only turns need to add up
    int line = 0;             // of the pattern: what drew it
};

struct Panel {
    std::vector<int> outer;               // corners, counter-clockwise
    std::vector<std::vector<int>> holes;  // clockwise
    int piece = 0;
};

struct Sheet {
    std::vector<Vec2> corners;
    std::vector<Panel> panels;
    std::vector<Fold> folds;
    std::vector<Loop> loops;
    std::vector<std::vector<Stretch>> cuts;  // by piece: its edges, slits included

    // The longer side of what is drawn, mm; > 0.
    [[nodiscard]] double size() const;
    [[nodiscard]] Vec2 at(int corner) const { return corners[static_cast<std::size_t>(corner)]; }
    [[nodiscard]] Segment segment(Stretch stretch) const { return {at(stretch.a), at(stretch.b)}; }
    // The stretches of a fold, those that meet as one.
    [[nodiscard]] std::vector<Segment> stretches_of(const Fold& fold) const;
    // The line of a fold, from its first corner to its last.
    [[nodiscard]] Segment line_of(const Fold& fold) const {
        return {at(fold.stretches.front().a), at(fold.stretches.back().b)};
    }
    // Whether panels are divided by bends.
    [[nodiscard]] bool bends() const;
    // Without corners at which nothing turns.
    [[nodiscard]] Polygon outline_of(const Panel& panel) const;
};

// Stretches between the same two panels are one fold where they lie on a line to this share of the sheet, but
// at least to kSilentMm.
inline constexpr double kOneLine = 1e-4;

// Mends the lines within the tolerances, finds panels, holes, pieces, folds and loops. Findings as
// fold_sheet() has them. Cost: near linear in lines and crossings.
//
// `bends` divide panels further: each leads from corner to corner of a panel, without crossing another;
// corners are numbered as in the sheet without them. They become folds whose ink is kBend alone and whose
// target is 0.
std::optional<Sheet> make_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                Diagnostics& diagnostics, std::span<const Stretch> bends = {});

}  // namespace popup::folded
