// All files of a run: planned by their names, made from a compilation, and written together or not at all.
//
//     Diagnostics told;
//     const auto source = read_source("castle.xml", told);
//     const auto plan = plan_outputs({.outputs = {"castle.svg", "castle.pdf", "castle.glb"},
//                                     .inputs = {"castle.xml"}}, told);
//     if (!source || !plan) return;  // `told` says why
//     CompileOptions options;
//     options.output.profile = *find_profile("k40");
//     fit_layout(options);
//     Compilation run = compile({*source}, options, {});
//     const auto written = write_files(*plan, options.output, run);
//
// `written` has the names, "castle-2.svg" of a second sheet among them. It is nullopt, and nothing is
// written, when a design has errors or an output cannot be made: the findings of the designs and of the run
// say why.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "popup/compile.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/output.h"

namespace popup {

// What a run shall write.
struct OutputRequest {
    // A file of the run that its caller writes beside the outputs.
    struct Other {
        std::string path;
        std::string name;  // as a message calls it that standard output has two users; empty: it is not one
    };
    std::vector<std::string> outputs = {};  // a suffix names the format; "-" is standard output
    std::string format = {};  // of standard output, and where a suffix says nothing; empty: there is none
    std::vector<std::string> inputs = {};  // names of the sources: none is written over
    std::string language = {};             // as in ReadOptions: of the inputs
    DrawnAs as = DrawnAs::parts;           // as in DrawingOptions: of the inputs
    std::vector<Other> others = {};        // no two outputs or others are the same file, and none is an input
    std::vector<std::string> streams = {};  // what else goes to standard output, as a message calls it
};

struct PlannedOutput {
    std::string path;
    const Format* format = nullptr;  // never null in a plan
};

struct OutputPlan {
    std::vector<PlannedOutput> outputs;  // in the order of the request
    std::vector<std::string> inputs;
};

// Makes the layout suit the outputs: no sheet is larger than the bed of the profile's machine, and the margin
// has room for registration marks and the bar. Sets options.layout.bed.
void fit_layout(CompileOptions& options);

// Finds the format of each output. Nullopt with one `unwritable-output` error: a suffix names no format, two
// outputs are one file, one is an input, standard output has two users, a document is to be made of several
// inputs, or an input is known by its name not to have what an output needs. Looks at files, and opens none.
std::optional<OutputPlan> plan_outputs(const OutputRequest& request, Diagnostics& diagnostics);

// True when every input has what the outputs need. Else an `unwritable-output` error is added: parts that do
// not move have no animation and no document, and a model only where their language says how they stand.
bool can_be_made(const OutputPlan& plan, const Compilation& run, Diagnostics& diagnostics);

// The designs of a run as scenes, which point into it. Precondition: each has an assembly.
std::vector<SceneCard> scene_of(const Compilation& run);

// What can be made of flat parts, in words for a hint.
std::string outputs_of_parts(bool has_model);

// Adds an error to each design that gives nothing to write: a program that only defines functions, and with
// FoldOptions::flat a sheet of which no flat state was found.
void refuse_definitions(Compilation& run);

// What of a run's files needs no sheets, and is made by threads of their own: models, and pages as far as the
// rows of their formats begin them. Equal formats share what is begun.
//
//     Compilation run = compile({*source}, options, {});  // with options.until == Stage::pattern
//     const BegunFiles begun = begin_files(*plan, options.output, run);
//     lay_out_run(run, options);
//     const auto files = make_files(*plan, options.output, run, begun);
struct BegunModel;
struct BegunFiles {
    std::map<const Format*, std::shared_ptr<BegunModel>> models = {};
    std::map<const Format*, std::shared_ptr<BegunPage>> pages = {};
};
// None where options.threads is 1, where a design has errors, or where make_files() would refuse one. What is
// returned must not outlive the designs of the run, nor may these change before.
BegunFiles begin_files(const OutputPlan& plan, const OutputOptions& options, const Compilation& run);

// Makes every file of the plan, and writes none. Sheets after the first are "card-2.svg", what is printed of
// a sheet and what is cut "card-print.svg" and "card-cut.svg"; reports come last and name the others.
// Findings on the profile and on single outputs are added to the run's. Nullopt when a design has errors,
// there is no layout, or a writer failed; then the run or a design has an error that says why.
// Precondition: `run` was compiled with the same output options, and files were begun with them; `begun` is
// used once.
std::optional<std::vector<PendingFile>> make_files(const OutputPlan& plan, const OutputOptions& options,
                                                   Compilation& run, const BegunFiles& begun = {});

// True when no file replaces an input, or what a program has loaded. The plan could not know: names of
// further sheets, and what programs load, are known only now. Else an `unwritable-output` error names the
// first that would be lost.
bool spares_inputs(const OutputPlan& plan, const std::vector<PendingFile>& files, const Compilation& run,
                   Diagnostics& diagnostics);
// The same of one output, and of the files that programs have loaded.
bool spares_loaded(const std::string& output, const std::vector<std::string>& loaded,
                   Diagnostics& diagnostics);

// Makes all files and writes them by write_all(), which see for `keep_identical`. The names of all files, in
// the order in which they were made. Nullopt when nothing was written; the errors are those of make_files(),
// spares_inputs() and write_all(), in the run's diagnostics. Precondition as above.
std::optional<std::vector<std::string>> write_files(const OutputPlan& plan, const OutputOptions& options,
                                                    Compilation& run, bool keep_identical = false);

// True when the findings say that an output could not be made or written, rather than that a design is wrong.
bool output_refused(const Diagnostics& diagnostics);

}  // namespace popup
