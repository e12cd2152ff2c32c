// Where text goes: numbers into tabs, names into pieces.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/geometry/edge_index.h"
#include "base/text/text_width.h"
#include "popup/geometry.h"

namespace popup {

// The number of a piece as it is written alone: with a full stop where it would be another number for those
// who hold the piece upside down. "6." and "16." (91), but "7", "8" and "6L".
std::string upright_number(std::string_view number);

// Text of this size, its middle at `at`.
struct TextSpot {
    Vec2 at;
    double height;
    double angle = 0.0;
    double room = 1.0;  // as Label's: asked of plates alone
};

// The largest text, 1.5 to 4 mm high, that fits into one of a tab's parts, in seam coordinates (text along
// the seam). Where even the smallest does not fit it is given at the best place all the same: joints must
// have their numbers. Nothing only when there are no parts.
std::optional<TextSpot> place_in_tab(std::span<const Ring> parts, std::string_view text);

// The same, but nothing where even the smallest text does not fit.
std::optional<TextSpot> place_if_it_fits(std::span<const Ring> parts, std::string_view text);

// Lines that text is to keep clear of: their middles, and half the width of the widest.
struct DrawnLines {
    EdgeIndex at{};
    double half_width = 0.0;
};

// What is drawn on a plate.
struct Drawing {
    DrawnLines all;
    DrawnLines texts;  // of these, lines of text
};

// The largest text, 1.5 to 4 mm high, that fits on a plate clear of all its edges, and of other lines and
// rings in the index (rings that text is to avoid are put in clockwise); the place with most room around it.
// Clear of what is drawn on the plate if that can be had, and always of texts, which nobody could read with
// another across. Its `room` is at most 6. Nothing when no place will do. Cost: a bounded number of questions
// to the indexes.
std::optional<TextSpot> place_on_plate(const EdgeIndex& plate, const Drawing& drawing, const Box& bounds,
                                       std::string_view text);

}  // namespace popup
