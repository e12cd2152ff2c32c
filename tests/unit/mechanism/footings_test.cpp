// What stands on what, in a design as it is written.
#include "mechanism/footings.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "popup/check.h"
#include "support/designs.h"

namespace popup::test {
namespace {

// Points of pieces, which are drawn on pages of their own, do not count.
TEST(Footings, OfALongCardAreWhatElementsStandOnWhenChecked) {
    const Design design = row(100);
    const Footings footings = footings_of(design);
    const CardFolds card = folds_of_card(design);
    ASSERT_TRUE(card.as_written);
    std::size_t on_elements = 0;
    for (std::size_t i = 0; i < design.structures.size(); ++i) {
        const auto& owner = card.standing[i].owner;
        EXPECT_EQ(footings.ground[i].owner, owner ? static_cast<int>(*owner) : -1) << i;
        on_elements += owner ? 1 : 0;
    }
    EXPECT_EQ(on_elements, 60U);
}

// The fold may be given by two points of it that are near each other, and a little off it.
TEST(Footings, AreFoundByShortLinesThatLieAskew) {
    Design design = card(200.0, 300.0);
    add(design, "step", {{-20, 100}, {-20, 120}, {20, 100}, {20, 120}}, {0, -150}, {0, 150});
    add(design, "step", {{-25, 105}, {-25, 115}, {-15, 105}, {-15, 115}}, {-20.3, 109}, {-19.7, 111});
    add(design, "step", {{-20, -120}, {-20, -100}, {20, -120}, {20, -100}}, {0.4, 140}, {-0.4, 145});
    const Footings footings = footings_of(design);
    EXPECT_EQ(footings.ground[0].fold, 0);
    EXPECT_EQ(footings.ground[1].owner, 0);
    EXPECT_EQ(footings.ground[2].fold, 0) << "far from the line that names the gutter";
}

}  // namespace
}  // namespace popup::test
