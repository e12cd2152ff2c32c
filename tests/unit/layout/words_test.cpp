// How sheets and rotations are written.
#include <gtest/gtest.h>

#include "popup/layout.h"

namespace popup {
namespace {

TEST(Layout, SheetsAreParsed) {
    EXPECT_EQ(parse_sheet("auto")->name, "auto");
    EXPECT_EQ(parse_sheet("A3")->name, "a3");
    EXPECT_EQ(parse_sheet("300x200")->width_mm, 300.0);
    EXPECT_EQ(parse_sheet("300x200mm")->height_mm, 200.0);
    EXPECT_NEAR(parse_sheet("12x24in")->height_mm, 609.6, 1e-9);
    EXPECT_EQ(parse_sheet("1.5e2x200")->width_mm, 150.0);
    for (const char* bad : {"", "a9", "300", "300x", "x200", "0x200", "-1x5", "300x200cm", "nanx5", "infx5",
                            "300x200 ", "1e300x5", "300,5x200", "3 x 4"}) {
        EXPECT_FALSE(parse_sheet(bad).has_value()) << bad;
    }
}

TEST(Layout, RotationsAreParsed) {
    EXPECT_EQ(parse_rotation("none")->count, 1);
    EXPECT_EQ(parse_rotation("180")->count, 2);
    EXPECT_EQ(parse_rotation("90")->count, 4);
    EXPECT_EQ(parse_rotation("any")->count, 0);
    EXPECT_EQ(parse_rotation("12")->count, 12);
    for (const char* bad : {"", "0", "-1", "1.5", "90x", "all", "99999999999"}) {
        EXPECT_FALSE(parse_rotation(bad).has_value()) << bad;
    }
}

}  // namespace
}  // namespace popup
