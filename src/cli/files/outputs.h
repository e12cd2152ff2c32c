// The outputs of a build: what they are, whether they can be, and their bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "popup/compile.h"
#include "popup/output.h"

namespace popup::cli {

struct PlannedOutput {
    std::string path;
    const Format* format = nullptr;
};

// UsageError when `name`, a suffix with or without its full stop, is no format's.
void check_format_name(const std::string& name);

// Finds the format of every output. UsageError on an unknown one, on two users of standard output, on an
// output, diagnostics and the dependency file among them, that is named twice or is an input, on one document
// for several inputs, and when an output needs what an input does not have: parts that do not move have no
// model.
std::vector<PlannedOutput> plan_outputs(const Options& options);

// True for "-" and for the other names of standard output.
bool is_standard_output(const std::string& path);

// True when both names are the same file now, or would be once written.
bool same_place(const std::string& a, const std::string& b);

// True when writing `output` would replace the file `input`.
bool overwrites(const std::string& output, const std::string& input);

// The last stage that these outputs, and --emit, need.
Stage needed_stage(const std::vector<PlannedOutput>& outputs, const std::optional<Emit>& emit);

// JSON documents, one an input, as --emit prints them: one as it is, several as a list.
std::string json_list(std::vector<std::string> documents);

// True when the findings say that an output could not be written, rather than that a design is wrong.
bool output_refused(const Diagnostics& diagnostics);

// Every file of the run with its bytes, the --emit document included; sheets after the first as "card-2.svg".
// nullopt when a writer failed; why stands in the run's diagnostics. UsageError when standard input turns out
// not to have what an output needs.
// Precondition: no design has errors.
std::optional<std::vector<PendingFile>> make_files(const std::vector<PlannedOutput>& outputs,
                                                   const Options& options, Compilation& compilation);

}  // namespace popup::cli
