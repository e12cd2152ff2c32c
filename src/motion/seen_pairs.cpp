#include "motion/seen_pairs.h"

#include <algorithm>

#include "base/nth.h"

namespace popup {

SeenPairs::SeenPairs(std::span<const int> base, std::span<const int> mover) {
    const auto plates = static_cast<int>(base.size());
    std::vector<std::vector<int>> above(base.size());  // by plate: itself and all that it hangs on
    for (int plate = 0; plate < plates; ++plate) {
        for (int at = plate; at >= 0; at = nth(base, at)) nth(above, plate).push_back(at);
        std::sort(nth(above, plate).begin(), nth(above, plate).end());
    }
    std::vector<int> between;
    for (int b = 0; b < plates; ++b) {
        for (int a = 0; a < b; ++a) {
            between.clear();
            std::set_symmetric_difference(nth(above, a).begin(), nth(above, a).end(), nth(above, b).begin(),
                                          nth(above, b).end(), std::back_inserter(between));
            Pair& pair = pairs_.emplace_back(Pair{a, b, {}, {}});
            for (const int plate : between) {
                if (nth(mover, plate) >= 0) pair.movers.push_back(nth(mover, plate));
            }
            std::sort(pair.movers.begin(), pair.movers.end());
            pair.movers.erase(std::unique(pair.movers.begin(), pair.movers.end()), pair.movers.end());
        }
    }
}

void SeenPairs::set(std::vector<int> doing, const std::vector<char>& still) {
    doing_ = std::move(doing);
    still_ = still;
}

std::size_t SeenPairs::index(int a, int b) const {
    const auto row = static_cast<std::size_t>(b);
    return row * (row - 1) / 2 + static_cast<std::size_t>(a);
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
    Pair& pair = pairs_[index(a, b)];
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
    return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
        const Way* const way = pair.ways.empty() ? nullptr : find(pair);
        return way != nullptr && way->crosses && !aside.contains({pair.a, pair.b});
    });
}

}  // namespace popup
