// A secret that tells who may see a page.
#pragma once

#include <string>
#include <string_view>

namespace popup::live {

// 128 bits of the kernel's random numbers (getrandom), as 32 hexadecimal digits. Waits where the kernel has
// none yet. Throws std::system_error where it never has.
std::string new_token();

// Whether both are the same text, in a time that depends on their lengths alone.
bool same_secret(std::string_view given, std::string_view secret);

}  // namespace popup::live
