// By what a drawing is known for one.
#include <gtest/gtest.h>

#include <string>

#include "popup/language.h"

namespace popup {
namespace {

TEST(DrawingLanguage, IsToldBySuffixAndOfStandardInputByItsFirstTag) {
    const auto name = [](const std::string& file, const std::string& text) -> std::string {
        const Language* language = find_language(Source{file, text}, "");
        return language == nullptr ? "" : std::string(language->name);
    };
    EXPECT_EQ(name("a.svg", ""), "svg");
    EXPECT_EQ(name("A.SVG", "<popup/>"), "svg");
    EXPECT_EQ(name("a.xml", "<svg/>"), "xml");
    EXPECT_EQ(name("a.dxf", "<svg/>"), "dxf");
    EXPECT_EQ(name("a.dwg", "<svg/>"), "");
    EXPECT_EQ(name("-", "<svg/>"), "svg");
    EXPECT_EQ(name("-", "\xEF\xBB\xBF<?xml version='1.0'?> <!-- <popup> --><svg width='3'>"), "svg");
    EXPECT_EQ(name("-", "<!DOCTYPE svg PUBLIC 'x'><svg/>"), "svg");
    EXPECT_EQ(name("-", "<s:svg/>"), "svg");
    EXPECT_EQ(name("-", "\n ; a program\nforward(1)"), "flatlang");
    EXPECT_EQ(name("-", "repeat (4) forward(1) done"), "flatlang");
    for (const std::string other :
         {"", "<popup><svg/></popup>", "<svgs/>", "<?xml", "<!-- <svg/>", "<", "12"}) {
        EXPECT_EQ(name("-", other), "xml") << other;
    }
    EXPECT_EQ(find_language(Source{"a.xml", ""}, "svg")->name, "svg");
    EXPECT_EQ(find_language(Source{"a.xml", ""}, "dwg"), nullptr);
}

TEST(DrawingLanguage, IsNoDesign) {
    Diagnostics diagnostics("a.svg");
    EXPECT_FALSE(read_design(Source{"a.svg", "<svg/>"}, {}, diagnostics));
    EXPECT_EQ(diagnostics.sorted().at(0).code, "no-design");
    for (const std::string program :
         {"repeat (4) forward(1) left(90) done", "define side() forward(1) done"}) {
        Diagnostics told("a.fl");
        EXPECT_FALSE(read_design(Source{"a.fl", program}, {}, told));
        EXPECT_EQ(told.sorted().at(0).code, "no-design") << program;
    }
}

}  // namespace
}  // namespace popup
