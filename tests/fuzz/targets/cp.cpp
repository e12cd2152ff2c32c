// Crease patterns of ORIPA and its like.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_cp(std::string_view bytes) { look_at_design("fuzz.cp", bytes); }

}  // namespace popup::fuzz
