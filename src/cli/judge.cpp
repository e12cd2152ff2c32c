#include "cli/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cli/files/read_settings.h"
#include "cli/report.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

namespace fs = std::filesystem;

BaselinePlaces places_of(const std::string& baseline) {
    std::error_code error;
    BaselinePlaces places;
    places.working = fs::current_path(error);
    if (error) places.working = "/";
    places.baseline = (places.working / baseline).parent_path();
    return places;
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

void check_judge_options(const Options& options) {
    const JudgeOptions& judge = options.judge;
    const MessageOptions& messages = options.messages;
    if (judge.write_baseline && judge.baseline.empty())
        throw UsageError("--write-baseline needs to know where", {"--baseline FILE names the file"});
    if (judge.statistics && messages.format->for_machines && messages.format->name != "json") {
        throw UsageError(
            fmt::format("--statistics are counts, and {} has no place for them", messages.format->name),
            {"take text, short or json"});
    }
    if (judge.baseline.empty()) return;
    if (!messages.file.empty() && same_place(judge.baseline, messages.file))
        throw UsageError(judge.baseline + " is named twice", {"--diagnostics and --baseline take two files"});
}

std::optional<BaselineFile> load_baseline(const Options& options) {
    const std::string& name = options.judge.baseline;
    if (name.empty()) return std::nullopt;
    BaselineFile file;
    file.diagnostics = Diagnostics(name);
    std::error_code error;
    if (options.judge.write_baseline && fs::symlink_status(name, error).type() == fs::file_type::not_found) {
        file.is.emplace();
        return file;
    }
    Diagnostics reading(name);
    std::optional<Source> source = read_settings(name, reading);
    if (!source) {
        for (const Diagnostic& one : reading.sorted()) {
            file.diagnostics.add(one.severity, one.code, one.place, one.message)
                .hint("--write-baseline makes a new one");
        }
        return file;
    }
    file.source = std::move(*source);
    file.is = read_baseline(file.source, file.diagnostics);
    return file;
}

void judge(const Options& options, const Baseline& baseline, Findings& findings) {
    const std::string& name = options.judge.baseline;
    const std::size_t outdated = accept(findings, baseline, places_of(name));
    say(options.messages, fmt::format("{} {} accepted by {}", counted(findings.accepted(), "finding"),
                                      findings.accepted() == 1 ? "is" : "are", name));
    if (outdated == 0) return;
    Diagnostics remarks(name, options.policy);
    remarks
        .remark("baseline-outdated", {},
                fmt::format("{} of the baseline {} no longer there", counted(outdated, "finding"),
                            outdated == 1 ? "is" : "are"))
        .hint("--write-baseline takes what is mended out of it");
    for (Diagnostic& one : remarks.sorted()) findings.run.push_back(std::move(one));
}

bool accept_all(const Options& options, const Baseline& old, Findings& findings) {
    const std::string& name = options.judge.baseline;
    const BaselinePlaces places = places_of(name);
    const auto exists = [&places](const std::string& file) {
        std::error_code error;
        return fs::exists(places.baseline / file, error);
    };
    std::size_t kept = 0;
    const Baseline baseline = baseline_of(findings, old, places, exists, &kept);
    Diagnostics trouble(name);
    if (!write_all({{name, write_baseline(baseline)}}, true, trouble)) {
        for (Diagnostic& one : trouble.sorted()) findings.run.push_back(std::move(one));
        return false;
    }
    accept(findings, baseline, places);
    announce(
        options.messages,
        fmt::format("{} in {} {} accepted by {} from now on", counted(findings.accepted(), "finding"),
                    counted(findings.designs(), "design"), findings.accepted() == 1 ? "is" : "are", name));
    if (kept > 0) {
        announce(options.messages,
                 fmt::format("{} of files with errors, which keep them from being looked for, stay{} in {}",
                             counted(kept, "accepted finding"), kept == 1 ? "s" : "", name));
    }
    return true;
}

}  // namespace popup::cli
