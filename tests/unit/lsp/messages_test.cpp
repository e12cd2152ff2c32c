// What comes in that no client should send, and in what order.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/lsp_client.h"
#include "support/random.h"

namespace popup::lsp {
namespace {

using namespace test_client;

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
