// Arguments out of files: "@FILE" stands for the words that FILE holds.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

// The arguments, each "@FILE" replaced by the words of the file, in which the same may stand again; a name
// counts from the working directory wherever it stands. Words are apart by blanks and line breaks. Quotes,
// single or double, keep blanks in a word, and a backslash takes any character as it is, in quotes as well;
// this is how gcc reads such files. Other than with gcc, an @ in quotes names no file, and what cannot be
// read is a UsageError and never a word as it stands: a missing file, one that names itself, quotes that are
// not closed, more than 16 files in each other or a million words. Appends the names of the files that were
// read to `files`, each once.
std::vector<std::string> expand_response_files(const std::vector<std::string>& arguments,
                                               std::vector<std::string>& files);

}  // namespace popup::cli
