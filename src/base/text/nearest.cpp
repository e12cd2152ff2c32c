#include "base/text/nearest.h"

#include <algorithm>
#include <utility>

namespace popup {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = a[i - 1] == b[j - 1];
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                now[j] = std::min(now[j], before[j - 2] + 1);
            }
        }
        std::swap(before, last);
        std::swap(last, now);
    }
    return last[b.size()];
}

std::vector<std::string> nearest(std::string_view word, std::span<const std::string_view> candidates,
                                 std::size_t limit) {
    // Nobody types a word this long by mistake, and the table grows with the product of the lengths.
    if (word.empty() || word.size() > 80) return {};
    std::vector<std::pair<std::size_t, std::string_view>> ranked;
    for (const std::string_view candidate : candidates) {
        const bool begins = word.size() >= 2 && (candidate.starts_with(word) || word.starts_with(candidate));
        const std::size_t most = std::max<std::size_t>(2, candidate.size() / 3);
        // Each letter that one has more than the other is a change.
        if (!begins && (word.size() > candidate.size() + most || candidate.size() > word.size() + most))
            continue;
        const std::size_t distance = begins ? 1 : edit_distance(word, candidate);
        if (distance <= most && distance < candidate.size()) ranked.emplace_back(distance, candidate);
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> result;
    for (std::size_t i = 0; i < std::min(limit, ranked.size()); ++i) result.emplace_back(ranked[i].second);
    return result;
}

}  // namespace popup
