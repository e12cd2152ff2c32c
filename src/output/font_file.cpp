#include "output/font_file.h"

namespace popup {

FontFile::~FontFile() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
}

std::unique_ptr<FontFile> FontFile::open(const std::string& file) {
    auto font = std::make_unique<FontFile>();
    if (FT_Init_FreeType(&font->library) != 0) return nullptr;
    if (FT_New_Face(font->library, file.c_str(), 0, &font->face) != 0) return nullptr;
    return font;
}

}  // namespace popup
