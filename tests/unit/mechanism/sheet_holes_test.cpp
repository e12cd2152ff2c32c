// Holes in a sheet: what they go through, what of folds and cuts they leave, and where none may be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "input/xml/read.h"
#include "output/xml.h"
#include "sheet_features.h"
#include "support/designs.h"

namespace popup::test {
namespace {

TEST(SheetHoles, AHoleGoesThroughAllThatItLiesOnAndSplitsFolds) {
    // Over the gutter below the box, over its left fold, and wholly in the box.
    const FromXml made = from_xml(box(-30, -10, 20, 40, "b") + hole("M -5 -40 h 10 v 20 h -10 Z", "a") +
                                  hole("M -34 0 h 8 v 10 h -8 Z M 5 0 h 5 v 5 h -5 Z", "c"));
    EXPECT_EQ(made.text, "");
    expect_sound(made, 200.0 + 80.0 + 25.0);
    EXPECT_EQ(made.assembly->plates.size(), 4U);
    const std::vector<Segment> valleys = lines_of(*made.assembly, LineKind::valley);
    EXPECT_NEAR(length_of(valleys), (150.0 - 50.0 - 20.0) + (50.0 - 10.0) + 50.0, 1e-6);
    for (const Segment& line : valleys) {
        const Vec2 middle = 0.5 * (line.a + line.b);
        EXPECT_FALSE(std::abs(middle.x) < 5.0 && middle.y > -40.0 && middle.y < -20.0);
    }
    // The border of the page, the two cuts of the box, less 2 mm that were cut already, and the holes.
    EXPECT_NEAR(length_of(lines_of(*made.assembly, LineKind::cut)), 700.0 + 100.0 + 60.0 + 36.0 + 20.0, 1e-6);
}

TEST(SheetHoles, AHoleOverACutTakesIt) {
    const FromXml made = from_xml(box(-30, -10, 20, 40, "b") + hole("M -15 35 h 10 v 10 h -10 Z"));
    EXPECT_EQ(made.text, "");
    expect_sound(made, 100.0);
    EXPECT_NEAR(length_of(lines_of(*made.assembly, LineKind::cut)), 700.0 + 100.0 - 10.0 + 40.0, 1e-6);
}

// Most holes of lace have nothing but paper round them.
TEST(SheetHoles, LaceLosesWhatItsHolesTake) {
    std::string lace;
    for (int i = 0; i < 12; ++i) {
        for (int k = 0; k < 15; ++k) {
            lace += hole(fmt::format("M {} {} h 4 v 5 h -4 Z", 10 + 7 * i, -60 + 8 * k),
                         fmt::format("h{}-{}", i, k));
        }
    }
    const FromXml made = from_xml(lace);
    EXPECT_EQ(made.text, "");
    expect_sound(made, 12 * 15 * 20.0);
    // A hole in one of them takes nothing, one over two of them what is left between, and one too near to the
    // edge is none.
    expect_sound(from_xml(lace + hole("M 10.5 -59.5 h 3 v 4 h -3 Z", "in")), 12 * 15 * 20.0);
    expect_sound(from_xml(lace + hole("M 12 -60 h 6 v 5 h -6 Z", "over")), 12 * 15 * 20.0 + 15.0);
    EXPECT_NE(from_xml(lace + hole("M 95 -60 h 4.5 v 5 h -4.5 Z", "near")).text.find("does-not-fit"),
              std::string::npos);
}

// What is left between two holes tears where it is narrow, but not where they meet, or one takes the other.
TEST(SheetHoles, TellsOfNarrowPaperBetweenTwoHoles) {
    const std::string one = hole("M 10 -60 h 4 v 5 h -4 Z", "one");
    EXPECT_EQ(
        from_xml(one + hole("M 14.3 -58 h 4 v 8 h -3 Z", "two")).text,
        "warning paper-too-thin: \"two\": only 0.30 mm of paper is left between it and another hole, at "
        "(14.15, -58.00) mm; below 0.50 mm it tears\n");
    for (const char* d : {"M 14.5 -58 h 4 v 8 h -4 Z", "M 14 -58 h 4 v 8 h -4 Z", "M 13 -58 h 4 v 8 h -4 Z",
                          "M 10.2 -59.8 h 3 v 4 h -3 Z", "M 9.8 -60.2 h 5 v 6 h -5 Z"}) {
        EXPECT_EQ(from_xml(one + hole(d, "two")).text, "") << d;
    }
    // A third hole has taken what is between the two.
    EXPECT_EQ(from_xml(one + hole("M 13 -58.5 h 1.8 v 3 h -1.8 Z", "over") +
                       hole("M 14.3 -58 h 4 v 2 h -4 Z", "two"))
                  .text,
              "");
}

TEST(SheetHoles, AHoleMayStandBesideTheStructures) {
    const auto read = [](const std::string& before, const std::string& inside) {
        Diagnostics diagnostics;
        auto design =
            xml::read({"card.xml", "<popup version='3.0' units='mm'><mainpage width='200' height='150'/>" +
                                       before + "<structurelist>" + box(-30, -10, 20, 40, "b") + inside +
                                       "</structurelist></popup>"},
                      {}, diagnostics);
        EXPECT_EQ(findings(diagnostics), "");
        return write_document(design.value());
    };
    const std::string d = "M -5 0 h 3 v 3 h -3 Z";
    const std::string as_structure = "<structure type='hole'><outline page='0' d='" + d + "'/></structure>";
    EXPECT_EQ(read("<hole page='0' d='" + d + "'/>", ""), read("", as_structure));
    EXPECT_EQ(
        read("<hole page='0' d='" + d + "'/><hole d='M 5 0 h 3 v 3 h -3 Z'/>", ""),
        read("", as_structure + "<structure type='hole'><outline d='M 5 0 h 3 v 3 h -3 Z'/></structure>"));
}

TEST(SheetHoles, RefusesHolesThatPartTheCard) {
    EXPECT_EQ(from_xml(hole("M 80 0 h 30 v 10 h -30 Z")).text,
              "error does-not-fit: \"hole\": it leaves the page by 10.00 mm\n");
    EXPECT_EQ(from_xml(hole("M 80 0 h 19.5 v 10 h -19.5 Z")).text,
              "error does-not-fit: \"hole\": it comes nearer than 1.00 mm to an edge of the page\n");
    EXPECT_EQ(
        from_xml(box(-30, -10, 20, 40, "b") + hole("M -12 -12 h 4 v 54 h -4 Z")).text,
        "error hole-off-piece: \"hole\": it leaves 0.00 mm of a fold of \"b\" in one stretch; the least is "
        "1.00 mm\n");
    EXPECT_EQ(from_xml(box(-30, -10, 20, 40, "b") + hole("M -25 -12 h 4 v 54 h -4 Z")).text,
              "error hole-off-piece: \"hole\": it cuts \"b/left\" into 2 parts\n");
    EXPECT_EQ(from_xml(hole("M 10 0 h 20 v 20 h -20 Z M 15 5 v 10 h 10 v -10 Z")).text,
              "error hole-off-piece: \"hole\": it has an island at (15.00, 5.00) mm, which would fall out\n");
    // What comes later keeps away from it.
    EXPECT_EQ(from_xml(hole("M 5 0 h 10 v 10 h -10 Z") + box(-20, -10, 20, 20, "b")).text.substr(0, 26),
              "warning does-not-fit: \"b\":");
}

// What a flag is glued to: 40 mm wide and 30 mm high, less its inset, which the glue keeps from the border.
std::string glued(const std::string& outline) {
    return "<structure type='attached-plane' id='flag'><outerpoints><point x='30' y='0'/><point x='30' "
           "y='20'/><point x='0' y='0'/><point x='0' y='20'/></outerpoints><outline d='" +
           outline + "'/><parentplate page='0' x='30' y='5'/></structure>";
}

// However far the border of the glued area is, and also where the hole cuts it.
TEST(SheetHoles, AHoleIsNotCutThroughWhatIsGlued) {
    const std::string flag = glued("M -20 -5 H 20 V 25 H -20 Z");
    EXPECT_EQ(from_xml(flag + hole("M 28 8 h 4 v 4 h -4 Z")).text,
              "error does-not-fit: \"hole\": it would cut 16.00 mm² out of the 1200.00 mm² that \"flag\" is "
              "glued to, at (30.00, 10.00) mm\n");
    EXPECT_EQ(from_xml(flag + hole("M 40 8 h 20 v 4 h -20 Z")).text,
              "error does-not-fit: \"hole\": it would cut 40.00 mm² out of the 1200.00 mm² that \"flag\" is "
              "glued to, at (45.00, 10.00) mm\n");
    // Beside it, in a hole of its glued area, and under it where the flag is listed later.
    EXPECT_EQ(from_xml(flag + hole("M 52 8 h 4 v 4 h -4 Z")).text, "");
    EXPECT_EQ(
        from_xml(glued("M -20 -5 H 20 V 25 H -20 Z M -10 5 V 15 H 10 V 5 Z") + hole("M 28 8 h 4 v 4 h -4 Z"))
            .text,
        "");
    EXPECT_EQ(from_xml(hole("M 28 8 h 4 v 4 h -4 Z") + flag).text, "");
}

}  // namespace
}  // namespace popup::test
