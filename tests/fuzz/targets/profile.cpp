// Profiles in TOML.
#include "popup/profile.h"

#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_profile(std::string_view bytes) {
    Diagnostics told("fuzz.toml");
    const auto profile = read_profile({"fuzz.toml", std::string(bytes)}, told);
    expect_told(told, bytes);
    expect(profile.has_value() == !told.has_errors(), "a profile, or an error");
}

}  // namespace popup::fuzz
