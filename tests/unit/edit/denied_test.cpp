// What a policy denies is refused, be it found by the checks or where plates move.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "edit/denied_of_drawing.h"
#include "popup/edit.h"
#include "popup/edit_drawing.h"
#include "support/designs.h"
#include "unit/edit/drawing_edits.h"

namespace popup::test {
namespace {

constexpr const char* kTent = R"(<popup version="3.0" units="mm">
  <mainpage width="200" height="140"/>
  <structurelist>
    <structure type="tent" id="t">
      <outerpoints>
        <point x="-20" y="-15"/> <point x="-20" y="15"/> <point x="20" y="-15"/> <point x="20" y="15"/>
        <point x="-28" y="-15"/> <point x="-28" y="15"/> <point x="28" y="-15"/> <point x="28" y="15"/>
      </outerpoints>
      <parentfold on="gutter"/>
    </structure>
  </structurelist>
</popup>
)";
constexpr const char* kInTheTent = "add v-fold --id v --at 0 --width 60 --height 50";

struct Denied {
    Edited edited;
    std::string of_edits, of_document;
    int line = 0;  // of the edits, at which it is refused
};

Denied edited(const std::string& text, const std::string& edits, const DiagnosticPolicy& policy, bool all) {
    Diagnostics of_edits("edits.txt");
    Diagnostics of_document("card.xml", policy);
    const CompileOptions compile;
    EditOptions options;
    if (all) options.all = &compile;
    const auto done =
        edit_document({"card.xml", text}, read_edits(edits, of_edits), options, of_edits, of_document);
    EXPECT_TRUE(done) << findings(of_edits);
    const auto said = of_edits.sorted();
    return {done.value_or(Edited()), findings(of_edits), findings(of_document),
            said.empty() ? 0 : said.front().place.line};
}

TEST(DeniedEdits, AreThoseThatMakeACollision) {
    const Denied denied = edited(kTent, kInTheTent, {{"collision"}, {}, false}, true);
    EXPECT_TRUE(denied.edited.refused);
    EXPECT_NE(denied.of_document.find("goes through"), std::string::npos) << denied.of_document;
    EXPECT_NE(denied.of_document.find("error"), std::string::npos) << denied.of_document;
    EXPECT_NE(denied.of_edits.find("edit-refused"), std::string::npos) << denied.of_edits;
    EXPECT_TRUE(edited(kTent, kInTheTent, {{}, {}, true}, true).edited.refused);
    // Without a policy it is told.
    const Denied told = edited(kTent, kInTheTent, {}, true);
    EXPECT_FALSE(told.edited.refused);
    EXPECT_TRUE(told.edited.examined);
    EXPECT_NE(told.of_document.find("goes through"), std::string::npos) << told.of_document;
    // Where nobody looks, that is known.
    EXPECT_FALSE(edited(kTent, kInTheTent, {}, false).edited.examined);
}

TEST(DeniedEdits, AreNotThoseOfWhatWasThereBefore) {
    const std::string both = edited(kTent, kInTheTent, {}, true).edited.text;
    const DiagnosticPolicy deny{{"collision"}, {}, true};
    const Denied moved = edited(both, "set t --left-color gold", deny, true);
    EXPECT_FALSE(moved.edited.refused) << moved.of_document;
    const Denied small = edited(both, "add beak --id b --at -55 --width 6", deny, true);
    EXPECT_FALSE(small.edited.refused) << small.of_document;
    EXPECT_EQ(small.of_document, "");
}

// The line that brings what is denied is named, not the first one.
TEST(DeniedEdits, AreToldAtTheLineThatBringsThem) {
    const Denied denied =
        edited(kTent, std::string("set t --width 41\n") + kInTheTent + "\nset t --width 40\n",
               {{"collision"}, {}, false}, true);
    EXPECT_TRUE(denied.edited.refused);
    EXPECT_EQ(denied.line, 2) << denied.of_edits;
}

// The wall leans then, and its fold goes by another angle.
Denied leaned(const DiagnosticPolicy& policy, bool force) {
    Diagnostics of_edits("edits.txt");
    Diagnostics of_document("box.svg", policy);
    DrawingEditOptions options;
    options.force = force;
    const std::vector<EditLine> lines{{words_of("extrude back --by 1"), {1, 1}},
                                      {words_of("edge front.1-2 --by 0,-10,0"), {2, 1}}};
    const auto done = edit_drawing({"box.svg", kTray}, lines, options, of_edits, of_document);
    EXPECT_TRUE(done) << findings(of_edits);
    const auto said = of_edits.sorted();
    return {done.value_or(Edited()), findings(of_edits), findings(of_document),
            said.empty() ? 0 : said.front().place.line};
}

TEST(DeniedEdits, OfDrawingsAreThoseThatFindIt) {
    const Denied denied = leaned({{"folds-turn"}, {}, false}, false);
    EXPECT_TRUE(denied.edited.refused);
    EXPECT_NE(denied.of_document.find("error"), std::string::npos) << denied.of_document;
    EXPECT_NE(denied.of_edits.find("edit-refused"), std::string::npos) << denied.of_edits;
    EXPECT_EQ(denied.line, 2);
    EXPECT_FALSE(leaned({}, false).edited.refused);
    EXPECT_FALSE(leaned({{"folds-turn"}, {}, false}, true).edited.refused);
    EXPECT_FALSE(leaned({{"collision"}, {}, true}, false).edited.refused);
}

TEST(DeniedEdits, OfDrawingsAreThoseOfWhatIsFoundOfTheSheet) {
    const std::string tray = kTray;
    std::string dangling = tray;
    const std::string fold = R"(<path class="mountain" stroke="#ff0000" d="M60 60H90"/>)";
    dangling.insert(dangling.rfind("</g>"), fold);
    std::string two = dangling;
    two.insert(two.rfind("</g>"), R"(<path class="mountain" stroke="#ff0000" d="M60 70H90"/>)");
    const auto brings = [](const std::string& before, const std::string& after,
                           const DiagnosticPolicy& policy) {
        Diagnostics told("box.svg", policy);
        const bool any = edit::brings_denied({"box.svg", before}, after, {}, told);
        EXPECT_EQ(any, told.has_errors()) << findings(told);
        return any;
    };
    const DiagnosticPolicy deny{{"dangling-fold"}, {}, false};
    EXPECT_TRUE(brings(tray, dangling, deny));
    EXPECT_TRUE(brings(tray, dangling, {{}, {}, true}));
    EXPECT_FALSE(brings(tray, dangling, {{"collision"}, {}, false}));
    EXPECT_FALSE(brings(tray, dangling, {}));
    EXPECT_FALSE(brings(dangling, dangling, deny));
    EXPECT_FALSE(brings(dangling, tray, deny));
    EXPECT_TRUE(brings(dangling, two, deny));
}

}  // namespace
}  // namespace popup::test
