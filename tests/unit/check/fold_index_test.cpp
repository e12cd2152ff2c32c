// Which fold a line means.
#include "check/fold_index.h"

#include <gtest/gtest.h>

#include <vector>

#include "mechanism/builder.h"

namespace popup {
namespace {

constexpr double kRoundingMm = 0.01;
constexpr double kReachMm = 0.5;

Fold fold_at(const Segment& at) {
    Fold fold;
    fold.left_page = fold.right_page = 0;
    fold.on_left = fold.on_right = at;
    return fold;
}

Box around(Vec2 p) {
    Box box;
    box.extend(p - Vec2{1, 1});
    box.extend(p + Vec2{1, 1});
    return box;
}

// A repair has shortened an element, and moved its fold a little to the side. A line along where the fold is
// does not mean where it was, even where an element stands beyond the end of what is left.
TEST(FoldIndex, TakesOnePlaceOfAFoldWhereverAnElementStandsOnIt) {
    const Segment drawn{{0.3, 0}, {0.3, 40}};
    const Segment left{{0, 0}, {0, 10}};
    FoldIndex index;
    index.add(7, fold_at(left), {drawn, drawn}, false, kRoundingMm);
    for (const double y : {5.0, 11.2, 30.0}) {
        for (const FoldMatch& match : index.matches(0, {0, 0}, {0, 40}, around({0, y}), kReachMm))
            EXPECT_TRUE(match.left.identity) << y;
        const std::vector<FoldMatch> as_drawn =
            index.matches(0, {0.3, 0}, {0.3, 40}, around({0, y}), kReachMm);
        ASSERT_EQ(as_drawn.size(), 1U) << y;
        EXPECT_EQ(as_drawn.front().fold, 7);
        EXPECT_FALSE(as_drawn.front().left.identity) << y;
    }
    EXPECT_EQ(index.matches(0, {0, 0}, {0, 40}, around({0, 5}), kReachMm).size(), 1U);
}

// Where both lie in one line, both count: what was drawn first.
TEST(FoldIndex, KnowsAShortenedFoldByBothItsPlaces) {
    const Segment drawn{{0, 0}, {0, 40}};
    FoldIndex index;
    index.add(7, fold_at({{0, 5}, {0, 35}}), {drawn, drawn}, false, kRoundingMm);
    const std::vector<FoldMatch> found = index.matches(0, {0, 0}, {0, 40}, around({0, 20}), kReachMm);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_FALSE(found[0].left.identity);
    EXPECT_TRUE(found[1].left.identity);
}

}  // namespace
}  // namespace popup
