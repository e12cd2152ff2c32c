// The document writer: one canonical spelling, which reads as the same design.
#include <gtest/gtest.h>

#include <string>

#include "output/xml.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"
#include "popup/mechanism.h"
#include "support/designs.h"

namespace popup {
namespace {

Design read(const std::string& text) {
    Diagnostics diagnostics("card.xml");
    auto design = read_design(Source{"card.xml", text}, {}, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) ADD_FAILURE() << d.message;
    return design.value_or(Design{});
}

void expect_near(const DesignPoint& a, const DesignPoint& b, double mm) {
    EXPECT_NEAR(a.at.x, b.at.x, 1e-6 * mm);
    EXPECT_NEAR(a.at.y, b.at.y, 1e-6 * mm);
    EXPECT_EQ(a.page, b.page);
}

void expect_same(const Design& a, const Design& b) {
    const double mm = a.unit.mm;
    EXPECT_EQ(a.version, b.version);
    EXPECT_EQ(a.unit.name, b.unit.name);
    EXPECT_NEAR(a.width_mm, b.width_mm, 1e-6 * mm);
    EXPECT_NEAR(a.height_mm, b.height_mm, 1e-6 * mm);
    EXPECT_EQ(a.left, b.left);
    EXPECT_EQ(a.right, b.right);
    ASSERT_EQ(a.structures.size(), b.structures.size());
    for (std::size_t i = 0; i < a.structures.size(); ++i) {
        const Structure& s = a.structures[i];
        const Structure& t = b.structures[i];
        EXPECT_EQ(s.type, t.type);
        EXPECT_EQ(s.id, t.id);
        EXPECT_EQ(color_of(s, "leftcolor"), color_of(t, "leftcolor"));
        EXPECT_EQ(color_of(s, "rightcolor"), color_of(t, "rightcolor"));
        EXPECT_EQ(color_of(s, "lefttabcolor"), color_of(t, "lefttabcolor"));
        EXPECT_EQ(color_of(s, "righttabcolor"), color_of(t, "righttabcolor"));
        EXPECT_EQ(s.fold.page, t.fold.page);
        expect_near(s.fold.begin, t.fold.begin, mm);
        expect_near(s.fold.end, t.fold.end, mm);
        ASSERT_EQ(s.points.size(), t.points.size());
        for (std::size_t j = 0; j < s.points.size(); ++j) expect_near(s.points[j], t.points[j], mm);
    }
    ASSERT_EQ(a.lines.size(), b.lines.size());
    for (std::size_t i = 0; i < a.lines.size(); ++i) {
        EXPECT_EQ(a.lines[i].page, b.lines[i].page);
        EXPECT_NEAR(a.lines[i].thickness_pt, b.lines[i].thickness_pt, 1e-6);
        EXPECT_EQ(a.lines[i].color, b.lines[i].color);
        ASSERT_EQ(a.lines[i].points.size(), b.lines[i].points.size());
        for (std::size_t j = 0; j < a.lines[i].points.size(); ++j) {
            expect_near(a.lines[i].points[j], b.lines[i].points[j], mm);
        }
    }
}

constexpr const char* kCanonical = R"(<?xml version="1.0" encoding="UTF-8"?>
<popup version="2.0" units="in">
  <mainpage width="11" height="8.5">
    <leftcolor>#ffffff</leftcolor>
  </mainpage>
  <structurelist>
    <structure type="beak" id="bird">
      <outerpoints>
        <point x="0" y="1.5"/>
        <point x="-1.25" y="0.5" page="0"/>
        <point x="1.25" y="0.333333"/>
      </outerpoints>
      <leftcolor>#ffcc00</leftcolor>
      <righttabcolor>#ff9900</righttabcolor>
      <parentfold page="0">
        <begin x="0" y="-4.25"/>
        <end x="0" y="4.25"/>
      </parentfold>
    </structure>
  </structurelist>
  <drawnlinelist>
    <drawnline page="0" thickness="2" color="#0000ff">
      <point x="-3" y="-2"/>
      <point x="-2" y="-2.5"/>
    </drawnline>
  </drawnlinelist>
</popup>
)";

TEST(XmlWriter, TheCanonicalSpellingIsWrittenAsItIs) {
    EXPECT_EQ(write_document(read(kCanonical)), kCanonical);
}

TEST(XmlWriter, GenerousSpellingsBecomeCanonical) {
    EXPECT_EQ(
        write_document(read(
            "<PopUp Units='inch'><main_page left_colour='white'/><structures><Structure TYPE='2' id='bird' "
            "leftcolor='255,204,0' righttabcolor='-26368'><point>0,1.5</point><point page='0'>-1.25,.5"
            "</point><point>1.25,0.33333333</point><parentfold begin='0,-4.25' end='0,4.25'/>"
            "</Structure></structures><drawnlinelist><line thickness='2.0' color='blue'>-3,-2 -2,-2.5"
            "</line></drawnlinelist></PopUp>")),
        kCanonical);
}

TEST(XmlWriter, AnEmptyCardIsADocument) {
    const std::string text = write_document(read("<popup units='pt'/>"));
    EXPECT_EQ(
        text,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<popup version=\"2.0\" units=\"pt\">\n"
        "  <mainpage width=\"792\" height=\"612\"/>\n  <structurelist>\n  </structurelist>\n</popup>\n");
}

TEST(XmlWriter, WhatIsWrittenReadsAsTheSameDesign) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Design design = test::generate(seed, 30);
        for (const double mm : {1.0, 10.0}) {
            design.unit = mm == 1.0 ? Unit{"mm", 1.0} : Unit{"cm", 10.0};
            const std::string text = write_document(design);
            const Design again = read(text);
            expect_same(design, again);
            EXPECT_EQ(write_document(again), text);
        }
    }
}

TEST(XmlWriter, DroppedElementsAreLeftOutAndTheOthersKeepTheirNames) {
    const std::string beak =
        "<structure type='2'><outerpoints>0,1 -1,0 1,0</outerpoints><parentfold begin='0,-4' "
        "end='0,4'/></structure>";
    const std::string line = "<drawnline>0,0 1,1</drawnline>";
    Design design = read("<popup><structurelist>" + beak + beak + beak + "</structurelist><drawnlinelist>" +
                         line + "</drawnlinelist></popup>");
    design.structures[1].dropped = true;
    design.lines[0].dropped = true;
    const Design again = read(write_document(design));
    ASSERT_EQ(again.structures.size(), 2U);
    EXPECT_EQ(again.structures[0].id, "e1");
    EXPECT_FALSE(again.structures[0].id_given);
    EXPECT_EQ(again.structures[1].id, "e3");
    EXPECT_TRUE(again.lines.empty());
}

TEST(XmlWriter, TheCheckedDesignIsWritten) {
    Diagnostics diagnostics("card.xml");
    const Design design = read(kCanonical);
    const auto checked = check(design, {}, diagnostics);
    ASSERT_TRUE(checked) << test::findings(diagnostics);
    const auto text = write_xml(*checked, {}, diagnostics);
    ASSERT_TRUE(text);
    EXPECT_EQ(*text, write_document(checked->design()));
}

}  // namespace
}  // namespace popup
