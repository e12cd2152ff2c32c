#include "popup/compile.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "folded/carton/ring.h"
#include "popup/made_size.h"
#include "run/crew.h"
#include "run/unique_stems.h"
#include "run/unused_allowances.h"

namespace popup {
namespace {
// The stages of one design, in order, up to its check; assemblies enter there. False: they end here.
bool run_first_stages(CompiledDesign& one, const CompileOptions& options) {
    Reading reading = read_source_text(one.source, options.read, one.diagnostics);
    one.printed = std::move(reading.printed);
    one.further_files = std::move(reading.files);
    one.missing_files = std::move(reading.missing);
    one.design = std::move(reading.design);
    one.creases = std::move(reading.creases);
    one.assembly = std::move(reading.assembly);
    if (one.assembly) {
        if (one.assembly->file.empty()) one.assembly->file = one.source.name;
        one.diagnostics.set_places_file(one.assembly->file);
    } else if (one.creases && options.until >= Stage::assembly) {
        one.assembly = fold_sheet(*one.creases, options.fold, one.diagnostics);
    } else if (one.design) {
        one.design->stem = one.stem;
        if (options.until == Stage::design) return false;
        one.checked = check(*one.design, options.check, one.diagnostics);
        if (!one.checked || options.until == Stage::check) return false;
    }
    return true;
}

// Of a drawing that collides as it is folded, or stays open, how far its folds may be meant to go.
void tell_what_closes(CompiledDesign& one, const CompileOptions& options) {
    if (!one.motion->examination || !find_language(one.source, options.read.language)->drawn) return;
    const bool collides = !one.motion->examination->contacts.empty();
    MotionOptions motion = options.motion;
    motion.memory = nullptr;
    const auto simulated = [&](Assembly& sheet, Diagnostics& found) {
        return simulate_sheet(sheet, motion, found).has_value();
    };
    folded::tell_open_ring(*one.creases, options.fold, collides, simulated, one.diagnostics);
}

// Whether a pattern is made, or only what it would say is found.
enum class Draw { yes, no };

// False: a stage that finds something was not asked for, or not reached.
bool run_last_stages(CompiledDesign& one, const CompileOptions& options, Draw draw) {
    if (one.checked) one.assembly = assemble(*one.checked, options.assemble, one.diagnostics);
    if (one.assembly) one.assembly->stem = one.stem;
    if (one.assembly && options.opens && !open_to(*one.assembly, *options.opens, one.diagnostics))
        return false;
    if (one.assembly && one.checked) level_horizons(*one.assembly, one.diagnostics);
    if (one.assembly && one.creases && options.until == Stage::assembly)
        order_folds(*one.assembly, options.motion, one.diagnostics);
    if (!one.assembly || options.until <= Stage::assembly) return false;
    const auto bound = [&](const auto& f) { return std::bind_front(f, std::cref(one), std::cref(options)); };
    if (moves(*one.assembly)) {
        MotionOptions motion = options.motion;
        if (options.fitting_size) motion.fitting_size = bound(options.fitting_size);
        if (options.move_holds) motion.move_holds = bound(options.move_holds);
        if (options.move_command) motion.move_command = bound(options.move_command);
        one.motion = one.creases ? simulate_sheet(*one.assembly, motion, one.diagnostics)
                                 : simulate(*one.assembly, motion, one.diagnostics);
        if (one.creases && one.motion) tell_what_closes(one, options);
    }
    if (options.until == Stage::motion || (moves(*one.assembly) && !one.motion)) return false;
    PatternOptions pattern = options.pattern;
    if (options.clearing_move) pattern.clearing_move = bound(options.clearing_move);
    if (draw == Draw::no) judge_tabs(*one.assembly, pattern, one.diagnostics);
    if (draw == Draw::yes) one.pattern = make_pattern(*one.assembly, pattern, one.diagnostics);
    judge_made_size(*one.assembly, pattern, options.layout.scale, one.diagnostics);
    return true;
}

// What is said once no further stage will say anything. `whole`: all that find something have run.
void conclude(CompiledDesign& one, const CompileOptions& options, bool whole) {
    one.diagnostics.apply_allowances();
    // What has not been looked for cannot be missed.
    if (!whole || (one.motion && !one.motion->examination) || one.diagnostics.has_errors_as_given()) return;
    using Codes = std::set<std::string_view>;
    tell_unused_allowances(one.diagnostics, options.motion.clearance_mm ? Codes{} : Codes{"clearance-low"});
}

void compile_one(CompiledDesign& one, const CompileOptions& options) {
    const bool whole = run_first_stages(one, options) && run_last_stages(one, options, Draw::yes);
    conclude(one, options, whole);
}

// Designs share nothing, so any thread takes the next one.
CrewOptions crew_of(const CompileOptions& options) {
    return {static_cast<std::size_t>(std::max(options.threads, 1)), options.may_start_thread,
            options.thread_ended, options.progress};
}

}  // namespace

Compilation compile(std::vector<Source> sources, const CompileOptions& options,
                    const DiagnosticPolicy& policy) {
    Compilation run;
    run.run_diagnostics = Diagnostics({}, policy);
    run.designs.resize(sources.size());
    std::vector<std::string> stems;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        stems.push_back(sources[i].stem());
        run.designs[i].diagnostics = Diagnostics(sources[i].name, policy);
        run.designs[i].source = std::move(sources[i]);
    }
    stems = unique_stems(std::move(stems));
    for (std::size_t i = 0; i < stems.size(); ++i) run.designs[i].stem = std::move(stems[i]);
    share_work(run.designs.size(), crew_of(options),
               [&](std::size_t i) { compile_one(run.designs[i], options); });
    if (options.until == Stage::layout) lay_out_run(run, options);
    return run;
}

void compile_further(CompiledDesign& one, const CompileOptions& options) {
    const bool further = one.checked && options.until > Stage::check;
    conclude(one, options, further && run_last_stages(one, options, Draw::yes));
}

void find_further(CompiledDesign& one, const CompileOptions& options) {
    CompileOptions all = options;
    all.until = Stage::pattern;
    conclude(one, options, one.checked && run_last_stages(one, all, Draw::no));
}

void compile_each(std::size_t count, const std::function<std::optional<Source>(std::size_t)>& source,
                  const std::function<void(std::size_t, CompiledDesign&&)>& done,
                  const CompileOptions& options, const DiagnosticPolicy& policy) {
    share_work(count, crew_of(options), [&](std::size_t i) {
        std::optional<Source> text = source(i);
        if (!text) return;
        CompiledDesign one;
        one.diagnostics = Diagnostics(text->name, policy);
        one.source = std::move(*text);
        one.stem = one.source.stem();
        compile_one(one, options);
        done(i, std::move(one));
    });
}

}  // namespace popup
