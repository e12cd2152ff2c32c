#include "cli/options/options.h"

#include <fmt/format.h>

#include <cstdlib>
#include <thread>
#include <utility>

#include "base/diagnostics/render_diagnostics.h"
#include "cli/options/value_option.h"

namespace popup::cli {
namespace {

// The worst finding as "FILE:LINE:COLUMN: MESSAGE".
std::string one_line(const Diagnostics& findings) {
    const std::vector<Diagnostic> all = findings.sorted();
    POPUP_INVARIANT(!all.empty());
    const Diagnostic& one = all.front();
    if (one.place.line == 0) return fmt::format("{}: {}", one.file, one.message);
    return fmt::format("{}:{}:{}: {}", one.file, one.place.line, one.place.column, one.message);
}

void add_codes(CLI::App& verb, const std::string& name, const std::string& about,
               std::set<std::string, std::less<>>& codes) {
    values(verb, name, "CODE", about, "Diagnostics", [name, &codes](std::string_view code) {
        if (find_code(code) == nullptr) {
            std::vector<std::string_view> known;
            for (const CodeInfo& row : code_table()) known.push_back(row.code);
            auto hints = did_you_mean(code, known);
            hints.emplace_back("\"popupc list codes\" lists all");
            throw UsageError(fmt::format("{}: there is no diagnostic \"{}\"", name, code), hints, known);
        }
        codes.emplace(code);
    });
}

}  // namespace

Length length_option(std::string_view option, std::string_view text, double least_mm) {
    const std::optional<Length> length = parse_length(text);
    constexpr double kMostLengthMm = 1e6;
    if (length && length->mm > kMostLengthMm) {
        throw UsageError(
            fmt::format("{} takes {:.0f} m at most, not \"{}\"", option, kMostLengthMm / 1e3, text));
    }
    if (!length || length->mm < least_mm) {
        const std::string least = least_mm <= 0.0   ? "of zero or more"
                                  : least_mm < 0.01 ? "above zero"
                                                    : fmt::format("of {} mm or more", least_mm);
        throw UsageError(fmt::format("{} takes a length {}, not \"{}\"", option, least, text),
                         {"write 5, 5mm, 0.5cm, 0.2in or 14pt"});
    }
    return *length;
}

UsageError::UsageError(const Diagnostics& findings, std::string text)
    : std::runtime_error(one_line(findings)),
      in_file_(std::make_shared<const InFile>(InFile{findings, std::move(text)})) {}

bool MessageOptions::use_standard_output() const {
    return file == "-" || (file.empty() && format->for_machines);
}

void add_input_options(CLI::App& verb, Options& options) {
    verb.add_option("INPUT", options.inputs.names, "documents to read; \"-\" is standard input")
        ->required()
        ->type_name("");
    value(verb, "--from", "LANGUAGE", "the inputs' language, where a suffix does not tell", "Input",
          [&options](std::string_view text) {
              std::vector<std::string_view> known;
              for (const Language& row : language_table()) known.push_back(row.name);
              for (const Language& row : language_table()) {
                  if (row.name != text && (row.suffix.empty() || row.suffix.substr(1) != text)) continue;
                  options.inputs.language = row.name;
                  return;
              }
              throw UsageError(
                  fmt::format("--from takes a language ({}), not \"{}\"", fmt::join(known, ", "), text), {},
                  known);
          })
        ->configurable(false);
    verb.add_flag("--strict", options.compile.read.strict, "unknown markup is an error, not a warning")
        ->group("Input");
    add_drawing_options(verb, options);
}

void add_tree_options(CLI::App& verb, Options& options) {
    InputOptions& inputs = options.inputs;
    verb.get_option("INPUT")->description("documents, or directories of them; \"-\" is standard input");
    const auto add = [&verb](const std::string& name, const std::string& about,
                             std::vector<std::string>& patterns) {
        values(verb, name, "GLOB", about, "Directories", [name, &patterns](std::string_view text) {
            if (text.empty()) throw UsageError(name + " takes a pattern of file names, such as 'draft-*'");
            patterns.emplace_back(text);
        });
    };
    add("--include", "take the files that match this, not all designs. Repeatable", inputs.include);
    add("--exclude", "leave out files and directories that match this. Repeatable", inputs.exclude);
}

void add_message_options(CLI::App& verb, Options& options) {
    MessageOptions& messages = options.messages;
    std::vector<std::string_view> formats;
    for (const MessageFormat& row : message_format_table()) formats.push_back(row.name);
    value(verb, "--message-format", "FORMAT",
          fmt::format("{} (default), {} or {}", formats.front(),
                      fmt::join(formats.begin() + 1, formats.end() - 1, ", "), formats.back()),
          "Diagnostics", [&messages, formats](std::string_view text) {
              const MessageFormat* format = find_message_format(text);
              if (format == nullptr) {
                  throw UsageError(
                      fmt::format("--message-format takes {}, not \"{}\"", fmt::join(formats, ", "), text),
                      did_you_mean(text, formats), formats);
              }
              messages.format = format;
          });
    value(verb, "--diagnostics", "FILE", "write diagnostics to FILE", "Diagnostics",
          [&messages](std::string_view text) {
              if (text.empty()) throw UsageError("--diagnostics takes the name of a file");
              messages.file = text;
          })
        ->configurable(false);
    add_talk_options(verb, options);
}

void add_talk_options(CLI::App& verb, Options& options) {
    MessageOptions& messages = options.messages;
    const auto when = [](std::string_view option, std::string_view text) {
        return choose<When>(option, text,
                            {{"auto", When::automatic}, {"always", When::always}, {"never", When::never}});
    };
    value(verb, "--color", "WHEN", "auto (default), always or never; NO_COLOR is honoured", "Diagnostics",
          [&messages, when, edits = verb.get_name() == "edit"](std::string_view text) {
              try {
                  messages.color = when("--color", text);
              } catch (const UsageError& error) {
                  if (!edits) throw;
                  std::vector<std::string> hints = error.hints();
                  hints.push_back(fmt::format("the colour of an element is written color={}", text));
                  throw UsageError(error.what(), std::move(hints));
              }
          });
    value(verb, "--progress", "WHEN", "auto (default: on a terminal), always or never", "Diagnostics",
          [&messages, when](std::string_view text) { messages.progress = when("--progress", text); });
    CLI::Option* quiet =
        verb.add_flag("-q,--quiet", messages.quiet, "no remarks, no summary")->group("Diagnostics");
    verb.add_flag("-v,--verbose", messages.verbose, "say what was done")
        ->group("Diagnostics")
        ->excludes(quiet);
}

void add_policy_options(CLI::App& verb, Options& options) {
    add_codes(verb, "--deny", "make this diagnostic an error", options.policy.deny);
    add_codes(verb, "--allow", "drop this diagnostic, unless it is an error", options.policy.allow);
    verb.add_flag("--werror", options.policy.warnings_are_errors, "make all warnings errors")
        ->group("Diagnostics");
}

void add_judge_options(CLI::App& verb, Options& options) {
    JudgeOptions& judge = options.judge;
    value(verb, "--baseline", "FILE", "findings that stand in FILE are accepted; only new ones count",
          "Diagnostics", [&judge](std::string_view text) {
              if (text.empty() || text == "-") throw UsageError("--baseline takes the name of a file");
              judge.baseline = text;
          });
    verb.add_flag("--write-baseline", judge.write_baseline, "accept all findings: write them to the baseline")
        ->configurable(false)
        ->group("Diagnostics");
    verb.add_flag("--statistics", judge.statistics, "count the findings of each kind instead of telling them")
        ->group("Diagnostics");
}

void add_check_options(CLI::App& verb, Options& options) {
    value(
        verb, "--repair", "WHEN", "auto (default) mends what can be mended; never: it is an error", "Input",
        [&options](std::string_view text) {
            options.compile.check.repair = choose<bool>("--repair", text, {{"auto", true}, {"never", false}});
        });
    value(verb, "--horizon", "HEIGHT", "level the horizons of all pictures, this high above the open card",
          "Pattern", [&options](std::string_view text) {
              options.compile.assemble.horizon_mm = length_option("--horizon", text, 0.0).mm;
          });
    value(verb, "--tab-depth", "LENGTH", "depth of glue tabs (default 10mm)", "Pattern",
          [&options](std::string_view text) {
              options.compile.pattern.tab_depth = length_option("--tab-depth", text, 1e-3);
          });
}

void add_sheet_options(CLI::App& verb, Options& options) {
    LayoutOptions& layout = options.compile.layout;
    bool& given = options.sheet_given;
    value(verb, "--sheet", "SIZE", "auto (default), a name of \"popupc list sheets\", or WxH with mm or in",
          "Sheet", [&layout, &given](std::string_view text) {
              const std::optional<SheetChoice> sheet = parse_sheet(text);
              if (!sheet) {
                  std::vector<std::string_view> names{"auto"};
                  for (const Paper& paper : paper_table()) names.push_back(paper.name);
                  throw UsageError(
                      fmt::format("--sheet takes {}, or a size, not \"{}\"", fmt::join(names, ", "), text),
                      {"write a size as 300x200, 300x200mm or 12x8.5in"}, names);
              }
              layout.sheet = *sheet;
              given = true;
          });
    value(verb, "--paper-family", "FAMILY",
          "papers of --sheet auto: auto (default, by the unit), iso, us or any", "Sheet",
          [&layout](std::string_view text) {
              layout.papers = choose<PaperFamily>("--paper-family", text,
                                                  {{"auto", PaperFamily::automatic},
                                                   {"iso", PaperFamily::iso},
                                                   {"us", PaperFamily::us},
                                                   {"any", PaperFamily::any}});
          });
    value(verb, "--margin", "LENGTH", "free edge of the sheet (default 5mm)", "Sheet",
          [&layout, &given, &options](std::string_view text) {
              layout.margin = length_option("--margin", text, 0.0);
              given = true;
              options.margin_given = true;
          });
    value(verb, "--spacing", "LENGTH", "free space between pieces (default 2mm)", "Sheet",
          [&layout, &given](std::string_view text) {
              layout.spacing = length_option("--spacing", text, 0.0);
              given = true;
          });
    value(verb, "--scale", "FACTOR", "size of everything (default 1)", "Sheet",
          [&layout, &given](std::string_view text) {
              layout.scale = number_option("--scale", text, 0.001, 1000.0);
              given = true;
          });
    value(verb, "--copies", "N", "how often each input is wanted (default 1)", "Sheet",
          [&layout, &given](std::string_view text) {
              const double count = number_option("--copies", text, 1.0, 10000.0);
              layout.copies = static_cast<int>(count);
              if (layout.copies != count)
                  throw UsageError(fmt::format("--copies takes a whole number, not \"{}\"", text));
              given = true;
          });
}

void add_motion_options(CLI::App& verb, Options& options) {
    value(verb, "--angles", "ANGLES", "degrees, FIRST:LAST:STEP or a list A,B,C (default 0:180:5)", "Motion",
          [&options](std::string_view text) {
              auto angles = parse_angles(text);
              if (!angles) {
                  if (const double count = count_angles(text); count > kMostAngles) {
                      throw UsageError(fmt::format("--angles {} is {:.0f} angles; the most is {:.0f}", text,
                                                   count, kMostAngles),
                                       {"take a larger step"});
                  }
                  throw UsageError(fmt::format("--angles takes degrees from 0 to 180, not \"{}\"", text),
                                   {"write FIRST:LAST:STEP, such as 0:180:5, or a list, such as 0,45,90"});
              }
              options.compile.motion.angles = std::move(*angles);
          });
    value(verb, "--opens", "ANGLE", "how far cards open, at most 180 degrees (default: as the design says)",
          "Motion", [&options](std::string_view text) {
              options.compile.opens = Angle::degrees(number_option("--opens", text, 1.0, 180.0));
          });
    value(verb, "--solver", "NAME",
          "closed-form (default), or iterative: Hendrix's own, slow, for comparison", "Motion",
          [&options](std::string_view text) {
              options.compile.motion.solver = choose<Solver>(
                  "--solver", text, {{"closed-form", Solver::closed_form}, {"iterative", Solver::iterative}});
          });
    value(verb, "--clearance", "LENGTH", "also name plates that come closer to each other than this",
          "Motion", [&options](std::string_view text) {
              options.compile.motion.clearance_mm = length_option("--clearance", text, 1e-3).mm;
          });
    value(verb, "--paper-thickness", "LENGTH", "thickness of the paper, which gives that of the closed card",
          "Motion", [&options](std::string_view text) {
              options.compile.motion.paper_mm = length_option("--paper-thickness", text, 1e-3).mm;
              options.compile.output.still.paper_mm = options.compile.motion.paper_mm;
          });
}

void add_animation_options(CLI::App& verb, Options& options) {
    const auto number = [&verb](const std::string& name, const std::string& about, double& target,
                                double least) {
        verb.add_option_function<std::string>(
                name,
                [name, &target, least](const std::string& text) {
                    target = number_option(name, text, least, 1000.0);
                },
                about)
            ->type_name("N")
            ->group("Motion");
    };
    number("--fps", "at least so many keys a second in the animation", options.compile.output.fps, 0.001);
    number("--duration", "length of the animation in seconds (default 4)", options.compile.output.duration_s,
           0.001);
}

void check_motion_options(const Options& options) {
    const MotionOptions& motion = options.compile.motion;
    if (motion.solver != Solver::iterative) return;
    for (const auto& [given, name] : {std::pair(motion.clearance_mm.has_value(), "--clearance"),
                                      std::pair(motion.paper_mm.has_value(), "--paper-thickness")}) {
        if (!given) continue;
        throw UsageError(fmt::format("{} asks for what --solver iterative does not look at", name),
                         {"leave --solver out: the closed form is examined"});
    }
}

void add_config_options(CLI::App& verb, Options& options) {
    ConfigOptions& config = options.config;
    CLI::Option* off = verb.add_flag("--no-config", config.off, "take no settings from a popupc.toml")
                           ->configurable(false)
                           ->group("Configuration");
    value(verb, "--config", "FILE", "take settings from FILE (default: popupc.toml, upward from the input)",
          "Configuration",
          [&config](std::string_view text) {
              if (text.empty()) throw UsageError("--config takes the name of a file");
              config.file = text;
          })
        ->configurable(false)
        ->excludes(off);
    add_print_config_option(verb, options);
}

void add_print_config_option(CLI::App& verb, Options& options) {
    verb.add_flag("--print-config", options.config.print,
                  "print all settings and where they come from; do nothing")
        ->configurable(false)
        ->group("Configuration");
}

void add_thread_option(CLI::App& verb, Options& options) {
    options.compile.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    // Under make it is make that shares out threads, and pages do not ask it for so short a while.
    options.compile.output.threads = std::getenv("MAKEFLAGS") == nullptr ? options.compile.threads : 1;
    value(verb, "-j,--jobs", "N", "how much is done at a time (default: one a processor, or as make allows)",
          "Other", [&options](std::string_view text) {
              const double count = number_option("-j", text, 1.0, 1024.0);
              options.compile.threads = static_cast<int>(count);
              options.compile.output.threads = options.compile.threads;
              options.jobs_given = true;
              if (options.compile.threads != count) {
                  throw UsageError(fmt::format("-j takes a whole number, not \"{}\"", text));
              }
          });
}

}  // namespace popup::cli
