// Files that are no designs of webOAcard, or not wholly: what is wrong is said where it stands.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "input/oa/read.h"
#include "unit/input/oa/oa_reading.h"

namespace popup {
namespace {

using test::Read;
using test::read;

struct Mistake {
    std::string name, text, code, says;
    int line = 1, column = 1;
    friend std::ostream& operator<<(std::ostream& out, const Mistake& one) { return out << one.name; }
};
class OaMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(OaMistakes, AreSaidWhereTheyStand) {
    const Mistake& one = GetParam();
    const Read made = read(one.text);
    EXPECT_FALSE(made.assembly);
    ASSERT_FALSE(made.findings.empty());
    EXPECT_EQ(made.findings[0].severity, Severity::error);
    EXPECT_EQ(made.findings[0].code, one.code) << made.told();
    EXPECT_NE(made.findings[0].message.find(one.says), std::string::npos) << made.told();
    EXPECT_EQ(made.findings[0].place.line, one.line) << made.told();
    EXPECT_EQ(made.findings[0].place.column, one.column) << made.told();
}

std::string with_face(const std::string& face) {
    return "{\"settings\": {\"cardW\": 100, \"cardH\": 80}, \"faces\": [\n" + face + "\n]}";
}

INSTANTIATE_TEST_SUITE_P(
    Oa, OaMistakes,
    testing::Values(
        Mistake{"empty", "", "empty-input", "the file is empty", 0, 0},
        Mistake{"cut off", "{\"settings\": {\"cardW\": 100", "oa-syntax", "this is not JSON", 1, 27},
        Mistake{"not a number", "{\"settings\": {\"cardW\": NaN}}", "oa-syntax", "this is not JSON", 1, 24},
        Mistake{"too large a number", "{\"settings\": {\"cardW\": 1e999}}", "oa-syntax", "this is not JSON",
                1, 29},
        Mistake{"a list", "[]", "oa-value", "the file must be an object with \"settings\" and \"faces\"", 1,
                1},
        Mistake{"no settings", "{\"faces\": []}", "oa-value", "the file has no \"settings\"", 1, 1},
        Mistake{"no width", "{\"settings\": {\"cardH\": 80}, \"faces\": []}", "oa-value",
                "settings has no \"cardW\"", 1, 14},
        Mistake{"no faces", "{\"settings\": {\"cardW\": 100, \"cardH\": 80}}", "oa-value",
                "the file has no \"faces\"", 1, 1},
        Mistake{"negative height", "{\"settings\": {\"cardW\": 100, \"cardH\": -80}, \"faces\": []}",
                "oa-value", "settings.cardH must be a number from 1 to 10000", 1, 38},
        Mistake{"face of another sort", with_face("7"), "oa-value", "faces[0] must be an object", 2, 1},
        Mistake{"no depth", with_face(R"({"contours": []})"), "oa-value", "faces[0] has no \"t\"", 2, 1},
        Mistake{"no contours", with_face(R"({"t": 20})"), "oa-value", "faces[0] has no \"contours\"", 2, 1},
        Mistake{"unknown mode", with_face(R"({"t": 20, "mode": 3, "contours": []})"), "oa-value",
                "faces[0].mode must be 0 (a face), 1 (a hole) or 2 (a pull)", 2, 19},
        Mistake{"horizontal", with_face(R"({"t": 20, "type": "HFACE", "contours": []})"), "oa-value",
                "faces[0].type must be \"VFACE\"", 2, 19},
        Mistake{"contour of another sort", with_face(R"({"t": 20, "contours": [[]]})"), "oa-value",
                "faces[0].contours[0] must be an object", 2, 24},
        Mistake{"point without Y", with_face(R"({"t": 20, "contours": [{"outer": [{"X": 1}]}]})"), "oa-value",
                "faces[0].contours[0].outer[0] must be a point", 2, 35},
        Mistake{"far out", with_face(R"({"t": 20, "contours": [{"outer": [{"X": 1e9, "Y": 0}]}]})"),
                "oa-value", "no further out than a kilometre", 2, 35},
        Mistake{"twice", with_face(R"({"t": 20, "t": 30, "contours": []})"), "oa-syntax",
                "the object has two members \"t\"", 2, 11},
        Mistake{"deep", std::string(500, '['), "oa-syntax", "nested more than 32 deep", 1, 33},
        Mistake{"all covered",
                with_face(R"({"t": 80, "contours": [{"outer": [{"X": 0, "Y": -80}, {"X": 100, "Y": -80},)"
                          R"( {"X": 100, "Y": 80}, {"X": 0, "Y": 80}]}]})"),
                "oa-no-card", "nothing is left of the back", 0, 0}));

TEST(OaFiles, UnknownMembersAreNamed) {
    const std::string text =
        with_face(R"({"t": 20, "colour": 1, "contours": [{"outer": [{"X": 10, "Y": 20}, {"X": 30, "Y": 20},)"
                  R"( {"X": 30, "Y": 5}, {"X": 10, "Y": 5}]}]})");
    const Read lenient = read(text);
    EXPECT_TRUE(lenient.assembly);
    EXPECT_EQ(lenient.told(), "unknown-member: \"colour\" is no member of this, and is not read\n");
    EXPECT_FALSE(read(text, true).assembly);
}

TEST(OaFiles, IsKnownByItsFirstMember) {
    EXPECT_TRUE(oa::recognises("  { \"settings\": {"));
    EXPECT_TRUE(oa::recognises("{\n\"faces\" : []"));
    EXPECT_FALSE(oa::recognises("{\"assembly\": 1}"));
    EXPECT_FALSE(oa::recognises("[{\"settings\""));
    EXPECT_FALSE(oa::recognises(""));
}

}  // namespace
}  // namespace popup
