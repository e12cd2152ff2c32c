#include "lsp/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "popup/compile.h"

namespace popup::lsp {
namespace {

constexpr std::size_t kDeepest = 100;
constexpr std::size_t kMostValues = 2'000'000;
// Elements deeper on one another than this are shown beside one another.
constexpr int kDeepestSymbol = 50;
constexpr int kFurthest = std::numeric_limits<int>::max() / 2;

// The member at the end of a way of names, or null.
const Json* find(const Json& object, std::initializer_list<std::string_view> way) {
    const Json* at = &object;
    for (const std::string_view name : way) {
        at = member_if_any(*at, name);
        if (at == nullptr) return nullptr;
    }
    return at;
}

bool is_true(const Json* value) { return value != nullptr && value->is_boolean() && value->get<bool>(); }

bool lists(const Json* value, std::string_view word) {
    return value != nullptr && value->is_array() &&
           std::any_of(value->begin(), value->end(),
                       [&](const Json& one) { return one.is_string() && one == word; });
}

int number_of(const Json& value) {
    if (value.is_number_unsigned())
        return static_cast<int>(std::min<std::uint64_t>(value.get<std::uint64_t>(), kFurthest));
    if (value.is_number_integer())
        return static_cast<int>(std::clamp<std::int64_t>(value.get<std::int64_t>(), 0, kFurthest));
    if (value.is_number_float() && value.get<double>() >= 0.0 && value.get<double>() < kFurthest)
        return static_cast<int>(value.get<double>());
    return static_cast<int>(value.get<Json::array_t>().size());  // tells what is wrong with it
}

int severity_number(Severity severity) {
    switch (severity) {
        case Severity::error:
            return 1;
        case Severity::warning:
            return 2;
        case Severity::remark:
            return 3;
    }
    return 1;
}

// A snippet as it is written by hand: placeholders with their words, or nothing.
std::string without_placeholders(std::string_view snippet) {
    std::string text;
    for (std::size_t i = 0; i < snippet.size(); ++i) {
        if (snippet[i] != '$') {
            text += snippet[i];
            continue;
        }
        if (i + 1 < snippet.size() && snippet[i + 1] == '{') {
            const std::size_t end = std::min(snippet.find('}', i), snippet.size() - 1);
            const std::string_view inside = snippet.substr(i + 2, end - i - 2);
            const std::size_t colon = inside.find(':');
            if (colon != std::string_view::npos) text += inside.substr(colon + 1);
            i = end;
        } else {
            while (i + 1 < snippet.size() && snippet[i + 1] >= '0' && snippet[i + 1] <= '9') ++i;
        }
    }
    return text;
}

}  // namespace

ClientAbilities abilities_of(const Json& params) {
    ClientAbilities client;
    const Json* all = find(params, {"capabilities"});
    if (all == nullptr) return client;
    const Json* encodings = find(*all, {"general", "positionEncodings"});
    if (encodings != nullptr && encodings->is_array()) {
        for (const Json& one : *encodings) {
            const auto known =
                one.is_string() ? find_encoding(one.get_ref<const std::string&>()) : std::nullopt;
            if (!known) continue;
            client.encoding = *known;
            break;
        }
    }
    client.markdown = lists(find(*all, {"textDocument", "hover", "contentFormat"}), "markdown");
    client.snippets = is_true(find(*all, {"textDocument", "completion", "completionItem", "snippetSupport"}));
    client.symbol_tree =
        is_true(find(*all, {"textDocument", "documentSymbol", "hierarchicalDocumentSymbolSupport"}));
    client.action_literals =
        find(*all, {"textDocument", "codeAction", "codeActionLiteralSupport"}) != nullptr;
    client.document_changes = is_true(find(*all, {"workspace", "workspaceEdit", "documentChanges"}));
    client.watches_files = is_true(find(*all, {"workspace", "didChangeWatchedFiles", "dynamicRegistration"}));
    return client;
}

Json capabilities(const ClientAbilities& client, bool has_view) {
    Json made{
        {"capabilities",
         {{"positionEncoding", to_string(client.encoding)},
          {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", {{"includeText", false}}}}},
          {"hoverProvider", true},
          {"completionProvider", {{"triggerCharacters", {"<", "\"", "'", " ", ".", "/"}}}},
          {"documentSymbolProvider", true},
          {"definitionProvider", true},
          {"referencesProvider", true},
          {"renameProvider", {{"prepareProvider", true}}},
          {"colorProvider", true},
          {"documentFormattingProvider", true},
          {"codeActionProvider", {{"codeActionKinds", Json::array({"quickfix", "source.fixAll"})}}}}},
        {"serverInfo", {{"name", "popupc"}, {"version", version()}}}};
    if (has_view) {
        made["capabilities"]["codeLensProvider"] = Json::object();
        made["capabilities"]["executeCommandProvider"] = {{"commands", Json::array({kOpenView})}};
    }
    return made;
}

const Json& member(const Json& object, std::string_view name) { return object.at(std::string(name)); }

const Json* member_if_any(const Json& object, std::string_view name) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(std::string(name));
    return found == object.end() ? nullptr : &*found;
}

Position position_of(const Json& position) {
    return {number_of(member(position, "line")), number_of(member(position, "character"))};
}

Span span_of(const Json& range, const Text& text, Encoding encoding) {
    const std::size_t a = text.offset(position_of(member(range, "start")), encoding);
    const std::size_t b = text.offset(position_of(member(range, "end")), encoding);
    return {std::min(a, b), std::max(a, b)};
}

Json to_json(Position position) { return {{"line", position.line}, {"character", position.character}}; }

Json range_json(const Text& text, Span at, Encoding encoding) {
    return {{"start", to_json(text.position(at.begin, encoding))},
            {"end", to_json(text.position(at.end, encoding))}};
}

Json markup_json(const std::string& markdown, const ClientAbilities& client) {
    if (client.markdown) return {{"kind", "markdown"}, {"value", markdown}};
    std::string plain;
    for (const char c : markdown) {
        if (c != '*' && c != '`') plain += c;
    }
    return {{"kind", "plaintext"}, {"value", plain}};
}

Json finding_json(const Finding& finding, const Text& text, const std::string& uri, Encoding encoding) {
    const Diagnostic& said = finding.diagnostic;
    std::string message = said.message;
    if (said.change) message += fmt::format("\nwas: {}\nnow: {}", said.change->before, said.change->after);
    for (const std::string& hint : said.hints) message += fmt::format("\nhint: {}", hint);
    Json made{{"range", range_json(text, finding.at, encoding)},
              {"severity", severity_number(said.severity)},
              {"code", said.code},
              {"source", "popupc"},
              {"message", message}};
    Json related = Json::array();
    for (const FindingPlace& one : finding.related) {
        related.push_back({{"location", {{"uri", uri}, {"range", range_json(text, one.at, encoding)}}},
                           {"message", one.text}});
    }
    if (!related.empty()) made["relatedInformation"] = std::move(related);
    return made;
}

Json completion_json(const std::vector<Completion>& items, const Text& text, std::size_t at,
                     const ClientAbilities& client) {
    Json list = Json::array();
    const std::string_view bytes = text.bytes();
    int number = 0;
    for (const Completion& one : items) {
        // The protocol wants one line, with the cursor in it.
        Span replaces = one.replaces;
        const std::size_t line_end = std::min(bytes.find_first_of("\r\n", replaces.begin), bytes.size());
        replaces.end = std::min(std::max(replaces.end, at), std::max(line_end, at));
        const std::size_t line_begin = at == 0 ? 0 : bytes.find_last_of("\r\n", at - 1) + 1;
        replaces.begin = std::max(replaces.begin, line_begin);
        const bool tag = replaces.begin < bytes.size() && replaces.begin < at && bytes[replaces.begin] == '<';
        Json made{
            {"label", one.label},
            {"kind", static_cast<int>(one.kind)},
            // In the order that they are given in.
            {"sortText", fmt::format("{:05}", number++)},
            {"filterText", tag ? "<" + one.label : one.label},
            {"textEdit",
             {{"range", range_json(text, replaces, client.encoding)},
              {"newText", one.snippet && !client.snippets ? without_placeholders(one.text) : one.text}}}};
        if (one.snippet && client.snippets) made["insertTextFormat"] = 2;
        if (!one.detail.empty()) made["detail"] = one.detail;
        if (!one.markdown.empty()) made["documentation"] = markup_json(one.markdown, client);
        list.push_back(std::move(made));
    }
    return {{"isIncomplete", false}, {"items", std::move(list)}};
}

Json symbols_json(const std::vector<Symbol>& symbols, const Text& text, const std::string& uri,
                  const ClientAbilities& client) {
    if (!client.symbol_tree) {
        Json list = Json::array();
        for (const Symbol& one : symbols) {
            Json made{{"name", one.name},
                      {"kind", static_cast<int>(one.kind)},
                      {"location", {{"uri", uri}, {"range", range_json(text, one.all, client.encoding)}}}};
            if (one.parent >= 0) made["containerName"] = symbols[static_cast<std::size_t>(one.parent)].name;
            list.push_back(std::move(made));
        }
        return list;
    }
    std::vector<int> depth(symbols.size(), 0);
    std::vector<int> parent(symbols.size(), -1);
    std::vector<Json> made;
    made.reserve(symbols.size());
    for (std::size_t i = 0; i < symbols.size(); ++i) {
        const Symbol& one = symbols[i];
        parent[i] = one.parent;
        if (one.parent >= 0) {
            const auto up = static_cast<std::size_t>(one.parent);
            if (depth[up] >= kDeepestSymbol) parent[i] = parent[up];
            if (parent[i] >= 0) depth[i] = depth[static_cast<std::size_t>(parent[i])] + 1;
        }
        Json& json =
            made.emplace_back(Json{{"name", one.name.empty() ? "?" : one.name},
                                   {"kind", static_cast<int>(one.kind)},
                                   {"range", range_json(text, one.all, client.encoding)},
                                   {"selectionRange", range_json(text, one.name_at, client.encoding)}});
        if (!one.detail.empty()) json["detail"] = one.detail;
    }
    // From the last on, so that each is whole before it goes into its parent; then in their order again.
    std::vector<std::vector<std::size_t>> children(symbols.size());
    Json roots = Json::array();
    for (std::size_t i = 0; i < symbols.size(); ++i) {
        if (parent[i] >= 0) children[static_cast<std::size_t>(parent[i])].push_back(i);
    }
    for (std::size_t i = symbols.size(); i-- > 0;) {
        if (children[i].empty()) continue;
        Json list = Json::array();
        for (const std::size_t child : children[i]) list.push_back(std::move(made[child]));
        made[i]["children"] = std::move(list);
    }
    for (std::size_t i = 0; i < symbols.size(); ++i) {
        if (parent[i] < 0) roots.push_back(std::move(made[i]));
    }
    return roots;
}

Json edits_json(const std::vector<TextEdit>& edits, const Text& text, Encoding encoding) {
    Json list = Json::array();
    for (const TextEdit& edit : edits)
        list.push_back({{"range", range_json(text, edit.at, encoding)}, {"newText", edit.text}});
    return list;
}

std::string refusal_of(std::string_view body) {
    std::size_t depth = 0;
    std::size_t values = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < body.size(); ++i) {
        const char c = body[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
            continue;
        }
        switch (c) {
            case '"':
                in_text = true;
                break;
            case '[':
            case '{':
                if (++depth > kDeepest) return fmt::format("a message is nested more than {} deep", kDeepest);
                ++values;
                break;
            case ']':
            case '}':
                if (depth > 0) --depth;
                break;
            case ',':
                ++values;
                break;
            default:
                break;
        }
        if (values > kMostValues) return fmt::format("a message has more than {} values", kMostValues);
    }
    return {};
}

}  // namespace popup::lsp
