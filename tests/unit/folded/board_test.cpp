// Allowances for the board: which creases are moved and how far, which cartons need none, and how large a
// carton is. Distances of closed panels are measured here on the placed assembly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "folded/carton/hull3.h"
#include "popup/crease_pattern.h"
#include "popup/files.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "support/folded_ends.h"
#include "support/random.h"

namespace popup {
namespace {

const std::filesystem::path kSource(POPUP_SOURCE_DIR);

std::vector<std::string> messages(const Diagnostics& diagnostics, const std::string& code) {
    std::vector<std::string> found;
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (one.code == code) found.push_back(one.message);
    }
    return found;
}

// How far the middle of one closed panel is from the plane of another.
double apart(const Assembly& assembly, const std::string& one, const std::string& other) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(assembly.sweep.from_deg), frames));
    const auto number = [&](const std::string& name) {
        const auto at = std::find_if(assembly.plates.begin(), assembly.plates.end(),
                                     [&](const Plate& plate) { return plate.name == name; });
        EXPECT_NE(at, assembly.plates.end()) << name;
        return static_cast<std::size_t>(at - assembly.plates.begin());
    };
    const std::size_t a = number(one);
    const std::size_t b = number(other);
    const Vec3 at = frames[a].point(bounds(assembly.plates[a].outline.outer).centre());
    return std::abs(dot(at - frames[b].origin, frames[b].normal()));
}

class KitBoard : public testing::TestWithParam<const char*> {};

// The kit draws cartons with the allowances of its page.
TEST_P(KitBoard, CartonsOfTheKitNeedNothingForTheirOwnBoard) {
    const std::filesystem::path path = kSource / "samples/cartons" / (std::string(GetParam()) + ".fl");
    const auto pattern = test::read_folded(path);
    ASSERT_TRUE(pattern);
    Diagnostics diagnostics;
    const auto source = read_source(path.string(), diagnostics);
    const std::size_t at = source->text.find("\nboard = ");
    ASSERT_NE(at, std::string::npos);
    const double board = std::stod(source->text.substr(at + 9));
    const auto allowed = allow_for_board(*pattern, {}, board, diagnostics);
    ASSERT_TRUE(allowed);
    EXPECT_FALSE(allowed->moved);
    EXPECT_EQ(messages(diagnostics, "crease-moved"), std::vector<std::string>{});
    EXPECT_EQ(messages(diagnostics, "no-room-for-board"), std::vector<std::string>{});
    EXPECT_FALSE(messages(diagnostics, "carton-size").empty());
}

INSTANTIATE_TEST_SUITE_P(Kit, KitBoard,
                         testing::Values("auto-lock-bottom", "fefco-0201", "fefco-0215", "fefco-0421",
                                         "fefco-0427", "gift-bag", "hexagonal-box", "reverse-tuck-end",
                                         "sleeve", "straight-tuck-end", "tray-with-lid"));

TEST(Board, WhatGoesInsideGoesInByACaliperAndATuckFlapByMore) {
    const auto pattern = test::read_folded(kSource / "tests/cases/board/tube.svg");
    ASSERT_TRUE(pattern);
    Diagnostics diagnostics;
    FoldOptions options;
    const auto flat = fold_sheet(*pattern, options, diagnostics);
    ASSERT_TRUE(flat);
    options.board_mm = 0.5;
    const auto thick = fold_sheet(*pattern, options, diagnostics);
    ASSERT_TRUE(thick);
    EXPECT_EQ(messages(diagnostics, "no-room-for-board"), std::vector<std::string>{});
    const auto closes = [&](const std::string& one, const std::string& other, double mm) {
        EXPECT_NEAR(apart(*flat, one, other), 0.0, 1e-6) << one;
        EXPECT_NEAR(apart(*thick, one, other), mm, 1e-6) << one;
    };
    closes("sheet/glue-flap", "sheet/left", 0.5);
    closes("sheet/top-dust-flap-right", "sheet/top", 0.5);
    closes("sheet/top-dust-flap-left", "sheet/top", 0.5);
    closes("sheet/top-tuck", "sheet/front", 0.75);
}

TEST(Board, WhatWasAllowedForNeedsNothingMore) {
    const auto pattern = test::read_folded(kSource / "tests/cases/board/tube.svg");
    ASSERT_TRUE(pattern);
    Diagnostics diagnostics;
    const auto once = allow_for_board(*pattern, {}, 0.5, diagnostics);
    ASSERT_TRUE(once);
    EXPECT_TRUE(once->moved);
    Diagnostics second;
    const auto twice = allow_for_board(once->pattern, {}, 0.5, second);
    ASSERT_TRUE(twice);
    EXPECT_FALSE(twice->moved) << messages(second, "crease-moved").front();
}

class MailersBoard : public testing::TestWithParam<double> {};

// Its ears, dust flaps and corner flaps begin two by two in one corner, and each is moved by a length of its
// own, some past where the other begins. What is drawn alike on both sides, to the last digit, is moved
// alike.
TEST_P(MailersBoard, StaysOnePieceAndMirrored) {
    const auto pattern = test::read_folded(kSource / "tests/cases/board/mailer.svg");
    ASSERT_TRUE(pattern);
    Diagnostics diagnostics;
    const auto allowed = allow_for_board(*pattern, {}, GetParam(), diagnostics);
    ASSERT_TRUE(allowed);
    EXPECT_TRUE(allowed->moved);
    std::vector<Vec2> points;
    for (const CreaseLine& line : allowed->pattern.lines)
        points.insert(points.end(), line.points.begin(), line.points.end());
    for (const Vec2 p : points) {
        const Vec2 mirrored{350.0 - p.x, p.y};
        EXPECT_TRUE(
            std::any_of(points.begin(), points.end(), [&](Vec2 q) { return distance(q, mirrored) < 1e-6; }))
            << p.x << ", " << p.y;
    }
    FoldOptions options;
    options.board_mm = GetParam();
    const auto folded = fold_sheet(*pattern, options, diagnostics);
    ASSERT_TRUE(folded);
    EXPECT_EQ(folded->pieces.size(), 1U);
    EXPECT_EQ(folded->plates.size(), 19U);
    // What is told of creases names the panels of the model, whichever of two equal ones is moved.
    const std::vector<std::string> told = messages(diagnostics, "crease-moved");
    EXPECT_FALSE(told.empty());
    for (const std::string& message : told) {
        const std::size_t begin = message.find("between ") + 8;
        const std::size_t end = message.find(" and ", begin);
        const std::size_t last = message.find(" lacks ", end);
        for (const std::string& name :
             {message.substr(begin, end - begin), message.substr(end + 5, last - end - 5)}) {
            EXPECT_TRUE(std::any_of(folded->plates.begin(), folded->plates.end(), [&](const Plate& plate) {
                return plate.name == name;
            })) << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Boards, MailersBoard, testing::Values(0.3, 0.5, 1.0, 1.5, 2.0, 3.0));

TEST(Board, SheetsThatDoNotFoldAsTheyAreDrawnAreFoldedWithoutIt) {
    const auto pattern = test::read_folded(kSource / "samples/folded/carton.svg");
    ASSERT_TRUE(pattern);
    // Three folds about a corner do not go: nothing is rigid.
    CreasePattern three = *pattern;
    three.lines.clear();
    const auto line = [&](std::vector<Vec2> points, bool closed, CreaseUse use) {
        CreaseLine& made = three.lines.emplace_back();
        made.points = std::move(points);
        made.closed = closed;
        made.use = use;
    };
    line({{0, 0}, {80, 0}, {80, 80}, {0, 80}}, true, CreaseUse::cut);
    line({{40, 40}, {40, 0}}, false, CreaseUse::valley);
    line({{40, 40}, {80, 80}}, false, CreaseUse::valley);
    line({{40, 40}, {0, 80}}, false, CreaseUse::mountain);
    FoldOptions options;
    options.board_mm = 0.5;
    Diagnostics diagnostics;
    EXPECT_TRUE(fold_sheet(three, options, diagnostics));
    EXPECT_EQ(messages(diagnostics, "board-left-out").size(), 1U);
    EXPECT_EQ(messages(diagnostics, "not-rigid").size(), 1U);
}

TEST(Hull, OfABoxHasItsVolumeAndSurface) {
    std::vector<Vec3> points;
    test::Random random(7);
    // Points on the sides, and within: the hull is that of the corners.
    for (int i = 0; i < 200; ++i) {
        Vec3 p{30.0 * random.unit(), 20.0 * random.unit(), 10.0 * random.unit()};
        if (i % 4 == 0) p.x = 30;
        if (i % 4 == 1) p.y = 0;
        if (i % 4 == 2) p.z = 10;
        points.push_back(p);
    }
    for (const double x : {0.0, 30.0}) {
        for (const double y : {0.0, 20.0}) {
            for (const double z : {0.0, 10.0}) points.push_back({x, y, z});
        }
    }
    const folded::HullSize size = folded::hull_size(points);
    EXPECT_NEAR(size.volume, 6000.0, 1e-3);
    EXPECT_NEAR(size.surface, 2200.0, 1e-3);
}

TEST(Hull, OfWhatLiesInAPlaneIsNothing) {
    EXPECT_EQ(
        folded::hull_size(std::vector<Vec3>{{0, 0, 1}, {5, 0, 1}, {5, 5, 1}, {0, 5, 1}, {2, 2, 1}}).volume,
        0.0);
    EXPECT_EQ(folded::hull_size(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).volume, 0.0);
    EXPECT_EQ(folded::hull_size({}).volume, 0.0);
}

// An octahedron: 4/3 of the cube of what its corners stand off by, whatever else is inside.
TEST(Hull, OfAnOctahedronIsExact) {
    std::vector<Vec3> points{{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}, {1, 1, 1}};
    EXPECT_NEAR(folded::hull_size(points).volume, 36.0, 1e-9);
    EXPECT_NEAR(folded::hull_size(points).surface, 8 * std::sqrt(3.0) / 4 * 18, 1e-9);
}

}  // namespace
}  // namespace popup
