#include "lsp/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "lsp/uri.h"

namespace popup::lsp {
namespace {

// Who has found out so quickly what is the matter need not wait until nobody types.
constexpr std::chrono::milliseconds kAtOnce{100};

bool is_request_id(const Json& id) { return id.is_string() || id.is_number() || id.is_null(); }

}  // namespace

Analysis run(const Work& work) {
    AnalysisOptions options = work.options;
    if (work.depth == Depth::whole) options.compile.motion.memory = work.memory.get();
    return analyse(work.source, options, work.depth, work.stages);
}

void Server::receive(const std::string& body, Clock::time_point now) {
    if (const std::string why = refusal_of(body); !why.empty())
        return refuse(nullptr, ErrorCode::parse_error, why);
    Json message = Json::parse(body, nullptr, false);
    if (message.is_discarded()) return refuse(nullptr, ErrorCode::parse_error, "the message is no JSON");
    // What is cancelled waits before it.
    const Json* method = member_if_any(message, "method");
    if (method != nullptr && *method == "$/cancelRequest") {
        const Json* params = member_if_any(message, "params");
        if (params != nullptr) cancel(*params);
        return;
    }
    waiting_.push_back({std::move(message), now, false});
}

void Server::receive_fault(const std::string& fault) { refuse(nullptr, ErrorCode::parse_error, fault); }

void Server::cancel(const Json& params) {
    const Json* id = member_if_any(params, "id");
    if (id == nullptr) return;
    for (Waiting& one : waiting_) {
        const Json* other = member_if_any(one.message, "id");
        if (other != nullptr && *other == *id && member_if_any(one.message, "method") != nullptr)
            one.cancelled = true;
    }
}

bool Server::step() {
    if (waiting_.empty() || ended_) return false;
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    now_ = next.at;
    if (next.cancelled) {
        refuse(next.message.at("id"), ErrorCode::request_cancelled, "the request was cancelled");
    } else {
        handle(next.message);
    }
    return true;
}

std::vector<std::string> Server::take_sent() { return std::exchange(sent_, {}); }

void Server::answer(const Json& id, Json result) {
    const Json message{{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
    sent_.push_back(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void Server::refuse(const Json& id, ErrorCode code, std::string_view why) {
    const Json message{{"jsonrpc", "2.0"},
                       {"id", id},
                       {"error", {{"code", static_cast<int>(code)}, {"message", std::string(why)}}}};
    sent_.push_back(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void Server::notify(std::string_view method, Json params) {
    const Json message{{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}};
    sent_.push_back(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void Server::handle(const Json& message) {
    const Json* id = member_if_any(message, "id");
    const Json* method = member_if_any(message, "method");
    if (!message.is_object()) return refuse(nullptr, ErrorCode::invalid_request, "a message is an object");
    if (id != nullptr && !is_request_id(*id))
        return refuse(nullptr, ErrorCode::invalid_request, "an id is a number or a text");
    if (method == nullptr) {
        // An answer of the client's: nothing was asked that its answer matters for.
        if (member_if_any(message, "result") != nullptr || member_if_any(message, "error") != nullptr) return;
        return refuse(id != nullptr ? *id : Json(), ErrorCode::invalid_request, "the message has no method");
    }
    if (!method->is_string())
        return refuse(id != nullptr ? *id : Json(), ErrorCode::invalid_request, "a method is a text");
    const Json* params = member_if_any(message, "params");
    const Json none = Json::object();
    const std::string& name = method->get_ref<const std::string&>();
    if (id == nullptr) return handle_notification(name, params != nullptr ? *params : none);
    handle_request(name, *id, params != nullptr ? *params : none);
}

void Server::handle_request(const std::string& method, const Json& id, const Json& params) {
    struct Row {
        std::string_view method;
        Request request;
    };
    static constexpr std::array kRows = std::to_array<Row>({
        {"initialize", &Server::initialize},
        {"shutdown", &Server::shutdown},
        {"textDocument/hover", &Server::hover},
        {"textDocument/completion", &Server::complete},
        {"textDocument/documentSymbol", &Server::symbols},
        {"textDocument/definition", &Server::definition},
        {"textDocument/references", &Server::references},
        {"textDocument/prepareRename", &Server::prepare_rename},
        {"textDocument/rename", &Server::rename},
        {"textDocument/codeAction", &Server::code_actions},
        {"textDocument/documentColor", &Server::colors},
        {"textDocument/colorPresentation", &Server::color_presentations},
        {"textDocument/formatting", &Server::format},
        {"textDocument/codeLens", &Server::lenses},
        {"workspace/executeCommand", &Server::execute},
    });
    const bool greeting = method == "initialize";
    if (!initialized_ && !greeting)
        return refuse(id, ErrorCode::not_initialized, "the first request is initialize");
    if (initialized_ && greeting) return refuse(id, ErrorCode::invalid_request, "initialize comes once");
    if (shut_down_) return refuse(id, ErrorCode::invalid_request, "the server is shut down");
    const auto row =
        std::find_if(kRows.begin(), kRows.end(), [&](const Row& one) { return one.method == method; });
    if (row == kRows.end())
        return refuse(id, ErrorCode::method_not_found,
                      fmt::format("there is no method {}", method.substr(0, 100)));
    try {
        answer(id, (this->*row->request)(params));
    } catch (const Refusal& refusal) {
        refuse(id, ErrorCode::request_failed, refusal.why);
    } catch (const Json::exception& wrong) {
        refuse(id, ErrorCode::invalid_params, wrong.what());
    } catch (const std::bad_alloc&) {
        refuse(id, ErrorCode::internal_error, "there is not enough memory");
    }
}

void Server::handle_notification(const std::string& method, const Json& params) {
    struct Row {
        std::string_view method;
        Notification notification;
    };
    static constexpr std::array kRows = std::to_array<Row>({
        {"initialized", &Server::initialized},
        {"textDocument/didOpen", &Server::opened},
        {"textDocument/didChange", &Server::changed},
        {"textDocument/didSave", &Server::saved},
        {"textDocument/didClose", &Server::closed},
        {"workspace/didChangeWatchedFiles", &Server::files_changed},
        {"$/setTrace", &Server::set_trace},
    });
    if (method == "exit") {
        ended_ = true;
        return;
    }
    const auto row =
        std::find_if(kRows.begin(), kRows.end(), [&](const Row& one) { return one.method == method; });
    if (row == kRows.end() || !initialized_ || shut_down_) return;
    try {
        (this->*row->notification)(params);
    } catch (const Json::exception& wrong) {
        // Nobody waits for an answer; the log is where it can be seen.
        notify("window/logMessage", {{"type", 2}, {"message", fmt::format("{}: {}", method, wrong.what())}});
    }
}

Json Server::initialize(const Json& params) {
    client_ = abilities_of(params);
    const Json* trace = member_if_any(params, "trace");
    traces_ = trace != nullptr && trace->is_string() && *trace != "off";
    initialized_ = true;
    return capabilities(client_, static_cast<bool>(options_.open_view));
}

Json Server::shutdown(const Json& /*params*/) {
    shut_down_ = true;
    return nullptr;
}

// Files that documents name and no editor has open, such as pictures.
void Server::initialized(const Json& /*params*/) {
    if (!client_.watches_files) return;
    const Json watched = Json::array({{{"globPattern", "**/*.{png,jpg,jpeg,svg,fl}"}}});
    const Json registration{{"id", "files"},
                            {"method", "workspace/didChangeWatchedFiles"},
                            {"registerOptions", {{"watchers", watched}}}};
    const Json message{{"jsonrpc", "2.0"},
                       {"id", "popupc-files"},
                       {"method", "client/registerCapability"},
                       {"params", {{"registrations", Json::array({registration})}}}};
    sent_.push_back(message.dump());
}

void Server::opened(const Json& params) {
    const Json& given = member(params, "textDocument");
    Document made;
    made.uri = member(given, "uri").get<std::string>();
    made.text = Text(member(given, "text").get<std::string>());
    if (const Json* version = member_if_any(given, "version");
        version != nullptr && version->is_number_integer())
        made.version = version->get<std::int64_t>();
    const auto path = path_of(made.uri);
    made.path = path ? *path : made.uri.substr(made.uri.rfind(':') + 1);
    if (path) made.real = real_path(*path);
    // A file is what its name says; of one that has none yet the editor knows, or the text tells.
    made.language = path ? find_language({made.path, {}}, {}) : nullptr;
    if (made.language == nullptr) {
        const Json* named = member_if_any(given, "languageId");
        const std::string name =
            named != nullptr && named->is_string() ? named->get<std::string>() : std::string();
        for (const Language& row : language_table()) {
            if (row.name == name) made.language = &row;
        }
        if (made.language == nullptr && name == "popup") made.language = find_language({}, "xml");
    }
    if (made.language != nullptr) made.service = find_service(made.language->name);
    Document& document = documents_[made.uri] = std::move(made);
    touch(document);
    touch_readers({document.path, document.real});
}

void Server::changed(const Json& params) {
    const auto found = documents_.find(member(member(params, "textDocument"), "uri").get<std::string>());
    if (found == documents_.end()) return;
    Document& document = found->second;
    // All changes, or none: a half of them would be a text that nobody has.
    Text text = document.text;
    for (const Json& change : member(params, "contentChanges")) {
        const std::string& with = member(change, "text").get_ref<const std::string&>();
        if (const Json* range = member_if_any(change, "range"); range != nullptr && !range->is_null()) {
            text.replace(span_of(*range, text, client_.encoding), with);
        } else {
            text = Text(with);
        }
    }
    document.text = std::move(text);
    const Json* version = member_if_any(member(params, "textDocument"), "version");
    if (version != nullptr && version->is_number_integer()) document.version = version->get<std::int64_t>();
    touch(document);
    touch_readers({document.path, document.real});
}

void Server::saved(const Json& params) {
    const auto found = documents_.find(member(member(params, "textDocument"), "uri").get<std::string>());
    if (found == documents_.end()) return;
    touch(found->second);
    touch_readers({found->second.path, found->second.real});
}

void Server::closed(const Json& params) {
    const std::string uri = member(member(params, "textDocument"), "uri").get<std::string>();
    const auto found = documents_.find(uri);
    if (found == documents_.end()) return;
    const Analysis::File file{found->second.path, found->second.real};
    documents_.erase(found);
    notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", Json::array()}});
    touch_readers(file);
}

void Server::files_changed(const Json& params) {
    for (const Json& one : member(params, "changes")) {
        if (const auto path = path_of(member(one, "uri").get_ref<const std::string&>()))
            touch_readers({*path, real_path(*path)});
    }
}

void Server::set_trace(const Json& params) { traces_ = member(params, "value") != "off"; }

void Server::touch(Document& document) {
    document.revision = ++revisions_;
    document.changed = now_;
    document.check_due = document.service != nullptr;
    document.whole_due = false;
}

bool Server::reads(const Document& document, const Analysis::File& file) {
    if (!document.latest || document.real == file.real) return false;
    const std::vector<Analysis::File>& files = document.latest->files;
    // By its name too: a link may lead elsewhere since.
    return std::any_of(files.begin(), files.end(), [&file](const Analysis::File& one) {
        return one.real == file.real || one.path == file.path;
    });
}

void Server::touch_readers(const Analysis::File& file) {
    for (auto& [uri, document] : documents_) {
        if (reads(document, file)) touch(document);
    }
}

const Server::Document* Server::opened_as(const std::string& path) const {
    for (const auto& [uri, document] : documents_) {
        if (document.path == path) return &document;
    }
    const std::string real = real_path(path);
    for (const auto& [uri, document] : documents_) {
        if (document.real == real) return &document;
    }
    return nullptr;
}

std::optional<std::string> Server::text_of(const std::string& path) const {
    const Document* document = opened_as(path);
    return document != nullptr ? std::optional(document->text.bytes()) : std::nullopt;
}

AnalysisOptions Server::options_of(const Document& document) const {
    AnalysisOptions made{options_.compile, options_.policy, document.language};
    // The run looks at the texts as they are now, wherever it happens.
    auto texts = std::make_shared<std::map<std::string, std::string>>();
    for (const auto& [uri, other] : documents_) {
        if (&other != &document && path_of(uri)) texts->emplace(other.real, other.text.bytes());
    }
    if (!texts->empty()) {
        made.compile.read.program.overlay = [texts](const std::string& path) -> std::optional<std::string> {
            const auto found = texts->find(real_path(path));
            return found == texts->end() ? std::nullopt : std::optional(found->second);
        };
    }
    return made;
}

std::optional<Work> Server::next_work(Depth depth, Clock::time_point now) {
    if (shut_down_) return std::nullopt;
    Document* best = nullptr;
    for (auto& [uri, document] : documents_) {
        const bool due =
            depth == Depth::check ? document.check_due : document.whole_due && whole_due_at(document) <= now;
        if (due && (best == nullptr || best->revision < document.revision)) best = &document;
    }
    if (best == nullptr) return std::nullopt;
    (depth == Depth::check ? best->check_due : best->whole_due) = false;
    if (!best->service->is_ours(best->text.bytes())) {
        notify("textDocument/publishDiagnostics", {{"uri", best->uri}, {"diagnostics", Json::array()}});
        best->latest.reset();
        best->good.reset();
        return next_work(depth, now);
    }
    const bool whole = depth == Depth::whole;
    const bool is_checked = best->checked && best->latest_revision == best->revision;
    return Work{best->uri,
                best->revision,
                {best->path, best->text.bytes()},
                options_of(*best),
                depth,
                whole && is_checked ? best->checked->stages : nullptr,
                whole ? best->memory : nullptr};
}

Clock::time_point Server::whole_due_at(const Document& document) const {
    const bool at_once = document.whole_took && *document.whole_took <= kAtOnce;
    return at_once ? document.changed : document.changed + options_.pause;
}

std::optional<Clock::time_point> Server::next_due() const {
    std::optional<Clock::time_point> due;
    for (const auto& [uri, document] : documents_) {
        if (document.check_due) return Clock::time_point{};
        if (document.whole_due && (!due || whole_due_at(document) < *due)) due = whole_due_at(document);
    }
    return due;
}

void Server::finish(const Work& work, Analysis analysis, Clock::duration took) {
    const auto found = documents_.find(work.uri);
    if (found == documents_.end() || found->second.revision != work.revision) return;
    Document& document = found->second;
    // A check that ends behind the whole has nothing to add.
    const bool have_whole = document.latest && document.latest_revision == work.revision &&
                            document.latest->depth == Depth::whole;
    if (work.depth == Depth::check && have_whole) return;
    if (work.depth == Depth::check) {
        document.checked = std::make_shared<const Analysis>(analysis);
        if (document.whole) carry_over(*document.whole, analysis);
        document.whole_due = analysis.design || document.language->name != "xml";
    } else if (document.checked) {
        mark_late(analysis, *document.checked);
    }
    if (work.depth == Depth::whole) document.whole_took = took;
    trace(document, analysis, took);
    auto shared = std::make_shared<const Analysis>(std::move(analysis));
    document.latest = shared;
    document.latest_revision = work.revision;
    if (work.depth == Depth::whole) document.whole = shared;
    if (shared->design) document.good = shared;
    publish(document, *shared);
}

// How much of it was looked at, for who asks for a trace.
void Server::trace(const Document& document, const Analysis& analysis, Clock::duration took) {
    if (!traces_) return;
    const double ms = std::chrono::duration<double, std::milli>(took).count();
    std::string text = fmt::format("{}: {} in {:.0f} ms", document.path,
                                   analysis.depth == Depth::check ? "checked" : "examined", ms);
    if (analysis.examined) {
        const ExaminationMemory::Share& share = *analysis.examined;
        text += fmt::format(
            ", {} of {} plates changed, {} of {} pairs of plates that come near each other examined ({:.1f} "
            "%), {} of {} pairs of layers",
            share.changed_plates, share.plates, share.examined_pairs, share.pairs,
            100.0 * static_cast<double>(share.examined_pairs) /
                static_cast<double>(std::max<std::size_t>(share.pairs, 1)),
            share.examined_layers, share.layers);
    }
    notify("$/logTrace", {{"message", std::move(text)}});
}

void Server::publish(const Document& document, const Analysis& analysis) {
    Json list = Json::array();
    for (const Finding& one : analysis.findings)
        list.push_back(finding_json(one, *analysis.text, document.uri, client_.encoding));
    Json params{{"uri", document.uri}, {"diagnostics", std::move(list)}};
    if (document.version) params["version"] = *document.version;
    notify("textDocument/publishDiagnostics", std::move(params));
}

}  // namespace popup::lsp
