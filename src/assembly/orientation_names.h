// What the ways to stand are called, in documents, assemblies and models.
#pragma once

#include <array>
#include <string_view>

namespace popup {

// In the order of the enumerators of Orientation. The first is for assemblies alone, which leave it out.
inline constexpr std::array<std::string_view, 4> kOrientationNames{"guessed", "upright", "flat", "stage"};

}  // namespace popup
