// What `check` makes of its findings: which of them a baseline accepts.
#pragma once

#include <optional>

#include "cli/options/options.h"
#include "findings/baseline.h"
#include "popup/files.h"

namespace popup::cli {

// A UsageError when what is said about the findings does not go together.
void check_judge_options(const Options& options);

// A baseline's file as it was read.
struct BaselineFile {
    Diagnostics diagnostics;
    Source source;               // without text where it could not be read
    std::optional<Baseline> is;  // empty where it cannot be used: the diagnostics say why
};

// Reads the baseline, where one is named. One that is about to be written need not be there yet.
std::optional<BaselineFile> load_baseline(const Options& options);

// Takes what the baseline accepts out of what is told, and remarks on what it need not accept any more.
void judge(const Options& options, const Baseline& baseline, Findings& findings);

// Accepts everything: writes the baseline anew, leaves no finding to tell, and says so. False when it cannot
// be written; that stands in the findings then.
bool accept_all(const Options& options, const Baseline& old, Findings& findings);

}  // namespace popup::cli
