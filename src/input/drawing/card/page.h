// The page of a drawn card, and its gutter.
#pragma once

#include <optional>
#include <vector>

#include "base/geometry/sheet_graph.h"
#include "parts/tracing.h"
#include "popup/diagnostics.h"

namespace popup::drawing::card {

// Where the drawing has the page, and how it lies there.
struct CardPage {
    Vec2 centre;                       // of the page, on the gutter; mm of the drawing
    Vec2 up;                           // unit, along the gutter: the y axis of the page
    double width = 0.0, height = 0.0;  // across and along the gutter
    int element = 0;                   // that drew its border
    int gutter_element = 0;
    int left = 0, right = 0;  // faces on either side of the gutter, at the border

    // From the drawing to the page, and back.
    [[nodiscard]] Vec2 to_page(Vec2 p) const {
        const Vec2 d = p - centre;
        return {dot(right_of(up), d), dot(up, d)};
    }
    [[nodiscard]] Vec2 to_drawing(Vec2 p) const { return centre + p.x * right_of(up) + p.y * up; }
};

// The face outside of everything is around it. The border is what surrounds most, and must be a rectangle;
// the gutter is the fold between the middles of two of its sides. A gutter that lies across the drawing is
// turned upright, the upper half of the drawing on its left.
// Errors: `no-page`, `page-not-rectangle`, `no-gutter`, `gutter-off-middle`. Repairs: `page-mended`, for
// corners and gutters that are off by up to 0.5 mm.
std::optional<CardPage> find_page(const Tracing& tracing, const SheetGraph& graph, Diagnostics& diagnostics);

}  // namespace popup::drawing::card
