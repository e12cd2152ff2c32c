// Copies, and what is drawn about an apex: an element has its shape wherever it is put.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "popup/edit.h"
#include "support/designs.h"

namespace popup::test {
namespace {

using nlohmann::json;

// The document after the edits, one a line; what is wrong with it is a failure.
std::string after(const std::string& document, const std::string& edits) {
    Diagnostics trouble("edits.txt");
    Diagnostics of_document("card.xml");
    const auto made =
        edit_document({"card.xml", document}, read_edits(edits, trouble), {}, trouble, of_document);
    EXPECT_TRUE(made && !made->refused) << edits << "\n" << findings(trouble) << findings(of_document);
    return made ? made->text : std::string();
}

json one(const std::string& document, const std::string& id) {
    Diagnostics trouble;
    const auto design = read_design({"card.xml", document}, {}, trouble);
    EXPECT_TRUE(design) << findings(trouble);
    if (!design) return {};
    const json card = json::parse(show_json(*design, {id, false}, trouble).value());
    return card["elements"].empty() ? json() : card["elements"][0];
}

std::string card_with(const std::string& element) {
    Diagnostics trouble;
    NewCard wanted;
    wanted.width_mm = 400.0;
    wanted.height_mm = 300.0;
    return after(new_document(wanted, trouble).value(), "add " + element);
}

// Its apex at (0, 0) is that of an element that is there, and not of one that is still to be made.
TEST(Copies, WhatIsDrawnStaysAboutAnApexAtZero) {
    const std::string card = card_with("v-fold-cut --id bird");
    EXPECT_EQ(one(card, "bird")["points"]["A"], json({0.0, 0.0}));
    for (const char* edit : {"set bird --at 12", "set bird --length 50", "set bird --width 70",
                             "set bird --turn 9", "move bird --to 30\nset bird --at 0"}) {
        SCOPED_TRACE(edit);
        after(card, edit);
    }
    EXPECT_EQ(after(after(card, "set bird --at 12"), "set bird --at 0"), card);
    const std::string copied =
        after(card, "set bird --length 40 --width 40\ncopy bird --step 60 --ids second");
    EXPECT_EQ(one(copied, "second")["measures"]["at"], 60.0);
}

// On a fold that begins elsewhere.
TEST(Copies, WhatIsDrawnAboutAnApexGoesToAnotherFold) {
    const std::string card = card_with(
        "v-fold --id v --at -100 --width 160 --height 80 --angle 110 --lean 60\n"
        "add v-fold-cut --id bird --width 20 --length 20 --at 70");
    const std::string copied = after(card, "copy bird --on v.centre --step -80 --ids second");
    const json made = one(copied, "second");
    EXPECT_EQ(made["on"], "v.centre");
    EXPECT_EQ(made["points"]["A"], json({0.0, -10.0}));
    EXPECT_EQ(made["values"]["outline"], "M 0 -10 L -10 2 L -8 10 L 0 4 L 8 10 L 10 2 Z");
}

// A window is cut where the disc behind it is.
TEST(Copies, AWindowGoesWithItsDisc) {
    const std::string card =
        card_with("disc --id wheel --x 90 --y 40 --radius 30 --window 'M 80 50 L 100 50 L 100 60 L 80 60 Z'");
    const std::string copied = after(card, "copy wheel --on page.left --step=-180 --ids second");
    const json made = one(copied, "second");
    EXPECT_EQ(made["points"]["A"], json({-90.0, 40.0}));
    EXPECT_EQ(made["values"]["window"], "M -100 50 L -80 50 L -80 60 L -100 60 Z");
}

// A piece with a drawn shape keeps it, on every fold.
TEST(Copies, ADrawnPieceIsCopiedAsItIs) {
    const std::string card = card_with(
        "tent --id roof --at 90 --length 60 --width 80 --height 50\n"
        "add v-fold --id bird --at -100 --width 40 --height 40 --angle 100 --lean 60\n"
        "outline bird --d 'M -25.711504 4.533632 L -20 40 L 0 30 L 20 40 L 25.711504 4.533632 L 0 0 Z'");
    const json bird = one(card, "bird");
    const json made = one(after(card, "copy bird --on roof.centre --step 95 --ids second"), "second");
    EXPECT_EQ(made["on"], "roof.centre");
    EXPECT_EQ(made["values"]["outline"], bird["values"]["outline"]);
    for (const char* point : {"G", "E", "H", "J", "I"})
        EXPECT_EQ(made["points"][point], bird["points"][point]) << point;
}

std::string drawn(const std::string& element, const std::string& what = "outline") {
    return one(card_with(element + " --id x"), "x")["values"][what];
}

// What is drawn for a new element stays as it is drawn, where nothing else is said.
TEST(Copies, ANewElementHasTheShapeThatIsDrawn) {
    const std::string square = "M -10 20 L 10 20 L 10 30 L -10 30 Z";
    EXPECT_EQ(drawn("polygon --outline '" + square + "'"), square);
    EXPECT_EQ(drawn("polygon --at 0 --outline '" + square + "'"), "M -10 -5 L 10 -5 L 10 5 L -10 5 Z");
    EXPECT_EQ(drawn("polygon --width 40 --outline '" + square + "'"), "M -20 15 L 20 15 L 20 35 L -20 35 Z");
    EXPECT_EQ(drawn("freeform --outline '" + square + "'"), square);
    EXPECT_EQ(drawn("hole --outline 'M 20 20 L 30 20 L 30 30 Z'"), "M 20 20 L 30 20 L 30 30 Z");
    EXPECT_EQ(drawn("attached-plane --outline 'M -5 -5 L 5 -5 L 5 5 L -5 5 Z'"),
              "M -5 -5 L 5 -5 L 5 5 L -5 5 Z");
    EXPECT_EQ(drawn("disc --outline 'M -15 -15 L 15 -15 L 15 15 L -15 15 Z'"),
              "M -15 -15 L 15 -15 L 15 15 L -15 15 Z");
    EXPECT_EQ(drawn("disc --x 60 --window 'M 50 10 L 60 10 L 60 15 Z'", "window"),
              "M 50 10 L 60 10 L 60 15 Z");
    // About its apex, wherever that is.
    EXPECT_EQ(drawn("v-fold-cut --outline 'M 0 0 L -10 10 L 0 5 L 10 10 Z'"),
              "M 0 0 L -10 10 L 0 5 L 10 10 Z");
    EXPECT_EQ(drawn("v-fold-cut --at 20 --outline 'M 0 0 L -10 10 L 0 5 L 10 10 Z'"),
              "M 0 20 L -10 30 L 0 25 L 10 30 Z");
}

}  // namespace
}  // namespace popup::test
