#include <gtest/gtest.h>

#include <set>
#include <string>

#include "popup/output.h"

namespace popup {
namespace {

TEST(Formats, HaveTheRowsThatArePromisedEachWithAWordAboutIt) {
    std::vector<std::string> suffixes;
    for (const Format& row : format_table()) {
        suffixes.emplace_back(row.suffix);
        EXPECT_FALSE(row.about.empty()) << row.suffix;
        std::visit([&row](auto write) { EXPECT_NE(write, nullptr) << row.suffix; }, row.write);
    }
    EXPECT_EQ(suffixes, (std::vector<std::string>{".svg", ".book.pdf", ".book.html", ".pdf", ".dxf", ".lbrn2",
                                                  ".plt", ".view.png", ".png", ".jpg", ".webp", ".gif",
                                                  ".glb", ".gltf", ".html", ".fold", ".xml", ".json"}));
}

TEST(Formats, AreFoundBySuffixOrNameWhateverTheCase) {
    const auto suffix = [](std::string_view path) -> std::string {
        const Format* format = find_format(path);
        return format == nullptr ? "" : std::string(format->suffix);
    };
    EXPECT_EQ(suffix("out/card.svg"), ".svg");
    EXPECT_EQ(suffix("CARD.PDF"), ".pdf");
    EXPECT_EQ(suffix("a.svg.Json"), ".json");
    EXPECT_EQ(suffix("model.glTF"), ".gltf");
    EXPECT_EQ(suffix("glb"), ".glb");
    EXPECT_EQ(suffix("XML"), ".xml");
    for (const char* unknown : {"", ".", "svg.", "card", "card.sv", "cardsvg", "out/svg", "card.svg/", "-"}) {
        EXPECT_EQ(suffix(unknown), "") << unknown;
    }
}

}  // namespace
}  // namespace popup
