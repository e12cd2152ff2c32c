// What the server answers about documents.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "lsp/server.h"
#include "lsp/uri.h"
#include "popup/edit.h"

namespace popup::lsp {
namespace {

bool meets(Span a, Span b) { return a.begin <= b.end && b.begin <= a.end; }

}  // namespace

Server::Document* Server::find(const Json& params) {
    const auto found = documents_.find(member(member(params, "textDocument"), "uri").get<std::string>());
    return found == documents_.end() || found->second.service == nullptr ? nullptr : &found->second;
}

std::size_t Server::offset_of(const Document& document, const Json& params) const {
    return document.text.offset(position_of(member(params, "position")), client_.encoding);
}

View Server::view_of(const Document& document) const {
    View view{document.text, document.path};
    if (document.latest && document.latest_revision == document.revision)
        view.analysis = document.latest.get();
    view.good = document.good.get();
    view.read = [this](const std::string& path) -> std::optional<std::string> {
        if (auto text = text_of(path)) return text;
        Diagnostics unread;
        auto source = read_source(path, unread);
        return source ? std::optional(std::move(source->text)) : std::nullopt;
    };
    std::set<std::string> known{document.real};
    const auto add = [&known](const Analysis::File& file, std::vector<std::string>& to) {
        if (known.insert(file.real).second) to.push_back(file.path);
    };
    if (document.latest) {
        for (const Analysis::File& file : document.latest->files) add(file, view.loaded);
    }
    const std::string name = std::filesystem::path(document.path).filename().string();
    for (const auto& [uri, other] : documents_) {
        if (other.latest && other.latest->may_load_more) {
            const std::string_view hidden = &other == &document ? "load" : std::string_view(name);
            if (other.text.bytes().find(hidden) != std::string::npos) view.doubtful = other.path;
        }
        if (!reads(other, {document.path, document.real})) continue;
        add({other.path, other.real}, view.readers);
        for (const Analysis::File& file : other.latest->files) add(file, view.readers);
    }
    return view;
}

Json Server::hover(const Json& params) {
    Document* document = find(params);
    if (document == nullptr) return nullptr;
    const std::size_t at = offset_of(*document, params);
    const View view = view_of(*document);
    std::string said;
    std::optional<Span> span;
    if (view.analysis != nullptr) {
        for (const Finding& one : view.analysis->findings) {
            if (!one.at.touches(at)) continue;
            said += (said.empty() ? "" : "\n\n---\n\n") + finding_markdown(one.diagnostic);
            if (!span) span = one.at;
        }
    }
    if (const auto hover = document->service->hover(view, at)) {
        said += (said.empty() ? "" : "\n\n---\n\n") + hover->markdown;
        span = hover->at;
    }
    if (said.empty()) return nullptr;
    return {{"contents", markup_json(said, client_)},
            {"range", range_json(document->text, *span, client_.encoding)}};
}

Json Server::complete(const Json& params) {
    Document* document = find(params);
    if (document == nullptr) return nullptr;
    const std::size_t at = offset_of(*document, params);
    return completion_json(document->service->complete(view_of(*document), at), document->text, at, client_);
}

Json Server::symbols(const Json& params) {
    Document* document = find(params);
    if (document == nullptr) return nullptr;
    return symbols_json(document->service->symbols(view_of(*document)), document->text, document->uri,
                        client_);
}

std::optional<Text> Server::target_text(const std::string& path) const {
    if (auto open = text_of(path)) return Text(std::move(*open));
    Diagnostics unread;
    auto source = read_source(path, unread);
    return source ? std::optional(Text(std::move(source->text))) : std::nullopt;
}

std::string Server::target_uri(const std::string& path) const {
    const Document* document = opened_as(path);
    return document != nullptr ? document->uri : uri_of(path);
}

// Null where its file cannot be read.
Json Server::location(const Target& target) {
    const auto text = target_text(target.path);
    if (!text || target.at.end > text->size()) return nullptr;
    return {{"uri", target_uri(target.path)}, {"range", range_json(*text, target.at, client_.encoding)}};
}

Json Server::definition(const Json& params) {
    Document* document = find(params);
    if (document == nullptr) return nullptr;
    const auto target = document->service->definition(view_of(*document), offset_of(*document, params));
    return target ? location(*target) : Json();
}

Json Server::references(const Json& params) {
    Document* document = find(params);
    if (document == nullptr) return nullptr;
    std::vector<Target> all = document->service->references(view_of(*document), offset_of(*document, params));
    const Json* context = member_if_any(params, "context");
    const Json* declared = context == nullptr ? nullptr : member_if_any(*context, "includeDeclaration");
    if (declared != nullptr && declared->is_boolean() && !declared->get<bool>() && !all.empty())
        all.erase(all.begin());
    Json list = Json::array();
    // The texts of a program's files are few; each is read once.
    std::map<std::string, std::optional<Text>> texts;
    for (const Target& one : all) {
        auto text = texts.find(one.path);
        if (text == texts.end()) text = texts.emplace(one.path, target_text(one.path)).first;
        if (!text->second || one.at.end > text->second->size()) continue;
        list.push_back(
            {{"uri", target_uri(one.path)}, {"range", range_json(*text->second, one.at, client_.encoding)}});
    }
    return list;
}

Json Server::prepare_rename(const Json& params) {
    Document* document = find(params);
    if (document == nullptr) return nullptr;
    const auto name = document->service->renameable(view_of(*document), offset_of(*document, params));
    if (!name) return nullptr;
    return {{"range", range_json(document->text, *name, client_.encoding)},
            {"placeholder", document->text.bytes().substr(name->begin, name->size())}};
}

Json Server::rename(const Json& params) {
    Document* document = find(params);
    if (document == nullptr) return nullptr;
    const std::string name = member(params, "newName").get<std::string>();
    // What a program loads is known once it has been run, and so is who loads it.
    const bool program = document->language->name != "xml";
    for (auto& [uri, other] : documents_) {
        if (&other == document || (program && other.service == document->service)) current(other);
    }
    const Renaming made = document->service->rename(view_of(*document), offset_of(*document, params), name);
    if (!made.refusal.empty()) throw Refusal{made.refusal};
    return workspace_edit(made.files);
}

Json Server::workspace_edit(const std::vector<FileEdits>& files) const {
    Json changes = Json::object();
    Json versioned = Json::array();
    for (const FileEdits& file : files) {
        const auto text = target_text(file.path);
        if (!text) throw Refusal{fmt::format("{} cannot be read", file.path)};
        const std::string uri = target_uri(file.path);
        Json edits = edits_json(file.edits, *text, client_.encoding);
        const auto open = documents_.find(uri);
        Json version;
        if (open != documents_.end() && open->second.version) version = *open->second.version;
        versioned.push_back({{"textDocument", {{"uri", uri}, {"version", version}}}, {"edits", edits}});
        changes[uri] = std::move(edits);
    }
    if (client_.document_changes) return {{"documentChanges", std::move(versioned)}};
    return {{"changes", std::move(changes)}};
}

std::shared_ptr<const Analysis> Server::current(Document& document) {
    if (document.latest && document.latest_revision == document.revision) return document.latest;
    if (!document.service->is_ours(document.text.bytes())) return std::make_shared<const Analysis>();
    const Work work{document.uri,
                    document.revision,
                    {document.path, document.text.bytes()},
                    options_of(document),
                    Depth::check,
                    nullptr,
                    nullptr};
    finish(work, run(work));
    document.check_due = false;
    return document.latest;
}

Json Server::action(const Document& document, const Fix& fix, std::string_view kind, const Finding* finding,
                    bool preferred) const {
    Json made{{"title", fix.title}, {"kind", kind}, {"edit", workspace_edit({{document.path, fix.edits}})}};
    if (finding != nullptr)
        made["diagnostics"] =
            Json::array({finding_json(*finding, document.text, document.uri, client_.encoding)});
    if (preferred) made["isPreferred"] = true;
    return made;
}

Json Server::code_actions(const Json& params) {
    Document* document = find(params);
    // A client without literals wants commands, and there are none.
    if (document == nullptr || !client_.action_literals) return nullptr;
    const Span range = span_of(member(params, "range"), document->text, client_.encoding);
    const Json* context = member_if_any(params, "context");
    const Json* only = context == nullptr ? nullptr : member_if_any(*context, "only");
    const auto wanted = [only](std::string_view kind) {
        if (only == nullptr || !only->is_array()) return true;
        return std::any_of(only->begin(), only->end(), [kind](const Json& one) {
            return one.is_string() && kind.starts_with(one.get_ref<const std::string&>());
        });
    };
    const std::shared_ptr<const Analysis> analysis = current(*document);
    const View view = view_of(*document);
    Json list = Json::array();
    bool repairs = false;
    for (const Finding& one : analysis->findings) {
        repairs = repairs || one.diagnostic.change;
        if (!wanted("quickfix") || !meets(one.at, range)) continue;
        bool first = true;
        for (const Fix& fix : one.fixes) {
            list.push_back(action(*document, fix, "quickfix", &one, std::exchange(first, false)));
        }
        if (const auto fix = document->service->allow(view, one))
            list.push_back(action(*document, *fix, "quickfix", &one, false));
    }
    // Beside the fix of one finding, and where a client asks for nothing else, as it does before it saves.
    const bool alone = !wanted("quickfix");
    if (repairs && (alone ? wanted("source.fixAll") : !list.empty())) {
        if (const auto all = all_repairs({document->path, document->text.bytes()}, options_of(*document)))
            list.push_back(action(*document, *all, alone ? "source.fixAll" : "quickfix", nullptr, false));
    }
    return list;
}

Json Server::colors(const Json& params) {
    Document* document = find(params);
    Json list = Json::array();
    if (document == nullptr) return list;
    for (const ColorAt& one : document->service->colors(view_of(*document))) {
        constexpr double kMost = 255.0;
        list.push_back({{"range", range_json(document->text, one.at, client_.encoding)},
                        {"color",
                         {{"red", one.color.r / kMost},
                          {"green", one.color.g / kMost},
                          {"blue", one.color.b / kMost},
                          {"alpha", 1.0}}}});
    }
    return list;
}

// As popupc fmt does.
Json Server::format(const Json& params) {
    const Document* document = find(params);
    if (document == nullptr || document->language->name != "xml" ||
        !document->service->is_ours(document->text.bytes()))
        return nullptr;
    Diagnostics trouble(document->path);
    const auto text = format_document({document->path, document->text.bytes()}, trouble);
    if (!text) {
        const std::vector<Diagnostic> said = trouble.sorted();
        throw Refusal{said.empty() ? std::string("it is no document that can be formatted")
                                   : fmt::format("it is left as it is: {}", said.front().message)};
    }
    return edits_json(differences(document->text.bytes(), *text), document->text, client_.encoding);
}

// One lens, at the root of a document or the first line of a program.
Json Server::lenses(const Json& params) {
    const Document* document = find(params);
    if (document == nullptr || !options_.open_view || !document->service->is_ours(document->text.bytes()))
        return Json::array();
    const std::string& bytes = document->text.bytes();
    const std::size_t root = document->language->name == "xml" ? bytes.find("<popup") : 0;
    const Span at = underlined(document->text, root == std::string::npos ? 0 : root);
    return Json::array(
        {{{"range", range_json(document->text, at, client_.encoding)},
          {"command",
           {{"title", "Open view"}, {"command", kOpenView}, {"arguments", Json::array({document->uri})}}}}});
}

Json Server::execute(const Json& params) {
    if (member(params, "command") != kOpenView || !options_.open_view)
        throw Refusal{fmt::format("there is no command {}", member(params, "command").dump().substr(0, 100))};
    const Json* arguments = member_if_any(params, "arguments");
    const Document* document = nullptr;
    if (arguments != nullptr && arguments->is_array() && !arguments->empty()) {
        const auto found = documents_.find(arguments->front().get<std::string>());
        if (found != documents_.end()) document = &found->second;
    } else {
        for (const auto& [uri, one] : documents_) {
            if (one.service != nullptr && (document == nullptr || document->revision < one.revision))
                document = &one;
        }
    }
    if (document == nullptr || document->service == nullptr) throw Refusal{"no such document is open"};
    if (!path_of(document->uri)) throw Refusal{"the view shows files: save the document first"};
    if (const std::string why = options_.open_view(document->path); !why.empty()) throw Refusal{why};
    return nullptr;
}

Json Server::color_presentations(const Json& params) {
    const Json& color = member(params, "color");
    const auto part = [&color](std::string_view name) {
        const double value = member(color, name).get<double>();
        return static_cast<std::uint8_t>(
            std::lround(std::clamp(std::isfinite(value) ? value : 0.0, 0.0, 1.0) * 255.0));
    };
    return Json::array({{{"label", to_string(Color{part("red"), part("green"), part("blue")})}}});
}

}  // namespace popup::lsp
