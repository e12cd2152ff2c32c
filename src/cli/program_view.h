// The program as its parser knows it, as plain values: what completions and manual pages are made from, so
// that they have every verb and option that --help has.
#pragma once

#include <string>
#include <vector>

#include "cli/options/value_option.h"

namespace popup::cli {

struct OptionView {
    std::vector<std::string> names;  // "-o", "--output"; of a positional its name alone
    std::string type;                // what its value is called, "FILE"; empty: it takes none
    std::string about;
    std::string group;
    OptionTraits traits;
    bool required = false;
    std::vector<std::string>
        words;  // values it takes, where it has a list of them; others may be good as well
};

struct VerbView {
    std::string name;
    std::string about;
    std::string footer;
    std::vector<OptionView> positionals;
    bool takes_edit = false;          // more words follow, which make up an edit
    std::vector<OptionView> options;  // in the order of --help within a group
    std::vector<std::string> groups;  // in the order of --help
};

struct ProgramView {
    VerbView self;  // the program without a verb
    std::vector<VerbView> verbs;
};

// Declares the program and looks at it. Lists of values come from the options themselves: each is asked for a
// value that none has, and says what it would have taken (UsageError::choices).
ProgramView view_program();

}  // namespace popup::cli
