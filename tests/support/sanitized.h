// Whether tests look at the library and the program as they are, or built with the sanitizers.
#pragma once

#include <algorithm>
#include <concepts>

namespace popup::test {

// Tests are compiled once, and linked with either: what differs is found when they run. Set before anything
// that is initialized at run time.
extern const bool kSanitized;

// How many of n inputs that are generated or damaged are looked at: all, but under the sanitizers one in
// `part` of them, at least one where n is. There each takes about ten times as long, and what sanitizers look
// for shows in a tenth of them; what the results must be is seen in all of them, elsewhere. What a test says
// it must find at the least is the same share of it:
//
//   for (std::uint64_t seed = 1; seed <= sanitized_count(2000); ++seed) accepted += look_at(seed);
//   EXPECT_GT(accepted, sanitized_count(300));
template <std::integral Count>
Count sanitized_count(Count n, Count part = 10) {
    return kSanitized && n > 0 ? std::max<Count>(n / part, 1) : n;
}

}  // namespace popup::test
