// SVG drawings as flat parts.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_drawing(std::string_view bytes) { look_at_design("fuzz.svg", bytes); }

}  // namespace popup::fuzz
