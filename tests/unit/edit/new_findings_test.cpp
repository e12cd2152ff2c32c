// What edits tell of a document is what they have made of it, and nothing else.
#include <gtest/gtest.h>

#include <string>

#include "popup/edit.h"
#include "support/designs.h"

namespace popup::test {
namespace {

struct Told {
    std::string findings;  // of the document
    std::string text;
    bool refused = false;
};

Told told(const std::string& document, const std::string& edit) {
    Diagnostics of_edits("edits.txt");
    Diagnostics of_document("card.xml");
    const auto edited =
        edit_document({"card.xml", document}, read_edits(edit, of_edits), {}, of_edits, of_document);
    EXPECT_TRUE(edited) << findings(of_edits);
    Told made;
    made.findings = findings(of_document);
    if (edited) made.text = edited->text;
    made.refused = edited && edited->refused;
    return made;
}

std::string card(const std::string& structures) {
    return "<popup version=\"3.0\" units=\"mm\">\n  <mainpage width=\"280\" height=\"216\"/>\n  "
           "<structurelist>\n" +
           structures + "  </structurelist>\n</popup>\n";
}

constexpr const char* kFloating = R"(    <structure type="step" id="step">
      <outerpoints>
        <point x="-42" y="-16"/> <point x="-42" y="32"/>
        <point x="47" y="-18"/> <point x="47" y="34"/>
      </outerpoints>
      <parentfold page="0"><begin x="0" y="-108"/><end x="0" y="108"/></parentfold>
    </structure>
    <structure type="floating-layer" id="layer" height="2.7">
      <outerpoints>
        <point x="0" y="14"/> <point x="0" y="3"/> <point x="9" y="14"/> <point x="9" y="3"/>
      </outerpoints>
      <parentfold page="0"><begin x="5" y="-17"/><end x="5" y="33"/></parentfold>
    </structure>
)";
constexpr const char* kHole = R"(    <structure type="hole" id="hole">
      <outline d="M 55 85 h 10 v 10 h -10 Z"/>
    </structure>
)";
constexpr const char* kFlag = R"(    <structure type="attached-plane" id="flag" side="front">
      <outerpoints>
        <point x="60" y="AT"/> <point x="60" y="TO"/> <point x="0" y="0"/> <point x="0" y="10"/>
      </outerpoints>
      <outline d="M -10 -10 H 10 V 10 H -10 Z"/>
      <parentplate page="0" x="60" y="AT"/>
    </structure>
)";

std::string flag_at(int y) {
    std::string made = kFlag;
    for (std::size_t at = made.find("AT"); at != std::string::npos; at = made.find("AT"))
        made.replace(at, 2, std::to_string(y));
    made.replace(made.find("TO"), 2, std::to_string(y + 10));
    return made;
}

// A card that has an error is not moved, and what would have been found there is not known: once the error is
// gone, all of it is new.
TEST(NewFindings, AreOfTheWholeCardWhereAnErrorHidThem) {
    const std::string bad = card(flag_at(100) + kFloating + kHole);
    const std::string told_before = told(bad, "set step --left-color gold").findings;
    EXPECT_EQ(told_before, "") << "the hole through what is glued is no new error";
    const Told mended = told(bad, "move flag --y=-40");
    EXPECT_FALSE(mended.refused);
    EXPECT_NE(mended.findings.find("not-forced"), std::string::npos) << mended.findings;
    // Nothing hid it here.
    EXPECT_EQ(told(card(flag_at(40) + kFloating + kHole), "move flag --y=-2").findings, "");
}

std::string beak(const char* id, int y) {
    const auto point = [](int x, int at) {
        return "<point x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(at) + "\"/>";
    };
    return std::string("    <structure type=\"beak\"") + id + ">\n      <outerpoints>" + point(0, y) +
           point(-8, y - 8) + point(8, y - 8) +
           "</outerpoints>\n      <parentfold page=\"0\"><begin x=\"0\" y=\"-108\"/><end x=\"0\" "
           "y=\"108\"/></parentfold>\n    </structure>\n";
}

// Elements without an id are called by their numbers, which change with what goes before them.
TEST(NewFindings, KnowWhatIsCalledByItsNumber) {
    const std::string bad = card(beak("", -40) + beak("", 20) + beak("", 400));
    const Told gone = told(bad, "delete e1");
    EXPECT_EQ(gone.findings, "");
    EXPECT_FALSE(gone.refused);
    const Told named = told(bad, "rename e3 far");
    EXPECT_EQ(named.findings, "");
    EXPECT_FALSE(named.refused);
    // One more of the kind is new all the same.
    EXPECT_TRUE(told(bad, "move e2 --along 380").refused);
}

// What stands on the page of a piece that is taken out has no page any more: reading says so, and nothing is
// checked.
TEST(NewFindings, AreThoseOfReadingWhereAPageIsGone) {
    const std::string tent = R"(    <structure type="tent" id="tent">
      <outerpoints>
        <point x="-20" y="0"/> <point x="-20" y="40"/> <point x="20" y="0"/> <point x="20" y="40"/>
        <point x="-30" y="0"/> <point x="-30" y="40"/> <point x="30" y="0"/> <point x="30" y="40"/>
      </outerpoints>
      <parentfold page="0"><begin x="0" y="-108"/><end x="0" y="108"/></parentfold>
    </structure>
)";
    std::string on_it = beak(" id=\"beak\"", 20);
    // Beside its folds, so that nothing is known to carry it.
    const std::string fold = R"(page="0"><begin x="0" y="-108"/><end x="0")";
    on_it.replace(on_it.find(fold), fold.size(), R"(page="1"><begin x="90" y="-108"/><end x="90")");
    const Told gone = told(card(tent + on_it), "delete tent");
    EXPECT_TRUE(gone.refused);
    EXPECT_EQ(gone.findings.find("page-not-there"), std::string::npos) << gone.findings;
    EXPECT_NE(gone.findings.find("bad-page"), std::string::npos) << gone.findings;
}

}  // namespace
}  // namespace popup::test
