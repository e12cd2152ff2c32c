// The whole compiler as one call: sources in, stages' values out, nothing written.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/assembly.h"
#include "popup/check.h"
#include "popup/design.h"
#include "popup/files.h"
#include "popup/language.h"
#include "popup/layout.h"
#include "popup/motion.h"
#include "popup/output.h"
#include "popup/pattern.h"

namespace popup {

// The program's version, "0.1.0".
std::string_view version();

// How far to go. Later stages are skipped.
enum class Stage { design, check, assembly, motion, pattern, layout };

struct CompiledDesign;

struct CompileOptions {
    ReadOptions read;
    CheckOptions check;
    AssembleOptions assemble;
    FoldOptions fold;
    MotionOptions motion;
    PatternOptions pattern;
    LayoutOptions layout;
    OutputOptions output;  // the kerf of its profile is applied to the layout
    // How far cards open, above 0° and at most 180°: where their sweep ends, whatever the design says. None:
    // as far as the design says.
    std::optional<Angle> opens = {};
    // Asked of an element that sticks out of the closed card, by so many mm: a size that was tried and keeps
    // it inside, as the words of a hint; fitting_size() of popup/edit.h is such a function. It is given the
    // design, which has been assembled, and these options. Called by any thread. Empty: no sizes are told.
    std::function<std::optional<std::string>(const CompiledDesign&, const CompileOptions&,
                                             const std::string& element, double by_mm)>
        fitting_size = {};
    // Asked of an element of which a tab is glued where one of an earlier element is, as PatternOptions has
    // it; clearing_move() of popup/edit.h is such a function. It is given what fitting_size is given. Empty:
    // no moves are told.
    std::function<std::optional<std::string>(const CompiledDesign&, const CompileOptions&,
                                             const std::string& element)>
        clearing_move = {};
    // Asked of a move that a hint of the motion tells, as MotionOptions has it; move_command() of
    // popup/edit.h is such a function. It is given what fitting_size is given. Empty: moves are told without
    // it.
    std::function<std::optional<std::string>(const CompiledDesign&, const CompileOptions&,
                                             const std::string& element, Vec2 by)>
        move_command = {};
    // Asked of a move that was tried in the motion, as MotionOptions has it; move_holds() of popup/edit.h is
    // such a function. It is given what fitting_size is given. Empty: all that were tried are told.
    std::function<bool(const CompiledDesign&, const CompileOptions&, const std::string& element, Vec2 by)>
        move_holds = {};
    Stage until = Stage::layout;
    int threads = 1;  // ≥ 1, of the layout too; results do not depend on it
    // Asked before a thread is started beside the caller's, when there is work for it; it answers at once.
    // May be empty: up to `threads` are started. Where the answer is no, it is asked again before the next
    // design. Called by any thread, several at a time.
    std::function<bool()> may_start_thread = {};
    // After each yes, once: that thread has no more work. May be empty. Called by any thread, and not any
    // more when compile() returns or throws.
    std::function<void()> thread_ended = {};
    // Told how many designs are done, one call at a time but from any thread, and at the end that all are.
    // When designs are finished faster than it returns, it is not told of each. May be empty.
    std::function<void(std::size_t done, std::size_t total)> progress;
};

// Everything known of one input. A stage that failed, or was not asked for, is empty. An input that describes
// parts has an assembly without a design before it, and no motion, for nothing of it moves.
struct CompiledDesign {
    Source source;
    std::string stem;  // unique in the run
    Diagnostics diagnostics;
    std::string printed;                     // as in Reading
    std::vector<std::string> further_files;  // likewise: Reading::files
    std::vector<std::string> missing_files;  // likewise: Reading::missing
    std::optional<Design> design;
    std::optional<CreasePattern> creases;
    std::optional<CheckedDesign> checked;
    std::optional<Assembly> assembly;
    std::optional<Motion> motion;
    std::optional<Pattern> pattern;
};

struct Compilation {
    std::vector<CompiledDesign> designs;  // in argument order
    std::optional<Layout> layout;         // of all of them; empty when any design has errors
    Diagnostics run_diagnostics;          // what concerns the run, not one design (layout, outputs)
    [[nodiscard]] bool has_errors() const;
    [[nodiscard]] bool has_findings() const;
};

// Runs the stages on every source, in parallel under options.threads, then lays all patterns out together.
// A design's stages end with the first that gives nothing; warnings that the policy made errors do not stop
// it. Never throws for bad input; findings are in the result. What a function of the options throws goes on
// to the caller, when all threads have ended.
Compilation compile(std::vector<Source> sources, const CompileOptions& options,
                    const DiagnosticPolicy& policy);

// Goes on with a design that was compiled up to Stage::check: as compile() would have, but with nothing done
// twice. Does nothing to one that has no checked design. Its source and the options, but for `until`, are
// those that it was compiled with.
void compile_further(CompiledDesign& one, const CompileOptions& options);

// The same up to Stage::pattern for callers that want the findings alone, such as an editor: no pattern is
// made, and judge_tabs() says what make_pattern() would have found. options.until is not looked at.
void find_further(CompiledDesign& one, const CompileOptions& options);

// The last stage alone, of designs that were compiled as far as their patterns with the same options: lays
// them all out together. Does nothing where a design has errors, or there are no patterns; what it finds is
// the run's. compile() is that and this.
void lay_out_run(Compilation& run, const CompileOptions& options);

// As compile(), but without the layout, for more designs than the memory can hold the values of: each source
// is asked for when its turn comes, each design handed over when it is done, and nothing else is kept. Both
// functions are called once for each number below `count`, from any of the threads, in no certain order, and
// must not throw. A source of nullopt is left out, and `done` is not called for it. Stems are not made
// unique.
void compile_each(std::size_t count, const std::function<std::optional<Source>(std::size_t)>& source,
                  const std::function<void(std::size_t, CompiledDesign&&)>& done,
                  const CompileOptions& options, const DiagnosticPolicy& policy);

}  // namespace popup
