// Values as the protocol's JSON, and the other way.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/features.h"
#include "lsp/text.h"

namespace popup::lsp {

using Json = nlohmann::json;

// Errors of JSON-RPC and of the protocol.
enum class ErrorCode {
    parse_error = -32700,
    invalid_request = -32600,
    method_not_found = -32601,
    invalid_params = -32602,
    internal_error = -32603,
    not_initialized = -32002,
    request_cancelled = -32800,
    request_failed = -32803,
};

// What the client can take, as it said when it was greeted.
struct ClientAbilities {
    Encoding encoding = Encoding::utf16;
    bool markdown = false;
    bool snippets = false;
    bool symbol_tree = false;
    bool action_literals = false;
    bool document_changes = false;
    bool watches_files = false;
};
// Of the params of `initialize`; whatever is not as it should be is taken as not there.
ClientAbilities abilities_of(const Json& params);
// The answer to `initialize`.
Json capabilities(const ClientAbilities& client, bool has_view);

// The command that opens the live view: of the document of a URI, its one argument; without one of the
// document that was opened or changed last.
inline constexpr std::string_view kOpenView = "popupc.openView";

// A member of an object; an out_of_range or type_error of the library where there is none.
const Json& member(const Json& object, std::string_view name);
// The same, or null where there is none.
const Json* member_if_any(const Json& object, std::string_view name);
// A position, range or offset of params. Numbers beyond what a text may have are as large as that.
Position position_of(const Json& position);
Span span_of(const Json& range, const Text& text, Encoding encoding);

Json to_json(Position position);
Json range_json(const Text& text, Span at, Encoding encoding);
// {"kind": …, "value": …}: as markdown where the client takes it, else as its plain text.
Json markup_json(const std::string& markdown, const ClientAbilities& client);
Json finding_json(const Finding& finding, const Text& text, const std::string& uri, Encoding encoding);
Json completion_json(const std::vector<Completion>& items, const Text& text, std::size_t at,
                     const ClientAbilities& client);
Json symbols_json(const std::vector<Symbol>& symbols, const Text& text, const std::string& uri,
                  const ClientAbilities& client);
Json edits_json(const std::vector<TextEdit>& edits, const Text& text, Encoding encoding);

// Why a body is not even looked at, as a sentence without its full stop: it is nested too deep, or has too
// many values to be anything but a trap. Empty: it may be parsed.
std::string refusal_of(std::string_view body);

}  // namespace popup::lsp
