// The font of labels, read from its file, so that no output depends on how a system chooses fonts.
#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H

#include <memory>
#include <string>

namespace popup {

// A font file as FreeType has it. Null from open() when the file cannot be read as a font.
struct FontFile {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    FontFile() = default;
    FontFile(const FontFile&) = delete;
    FontFile& operator=(const FontFile&) = delete;
    ~FontFile();
    static std::unique_ptr<FontFile> open(const std::string& file);
};

}  // namespace popup
