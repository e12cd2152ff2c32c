// Hints that name a change that was tried: whoever obeys them word for word no longer sees the finding.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "popup/edit.h"
#include "popup/files.h"
#include "support/sanitized.h"

namespace popup {
namespace {

constexpr std::string_view kCommand = "popupc edit … ";

std::vector<Diagnostic> findings_of(const Source& source) {
    CompileOptions options;
    options.until = Stage::pattern;
    options.fitting_size = fitting_size;
    options.clearing_move = clearing_move;
    options.move_command = move_command;
    options.move_holds = move_holds;
    const Compilation run = compile({source}, options, {});
    std::vector<Diagnostic> found;
    for (const Diagnostic& one : run.designs.front().diagnostics.sorted()) {
        if (one.severity != Severity::remark) found.push_back(one);
    }
    return found;
}

// The edits that the finding's hints name, each of which mends it.
std::vector<std::vector<std::string>> edits_of(const Diagnostic& finding) {
    std::vector<std::vector<std::string>> edits;
    for (const std::string& hint : finding.hints) {
        const std::size_t at = hint.find(kCommand);
        if (at == std::string::npos) continue;
        std::istringstream words(hint.substr(at + kCommand.size()));
        edits.push_back({std::istream_iterator<std::string>(words), {}});
    }
    return edits;
}

// The first of them; empty: none.
std::vector<std::string> edit_of(const Diagnostic& finding) {
    const auto edits = edits_of(finding);
    return edits.empty() ? std::vector<std::string>() : edits.front();
}

std::optional<Source> edited(const Source& source, const std::vector<std::string>& words) {
    const EditLine edit{words, {}};
    Diagnostics told(source.name);
    const auto done = edit_document(source, {&edit, 1}, {}, told, told);
    if (!done || done->refused) return std::nullopt;
    return Source{source.name, done->text};
}

// What obeying the finding makes of the document.
Source obeyed(const Source& source, const Diagnostic& finding) {
    const auto changed = edited(source, edit_of(finding));
    EXPECT_TRUE(changed) << finding.message;
    return changed.value_or(source);
}

// Whether its hints tell a move, such as: moving "back" 6.99 mm along its fold, ...
bool tells_move(const Diagnostic& finding) {
    return std::any_of(finding.hints.begin(), finding.hints.end(),
                       [](const std::string& hint) { return hint.starts_with("moving \""); });
}

// What a finding is of, whatever its numbers.
std::vector<std::string> told_of(const Diagnostic& finding) {
    std::vector<std::string> words{finding.code, finding.element};
    for (const Related& other : finding.related) words.push_back(other.text);
    return words;
}

// This finding is gone, and no other element is in trouble, or in trouble of another kind.
void expect_mended(const Source& before, const Source& after, const Diagnostic& finding) {
    const std::vector<Diagnostic> old = findings_of(before);
    for (const Diagnostic& left : findings_of(after)) {
        EXPECT_FALSE(told_of(left) == told_of(finding)) << before.name << ": " << left.message;
        EXPECT_TRUE(std::any_of(
            old.begin(), old.end(),
            [&](const Diagnostic& one) { return one.code == left.code && one.element == left.element; }))
            << before.name << ": " << left.message;
    }
}

std::vector<Source> documents_of_cases() {
    std::vector<Source> all;
    const std::filesystem::path cases = std::filesystem::path(POPUP_SOURCE_DIR) / "tests" / "cases";
    std::vector<std::string> names;  // in an order that every file system has
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cases)) {
        if (entry.path().extension() == ".xml") names.push_back(entry.path().string());
    }
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
        Diagnostics unheard;
        if (auto source = read_source(name, unheard)) all.push_back(*std::move(source));
    }
    return all;
}

// A card with one element.
Source card_with(const std::string& element) {
    return {"card.xml",
            "<popup version=\"3.0\" units=\"mm\">\n  <mainpage width=\"200\" height=\"140\"/>\n  "
            "<structurelist>\n" +
                element + "  </structurelist>\n</popup>\n"};
}

TEST(TriedHints, OfEveryCaseHoldWhatTheyPromise) {
    int sizes = 0;
    int moves = 0;
    std::size_t number = 0;
    for (const Source& source : documents_of_cases()) {
        if (number++ % (test::kSanitized ? 4 : 1) != 0) continue;
        for (const Diagnostic& finding : findings_of(source)) {
            bool moves_it = false;
            for (const std::vector<std::string>& words : edits_of(finding)) {
                moves_it = moves_it || words.front() == "move";
                ++(words.front() == "move" ? moves : sizes);
                const auto changed = edited(source, words);
                ASSERT_TRUE(changed) << source.name << ": " << finding.message;
                expect_mended(source, *changed, finding);
            }
            EXPECT_EQ(moves_it, tells_move(finding)) << source.name << ": " << finding.message;
        }
    }
    EXPECT_GE(sizes, test::kSanitized ? 0 : 4);  // few cases have any
    EXPECT_GE(moves, test::sanitized_count(10, 4));
}

TEST(FittingSize, ADiscIsMadeAsSmallAsItMustBe) {
    // Its middle is 35 mm from the edge of the card.
    const Source card = card_with(R"(    <structure type="disc" id="moon" radius="40">
      <outerpoints><point x="65" y="0"/><point x="65" y="0"/></outerpoints>
      <parentplate page="0" x="50" y="0"/>
    </structure>
)");
    const std::vector<Diagnostic> found = findings_of(card);
    ASSERT_EQ(found.size(), 1U) << (found.empty() ? "" : found.front().message);
    const std::vector<std::string> words = edit_of(found.front());
    ASSERT_EQ(words.size(), 4U);
    EXPECT_EQ(words[1] + words[2], "moon--radius");
    EXPECT_NEAR(std::stod(words[3]), 35.0, 0.1);
    EXPECT_LE(std::stod(words[3]), 35.02);
}

TEST(FittingSize, LengthsAreInTheUnitOfTheDocument) {
    const Source card{"card.xml", R"(<popup version="3.0" units="in">
  <mainpage width="8" height="5"/>
  <structurelist>
    <structure type="disc" id="moon" radius="1.5">
      <outerpoints><point x="3" y="0"/><point x="3" y="0"/></outerpoints>
      <parentplate page="0" x="2" y="0"/>
    </structure>
  </structurelist>
</popup>
)"};
    const std::vector<Diagnostic> found = findings_of(card);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().hints.front(),
              "a radius of 1.00 in, not 1.50 in, keeps it inside the closed card: popupc edit … set moon "
              "--radius 1.00in");
    EXPECT_TRUE(findings_of(obeyed(card, found.front())).empty());
}

// Tents on the gutter, each from one y to another.
Source card_of_tents(std::initializer_list<std::pair<int, int>> tents) {
    std::string text = R"(<popup version="3.0" units="mm">
  <mainpage width="200" height="200"/>
  <structurelist>
)";
    char id = 'a';
    for (const auto& [from, to] : tents) {
        text += fmt::format("    <structure type=\"tent\" id=\"{}\"><outerpoints>\n", id++);
        for (const int x : {25, 36}) {
            for (const int side : {-x, x})
                text += fmt::format(R"(<point x="{0}" y="{1}"/><point x="{0}" y="{2}"/>)", side, from, to);
        }
        text += R"(</outerpoints><parentfold><begin x="0" y="-100"/><end x="0" y="100"/></parentfold>
    </structure>
)";
    }
    return {"card.xml", text + "  </structurelist>\n</popup>\n"};
}

// The hints of all `glue-overlaps`.
std::vector<std::string> clearing_hints(const Source& card) {
    std::vector<std::string> hints;
    for (const Diagnostic& one : findings_of(card)) {
        if (one.code == "glue-overlaps") hints.insert(hints.end(), one.hints.begin(), one.hints.end());
    }
    return hints;
}

TEST(ClearingMove, IsTheShorterWay) {
    EXPECT_EQ(
        clearing_hints(card_of_tents({{-60, -40}, {-46, -26}})),
        (std::vector<std::string>{
            "moving \"b\" 6.00 mm along its fold, by (0.00, 6.00) mm on the page, keeps its tabs clear of "
            "all others: popupc edit … move b --along=6.00mm --follow"}));
    const Source back = card_of_tents({{-60, -20}, {-67, -47}});
    EXPECT_EQ(
        clearing_hints(back),
        (std::vector<std::string>{
            "moving \"b\" 13.00 mm along its fold, by (0.00, -13.00) mm on the page, keeps its tabs clear "
            "of all others: popupc edit … move b --along=-13.00mm --follow"}));
    for (const Diagnostic& finding : findings_of(back)) {
        if (finding.code != "glue-overlaps") continue;
        EXPECT_TRUE(findings_of(obeyed(back, finding)).empty());
    }
}

// 6 mm would bring it on the third one; the other way is free, and not beyond the page.
TEST(ClearingMove, GoesPastAThird) {
    const Source card = card_of_tents({{-60, -40}, {-46, -26}, {-22, -2}});
    const std::vector<std::string> hints = clearing_hints(card);
    ASSERT_EQ(hints.size(), 1U);
    EXPECT_NE(hints[0].find("move b --along=-34.00mm --follow"), std::string::npos) << hints[0];
}

TEST(ClearingMove, NoneIsToldWhereNoneWorks) {
    const std::string all_over =
        "move \"b\" along the fold it stands on until its tab 2L is clear of tab 1L of "
        "\"a\" and of those of all others";
    EXPECT_EQ(clearing_hints(card_of_tents({{-80, 80}, {-90, 90}})), (std::vector<std::string>{all_over}));
}

// A dozen in trouble cost no more than three.
TEST(ClearingMove, IsTriedOfAFewElements) {
    std::size_t asked = 0;
    CompileOptions options;
    options.until = Stage::pattern;
    options.clearing_move = [&](const auto&, const auto&, const auto&) {
        ++asked;
        return std::optional<std::string>();
    };
    const Source card = card_of_tents({{-90, -80},
                                       {-85, -75},
                                       {-70, -60},
                                       {-65, -55},
                                       {-50, -40},
                                       {-45, -35},
                                       {-30, -20},
                                       {-25, -15},
                                       {-10, 0},
                                       {-5, 5},
                                       {10, 20},
                                       {15, 25}});
    const Compilation run = compile({card}, options, {});
    const auto found = run.designs.front().diagnostics.sorted();
    EXPECT_EQ(std::count_if(found.begin(), found.end(),
                            [](const Diagnostic& one) { return one.code == "glue-overlaps"; }),
              6);
    EXPECT_EQ(asked, 3U);
}

TEST(ClearingMove, OnlyElementsOfDocumentsHaveOne) {
    CompiledDesign one;
    one.source = card_of_tents({{-60, -40}, {-46, -26}});
    Diagnostics told("card.xml");
    one.design = read_design(one.source, {}, told);
    one.checked = check(*one.design, {}, told);
    one.assembly = assemble(*one.checked, {}, told);
    EXPECT_NE(clearing_move(one, {}, "b"), std::nullopt);
    EXPECT_EQ(clearing_move(one, {}, "nobody"), std::nullopt);
    one.source.name = "card.fl";
    EXPECT_EQ(clearing_move(one, {}, "b"), std::nullopt);
}

TEST(FittingSize, OnlyElementsOfDocumentsHaveThem) {
    CompiledDesign one;
    one.source = card_with("");
    Diagnostics told("card.xml");
    one.checked = check(*read_design(one.source, {}, told), {}, told);
    EXPECT_EQ(fitting_size(one, {}, "nobody", 10.0), std::nullopt);
    one.source.name = "card.fl";
    EXPECT_EQ(fitting_size(one, {}, "nobody", 10.0), std::nullopt);
}

}  // namespace
}  // namespace popup
