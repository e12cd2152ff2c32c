#include "output/layer_levels.h"

#include <algorithm>

namespace popup {

std::vector<int> layer_levels(std::size_t count, std::span<const std::pair<int, int>> over) {
    std::vector<std::vector<std::size_t>> above(count);  // those that lie on each
    std::vector<int> below(count, 0);                    // how many each still waits for
    for (const auto& [low, high] : over) {
        above[static_cast<std::size_t>(low)].push_back(static_cast<std::size_t>(high));
        ++below[static_cast<std::size_t>(high)];
    }
    std::vector<int> level(count, 0);
    std::vector<char> done(count, 0);
    std::vector<std::size_t> ready;
    const auto drain = [&] {
        while (!ready.empty()) {
            const std::size_t one = ready.back();
            ready.pop_back();
            if (std::exchange(done[one], 1) != 0) continue;
            for (const std::size_t next : above[one]) {
                if (done[next] == 0) level[next] = std::max(level[next], level[one] + 1);
                if (--below[next] == 0) ready.push_back(next);
            }
        }
    };
    for (std::size_t i = 0; i < count; ++i) {
        if (below[i] == 0) ready.push_back(i);
    }
    drain();
    for (std::size_t i = 0; i < count; ++i) {
        if (done[i] != 0) continue;
        ready.push_back(i);
        drain();
    }
    return level;
}

}  // namespace popup
