// Elements that are added with no more than what they stand on.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "popup/compile.h"
#include "popup/edit.h"
#include "support/designs.h"

namespace popup::test {
namespace {

constexpr const char* kBlank =
    "<popup version=\"3.0\" units=\"mm\">\n  <mainpage width=\"260\" height=\"200\"/>\n"
    "  <structurelist>\n  </structurelist>\n</popup>\n";

struct Added {
    std::string text;     // empty: refused
    std::string refusal;  // what was said then
};

Added added(const std::string& document, const std::string& edit) {
    Diagnostics of_edits("edits.txt");
    Diagnostics of_document("card.xml");
    const auto edited =
        edit_document({"card.xml", document}, read_edits(edit, of_edits), {}, of_edits, of_document);
    if (!edited || edited->refused) return {{}, findings(of_edits) + findings(of_document)};
    return {edited->text, {}};
}

// Warnings and errors, those of the motion and of tabs too; that a disc is turned by hand is only remarked.
std::string found_in(const std::string& text) {
    const Compilation all = compile({{"card.xml", text}}, {}, {});
    const Diagnostics& found = all.designs.front().diagnostics;
    return found.has_findings() ? findings(found) : std::string();
}

struct Ground {
    const char* first;  // what carries it
    const char* on;
    bool seam, plate;
};
constexpr Ground kGrounds[] = {
    {"", "gutter", false, false},
    {"add v-fold --id bird", "bird.centre", false, false},
    {"add v-fold --id bird", "bird.left", true, false},
    {"add v-fold --id bird", "bird.right", true, false},
    {"add tent --id roof", "roof.centre", false, false},
    {"add tent --id roof", "roof.left", true, false},
    {"add tent --id roof", "roof.right", true, false},
    {"", "page.left", false, true},
    {"add v-fold --id bird", "bird.left", false, true},
    {"add v-fold --id bird", "bird.right", false, true},
    {"add tent --id roof", "roof.left", false, true},
    {"add tent --id roof", "roof.right", false, true},
};

// Each row of the table on all that it can stand on; cuts of a seam are refused, with what can stand there.
TEST(Defaults, MakeCardsWithoutFindings) {
    for (const Ground& ground : kGrounds) {
        const std::string card = *ground.first == 0 ? kBlank : added(kBlank, ground.first).text;
        ASSERT_FALSE(card.empty());
        for (const ElementInfo& row : element_table()) {
            if (row.grounds.page || row.grounds.plate != ground.plate) continue;
            const std::string edit =
                "add " + std::string(row.name) + " --id new --on " + std::string(ground.on);
            SCOPED_TRACE(edit);
            const Added made = added(card, edit);
            if (made.text.empty()) {
                EXPECT_TRUE(ground.seam && !row.grounds.seam &&
                            made.refusal.find("cut-on-seam") != made.refusal.npos)
                    << made.refusal;
                continue;
            }
            EXPECT_EQ(found_in(made.text), "");
        }
    }
}

// What has several plates is called otherwise in the assembly.
TEST(Defaults, FindRoomOnPlatesOfSeveral) {
    const std::string card =
        added(added(kBlank, "add floating-layer --id deck --at 40").text, "add box --id house --at -40").text;
    ASSERT_FALSE(card.empty());
    for (const std::string on :
         {"deck.left", "deck.topleft", "deck.topright", "house.left", "house.frontleft", "house.frontright",
          "house.backleft", "house.backright"}) {
        SCOPED_TRACE(on);
        const Added made = added(card, "add attached-plane --id sign --on " + on);
        ASSERT_FALSE(made.text.empty()) << made.refusal;
        EXPECT_EQ(found_in(made.text), "");
    }
}

// Shares of a short fold alone would leave nothing of tabs.
TEST(Defaults, HaveTabsThatHoldOnShortFolds) {
    const auto card_of = [](int height_mm) {
        return "<popup version=\"3.0\" units=\"mm\">\n  <mainpage width=\"200\" height=\"" +
               std::to_string(height_mm) + "\"/>\n  <structurelist>\n  </structurelist>\n</popup>\n";
    };
    for (const auto& [type, from_mm] :
         {std::pair{"tent", 15}, {"layer", 15}, {"box", 20}, {"v-fold", 30}, {"floating-layer", 20}}) {
        for (int height_mm = from_mm; height_mm <= 100; height_mm += 5) {
            SCOPED_TRACE(std::string(type) + " on " + std::to_string(height_mm));
            const Added made =
                added(card_of(height_mm), "add " + std::string(type) + " --id new --on gutter");
            EXPECT_EQ(made.text.empty() ? made.refusal : found_in(made.text), "");
        }
    }
}

// What is glued on a plate already leaves less of it.
TEST(Defaults, LeaveWhatIsThereAlone) {
    std::string card = kBlank;
    for (const char* edit : {"add attached-plane --on page.left", "add attached-plane --on page.left"}) {
        card = added(card, edit).text;
        ASSERT_FALSE(card.empty());
    }
    EXPECT_EQ(found_in(card), "");
}

// The form follows the fold, and the id says which it is.
TEST(Defaults, HaveTheFormOfTheFold) {
    const std::string card = added(kBlank, "add v-fold --id bird").text;
    const Added sunk = added(card, "add step --on bird.centre");
    EXPECT_NE(sunk.text.find("type=\"inverted-step\" id=\"inverted-step\""), std::string::npos) << sunk.text;
    const Added raised = added(card, "add inverted-step --on gutter --at 60 --room 60");
    EXPECT_NE(raised.text.find("type=\"step\" id=\"step\""), std::string::npos) << raised.text;
}

}  // namespace
}  // namespace popup::test
