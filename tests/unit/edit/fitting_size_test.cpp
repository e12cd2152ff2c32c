// Sizes that hints of protrusions name: obeyed word for word, the element stays inside the closed card.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "popup/edit.h"
#include "popup/files.h"

namespace popup {
namespace {

constexpr std::string_view kCommand = "popupc edit … ";

std::vector<Diagnostic> findings_of(const Source& source) {
    CompileOptions options;
    options.until = Stage::motion;
    options.fitting_size = fitting_size;
    const Compilation run = compile({source}, options, {});
    std::vector<Diagnostic> found;
    for (const Diagnostic& one : run.designs.front().diagnostics.sorted()) {
        if (one.severity != Severity::remark) found.push_back(one);
    }
    return found;
}

// The edit that the finding's hints name; empty: none.
std::vector<std::string> edit_of(const Diagnostic& finding) {
    for (const std::string& hint : finding.hints) {
        const std::size_t at = hint.find(kCommand);
        if (at == std::string::npos) continue;
        std::istringstream words(hint.substr(at + kCommand.size()));
        return {std::istream_iterator<std::string>(words), {}};
    }
    return {};
}

// What obeying the finding makes of the document.
Source obeyed(const Source& source, const Diagnostic& finding) {
    const EditLine edit{edit_of(finding), {}};
    Diagnostics told(source.name);
    const auto edited = edit_document(source, {&edit, 1}, {}, told, told);
    EXPECT_TRUE(edited && !edited->refused) << finding.message;
    Source changed = source;
    if (edited) changed.text = edited->text;
    return changed;
}

bool is_same(const Diagnostic& a, const Diagnostic& b) { return a.code == b.code && a.element == b.element; }

// A card with one element.
Source card_with(const std::string& element) {
    return {"card.xml",
            "<popup version=\"3.0\" units=\"mm\">\n  <mainpage width=\"200\" height=\"140\"/>\n  "
            "<structurelist>\n" +
                element + "  </structurelist>\n</popup>\n"};
}

TEST(FittingSize, EveryOneOfTheCasesHoldsWhatItPromises) {
    const std::filesystem::path cases = std::filesystem::path(POPUP_SOURCE_DIR) / "tests" / "cases";
    int obeyed_sizes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cases)) {
        if (entry.path().extension() != ".xml") continue;
        Diagnostics unheard;
        const auto source = read_source(entry.path().string(), unheard);
        if (!source) continue;
        for (const Diagnostic& finding : findings_of(*source)) {
            if (finding.code != "protrusion" || edit_of(finding).empty()) continue;
            ++obeyed_sizes;
            const std::vector<Diagnostic> before = findings_of(*source);
            for (const Diagnostic& left : findings_of(obeyed(*source, finding))) {
                EXPECT_FALSE(is_same(left, finding)) << entry.path() << ": " << left.message;
                EXPECT_TRUE(std::any_of(before.begin(), before.end(),
                                        [&](const Diagnostic& one) { return is_same(one, left); }))
                    << entry.path() << ": " << left.message;
            }
        }
    }
    EXPECT_GE(obeyed_sizes, 4);
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
    EXPECT_EQ(
        found.front().hints.front(),
        "with a radius of 1.00 in in place of 1.50 in it stays inside the closed card: popupc edit … set "
        "moon --radius 1.00in");
    EXPECT_TRUE(findings_of(obeyed(card, found.front())).empty());
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
