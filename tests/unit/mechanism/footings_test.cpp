// What stands on what, in a design as it is written.
#include "mechanism/footings.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "popup/check.h"
#include "support/designs.h"

namespace popup::test {
namespace {

// Where nothing has to be repaired, each stands on what it stands on when it is checked.
void expect_as_checked(const Design& design, std::size_t& on_elements) {
    const Footings footings = footings_of(design);
    const CardFolds card = folds_of_card(design);
    if (!card.as_written) return;
    for (std::size_t i = 0; i < design.structures.size(); ++i) {
        const Structure& one = design.structures[i];
        if (one.finds_ground || one.named().given()) continue;
        const auto& owner = card.standing[i].owner;
        EXPECT_EQ(footings.ground[i].owner, owner ? static_cast<int>(*owner) : -1) << one.id;
        on_elements += owner ? 1 : 0;
    }
}

TEST(Footings, AreWhatElementsStandOnWhenChecked) {
    std::size_t on_elements = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) expect_as_checked(generate(seed, 8), on_elements);
    expect_as_checked(row(100), on_elements);
    EXPECT_GT(on_elements, 300U);
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
