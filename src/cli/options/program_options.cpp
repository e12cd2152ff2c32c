#include "cli/options/program_options.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "base/diagnostics/render_diagnostics.h"
#include "base/nth.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/options/value_option.h"
#include "cli/report.h"

namespace popup::cli {
namespace {

constexpr std::string_view kProgramGroup = "Programs";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// Such as FlatLang gives to variables.
bool is_name(std::string_view text) {
    return !text.empty() && is_letter(text.front()) && std::all_of(text.begin(), text.end(), [](char c) {
        return is_letter(c) || (c >= '0' && c <= '9');
    });
}

// "NAME=VALUE"; "NAME" alone is true. Of several with one name the last counts, in its place.
void define(std::vector<std::pair<std::string, std::string>>& definitions, std::string_view text) {
    const std::size_t equals = text.find('=');
    const std::string_view name = text.substr(0, equals);
    if (!is_name(name)) {
        throw UsageError(
            fmt::format("-D takes NAME=VALUE, and \"{}\" is no name of a variable", visible(name)),
            {"names are letters, digits and _, and begin with no digit: -D teeth=24"});
    }
    definitions.erase(std::remove_if(definitions.begin(), definitions.end(),
                                     [name](const auto& one) { return one.first == name; }),
                      definitions.end());
    definitions.emplace_back(name, equals == std::string_view::npos ? "true" : text.substr(equals + 1));
}

void add_limit(CLI::App& verb, const std::string& name, const std::string& about, std::uint64_t& limit,
               double most) {
    value(verb, name, "N", fmt::format("{} (default {})", about, limit), std::string(kProgramGroup),
          [name, &limit, most](std::string_view text) {
              const double count = number_option(name, text, 1.0, most);
              if (count != std::floor(count))
                  throw UsageError(fmt::format("{} takes a whole number, not \"{}\"", name, text));
              limit = static_cast<std::uint64_t>(count);
          });
}

// What each input printed, in argument order.
template <typename Use>
void each_input(const Run& run, Use use) {
    for (const int index : run.order) {
        if (index < 0) {
            const Run::Apart& one = nth(run.apart, -1 - index);
            use(one.diagnostics.file(), one.printed, one.loaded);
        } else {
            const CompiledDesign& one = nth(run.compilation.designs, index);
            use(one.source.name, one.printed, one.further_files);
        }
    }
}

}  // namespace

void add_run_options(CLI::App& verb, Options& options) {
    ProgramOptions& program = options.compile.read.program;
    const std::string group(kProgramGroup);
    values(verb, "-D,--define", "NAME=VALUE", "a program's variable; without =VALUE it is true. Repeatable",
           group, [&program](std::string_view text) { define(program.definitions, text); });
    values(verb, "-I,--include-dir", "DIR", "where programs load from after their own folder. Repeatable",
           group, [&program](std::string_view text) {
               if (text.empty()) throw UsageError("-I takes the name of a directory");
               program.folders.emplace_back(text);
           });
    value(verb, "--flatlang", "EDITION", "mended (default), or 2008: as the original interpreter was", group,
          [&program](std::string_view text) {
              program.as_2008 = choose<bool>("--flatlang", text, {{"mended", false}, {"2008", true}});
          });
    ProgramLimits& limits = program.limits;
    add_limit(verb, "--max-steps", "evaluations, after which a program is stopped", limits.steps, 1e15);
    add_limit(verb, "--max-depth", "calls within calls, likewise", limits.depth, 1e5);
    add_limit(verb, "--max-values", "elements, members and variables at a time", limits.values, 1e9);
    add_limit(verb, "--max-text", "bytes of a text, and of all that is printed", limits.text, 1e9);
    add_limit(verb, "--max-trail", "operations of the turtle", limits.trail, 1e9);
}

void add_program_options(CLI::App& verb, Options& options) {
    add_run_options(verb, options);
    value(verb, "--print", "FILE", "what programs print goes here (default: to standard error)",
          std::string(kProgramGroup),
          [&options](std::string_view text) {
              if (text.empty()) throw UsageError("--print takes the name of a file");
              options.print.file = text;
          })
        ->configurable(false);
}

void check_print_options(const Options& options) {
    const std::string& file = options.print.file;
    if (file.empty()) return;
    if (is_standard_output(file) && options.messages.use_standard_output()) {
        throw UsageError("standard output has two users: --print and the diagnostics",
                         {"--diagnostics FILE and --print FILE take files"});
    }
    for (const std::string& other : {options.messages.file, options.judge.baseline}) {
        if (!other.empty() && same_place(file, other))
            throw UsageError(file + " is named twice", {"--print takes a file of its own"});
    }
}

std::string printed_text(const Run& run) {
    const bool several = run.order.size() > 1;
    std::string all;
    each_input(run, [&](const std::string& name, const std::string& printed, const auto& /*loaded*/) {
        if (printed.empty()) return;
        if (several) all += fmt::format("== {} ==\n", name == "-" ? "<stdin>" : visible(name));
        all += printed;
        if (!all.ends_with('\n')) all += '\n';
    });
    return all;
}

std::string shown_on_terminal(std::string_view printed) {
    std::string shown;
    while (!printed.empty()) {
        const std::size_t end = std::min(printed.find_first_of("\n\t"), printed.size());
        shown += visible(printed.substr(0, end));
        if (end == printed.size()) break;
        shown += printed[end];
        printed.remove_prefix(end + 1);
    }
    return shown;
}

void tell_printed(const Options& options, const Run& run) {
    if (!options.print.file.empty()) return;
    const std::string shown = shown_on_terminal(printed_text(run));
    if (!shown.empty()) say_between(options.messages, shown);
}

bool write_printed(const Options& options, const Run& run, Diagnostics& diagnostics) {
    if (options.print.file.empty()) return true;
    return write_all({{options.print.file, printed_text(run)}}, false, diagnostics);
}

void check_loaded(const Run& run, const std::string& output) {
    if (output.empty()) return;
    Diagnostics told;
    if (!spares_loaded(output, loaded_files(run), told)) refuse_usage(told);
}

void check_loaded(const Source& source, const ReadOptions& options,
                  std::initializer_list<std::string_view> outputs) {
    std::optional<Reading> reading;
    for (const std::string_view output : outputs) {
        std::error_code error;
        if (output.empty() || !std::filesystem::exists(output, error)) continue;
        if (!reading) {
            Diagnostics unheard;
            reading = read_source_text(source, options, unheard);
        }
        Diagnostics told;
        if (!spares_loaded(std::string(output), reading->files, told)) refuse_usage(told);
    }
}

void check_loaded(const std::vector<std::string>& loaded, std::initializer_list<std::string_view> outputs) {
    for (const std::string_view output : outputs) {
        Diagnostics told;
        if (!output.empty() && !spares_loaded(std::string(output), loaded, told)) refuse_usage(told);
    }
}

std::vector<std::string> loaded_files(const Run& run) {
    std::vector<std::string> files;
    std::set<std::string_view> seen;
    each_input(run, [&](const std::string& /*name*/, const std::string& /*printed*/, const auto& loaded) {
        for (const std::string& file : loaded) {
            if (seen.insert(file).second) files.push_back(file);
        }
    });
    return files;
}

}  // namespace popup::cli
