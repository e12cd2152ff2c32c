// The outputs of a build as the command line asks for them: planned, and made with what --emit prints.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.h"
#include "popup/compile.h"
#include "popup/write.h"

namespace popup::cli {

// UsageError when `name`, a suffix with or without its full stop, is no format's.
void check_format_name(const std::string& name);

// UsageError when a file that a verb writes a document into is named as something else.
void check_document_name(const std::string& name, std::string_view verb);

// Throws the first of the findings as a UsageError: what the library found is how the program was called.
// Precondition: there is one.
[[noreturn]] void refuse_usage(const Diagnostics& told);

// The outputs as plan_outputs() has them, the diagnostics, the dependency file and what programs print
// counted among the files that must not be the same. UsageError where they cannot be, and when an input is
// known not to have what --emit asks for.
OutputPlan plan_of(const Options& options);

// For verbs that need no output: UsageError where two files that are written beside outputs are the same, or
// one is an input.
void keep_apart(const Options& options);

// Takes away what runs that were killed have left in the directories of these files; an empty name has none.
void clear_litter(const std::vector<std::string>& files);

// The last stage that the outputs, and --emit, need.
Stage needed_stage(const OutputPlan& plan, const std::optional<Emit>& emit);

// JSON documents, one an input, as --emit prints them: one as it is, several as a list.
std::string json_list(std::vector<std::string> documents);

// Every file of the run as make_files() has them, and the --emit document. UsageError when an input turns out
// not to have what an output needs.
// Precondition: no design has errors.
std::optional<std::vector<PendingFile>> files_of(const OutputPlan& plan, const Options& options,
                                                 Compilation& compilation, const BegunFiles& begun = {});

}  // namespace popup::cli
