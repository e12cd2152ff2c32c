// The kit's texts. The build writes their definition from src/input/flatlang/kit/*.fl
// (cmake/embed_files.cmake).
#pragma once

#include <span>
#include <string_view>

namespace popup::flatlang {

struct KitFile {
    std::string_view name;  // "gear.fl"
    std::string_view text;  // as the file has it, byte for byte
};

// Sorted by name, bytewise.
std::span<const KitFile> kit_table();

}  // namespace popup::flatlang
