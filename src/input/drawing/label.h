// The texts of a sheet that this program has made.
#pragma once

#include <optional>

#include "input/drawing/shapes.h"
#include "input/drawing/transform.h"
#include "input/xml/tree.h"
#include "popup/print.h"

namespace popup::drawing {

// A text that is set about its middle, and turned about it. Nullopt of any other.
std::optional<Text> label_of(const xml::Node& element, const Attributes& attributes, const Affine& to_mm);

}  // namespace popup::drawing
