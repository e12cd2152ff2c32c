// Designs of webOAcard.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_oa(std::string_view bytes) { look_at_design("fuzz.oa", bytes); }

}  // namespace popup::fuzz
