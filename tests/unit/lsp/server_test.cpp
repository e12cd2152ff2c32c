// The server: messages in, messages out, without threads and clocks.
#include "lsp/server.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/random.h"
#include "support/run_program.h"

namespace popup::lsp {
namespace {

const std::string kUri = "file:///cards/camp.xml";

// A client in the test's own thread: what the server has to say is handed over at once.
class Client {
 public:
    explicit Client(Json abilities = Json::object()) : server_({}) {
        if (abilities.is_null()) return;
        const Json answer = ask("initialize", {{"capabilities", std::move(abilities)}});
        greeting = answer["result"];
        notify("initialized", Json::object());
    }

    // All that comes in answer to a body.
    std::vector<Json> send(const std::string& body) {
        server_.receive(body);
        return handle();
    }
    std::vector<Json> handle() {
        while (server_.step()) {
        }
        std::vector<Json> all;
        for (const std::string& one : server_.take_sent()) all.push_back(Json::parse(one));
        return all;
    }
    Json ask(const std::string& method, Json params) {
        const int id = ++id_;
        for (Json& one :
             send(Json{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", std::move(params)}}
                      .dump())) {
            if (one.contains("id") && one["id"] == id && !one.contains("method")) return one;
        }
        ADD_FAILURE() << method << " was not answered";
        return nullptr;
    }
    std::vector<Json> notify(const std::string& method, Json params) {
        return send(Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}}.dump());
    }
    void open(const std::string& text, const std::string& uri = kUri) {
        notify("textDocument/didOpen",
               {{"textDocument", {{"uri", uri}, {"languageId", "x"}, {"version", 1}, {"text", text}}}});
    }
    void change(Json changes, int version, const std::string& uri = kUri) {
        notify("textDocument/didChange", {{"textDocument", {{"uri", uri}, {"version", version}}},
                                          {"contentChanges", std::move(changes)}});
    }
    // Does what is due of that depth, and returns the diagnostics that were published last.
    Json look(Depth depth, const std::string& uri = {}) {
        Json found;
        while (const auto work = server_.next_work(depth, Clock::now())) server_.finish(*work, run(*work));
        for (Json& one : handle()) {
            if (one.value("method", "") != "textDocument/publishDiagnostics") continue;
            if (uri.empty() || one["params"]["uri"] == uri) found = one["params"];
        }
        return found;
    }
    Server& server() { return server_; }
    Json greeting;

 private:
    Server server_;
    int id_ = 0;
};

Json at(int line, int character, const std::string& uri = kUri) {
    return {{"textDocument", {{"uri", uri}}}, {"position", {{"line", line}, {"character", character}}}};
}

Json with(Json params, const std::string& name, Json value) {
    params[name] = std::move(value);
    return params;
}

const Json kAbilities{{"textDocument",
                       {{"hover", {{"contentFormat", Json::array({"markdown"})}}},
                        {"completion", {{"completionItem", {{"snippetSupport", true}}}}},
                        {"documentSymbol", {{"hierarchicalDocumentSymbolSupport", true}}},
                        {"codeAction", {{"codeActionLiteralSupport", Json::object()}}}}}};

const std::string kCamp = R"(<popup version="2.0" units="mm">
  <mainpage width="200" height="140"/>
  <structurelist>
    <structure type="tent" id="tent">
      <outerpoints>
        <point x="-25" y="0"/>   <point x="-25" y="40"/>
        <point x="25" y="0"/>    <point x="25" y="40"/>
        <point x="-22" y="-20"/> <point x="-22" y="20"/>
        <point x="22" y="-20"/>  <point x="22" y="20"/>
      </outerpoints>
      <parentfold>
        <begin x="0" y="-70"/> <end x="0" y="70"/>
      </parentfold>
    </structure>
    <structure type="inverted-beak" id="flag">
      <outerpoints>
        <point x="0" y="15"/> <point x="-8" y="5"/> <point x="8" y="5"/>
      </outerpoints>
      <leftcolor>gold</leftcolor>
      <parentfold page="1">
        <begin x="0" y="-20"/> <end x="0" y="20"/>
      </parentfold>
    </structure>
  </structurelist>
</popup>
)";

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

TEST(Server, TellsWhatItCanDo) {
    const Client plain;
    EXPECT_EQ(plain.greeting["capabilities"]["positionEncoding"], "utf-16");
    EXPECT_EQ(plain.greeting["capabilities"]["textDocumentSync"]["change"], 2);
    EXPECT_EQ(plain.greeting["serverInfo"]["name"], "popupc");
    EXPECT_FALSE(plain.greeting["capabilities"].contains("documentFormattingProvider"));
    const Client bytes(Json{{"general", {{"positionEncodings", {"klingon", 3, "utf-8", "utf-16"}}}}});
    EXPECT_EQ(bytes.greeting["capabilities"]["positionEncoding"], "utf-8");
}

TEST(Server, FindsAsOneTypes) {
    Client client(kAbilities);
    client.open(kCamp);
    const Json found = client.look(Depth::check);
    ASSERT_EQ(codes(found), std::vector<std::string>{"tent-too-narrow"});
    EXPECT_EQ(found["version"], 1);
    const Json& one = found["diagnostics"][0];
    EXPECT_EQ(one["range"],
              (Json{{"start", {{"line", 3}, {"character", 4}}}, {"end", {{"line", 3}, {"character", 14}}}}));
    EXPECT_EQ(one["severity"], 2);
    EXPECT_EQ(one["source"], "popupc");
    // In two edits of one message the piece becomes wide enough; the second range is of the text after the
    // first.
    client.change(
        {{{"range", {{"start", {{"line", 7}, {"character", 19}}}, {"end", {{"line", 7}, {"character", 21}}}}},
          {"text", "36"}},
         {{"range", {{"start", {{"line", 7}, {"character", 44}}}, {"end", {{"line", 7}, {"character", 46}}}}},
          {"text", "36"}},
         {{"range", {{"start", {{"line", 8}, {"character", 18}}}, {"end", {{"line", 8}, {"character", 20}}}}},
          {"text", "36"}},
         {{"range", {{"start", {{"line", 8}, {"character", 43}}}, {"end", {{"line", 8}, {"character", 45}}}}},
          {"text", "36"}}},
        2);
    const Json mended = client.look(Depth::check);
    EXPECT_TRUE(codes(mended).empty());
    EXPECT_EQ(mended["version"], 2);
    client.notify("textDocument/didClose", {{"textDocument", {{"uri", kUri}}}});
    EXPECT_FALSE(client.server().next_work(Depth::check, Clock::now()));
}

TEST(Server, OnlyTheRunOfTheLatestTextTells) {
    Client client(kAbilities);
    client.open(kCamp);
    const auto old = client.server().next_work(Depth::check, Clock::now());
    ASSERT_TRUE(old);
    client.change({{{"text", "<popup/>"}}}, 2);
    client.server().finish(*old, run(*old));
    EXPECT_TRUE(client.handle().empty()) << "what was found in a text that is gone";
    EXPECT_EQ(client.look(Depth::check)["version"], 2);
    EXPECT_FALSE(client.server().next_work(Depth::whole, Clock::time_point{})) << "one is still typing";
    EXPECT_TRUE(client.server().next_work(Depth::whole, Clock::now()));
}

TEST(Server, MendsOneFindingAllOfThemAndAllowsOne) {
    Client client(kAbilities);
    client.open(kCamp);
    const Json params{
        {"textDocument", {{"uri", kUri}}},
        {"range", {{"start", {{"line", 3}, {"character", 6}}}, {"end", {{"line", 3}, {"character", 6}}}}},
        {"context", {{"diagnostics", Json::array()}}}};
    const Json actions = client.ask("textDocument/codeAction", params)["result"];
    ASSERT_EQ(actions.size(), 2U);
    EXPECT_EQ(actions[0]["title"], "Mend \"tent\": tent-too-narrow");
    EXPECT_EQ(actions[0]["isPreferred"], true);
    EXPECT_EQ(actions[1]["title"], "Make all repairs");
    EXPECT_EQ(actions[1]["kind"], "quickfix");
    for (const Json& action : actions) {
        const std::string text = edited(kCamp, action["edit"]["changes"][kUri]);
        Client other(kAbilities);
        other.open(text);
        EXPECT_TRUE(codes(other.look(Depth::check)).empty()) << action["title"];
    }
    Json only = params;
    only["context"]["only"] = Json::array({"source.fixAll"});
    const Json before_saving = client.ask("textDocument/codeAction", only)["result"];
    ASSERT_EQ(before_saving.size(), 1U);
    EXPECT_EQ(before_saving[0]["kind"], "source.fixAll");
}

// Two v-folds through one another: the move that was tried, and the comment that allows them.
TEST(Server, OffersTheMoveOfACollision) {
    const std::string text =
        test::read_file(std::string(POPUP_SOURCE_DIR) + "/tests/cases/found/collide.xml");
    ASSERT_FALSE(text.empty());
    Client client(kAbilities);
    client.open(text);
    client.look(Depth::check);
    const Json found = client.look(Depth::whole);
    const auto collision = std::find_if(found["diagnostics"].begin(), found["diagnostics"].end(),
                                        [](const Json& one) { return one["code"] == "collision"; });
    ASSERT_NE(collision, found["diagnostics"].end());
    EXPECT_EQ((*collision)["relatedInformation"].size(), 1U);
    const Json actions = client.ask("textDocument/codeAction", {{"textDocument", {{"uri", kUri}}},
                                                                {"range", (*collision)["range"]}})["result"];
    ASSERT_GE(actions.size(), 2U);
    EXPECT_TRUE(actions[0]["title"].get<std::string>().starts_with("Move \"")) << actions[0]["title"];
    for (const Json& action : {actions[0], actions[1]}) {
        Client other(kAbilities);
        other.open(edited(text, action["edit"]["changes"][kUri]));
        other.look(Depth::check);
        EXPECT_EQ(codes(other.look(Depth::whole)), std::vector<std::string>{}) << action["title"];
    }
}

// While the motion is examined anew, what was found before stays, where its element is now.
TEST(Server, KeepsFindingsOfTheMotionUntilTheNextExamination) {
    const std::string text =
        test::read_file(std::string(POPUP_SOURCE_DIR) + "/tests/cases/found/collide.xml");
    Client client(kAbilities);
    client.open(text);
    client.look(Depth::check);
    const Json before = client.look(Depth::whole);
    client.change(
        {{{"range", {{"start", {{"line", 0}, {"character", 0}}}, {"end", {{"line", 0}, {"character", 0}}}}},
          {"text", "<!-- one line more -->\n"}}},
        2);
    const Json after = client.look(Depth::check);
    ASSERT_EQ(codes(after), codes(before));
    EXPECT_EQ(after["diagnostics"][0]["range"]["start"]["line"].get<int>(),
              before["diagnostics"][0]["range"]["start"]["line"].get<int>() + 1);
}

TEST(Server, KnowsWhatStandsUnderTheCursor) {
    Client client(kAbilities);
    client.open(kCamp);
    client.look(Depth::check);
    const auto hover = [&](int line, int character) {
        const Json result = client.ask("textDocument/hover", at(line, character))["result"];
        return result.is_null() ? std::string() : result["contents"]["value"].get<std::string>();
    };
    EXPECT_NE(hover(14, 8).find("\"flag\" stands on the centre fold of \"tent\""), std::string::npos)
        << hover(14, 8);
    EXPECT_NE(hover(3, 6).find("**tent-too-narrow**"), std::string::npos) << "the finding is explained";
    EXPECT_EQ(hover(16, 32),
              "**B**, point 2 of 3 of an inverted-beak: on the left, on the page of what it stands on; its "
              "partner is E");
    EXPECT_EQ(hover(18, 18), "`#ffd700`: red 255, green 215, blue 0 (*gold*)");
    EXPECT_EQ(hover(1, 5), "**mainpage**: the base page: the card itself, laid flat");
    EXPECT_EQ(hover(2, 0), "");
}

TEST(Server, ShowsTheTreeFindsAndRenames) {
    Client client(kAbilities);
    client.open(kCamp);
    client.look(Depth::check);
    const Json tree =
        client.ask("textDocument/documentSymbol", {{"textDocument", {{"uri", kUri}}}})["result"];
    ASSERT_EQ(tree.size(), 2U);
    EXPECT_EQ(tree[1]["name"], "tent");
    EXPECT_EQ(tree[1]["children"][0]["name"], "flag") << "it stands on the tent";
    const Json target = client.ask("textDocument/definition", at(19, 10))["result"];
    EXPECT_EQ(target["range"]["start"], (Json{{"line", 3}, {"character", 31}}));
    const Json all = client.ask("textDocument/references",
                                with(at(3, 32), "context", {{"includeDeclaration", true}}))["result"];
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1]["range"]["start"]["line"], 19);
    const Json renamed = client.ask("textDocument/rename", with(at(3, 32), "newName", "marquee"))["result"];
    EXPECT_NE(edited(kCamp, renamed["changes"][kUri]).find("id=\"marquee\""), std::string::npos);
    const auto refusal = [&](const std::string& name) {
        return client.ask("textDocument/rename", with(at(3, 32), "newName", name))["error"].value("message",
                                                                                                  "");
    };
    EXPECT_EQ(refusal("flag"), "there is an element \"flag\" already");
    EXPECT_EQ(refusal("page"), "the id \"page\" is kept for the base page");
    EXPECT_TRUE(refusal("a b").starts_with("\"a b\" cannot be an id"));
}

std::vector<std::string> labels(Client& client, int line, int character, const std::string& uri = kUri) {
    std::vector<std::string> all;
    const Json answer = client.ask("textDocument/completion", at(line, character, uri));
    for (const Json& one : answer["result"]["items"]) all.push_back(one["label"]);
    return all;
}

bool has(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

// What may stand there follows from the rows: every element, every parameter.
TEST(Server, CompletesFromTheRows) {
    Client client(kAbilities);
    client.open(kCamp);
    client.look(Depth::check);
    const auto types = labels(client, 3, 22);
    for (const ElementInfo& row : element_table()) EXPECT_TRUE(has(types, std::string(row.name))) << row.name;
    EXPECT_TRUE(has(labels(client, 18, 17), "gold"));
    EXPECT_TRUE(has(labels(client, 0, 30), "mm"));
    client.change({{{"text",
                     "<popup version=\"3.0\" units=\"mm\">\n<structurelist>\n<\n<structure type=\"box\" "
                     ">\n<\n</structure>\n</structurelist>\n</popup>"}}},
                  2);
    const auto elements = labels(client, 2, 1);
    for (const ElementInfo& row : element_table())
        EXPECT_TRUE(has(elements, "structure " + std::string(row.name))) << row.name;
    const ElementInfo* box = find_element("box");
    ASSERT_NE(box, nullptr);
    const auto attributes = labels(client, 3, 22);
    EXPECT_FALSE(has(attributes, "type")) << "it is there already";
    EXPECT_TRUE(has(attributes, "id"));
    const auto children = labels(client, 4, 1);
    for (const ParameterInfo& one : box->parameters) {
        const bool attribute = one.kind == ParameterKind::length || one.kind == ParameterKind::number ||
                               one.kind == ParameterKind::choice;
        if (!one.group.empty()) continue;
        EXPECT_TRUE(has(attribute ? attributes : children, std::string(one.name))) << one.name;
    }
    EXPECT_TRUE(has(children, "parentfold tent.centre")) << "folds of the last text that could be read";
    client.change({{{"text", "<popup>\n<!-- popupc: allow col -->\n</popup>"}}}, 3);
    EXPECT_TRUE(has(labels(client, 1, 25), "collision"));
    EXPECT_FALSE(has(labels(client, 1, 25), "xml-syntax")) << "errors cannot be allowed";
}

// A document that is being typed keeps its tree, at the right places.
TEST(Server, AnswersInTheMiddleOfTyping) {
    Client client(kAbilities);
    client.open(kCamp);
    client.look(Depth::check);
    // A tag without an end, with characters that count two, before all the rest.
    const std::string typed = "<structure type=\"v-fold\" id=\"𝄞🎪\" <point x=\"1\n    ";
    client.change(
        {{{"range", {{"start", {{"line", 3}, {"character", 4}}}, {"end", {{"line", 3}, {"character", 4}}}}},
          {"text", typed}}},
        2);
    EXPECT_EQ(codes(client.look(Depth::check)), std::vector<std::string>{"xml-syntax"});
    const Json tree =
        client.ask("textDocument/documentSymbol", {{"textDocument", {{"uri", kUri}}}})["result"];
    ASSERT_EQ(tree.size(), 3U);
    EXPECT_EQ(tree[1]["selectionRange"],
              (Json{{"start", {{"line", 3}, {"character", 33}}}, {"end", {{"line", 3}, {"character", 37}}}}));
    EXPECT_EQ(tree[2]["name"], "tent");
    EXPECT_EQ(tree[2]["selectionRange"]["start"]["line"], 4);
    EXPECT_EQ(tree[2]["children"][0]["name"], "flag") << "as it stood when the text could be read last";
    EXPECT_EQ(client.ask("textDocument/definition", at(20, 10))["result"]["range"]["start"]["line"], 4);
}

TEST(Server, SpeaksBytesAndCrLf) {
    Client client(
        {{"general", {{"positionEncodings", {"utf-8"}}}}, {"textDocument", kAbilities["textDocument"]}});
    client.open("<popup>\r\n  <!-- 🎪 --> <strange/>\r\n</popup>\r\n");
    const Json found = client.look(Depth::check);
    ASSERT_EQ(codes(found), std::vector<std::string>{"unknown-markup"});
    EXPECT_EQ(found["diagnostics"][0]["range"]["start"], (Json{{"line", 1}, {"character", 16}}));
    const Json actions = client.ask(
        "textDocument/codeAction",
        {{"textDocument", {{"uri", kUri}}}, {"range", found["diagnostics"][0]["range"]}})["result"];
    ASSERT_EQ(actions.size(), 1U);
    EXPECT_EQ(actions[0]["edit"]["changes"][kUri][0]["newText"],
              "\r\n  <!-- popupc: allow unknown-markup -->");
}

TEST(Server, DocumentsOfOthersAreLeftAlone) {
    Client client(kAbilities);
    client.open("<html><body/></html>");
    EXPECT_TRUE(codes(client.look(Depth::check)).empty());
    client.open("a, b\n1, 2\n", "file:///cards/table.csv");
    EXPECT_FALSE(client.server().next_work(Depth::check, Clock::now()));
    EXPECT_TRUE(client.ask("textDocument/hover", at(0, 0, "file:///cards/table.csv"))["result"].is_null());
}

const std::string kProgram = R"(load("lib.fl")
; draws a star with so many points
define star(points, size)
  repeat (points) forward(size) right(360 / points) done
done
card = popup(8, 6)
size = 2
star(5, size)
sta
)";

TEST(Server, KnowsPrograms) {
    const std::string uri = "file:///cards/star.fl";
    const std::string library = "file:///cards/lib.fl";
    Client client(kAbilities);
    client.open("define helper(size) forward(size) done  ; goes\n", library);
    client.open(kProgram, uri);
    client.look(Depth::check);
    const auto hover = [&](int line, int character) {
        return client.ask("textDocument/hover", at(line, character, uri))["result"]["contents"]["value"]
            .get<std::string>();
    };
    EXPECT_EQ(hover(7, 1), "```flatlang\ndefine star(points, size)\n```\n\ndraws a star with so many points");
    EXPECT_EQ(hover(3, 20), "```flatlang\nforward(amt)\n```\n\ngoes ahead, by so many inches");
    const auto offered = labels(client, 8, 3, uri);
    for (const char* name :
         {"star", "helper", "forward", "gear", "v_fold", "popup", "define", "card", "sqrt"})
        EXPECT_TRUE(has(offered, name)) << name;
    EXPECT_FALSE(has(offered, "__forward"));
    EXPECT_TRUE(has(labels(client, 0, 6, uri), "kit/gear.fl"));
    EXPECT_EQ(client.ask("textDocument/definition", at(7, 1, uri))["result"]["range"]["start"]["line"], 2);
    // Scope is dynamic, so a name is one name in all files of the program.
    const Json renamed =
        client.ask("textDocument/rename", with(at(6, 1, uri), "newName", "inches"))["result"]["changes"];
    EXPECT_EQ(renamed[library].size(), 2U);
    EXPECT_EQ(renamed[uri].size(), 4U);
    const auto refusal = [&](int line, int character, const std::string& name) {
        return client.ask("textDocument/rename", with(at(line, character, uri), "newName", name))["error"]
            .value("message", "");
    };
    EXPECT_EQ(refusal(3, 20, "ahead"), "\"forward\" is a name of the language or of its kit");
    EXPECT_EQ(refusal(6, 1, "helper"), "\"helper\" is in use already, in /cards/lib.fl");
    EXPECT_TRUE(refusal(6, 1, "done").starts_with("a name is letters"));
    const Json symbols =
        client.ask("textDocument/documentSymbol", {{"textDocument", {{"uri", uri}}}})["result"];
    ASSERT_EQ(symbols.size(), 3U);
    EXPECT_EQ(symbols[0]["name"], "star");
}

// What an editor has open counts before the disk, where nothing of that name may even be.
TEST(Server, TextsInMemoryWinOverTheDisk) {
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "lib.fl", "define helper() print(\"disk\") done\n");
    const std::string folder = "file://" + scratch.path().string();
    Client client(kAbilities);
    const std::string main = folder + "/main.fl";
    client.open("load(\"lib.fl\")\npopup(8, 6)\nhelper(1)\n", main);
    EXPECT_EQ(codes(client.look(Depth::check, main)), std::vector<std::string>{"flatlang-argument-count"});
    client.open("define helper(x) print(x) done\n", folder + "/lib.fl");
    EXPECT_EQ(codes(client.look(Depth::check, main)), std::vector<std::string>{}) << "as it is open";
    client.notify("textDocument/didClose", {{"textDocument", {{"uri", folder + "/lib.fl"}}}});
    EXPECT_EQ(codes(client.look(Depth::check, main)), std::vector<std::string>{"flatlang-argument-count"});
    // A file that is nowhere but in the editor.
    client.open("load(\"new.fl\")\n", main);
    EXPECT_FALSE(codes(client.look(Depth::check, main)).empty());
    client.open("popup(8, 6)\n", folder + "/new.fl");
    EXPECT_EQ(codes(client.look(Depth::check, main)), std::vector<std::string>{});
}

std::vector<int> errors(const std::vector<Json>& answers) {
    std::vector<int> all;
    for (const Json& one : answers)
        all.push_back(one.contains("error") ? one["error"]["code"].get<int>() : 0);
    return all;
}

TEST(Server, AnswersWhatIsNoMessage) {
    Client client(kAbilities);
    const std::vector<std::pair<std::string, std::vector<int>>> cases{
        {"", {-32700}},
        {"{", {-32700}},
        {"\xff\xfe", {-32700}},
        {R"({"jsonrpc": "2.0", "id": 1, "method": "\ud800"})", {-32700}},
        {std::string(1000, '['), {-32700}},
        {"[" + std::string(5'000'000, ',') + "]", {-32700}},
        {"[]", {-32600}},
        {"null", {-32600}},
        {R"({"id": 1})", {-32600}},
        {R"({"id": {"a": 1}, "method": "shutdown"})", {-32600}},
        {R"({"id": 1, "method": 7})", {-32600}},
        {R"({"id": 1, "method": "initialize", "params": {}})", {-32600}},
        {R"({"id": 1, "method": "no/such"})", {-32601}},
        {R"({"method": "no/such"})", {}},
        {R"({"id": 1, "result": null})", {}},
        {R"({"id": 1, "error": {}})", {}},
        {R"({"id": 1, "method": "textDocument/hover"})", {-32602}},
        {R"({"id": 1, "method": "textDocument/hover", "params": [1]})", {-32602}},
        {R"({"id": 1, "method": "textDocument/hover", "params": {"textDocument": {"uri": 4}}})", {-32602}},
        {R"({"id": 1, "method": "textDocument/hover", "params": {"textDocument": {"uri": "file:///none"}}})",
         {0}},
        {R"({"id": 1.5, "method": "textDocument/hover", "params": null})", {-32602}},
    };
    for (const auto& [body, expected] : cases)
        EXPECT_EQ(errors(client.send(body)), expected) << body.substr(0, 80);
    // Positions that no text has.
    client.open(kCamp);
    for (const char* number : {"-1", "4294967296", "1e300", "99999999999999999999", "0.5"}) {
        const std::string body =
            R"({"id": 2, "method": "textDocument/hover", "params": {"textDocument": {"uri": ")" + kUri +
            R"("}, "position": {"line": )" + number + R"(, "character": )" + number + "}}}";
        EXPECT_EQ(client.send(body).size(), 1U) << number;
    }
}

TEST(Server, KeepsTheOrderOfALife) {
    Client client(Json(nullptr));  // not greeted
    EXPECT_EQ(errors(client.send(R"({"id": 1, "method": "textDocument/hover"})")), std::vector<int>{-32002});
    EXPECT_EQ(errors(client.send(R"({"id": 1, "method": "shutdown"})")), std::vector<int>{-32002});
    EXPECT_TRUE(client.notify("textDocument/didOpen", Json::object()).empty());
    EXPECT_EQ(errors(client.send(R"({"id": "a", "method": "initialize"})")), std::vector<int>{0});
    EXPECT_EQ(errors(client.send(R"({"id": "a", "method": "shutdown"})")), std::vector<int>{0});
    EXPECT_EQ(errors(client.send(R"({"id": "a", "method": "textDocument/hover"})")),
              std::vector<int>{-32600});
    EXPECT_FALSE(client.server().ended());
    client.notify("exit", Json::object());
    EXPECT_TRUE(client.server().ended());
    EXPECT_EQ(client.server().exit_code(), 0);
    Client rude(kAbilities);
    rude.notify("exit", Json::object());
    EXPECT_EQ(rude.server().exit_code(), 1);
}

TEST(Server, DoesNotDoWhatWasCancelledWhileItWaited) {
    Client client(kAbilities);
    client.server().receive(R"({"id": 7, "method": "no/such"})");
    client.server().receive(R"({"id": 8, "method": "no/such"})");
    client.server().receive(R"({"id": 7, "method": "no/such"})");  // an id that is in use already
    client.server().receive(R"({"method": "$/cancelRequest", "params": {"id": 8}})");
    client.server().receive(R"({"method": "$/cancelRequest", "params": {"id": 99}})");
    client.server().receive(R"({"method": "$/cancelRequest", "params": 3})");
    EXPECT_EQ(errors(client.handle()), (std::vector<int>{-32601, -32800, -32601}));
}

// A half of a change that makes no sense is not made.
TEST(Server, ChangesAreMadeWholeOrNotAtAll) {
    Client client(kAbilities);
    client.open("<popup/>");
    client.change({{{"text", "<popup><structurelist/></popup>"}}, {{"range", 3}, {"text", "x"}}}, 2);
    client.change({{{"text", 5}}}, 3);
    const auto work = client.server().next_work(Depth::check, Clock::now());
    ASSERT_TRUE(work);
    EXPECT_EQ(work->source.text, "<popup/>");
}

// Messages damaged in any way, to documents damaged in any way: the server answers, and goes on answering.
TEST(Server, GoesOnWhateverComes) {
    const std::vector<std::string> methods{"hover",         "completion",     "definition", "references",
                                           "prepareRename", "documentSymbol", "codeAction", "documentColor"};
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        test::Random random(seed);
        Client client(kAbilities);
        const std::string uri = seed % 2 == 0 ? kUri : "file:///cards/star.fl";
        std::string text = seed % 2 == 0 ? kCamp : kProgram;
        for (std::size_t i = 0; i < random.below(12); ++i) {
            const std::size_t at = random.below(text.size());
            static const std::vector<std::string> kWith{"",        "<",    ">", "\"", "</", "<!--",
                                                        "-->",     "'",    "=", "\n", "𝄞",  "<structure ",
                                                        "define ", "done", "(", "["};
            text.replace(at, random.below(8), kWith[random.below(kWith.size())]);
        }
        // What is cut may have left half a character.
        client.send(Json{{"method", "textDocument/didOpen"},
                         {"params", {{"textDocument", {{"uri", uri}, {"text", text}, {"version", 1}}}}}}
                        .dump(-1, ' ', false, Json::error_handler_t::replace));
        client.look(Depth::check);
        for (int i = 0; i < 30; ++i) {
            const int line = static_cast<int>(random.below(30));
            Json params = at(line, static_cast<int>(random.below(60)), uri);
            params["range"] = {{"start", params["position"]},
                               {"end", {{"line", line + 1}, {"character", 0}}}};
            std::string body = Json{
                {"id", i},
                {"method", "textDocument/" + methods[random.below(methods.size())]},
                {"params", params}}.dump();
            if (random.below(3) == 0) body[random.below(body.size())] = static_cast<char>(random.below(256));
            EXPECT_LE(client.send(body).size(), 2U);
        }
        EXPECT_EQ(
            client.ask("textDocument/documentColor", {{"textDocument", {{"uri", uri}}}}).count("result"), 1U)
            << "seed " << seed;
    }
}

}  // namespace
}  // namespace popup::lsp
