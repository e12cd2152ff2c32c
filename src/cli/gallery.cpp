// A page for a library of designs, made anew as far as something has changed.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "cli/batch/jobserver.h"
#include "cli/batch/worker_pool.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/gallery/gallery_files.h"
#include "cli/gallery/gallery_job.h"
#include "cli/options/profile_options.h"
#include "cli/options/value_option.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/verbs.h"

namespace popup::cli {
namespace {

namespace fs = std::filesystem;

// Settings that change no page of a design: what is looked at, what is said of it, and where it goes.
constexpr std::string_view kElsewhere[] = {
    "INPUT", "output",  "title",   "include",        "exclude",     "jobs",   "color",     "progress",
    "quiet", "verbose", "dry-run", "message-format", "diagnostics", "config", "no-config", "include-dir"};

// `folders`: where programs load from, as they are named from the library's root.
std::string command_of(const Options& options, const std::optional<ProfileFile>& profile,
                       const std::vector<std::string>& folders) {
    std::vector<std::string> words{"include-dir"};
    words.insert(words.end(), folders.begin(), folders.end());
    for (const auto& [key, values] : options.settings) {
        if (std::find(std::begin(kElsewhere), std::end(kElsewhere), key) != std::end(kElsewhere)) continue;
        words.push_back(key);
        words.insert(words.end(), values.begin(), values.end());
    }
    if (profile) words.push_back(profile->source.text);
    return command_digest(words);
}

// Folders count from the working directory here, and from the library's root where designs are compiled.
void name_from(const std::string& root, std::vector<std::string>& folders) {
    for (std::string& folder : folders) {
        std::error_code error;
        const fs::path whole = fs::weakly_canonical(fs::absolute(folder, error), error);
        if (!error) folder = whole.lexically_relative(root).string();
    }
}

struct GalleryTally {
    std::size_t made = 0, fresh = 0, gone = 0;
    std::vector<std::size_t> due;
    bool unusable = false;  // a design could not be read, or a file not be written
    bool page = false;      // that of all designs is as it should be
    bool lost = false;      // nor could the record
};

// Hears how jobs end, and writes what they made.
class Keeper {
 public:
    Keeper(GalleryRun& run, GalleryFiles* files, const MessageOptions& messages)
        : run_(run),
          files_(files),
          messages_(messages),
          progress_(progress_meter(messages, run.plan.designs.size())) {}

    // False when nothing can be written down any more.
    bool hear(const JobEnd& end) {
        GalleryReply reply = end.reply ? unpacked_reply(*end.reply) : crashed_one(run_, end.job, end.signal);
        switch (reply.news) {
            case GalleryNews::fresh:
                ++tally.fresh;
                break;
            case GalleryNews::due:
                tally.due.push_back(end.job);
                break;
            case GalleryNews::made:
                if (keep(end.job, std::move(reply.entry))) ++tally.made;
                break;
        }
        if (progress_) progress_(++done_, run_.plan.designs.size());
        return !tally.lost;
    }

    GalleryTally tally;
    std::map<std::size_t, std::vector<Diagnostic>> told;  // by job: what is new
    std::map<std::size_t, std::string> printed;           // likewise

 private:
    // False when its files could not be written.
    bool keep(std::size_t job, GalleryEntry entry) {
        Diagnostics trouble(run_.plan.designs[job].file);
        const bool written = files_->write(entry.row, std::move(entry.files), run_.record, trouble);
        std::vector<Diagnostic>& findings = told[job] = entry.row.findings;
        for (Diagnostic& one : trouble.sorted()) findings.push_back(std::move(one));
        if (!entry.printed.empty()) printed[job] = std::move(entry.printed);
        const JobStatus status = entry.row.result.status;
        if (!written || status == JobStatus::unusable || status == JobStatus::crashed) tally.unusable = true;
        tally.lost = !files_->trouble().empty();
        say(messages_, fmt::format("{} {}", written ? "made" : "could not write",
                                   entry.row.result.outputs.empty() ? run_.plan.designs[job].file
                                                                    : entry.row.result.outputs.front().file));
        // Else what was there is still there, and its row with it.
        if (written) run_.record.add(std::move(entry.row));
        return written;
    }

    GalleryRun& run_;
    GalleryFiles* files_;  // null in a dry run
    const MessageOptions& messages_;
    std::function<void(std::size_t, std::size_t)> progress_;
    std::size_t done_ = 0;
};

std::string title_of(const GalleryOptions& gallery, const GalleryPlan& plan) {
    if (!gallery.title.empty()) return gallery.title;
    const std::string name = fs::path(plan.root).filename().string();
    return name.empty() ? "Designs" : name;
}

// The page of all designs that there are rows of.
bool write_index(const GalleryOptions& gallery, GalleryRun& run, GalleryFiles& files,
                 Diagnostics& diagnostics) {
    std::vector<const GalleryRow*> rows;
    for (const auto& [label, row] : run.record.rows()) {
        if (row.tile) rows.push_back(&row);
    }
    std::sort(rows.begin(), rows.end(),
              [](const GalleryRow* a, const GalleryRow* b) { return label_before(a->label, b->label); });
    std::vector<GalleryTile> tiles;
    tiles.reserve(rows.size());
    for (const GalleryRow* row : rows) tiles.push_back(*row->tile);
    std::vector<PendingFile> pending{
        {std::string(kGalleryIndex), write_gallery(title_of(gallery, run.plan), tiles)}};
    GalleryRow index;
    index.result.outputs.push_back(digest_of(pending.front().path, pending.front().bytes));
    if (!files.write(index, std::move(pending), run.record, diagnostics)) return false;
    run.record.add(std::move(index));
    return true;
}

// Designs that are gone have no tile any more.
void forget_others(GalleryRun& run) {
    std::set<std::string> labels{std::string()};
    for (const GalleryDesign& design : run.plan.designs) labels.insert(design.label);
    std::vector<std::string> others;
    for (const auto& [label, row] : run.record.rows()) {
        if (!labels.contains(label)) others.push_back(label);
    }
    for (const std::string& label : others) run.record.remove(label);
}

std::string text_of_file(const std::string& name) {
    Diagnostics unheard;
    std::optional<Source> source = read_source(name, unheard);
    return source ? std::move(source->text) : std::string();
}

// What there is to tell. Of designs that are as they were people are told the errors, and machines
// everything.
bool tell(const Options& options, const GalleryRun& run, const Keeper& keeper, const InputFiles& inputs,
          const Diagnostics& trouble) {
    const MessageOptions& messages = options.messages;
    std::deque<std::string> texts;
    Findings findings;
    for (const auto& [number, directory] : inputs.directories)
        findings.files.push_back({directory.file(), {}, false, directory.sorted(), {}});
    for (std::size_t i = 0; i < run.plan.designs.size(); ++i) {
        const GalleryDesign& design = run.plan.designs[i];
        const auto news = keeper.told.find(i);
        const GalleryRow* row = run.record.find(design.label);
        std::vector<Diagnostic> told;
        if (news != keeper.told.end()) {
            told = news->second;
        } else if (row != nullptr) {
            told = row->findings;
            if (!messages.format->for_machines && !messages.verbose) {
                std::erase_if(told, [](const Diagnostic& one) { return one.severity != Severity::error; });
            }
        }
        for (Diagnostic& one : told) one.file = design.file;
        if (!told.empty()) texts.push_back(text_of_file(design.file));
        // The counts of people's summary would be of what is told, and not of the gallery.
        findings.files.push_back({design.file,
                                  told.empty() ? std::string_view() : std::string_view(texts.back()),
                                  messages.format->for_machines,
                                  std::move(told),
                                  {}});
    }
    findings.run = trouble.sorted();
    return report(messages, std::move(findings));
}

std::string summary(const Options& options, const GalleryRun& run, const GalleryTally& tally,
                    double seconds) {
    std::size_t shown = 0;
    std::size_t failed = 0;
    for (const auto& [label, row] : run.record.rows()) {
        if (row.tile) ++shown;
        if (row.result.errors > 0) ++failed;
    }
    std::string text = fmt::format("{}/{}{}: {} design{}", options.gallery.directory, kGalleryIndex,
                                   tally.page ? "" : " could not be written", shown, shown == 1 ? "" : "s");
    if (failed > 0) text += fmt::format(", {} with errors", failed);
    text += fmt::format(", in {:.1f} s", seconds);
    if (tally.made > 0) text += fmt::format("; {} made", tally.made);
    if (tally.fresh > 0) text += fmt::format("; {} as they were", tally.fresh);
    if (tally.gone > 0)
        text += fmt::format("; {} old file{} taken away", tally.gone, tally.gone == 1 ? "" : "s");
    return text;
}

ExitCode exit_of(const GalleryRun& run, const GalleryTally& tally) {
    if (tally.unusable || tally.lost) return exit_unusable;
    const bool failed = std::any_of(run.record.rows().begin(), run.record.rows().end(),
                                    [](const auto& one) { return one.second.result.errors > 0; });
    return failed ? exit_findings : exit_done;
}

// Starts the workers; returns the signal that ended the run, or 0.
int make_all(const Options& options, const GalleryRun& run, Keeper& keeper) {
    std::vector<std::size_t> jobs(run.plan.designs.size());
    for (std::size_t i = 0; i < jobs.size(); ++i) jobs[i] = i;
    PoolOptions pool;
    pool.workers = static_cast<std::size_t>(std::max(1, options.compile.threads));
    pool.begun = [&run] {
        // There labels are names of files. It was looked at before: what is gone now ends the job.
        if (::chdir(run.plan.root.c_str()) != 0) std::_Exit(1);
    };
    Jobserver jobserver(options.jobs_given ? nullptr : std::getenv("MAKEFLAGS"));
    if (!jobserver.trouble().empty()) say(options.messages, jobserver.trouble());
    ask_before_workers(jobserver, pool);
    return run_pool(
        jobs, pool, [&run](std::size_t job) { return packed(make_one(run, job)); },
        [&keeper](const JobEnd& end) { return keeper.hear(end); });
}

// Everything that is looked at before any design is.
GalleryRun prepare(const Options& options, GalleryPlan plan, const std::optional<ProfileFile>& profile) {
    const std::string& given = options.gallery.directory;
    GalleryRun run;
    run.plan = std::move(plan);
    run.directory = directory_for(given, run.plan);
    run.record = record_of(given, run.directory, run.plan);
    run.compile = options.compile;
    run.policy = options.policy;
    run.dry_run = options.gallery.dry_run;
    run.compile.read.language = options.inputs.language;
    run.compile.threads = 1;
    run.compile.output.threads = 1;
    // An interrupt lets a design come to its end as it would have: what is cut short is another result.
    static const std::atomic<bool> kNever{false};
    run.compile.layout.nesting.stop = &kNever;
    name_from(run.plan.root, run.compile.read.program.folders);
    run.command = command_of(options, profile, run.compile.read.program.folders);
    for (const std::string_view file : {kGalleryIndex, kGalleryRecord}) {
        const std::string path = fmt::format("{}/{}", given, file);
        if (!options.messages.file.empty() && same_place(path, options.messages.file))
            throw UsageError(path + " is named twice", {"--diagnostics takes a file of its own"});
    }
    if (::access(run.plan.root.c_str(), X_OK) != 0) throw UsageError(run.plan.root + ": permission denied");
    return run;
}

void print_programs(const Options& options, const GalleryRun& run, const Keeper& keeper) {
    for (const auto& [job, text] : keeper.printed) {
        std::string shown = fmt::format("== {} ==\n", run.plan.designs[job].file) + text;
        if (!shown.ends_with('\n')) shown += '\n';
        say_between(options.messages, shown_on_terminal(shown));
    }
}

void check_arguments(const Options& options) {
    check_motion_options(options);
    if (options.gallery.directory.empty())
        throw UsageError("a gallery needs a directory: name one with -o",
                         {"such as: popupc gallery designs/ -o gallery"});
    const std::vector<std::string>& names = options.inputs.names;
    if (std::find(names.begin(), names.end(), "-") != names.end())
        throw UsageError("a gallery is made of files, and standard input is none");
}

}  // namespace

CLI::App* add_gallery(CLI::App& app, Options& options) {
    CLI::App* verb =
        app.add_subcommand("gallery", "Make a page for a library of designs, with a tile a design");
    GalleryOptions& gallery = options.gallery;
    add_input_options(*verb, options);
    add_tree_options(*verb, options);
    value(*verb, "-o,--output", "DIR", "the directory of the gallery; DIR/index.html is its page", "Output",
          [&gallery](std::string_view text) { gallery.directory = text; })
        ->configurable(false);
    value(*verb, "--title", "TEXT",
          "what stands above the tiles (default: the name of the designs' directory)", "Output",
          [&gallery](std::string_view text) { gallery.title = text; });
    verb->add_flag("-n,--dry-run", gallery.dry_run, "print the designs that have something to do; do nothing")
        ->configurable(false)
        ->group("Output");
    add_profile_options(*verb, options);
    add_check_options(*verb, options);
    add_sheet_options(*verb, options);
    add_nest_options(*verb, options);
    add_motion_options(*verb, options);
    add_program_options(*verb, options);
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    add_thread_option(*verb, options);
    // What these ask for, pages do not have.
    for (const char* name : {"--dpi", "--print-and-cut", "--print"})
        verb->remove_option(verb->get_option(name));
    verb->footer(
        "Examples:\n"
        "  popupc gallery designs/ -o gallery\n"
        "  popupc gallery spring/ autumn/ extra.fl -o site/cards --title 'All cards'\n"
        "  popupc gallery designs/ -o gallery --sheet a4 --profile k40\n"
        "  popupc gallery designs/ -o gallery --dry-run\n"
        "\nWhat has not changed is not made again. A design that is gone loses its tile and its files; files "
        "that\n"
        "the gallery did not write are left alone. A design with errors has a tile that shows them.\n"
        "\nExit status 0 when all designs are shown, 1 when some have errors, 2 when some could not be read "
        "or\n"
        "written.");
    return verb;
}

int run_gallery(const Options& given) {
    const auto begun = std::chrono::steady_clock::now();
    Options options = given;
    check_arguments(options);
    const MessageOptions& messages = options.messages;
    const InputFiles files = find_inputs(options);
    check_inputs(options, files.names);
    spare(files_read(options, files.names, files.ignore_files), options);
    const std::optional<ProfileFile> profile = load_profile(options);
    if (profile && profile->diagnostics.has_errors()) {
        report(messages, {{&profile->diagnostics, profile->source.text, false}}, Diagnostics());
        return profile->readable ? exit_findings : exit_unusable;
    }
    finish_profile(options);
    GalleryRun run = prepare(options, plan_gallery(options.inputs.names, files.names), profile);
    std::optional<GalleryFiles> output;
    const bool is_empty = run.plan.designs.empty();
    if (!run.dry_run && !is_empty) output.emplace(options.gallery.directory, run.directory);
    Keeper keeper(run, output ? &*output : nullptr, messages);
    const int signal = make_all(options, run, keeper);
    GalleryTally& tally = keeper.tally;
    if (!files.readable) tally.unusable = true;
    Diagnostics trouble;
    if (output) {
        // Where a directory could not be looked at, its designs may still be there.
        if (files.readable) forget_others(run);
        const bool written = !tally.lost && write_index(options.gallery, run, *output, trouble);
        tally.page = written;
        if (!written) tally.unusable = true;
        // The old page leads to files that the new one does without.
        if (written) tally.gone = output->settle(run.record, messages, tally.lost);
        output->close();
    }
    print_programs(options, run, keeper);
    const bool told = tell(options, run, keeper, files, trouble);
    if (signal != 0) {
        say_between(messages,
                    fmt::format("popupc: interrupted: {} of {} designs were looked at; the same command "
                                "goes on from there\n",
                                tally.made + tally.fresh, run.plan.designs.size()));
        std::raise(signal);
    }
    if (tally.lost) {
        report_usage(UsageError(fmt::format("{}/{} cannot be written: {}", options.gallery.directory,
                                            kGalleryRecord, output->trouble()),
                                {"the same command goes on from what is written down"}));
    }
    if (run.dry_run) {
        std::string due;
        std::sort(tally.due.begin(), tally.due.end());
        for (const std::size_t job : tally.due) due += run.plan.designs[job].file + "\n";
        return print(due) && told ? exit_of(run, tally) : exit_unusable;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (is_empty && !run.record.rows().empty()) {
        announce(messages, fmt::format("{}/{} stays as it was: there is no design to show in its place",
                                       options.gallery.directory, kGalleryIndex));
    }
    if (output && !messages.use_standard_output())
        announce(messages, summary(options, run, tally, took.count()));
    if (!told) return exit_unusable;
    return is_empty && files.readable ? exit_findings : exit_of(run, tally);
}

}  // namespace popup::cli
