// The language server: messages in, messages out. It reads no clock, starts no thread and touches no stream;
// who drives it (session.h) brings all of these.
//
//     Server server({options, policy});
//     server.receive(R"({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {}})");
//     while (server.step()) {
//     }
//     for (const std::string& body : server.take_sent()) send(body);
//     const std::optional<Work> work = server.next_work(Depth::check, now);
//     if (work) server.finish(*work, run(*work));
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lsp/analysis.h"
#include "lsp/features.h"
#include "lsp/protocol.h"
#include "lsp/server_options.h"

namespace popup::lsp {

using Clock = std::chrono::steady_clock;

// One state of one document that is to be looked at. It refers to nothing of the server's, so that another
// thread may do it.
struct Work {
    std::string uri;
    std::uint64_t revision = 0;
    Source source;
    AnalysisOptions options;
    Depth depth = Depth::check;
    Stages stages;                              // of the check, where the motion is to be looked at
    std::shared_ptr<ExaminationMemory> memory;  // of the document's motion, for one thread at a time
};
Analysis run(const Work& work);

// A request that cannot be done, for a reason that its user should read.
struct Refusal {
    std::string why;
};

class Server {
 public:
    explicit Server(ServerOptions options) : options_(std::move(options)) {}

    // Takes a message in; it waits for its turn. Any bytes may come: what is no message is answered as
    // JSON-RPC says.
    void receive(const std::string& body, Clock::time_point now = {});
    // A message that could not even be told from others.
    void receive_fault(const std::string& fault);
    // Handles the message whose turn it is; false: there is none. A request that was cancelled while it
    // waited is answered so.
    bool step();
    // The bodies that are to be sent, in order.
    std::vector<std::string> take_sent();

    // What is to be looked at next; nullopt: nothing that is due. Of several documents the one that was
    // changed last. The motion is examined where there are no errors, and when nothing has been typed for a
    // while; at once where the last examination took so little time that nobody would notice it.
    // Works of one depth are done one after the other.
    std::optional<Work> next_work(Depth depth, Clock::time_point now);
    // When something will be due that is not yet; nullopt: nothing will.
    [[nodiscard]] std::optional<Clock::time_point> next_due() const;
    // Publishes what was found, unless the document has changed since or is closed: then the next run tells.
    // `took`: how long the run did.
    void finish(const Work& work, Analysis analysis, Clock::duration took = {});

    // After `exit`: nothing more is to be done.
    [[nodiscard]] bool ended() const { return ended_; }
    // 0 where `shutdown` came before `exit`.
    [[nodiscard]] int exit_code() const { return shut_down_ ? 0 : 1; }

 private:
    struct Document {
        std::string uri;
        std::string path;
        std::string real;  // its real_path(); empty: it is no file
        const Language* language = nullptr;
        const Service* service = nullptr;  // null: nothing is said of it
        std::optional<std::int64_t> version;
        std::uint64_t revision = 0;
        Text text;
        Clock::time_point changed;
        bool check_due = false, whole_due = false;
        std::shared_ptr<const Analysis> latest;  // of latest_revision
        std::uint64_t latest_revision = 0;
        std::shared_ptr<const Analysis> whole;    // the last that was complete
        std::shared_ptr<const Analysis> checked;  // of the same state, as far as its check
        std::shared_ptr<const Analysis> good;     // the last with a design
        std::shared_ptr<ExaminationMemory> memory = std::make_shared<ExaminationMemory>();
        std::optional<Clock::duration> whole_took;  // the last time; nullopt: that is not known
    };
    struct Waiting {
        Json message;
        Clock::time_point at;
        bool cancelled = false;
    };
    using Request = Json (Server::*)(const Json& params);
    using Notification = void (Server::*)(const Json& params);

    void handle(const Json& message);
    void handle_request(const std::string& method, const Json& id, const Json& params);
    void handle_notification(const std::string& method, const Json& params);
    void answer(const Json& id, Json result);
    void refuse(const Json& id, ErrorCode code, std::string_view why);
    void notify(std::string_view method, Json params);
    void cancel(const Json& params);

    Json initialize(const Json& params);
    Json shutdown(const Json& params);
    Json hover(const Json& params);
    Json complete(const Json& params);
    Json symbols(const Json& params);
    Json definition(const Json& params);
    Json references(const Json& params);
    Json prepare_rename(const Json& params);
    Json rename(const Json& params);
    Json code_actions(const Json& params);
    Json colors(const Json& params);
    Json color_presentations(const Json& params);
    Json format(const Json& params);
    Json lenses(const Json& params);
    Json execute(const Json& params);
    void initialized(const Json& params);
    void opened(const Json& params);
    void changed(const Json& params);
    void saved(const Json& params);
    void closed(const Json& params);
    void files_changed(const Json& params);
    void set_trace(const Json& params);

    // The document that params name; null: it is not open, or nothing is said of it.
    Document* find(const Json& params);
    [[nodiscard]] View view_of(const Document& document) const;
    [[nodiscard]] AnalysisOptions options_of(const Document& document) const;
    // What was found in the text as it is now: looked for on the spot where no run has ended yet.
    std::shared_ptr<const Analysis> current(Document& document);
    void touch(Document& document);
    [[nodiscard]] Clock::time_point whole_due_at(const Document& document) const;
    void trace(const Document& document, const Analysis& analysis, Clock::duration took);
    // Whether what was last found of it depends on a file.
    [[nodiscard]] static bool reads(const Document& document, const Analysis::File& file);
    // Those that read the file are looked at again.
    void touch_readers(const Analysis::File& file);
    void publish(const Document& document, const Analysis& analysis);
    // The open document of that path, or else of another name of the same file; null: it is not open.
    [[nodiscard]] const Document* opened_as(const std::string& path) const;
    [[nodiscard]] std::optional<std::string> text_of(const std::string& path) const;
    // A text that positions of a target refer to.
    [[nodiscard]] std::optional<Text> target_text(const std::string& path) const;
    [[nodiscard]] std::string target_uri(const std::string& path) const;
    Json location(const Target& target);
    Json workspace_edit(const std::vector<FileEdits>& files) const;
    Json action(const Document& document, const Fix& fix, std::string_view kind, const Finding* finding,
                bool preferred) const;
    // Where params' position is.
    std::size_t offset_of(const Document& document, const Json& params) const;

    ServerOptions options_;
    ClientAbilities client_;
    std::map<std::string, Document> documents_;  // by URI
    std::deque<Waiting> waiting_;
    std::vector<std::string> sent_;
    std::uint64_t revisions_ = 0;
    Clock::time_point now_;  // when the message came that is handled
    bool traces_ = false;
    bool initialized_ = false, shut_down_ = false, ended_ = false;
};

}  // namespace popup::lsp
