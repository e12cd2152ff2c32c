// Where the style and the attributes of an element put what it draws.
#pragma once

#include <string_view>
#include <vector>

#include "input/drawing/shapes.h"
#include "input/drawing/style.h"
#include "input/drawing/transform.h"

namespace popup::drawing {

struct Placing {
    Affine map;                              // to the coordinates around it
    std::vector<std::string_view> not_read;  // properties that would place it elsewhere
    const xml::Attribute* fault = nullptr;   // a transform that cannot be read; then the map is none
};

// `view`: of the picture around, for percentages. The transform of a style outweighs the attribute, if it can
// be read.
Placing placing_of(const Declarations& declared, const Attributes& attributes, Vec2 view);

}  // namespace popup::drawing
