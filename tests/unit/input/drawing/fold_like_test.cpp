// Folds of drawings that are read as flat parts: they are told of however the outline is drawn, and layers
// say what they are in more languages than one.
#include "input/drawing/fold_like.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "input/drawing/notation.h"
#include "support/drawings.h"

namespace popup {
namespace {

using drawing::Named;
using test::drawing;
using test::read_drawing;

const std::string kLooseBorder =
    "<path stroke='#000' d='M10 10H90M90 10V90M90 90H10M10 90V10'/><path stroke='#000' d='M30 30V70'/>";

// The messages of `folds-as-cuts`, one a line.
std::string told(const std::string& body) {
    std::string text;
    for (const Diagnostic& one : read_drawing(drawing(body)).findings) {
        if (one.code == "folds-as-cuts") text += one.message + "\n";
    }
    return text;
}

TEST(FoldLike, IsToldOfWhereTheBorderIsOpenLines) {
    const std::string folds = "<path stroke='#00f' d='M10 50H30'/><path stroke='#f00' d='M30 60H50'/>";
    const std::string both =
        "1 solid blue (#0000ff) line, 1 solid red (#ff0000) line look like folds, and are read as cuts\n";
    EXPECT_EQ(told(kLooseBorder + folds), both);
    EXPECT_EQ(told("<rect stroke='#000' x='10' y='10' width='80' height='80'/>" + folds), both);
    // Folds that make a loop are folds still.
    EXPECT_EQ(told(kLooseBorder + "<path stroke='#00f' d='M30 30H60M60 30V60M60 60H30M30 60V30'/>"),
              "4 solid blue (#0000ff) lines look like folds, and are read as cuts\n");
    // A border that folds close, too.
    EXPECT_EQ(
        told("<path stroke='#000' d='M10 10H90M90 10V90M90 90H10'/><path stroke='#00f' d='M10 90V10'/>"),
        "1 solid blue (#0000ff) line looks like folds, and is read as a cut\n");
}

TEST(FoldLike, IsNoOutlineInAColourOfFolds) {
    // What is cut by a laser is often red all over.
    EXPECT_EQ(told("<path stroke='#f00' d='M10 10H90M90 10V90M90 90H10M10 90V10M30 30V70'/>"), "");
    EXPECT_EQ(told("<path stroke='#f00' d='M10 10H90M90 10V90M90 90H10M10 90V10M30 30V70'/>"
                   "<path stroke='#000' d='M40 40H60'/>"),
              "");
    EXPECT_EQ(told("<path stroke='#f00' d='M10 10H90M90 10V90M90 90H10M10 90V10'/>"
                   "<path stroke='#00f' d='M10 50H90'/>"),
              "1 solid blue (#0000ff) line looks like folds, and is read as a cut\n");
    EXPECT_EQ(told(kLooseBorder), "");
}

TEST(FoldLike, ReadsDashesOfOrigamiSimulatorInsideOfOpenLines) {
    const auto reading =
        read_drawing(drawing(kLooseBorder + "<path stroke='#00f' stroke-dasharray='3 1' d='M20 20V80'/>"
                                            "<path stroke='#f00' stroke-dasharray='3 1' d='M40 20V80'/>"));
    EXPECT_EQ(reading.codes(), "");
    ASSERT_EQ(reading.part().lines.size(), 2U);
    EXPECT_EQ(reading.part().lines[0].kind, LineKind::valley);
    EXPECT_EQ(reading.part().lines[1].kind, LineKind::mountain);
}

TEST(FoldLike, TellsOfSeamsWhereNothingIsAFold) {
    const std::string black =
        "<rect stroke='#000' x='10' y='10' width='80' height='80'/>"
        "<path stroke='#000' stroke-dasharray='3 1' d='M20 20V80M30 20V80'/>";
    EXPECT_EQ(
        told(black),
        "2 dashed black (#000000) lines look like folds, and are read as seams, where paper is glued\n");
    // With folds of this program's notation beside them they are seams in earnest.
    for (const std::string fold : {"#f0f", "#00f"}) {
        EXPECT_EQ(told(black + "<path stroke='" + fold + "' stroke-dasharray='3 1' d='M40 20V80'/>"), "");
    }
}

// Each hint names what reads these lines; of colours that cuts have none is a rule.
TEST(FoldLike, NamesTheOptionsThatReadIt) {
    const auto last_hint = [](const std::string& body) -> std::string {
        const auto reading = read_drawing(drawing(body));
        if (reading.findings.empty() || reading.findings[0].hints.size() != 3) return "";
        EXPECT_EQ(reading.findings[0].hints[1],
                  "--as folded reads them as the folds of a carton, or of another folded sheet");
        return reading.findings[0].hints[2];
    };
    const std::string rect = "<rect stroke='#000' x='10' y='10' width='80' height='80'/>";
    EXPECT_EQ(last_hint(rect + "<path stroke='#ff2d2d' d='M20 20V80'/><path stroke='#00f' d='M30 20V80'/>"
                               "<path stroke='#0a0' stroke-dasharray='3 1' d='M30 20V80'/>"),
              "--lines says which lines are what: --lines mountain=#ff2d2d,valley=#0000ff,fold=#00aa00");
    EXPECT_EQ(last_hint(rect + "<path class='crease' stroke='#000' d='M20 20V80'/>"),
              "--lines says which lines are what, by their layer, class, id or colour");
}

TEST(FoldLike, IsCalledSoInSeveralLanguages) {
    const drawing::LineRules rules({});
    const std::vector<std::pair<std::string, Named>> names{
        {"Schneiden", Named::cut},
        {"Stanzlinie_2", Named::cut},
        {"Rillen", Named::fold},
        {"Falzlinien", Named::fold},
        {"Bergfalten", Named::mountain},
        {"Talfalz", Named::valley},
        {"Löcher", Named::hole},
        {"Loecher", Named::hole},
        {"Hilfslinien", Named::ignore},
        {"Klebefläche", Named::ignore},
        {"Klebelasche", Named::nothing},  // the flap is cut and folded
        {"Bemaßung", Named::ignore},
        {"Bema_xDF_ung", Named::ignore},
        {"Découpe", Named::cut},
        {"DÉCOUPE", Named::cut},
        {"De\xCC\x81"
         "coupe",
         Named::cut},
        {"D_xE9_coupe", Named::cut},
        {"Plis vallée", Named::valley},
        {"Plis_x0020_montagne", Named::mountain},
        {"rainage", Named::fold},
        {"fenêtres", Named::hole},
        {"Corte", Named::cut},
        {"Doblez montaña", Named::mountain},
        {"taglio", Named::cut},
        {"Pieghe a valle", Named::valley},
        {"cordonature", Named::fold},
        {"Mountain_x0020_folds", Named::mountain},
        {"Coupes et plis", Named::nothing},
        {"Ebene 1", Named::nothing},
        {"Calque_2", Named::nothing},
    };
    for (const auto& [name, named] : names) EXPECT_EQ(rules.said_by(name).named, named) << name;
    // A rule may be written as the name is.
    const drawing::LineRules given({{"Vallée", DrawnUse::cut}});
    for (const std::string name : {"Vallée",
                                   "VALL\xC3\x89"
                                   "E 2",
                                   "vallee", "Vall_xE9_e"}) {
        EXPECT_EQ(given.said_by(name).named, Named::cut) << name;
    }
    const drawing::LineRules sharp({{"Maße", DrawnUse::print}});
    for (const std::string name : {"Maße", "MASSE 2", "Ma_xDF_e"})
        EXPECT_EQ(sharp.said_by(name).named, Named::print) << name;
}

}  // namespace
}  // namespace popup
