// Tabs and what is glued flat are judged as they are made.
#include "popup/made_size.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "unit/pattern/hand_made_card.h"

namespace popup {
namespace {

constexpr double kPi = std::numbers::pi;

std::string found(const Assembly& assembly, double scale, double depth_mm = 10.0) {
    PatternOptions options;
    options.tab_depth = Length::millimetres(depth_mm);
    Diagnostics diagnostics;
    judge_made_size(assembly, options, scale, diagnostics);
    std::string all;
    for (const Diagnostic& one : diagnostics.sorted()) {
        EXPECT_EQ(one.code, "tab-too-small");
        all += one.message + "; " + one.hints.front() + "\n";
    }
    return all;
}

TEST(MadeSize, OfAllTabsIsToldOnce) {
    test::HandMadeCard card;
    card.v_fold(-30, 60, 40 * kPi / 180, 100 * kPi / 180, 40);
    EXPECT_EQ(found(card.assembly, 1.0), "");
    EXPECT_EQ(found(card.assembly, 2.0), "");
    EXPECT_EQ(found(card.assembly, 0.31), "");
    EXPECT_EQ(found(card.assembly, 0.1),
              "glue tabs of 10 mm are made 1 mm deep at a scale of 0.1; with less than 3 mm they hold badly; "
              "take --scale 0.3 or more, or --tab-depth 30mm where there is room for it\n");
    // Who wants tabs of 2 mm has them, but gets no smaller ones.
    EXPECT_EQ(found(card.assembly, 1.0, 2.0), "");
    EXPECT_NE(found(card.assembly, 0.5, 2.0).find("tabs of 2 mm are made 1 mm deep"), std::string::npos);
}

TEST(MadeSize, OfATabThatIsTrimmedIsToldOfIt) {
    test::HandMadeCard card;
    card.v_fold(-30, 60, 10 * kPi / 180, 85 * kPi / 180, 40);  // close to the gutter
    ASSERT_EQ(found(card.assembly, 1.0), "");
    const std::string told = found(card.assembly, 0.4);
    EXPECT_NE(told.find("at a scale of 0.4 glue tab 1"), std::string::npos) << told;
    EXPECT_NE(told.find("at least 3 mm deep (7.5 mm as drawn)"), std::string::npos) << told;
    EXPECT_NE(told.find("seam of 24.00 mm ("), std::string::npos) << told;
}

TEST(MadeSize, OfWhatIsGluedFlatIsTold) {
    Assembly assembly;
    assembly.glued_areas.push_back({0, 0, {{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}}, "1", "flag", {4, 2}});
    EXPECT_EQ(found(assembly, 0.5), "");
    EXPECT_EQ(
        found(assembly, 0.4),
        "\"flag\" is glued over 100.0 mm², which are 16.0 mm² at a scale of 0.4; 25 mm² are the least that "
        "holds; take --scale 0.5 or more, or make the piece larger where it is glued\n");
}

}  // namespace
}  // namespace popup
