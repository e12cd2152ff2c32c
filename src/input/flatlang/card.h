// Pop-up cards that programs write: popup() and one builtin an element.
#pragma once

#include <optional>
#include <string>

#include "popup/design.h"

namespace popup::flatlang {

// The card of a program, if it makes one.
struct Card {
    std::optional<Design> design;  // from the call of popup() on
};

}  // namespace popup::flatlang
