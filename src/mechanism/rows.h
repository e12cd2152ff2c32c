// The element rows, each defined in its element's file.
#pragma once

#include "mechanism/element.h"

namespace popup {

extern const ElementRow kStep, kInvertedStep;
extern const ElementRow kBeak, kInvertedBeak;
extern const ElementRow kAngledStep, kInvertedAngledStep;
extern const ElementRow kVFold, kInvertedVFold;
extern const ElementRow kTent;

}  // namespace popup
