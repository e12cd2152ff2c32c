// A unified diff of two texts, as `patch` takes it.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// The unified diff (three lines of context) that turns `before` into `after`; empty when they are equal.
// `name` is given on both header lines, a tab after one with blanks. A last line without line break is marked
// as GNU diff does. Guarantees: applying it to `before` gives `after`. It is the shortest one wherever
// changes lie between lines that stand once in each text and are not too many (256 in a row). Cost: O(n log
// n) in lines when changes are few or scattered, never worse than a bounded multiple of that.
std::string unified_diff(std::string_view name, std::string_view before, std::string_view after);

}  // namespace popup
