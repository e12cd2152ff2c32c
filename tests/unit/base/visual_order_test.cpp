// Letters as they stand on paper: what runs to the left, what joins, and all else as it was.
#include "base/text/visual_order.h"

#include <gtest/gtest.h>

namespace popup {
namespace {

TEST(VisualOrder, LeavesTextThatRunsToTheRightAlone) {
    for (const char* text : {"", "Happy birthday", "Grüße, Łódź", "Γειά σου", "с днём рождения", "日本 → 紙",
                             "\xF0\x9F\x8E\x82 cake"}) {
        EXPECT_EQ(in_visual_order(text), text);
    }
}

TEST(VisualOrder, TurnsWhatRunsToTheLeft) {
    EXPECT_EQ(in_visual_order("שלום"), "םולש");
    // Numbers and words of other scripts keep their own direction.
    EXPECT_EQ(in_visual_order("שלום 2026 Anna"), "Anna 2026 םולש");
    EXPECT_EQ(in_visual_order("Anna שלום!"), "Anna םולש!");
    EXPECT_EQ(in_visual_order("(שלום)"), "(םולש)");
}

TEST(VisualOrder, JoinsArabicLetters) {
    // BEH, ALEF: the first has its form at the beginning of a word, the second that at its end.
    EXPECT_EQ(in_visual_order("\xD8\xA8\xD8\xA7"), "\xEF\xBA\x8E\xEF\xBA\x91");
    // LAM and ALEF are one letter.
    EXPECT_EQ(in_visual_order("\xD9\x84\xD8\xA7"), "\xEF\xBB\xBB");
}

}  // namespace
}  // namespace popup
