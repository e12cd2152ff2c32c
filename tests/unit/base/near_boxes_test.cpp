// Which boxes touch is found as a look at each pair would find it.
#include "base/geometry/near_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/proposals.h"

namespace popup {
namespace {

std::vector<SpaceBox> boxes(std::uint64_t seed, std::size_t count, double room, double size) {
    test::Dice dice{seed};
    std::vector<SpaceBox> made(count);
    for (SpaceBox& one : made) {
        const Vec3 at{dice.uniform(0, room), dice.uniform(0, room), dice.uniform(0, room)};
        one.extend(at);
        one.extend(
            {at.x + dice.uniform(0, size), at.y + dice.uniform(0, size), at.z + dice.uniform(0, size)});
    }
    return made;
}

std::vector<std::pair<int, int>> by_pairs(const std::vector<SpaceBox>& all) {
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t a = 0; a < all.size(); ++a) {
        for (std::size_t b = a + 1; b < all.size(); ++b) {
            if (all[a].meets(all[b])) pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
        }
    }
    return pairs;
}

TEST(NearBoxes, AreThoseThatTouch) {
    for (const std::size_t count : {0U, 1U, 47U, 48U, 49U, 97U, 700U}) {
        const std::vector<SpaceBox> all = boxes(count + 1, count, 100.0, 20.0);
        const auto pairs = by_pairs(all);
        EXPECT_EQ(near_earlier(all, count + 1), pairs) << count;
        EXPECT_EQ(near_pairs(all, pairs.size() + 1), pairs) << count;
    }
}

// A heap, where each touches all.
TEST(NearBoxes, AreNoMoreThanAskedForToEach) {
    constexpr std::size_t kCount = 500;
    constexpr std::size_t kMost = 7;
    const std::vector<SpaceBox> all = boxes(3, kCount, 1.0, 100.0);
    const auto known = by_pairs(all);
    const auto pairs = near_earlier(all, kMost);
    EXPECT_TRUE(std::includes(known.begin(), known.end(), pairs.begin(), pairs.end()));
    EXPECT_TRUE(std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end());
    std::vector<std::size_t> earlier(kCount, 0), found(kCount, 0);
    for (const auto& [a, b] : known) ++earlier[static_cast<std::size_t>(b)];
    for (const auto& [a, b] : pairs) ++found[static_cast<std::size_t>(b)];
    for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(found[i], std::min(earlier[i], kMost)) << i;
}

}  // namespace
}  // namespace popup
