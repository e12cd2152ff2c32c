// Letters of single lines, and the ticks that show where a tab goes.
#include "fabrication/stroke_font.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fabrication/glue_marks.h"

namespace popup {
namespace {

TEST(StrokeFont, HasAllPrintedCharactersOfAscii) {
    for (char32_t c = U' '; c <= U'~'; ++c) {
        ASSERT_TRUE(has_stroke_letter(c));
        const StrokeLetter letter = stroke_letter(c);
        EXPECT_GT(letter.advance, 0.1);
        EXPECT_EQ(letter.lines.empty(), c == U' ');
        for (const auto& line : letter.lines) {
            EXPECT_GE(line.size(), 2U);
            for (const Vec2 p : line) {
                EXPECT_GE(p.x, 0.0) << static_cast<char>(c);
                EXPECT_LE(p.x, letter.advance) << static_cast<char>(c);
            }
        }
    }
    EXPECT_FALSE(has_stroke_letter(U'\u00e9'));
    EXPECT_FALSE(has_stroke_letter(U'\x7f'));
}

TEST(StrokeFont, HasCapitalsAndFiguresOneHigh) {
    for (const char32_t c : U"0123456789LRH") {
        if (c == U'\0') continue;
        Box box;
        for (const auto& line : stroke_letter(c).lines) {
            for (const Vec2 p : line) box.extend(p);
        }
        EXPECT_NEAR(box.min.y, 0.0, 1e-9) << static_cast<char>(c);
        EXPECT_NEAR(box.max.y, 1.0, 1e-9) << static_cast<char>(c);
    }
}

TEST(TargetTicks, AreInTheCornersAndInsideTheTarget) {
    for (const bool turned : {false, true}) {
        Ring target{{0, 0}, {40, 0}, {34, 10}, {20, 10.2}, {6, 10}};
        if (turned) std::reverse(target.begin(), target.end());
        const auto ticks = target_ticks(target);
        EXPECT_EQ(ticks.size(), 4U);  // not where it hardly turns
        for (const auto& tick : ticks) {
            ASSERT_EQ(tick.size(), 3U);
            for (const Vec2 p : tick) EXPECT_TRUE(contains(Polygon{target, {}}, p)) << p.x << "," << p.y;
            double nearest = 1e9;
            for (const Vec2 corner : target) nearest = std::min(nearest, distance(tick[1], corner));
            EXPECT_LE(nearest, 1.0);
        }
    }
}

TEST(TargetTicks, AreDashesAlongWhatHasNoCorners) {
    Ring target;
    for (int i = 0; i < 90; ++i) target.push_back(rotated({12.0, 0.0}, i * 0.0698131700797732));
    const auto ticks = target_ticks(target);
    EXPECT_GE(ticks.size(), 8U);
    for (const auto& tick : ticks) {
        for (const Vec2 p : tick) EXPECT_LT(length(p), 12.0);
    }
}

TEST(TargetTicks, MarksAreWhereTheyAreAskedFor) {
    using enum MarksOn;
    for (const ScoreSide side : {ScoreSide::front, ScoreSide::back, ScoreSide::both}) {
        for (const bool back : {false, true}) {
            EXPECT_EQ(marks_joints(front, side, back), !back);
            EXPECT_EQ(marks_joints(MarksOn::back, side, back), back);
            EXPECT_FALSE(marks_joints(none, side, back));
            EXPECT_FALSE(marks_names(none, side, back));
            // A name on the front would be seen.
            EXPECT_EQ(marks_names(hidden, side, back), back && side != ScoreSide::front);
        }
        EXPECT_EQ(marks_joints(hidden, side, false), side != ScoreSide::back);
        EXPECT_NE(marks_joints(hidden, side, true), marks_joints(hidden, side, false));
    }
}

}  // namespace
}  // namespace popup
