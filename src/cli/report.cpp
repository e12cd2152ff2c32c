#include "cli/report.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include "base/render_diagnostics.h"

namespace popup::cli {
namespace {

void to_standard_error(std::string_view text) {
    // Nothing can be said about a standard error that does not take it.
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

bool colorful(const MessageOptions& options) {
    if (options.color != When::automatic) return options.color == When::always;
    const char* no_color = std::getenv("NO_COLOR");
    const char* terminal = std::getenv("TERM");
    return options.file.empty() && (no_color == nullptr || *no_color == '\0') &&
           (terminal == nullptr || std::string_view(terminal) != "dumb") && ::isatty(STDERR_FILENO) != 0;
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string summary(std::size_t files, const std::array<std::size_t, 3>& counts) {
    std::string text = "popupc: " + counted(files, "file") + ": ";
    if (counts[2] + counts[1] == 0) return text + "nothing to report\n";
    if (counts[2] > 0) text += counted(counts[2], "error");
    if (counts[2] > 0 && counts[1] > 0) text += ", ";
    if (counts[1] > 0) text += counted(counts[1], "warning");
    return text + "\n";
}

}  // namespace

bool report(const MessageOptions& options, const std::vector<FileFindings>& files, const Diagnostics& run) {
    const bool color = colorful(options);
    std::string text;
    std::array<std::size_t, 3> counts{};
    const auto add = [&](const Diagnostics& diagnostics, std::string_view source) {
        PlaceFinder finder(source);
        for (const Diagnostic& one : diagnostics.sorted()) {
            if (options.quiet && one.severity == Severity::remark) continue;
            ++counts[static_cast<std::size_t>(one.severity)];
            switch (options.format) {
                case MessageFormat::text:
                    text += render_text(one, finder, color);
                    break;
                case MessageFormat::brief:
                    text += render_short(one, color);
                    break;
                case MessageFormat::json:
                    text += render_json(one);
                    break;
            }
        }
    };
    for (const FileFindings& file : files) add(*file.diagnostics, file.text);
    add(run, {});
    if (files.size() > 1 && !options.quiet && options.format != MessageFormat::json) {
        text += summary(files.size(), counts);
    }
    if (options.file.empty() && !options.use_standard_output()) {
        to_standard_error(text);
        return true;
    }
    if (options.use_standard_output()) return print(text);
    Diagnostics trouble;
    if (write_all({{options.file, text}}, false, trouble)) return true;
    for (const Diagnostic& one : trouble.sorted()) to_standard_error(render_short(one));
    return false;
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

void say_layers(const MessageOptions& options, const Compilation& compilation) {
    for (const CompiledDesign& one : compilation.designs) {
        if (!one.motion || !one.motion->examination) continue;
        const ClosedCard& closed = one.motion->examination->closed;
        if (closed.max_layers == 0) continue;  // too many to count
        std::string line = fmt::format("{}: closed, up to {} plates lie on one another, covers included",
                                       one.source.name, closed.max_layers);
        if (closed.thickness_mm) line += fmt::format(", {:.2f} mm", *closed.thickness_mm);
        say(options, line);
    }
}

std::function<void(std::size_t, std::size_t)> progress_meter(const MessageOptions& options,
                                                             std::size_t inputs) {
    const bool terminal = ::isatty(STDERR_FILENO) != 0;
    if (options.progress == When::never) return {};
    if (options.progress == When::automatic && (inputs < 2 || !terminal || options.quiet)) return {};
    return [terminal](std::size_t done, std::size_t total) {
        if (!terminal) {
            to_standard_error(fmt::format("popupc: {} of {} designs\n", done, total));
        } else if (done < total) {
            to_standard_error(fmt::format("\r{} of {} designs", done, total));
        } else {
            to_standard_error("\r\x1b[K");
        }
    };
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
    action.sa_handler = [](int) { interrupted.store(true); };
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
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

}  // namespace popup::cli
