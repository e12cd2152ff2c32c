// Whole numbers of the grid on which outlines and places stand while pieces are nested.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "popup/geometry.h"
#include "popup/units.h"

namespace popup {

// A length in steps of 1e-6 mm.
using GridLength = std::int64_t;
inline constexpr double kGridSteps = 1e6;  // a millimetre
inline GridLength to_grid(double mm) { return std::llround(mm * kGridSteps); }
inline double from_grid(GridLength length) { return static_cast<double>(length) / kGridSteps; }

// Numbers of items, shapes and sheets as indexes.
inline std::size_t index(int number) { return static_cast<std::size_t>(number); }

struct GridPoint {
    GridLength x = 0;
    GridLength y = 0;
    friend bool operator==(const GridPoint&, const GridPoint&) = default;
    friend bool operator<(GridPoint a, GridPoint b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
    friend GridPoint operator+(GridPoint a, GridPoint b) { return {a.x + b.x, a.y + b.y}; }
    friend GridPoint operator-(GridPoint a, GridPoint b) { return {a.x - b.x, a.y - b.y}; }
};

using GridRing = std::vector<GridPoint>;

// Exact for coordinates within ±1e17 steps.
__extension__ using Wide = __int128;
__extension__ using UnsignedWide = unsigned __int128;
inline Wide cross(GridPoint a, GridPoint b) {
    return static_cast<Wide>(a.x) * b.y - static_cast<Wide>(a.y) * b.x;
}

struct GridBox {
    GridLength x0 = INT64_MAX, y0 = INT64_MAX, x1 = INT64_MIN, y1 = INT64_MIN;
    void extend(GridPoint p) {
        x0 = std::min(x0, p.x);
        y0 = std::min(y0, p.y);
        x1 = std::max(x1, p.x);
        y1 = std::max(y1, p.y);
    }
    [[nodiscard]] GridLength width() const { return x1 - x0; }
    [[nodiscard]] GridLength height() const { return y1 - y0; }
};

// p turned counter-clockwise about the origin; exact for quarter turns.
Vec2 turned(Vec2 p, Angle angle);

// The ring turned, then rounded to the grid; points that fall together are one.
GridRing turned_ring(const Ring& ring, Angle angle);

// The ring in millimetres. Exact as far as doubles are: to_grid() gives it back.
Ring in_mm(const GridRing& ring);

}  // namespace popup
