// The last word on a layout: integers only.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "nest/grid.h"
#include "nest/shapes.h"

namespace popup {

// A shape at a whole place on a sheet.
struct ExactPlace {
    int sheet = 0;
    int shape = 0;
    GridPoint at;
};

// The exact parts of shapes (see TurnedShape), for tests without rounding.
class ExactShapes {
 public:
    explicit ExactShapes(const std::vector<TurnedShape>& shapes);

    // Whether the interiors of two shapes are apart by `spacing` steps or more; 0: whether they are disjoint.
    [[nodiscard]] bool apart(int a, GridPoint at_a, int b, GridPoint at_b, GridLength spacing) const;

    // The first two places, by index, that are not apart; nullopt when all are.
    [[nodiscard]] std::optional<std::pair<int, int>> first_conflict(const std::vector<ExactPlace>& places,
                                                                    GridLength spacing) const;
    [[nodiscard]] const GridBox& bounds(int shape) const { return nth(shapes_, shape).box; }

 private:
    struct Part {
        GridRing ring;
        GridBox box;
    };
    struct Exact {
        std::vector<Part> parts;
        GridBox box;
    };
    std::vector<Exact> shapes_;
};

}  // namespace popup
