// schemas/popup.xsd, the element table and the writer say the same.
#include "input/xml/schema.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/xml.h"
#include "popup/language.h"
#include "popup/mechanism.h"
#include "support/designs.h"
#include "support/run_program.h"

namespace popup {
namespace {

namespace fs = std::filesystem;

fs::path schema_file() { return fs::path(POPUP_SOURCE_DIR) / "schemas" / "popup.xsd"; }

// What xmllint says of a document; empty when it is valid.
std::string violations(const std::string& document) {
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "card.xml", document);
    const test::RunResult result = test::run(
        {"xmllint", "--noout", "--schema", schema_file().string(), (scratch / "card.xml").string()});
    return result.exit == 0 ? std::string() : result.err;
}

// POPUP_UPDATE=1 writes the file anew.
TEST(Schema, TheShippedFileIsTheOneTheTablesMake) {
    const std::string rendered = xml::render_schema();
    const char* update = std::getenv("POPUP_UPDATE");
    if (update != nullptr && std::string(update) == "1") test::write_file(schema_file(), rendered);
    EXPECT_EQ(test::read_file(schema_file()), rendered);
}

TEST(Schema, EveryTypeOfTheTableIsAllowedByNameAndByCode) {
    const std::string schema = xml::render_schema();
    for (const ElementInfo& info : element_table()) {
        EXPECT_NE(schema.find("<xs:enumeration value=\"" + std::string(info.name) + "\">"),
                  std::string::npos);
        if (info.code < 0) continue;
        EXPECT_NE(schema.find("<xs:enumeration value=\"" + std::to_string(info.code) + "\"/>"),
                  std::string::npos);
    }
}

TEST(Schema, WhatTheWriterWritesIsValid) {
    if (!test::have_program("xmllint")) GTEST_SKIP() << "xmllint (libxml2-utils) is not installed";
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Design design = test::generate(seed, 40);
        design.left = Color{1, 2, 3};
        design.structures.front().argument(2).value = Color{};
        DrawnLine line;
        line.points.resize(2);
        line.points[1].at = {1e-7, 1e6};
        line.thickness_pt = 0.5;
        design.lines.push_back(line);
        EXPECT_EQ(violations(write_document(design)), "");
    }
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        EXPECT_EQ(violations(write_document(test::generate_any(seed, 12))), "");
    EXPECT_EQ(violations(write_document(test::card())), "");
}

TEST(Schema, WhatIsNotCanonicalIsInvalid) {
    if (!test::have_program("xmllint")) GTEST_SKIP() << "xmllint (libxml2-utils) is not installed";
    const std::string good = R"(<popup version="2.0" units="in">
  <mainpage width="11" height="8.5"/>
  <structurelist>
    <structure type="beak" id="a">
      <outerpoints><point x="0" y="1.5"/><point x="-1.25" y="0.5"/><point x="1.25" y="5e-1" page="0"/></outerpoints>
      <leftcolor>#ffcc00</leftcolor>
      <parentfold page="0"><begin x="0" y="-4.25"/><end x="0" y="4.25"/></parentfold>
    </structure>
    <structure type="2" id="b">
      <outerpoints><point x="0" y="1.5"/><point x="-1.25" y="0.5"/><point x="1.25" y=".5"/></outerpoints>
      <parentfold><begin x="0" y="-4.25"/><end x="0" y="4.25"/></parentfold>
    </structure>
  </structurelist>
  <drawnlinelist><drawnline thickness="2"><point x="-3" y="-2"/><point x="-2" y="-2.5"/></drawnline></drawnlinelist>
</popup>)";
    ASSERT_EQ(violations(good), "");
    const std::vector<std::pair<std::string, std::string>> slips{
        {"<popup ", "<popupp "},
        {"units=\"in\"", "units=\"furlong\""},
        {"version=\"2.0\"", "version=\"1.0\""},
        {"width=\"11\"", "width=\"0\""},
        {"width=\"11\"", "width=\"INF\""},
        {"width=\"11\"", "depth=\"11\""},
        {"type=\"beak\"", "type=\"beek\""},
        {"type=\"2\"", "type=\"9\""},
        {"id=\"b\"", "id=\"a\""},
        {"id=\"b\"", "id=\"1\""},
        {"x=\"0\"", "x=\"NaN\""},
        {"x=\"0\"", "x=\"1,5\""},
        {"x=\"0\"", "x=\"0x1\""},
        {"page=\"0\"", "page=\"-1\""},
        {"page=\"0\"", "page=\"0.5\""},
        {"#ffcc00", "gold"},
        {"<point x=\"0\" y=\"1.5\"/>", "<point>0,1.5</point>"},
        {"<point x=\"0\" y=\"1.5\"/><point x=\"-1.25\" y=\"0.5\"/><point x=\"1.25\" y=\"5e-1\" page=\"0\"/>",
         ""},
        {"<end x=\"0\" y=\"4.25\"/>", ""},
        {"thickness=\"2\"", "thickness=\"-1\""},
        {"<point x=\"-3\" y=\"-2\"/>", ""},
    };
    for (const auto& [old, fresh] : slips) {
        std::string text = good;
        text.replace(text.find(old), old.size(), fresh);
        EXPECT_NE(violations(text), "") << old << " became " << fresh;
    }
}

}  // namespace
}  // namespace popup
