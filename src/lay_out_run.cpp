// The patterns of a run, laid out together.
#include <utility>

#include "fabrication/kerf.h"
#include "popup/compile.h"

namespace popup {

void lay_out_run(Compilation& run, const CompileOptions& options) {
    std::vector<DesignPattern> patterns;
    for (const CompiledDesign& one : run.designs) {
        if (one.pattern) patterns.push_back({one.source.name, one.stem, *one.pattern});
    }
    if (patterns.empty() || run.has_errors()) return;
    LayoutOptions layout = options.layout;
    if (const auto& first = run.designs.front().assembly; first && layout.papers == PaperFamily::automatic)
        layout.papers = papers_for(first->units);
    layout.nesting.threads = options.threads;
    layout.nesting.may_start_thread = options.may_start_thread;
    layout.nesting.thread_ended = options.thread_ended;
    run.layout = lay_out(std::move(patterns), layout, run.run_diagnostics);
    const KerfWidths kerf = KerfWidths::of(options.output.profile);
    if (run.layout && !apply_kerf(*run.layout, kerf, layout.spacing.mm, run.run_diagnostics))
        run.layout.reset();
}

}  // namespace popup
