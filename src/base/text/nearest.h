// What the user may have meant by a word that is none of ours.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace popup {

// Number of insertions, deletions, exchanges and swaps of neighbours that turn `a` into `b`, in bytes.
// Cost: product of the lengths.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidates most like `word`, best first, at most `limit`; equally good ones as they stand. A candidate
// that differs in more than a third of its letters (at least two) is no answer, unless one begins with the
// other.
std::vector<std::string> nearest(std::string_view word, std::span<const std::string_view> candidates,
                                 std::size_t limit = 3);

}  // namespace popup
