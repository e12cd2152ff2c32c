// `popupc view`: the live view of inputs, in the reader's browser.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/build.h"
#include "cli/files/outputs.h"
#include "cli/options/value_option.h"
#include "cli/report.h"
#include "cli/sheets_later.h"
#include "cli/verbs.h"
#include "cli/watch.h"
#include "live/browser.h"
#include "live/server.h"
#include "output/viewer/live.h"
#include "popup/write.h"

namespace popup::cli {
namespace {

// Long enough for a file that is taken away and made anew, and for the rest of a burst.
constexpr std::chrono::milliseconds kQuietForEyes{10};

void add_view_options(CLI::App& verb, Options& options) {
    ViewOptions& view = options.view;
    value(verb, "--port", "N", "the port to serve on (default: one that is free)", "View",
          [&view](std::string_view text) {
              const double port = number_option("--port", text, 1.0, 65535.0);
              view.port = static_cast<int>(port);
              if (view.port != port) {
                  throw UsageError(fmt::format("--port takes a whole number, not \"{}\"", text));
              }
          });
    verb.add_flag("--no-browser", view.no_browser, "only print the address, and open no browser")
        ->group("View");
    value(verb, "--idle", "TIME", "end when no page was open for so long (default 1h); 0: never", "View",
          [&view](std::string_view text) {
              const auto time = parse_time(text);
              if (!time) {
                  throw UsageError(fmt::format("--idle takes a time of at most 1000 hours, not \"{}\"", text),
                                   {"write 90s, 15m or 1h; 0 is never"});
              }
              view.idle = *time;
          });
}

void check_streams(const Options& options) {
    check_watchable(options, "view compiles again and again");
    if (!options.messages.use_standard_output()) return;
    throw UsageError("standard output has two users: the address of the view, and the diagnostics",
                     {"--message-format text and short go to standard error"});
}

// UsageError where an input has no model to be shown.
void check_shown(const Compilation& compilation, const std::vector<std::string>& inputs) {
    static constexpr Format kLive{"", "the live view", PageWriter{}, Stills::all};
    Diagnostics told;
    if (!can_be_made({{{"the live view", &kLive}}, inputs}, compilation, told)) refuse_usage(told);
}

// What there is to say of a build, and of the models and sheets that were made of it.
live::News news_of(const Build& done) {
    live::News news;
    std::vector<Diagnostic> all;
    std::vector<LiveError> errors;
    const auto add = [&](const Diagnostics& diagnostics, std::string_view text) {
        for (Diagnostic& one : diagnostics.sorted()) {
            if (one.severity == Severity::error) errors.push_back({one, text});
            all.push_back(std::move(one));
        }
    };
    const std::vector<FileFindings> findings = done.findings();
    for (const FileFindings& one : findings) add(*one.diagnostics, one.text);
    add(done.run.compilation.run_diagnostics, {});
    news.errors = errors.size();
    if (!errors.empty()) news.trouble = live_trouble(errors);
    news.finding_count = all.size();
    news.findings = live_findings(all);
    return news;
}

// Wrong options, as pages show them.
live::News news_of(const UsageError& error) {
    live::News news;
    std::vector<Diagnostic> all;
    if (const UsageError::InFile* file = error.in_file()) {
        all = file->findings.sorted();
    } else {
        Diagnostic& one = all.emplace_back();
        one.message = error.what();
        one.hints = error.hints();
    }
    std::vector<LiveError> errors;
    for (const Diagnostic& one : all) {
        if (one.severity == Severity::error) {
            errors.push_back(
                {one, error.in_file() != nullptr ? std::string_view(error.in_file()->text) : ""});
        }
    }
    news.errors = errors.size();
    news.trouble = live_trouble(errors);
    news.stale = true;
    news.finding_count = all.size();
    news.findings = live_findings(all);
    return news;
}

std::unique_ptr<live::Server> serve(const ViewOptions& view) {
    LivePage page = live_page();
    live::Serving serving{.page = std::move(page.html), .policy = std::move(page.policy)};
    serving.port = static_cast<std::uint16_t>(view.port);
    serving.idle = view.idle;
    serving.forsaken = stop_watching;
    try {
        return std::make_unique<live::Server>(std::move(serving));
    } catch (const live::CannotServe& error) {
        if (view.port == 0) throw UsageError(fmt::format("no port can be had: {}", error.what()));
        std::vector<std::string> hints{"without --port one is taken that is free"};
        if (!error.in_use() && view.port < 1024) hints.emplace_back("ports below 1024 are the system's");
        throw UsageError(fmt::format("--port {}: {}", view.port,
                                     error.in_use() ? "another program has this port" : error.what()),
                         hints);
    }
}

}  // namespace

CLI::App* add_view(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("view", "Show the card in a browser, and every save of it at once");
    add_input_options(*verb, options);
    verb->get_option("INPUT")->description("documents to show");
    add_view_options(*verb, options);
    add_profile_options(*verb, options);
    add_check_options(*verb, options);
    add_sheet_options(*verb, options);
    add_nest_options(*verb, options);
    add_motion_options(*verb, options);
    add_animation_options(*verb, options);
    add_program_options(*verb, options);
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    add_thread_option(*verb, options);
    // It writes no file at all.
    for (const char* name : {"--dpi", "--print-and-cut", "--print", "--diagnostics"})
        verb->remove_option(verb->get_option(name));
    verb->footer(
        "Examples:\n"
        "  popupc view castle.xml\n"
        "  popupc view town.svg --as folded\n"
        "  popupc view castle.xml --no-browser --port 8123\n"
        "\nThe address is printed to standard output. Only this machine can open it, and only who has it.\n"
        "Ctrl-C ends it, and so does an hour without a page. Exit status 0 then, 2 for wrong usage.");
    return verb;
}

namespace {

// One live view, from its start to its end.
class View {
 public:
    explicit View(const Options& options) : server_(serve(options.view)) {}

    BuiltOf build(Options now, const std::string& why) {
        check_streams(now);
        sheets_.forget();
        auto job = std::make_unique<SheetsJob>();
        job->build = compile_inputs(now, Stage::pattern);
        BuiltOf read{job->build.inputs, job->build.missing};
        Compilation& compilation = job->build.run.compilation;
        std::optional<std::string> model;
        if (job->build.status == exit_done) {
            check_shown(compilation, now.inputs.names);
            model = live_model(scene_of(compilation), now.compile.output, compilation.run_diagnostics);
        }
        live::News news = news_of(job->build);
        news.stale = !model;
        news.model = model;
        server_->put(std::move(news));
        if (why.empty()) {
            show_address(now);
        } else {
            say(now.messages, fmt::format("{} has changed: {}", why,
                                          model ? "shown" : "it has errors, and the last picture stays"));
        }
        if (model) {
            job->options = std::move(now);
            sheets_.start(std::move(job));
        } else {
            tell_build(now, job->build);
        }
        return read;
    }

    void refuse(const UsageError& error) {
        sheets_.forget();
        server_->put(news_of(error));
    }

    // Whether the address could be told.
    [[nodiscard]] bool told() const { return told_; }

 private:
    void show_address(const Options& options) {
        told_ = print(server_->address() + "\n");
        if (!told_) return stop_watching();
        if (options.view.no_browser || live::open_browser(server_->address())) return;
        announce(options.messages, "no browser could be started: open the address above in one");
    }

    std::unique_ptr<live::Server> server_;
    bool told_ = false;
    SheetsLater sheets_{[this](const SheetsJob& job, std::optional<std::string> sheets) {
        live::News news = news_of(job.build);
        news.sheets = std::move(sheets);
        server_->put(std::move(news));
        tell_build(job.options, job.build);
    }};
};

}  // namespace

int run_view(const Options& options) {
    check_streams(options);
    View view(options);
    Watched watched;
    watched.quiet = kQuietForEyes;
    watched.harmless = true;
    watched.build = [&view](const Options& now, const std::string& why) { return view.build(now, why); };
    watched.refused = [&view](const UsageError& error) { view.refuse(error); };
    watch(options, watched);
    return view.told() ? exit_done : exit_unusable;
}

}  // namespace popup::cli
