// The text of a FlatLang program as a tree.
#pragma once

#include <string>
#include <string_view>

#include "input/flatlang/syntax.h"
#include "popup/diagnostics.h"

namespace popup::flatlang {

struct ParseOptions {
    // The original's parser: what is wrong is reported and skipped as its recovery does, a token that begins
    // no statement ends the program, and the rest stands in the tree. All findings are warnings then.
    bool as_2008 = false;
    // Levels of brackets and blocks within each other; deeper is a `flatlang-too-deep` error.
    int deepest = 250;
};

struct Parsed {
    Syntax syntax;
    bool complete = false;  // the whole text is in the tree, and nothing was wrong with it
};

// Reads `text` of the file of that name. Errors, located: `flatlang-syntax` (what stands there, and what was
// expected instead), as many as recovery finds that do not follow from one another, at most 20;
// `flatlang-too-deep`. The tree holds what was read in any case; without as_2008 it is to be run only when
// complete. In 2008 mode a node may stand without children that its kind wants: what lacks them fails when
// it is run. Never throws. Cost: linear in bytes.
Parsed parse(std::string_view file, std::string_view text, const ParseOptions& options, Symbols& symbols,
             Diagnostics& diagnostics);

}  // namespace popup::flatlang
