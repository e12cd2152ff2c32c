// DXF drawings.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_dxf(std::string_view bytes) { look_at_design("fuzz.dxf", bytes); }

}  // namespace popup::fuzz
