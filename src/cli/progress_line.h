// How far a run over many designs is, as a line of text.
#pragma once

#include <cstddef>
#include <string>

namespace popup {

struct ProgressState {
    std::size_t done = 0;
    std::size_t total = 0;
    double seconds = 0.0;  // since the begin
};

// "1200 of 10000 designs, 85.1/s, 1:43 left". The rate is that of the run up to now, and the time left is
// what the rest takes at this rate; while nothing is done, both are left out, and at the end the time left
// is.
std::string progress_text(const ProgressState& state);

// The same behind a bar, "[=====>      ] …", for a terminal of this many columns: never longer than one
// column less, so that it never breaks. The bar is left out where fewer than 10 columns are left for it, and
// what is still too long is cut off.
std::string progress_bar(const ProgressState& state, std::size_t columns);

}  // namespace popup
