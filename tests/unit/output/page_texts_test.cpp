// Texts of pages keep to the room they have.
#include "output/page_texts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/text/font_file.h"
#include "output/cairo_sheet.h"

namespace popup {
namespace {

constexpr double kCapMm = 2.0;

class PageTexts : public testing::Test {
 protected:
    PageTexts() { set_font(context_.get(), font_.get()); }
    [[nodiscard]] std::vector<std::string> lines(const std::string& text, double room_mm) const {
        return wrapped(context_.get(), text, kCapMm, room_mm);
    }
    [[nodiscard]] double length(const std::string& text) const {
        return text_length(context_.get(), text, kCapMm);
    }

 private:
    FontFace font_ = open_font(font_path(TextFont::sans));
    Surface surface_{cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr)};
    Context context_{cairo_create(surface_.get())};
};

TEST_F(PageTexts, WordsStayWholeWhereTheyHaveRoom) {
    EXPECT_EQ(lines("one two three", length("one two") + 0.01),
              (std::vector<std::string>{"one two", "three"}));
    EXPECT_EQ(lines("", 10.0), std::vector<std::string>{});
}

TEST_F(PageTexts, WordsWithoutRoomAreBrokenBehindMarks) {
    EXPECT_EQ(lines("a the-long-name-of-a-tent b", length("the-long-name-")),
              (std::vector<std::string>{"a", "the-long-name-", "of-a-tent b"}));
}

// Letters of two bytes are one; where not even one has room, each has a line.
TEST_F(PageTexts, WordsWithoutMarksAreBrokenBetweenCharacters) {
    const std::string word = "ÄÖÜÄÖÜÄÖÜÄÖÜÄÖÜÄÖÜ";
    for (const double room : {0.1, 5.0, 9.0, length(word)}) {
        std::string joined;
        for (const std::string& line : lines(word, room)) {
            EXPECT_EQ(line.size() % 2, 0U);
            EXPECT_TRUE(length(line) <= room || line.size() == 2) << line;
            joined += line;
        }
        EXPECT_EQ(joined, word);
    }
    EXPECT_EQ(lines(word, 0.1).size(), 18U);
    EXPECT_EQ(lines(word, length(word)).size(), 1U);
    // A word may be as long as a document.
    EXPECT_GT(lines(std::string(40'000, 'm'), 100.0).size(), 800U);
}

}  // namespace
}  // namespace popup
