#include "input/drawing/viewport.h"

#include <fmt/format.h>

#include <string>

#include "input/drawing/size.h"
#include "input/text.h"

namespace popup::drawing {

std::optional<Viewport> viewport_of(const Attributes& attributes, Vec2 around, const WantedSize& wanted,
                                    std::optional<ShapeProblem>& problem) {
    const double x = length_of(attributes, "x", around.x, 0.0, problem);
    const double y = length_of(attributes, "y", around.y, 0.0, problem);
    const double own_width = length_of(attributes, "width", around.x, around.x, problem);
    const double own_height = length_of(attributes, "height", around.y, around.y, problem);
    const Vec2 size{wanted.width.value_or(own_width), wanted.height.value_or(own_height)};
    const xml::Attribute* given = attributes.find("viewBox");
    const auto box = given == nullptr ? std::nullopt : parse_view_box(given->value.decoded);
    if (given != nullptr && !box && !problem) {
        problem =
            ShapeProblem{given, "bad-number",
                         fmt::format("the viewBox is \"{}\"", shown(given->value.decoded)), std::nullopt};
    }
    // A drawing may leave its size to the page around it: then percentages of it are 0.
    const bool unknown = around.x <= 0.0 || around.y <= 0.0;
    if (problem || (!unknown && (size.x <= 0.0 || size.y <= 0.0))) return std::nullopt;
    Viewport made{{1.0, 0.0, 0.0, 1.0, x, y}, size, size};
    if (box && size.x > 0.0 && size.y > 0.0) {
        made.from_inside =
            made.from_inside.after(fitted(*box, size.x, size.y, attributes.value("preserveAspectRatio")));
        made.view = {box->width, box->height};
    }
    return made;
}

}  // namespace popup::drawing
