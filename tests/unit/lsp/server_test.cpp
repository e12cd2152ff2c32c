// The server: messages in, messages out, without threads and clocks.
#include "lsp/server.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "output/xml.h"
#include "popup/edit.h"
#include "support/designs.h"
#include "support/lsp_client.h"
#include "support/run_program.h"

namespace popup::lsp {
namespace {

using namespace test_client;

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
    EXPECT_EQ(plain.greeting["capabilities"]["documentFormattingProvider"], true);
    EXPECT_FALSE(plain.greeting["capabilities"].contains("codeLensProvider")) << "there is no view to open";
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
// A keystroke costs what it changes, and finds what a run of everything finds.
TEST(Server, ExaminesWhatHasChangedAndSaysHowMuch) {
    std::string text = write_document(test::row(100));
    Client client(kAbilities);
    client.notify("$/setTrace", {{"value", "messages"}});
    client.open(text);
    client.look(Depth::check);
    client.look(Depth::whole);
    // The last digit of a point's x: a few tenths of a millimetre.
    const std::size_t at = text.find('"', text.find("<point x=\"", text.size() / 2) + 10) - 1;
    text[at] = text[at] == '5' ? '4' : '5';
    client.change({{{"text", text}}}, 2);
    client.look(Depth::check);
    const auto work = client.server().next_work(Depth::whole, Clock::now());
    ASSERT_TRUE(work);
    const Analysis again = run(*work);
    const Analysis fresh = analyse(work->source, work->options, Depth::whole);
    ASSERT_EQ(again.findings.size(), fresh.findings.size());
    for (std::size_t i = 0; i < fresh.findings.size(); ++i) {
        EXPECT_EQ(again.findings[i].diagnostic.message, fresh.findings[i].diagnostic.message);
        EXPECT_EQ(again.findings[i].at.begin, fresh.findings[i].at.begin);
    }
    ASSERT_TRUE(again.examined);
    EXPECT_LT(10 * again.examined->examined_pairs, again.examined->pairs);
    EXPECT_FALSE(fresh.examined);
    client.server().finish(*work, again, std::chrono::milliseconds(12));
    const std::vector<Json> told = client.handle();
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told[0]["method"], "$/logTrace");
    EXPECT_EQ(told[0]["params"]["message"],
              fmt::format("/cards/camp.xml: examined in 12 ms, {} of {} plates changed, {} of {} pairs of "
                          "plates that come near each other examined ({:.1f} %), {} of {} pairs of layers",
                          again.examined->changed_plates, again.examined->plates,
                          again.examined->examined_pairs, again.examined->pairs,
                          100.0 * static_cast<double>(again.examined->examined_pairs) /
                              static_cast<double>(again.examined->pairs),
                          again.examined->examined_layers, again.examined->layers));
    // What took so little is done at once the next time.
    client.change({{{"text", text + "\n"}}}, 3);
    client.look(Depth::check);
    EXPECT_TRUE(client.server().next_work(Depth::whole, Clock::time_point{}));
}

TEST(Server, Formats) {
    Client client(kAbilities);
    client.open(kCamp);
    const Json ask{{"textDocument", {{"uri", kUri}}}, {"options", {{"tabSize", 8}, {"insertSpaces", false}}}};
    const Json edits = client.ask("textDocument/formatting", ask)["result"];
    ASSERT_FALSE(edits.empty());
    Diagnostics trouble;
    const auto formatted = format_document({"camp.xml", kCamp}, trouble);
    ASSERT_TRUE(formatted);
    EXPECT_EQ(edited(kCamp, edits), *formatted);
    client.change({{{"text", *formatted}}}, 2);
    EXPECT_EQ(client.ask("textDocument/formatting", ask)["result"], Json::array());
    client.change({{{"text", "<popup><mainpage wid"}}}, 3);
    EXPECT_NE(client.ask("textDocument/formatting", ask)["error"]["message"].get<std::string>().find(
                  "it is left as it is"),
              std::string::npos);
    client.change({{{"text", "<html/>"}}}, 4);
    EXPECT_TRUE(client.ask("textDocument/formatting", ask)["result"].is_null());
}

TEST(Server, OpensTheView) {
    std::vector<std::string> opened;
    ServerOptions options;
    options.open_view = [&opened](const std::string& path) {
        opened.push_back(path);
        return std::string(path == "/cards/gone.xml" ? "there is no file yet" : "");
    };
    Client client(kAbilities, options);
    EXPECT_EQ(client.greeting["capabilities"]["executeCommandProvider"]["commands"],
              Json::array({"popupc.openView"}));
    client.open("<!-- mine -->\n" + kCamp);
    const Json lenses = client.ask("textDocument/codeLens", {{"textDocument", {{"uri", kUri}}}})["result"];
    ASSERT_EQ(lenses.size(), 1U);
    EXPECT_EQ(lenses[0]["range"]["start"], (Json{{"line", 1}, {"character", 0}}));
    EXPECT_EQ(lenses[0]["command"]["title"], "Open view");
    Json command{{"command", lenses[0]["command"]["command"]},
                 {"arguments", lenses[0]["command"]["arguments"]}};
    EXPECT_TRUE(client.ask("workspace/executeCommand", command)["result"].is_null());
    EXPECT_EQ(opened, std::vector<std::string>{"/cards/camp.xml"});
    // Clients that have no lenses run it by its name, of the document in hand.
    client.open(kCamp, "file:///cards/gone.xml");
    command.erase("arguments");
    EXPECT_EQ(client.ask("workspace/executeCommand", command)["error"]["message"], "there is no file yet");
    EXPECT_EQ(opened.back(), "/cards/gone.xml");
    client.open(kCamp, "untitled:camp");
    command["arguments"] = Json::array({"untitled:camp"});
    EXPECT_EQ(client.ask("workspace/executeCommand", command)["error"]["message"],
              "no such document is open");
    command["command"] = "rm";
    EXPECT_NE(client.ask("workspace/executeCommand", command)["error"], Json());
    EXPECT_EQ(opened.size(), 2U);
}

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

// What a hover has found out is kept until the text is another one, whichever run has ended since.
TEST(Server, ShowsMeasuresOfTheTextAsItIsNow) {
    Client client(kAbilities);
    client.open(kCamp);
    const auto measures = [&] {
        const Json result = client.ask("textDocument/hover", at(14, 8))["result"];
        const auto said = result["contents"]["value"].get<std::string>();
        return said.substr(0, said.find('\n'));
    };
    client.look(Depth::check);
    const std::string before = measures();
    EXPECT_NE(before.find(": at "), std::string::npos) << before;
    EXPECT_EQ(measures(), before);
    client.look(Depth::whole);
    EXPECT_EQ(measures(), before);
    Diagnostics said("camp.xml");
    const auto longer =
        edit_document({"camp.xml", kCamp}, read_edits("set flag --width 5", said), {}, said, said);
    ASSERT_TRUE(longer && !longer->refused) << test::findings(said);
    client.change({{{"text", longer->text}}}, 2);
    client.look(Depth::check);
    EXPECT_NE(measures(), before);
    EXPECT_NE(measures().find("width 5"), std::string::npos) << measures();
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
        Json{{"general", {{"positionEncodings", {"utf-8"}}}}, {"textDocument", kAbilities["textDocument"]}});
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

// However a program's files are named, and whether or not it has been looked at.
TEST(Server, RenamesInAllFilesOfAProgram) {
    const test::ScratchDirectory scratch;
    std::filesystem::create_directories(scratch / "inc");
    test::write_file(scratch / "inc/lib.fl", "; of the disk\ndefine mybox(size) forward(size) done\n");
    std::filesystem::create_directory_symlink(scratch / "inc", scratch / "linked");
    const std::string folder = "file://" + scratch.path().string();
    const std::string library = folder + "/inc/lib.fl";
    for (const char* name : {"lib.fl", "inc/lib.fl", "inc/../inc/./lib.fl", "linked/lib.fl"}) {
        SCOPED_TRACE(name);
        ServerOptions options;
        options.compile.read.program.folders = {
            std::filesystem::relative(scratch / "inc", std::filesystem::current_path()).string()};
        Client client(Json::object(), options);
        const std::string main = folder + "/main.fl";
        client.open("define mybox(size) forward(size) done\n", library);
        client.open(std::string("load(\"") + name + "\")\npopup(8, 6)\nmybox(1)\n", main);
        const Json to =
            client.ask("textDocument/rename", with(at(2, 1, main), "newName", "mine"))["result"]["changes"];
        ASSERT_TRUE(to.contains(library)) << to;
        EXPECT_EQ(to[library][0]["range"]["start"], (Json{{"line", 0}, {"character", 7}})) << "as it is open";
        EXPECT_EQ(to[main].size(), 1U);
        const Json from = client.ask("textDocument/rename",
                                     with(at(0, 8, library), "newName", "mine"))["result"]["changes"];
        EXPECT_EQ(from, to) << "from the file that is loaded";
        EXPECT_EQ(client.ask("textDocument/definition", at(2, 1, main))["result"]["uri"], library);
    }
}

TEST(Server, RenamesInDocumentsThatAreNoFiles) {
    Client client(Json::object());
    const std::string uri = "untitled:Untitled-1.fl";
    client.notify("textDocument/didOpen", {{"textDocument",
                                            {{"uri", uri},
                                             {"languageId", "flatlang"},
                                             {"version", 1},
                                             {"text", "mine = 3\nforward(mine)\n"}}}});
    const Json made =
        client.ask("textDocument/rename", with(at(0, 1, uri), "newName", "yours"))["result"]["changes"];
    EXPECT_EQ(made[uri].size(), 2U) << made;
}

// Open by its name and by a link, it is two texts, and each has its own edits.
TEST(Server, RenamesInTheDocumentThatWasAsked) {
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.fl", "");
    std::filesystem::create_symlink("a.fl", scratch / "b.fl");
    const std::string folder = "file://" + scratch.path().string();
    Client client(Json::object());
    client.open("; first\nmine = 3\n", folder + "/a.fl");
    client.open("mine = 4\n", folder + "/b.fl");
    const Json made = client.ask("textDocument/rename",
                                 with(at(0, 1, folder + "/b.fl"), "newName", "yours"))["result"]["changes"];
    ASSERT_TRUE(made.contains(folder + "/b.fl")) << made;
    EXPECT_EQ(made[folder + "/b.fl"][0]["range"]["start"], (Json{{"line", 0}, {"character", 0}}));
}

TEST(Server, RenamesNothingWhereAProgramCannotBeRead) {
    Client client(kAbilities);
    const std::string uri = "file:///cards/main.fl";
    client.open("load(\"lib.fl\")\nmybox(1\n", uri);
    EXPECT_NE(client.ask("textDocument/rename", with(at(1, 1, uri), "newName", "mine"))["error"]["message"]
                  .get<std::string>()
                  .find("hides which files"),
              std::string::npos);
    // Nor from a file that it loads.
    const std::string library = "file:///cards/lib.fl";
    client.open("define mybox() forward(1) done\n", library);
    EXPECT_NE(
        client.ask("textDocument/rename", with(at(0, 8, library), "newName", "mine"))["error"]["message"]
            .get<std::string>()
            .find("/cards/main.fl has an error"),
        std::string::npos);
    client.open("s = tent(card.gutter)\n", uri);
    for (const int column : {0, 4, 14}) {
        SCOPED_TRACE(column);
        EXPECT_EQ(client.ask("textDocument/prepareRename", at(0, column, uri))["result"].is_null(),
                  column > 0);
    }
    client.open("print(\"a;b\", foo", uri);
    EXPECT_TRUE(has(labels(client, 0, 16, uri), "forward")) << "that text is no comment";
    client.open("print(\"a\") ; foo", uri);
    EXPECT_TRUE(labels(client, 0, 16, uri).empty());
}

}  // namespace
}  // namespace popup::lsp
