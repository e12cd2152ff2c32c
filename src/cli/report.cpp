#include "cli/report.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/diagnostics/render_diagnostics.h"
#include "base/system/signal_cleanup.h"
#include "findings/repository.h"
#include "findings/statistics.h"

namespace popup::cli {
namespace {

namespace fs = std::filesystem;

void to_standard_error(std::string_view text) {
    // Nothing can be said about a standard error that does not take it.
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

fs::path absolute_or(const char* given, const fs::path& otherwise) {
    if (given == nullptr || *given == '\0') return otherwise;
    const fs::path path(given);
    return path.is_absolute() ? path : otherwise;
}

MessageStyle style_of(const MessageOptions& options) {
    MessageStyle style;
    style.color = colorful(options);
    std::error_code error;
    style.working = fs::current_path(error);
    // In a directory that is gone files have the names that were given.
    if (error) style.working = "/";
    style.repository = repository_of(style.working);
    style.workspace = absolute_or(std::getenv("GITHUB_WORKSPACE"), style.repository);
    return style;
}

// A line that closes the findings of several designs; files are the same whenever they are written, so they
// name no time.
std::string summary(const MessageOptions& options, const Findings& findings) {
    if (options.quiet || findings.designs() < 2) return {};
    if (!options.file.empty()) return summary_line(findings, std::nullopt);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - options.began;
    return summary_line(findings, passed.count());
}

// To where the user wants the findings.
bool deliver(const MessageOptions& options, const std::string& text) {
    if (options.use_standard_output()) return print(text);
    if (options.file.empty()) {
        to_standard_error(text);
        return true;
    }
    Diagnostics trouble;
    if (write_all({{options.file, text}}, false, trouble)) return true;
    for (const Diagnostic& one : trouble.sorted()) to_standard_error(render_short(one));
    return false;
}

}  // namespace

bool colorful(const MessageOptions& options) {
    if (options.color != When::automatic) return options.color == When::always;
    const char* no_color = std::getenv("NO_COLOR");
    const char* terminal = std::getenv("TERM");
    return options.file.empty() && (no_color == nullptr || *no_color == '\0') &&
           (terminal == nullptr || std::string_view(terminal) != "dumb") && ::isatty(STDERR_FILENO) != 0;
}

void say_between(const MessageOptions& options, std::string_view text) {
    const bool bar = options.progress != When::never && ::isatty(STDERR_FILENO) != 0;
    if (bar) to_standard_error("\r\x1b[K");
    to_standard_error(text);
}

bool report(const MessageOptions& options, const std::vector<FileFindings>& files, const Diagnostics& run) {
    return report(options, collect(files, run));
}

bool report(const MessageOptions& options, Findings findings) {
    if (options.quiet) findings = without_remarks(std::move(findings));
    MessageStyle style = style_of(options);
    style.summary = summary(options, findings);
    return deliver(options, options.format->render(findings, style));
}

bool report_statistics(const MessageOptions& options, Findings findings) {
    if (options.quiet) findings = without_remarks(std::move(findings));
    const std::vector<CodeCount> rows = count_findings(findings);
    if (options.format->for_machines) return deliver(options, statistics_json(rows));
    return deliver(options, statistics_text(rows) + summary(options, findings));
}

bool print(std::string_view text) {
    Diagnostics trouble;
    if (write_all({{"-", std::string(text)}}, false, trouble)) return true;
    if (!reader_has_gone()) {
        for (const Diagnostic& one : trouble.sorted()) to_standard_error(render_short(one));
    }
    return false;
}

void say(const MessageOptions& options, std::string_view line) {
    if (options.verbose) to_standard_error(fmt::format("popupc: {}\n", visible(line)));
}

void announce(const MessageOptions& options, std::string_view line) {
    if (!options.quiet) to_standard_error(fmt::format("popupc: {}\n", visible(line)));
}

void announce_links(const MessageOptions& options, const std::string& document) {
    std::error_code error;
    const std::uintmax_t names = std::filesystem::hard_link_count(document, error);
    if (error || names < 2) return;
    announce(options, fmt::format("{} has {} more name{} (hard links), which keep{} the document as it was",
                                  document, names - 1, names == 2 ? "" : "s", names == 2 ? "s" : ""));
}

std::string layers_line(const CompiledDesign& one) {
    if (!one.motion || !one.motion->examination) return {};
    const ClosedCard& closed = one.motion->examination->closed;
    if (closed.max_layers == 0) return {};  // too many to count
    std::string line = fmt::format("{}: closed, up to {} plates lie on one another, covers included",
                                   one.source.name, closed.max_layers);
    if (closed.thickness_mm) line += fmt::format(", {:.2f} mm", *closed.thickness_mm);
    return line;
}

void say_layers(const MessageOptions& options, const Compilation& compilation) {
    for (const CompiledDesign& one : compilation.designs) {
        const std::string line = layers_line(one);
        if (!line.empty()) say(options, line);
    }
}

std::function<void(const NestProgress&)> nesting_meter(const MessageOptions& options) {
    const bool terminal = ::isatty(STDERR_FILENO) != 0;
    if (options.progress == When::never) return {};
    if (options.progress == When::automatic && (!terminal || options.quiet)) return {};
    using Clock = std::chrono::steady_clock;
    const auto shown = std::make_shared<std::pair<Clock::time_point, bool>>(Clock::now(), false);
    return [terminal, shown](const NestProgress& progress) {
        auto& [last, any] = *shown;
        const bool over = progress.done >= 1.0;
        const auto pause = std::chrono::milliseconds(terminal ? 200 : 1000);
        if (!over && Clock::now() - last < pause) return;
        if (over && !any) return;
        last = Clock::now();
        if (terminal && over) {
            any = false;
            to_standard_error("\r\x1b[K");
            return;
        }
        any = true;
        to_standard_error(fmt::format("{}{} sheet{}, {:.1f} % used, {:.1f} mm of the last, {:.0f} % done{}",
                                      terminal ? "\r\x1b[K" : "popupc: nesting: ", progress.sheets,
                                      progress.sheets == 1 ? "" : "s", 100.0 * progress.utilisation,
                                      progress.last_length, 100.0 * progress.done, terminal ? "" : "\n"));
    };
}

namespace {
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);
}  // namespace

const std::atomic<bool>* stop_on_interrupt() {
    struct sigaction action {};
    action.sa_handler = [](int signal) {
        if (interrupted.exchange(true)) end_by_signal(signal);
    };
    action.sa_flags = static_cast<int>(SA_RESTART);
    ::sigaction(SIGINT, &action, nullptr);
    return &interrupted;
}

void report_usage(const UsageError& error) {
    if (const UsageError::InFile* file = error.in_file()) {
        PlaceFinder finder(file->text);
        const bool color = colorful({});
        for (const Diagnostic& one : file->findings.sorted()) {
            to_standard_error(render_text(one, finder, color));
        }
        return;
    }
    std::string text = fmt::format("popupc: error: {}\n", visible(error.what()));
    for (const std::string& hint : error.hints()) text += fmt::format("  hint: {}\n", visible(hint));
    to_standard_error(text);
}

bool reader_has_gone() {
    pollfd out{STDOUT_FILENO, POLLOUT, 0};
    return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

void end_out_of_memory() {
    constexpr std::string_view kSays = "popupc: error: there is not enough memory\n";
    [[maybe_unused]] const ssize_t put = ::write(STDERR_FILENO, kSays.data(), kSays.size());
    end_with(exit_unusable);
}

}  // namespace popup::cli
