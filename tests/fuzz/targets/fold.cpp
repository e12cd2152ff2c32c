// FOLD crease patterns.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_fold(std::string_view bytes) { look_at_design("fuzz.fold", bytes); }

}  // namespace popup::fuzz
