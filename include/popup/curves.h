// Which chords of polygons stand for curves, so that writers can draw the curves again.
//
// Geometry is polygons at one tolerance: nothing between a reader and a writer knows of curves. Whoever makes
// chords of a curve notes their ends here, and the table travels beside the geometry. Corners that booleans,
// chaining and turning have left where they were are found again by where they are; what was cut, moved or
// made anew is not, and stays straight. A table need not be told of any of this.
//
//   CurveTable table(flat.curves);                             // of flatten(), popup/path.h
//   std::vector<Polygon> left = subtract({outline}, {window});
//   for (const CurveStep& step : table.restored(left[0].outer, true).steps) …
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "popup/geometry.h"
#include "popup/path.h"

namespace popup {

// From the corner where the step before ended to the corner of number `to`.
struct CurveStep {
    std::size_t to = 0;
    bool curve = false;
    Vec2 control_1, control_2;  // of a curve
};

// A polygon with its curves. Closed: the last step ends at corner `start`.
struct Restored {
    std::size_t start = 0;
    std::vector<CurveStep> steps;  // none: no part of it was a curve
};

class CurveTable {
 public:
    CurveTable() = default;
    explicit CurveTable(const std::vector<FlatCurve>& curves);

    [[nodiscard]] bool empty() const { return corners_.empty(); }
    [[nodiscard]] std::size_t size() const { return cubics_.size(); }  // how many curves it knows
    // What it knows: a table made of it knows the same. Corners of a curve are sorted by t, then by where
    // they are. Precondition: it was not scaled.
    [[nodiscard]] std::vector<FlatCurve> curves() const;

    // Corners at `a` of a segment have been moved to its `b`: there the curves are to be found, too.
    void move(std::span<const Segment> moves);
    // Makes everything larger or smaller about the origin, its tolerance too. Precondition: by > 0.
    void scale(double by);

    // The polygon, or for `closed` false the line, with curves in place of their chords. A curve of which a
    // part was cut away keeps its other parts. Guarantees: a step's ends are corners of the polygon, and the
    // curve between them strays from the polygon by at most 0.01 mm (times what scale() was given) and the
    // 0.0001 mm of rounding; where two curves share their ends it is the one that the polygon runs along.
    // Curves straighter than kStraightMm stay as they are. A closed polygon that begins in the middle of a
    // curve begins at the end of it, unless `keep_start`, which makes two of the curve. Cost: near linear in
    // corners.
    [[nodiscard]] Restored restored(std::span<const Vec2> points, bool closed, bool keep_start) const;

 private:
    friend class CurveFinder;
    // The end of a chord. Sorted by column, y, curve and t.
    struct Corner {
        std::int64_t column = 0;
        Vec2 at;
        int curve = 0;
        double t = 0.0;
    };
    void sort();
    // The first that stands in this column at y or higher, or after the column.
    [[nodiscard]] std::vector<Corner>::const_iterator first_from(std::int64_t column, double y) const;
    std::vector<Cubic> cubics_;
    std::vector<Corner> corners_;
    double scale_ = 1.0;
};

}  // namespace popup
