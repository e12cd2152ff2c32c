// Assemblies as texts.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_assembly(std::string_view bytes) {
    look_at_design("fuzz.assembly.json", bytes, {}, Emit::always);
}

}  // namespace popup::fuzz
