// The files of a directory and of those below it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/files/path_patterns.h"
#include "popup/diagnostics.h"

namespace popup {

// The file that says what a walk leaves out, with the patterns of path_patterns.h. It is for its own
// directory and those below.
inline constexpr std::string_view kIgnoreFile = ".popupcignore";

struct WalkOptions {
    // Whether a file is wanted, by its name, the last part of its path.
    std::function<bool(std::string_view name)> wants;
    PathPatterns include;  // when there are any, files they say nothing of are left out as well
    PathPatterns exclude;  // asked before any ignore file
};

struct TreeWalk {
    std::vector<std::string> files;
    std::vector<std::string> ignore_files;  // that were found
    std::vector<Diagnostics>
        unreadable;  // directories and ignore files, one each, with an `unreadable-input`
};

// All wanted files below the directory `root`, as "ROOT/a/b.xml", without "./" before them. In each directory
// files and directories come in the order of the bytes of their names.
// Left out are names that begin with ".", what patterns exclude (of several ignore files the innermost that
// has a matching line decides; an excluded directory is not entered), and what is no file. Links to files are
// taken, links to directories are not followed. Links that lead nowhere are taken, so that reading tells.
// `policy` is that of the diagnostics. Never throws for what is on the disk.
TreeWalk walk_tree(const std::string& root, const WalkOptions& options, const DiagnosticPolicy& policy);

}  // namespace popup
