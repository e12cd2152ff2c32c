// The documents that `popupc new --template` begins with. The build writes their definition from
// src/edit/templates/*.xml (cmake/embed_files.cmake).
#pragma once

#include <span>
#include <string_view>

namespace popup::edit {

struct TemplateFile {
    std::string_view name;  // "castle.xml"
    std::string_view text;  // as the file has it, byte for byte
};

// Sorted by name, bytewise.
std::span<const TemplateFile> template_files();

}  // namespace popup::edit
