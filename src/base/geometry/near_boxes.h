// Boxes on pages and in space, and which of many touch: what may be near what, found without a look at each
// pair.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// Whether two boxes of one page share a point. Empty ones share none.
inline bool touch(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

// Empty at first: it touches nothing.
struct SpaceBox {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vec3 high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    // Makes it hold a point, and all within `reach` mm of it.
    void extend(Vec3 p, double reach = 0.0) {
        low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach), std::min(low.z, p.z - reach)};
        high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach), std::max(high.z, p.z + reach)};
    }
    [[nodiscard]] bool meets(const SpaceBox& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y && low.z <= other.high.z && other.low.z <= high.z;
    }
    [[nodiscard]] SpaceBox grown(double mm) const {
        return {{low.x - mm, low.y - mm, low.z - mm}, {high.x + mm, high.y + mm, high.z + mm}};
    }
};

// Pairs (a, b), a < b, in order, whose boxes touch; none of the boxes may be empty. Ends early after more
// than `most`. Cost: n log n, pairs.
std::vector<std::pair<int, int>> near_pairs(std::span<const SpaceBox> boxes, std::size_t most);
// The same with at most `most_each` earlier plates to each, whatever heaps others lie in.
std::vector<std::pair<int, int>> near_earlier(std::span<const SpaceBox> boxes, std::size_t most_each);

}  // namespace popup
