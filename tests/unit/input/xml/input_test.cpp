// Reading the popup document: every spelling gives the same design, everything keeps its place, and whatever
// is wrong is said where it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "input/color.h"
#include "input/xml/locate.h"
#include "input/xml/number.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"
#include "popup/mechanism.h"

namespace popup {
namespace {

struct Reading {
    std::optional<Design> design;
    std::vector<Diagnostic> findings;
    std::string text;  // of the findings, one a line: LINE:COLUMN CODE MESSAGE
};

Reading read(const std::string& text, bool strict = false, const std::string& name = "card.xml") {
    Diagnostics diagnostics(name);
    Reading reading;
    reading.design = read_design(Source{name, text}, ReadOptions{strict, {}, {}}, diagnostics);
    reading.findings = diagnostics.sorted();
    for (const Diagnostic& d : reading.findings) {
        reading.text += std::to_string(d.place.line) + ":" + std::to_string(d.place.column) + " " + d.code +
                        " " + d.message + "\n";
    }
    return reading;
}

std::vector<std::string> codes(const Reading& reading) {
    std::vector<std::string> out;
    for (const Diagnostic& d : reading.findings) out.push_back(d.code);
    return out;
}

using Codes = std::vector<std::string>;

// A document with one structure, whose parts can be exchanged.
struct Beak {
    std::string head = "<popup>";
    std::string type = "type=\"beak\"";
    std::string points =
        "<outerpoints><point x=\"0\" y=\"1.5\"/><point x=\"-1.25\" y=\"0.5\"/>"
        "<point x=\"1.25\" y=\"0.5\"/></outerpoints>";
    std::string colors;
    std::string fold =
        "<parentfold page=\"0\"><begin x=\"0\" y=\"-4.25\"/><end x=\"0\" y=\"4.25\"/></parentfold>";
    std::string lines;
    [[nodiscard]] std::string text() const {
        return head + "\n<structurelist>\n<structure " + type + ">\n" + points + "\n" + colors + "\n" + fold +
               "\n</structure>\n</structurelist>\n" + lines + "</popup>\n";
    }
};

void expect_points(const Design& design, const std::vector<Vec2>& mm) {
    ASSERT_EQ(design.structures.size(), 1U);
    ASSERT_EQ(design.structures[0].points.size(), mm.size());
    for (std::size_t i = 0; i < mm.size(); ++i) {
        EXPECT_NEAR(design.structures[0].points[i].at.x, mm[i].x, 1e-9);
        EXPECT_NEAR(design.structures[0].points[i].at.y, mm[i].y, 1e-9);
    }
}

const std::vector<Vec2> kBeakPoints{{0, 38.1}, {-31.75, 12.7}, {31.75, 12.7}};

// ---- The generous readings ----

TEST(Input, CanonicalDocumentReadsInMillimetres) {
    const Reading reading = read(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<popup version=\"2.0\" units=\"mm\">\n"
        "  <mainpage width=\"200\" height=\"150\"><leftcolor>#102030</leftcolor></mainpage>\n"
        "  <structurelist>\n"
        "    <structure type=\"tent\" id=\"roof\">\n"
        "      <outerpoints>\n"
        "        <point x=\"-20\" y=\"10\"/><point x=\"-20\" y=\"-10\"/><point x=\"20\" y=\"10\"/>\n"
        "        <point x=\"20\" y=\"-10\" page=\"0\"/><point x=\"-40\" y=\"10\"/><point x=\"-40\" "
        "y=\"-10\"/>\n"
        "        <point x=\"40\" y=\"10\"/><point x=\"40\" y=\"-10\"/>\n"
        "      </outerpoints>\n"
        "      <leftcolor>#ffcc00</leftcolor><righttabcolor>#00ff00</righttabcolor>\n"
        "      <parentfold page=\"0\"><begin x=\"0\" y=\"-75\"/><end x=\"0\" y=\"75\"/></parentfold>\n"
        "    </structure>\n"
        "  </structurelist>\n"
        "  <drawnlinelist>\n"
        "    <drawnline page=\"1\" thickness=\"2.5\" color=\"#0000ff\"><point x=\"-3\" y=\"-2\"/><point "
        "x=\"1\" y=\"0\"/></drawnline>\n"
        "  </drawnlinelist>\n"
        "</popup>\n");
    EXPECT_EQ(reading.text, "");
    ASSERT_TRUE(reading.design);
    const Design& d = *reading.design;
    EXPECT_EQ(d.file, "card.xml");
    EXPECT_EQ(d.stem, "card");
    EXPECT_EQ(d.unit.name, "mm");
    EXPECT_EQ(d.width_mm, 200);
    EXPECT_EQ(d.height_mm, 150);
    EXPECT_EQ(d.left, (Color{0x10, 0x20, 0x30}));
    EXPECT_FALSE(d.right);
    ASSERT_EQ(d.structures.size(), 1U);
    const Structure& s = d.structures[0];
    EXPECT_EQ(s.type, "tent");
    EXPECT_EQ(s.id, "roof");
    EXPECT_TRUE(s.id_given);
    EXPECT_EQ(s.place, (Place{5, 5}));
    ASSERT_EQ(s.points.size(), 8U);
    EXPECT_EQ(s.points[1].at, (Vec2{-20, -10}));
    EXPECT_EQ(s.points[1].place, (Place{7, 32}));
    EXPECT_FALSE(s.points[1].page);
    EXPECT_EQ(s.points[3].page, 0);
    EXPECT_EQ(color_of(s, "leftcolor"), (Color{0xff, 0xcc, 0}));
    EXPECT_FALSE(color_of(s, "rightcolor"));
    EXPECT_FALSE(color_of(s, "lefttabcolor"));
    EXPECT_EQ(color_of(s, "righttabcolor"), (Color{0, 0xff, 0}));
    EXPECT_EQ(s.fold.page, 0);
    EXPECT_EQ(s.fold.begin.at, (Vec2{0, -75}));
    EXPECT_EQ(s.fold.end.at, (Vec2{0, 75}));
    ASSERT_EQ(d.lines.size(), 1U);
    EXPECT_EQ(d.lines[0].page, 1);
    EXPECT_EQ(d.lines[0].thickness_pt, 2.5);
    EXPECT_EQ(d.lines[0].color, (Color{0, 0, 255}));
    ASSERT_EQ(d.lines[0].points.size(), 2U);
    EXPECT_EQ(d.lines[0].points[0].at, (Vec2{-3, -2}));
}

TEST(Input, WhatIsNotWrittenHasItsDefault) {
    const Reading reading = read("<popup/>");
    EXPECT_EQ(reading.text, "");
    ASSERT_TRUE(reading.design);
    EXPECT_EQ(reading.design->version, "2.0");
    EXPECT_EQ(reading.design->unit.name, "in");
    EXPECT_DOUBLE_EQ(reading.design->width_mm, 279.4);
    EXPECT_DOUBLE_EQ(reading.design->height_mm, 215.9);
    // Whatever the units: the default page is in inches.
    const Reading mm = read("<popup units='mm'><mainpage height='100'/></popup>");
    ASSERT_TRUE(mm.design);
    EXPECT_DOUBLE_EQ(mm.design->width_mm, 279.4);
    EXPECT_DOUBLE_EQ(mm.design->height_mm, 100);
}

TEST(Input, EverySpellingOfAPointIsTheSamePoint) {
    const std::string head = "<outerpoints>";
    const std::string tail = "</outerpoints>";
    const std::vector<std::string> spellings{
        Beak{}.points,
        head +
            "<point><x>0</x><y>1.5</y></point><point y='0.5'><x>-1.25</x></point><POINT X='1.25' Y='.5'/>" +
            tail,
        head + "<point>0,1.5</point><point> -1.25 , 0.5 </point><point>1.25 0.5</point>" + tail,
        head + "0,1.5 -1.25,0.5 1.25,0.5" + tail,
        head + "0,1.5; -1.25,0.5;\n 1.25,0.5" + tail,
        head +
            "<point value='0,1.5'/><point><value>-1.25,0.5</value></point><point><x value='1.25'/><y> 0.5 "
            "</y></point>" +
            tail,
        head + "0,1.5 <!-- B --> -1.25,0.5 <!-- E --> 1.25,0.5" + tail,
        head + "<point>0&#44;1.5</point><point x='-&#49;.25' y='5e-1'/><point><![CDATA[1.25,0.5]]></point>" +
            tail,
        "<outer_points><Point x='0' y='1.5'/><point x='-1.25' y='+0.5'/><point x='125e-2' "
        "y='0.50'/></outer_points>",
        "<Outer-Points><point x='0' y='1.5'/><?note?><point x='-1.25' y='0.5'/><point x='1.25' "
        "y='0.5'/></Outer-Points>",
        "<point x='0' y='1.5'/><point x='-1.25' y='0.5'/><point x='1.25' y='0.5'/>",
    };
    for (const std::string& spelling : spellings) {
        Beak beak;
        beak.points = spelling;
        const Reading reading = read(beak.text());
        EXPECT_EQ(reading.text, "") << spelling;
        ASSERT_TRUE(reading.design) << spelling;
        expect_points(*reading.design, kBeakPoints);
    }
    Beak attribute;
    attribute.type += " outerPoints='0,1.5 -1.25,0.5 1.25,0.5'";
    attribute.points.clear();
    const Reading reading = read(attribute.text());
    EXPECT_EQ(reading.text, "");
    ASSERT_TRUE(reading.design);
    expect_points(*reading.design, kBeakPoints);
}

TEST(Input, NamesMatchWithoutRegardToCaseUnderscoresAndHyphens) {
    const Reading reading = read(
        "<PopUp Version='2.0' UNITS='IN'><Main_Page><left-color>red</left-color></Main_Page>"
        "<StructureList><Structure Type='BEAK'><OuterPoints>0,1.5 -1.25,0.5 1.25,0.5</OuterPoints>"
        "<LeftColour>blue</LeftColour><left_tab_color>lime</left_tab_color>"
        "<ParentFold><page>0</page><Begin>0,-4.25</Begin><END>0,4.25</END></ParentFold></Structure></"
        "StructureList>"
        "<drawn-line-list/></PopUp>");
    EXPECT_EQ(reading.text, "");
    ASSERT_TRUE(reading.design);
    expect_points(*reading.design, kBeakPoints);
    EXPECT_EQ(reading.design->left, (Color{255, 0, 0}));
    EXPECT_EQ(color_of(reading.design->structures[0], "leftcolor"), (Color{0, 0, 255}));
    EXPECT_EQ(color_of(reading.design->structures[0], "lefttabcolor"), (Color{0, 255, 0}));
}

TEST(Input, ValuesMayBeAttributesOrElements) {
    const Reading reading = read(
        "<popup><version>2.0</version><units>cm</units><mainpage><width>20</width><height "
        "value='10'/></mainpage>"
        "<structurelist><structure leftcolor='red' rightcolor='0,0,255'><type>2</type><id>bird</id>"
        "<outerpoints>0,1 -1,0 1,0</outerpoints><parentfold page='0' begin='0,-4' end='0,4'/></structure>"
        "</structurelist><drawnlinelist><drawnline><thickness>3</thickness><color>-65536</color><page>0</"
        "page>"
        "<point>0,0</point><point>1,1</point></drawnline><drawnline>0,0 1,1 "
        "2,2</drawnline></drawnlinelist></popup>");
    EXPECT_EQ(reading.text, "");
    ASSERT_TRUE(reading.design);
    const Design& d = *reading.design;
    EXPECT_EQ(d.width_mm, 200);
    EXPECT_EQ(d.height_mm, 100);
    EXPECT_EQ(d.structures[0].type, "beak");
    EXPECT_EQ(d.structures[0].id, "bird");
    EXPECT_EQ(color_of(d.structures[0], "leftcolor"), (Color{255, 0, 0}));
    EXPECT_EQ(d.structures[0].fold.end.at, (Vec2{0, 40}));
    EXPECT_EQ(d.lines[0].thickness_pt, 3);
    EXPECT_EQ(d.lines[0].color, (Color{255, 0, 0}));
    EXPECT_EQ(d.lines[1].thickness_pt, 1);
    ASSERT_EQ(d.lines[1].points.size(), 3U);
    EXPECT_EQ(d.lines[1].points[2].at, (Vec2{20, 20}));
}

TEST(Input, UnitsScaleEverythingButLineThickness) {
    const std::vector<std::pair<std::string, double>> units{
        {"in", 25.4}, {"mm", 1}, {"cm", 10}, {"pt", 25.4 / 72}, {"px", 25.4 / 72}, {"Inches", 25.4}};
    for (const auto& [name, mm] : units) {
        const Reading reading =
            read("<popup units='" + name +
                 "'><mainpage width='6' height='7'/><drawnlinelist><drawnline thickness='4'>"
                 "1,2 3,4</drawnline></drawnlinelist></popup>");
        ASSERT_TRUE(reading.design) << name;
        EXPECT_DOUBLE_EQ(reading.design->width_mm, 6 * mm);
        EXPECT_DOUBLE_EQ(reading.design->lines[0].points[1].at.y, 4 * mm);
        EXPECT_EQ(reading.design->lines[0].thickness_pt, 4);
    }
}

TEST(Input, ColoursReadAsPeopleAndProgramsWriteThem) {
    EXPECT_EQ(parse_color("#F00"), (Color{255, 0, 0}));
    EXPECT_EQ(parse_color("#12aBcD"), (Color{0x12, 0xab, 0xcd}));
    EXPECT_EQ(parse_color(" 1, 20 ,255 "), (Color{1, 20, 255}));
    EXPECT_EQ(parse_color("RebeccaPurple"), (Color{0x66, 0x33, 0x99}));
    EXPECT_EQ(parse_color("-65536"), (Color{255, 0, 0}));
    EXPECT_EQ(parse_color("-1"), (Color{255, 255, 255}));
    EXPECT_EQ(parse_color("-16777216"), (Color{0, 0, 0}));
    EXPECT_EQ(parse_color("16711680"), (Color{255, 0, 0}));
    EXPECT_EQ(parse_color("0"), (Color{0, 0, 0}));
    EXPECT_EQ(parse_color("-2147483648"), (Color{0, 0, 0}));
    for (const char* bad :
         {"", "#", "#12", "#12345", "#1234567", "#ggg", "1,2", "1,2,3,4", "256,0,0", "-1,0,0", "1.5,2,3",
          "bleu", "0xff0000", "-2147483649", "4294967296", "#+12", "99999999999999999999", "1,2,"}) {
        EXPECT_FALSE(parse_color(bad)) << bad;
    }
    EXPECT_EQ(to_string(Color{0xAB, 0, 0x0c}), "#ab000c");
}

TEST(Input, NumbersAreDecimalWithAnOptionalExponent) {
    using xml::NumberFault;
    using xml::parse_number;
    for (const auto& [text, value] :
         std::vector<std::pair<std::string, double>>{{"1", 1},
                                                     {"-1.5", -1.5},
                                                     {"+.5", 0.5},
                                                     {"5.", 5},
                                                     {" 1e3\n", 1000},
                                                     {"1E-2", 0.01},
                                                     {"1e-400", 0},
                                                     {"0e999", 0},
                                                     {"1000e-3", 1},
                                                     {"0." + std::string(400, '0') + "1", 0},
                                                     {"1" + std::string(400, '0') + "e-400", 1}}) {
        EXPECT_EQ(parse_number(text).fault, NumberFault::none) << text;
        EXPECT_DOUBLE_EQ(parse_number(text).value, value) << text;
    }
    for (const auto& [text, fault] : std::vector<std::pair<std::string, NumberFault>>{
             {"", NumberFault::empty},
             {" ", NumberFault::empty},
             {"nan", NumberFault::not_finite},
             {"-INF", NumberFault::not_finite},
             {"infinity", NumberFault::not_finite},
             {"0x10", NumberFault::hexadecimal},
             {"1,5", NumberFault::comma},
             {"1e999", NumberFault::too_large},
             {"01e400", NumberFault::too_large},
             {"1" + std::string(400, '0') + "e-5", NumberFault::too_large},
             {"1.5in", NumberFault::malformed},
             {"--1", NumberFault::malformed},
             {"+-1", NumberFault::malformed},
             {".", NumberFault::malformed},
             {"1e", NumberFault::malformed},
             {"1e+", NumberFault::malformed},
             {"1 2", NumberFault::malformed},
             {"e5", NumberFault::malformed}}) {
        EXPECT_EQ(parse_number(text).fault, fault) << text;
    }
}

TEST(Input, WrittenNumbersHaveSixDecimalsAtMost) {
    using xml::format_number;
    EXPECT_EQ(format_number(0), "0");
    EXPECT_EQ(format_number(-0.0), "0");
    EXPECT_EQ(format_number(-1e-9), "0");
    EXPECT_EQ(format_number(1.5), "1.5");
    EXPECT_EQ(format_number(-1.0 / 3), "-0.333333");
    EXPECT_EQ(format_number(100), "100");
    EXPECT_EQ(format_number(1e6), "1000000");
    EXPECT_EQ(format_number(1e-6), "0.000001");
}

// ---- Ids ----

std::string structure(const std::string& attributes) {
    return "<structure type='beak' " + attributes +
           "><outerpoints>0,1 -1,0 1,0</outerpoints><parentfold begin='0,-4' end='0,4'/></structure>\n";
}

TEST(Input, AutomaticIdsAreNumberedAndStepAsideForGivenOnes) {
    const Reading reading =
        read("<popup><structurelist>\n" + structure("id='e2'") + structure("") + structure("") +
             structure("id='e4'") + structure("") + "</structurelist></popup>");
    EXPECT_EQ(reading.text, "");
    ASSERT_TRUE(reading.design);
    std::vector<std::string> ids;
    for (const Structure& s : reading.design->structures) ids.push_back(s.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"e2", "e6", "e3", "e4", "e5"}));
    EXPECT_FALSE(reading.design->structures[1].id_given);
}

TEST(Input, BadAndDoubledIdsAreErrors) {
    const Reading reading = read("<popup><structurelist>\n" + structure("id='a'") + structure("id='1a'") +
                                 structure("id='page'") + structure("id='a'") + structure("id=''") +
                                 structure("id='a b'") + "</structurelist></popup>");
    EXPECT_FALSE(reading.design);
    EXPECT_EQ(reading.text,
              "3:24 bad-id '1a' cannot be an id\n"
              "4:24 bad-id the id 'page' is kept for the base page\n"
              "5:24 duplicate-id the id 'a' is given twice; the first is on line 2\n"
              "6:24 missing-value 'id' is empty\n"
              "7:24 bad-id 'a b' cannot be an id\n");
}

// ---- Places and what is reported ----

TEST(Input, ColumnsCountCharactersAndLinesLineBreaks) {
    Beak beak;
    beak.head = "\xEF\xBB\xBF<popup>\r\n<!-- \xC3\xA4\xE2\x82\xAC\xF0\x9F\x90\xA6 --><foo/>";
    const Reading reading = read(beak.text());
    ASSERT_TRUE(reading.design);
    EXPECT_EQ(reading.text, "2:13 unknown-markup the element 'foo' is not known in 'popup'\n");
    EXPECT_EQ(reading.design->structures[0].place, (Place{4, 1}));
}

TEST(Input, FindingsNameTheStructureEvenWithoutAGivenId) {
    Beak beak;
    beak.colors = "<leftcolor>bleu</leftcolor>";
    const Reading reading = read(beak.text());
    ASSERT_EQ(codes(reading), Codes{"bad-color"});
    EXPECT_EQ(reading.findings[0].element, "e1");
    EXPECT_EQ(reading.findings[0].hints, std::vector<std::string>{"perhaps 'blue' is meant"});
}

TEST(Input, UnknownMarkupIsAWarningAndUnderStrictAnError) {
    Beak beak;
    beak.head =
        "<popup verison='2.0' xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
        "xsi:noNamespaceSchemaLocation='popup.xsd'>stray";
    beak.colors = "<leftcolour foo='1'>red</leftcolour><rigthcolor>red<deep><er/></deep></rigthcolor>";
    beak.lines = "<drawnlinelist><drawnline>0,0 1,1</drawnline>x</drawnlinelist>";
    const Reading reading = read(beak.text());
    ASSERT_TRUE(reading.design);
    EXPECT_EQ(codes(reading), Codes(5, "unknown-markup"));
    for (const Diagnostic& d : reading.findings) EXPECT_EQ(d.severity, Severity::warning);
    EXPECT_EQ(reading.findings[0].hints, std::vector<std::string>{"perhaps 'version' is meant"});
    EXPECT_EQ(reading.findings[3].hints, std::vector<std::string>{"perhaps 'rightcolor' is meant"});
    EXPECT_EQ(reading.findings[1].message, "the text 'stray' has no meaning in 'popup'");
    const Reading strict = read(beak.text(), true);
    EXPECT_FALSE(strict.design);
    EXPECT_EQ(codes(strict), Codes(5, "unknown-markup"));
    EXPECT_EQ(strict.findings[0].severity, Severity::error);
}

TEST(Input, AllProblemsOfADocumentAreCollected) {
    const Reading reading = read(
        "<popup units='furlong'>\n<mainpage width='0' height='-1'/>\n<structurelist>\n"
        "<structure type='beek'/>\n"
        "<structure><outerpoints><point x='1'/></outerpoints><parentfold/></structure>\n"
        "</structurelist>\n<drawnlinelist>\n"
        "<drawnline thickness='-1' page='x' color='#zz'>1,2</drawnline>\n</drawnlinelist>\n</popup>");
    EXPECT_FALSE(reading.design);
    EXPECT_EQ(reading.text,
              "1:8 bad-unit the unit 'furlong' is not known\n"
              "2:11 page-size the page's width is 0 mm, and must be from 1 to 10000 mm\n"
              "2:21 page-size the page's height is -25.4 mm, and must be from 1 to 10000 mm\n"
              "4:1 missing-value this structure has no parentfold\n"
              "4:12 unknown-type the type 'beek' is not known\n"
              "5:1 missing-value this structure has no type\n"
              "5:25 missing-value this point has no y\n"
              "5:53 missing-value this parentfold has no begin\n"
              "5:53 missing-value this parentfold has no end\n"
              "8:1 point-count a drawn line has at least 2 points, and 1 is given\n"
              "8:12 bad-number thickness is -1 pt, and must be from 0 to 1000 pt\n"
              "8:27 bad-page 'x' is not the number of a page\n"
              "8:36 bad-color color is '#zz', which is not a colour\n");
}

TEST(Input, EachBadValueIsSaidWhereItStands) {
    const auto point = [](const std::string& p) {
        Beak beak;
        beak.points = "<outerpoints><point x='0' y='1'/><point x='-1' y='0'/>\n" + p + "</outerpoints>";
        return read(beak.text()).text;
    };
    EXPECT_EQ(point("<point x='nan' y='0'/>"), "5:8 bad-number x is 'nan', which is not a finite number\n");
    EXPECT_EQ(point("<point x='1' y='-inf'/>"),
              "5:14 bad-number y is '-inf', which is not a finite number\n");
    EXPECT_EQ(point("<point x='1' y='1e308'/>"),
              "5:14 bad-number y is 1e308 in, further out than 1000000 mm\n");
    EXPECT_EQ(point("<point x='1e999' y='1'/>"),
              "5:8 bad-number x is '1e999', which is too large a number\n");
    EXPECT_EQ(point("<point x='0x10' y='1'/>"),
              "5:8 bad-number x is '0x10', which is not a decimal number\n");
    EXPECT_EQ(point("<point x='1,5' y='1'/>"), "5:8 bad-number x is '1,5', which is not a number\n");
    EXPECT_EQ(point("<point>1,5 2,5</point>"),
              "5:8 bad-point point is '1,5 2,5', 4 numbers where x and y are expected\n");
    EXPECT_EQ(point("<point>1\n   a</point>"), "6:4 bad-number y is 'a', which is not a number\n");
    EXPECT_EQ(point("<point/>"), "5:1 missing-value this point has no x and no y\n");
    EXPECT_EQ(point("<point x='1' X='2' y='3'/>"),
              "5:14 duplicate-value 'X' is given twice; the first is on line 5\n");
    EXPECT_EQ(point("<point x='1' y=''/>"), "5:14 missing-value 'y' is empty\n");
    EXPECT_EQ(point("<point x='1' y='0' page='-1'/>"), "5:20 bad-page '-1' is not the number of a page\n");
    EXPECT_EQ(point("<point x='1' y='0' page='1.5'/>"), "5:20 bad-page '1.5' is not the number of a page\n");
}

TEST(Input, AWrongNumberOfPointsSaysWhichAreExpected) {
    Beak beak;
    beak.points = "<outerpoints>0,1 -1,0</outerpoints>";
    EXPECT_EQ(read(beak.text()).text, "4:1 point-count 'beak' has 3 outer points (A B E), and 2 are given\n");
    beak.points = "<outerpoints>0,1 -1,0 1,0 1,0</outerpoints>";
    EXPECT_EQ(read(beak.text()).text, "4:1 point-count 'beak' has 3 outer points (A B E), and 4 are given\n");
    beak.points = "<outerpoints>0,1 -1,0 1,0 1</outerpoints>";
    EXPECT_EQ(read(beak.text()).text,
              "4:14 bad-point this list of points has 7 numbers, and each point takes two\n");
    beak.points.clear();
    EXPECT_EQ(read(beak.text()).text, "3:1 point-count 'beak' has 3 outer points (A B E), and 0 are given\n");
}

TEST(Input, PagesOfAParentFoldMustAgree) {
    Beak beak;
    beak.fold = "<parentfold><begin x='0' y='0' page='2'/><end x='0' y='1'/></parentfold>";
    const Reading reading = read(beak.text());
    ASSERT_TRUE(reading.design);
    EXPECT_EQ(reading.design->structures[0].fold.page, 2);
    beak.fold = "<parentfold page='1'><begin x='0' y='0' page='2'/><end x='0' y='1'/></parentfold>";
    EXPECT_EQ(codes(read(beak.text())), Codes{"bad-page"});
}

TEST(Input, VersionsOtherThanTheKnownAreAWarning) {
    EXPECT_EQ(read("<popup version='3.0'/>").design->version, "3.0");
    EXPECT_EQ(read("<popup version='2'/>").text, "");
    const Reading reading = read("<popup version='1.7'/>");
    ASSERT_TRUE(reading.design);
    EXPECT_EQ(reading.text, "1:8 unknown-version version '1.7' is not known; the document is read as 2.0\n");
}

TEST(Input, CodesAndNamesAreTypes) {
    const std::vector<std::pair<std::string, std::string>> beaks{
        {"2", "beak"}, {"beak", "beak"}, {"Inverted_Beak", "inverted-beak"}, {"3", "inverted-beak"}};
    for (const auto& [written, name] : beaks) {
        Beak beak;
        beak.type = "type='" + written + "'";
        const Reading reading = read(beak.text());
        ASSERT_TRUE(reading.design) << written;
        EXPECT_EQ(reading.design->structures[0].type, name);
    }
    for (const std::string wrong : {"9", "-1", "2.0", "beaks and all", "", "0x2"}) {
        Beak beak;
        beak.type = "type='" + wrong + "'";
        EXPECT_FALSE(read(beak.text()).design) << wrong;
    }
}

// ---- Languages ----

TEST(Input, TheSuffixOrTheNameTellsTheLanguage) {
    Diagnostics diagnostics("x");
    EXPECT_TRUE(read_design(Source{"A.XML", "<popup/>"}, {}, diagnostics));
    EXPECT_TRUE(read_design(Source{"-", "<popup/>"}, {}, diagnostics));
    EXPECT_TRUE(read_design(Source{"a.dat", "<popup/>"}, ReadOptions{false, "xml", {}}, diagnostics));
    EXPECT_FALSE(diagnostics.has_findings());
    EXPECT_FALSE(read_design(Source{"a.dat", "<popup/>"}, {}, diagnostics));
    EXPECT_FALSE(read_design(Source{"a.xml", "<popup/>"}, ReadOptions{false, "basic", {}}, diagnostics));
    EXPECT_EQ(diagnostics.sorted().size(), 2U);
    EXPECT_EQ(diagnostics.sorted()[0].code, "unknown-language");
}

}  // namespace
}  // namespace popup
