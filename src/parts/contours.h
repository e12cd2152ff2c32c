// Closed contours made sound, and which of them lies in which.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/geometry/tolerances.h"
#include "parts/work.h"
#include "popup/geometry.h"

namespace popup {

// True of regions in which there is room for a disc of the radius kDeepMm.
bool is_deep(const std::vector<Polygon>& regions);

struct ClosedContour {
    Ring ring;                  // counter-clockwise, on the grid, does not cross itself, has an area
    std::vector<int> elements;  // it is made of, ascending, at least one
    int parent = -1;            // the contour it lies in, the innermost
    int root = 0;               // the outermost contour around it; itself when there is none
    int depth = 0;              // how many contours it lies in, counted by parents
    // Contours whose edge it crosses by no more than kDeepMm; ascending.
    std::vector<int> grazed;
};

// Two contours of which neither lies in the other, though they overlap.
struct ContourOverlap {
    int a = 0, b = 0;
    double area_mm2 = 0.0;
    Vec2 at;  // a corner of what both hold
};

// A contour that was mended: it crossed itself.
struct CrossedContour {
    std::vector<int> elements;
    Vec2 at;
};

struct Contours {
    std::vector<ClosedContour> all;
    std::vector<ContourOverlap> overlaps;
    std::vector<CrossedContour> crossed;
    std::vector<std::vector<int>> doubled;  // elements of contours left out, for another is the same
    // Those without an area, and what of the others runs out and straight back (spurs_of), as open lines.
    std::vector<std::pair<std::vector<Vec2>, std::vector<int>>> hairs;
};

// A closed line as drawn, the last point joined to the first.
struct ClosedLine {
    std::vector<Vec2> points;  // at least two
    std::vector<int> elements;
};

// Contours that cross themselves become the outlines of what is inside of them, holes of that being contours
// of their own. Contours that only touch, or overlap by no more than kDeepMm, do not overlap. Nullopt when
// the work left does not do, or there are more than 10 000 overlaps. Cost: near linear for drawings in which
// contours touch few others and are not nested very deep.
std::optional<Contours> sort_contours(std::vector<ClosedLine> lines, Work& work);

}  // namespace popup
