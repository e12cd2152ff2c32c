// Ways from plate to plate over the folds of a sheet.
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "miura.h"
#include "motion/linkage.h"
#include "popup/crease_pattern.h"

namespace popup {
namespace {

constexpr std::size_t kFar = std::numeric_limits<std::size_t>::max();

// How many turns it takes from a plate to each, found by going over all turns until nothing is nearer. The
// world, which pieces stand in, is the last.
std::vector<std::size_t> turns_from(const Linkage& linkage, int plate, std::size_t plates) {
    std::vector<std::size_t> away(plates + 1, kFar);
    away[static_cast<std::size_t>(plate)] = 0;
    for (bool nearer = true; nearer;) {
        nearer = false;
        for (const Turn& turn : linkage.turns()) {
            std::size_t& one = away[static_cast<std::size_t>(turn.plate)];
            std::size_t& other = away[turn.other < 0 ? plates : static_cast<std::size_t>(turn.other)];
            if (one != kFar && one + 1 < other) {
                other = one + 1;
                nearer = true;
            } else if (other != kFar && other + 1 < one) {
                one = other + 1;
                nearer = true;
            }
        }
    }
    return away;
}

// A sheet of n × n panels has n⁴ pairs of them, and a search for each looks at up to n² panels.
TEST(Ways, FromOnePlateAreShortestAndTakeNoMoreThanAllPlates) {
    Diagnostics diagnostics;
    const auto sheet = fold_sheet(test::miura(9, 7, 10.0, 10.0, 0.3), {}, diagnostics);
    ASSERT_TRUE(sheet);
    const std::size_t plates = sheet->plates.size();
    ASSERT_EQ(plates, 63U);
    Linkage linkage(*sheet);
    std::vector<int> way;
    for (int a = 0; a < 63; a += 5) {
        const std::vector<std::size_t> away = turns_from(linkage, a, plates);
        std::size_t looked = 0;
        for (int b = 62; b >= 0; --b) {
            looked += linkage.way(a, b, way);
            ASSERT_EQ(way.size(), away[static_cast<std::size_t>(b)]) << a << " to " << b;
            int at = a;
            for (const int number : way) {
                const Turn& turn = linkage.turns()[static_cast<std::size_t>(number)];
                ASSERT_TRUE(turn.plate == at || turn.other == at) << a << " to " << b;
                at = turn.plate == at ? turn.other : turn.plate;
            }
            ASSERT_EQ(at, b) << "from " << a;
        }
        EXPECT_LE(looked, plates + 1) << a;
    }
}

}  // namespace
}  // namespace popup
