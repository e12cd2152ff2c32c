// The element rows, each defined in its element's file and listed in elements.inc.
#pragma once

#include "mechanism/element.h"

namespace popup {

#define POPUP_ELEMENT(row) extern const ElementRow row;
#include "mechanism/elements.inc"
#undef POPUP_ELEMENT

}  // namespace popup
