#include "popup/diagnostics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "base/diagnostics/render_diagnostics.h"

namespace popup {
namespace {

constexpr const char* kCode = "unreadable-input";
constexpr const char* kOther = "unwritable-output";

std::string text_of(std::string_view source, Place place, const std::string& message = "wrong") {
    Diagnostics diagnostics("f.xml");
    diagnostics.error(kCode, place, message);
    PlaceFinder finder(source);
    return render_text(diagnostics.sorted().front(), finder);
}

TEST(Diagnostics, AreGivenWorstFirstThenByPlace) {
    Diagnostics diagnostics("f");
    diagnostics.remark(kCode, {1, 1}, "r");
    diagnostics.warning(kCode, {2, 5}, "w2");
    diagnostics.error(kCode, {9, 1}, "e9");
    diagnostics.warning(kCode, {2, 1}, "w1");
    diagnostics.error(kOther, {9, 1}, "e9 later");
    std::string order;
    for (const Diagnostic& one : diagnostics.sorted()) order += one.message + ";";
    EXPECT_EQ(order, "e9;e9 later;w1;w2;r;");
    EXPECT_TRUE(diagnostics.has_errors());
    EXPECT_TRUE(diagnostics.has_findings());
}

TEST(Diagnostics, ARemarkIsNoFinding) {
    Diagnostics diagnostics;
    diagnostics.remark(kCode, {}, "r");
    EXPECT_FALSE(diagnostics.has_errors());
    EXPECT_FALSE(diagnostics.has_findings());
}

TEST(Diagnostics, WhatThePolicyDeniesFailsTheRunAndStopsNoStage) {
    DiagnosticPolicy policy;
    policy.deny.insert(kCode);
    policy.warnings_are_errors = true;
    Diagnostics diagnostics("f", policy);
    diagnostics.remark(kCode, {}, "denied");
    diagnostics.warning(kOther, {}, "an error, as all warnings are");
    EXPECT_TRUE(diagnostics.has_errors());
    EXPECT_FALSE(diagnostics.has_errors_as_given());
    // Also behind those that are only counted.
    for (int i = 0; i < 200; ++i) diagnostics.warning(kOther, {}, "one of many");
    EXPECT_FALSE(diagnostics.has_errors_as_given());
    diagnostics.error(kOther, {}, "an error");
    EXPECT_TRUE(diagnostics.has_errors_as_given());
}

TEST(Diagnostics, PolicyRaisesAndDrops) {
    DiagnosticPolicy policy;
    policy.deny.insert(kCode);
    policy.allow.insert(kOther);
    Diagnostics diagnostics("f", policy);
    diagnostics.remark(kCode, {}, "denied");
    diagnostics.warning(kOther, {}, "allowed").changed("a", "b");
    EXPECT_EQ(diagnostics.sorted().size(), 1U);
    EXPECT_EQ(diagnostics.sorted().front().severity, Severity::error);
    // A repair stays on record even where the user does not want to be told.
    EXPECT_EQ(diagnostics.repairs().size(), 1U);
    diagnostics.error(kOther, {}, "an error is never dropped");
    EXPECT_EQ(diagnostics.sorted().size(), 2U);

    policy = {};
    policy.warnings_are_errors = true;
    Diagnostics strict("f", policy);
    strict.remark(kCode, {}, "r");
    EXPECT_FALSE(strict.has_errors());
    strict.warning(kCode, {}, "w");
    EXPECT_TRUE(strict.has_errors());
}

TEST(Diagnostics, ManyOfOneKindAreCountedNotKept) {
    Diagnostics diagnostics("f");
    for (int i = 0; i < 250; ++i) diagnostics.warning(kCode, {i + 1, 1}, "w").hint("h").about("e");
    diagnostics.error(kCode, {1, 1}, "of another severity");
    const auto all = diagnostics.sorted();
    ASSERT_EQ(all.size(), 102U);
    EXPECT_EQ(all.front().message, "of another severity");
    EXPECT_EQ(all.back().message, "150 more warnings of this kind are not shown");
    EXPECT_TRUE(all.back().hints.empty());
}

TEST(Diagnostics, ReferencesStayValid) {
    Diagnostics diagnostics("f");
    Diagnostic& first = diagnostics.error(kCode, {1, 1}, "first");
    for (int i = 0; i < 90; ++i) diagnostics.error(kCode, {2, 1}, "later");
    first.hint("late");
    EXPECT_EQ(diagnostics.sorted().front().hints, std::vector<std::string>{"late"});
}

TEST(DiagnosticsDeathTest, AnUnknownCodeIsABrokenInvariant) {
    Diagnostics diagnostics;
    EXPECT_DEATH(diagnostics.error("no-such-code", {}, "x"), "no-such-code");
}

TEST(Codes, AreSortedUniqueAndExplained) {
    const auto table = code_table();
    std::string_view last;
    std::set<std::string_view> paragraphs;
    for (const CodeInfo& row : table) {
        EXPECT_LT(last, row.code);
        last = row.code;
        EXPECT_EQ(row.code.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string_view::npos)
            << row.code;
        EXPECT_FALSE(row.summary.empty()) << row.code;
        EXPECT_FALSE(row.summary.ends_with('.')) << row.code;
        // A real paragraph: a few sentences, of its own.
        EXPECT_GE(row.explanation.size(), 150U) << row.code;
        EXPECT_TRUE(row.explanation.ends_with('.')) << row.code;
        EXPECT_TRUE(paragraphs.insert(row.explanation).second) << row.code;
        EXPECT_EQ(find_code(row.code), &row);
    }
    EXPECT_EQ(find_code("no-such-code"), nullptr);
}

TEST(RenderText, ShowsTheLineWithACaretUnderTheColumn) {
    EXPECT_EQ(text_of("one\ntwo three\n", {2, 5}),
              "f.xml:2:5: error: wrong [unreadable-input]\n"
              "    2 | two three\n"
              "      |     ^\n");
}

TEST(RenderText, HintsFollow) {
    Diagnostics diagnostics("f.xml");
    diagnostics.warning(kCode, {}, "wrong").hint("do this").hint("or that");
    PlaceFinder finder("");
    EXPECT_EQ(render_text(diagnostics.sorted().front(), finder),
              "f.xml: warning: wrong [unreadable-input]\n  hint: do this\n  hint: or that\n");
}

TEST(RenderText, RelatedPlacesStandBetweenTheChangeAndTheHints) {
    Diagnostics diagnostics("f.xml");
    diagnostics.warning(kCode, {2, 1}, "wrong")
        .changed("1", "2")
        .with({1, 3}, "\"fire\"")
        .with({}, "\"page\x1b\"")
        .with({9, 1}, "beyond the end")
        .hint("do this");
    PlaceFinder finder("a fire\ntwo\n");
    EXPECT_EQ(render_text(diagnostics.sorted().front(), finder),
              "f.xml:2:1: warning: wrong [unreadable-input]\n"
              "    2 | two\n"
              "      | ^\n"
              "   was: 1\n"
              "   now: 2\n"
              "  with: f.xml:1:3: \"fire\"\n"
              "    1 | a fire\n"
              "      |   ^\n"
              "  with: f.xml: \"page\\x1b\"\n"
              "  with: f.xml:9:1: beyond the end\n"
              "  hint: do this\n");
}

TEST(RenderText, WhatHasNoPlaceHasNoExcerpt) {
    EXPECT_EQ(text_of("one\n", {}), "f.xml: error: wrong [unreadable-input]\n");
    EXPECT_EQ(text_of("one\n", {7, 1}), "f.xml:7:1: error: wrong [unreadable-input]\n");
}

TEST(RenderText, TabsAndWideCharactersKeepTheCaretInPlace) {
    // Columns count characters: tab, é, 日, 本, then x in column 5.
    EXPECT_EQ(text_of("\té日本x\r\n", {1, 5}),
              "f.xml:1:5: error: wrong [unreadable-input]\n"
              "    1 |     é日本x\n"
              "      |          ^\n");
}

TEST(RenderText, ACaretMayStandBehindTheLine) {
    EXPECT_EQ(text_of("ab\ncd", {1, 3}),
              "f.xml:1:3: error: wrong [unreadable-input]\n    1 | ab\n      |   ^\n");
    EXPECT_EQ(text_of("ab\ncd", {2, 99}),
              "f.xml:2:99: error: wrong [unreadable-input]\n    2 | cd\n      |   ^\n");
}

TEST(RenderText, ControlCharactersAreMadeVisible) {
    const std::string text = text_of("a\x1b[31m\xff\xe2\x80\xae z", {1, 2}, "a \x1b[0m b\nc");
    for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << text;
    EXPECT_EQ(text,
              "f.xml:1:2: error: a \\x1b[0m b c [unreadable-input]\n"
              "    1 | a\\x1b[31m\\xff\\u202e z\n"
              "      |  ^\n");
}

TEST(RenderText, LongLinesAreCutToAWindowAroundTheCaret) {
    std::string line;
    for (int i = 0; i < 100000; ++i) line += std::to_string(i % 10);
    for (const int column : {1, 50, 97, 5000, 99990, 100000, 100001}) {
        const std::string text = text_of(line + "\nnext", {1, column});
        const std::size_t first = text.find("    1 | ") + 8;
        const std::string shown = text.substr(first, text.find('\n', first) - first);
        EXPECT_LE(shown.size(), 104U) << column;
        const std::size_t second = text.find("      | ") + 8;
        const std::size_t caret = text.find('^') - second;
        // The character over the caret is the one meant; a cut is one column wide and three bytes long.
        const std::size_t at = shown.starts_with("…") ? caret + 2 : caret;
        if (column <= 100000) {
            ASSERT_LT(at, shown.size()) << text;
            EXPECT_EQ(shown[at], line[static_cast<std::size_t>(column - 1)]) << column;
        } else {
            EXPECT_EQ(at, shown.size());
        }
    }
}

TEST(RenderText, ManyPlacesOnALongLineCostOnePass) {
    // 20 000 questions about one line of 20 MB: 0.4 TB to look at unless the finder remembers where it is.
    const std::string line(20'000'000, 'x');
    PlaceFinder finder(line);
    std::size_t start = 0;
    std::size_t caret = 0;
    for (int i = 1; i <= 20000; ++i) {
        ASSERT_TRUE(finder.find({1, i * 1000}, start, caret));
        ASSERT_EQ(caret, static_cast<std::size_t>(i) * 1000 - 1);
    }
    ASSERT_TRUE(finder.find({1, 3}, start, caret));
    EXPECT_EQ(caret, 2U);
}

TEST(RenderText, GoingBackAndForthOnALongLineCostsNoPass) {
    // 4000 times from one end of 20 MB to the other: 80 GB to look at unless places on the way are
    // remembered.
    const std::string text = "first\n" + std::string(20'000'000, 'x') + "\nlast";
    PlaceFinder finder(text);
    std::size_t start = 0;
    std::size_t caret = 0;
    for (int i = 1; i <= 4000; ++i) {
        const int column = i % 2 == 0 ? i : 20'000'000 - i;
        ASSERT_TRUE(finder.find({2, column}, start, caret));
        ASSERT_EQ(start, 6U);
        ASSERT_EQ(caret, static_cast<std::size_t>(column) + 5);
        if (i % 100 != 0) continue;
        ASSERT_TRUE(finder.find({1, 2}, start, caret));
        ASSERT_EQ(caret, 1U);
        ASSERT_TRUE(finder.find({3, 4}, start, caret));
        ASSERT_EQ(start, 20'000'007U);
        ASSERT_EQ(caret, 20'000'010U);
    }
}

TEST(RenderShort, IsOneLine) {
    Diagnostics diagnostics("");
    diagnostics.error(kCode, {}, "wrong").hint("h").with({1, 1}, "there");
    EXPECT_EQ(render_short(diagnostics.sorted().front()), "popupc: error: wrong [unreadable-input]\n");
}

TEST(RenderJson, IsOneObjectALineWithNullForWhatThereIsNot) {
    Diagnostics diagnostics("f.xml");
    diagnostics.warning(kCode, {3, 4}, "a \"b\"\n\xff")
        .hint("h")
        .about("e1")
        .changed("1", "2")
        .with({7, 8}, "\"fire\"")
        .with({}, "the page");
    diagnostics.remark(kCode, {}, "plain");
    const auto all = diagnostics.sorted();
    const std::string line = render_json(all[0]);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["file"], "f.xml");
    EXPECT_EQ(json["line"], 3);
    EXPECT_EQ(json["column"], 4);
    EXPECT_EQ(json["severity"], "warning");
    EXPECT_EQ(json["code"], kCode);
    EXPECT_EQ(json["element"], "e1");
    EXPECT_EQ(json["hints"], nlohmann::json({"h"}));
    EXPECT_EQ(json["before"], "1");
    EXPECT_EQ(json["after"], "2");
    EXPECT_EQ(json["related"], nlohmann::json::parse(R"([{"line": 7, "column": 8, "text": "\"fire\""},
                                                        {"line": null, "column": null, "text": "the page"}])"));
    const auto bare = nlohmann::json::parse(render_json(all[1]));
    for (const char* key : {"line", "column", "element", "before", "after"})
        EXPECT_TRUE(bare[key].is_null()) << key;
    EXPECT_FALSE(bare.contains("related"));
}

}  // namespace
}  // namespace popup
