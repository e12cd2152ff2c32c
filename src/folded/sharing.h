// How a sheet folds, found by several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

namespace popup {
struct Assembly;
struct CreasePattern;
class Diagnostics;
struct FoldOptions;
}  // namespace popup

namespace popup::folded {

// Threads that look for it beside the caller's. What is found does not depend on them, to the last bit.
struct Sharing {
    int threads = 1;  // the caller's among them; ≥ 1
    // Calls piece(0) to piece(count - 1), each once, from so many threads at most, and returns when all are
    // done. Empty: the caller's thread does all.
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& piece)> share = {};
};

// popup::fold_sheet(), shared.
std::optional<Assembly> fold_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                   const Sharing& sharing, Diagnostics& diagnostics);

}  // namespace popup::folded
