// Lengths, and how a drawing's units become millimetres.
#pragma once

#include <optional>
#include <string_view>

#include "input/drawing/transform.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup::drawing {

// CSS: 96 pixels an inch.
inline constexpr double kMmPerPixel = 25.4 / 96.0;

// A length in pixels, which are user units too: a number, or one with px, mm, cm, in, pt, pc, q, or in
// percent of `whole`. Nullopt when it is none of these, or not finite.
std::optional<double> parse_length(std::string_view text, double whole);
// True of a length that has a unit other than px and %.
bool has_real_unit(std::string_view text);

// Whether Adobe Illustrator names itself before the root of a drawing: what it calls pixels are points, 72 to
// the inch.
bool is_by_illustrator(std::string_view text);

// What a drawing says of its size.
struct SizeSaid {
    bool sized = false;     // it has a width or a height
    bool has_unit = false;  // of one of these
    bool by_illustrator = false;
};

// Of a drawing of this size: a `size-missing` warning where the drawing does not say it, and a
// `size-in-pixels` remark where it says so in pixels.
void tell_size(Place place, Vec2 mm, const SizeSaid& said, Diagnostics& diagnostics);

// The part of a picture's coordinates that is shown.
struct ViewBox {
    Vec2 corner;
    double width = 0.0;   // > 0
    double height = 0.0;  // > 0
};
// Nullopt unless it is four numbers, the last two positive.
std::optional<ViewBox> parse_view_box(std::string_view text);

// Fits the box into a rectangle from the origin, as preserveAspectRatio says ("xMidYMid meet" when empty or
// not understood).
Affine fitted(const ViewBox& box, double width, double height, std::string_view preserve);

}  // namespace popup::drawing
