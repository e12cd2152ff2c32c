// A sheet full of drawn features, as a document: what the time of many outlines is measured with.
#pragma once

#include <span>
#include <string>

#include "popup/geometry.h"

namespace popup::test {

// SVG path data of a smooth closed curve of cubics through the points, one a point (Catmull-Rom).
std::string smooth_path(std::span<const Vec2> at);

// A POPUP_XML document of a card with so many `freeform` features, each of eight cubic curves, in rows along
// the gutter: every fourth stands on the gutter, the next two on its side folds, one more on the side fold of
// one of these. It needs no repair, opens and closes; equal counts give equal bytes on every machine.
std::string freeform_sheet(int features);

}  // namespace popup::test
