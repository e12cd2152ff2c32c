#include "motion/seen_pairs.h"

#include <algorithm>

#include "base/nth.h"

namespace popup {

SeenPairs::SeenPairs(std::span<const int> base, std::span<const int> mover)
    : base_(base.begin(), base.end()), mover_(mover.begin(), mover.end()), depth_(base.size(), -1) {
    std::vector<int> way;
    for (int plate = 0; plate < static_cast<int>(base_.size()); ++plate) {
        int at = plate;
        for (; at >= 0 && nth(depth_, at) < 0; at = nth(base_, at)) way.push_back(at);
        int depth = at < 0 ? -1 : nth(depth_, at);
        for (; !way.empty(); way.pop_back()) nth(depth_, way.back()) = ++depth;
    }
}

void SeenPairs::set(std::vector<int> doing, const std::vector<char>& still) {
    doing_ = std::move(doing);
    still_ = still;
}

SeenPairs::Pair& SeenPairs::pair_of(int a, int b) {
    const auto [known, fresh] = pairs_.try_emplace({a, b});
    Pair& pair = known->second;
    if (!fresh) return pair;
    // Up from both, as far as to the plate that they hang on together.
    while (a != b) {
        int& deeper = b < 0 || (a >= 0 && nth(depth_, a) >= nth(depth_, b)) ? a : b;
        if (nth(mover_, deeper) >= 0) pair.movers.push_back(nth(mover_, deeper));
        deeper = nth(base_, deeper);
    }
    std::sort(pair.movers.begin(), pair.movers.end());
    pair.movers.erase(std::unique(pair.movers.begin(), pair.movers.end()), pair.movers.end());
    return pair;
}

const SeenPairs::Way* SeenPairs::find(const Pair& pair) const {
    const auto same = [&](const Way& way) {
        for (std::size_t i = 0; i < pair.movers.size(); ++i) {
            if (way.doing[i] != nth(doing_, pair.movers[i])) return false;
        }
        return true;
    };
    const auto way = std::find_if(pair.ways.begin(), pair.ways.end(), same);
    return way == pair.ways.end() ? nullptr : &*way;
}

SeenPairs::Way& SeenPairs::of(int a, int b) {
    Pair& pair = pair_of(a, b);
    if (const Way* const known = find(pair))
        return pair.ways[static_cast<std::size_t>(known - pair.ways.data())];
    Way& way = pair.ways.emplace_back();
    way.still = true;
    for (const int mover : pair.movers) {
        const int doing = nth(doing_, mover);
        way.doing.push_back(doing);
        way.still = way.still && nth(still_, doing) != 0;
    }
    return way;
}

bool SeenPairs::Way::knows(double from, double to, std::vector<ContactRange>& found) const {
    found.clear();
    if (still && !cells.empty()) {
        const InCell& one = cells.front();
        const bool throughout =
            one.found.size() == 1 && one.found[0].from == one.from && one.found[0].to == one.to;
        if (one.found.empty()) return true;
        if (throughout) {
            found.push_back({from, to, one.found[0].kind, one.found[0].firm});
            return true;
        }
    }
    const auto at = std::find_if(cells.begin(), cells.end(),
                                 [&](const InCell& one) { return one.from == from && one.to == to; });
    if (at == cells.end()) return false;
    found = at->found;
    return true;
}

void SeenPairs::Way::keep(double from, double to, const std::vector<ContactRange>& found) {
    cells.push_back({from, to, found});
    crosses = crosses || std::any_of(found.begin(), found.end(), is_certain);
}

bool SeenPairs::any_crosses(const std::set<std::pair<int, int>>& aside) const {
    return std::any_of(pairs_.begin(), pairs_.end(), [&](const auto& known) {
        const Pair& pair = known.second;
        const Way* const way = pair.ways.empty() ? nullptr : find(pair);
        return way != nullptr && way->crosses && !aside.contains(known.first);
    });
}

}  // namespace popup
