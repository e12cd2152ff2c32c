// A client of the server, as tests are one, and what it opens.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "lsp/server.h"

namespace popup::lsp::test_client {

inline const std::string kUri = "file:///cards/camp.xml";

// A client in the test's own thread: what the server has to say is handed over at once.
class Client {
 public:
    explicit Client(Json abilities = Json::object(), ServerOptions options = {})
        : server_(std::move(options)) {
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

inline Json at(int line, int character, const std::string& uri = kUri) {
    return {{"textDocument", {{"uri", uri}}}, {"position", {{"line", line}, {"character", character}}}};
}

inline Json with(Json params, const std::string& name, Json value) {
    params[name] = std::move(value);
    return params;
}

inline const Json kAbilities{{"textDocument",
                              {{"hover", {{"contentFormat", Json::array({"markdown"})}}},
                               {"completion", {{"completionItem", {{"snippetSupport", true}}}}},
                               {"documentSymbol", {{"hierarchicalDocumentSymbolSupport", true}}},
                               {"codeAction", {{"codeActionLiteralSupport", Json::object()}}}}}};

inline const std::string kCamp = R"(<popup version="2.0" units="mm">
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

inline const std::string kProgram = R"(load("lib.fl")
; draws a star with so many points
define star(points, size)
  repeat (points) forward(size) right(360 / points) done
done
card = popup(8, 6)
size = 2
star(5, size)
sta
)";

}  // namespace popup::lsp::test_client
