// Many areas on a plate: only those that meet are looked at together.
#include "output/later_covers.h"

#include <gtest/gtest.h>

#include <numeric>

namespace popup {
namespace {

// Squares of half a millimetre, one each millimetre.
std::vector<PaintedBox> squares(int count) {
    std::vector<PaintedBox> boxes;
    for (int i = 0; i < count; ++i) {
        const Vec2 corner{static_cast<double>(i % 100), static_cast<double>(i / 100)};
        boxes.push_back({{corner, corner + Vec2{0.5, 0.5}}, true});
    }
    return boxes;
}

std::size_t pairs(const std::vector<std::vector<int>>& over) {
    return std::accumulate(over.begin(), over.end(), std::size_t{0},
                           [](std::size_t sum, const std::vector<int>& more) { return sum + more.size(); });
}

TEST(LaterCovers, OfSquaresApartThereAreNone) { EXPECT_EQ(pairs(later_covers(squares(5000))), 0U); }

TEST(LaterCovers, OfAGroundAreTheSquaresOnIt) {
    std::vector<PaintedBox> boxes = squares(5000);
    boxes.insert(boxes.begin(), {{{-1.0, -1.0}, {101.0, 101.0}}, true});
    const auto over = later_covers(boxes);
    EXPECT_EQ(over.front().size(), 5000U);
    EXPECT_EQ(over.front().front(), 1);
    EXPECT_EQ(pairs(over), 5000U) << "the squares do not hide each other, nor does the ground hide them";
}

TEST(LaterCovers, AreNotThoseThatOneSeesThrough) {
    const Box box{{0.0, 0.0}, {2.0, 2.0}};
    const std::vector<PaintedBox> boxes{{box, true}, {box, false}, {box, true}};
    EXPECT_EQ(later_covers(boxes), (std::vector<std::vector<int>>{{2}, {2}, {}}));
}

}  // namespace
}  // namespace popup
