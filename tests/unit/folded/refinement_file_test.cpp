// Refinement files: what is written is read, and what is none is told with its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "popup/files.h"
#include "popup/refinement.h"

namespace popup {
namespace {

TEST(RefinementFile, IsReadAsItWasWritten) {
    std::vector<Join> joins{
        {JoinKind::merge, {{"sheet/front", {20, 40.5}}, {"sheet/\"lid\"", {-3.25, 1e-3}}}},
        {JoinKind::paste, {{"sheet/glue-flap", {}}, {"sheet/front", {}}}},
        {JoinKind::coplanar, {{"sheet/1", {}}, {"sheet/2", {}}}}};
    joins[1].number = 3;
    for (const Ruler& ruler : {Ruler{}, Ruler{{3, 70}, 2.0, true, "px"}}) {
        const std::string text = write_refinement(joins, ruler);
        Diagnostics diagnostics;
        const auto read = read_refinement({"box.refine.json", text}, ruler, diagnostics);
        ASSERT_TRUE(read);
        EXPECT_EQ(write_refinement(*read, ruler), text);
        ASSERT_EQ(read->size(), 3U);
        EXPECT_EQ((*read)[0].parts[1].panel, "sheet/\"lid\"");
        EXPECT_NEAR((*read)[0].parts[1].corner.x, -3.25, 1e-9);
        EXPECT_NEAR((*read)[0].parts[0].corner.y, 40.5, 1e-9);
        EXPECT_EQ((*read)[1].number, 3);
        EXPECT_EQ((*read)[2].place, (Place{5, 5}));
    }
    // As findings show them: y goes down in drawings whose y does.
    EXPECT_NE(write_refinement(joins, {{0, 100}, 1.0, true, "mm"}).find("[20.0,59.5]"), std::string::npos);
    EXPECT_EQ(write_refinement({}, {}), "{\n  \"joins\": []\n}\n");
}

TEST(RefinementFile, IsRefusedWithItsPlace) {
    const auto told = [](const std::string& text) {
        Diagnostics diagnostics("r.json");
        EXPECT_FALSE(read_refinement({"r.json", text}, {}, diagnostics)) << text;
        EXPECT_EQ(diagnostics.sorted().size(), 1U);
        EXPECT_EQ(diagnostics.sorted().front().code, "bad-refinement");
        EXPECT_GT(diagnostics.sorted().front().place.line, 0);
        return diagnostics.sorted().front().message;
    };
    EXPECT_TRUE(told("{\n  x").starts_with("this is not JSON: "));
    EXPECT_TRUE(told(R"({"joins": [],})").starts_with("this is not JSON: "));
    EXPECT_EQ(told("[]"), "a refinement file is an object with a list \"joins\"");
    EXPECT_EQ(told(R"({"joins": [], "near": 4})"),
              "a refinement file has \"joins\" and nothing else, but this has \"near\"");
    EXPECT_EQ(told(R"({"joins": [3]})"), "join 1 is no object");
    EXPECT_EQ(told(R"({"joins": [{}]})"), "join 1 does not say what it joins");
    EXPECT_EQ(told(R"({"joins": [{"weld": []}]})"), "join 1 is a \"weld\", which is no way to join");
    EXPECT_EQ(told(R"({"joins": [{"paste": ["a", "b"]}, {"paste": ["a"]}]})"),
              "join 2 is a paste of 1 panels instead of two");
    EXPECT_EQ(told(R"({"joins": [{"paste": ["a", "b"], "number": 1.5}]})"),
              "join 1 has a \"number\" that is no number of a suggestion");
    EXPECT_EQ(told(R"({"joins": [{"merge": [{"panel": "a"}, {"panel": "b"}]}]})"),
              "join 1 is a merge of what has no \"panel\" or no \"corner\"");
    // What is no length, and what is nested beyond all measure.
    EXPECT_TRUE(told(R"({"joins": [{"merge": [{"panel": "a", "corner": [1e999, 0]}]}]})")
                    .starts_with("this is not JSON: number overflow"));
    EXPECT_EQ(told(R"({"joins": [{"merge": [{"panel": "a", "corner": [1e300, 0]}, {}]}]})"),
              "join 1 has a \"corner\" that is no place: two numbers, as findings print it");
    EXPECT_EQ(told("{\"joins\": [" + std::string(200'000, '[')), "values are nested more than 32 deep");
    // Long names are cut between characters.
    std::string name;
    for (int i = 0; i < 60; ++i) name += "é";
    EXPECT_EQ(told("{\"joins\": [{\"" + name + "\": []}]}"),
              "join 1 is a \"" + name.substr(0, 80) + "...\", which is no way to join");
}

}  // namespace
}  // namespace popup
