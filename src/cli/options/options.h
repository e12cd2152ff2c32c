// What the command line asks for, and how it is read. Options that verbs share are declared here once.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "batch/manifest.h"
#include "cli/options/dependency_options.h"
#include "cli/options/program_options.h"
#include "findings/message_formats.h"
#include "popup/compile.h"
#include "popup/diagnostics.h"
#include "popup/edit.h"
#include "popup/trace.h"

namespace CLI {
class App;
}

namespace popup::cli {

// The three exit codes; CLI.md's contract with makefiles.
enum ExitCode : int { exit_done = 0, exit_findings = 1, exit_unusable = 2 };

// Wrong usage: what is wrong, and what would be right. Thrown while options are read, caught by main().
class UsageError : public std::runtime_error {
 public:
    // `choices` are the words that would have been taken, where the option has a list of them: completions
    // ask an option for what it cannot know, and take them from here.
    explicit UsageError(const std::string& message, std::vector<std::string> hints = {},
                        std::vector<std::string_view> choices = {})
        : std::runtime_error(message), hints_(std::move(hints)), choices_(choices.begin(), choices.end()) {}
    // What is wrong stands in a configuration or response file, of which `text` is the whole. Precondition:
    // `findings` has errors. what() is the first of them on one line, with its place.
    UsageError(const Diagnostics& findings, std::string text);

    [[nodiscard]] const std::vector<std::string>& hints() const { return hints_; }
    [[nodiscard]] const std::vector<std::string>& choices() const { return choices_; }
    struct InFile {
        Diagnostics findings;
        std::string text;
    };
    // Null where the command line or the environment is wrong.
    [[nodiscard]] const InFile* in_file() const { return in_file_.get(); }
    // The word of the command line that is wrong: the value of an option, whose names are as it is declared
    // ("-o,--output"), or a word that nothing takes, without an option. Both empty: it is not known.
    struct Culprit {
        std::string option;
        std::string value;
    };
    [[nodiscard]] const Culprit& culprit() const { return culprit_; }
    UsageError& blame(std::string option, std::string value) {
        culprit_ = {std::move(option), std::move(value)};
        return *this;
    }

 private:
    std::vector<std::string> hints_;
    std::vector<std::string> choices_;
    std::shared_ptr<const InFile> in_file_;  // shared, because exceptions are copied
    Culprit culprit_;
};

enum class When { automatic, always, never };

// How findings are told.
struct MessageOptions {
    const MessageFormat* format = message_format_table().data();  // never null
    std::string file;  // --diagnostics; empty: standard error, for machine formats standard output
    When color = When::automatic;
    When progress = When::automatic;
    bool quiet = false;
    bool verbose = false;
    // When the run began; the summary names how long it took.
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
    // Machine formats without a file go to standard output, which then has its one user.
    [[nodiscard]] bool use_standard_output() const;
};

struct InputOptions {
    std::vector<std::string> names;
    std::string language;                       // --from; empty: by suffix
    std::vector<std::string> include, exclude;  // of what is found in directories
};

// What --emit prints: a stage, or what a program drew before anything was made of it.
enum class Emit { design, assembly, motion, pattern, layout, trail };

struct BuildOptions {
    std::vector<std::string> outputs;
    std::string format;  // --to, for standard output and suffixes that say nothing
    std::optional<Emit> emit;
    // Called with all files before any is written; throws a UsageError where one may not be. Empty: nothing.
    std::function<void(const std::vector<PendingFile>&)> before_writing;
    bool if_changed = false;
    bool watch = false;
    std::string profile_file;                // empty: a built-in profile
    std::optional<FoldStyle> folds;          // instead of the profile's
    std::optional<AwayFolds> away_folds;     // likewise
    std::optional<Perforation> perforation;  // likewise
    std::optional<Marks> marks;              // likewise
    std::optional<MarksOn> marks_on;         // likewise
    std::optional<double> joint_mm;          // likewise
    std::vector<std::string> kerfs;          // as given, each good in itself
    std::vector<std::string> speeds;         // likewise
    std::optional<Length> tile_margin;       // none: as TileOptions has it
    DependencyOptions dependencies;
};

// A variable that is named like those of options, and sets none.
struct UnknownVariable {
    std::string name;
    std::string why;  // "sets no option; did you mean POPUPC_SHEET?"
};

struct FixOptions {
    bool diff = false;
    bool in_place = false;
    bool collisions = false;  // move elements that collide
    std::string output;       // empty: standard output
};

struct EditVerbOptions {
    FixOptions output;
    std::string document;
    std::string file;                // -f; empty: the edit is on the command line
    std::vector<std::string> words;  // the edit
    std::string refinement;          // of a drawing; empty: none
    bool force = false;
};

struct FmtVerbOptions {
    FixOptions output;
    std::vector<std::string> documents;
};

struct NewVerbOptions {
    std::string output;
    std::optional<std::pair<double, double>> size;  // mm
    std::string unit;                               // in which the size is given; empty: none is named
    std::vector<std::string> with;
    std::string pattern;  // the template; empty: none
    bool force = false;
};

struct ShowVerbOptions {
    std::string document;
    std::string id;
    std::string refinement;  // of a drawing; empty: none
    bool all = false;
    bool json = false;
};

struct SuggestVerbOptions {
    std::string drawing;
    std::string refinement;               // --refinement; empty: none
    std::string accept;                   // --accept; empty: nothing
    std::optional<double> near_mm;        // none: as SuggestOptions has it
    std::optional<double> most_turn_deg;  // none: as AcceptOptions has it
    bool alone = false;
    bool json = false;
};

// What `check` makes of its findings.
struct JudgeOptions {
    std::string baseline;  // --baseline; empty: none
    bool write_baseline = false;
    bool statistics = false;
};

struct ViewOptions {
    int port = 0;  // 0: one that is free
    bool no_browser = false;
    std::chrono::milliseconds idle = std::chrono::hours(1);  // until nobody is thought to look; 0: never
};

struct ListOptions {
    std::string what;
    bool json = false;
};

// "2/5": the second of five.
struct Shard {
    int number = 1;  // from 1 to `count`
    int count = 1;
};

struct BatchOptions {
    std::string manifest;  // "-": standard input
    std::optional<ManifestForm> form;
    std::optional<Shard> shard;
    std::string results;              // empty: beside the manifest
    std::vector<std::string> common;  // words that stand before each job's options
    bool dry_run = false;
};

struct GalleryOptions {
    std::string directory;  // -o
    std::string title;      // empty: as the library's directory is called
    bool dry_run = false;
};

struct MergeOptions {
    std::string manifest;
    std::vector<std::string> results;  // empty: those beside the manifest
    std::string output;                // empty: none
    std::string missing;               // likewise
};

struct TraceVerbOptions {
    std::string picture;  // "-": standard input
    std::string output;   // empty: standard output
    MaskOptions mask;
    TraceOptions trace;
    double dpi = 0.0;  // of these three at most one is not 0
    double width_mm = 0.0;
    double height_mm = 0.0;
};

// Where settings come from that are not on the command line.
struct ConfigOptions {
    std::string file;    // --config; empty: popupc.toml, found upward from the inputs
    bool off = false;    // --no-config
    bool print = false;  // --print-config
};

// Everything of one run. A verb fills what it offers.
struct Options {
    Options() {
        compile.fitting_size = fitting_size;
        compile.clearing_move = clearing_move;
        compile.move_command = move_command;
        compile.move_holds = move_holds;
    }
    std::vector<std::string> arguments;  // all of these come from
    std::set<std::string> given;         // keys of the options that stand on the command line itself
    InputOptions inputs;
    MessageOptions messages;
    DiagnosticPolicy policy;
    CompileOptions compile;
    bool jobs_given = false;  // -j: make's jobserver is not asked
    // Any option about the sheet, on the command line or in the verb's own table of a configuration.
    bool sheet_given = false;
    bool margin_given = false;
    BuildOptions build;
    PrintOptions print;
    FixOptions fix;
    ViewOptions view;
    EditVerbOptions edit;
    ShowVerbOptions show;
    SuggestVerbOptions suggest;
    FmtVerbOptions fmt;
    NewVerbOptions made;
    std::string topic;  // of `explain`, `completions` and `manual`: the code, the shell, the verb
    ListOptions list;
    JudgeOptions judge;
    BatchOptions batch;
    GalleryOptions gallery;
    MergeOptions merge;
    TraceVerbOptions trace;
    ConfigOptions config;
    // Every option that has a value, by its key, whatever it comes from: command line, environment or
    // configuration. Of a flag the value is "true" or "false".
    std::map<std::string, std::vector<std::string>> settings;
    // The response files and the configuration by which the other options came to be: inputs of the run.
    std::vector<std::string> settings_files;
    // POPUPC_* of the environment that set nothing.
    std::vector<UnknownVariable> unknown_variables;
};

// Each adds one group of options to a verb; values land in `options`, which must outlive the parsing.
void add_input_options(CLI::App& verb, Options& options);
// Of these, those about drawings.
void add_drawing_options(CLI::App& verb, Options& options);
void add_tree_options(CLI::App& verb, Options& options);
void add_message_options(CLI::App& verb, Options& options);
// Of these, those about colour, progress and how much is said.
void add_talk_options(CLI::App& verb, Options& options);
void add_policy_options(CLI::App& verb, Options& options);
void add_judge_options(CLI::App& verb, Options& options);
void add_check_options(CLI::App& verb, Options& options);
void add_sheet_options(CLI::App& verb, Options& options);
void add_nest_options(CLI::App& verb, Options& options);
void add_motion_options(CLI::App& verb, Options& options);
// How animations run, in the same group.
void add_animation_options(CLI::App& verb, Options& options);
void add_thread_option(CLI::App& verb, Options& options);
void add_config_options(CLI::App& verb, Options& options);
// Alone where --config and --no-config would not say whose settings they mean: a batch's, or those of its
// builds.
void add_print_config_option(CLI::App& verb, Options& options);
// Where a changed document goes: --diff, --in-place or -o, of which one may be given. `in_place` tells of the
// second.
void add_document_output_options(CLI::App& verb, FixOptions& output, const std::string& in_place);

// A UsageError when the options about the motion, once all are read, do not go together.
void check_motion_options(const Options& options);

// `text` as a finite decimal number, whole text, whatever the locale.
std::optional<double> parse_number(std::string_view text);
// A number with an optional unit (mm, cm, in, pt); without one millimetres.
std::optional<Length> parse_length(std::string_view text);
// "[PIECE=]TURNS" of --rotate and "PIECE[#COPY]=X,Y[,DEGREES][@SHEET]" of --lock, as rules of a layout; the
// piece's name is empty where none is given. Copies and sheets count from 1 in the text. nullopt when they
// are not that.
std::optional<PieceRule> parse_turn_rule(std::string_view text);
std::optional<PieceRule> parse_lock_rule(std::string_view text);
// "FIRST:LAST:STEP" or "A,B,C", in degrees, each in [0, 180]; sorted, without doubles. nullopt when it is
// neither.
std::optional<std::vector<Angle>> parse_angles(std::string_view text);
// How many angles "FIRST:LAST:STEP" asks for, of which parse_angles() takes at most kMostAngles; 0 for what
// is no such range.
inline constexpr double kMostAngles = 100000;
double count_angles(std::string_view text);

// "90s", "15m", "1.5h", or 0; at most 1000 hours. nullopt when it is not that.
std::optional<std::chrono::milliseconds> parse_time(std::string_view text);

// The length or number of `text` for `option`, at least `least_mm` and at most 1 km, or within [least, most];
// else a UsageError that says what was wanted.
Length length_option(std::string_view option, std::string_view text, double least_mm);
double number_option(std::string_view option, std::string_view text, double least, double most);

// "did you mean …" for `word`; empty when nothing is like it.
std::vector<std::string> did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace popup::cli
