#include "base/text/font_file.h"

#include <array>
#include <string_view>

namespace popup {

std::string font_path(TextFont font) {
    constexpr std::array<std::string_view, kTextFontNames.size()> kFiles{
        "DejaVuSans.ttf",       "DejaVuSans-Bold.ttf", "DejaVuSerif.ttf",
        "DejaVuSerif-Bold.ttf", "DejaVuSansMono.ttf",  "DejaVuSansMono-Bold.ttf"};
    if (font == TextFont::sans) return POPUP_FONT_FILE;
    const std::string_view labels = POPUP_FONT_FILE;
    return std::string(labels.substr(0, labels.rfind('/') + 1)) +
           std::string(kFiles.at(static_cast<std::size_t>(font)));
}

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
