// Words of a text, quoted as gcc reads them in files of arguments.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup {

struct QuotedWord {
    std::string text;
    Place place;         // where it begins
    bool plain = false;  // begins with neither a quote nor a backslash
};

// The words of `text`, which blanks and line breaks keep apart. Quotes, single or double, keep blanks in a
// word; a backslash takes any character as it is, in quotes as well. A quote that is not closed, a backslash
// at the end and a NUL byte are errors with this code; the words before them are returned.
std::vector<QuotedWord> quoted_words(std::string_view text, std::string_view code, Diagnostics& trouble);

// The word as it is typed into a shell, or into a file of arguments: in single quotes unless it is plain.
// "roof", "'my roof'", "'it'\''s'".
std::string typed_word(std::string_view word);

}  // namespace popup
