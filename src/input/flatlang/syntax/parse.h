// The text of a FlatLang program as a tree.
#pragma once

#include <string>
#include <string_view>

#include "input/flatlang/syntax/syntax.h"
#include "popup/diagnostics.h"

namespace popup::flatlang {

// No path from the root of a tree to a leaf has more than this many nodes for each level that may be nested:
// a chain of operators is as deep as it is long. Longer ones are `flatlang-too-deep`, too.
inline constexpr int kTreeLevels = 4;

struct ParseOptions {
    // The original's parser: what is wrong is told and skipped as its recovery does, a word that begins no
    // statement ends the program, and the rest stands in the tree. Findings are warnings then, but for
    // `flatlang-too-deep`.
    bool as_2008 = false;
    // Levels of brackets and blocks within each other; deeper is a `flatlang-too-deep` error, and the text is
    // read no further.
    int deepest = 250;
};

struct Parsed {
    Syntax syntax;
    bool complete = false;  // the whole text is in the tree, and nothing was wrong with it
};

// Reads `text` of the file of that name. Errors, located: `flatlang-syntax` (what stands there, and what was
// expected instead), as many as recovery finds that do not follow from one another, at most 20 (in 2008 mode
// any number, where the original told them); `flatlang-too-deep`. The tree holds what was read in any case;
// without as_2008 it is to be run only when complete. In 2008 mode a node may stand without children that its
// kind wants (kMissing, or left out where their number is free): what lacks them fails when it is run. Any
// bytes may come; never throws. Cost: linear in bytes. Recursion is bounded by `deepest`.
Parsed parse(std::string_view file, std::string_view text, const ParseOptions& options, Symbols& symbols,
             Diagnostics& diagnostics);

}  // namespace popup::flatlang
