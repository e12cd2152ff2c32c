// Structures that are named elsewhere: as what others stand on, and as pages. What editors ask about them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lsp/server.h"
#include "support/lsp_client.h"

namespace popup::lsp {
namespace {

using namespace test_client;

// With characters that count two before what is asked about.
const std::string kNamed = R"(<popup version="3.0" units="mm">
  <mainpage width="200" height="140"/>
  <structurelist>
    <structure type="tent" id="roof">
      <outerpoints>
        <point x="-25" y="0"/>   <point x="-25" y="40"/> <point x="25" y="0"/>   <point x="25" y="40"/>
        <point x="-36" y="-20"/> <point x="-36" y="20"/> <point x="36" y="-20"/> <point x="36" y="20"/>
      </outerpoints>
      <parentfold on="gutter"/>
    </structure>
    <structure type="inverted-beak" id="flag">
      <outerpoints><point x="0" y="5"/> <point x="-8" y="-5"/> <point x="8" y="-5"/></outerpoints>
      <!-- 𝄞🎪 --><parentfold on="roof.Centre"/>
    </structure>
    <structure type="attached-plane" id="sign">
      <outerpoints>
        <point x="-10" y="-4"/> <point x="-10" y="4"/> <point x="0" y="-4"/> <point x="0" y="4"/>
      </outerpoints>
      <outline d="M 0 -4 L 0 4 L 20 4 L 20 -4 Z"/>
      <parentplate on="roof.left"/>
    </structure>
  </structurelist>
  <drawnlinelist><text page="roof" x="-9" y="1" height="3">A</text></drawnlinelist>
</popup>
)";

// The place of some characters behind the beginning of what stands there once.
Json place(const std::string& text, const std::string& what, std::size_t behind = 0) {
    const Text lines(text);
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    const Position found = lines.position(at + behind, Encoding::utf16);
    return test_client::at(found.line, found.character);
}

std::string edited(const std::string& text, const Json& edits) {
    const Text before(text);
    std::vector<TextEdit> all;
    for (const Json& one : edits)
        all.push_back(
            {span_of(one.at("range"), before, Encoding::utf16), one.at("newText").get<std::string>()});
    return with_edits(text, std::move(all));
}

std::vector<std::string> codes(const Json& published) {
    std::vector<std::string> all;
    for (const Json& one : published.at("diagnostics")) all.push_back(one.at("code"));
    return all;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

class NamedPlaces : public testing::Test {
 protected:
    NamedPlaces() { show(kNamed); }

    void show(const std::string& text) {
        client.open(text);
        found = client.look(Depth::check);
    }
    std::string hover(const std::string& what, std::size_t behind) {
        const Json result = client.ask("textDocument/hover", place(kNamed, what, behind))["result"];
        return result.is_null() ? std::string() : result["contents"]["value"].get<std::string>();
    }
    std::vector<std::string> offered(const std::string& text, const std::string& what, std::size_t behind) {
        client.change({{{"text", text}}}, ++version);
        std::vector<std::string> all;
        const Json answer = client.ask("textDocument/completion", place(text, what, behind));
        for (const Json& one : answer["result"]["items"]) all.push_back(one["label"]);
        return all;
    }

    Client client{kAbilities};
    Json found;
    int version = 1;
};

bool has(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

// A new id goes wherever the old one stood, and the document means what it meant.
TEST_F(NamedPlaces, FollowANewId) {
    ASSERT_EQ(codes(found), std::vector<std::string>{});
    const std::string wanted = replaced(kNamed, "roof", "house");
    for (const auto& [what, behind] : std::vector<std::pair<std::string, std::size_t>>{
             {"id=\"roof\"", 5}, {"roof.Centre", 0}, {"roof.left", 4}, {"page=\"roof\"", 8}}) {
        SCOPED_TRACE(what);
        const Json here = client.ask("textDocument/prepareRename", place(kNamed, what, behind))["result"];
        EXPECT_EQ(here["placeholder"], "roof");
        const Json renamed = client.ask("textDocument/rename",
                                        with(place(kNamed, what, behind), "newName", "house"))["result"];
        EXPECT_EQ(edited(kNamed, renamed["changes"][kUri]), wanted);
    }
    show(wanted);
    EXPECT_EQ(codes(found), std::vector<std::string>{});
    // The word of the fold is no id, nor are those of the page.
    for (const char* what : {".Centre", "gutter"})
        EXPECT_TRUE(client.ask("textDocument/prepareRename", place(kNamed, what, 2))["result"].is_null())
            << what;
    EXPECT_EQ(client.ask("textDocument/rename",
                         with(place(kNamed, "id=\"roof\"", 5), "newName", "gutter"))["error"]["message"],
              "the id \"gutter\" is kept for the base page");
}

TEST_F(NamedPlaces, LeadToTheirStructure) {
    const Json id = place(kNamed, "roof")["position"];
    for (const char* what : {"roof.Centre", "roof.left", "page=\"roof\""}) {
        const Json target = client.ask("textDocument/definition", place(kNamed, what, 7))["result"];
        EXPECT_EQ(target["range"]["start"], id) << what;
    }
    const Json all = client.ask("textDocument/references", with(place(kNamed, "roof"), "context",
                                                                {{"includeDeclaration", true}}))["result"];
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[0]["range"]["start"], id);
    EXPECT_EQ(all[1]["range"]["start"], place(kNamed, "roof.Centre")["position"]);
    EXPECT_EQ(all[2]["range"]["start"], place(kNamed, "roof.left")["position"]);
    EXPECT_EQ(all[3]["range"]["start"], place(kNamed, "page=\"roof\"", 6)["position"]);
}

TEST_F(NamedPlaces, AreToldUnderTheCursor) {
    EXPECT_TRUE(hover("roof.Centre", 6).ends_with("\n\nHere it is the centre fold of \"roof\"."))
        << hover("roof.Centre", 6);
    EXPECT_TRUE(hover("gutter", 2).ends_with("\n\nHere it is the gutter.")) << hover("gutter", 2);
    EXPECT_TRUE(hover("page=\"roof\"", 7).ends_with("\n\nHere it is that of the piece of \"roof\"."))
        << hover("page=\"roof\"", 7);
    // A structure with its measures.
    EXPECT_TRUE(
        hover("id=\"roof\"", 5)
            .starts_with(
                "\"roof\" stands on the gutter: at 20, length 40, width 50, height 25.904\n\n**tent**"))
        << hover("id=\"roof\"", 5);
}

// Whatever stands before it in the text, while it is being typed.
TEST_F(NamedPlaces, AreOffered) {
    const std::string folds = replaced(kNamed, "roof.Centre", "");
    EXPECT_EQ(offered(folds, "on=\"\"", 4),
              (std::vector<std::string>{"gutter", "roof.left", "roof.centre", "roof.right"}));
    const std::string open = replaced(kNamed, "roof.Centre\"/>", "ro");
    EXPECT_TRUE(has(offered(open, "on=\"ro\n", 6), "roof.centre"));
    const std::string plates = replaced(kNamed, "roof.left", "");
    EXPECT_EQ(offered(plates, "on=\"\"", 4),
              (std::vector<std::string>{"page.left", "page.right", "roof.left", "roof.right", "flag.left",
                                        "flag.right"}));
    EXPECT_EQ(offered(replaced(kNamed, "page=\"roof\"", "page=\"\""), "page=\"\"", 6),
              (std::vector<std::string>{"0", "1", "roof", "2", "sign"}));
    EXPECT_EQ(offered(replaced(replaced(kNamed, "page=\"roof\"", "page=\"\""), "3.0", "2.0"), "page=\"\"", 6),
              (std::vector<std::string>{"0", "1", "2"}));
    // As children of a structure.
    const std::string bare = replaced(kNamed, "<parentfold on=\"roof.Centre\"/>", "<p");
    EXPECT_TRUE(has(offered(bare, "<p\n", 2), "parentfold roof.centre"));
    const Json items = client.ask("textDocument/completion", place(bare, "<p\n", 2))["result"]["items"];
    const auto item = std::find_if(items.begin(), items.end(),
                                   [](const Json& one) { return one["label"] == "parentfold roof.centre"; });
    ASSERT_NE(item, items.end());
    EXPECT_EQ((*item)["textEdit"]["newText"], "<parentfold on=\"roof.centre\"/>");
    EXPECT_FALSE(has(offered(bare, "<p\n", 2), "parentplate roof.left")) << "a beak stands on no plate";
}

TEST_F(NamedPlaces, AreOfferedAsPlates) {
    const auto body = [this](const std::string& text, const std::string& label) {
        client.change({{{"text", text}}}, ++version);
        const Json items = client.ask("textDocument/completion", place(text, "<p\n", 2))["result"]["items"];
        const auto item =
            std::find_if(items.begin(), items.end(), [&](const Json& one) { return one["label"] == label; });
        return item == items.end() ? std::string() : (*item)["textEdit"]["newText"].get<std::string>();
    };
    const std::string bare = replaced(kNamed, "<parentplate on=\"roof.left\"/>", "<p");
    EXPECT_EQ(body(bare, "parentplate roof.left"), "<parentplate on=\"roof.left\"/>");
    EXPECT_EQ(body(bare, "parentplate page.right"), "<parentplate on=\"page.right\"/>");
    EXPECT_EQ(body(bare, "parentfold roof.centre"), "") << "an attached plane stands on no fold";
    EXPECT_EQ(body(bare, "parentplate"), "<parentplate on=\"$1\"/>");
    EXPECT_EQ(body(bare, "parentfold"), "<parentfold on=\"$1\"/>");
    // Names are from version 3.0 on.
    const std::string early = replaced(bare, "version=\"3.0\"", "version=\"2.0\"");
    EXPECT_EQ(body(early, "parentplate roof.left"), "");
    EXPECT_EQ(body(early, "parentplate"), "<parentplate page=\"${1:0}\" x=\"$2\" y=\"$3\"/>");
}

}  // namespace
}  // namespace popup::lsp
