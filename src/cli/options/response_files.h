// Arguments out of files: "@FILE" stands for the words that FILE holds.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "popup/files.h"

namespace popup::cli {

// The words of a command line, and where those stand that files hold.
struct ExpandedWords {
    struct Origin {
        std::size_t file = 0;  // of `files`, counted from 1; 0: the command line
        Place place;
    };
    std::vector<std::string> words;
    std::vector<Origin> origins;  // of each word; empty where no file is named
    std::vector<Source> files;    // those that were read
};

// The arguments, each "@FILE" replaced by the words of the file, in which the same may stand again; a name
// counts from the working directory wherever it stands. Words are apart by blanks and line breaks. Quotes,
// single or double, keep blanks in a word, and a backslash takes any character as it is, in quotes as well;
// this is how gcc reads such files. Other than with gcc, an @ in quotes names no file, and what cannot be
// read is a UsageError and never a word as it stands: a missing file, one that names itself, quotes that are
// not closed, more than 16 files in each other or a million words. Appends the names of the files that were
// read to `files`, each once.
ExpandedWords expand_response_files(const std::vector<std::string>& arguments,
                                    std::vector<std::string>& files);

// The error with the place of the word that it blames, or of an option that it names, where that word stands
// in a response file; else the error as it is. Cost: a look at each word.
UsageError placed(const UsageError& error, const ExpandedWords& expanded);

}  // namespace popup::cli
