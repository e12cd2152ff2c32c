// From cells to closed curves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "popup/path.h"
#include "trace/cells.h"

namespace popup {

// A border between figure and ground: one closed subpath, with the figure on its left. Coordinates are cells,
// y up from the lower edge of the grid without its rim.
struct CellContour {
    Path path;
    std::int64_t area = 0;  // in cells, of all that it goes round; negative of a hole
};

// How closely curves follow the borders.
enum class Closeness { smooth, corners, straight };

// The contours as curves, in the same order whatever the closeness: each that is no hole is followed by its
// holes. They stray from the borders by about half a cell, and `smooth` ones by at most about `tolerance`
// cells more. They may cross. A library of its own does it: P. Selinger, "Potrace: a polygon-based tracing
// algorithm" (2003).
std::vector<CellContour> curves_of(const CellGrid& cells, Closeness closeness, double tolerance);

// How many edges of cells lie between figure and ground.
std::size_t border_length(const CellGrid& cells);

// The contours as polygons through the middles of those edges, in no order that others have. They neither
// cross nor touch, and stray from the borders by less than half a cell.
class CellBorders {
 public:
    explicit CellBorders(const CellGrid& cells);
    [[nodiscard]] const std::vector<CellContour>& contours() const { return contours_; }
    // The one that a curve follows; null where it follows none.
    [[nodiscard]] const CellContour* of(const CellContour& curve) const;
    // The same of a curve that has lost most of its length, and so ends far from its border: the one of its
    // area that it lies along, the nearest of several. Cost: the first call sorts all contours; then log n,
    // and those of the same area that are about as far left.
    [[nodiscard]] const CellContour* about(const CellContour& curve) const;

 private:
    void follow(int x, int y);
    const CellGrid& cells_;
    std::vector<CellContour> contours_;
    struct Middle {
        std::int64_t area;
        Vec2 at;  // of the contour's box
        std::size_t contour;
    };
    mutable std::vector<Middle> middles_;  // by area, then from left to right
    std::vector<std::uint32_t> above_;     // by cell, the number of the contour along its upper edge, from 1
};

// What a contour of curves encloses, negative of a hole; 0 where it has too many points.
double enclosed_area(const CellContour& curve);

// The numbers of those that cross or touch themselves or others, ascending; closed subpaths in mm. Nullopt
// where they have too many points.
std::optional<std::vector<std::size_t>> crossing(const std::vector<Path>& paths);

}  // namespace popup
