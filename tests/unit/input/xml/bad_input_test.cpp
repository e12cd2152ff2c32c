// Documents that are no documents: each is an error with its place, soon, and in little memory.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup {
namespace {

// "LINE:COLUMN CODE" of the findings, one a line; a design in spite of them is said.
std::string read(std::string text) {
    Diagnostics diagnostics("card.xml");
    const auto design = read_design(Source{"card.xml", std::move(text)}, {}, diagnostics);
    std::string out = design ? "read\n" : "";
    for (const Diagnostic& d : diagnostics.sorted()) {
        EXPECT_FALSE(d.message.empty());
        EXPECT_LT(d.message.size(), 400U);
        EXPECT_EQ(d.message.find('\n'), std::string::npos);
        out += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + " " + d.code + "\n";
    }
    return out;
}

std::string repeated(const std::string& text, std::size_t times) {
    std::string out;
    out.reserve(text.size() * times);
    for (std::size_t i = 0; i < times; ++i) out += text;
    return out;
}

using namespace std::string_literals;

TEST(BadInput, EmptyFiles) {
    EXPECT_EQ(read(""), "0:0 empty-input\n");
    EXPECT_EQ(read(" \n\t\r\n"), "0:0 empty-input\n");
    EXPECT_EQ(read("\xEF\xBB\xBF"), "0:0 empty-input\n");
}

TEST(BadInput, OtherEncodings) {
    EXPECT_EQ(read("\xFF\xFE<\0p\0"s), "1:1 encoding\n");
    EXPECT_EQ(read("\xFE\xFF\0<\0p"s), "1:1 encoding\n");
    EXPECT_EQ(read("<\0p\0o\0"s), "1:1 encoding\n");
    EXPECT_EQ(read("<?xml version='1.0' encoding='ISO-8859-1'?><popup/>"), "1:21 encoding\n");
    EXPECT_EQ(read("<?xml version='1.0' encoding='utf-8'?><popup/>"), "read\n");
    EXPECT_EQ(read("<popup>\n<!-- \xE4 --></popup>"), "2:6 encoding\n");
    for (const char* bad :
         {"\x80", "\xC0\x80", "\xC3", "\xE2\x82", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xFF"}) {
        EXPECT_EQ(read("<popup><!--\xC3\xA4"s + bad + "--></popup>"), "1:13 encoding\n");
    }
    EXPECT_EQ(read("<popup><!-- \xC3\xA4\xE2\x82\xAC\xF0\x9F\x90\xA6 --></popup>"), "read\n");
}

TEST(BadInput, CharactersThatXmlForbids) {
    EXPECT_EQ(read("<popup>\0</popup>"s), "1:8 bad-character\n");
    EXPECT_EQ(read("<popup>\n\x01</popup>"), "2:1 bad-character\n");
    EXPECT_EQ(read("<popup>&#0;</popup>"), "1:8 bad-character\n");
    EXPECT_EQ(read("<popup version='&#xD800;'/>"), "1:17 bad-character\n");
    EXPECT_EQ(read("<popup>\xEF\xBF\xBF</popup>"), "1:8 bad-character\n");
}

TEST(BadInput, DeclarationsAndEntityBombs) {
    EXPECT_EQ(read("<?xml version='1.0'?>\n<!DOCTYPE lolz [<!ENTITY a 'ha'><!ENTITY b "
                   "'&a;&a;'>]>\n<popup>&b;</popup>"),
              "2:1 doctype\n");
    EXPECT_EQ(read("<!doctype popup SYSTEM 'file:///etc/passwd'><popup/>"), "1:1 doctype\n");
    EXPECT_EQ(read("<popup><!ENTITY a 'b'></popup>"), "1:8 doctype\n");
    EXPECT_EQ(read("<popup>&b;</popup>"), "1:8 xml-syntax\n");
}

TEST(BadInput, WhatIsNotXml) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"hello", "1:1"},
        {"%PDF-1.4", "1:1"},
        {"<", "1:1"},
        {"<popup", "1:1"},
        {"<popup>", "1:8"},
        {"<popup>\n<structurelist>\n<structure type='2'>\n", "4:1"},
        {"<popup></popup", "1:8"},
        {"<popup></pop>", "1:8"},
        {"<popup>\n</structure></popup>", "2:1"},
        {"</popup>", "1:1"},
        {"<popup/><popup/>", "1:9"},
        {"<popup/>text", "1:9"},
        {"<popup a/>", "1:8"},
        {"<popup a=1/>", "1:10"},
        {"<popup a='1/>", "1:10"},
        {"<popup a='<'/>", "1:10"},
        {"<popup a='1'b='2'/>", "1:13"},
        {"<popup a='1' a='2'/>", "1:14"},
        {"<popup 1='2'/>", "1:8"},
        {"<popup>a < b</popup>", "1:10"},
        {"<popup>a & b</popup>", "1:10"},
        {"<popup><!-- </popup>", "1:8"},
        {"<popup><![CDATA[ </popup>", "1:8"},
        {"<popup><?x </popup>", "1:8"},
        {"<?xml version='1.0'?>", "1:22"},
        {" <?xml version='1.0'?><popup/>", "1:2"},
        {"<!-- only -->", "1:14"},
        {"<![CDATA[x]]><popup/>", "1:1"},
        {"<popup></popup x='1'>", "1:8"},
    };
    for (const auto& [text, place] : cases) EXPECT_EQ(read(text), place + " xml-syntax\n") << text;
}

TEST(BadInput, AnotherKindOfDocument) {
    EXPECT_EQ(read("<svg xmlns='http://www.w3.org/2000/svg'/>"), "1:1 wrong-root\n");
    EXPECT_EQ(read("<!-- x -->\n  <p:popup xmlns:p='x'/>"), "2:3 wrong-root\n");
}

TEST(BadInput, ProcessingInstructionsAreSkippedAnywhere) {
    EXPECT_EQ(
        read("<?xml version='1.0'?><?xml-stylesheet href='a'?><popup><?a b?><mainpage><?c <d> ?></mainpage>"
             "<?e?></popup><?f?>"),
        "read\n");
}

TEST(BadInput, AMillionNestedTags) {
    EXPECT_EQ(read(repeated("<popup>", 1'000'000)), "1:701 xml-syntax\n");
    EXPECT_EQ(read(repeated("<a>", 1'000'000) + repeated("</a>", 1'000'000)), "1:301 xml-syntax\n");
}

TEST(BadInput, MarkupWithoutEnd) {
    EXPECT_EQ(read("<popup>" + repeated("<a/>", 8'100'000) + "</popup>"), "1:32000004 document-too-large\n");
    EXPECT_EQ(read("<popup>" + repeated("<!---->", 8'100'000) + "</popup>"),
              "1:56000008 document-too-large\n");
    std::string attributes = "<popup";
    for (int i = 0; i < 100'000; ++i) attributes += " a" + std::to_string(i) + "=''";
    EXPECT_EQ(read(attributes + "/>"), "1:7898 document-too-large\n");
    const std::string head = "<popup><structurelist><structure type='beak'>";
    const std::string tail = "</structure></structurelist></popup>";
    EXPECT_EQ(read(head + repeated("<point x='1' y='1'/>", 400'000) + tail), "1:23 document-too-large\n");
    EXPECT_NE(read(head + "<outerpoints>" + repeated("1,1 ", 3'000'000) + "</outerpoints>" + tail)
                  .find("document-too-large"),
              std::string::npos);
    EXPECT_NE(read("<popup><structurelist>" + repeated("<structure/>", 300'000) + "</structurelist></popup>")
                  .find("document-too-large"),
              std::string::npos);
}

TEST(BadInput, LongWordsAreCutInMessages) {
    const std::string word(5'000'000, 'a');
    EXPECT_EQ(read("<" + word + "/>"), "1:1 wrong-root\n");
    EXPECT_EQ(read("<popup><" + word + "/></popup>"), "read\n1:8 unknown-markup\n");
    EXPECT_EQ(read("<popup units='" + word + "'/>"), "1:8 bad-unit\n");
    EXPECT_EQ(read("<popup><mainpage width='" + std::string(1'000'000, '1') + "'/></popup>"),
              "1:18 bad-number\n");
    EXPECT_EQ(read("<popup><mainpage leftcolor='" + word + "'/></popup>"), "1:18 bad-color\n");
}

TEST(BadInput, ManyFindingsAreCountedNotKept) {
    Diagnostics diagnostics("card.xml");
    const Source source{"card.xml", "<popup>" + repeated("<x/>", 200'000) + "</popup>"};
    EXPECT_TRUE(read_design(source, {}, diagnostics));
    EXPECT_LT(diagnostics.sorted().size(), 200U);
}

}  // namespace
}  // namespace popup
