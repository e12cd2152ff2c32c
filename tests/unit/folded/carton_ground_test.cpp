// Which panel of a carton stays while the others are folded.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/nth.h"
#include "popup/files.h"
#include "popup/joints.h"
#include "popup/language.h"
#include "support/folded_ends.h"

namespace popup {
namespace {

using test::add_line;

// What stays while the rest is folded.
std::string ground_of(const CreasePattern& pattern) {
    Diagnostics diagnostics;
    const auto assembly = fold_sheet(pattern, {}, diagnostics);
    EXPECT_TRUE(assembly);
    if (!assembly) return {};
    std::string name;
    for (const Joint& joint : assembly->joints) {
        if (const auto* const still = std::get_if<Still>(&joint.how))
            name += nth(assembly->plates, still->plate).name;
    }
    return name;
}

// Boxes stand on what their makers stand them on, whatever is largest, and whatever is drawn first.
TEST(Carton, StandsOnItsBase) {
    const auto mailer = test::read_folded(std::filesystem::path(POPUP_SOURCE_DIR) / "tests" / "cases" /
                                          "board" / "mailer.svg");
    ASSERT_TRUE(mailer);
    EXPECT_EQ(ground_of(*mailer), "sheet/base");
    // A tray whose walls are larger than its base.
    CreasePattern tray;
    add_line(tray,
             {{0, 0},
              {0, -90},
              {60, -90},
              {60, 0},
              {150, 0},
              {150, 60},
              {60, 60},
              {60, 150},
              {0, 150},
              {0, 60},
              {-90, 60},
              {-90, 0}},
             true, CreaseUse::cut);
    add_line(tray, {{0, 0}, {60, 0}, {60, 60}, {0, 60}}, true, CreaseUse::valley);
    EXPECT_EQ(ground_of(tray), "sheet/base");
    // A tube with a top and a bottom that are larger than its walls; the top is drawn first. And one whose
    // front and back are as large: both lids hang on the back.
    // The bottom may be a little smaller, as its panels are tucked in first.
    for (const auto& [height, share] : {std::pair{30.0, 1.0}, {30.0, 0.98}, {120.0, 1.0}}) {
        CreasePattern tube;
        constexpr double kSide = 60.0;
        for (const bool top : {true, false}) {
            const double y = top ? height : 0.0;
            const double out = top ? height + kSide : -share * kSide;
            add_line(tube, {{2 * kSide, y}, {2 * kSide, out}, {3 * kSide, out}, {3 * kSide, y}}, false,
                     CreaseUse::cut);
            add_line(tube, {{2 * kSide, y}, {3 * kSide, y}}, false, CreaseUse::valley);
            add_line(tube, {{0, y}, {2 * kSide, y}}, false, CreaseUse::cut);
            add_line(tube, {{3 * kSide, y}, {4 * kSide, y}}, false, CreaseUse::cut);
        }
        add_line(tube, {{0, 0}, {-12, 5}, {-12, height - 5}, {0, height}}, false, CreaseUse::cut);
        for (const double x : {0.0, kSide, 2 * kSide, 3 * kSide})
            add_line(tube, {{x, 0}, {x, height}}, false, CreaseUse::valley);
        add_line(tube, {{4 * kSide, 0}, {4 * kSide, height}}, false, CreaseUse::cut);
        EXPECT_EQ(ground_of(tube), height < kSide ? "sheet/bottom" : "sheet/back");
    }
}

}  // namespace
}  // namespace popup
