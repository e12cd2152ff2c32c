// The fonts of labels and texts, read from their files, so that no output depends on how a system chooses
// fonts.
#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H

#include <memory>
#include <string>

#include "popup/print.h"

namespace popup {

// The file of a font: those of texts stand beside that of the labels.
std::string font_path(TextFont font);

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
