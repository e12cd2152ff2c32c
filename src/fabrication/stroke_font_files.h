// The font of single lines, as Debian's package hershey-fonts-data has it. The Hershey Fonts were originally
// created by Dr. A. V. Hershey while working at the U. S. National Bureau of Standards; the format of the
// data was originally created by James Hurt, Cognition, Inc. The build embeds the file
// (cmake/embed_files.cmake).
#pragma once

#include <span>
#include <string_view>

namespace popup {

struct StrokeFontFile {
    std::string_view name;  // "futural.jhf"
    std::string_view text;  // as the file has it, byte for byte
};

// One file.
std::span<const StrokeFontFile> stroke_font_files();

}  // namespace popup
