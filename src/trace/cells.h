// The figure as a grid of cells, and what is done to it before its outlines are followed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "popup/trace.h"

namespace popup {

// Cells, rows from the top, with a rim of empty ones around, so that whoever looks at neighbours needs no
// care. Its coordinates count the rim.
struct CellGrid {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> inside;
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

// Cells of `pixels` × `pixels` pixels, inside where at least half of them are. Cells that touch at a corner
// alone have been joined by one more cell beside them: outlines of such a grid do not touch one another.
CellGrid cells_of(const PixelMask& mask, int pixels);

// Areas in cells.
struct Cleaning {
    double least_area = 0.0;  // what has less is dropped, or filled
    bool largest = false;     // all shapes but the one with the most cells are dropped
};
struct Cleaned {
    struct Dropped {
        std::size_t count = 0;
        std::size_t largest = 0;
    };
    Dropped specks, holes, others;
};
// Specks go first, then holes.
Cleaned clean(CellGrid& cells, const Cleaning& how);

// Where a shape is narrower than `least`, in cells, between parts that are not, and that are wider than the
// neck by 3 cells or 0.3 `least`, whichever is less. From 10 cells on, one less than `least` is no neck. The
// cell is one of the neck's.
struct ThinPlace {
    int x = 0;
    int y = 0;
    double width = 0.0;  // to within half a cell
};
struct ThinPaper {
    std::vector<ThinPlace> necks;
    std::vector<ThinPlace> shapes;  // that are nowhere as wide, at their widest
};
// Cost: near linear in cells.
ThinPaper thin_paper(const CellGrid& cells, double least);

}  // namespace popup
