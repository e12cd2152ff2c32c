// What a repair writes back: the changed values, and not a byte more.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"
#include "support/designs.h"

namespace popup {
namespace {

Design read(const std::string& text) {
    Diagnostics diagnostics("card.xml");
    auto design = read_design(Source{"card.xml", text}, {}, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) ADD_FAILURE() << d.message;
    return design.value_or(Design{});
}

std::string patch(const std::string& text, const Design& design) {
    return language_table().front().patch(Source{"card.xml", text}, design);
}

// `text` with the first `old` replaced.
std::string with(std::string text, std::string_view old, std::string_view fresh) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), fresh);
}

constexpr std::string_view kFold =
    "<parentfold page='0'><begin x='0' y='-4'/><end x='0' y='4'/></parentfold>";

std::string document(const std::string& points, const std::string& units = "in",
                     const std::string& type = "beak") {
    return "\xEF\xBB\xBF<?xml version=\"1.0\"?>\r\n<!-- A bird -->\r\n<popup units='" + units +
           "'>\r\n\t<structurelist>\r\n\t\t<structure type='" + type + "' >\r\n" + points + "\r\n" +
           std::string(kFold) + "\r\n\t\t</structure>\r\n\t</structurelist>\r\n</popup  >\r\n<!-- end -->";
}

const std::string kPoints =
    "<outerpoints> <point x='0' y='1.50'/> <!-- B --> <point x = \" -1.25 \" y='.5' /><point><x> "
    "1.25</x><y>5e-1</y>"
    "</point></outerpoints>";

void move(DesignPoint& point, Vec2 to_mm) {
    point.at = to_mm;
    point.changed = true;
}

TEST(Patch, WithoutChangesIsTheSameBytes) {
    const std::string text = document(kPoints);
    EXPECT_EQ(patch(text, read(text)), text);
}

TEST(Patch, ChangesTheNumbersAndNothingElse) {
    const std::string text = document(kPoints);
    Design design = read(text);
    move(design.structures[0].points[1], {-25.4, 12.7});
    EXPECT_EQ(patch(text, design), with(text, "-1.25", "-1"));
    move(design.structures[0].points[2], {25.4 / 3, -12.7});
    EXPECT_EQ(patch(text, design),
              with(with(with(text, "-1.25", "-1"), "1.25<", "0.333333<"), "5e-1", "-0.5"));
    move(design.structures[0].fold.end, {2.54, 101.6});
    EXPECT_NE(patch(text, design).find("<end x='0.1' y='4'/>"), std::string::npos);
}

TEST(Patch, AnUnchangedCoordinateKeepsItsDigits) {
    const std::string text = document(kPoints);
    Design design = read(text);
    move(design.structures[0].points[0], {2.54, 38.1});
    EXPECT_EQ(patch(text, design), with(text, "x='0' y='1.50'", "x='0.1' y='1.50'"));
}

TEST(Patch, PointsAsTextKeepTheirSeparators) {
    const std::string text =
        document("<outerpoints>0,1.5 <!-- B --> -1.25 ,\t0.5\r\n 1.25;0.5 </outerpoints>");
    Design design = read(text);
    move(design.structures[0].points[1], {-50.8, 25.4});
    move(design.structures[0].points[2], {50.8, 25.4});
    EXPECT_EQ(patch(text, design), document("<outerpoints>0,1.5 <!-- B --> -2 ,\t1\r\n 2;1 </outerpoints>"));
}

TEST(Patch, ReferencesInANumberAreReplacedWithIt) {
    const std::string text = document(
        "<outerpoints><point x='0' y='1'/><point x='-&#49;.25' "
        "y='0'/><point>&#x31;.25&#44;&#9;0.&#53;</point></outerpoints>");
    Design design = read(text);
    EXPECT_DOUBLE_EQ(design.structures[0].points[1].at.x, -31.75);
    EXPECT_DOUBLE_EQ(design.structures[0].points[2].at.y, 12.7);
    move(design.structures[0].points[1], {-25.4, 0});
    move(design.structures[0].points[2], {25.4, 25.4});
    EXPECT_EQ(patch(text, design),
              document("<outerpoints><point x='0' y='1'/><point x='-1' y='0'/><point>1&#44;&#9;1</"
                       "point></outerpoints>"));
}

TEST(Patch, APageThatWasNotWrittenIsAddedToTheTag) {
    const std::string text = document(
        "<outerpoints><point x='0' y='1'/><point x='-1' y='0' /><point page='0'>1,0</point></outerpoints>");
    Design design = read(text);
    for (std::size_t i = 0; i < 3; ++i) {
        design.structures[0].points[i].page = static_cast<int>(i) + 1;
        design.structures[0].points[i].changed = true;
    }
    EXPECT_EQ(patch(text, design),
              document("<outerpoints><point x='0' y='1' page=\"1\"/><point x='-1' y='0' page=\"2\" "
                       "/><point page='3'>1,0</point></outerpoints>"));
}

TEST(Patch, AChangedTypeIsWrittenAsItWasByNameOrByCode) {
    const std::string by_name = document(kPoints);
    Design design = read(by_name);
    design.structures[0].type = "inverted-beak";
    design.structures[0].type_changed = true;
    EXPECT_EQ(patch(by_name, design), document(kPoints, "in", "inverted-beak"));
    const std::string by_code = document(kPoints, "in", "2");
    design = read(by_code);
    design.structures[0].type = "inverted-beak";
    design.structures[0].type_changed = true;
    EXPECT_EQ(patch(by_code, design), document(kPoints, "in", "3"));
}

TEST(Patch, ReadingAgainGivesTheValuesToAMillionthOfAUnit) {
    for (const char* unit : {"in", "mm", "cm", "pt", "px"}) {
        const std::string text = document(kPoints, unit);
        Design design = read(text);
        const double mm = design.unit.mm;
        for (DesignPoint& p : design.structures[0].points)
            move(p, {p.at.x * 1.2345678912 + 0.1, -p.at.y / 7});
        const Design again = read(patch(text, design));
        ASSERT_EQ(again.structures.size(), 1U);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(again.structures[0].points[i].at.x / mm, design.structures[0].points[i].at.x / mm,
                        1e-6);
            EXPECT_NEAR(again.structures[0].points[i].at.y / mm, design.structures[0].points[i].at.y / mm,
                        1e-6);
        }
        EXPECT_EQ(patch(patch(text, design), again), patch(text, design));
    }
}

std::string tent(const std::string& id, const std::string& page) {
    return "    <structure type='tent' id='" + id +
           "'>\n<outerpoints>-1,1 -1,-1 1,1 1,-1 -2,1 -2,-1 2,1 2,-1</outerpoints>"
           "<parentfold page='" +
           page + "'><begin x='0' y='-4'/><end x='0' y='4' page='" + page + "'/></parentfold></structure>";
}

// An older document may not name a page, and gets a warning: what nobody asks for is not mended.
TEST(Patch, ANameOfAPageStaysInAnOlderDocument) {
    const std::string text = "<popup version='2.0'><structurelist>" + tent("a", "0") + tent("roof", "a") +
                             "</structurelist></popup>";
    Diagnostics diagnostics("card.xml");
    auto design = read_design(Source{"card.xml", text}, {}, diagnostics);
    ASSERT_TRUE(design);
    ASSERT_NE(test::findings(diagnostics).find("newer-element"), std::string::npos);
    EXPECT_EQ(patch(text, *design), text);
    design->structures[0].id = "b";
    design->structures[0].id_changed = true;
    EXPECT_EQ(patch(text, *design),
              with(with(with(text, "id='a'", "id='b'"), "page='a'", "page='b'"), "page='a'", "page='b'"));
}

TEST(Patch, DroppedElementsTakeTheirLinesWithThem) {
    const std::string head = "<popup>\n  <structurelist>\n";
    const std::string middle = "\n  </structurelist>\n  <drawnlinelist>\n";
    const std::string line1 = "    <drawnline page='1'>0,0 1,1</drawnline> \r\n";
    const std::string line2 = "    <drawnline page='2'>0,0 1,1</drawnline>\n";
    const std::string tail = "  </drawnlinelist>\n</popup>\n";
    const std::string text = head + tent("a", "0") + "\n" + tent("b", "0") + "\n" + tent("c", "2") +
                             "<!-- c -->" + middle + line1 + line2 + tail;
    Design design = read(text);
    ASSERT_EQ(design.structures.size(), 3U);
    // As check() leaves it: the pages behind a dropped piece have moved up.
    design.structures[0].dropped = true;
    design.structures[2].fold.page = 1;
    design.structures[2].fold.page_changed = true;
    design.lines[0].dropped = true;
    design.lines[1].page = 1;
    design.lines[1].page_changed = true;
    EXPECT_EQ(patch(text, design), head + tent("b", "0") + "\n" + tent("c", "1") + "<!-- c -->" + middle +
                                       with(line2, "'2'", "'1'") + tail);
    // Beside something else on its line only the element itself goes.
    design.structures[2].dropped = true;
    EXPECT_EQ(patch(text, design),
              head + tent("b", "0") + "\n    <!-- c -->" + middle + with(line2, "'2'", "'1'") + tail);
}

}  // namespace
}  // namespace popup
