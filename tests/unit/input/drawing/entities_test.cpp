// What a document type declaration defines, in place of its references.
#include "input/drawing/entities.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace popup::drawing {
namespace {

TEST(Entities, StandForTheirTexts) {
    Entities entities(
        "<?xml version='1.0'?>\n<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\" [\n"
        "  <!-- <!ENTITY st0 \"no\"> -->\n"
        "  <!ENTITY st0 \"fill:none;stroke:#F00;\">\n\t<!ENTITY st1 'stroke:blue'>\n"
        "  <!ENTITY both \"&st0;&st1;\">\n  <!ENTITY st0 \"twice\">\n"
        "  <!ENTITY file SYSTEM \"/etc/passwd\">\n  <!ENTITY % outer \"st9\">\n]>\n");
    EXPECT_EQ(entities.expanded("&st0;"), "fill:none;stroke:#F00;");
    EXPECT_EQ(entities.expanded("a &st1; b&st1;"), "a stroke:blue bstroke:blue");
    EXPECT_EQ(entities.expanded("&both;"), "fill:none;stroke:#F00;stroke:blue");
    for (const std::string value : {"", "st0", "&st0", "&amp;", "&file;", "&outer;", "&;", "&&st", "& st0;"})
        EXPECT_EQ(entities.expanded(value), std::nullopt) << value;
    EXPECT_EQ(entities.expanded("&file;&st1;"), "&file;stroke:blue");
}

TEST(Entities, AreNoneWithoutADeclarationThatDefinesThem) {
    for (const std::string prolog :
         {"", "<!ENTITY a 'b'>", "<!DOCTYPE svg>", "<!DOCTYPE svg [<!ENTITY a 'b", "<!DOCTYPE svg [<!ENTITY",
          "<!DOCTYPE svg [<!ENTITY a", "<!DOCTYPE svg [<!--"})
        EXPECT_EQ(Entities(prolog).expanded("&a;"), std::nullopt) << prolog;
}

// A thousand million laughs.
TEST(Entities, GrowNoLargerThanTheirLimits) {
    std::string prolog = "<!DOCTYPE svg [<!ENTITY a0 \"laugh\">";
    for (int i = 1; i < 30; ++i) {
        prolog += fmt::format("<!ENTITY a{} \"", i);
        for (int k = 0; k < 10; ++k) prolog += fmt::format("&a{};", i - 1);
        prolog += "\">";
    }
    Entities entities(prolog + "]>");
    for (int i = 0; i < 30; ++i) {
        const auto value = entities.expanded(fmt::format("&a{};", i));
        ASSERT_TRUE(value);
        EXPECT_LE(value->size(), Entities::kLongest);
    }
    std::string value;
    while (value.size() < Entities::kLongestValue) value += "&a2;";
    EXPECT_EQ(entities.expanded(value), std::nullopt);
    // Nor do many values together.
    std::size_t sum = 0;
    while (const auto one = entities.expanded("&a2;")) sum += one->size();
    EXPECT_LE(sum, Entities::kInAll);
    EXPECT_GT(sum, Entities::kInAll / 2);
}

}  // namespace
}  // namespace popup::drawing
