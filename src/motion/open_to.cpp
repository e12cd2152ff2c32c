#include <fmt/format.h>

#include "popup/motion.h"

namespace popup {

bool open_to(Assembly& assembly, Angle opening, Diagnostics& diagnostics) {
    if (!moves(assembly)) return true;
    if (opening.deg > assembly.sweep.from_deg) {
        assembly.sweep.to_deg = opening.deg;
        return true;
    }
    diagnostics
        .error("opens-too-little", {},
               fmt::format("the sweep begins at {:g}°, so it cannot end at {:g}°", assembly.sweep.from_deg,
                           opening.deg))
        .hint("ask for a larger opening");
    return false;
}

}  // namespace popup
