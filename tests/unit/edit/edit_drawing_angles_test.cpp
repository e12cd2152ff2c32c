// How far the sides of an edited drawing are folded: what they say of it, and go on saying.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "unit/edit/drawing_edits.h"

namespace popup::test {
namespace {

// A side gets a corner where the element has an angle for each: the corner parts it in two sides.
TEST(EditDrawingAngles, SidesThatHaveAnglesGetCorners) {
    const std::string path =
        "<path id=\"crease\" class=\"mountain\" stroke=\"#ff0000\" d=\"M50 50H150V150H50Z\"/>";
    for (const std::string& crease :
         {path, kRectangle,
          std::string("<polygon class='mountain' stroke='#f00' points='50,50 150,50 150,150 50,150'/>"),
          std::string(
              "<path class='mountain' stroke='#f00' d='M50 50H150M150 50V150M150 150H50M50 150V50'/>")}) {
        for (const std::string angles : {"90 90 80 90", "90 90 90 90"}) {
            std::string drawing = kTray;
            std::string said = crease;
            said.insert(said.find(' '), " data-fold-angle='" + angles + "'");
            drawing.replace(drawing.find(path), path.size(), said);
            drawing.insert(drawing.find("  <circle"),
                           "  <path class=\"cut\" stroke=\"#000\" d=\"M100 150V190\"/>\n");
            const Done done = edit(drawing, {"vertex base.2 --by 0,-5,0"});
            ASSERT_TRUE(done.text) << said << "\n" << done.told;
            const auto before = vertices_of(drawing);
            const auto after = vertices_of(*done.text);
            ASSERT_TRUE(before.contains("base.2"));
            const Vec3 to = before.at("base.2") + Vec3{0, -5, 0};
            EXPECT_TRUE(std::any_of(after.begin(), after.end(), [&](const auto& one) {
                return one.first.starts_with("base.") && distance(one.second, to) < 1e-4;
            })) << *done.text;
            // It says all angles, and can be edited again.
            const Done still = edit(*done.text, {"extrude base --by 0"});
            ASSERT_TRUE(still.text) << still.told;
            EXPECT_EQ(*still.text, *done.text);
            EXPECT_EQ(still.told.find("[folds-turn]"), std::string::npos) << still.told;
            const Done again = edit(*done.text, {"vertex base.2 --by 0,-1,0"});
            EXPECT_TRUE(again.text) << *done.text << again.told;
        }
    }
}

// What says of its lines how far they are folded goes on doing so.
TEST(EditDrawingAngles, AnglesThatWereSaidStay) {
    std::string drawing = kTray;
    const std::string crease = "d=\"M50 50H150V150H50Z\"";
    drawing.replace(drawing.find(crease), crease.size(),
                    "data-fold-angle='90 90 auto 80' d=\"M50 50H150M150 150H50M50 50V150M150 150V50\"");
    const Done done = edit(drawing, {"edge front.1-2 --by 0,-10,0"});
    ASSERT_TRUE(done.text) << done.told;
    EXPECT_NE(done.text->find("data-fold-angle='90 75.963757 auto 80'"), std::string::npos) << *done.text;
}

// Two walls on one side, which gets a corner between them: each has an angle, of a rectangle as of a path.
// With --fold-to none is written.
TEST(EditDrawingAngles, WallsOnOneSideHaveAnglesOfTheirOwn) {
    std::string drawing = kTray;
    const std::string crease =
        "<path id=\"crease\" class=\"mountain\" stroke=\"#ff0000\" d=\"M50 50H150V150H50Z\"/>";
    drawing.insert(drawing.find("  <circle"), "  <path class=\"cut\" stroke=\"#000\" d=\"M100 150V190\"/>\n");
    std::string of_rectangle = drawing;
    of_rectangle.replace(drawing.find(crease), crease.size(), kRectangle);
    for (const std::string& one : {drawing, of_rectangle}) {
        const Done done = edit(one, {"edge panel-4.1-2 --by 0,-10,0"});
        ASSERT_TRUE(done.text) << done.told;
        const std::string said = "data-fold-angle=\"";
        const std::size_t at = done.text->find(said);
        ASSERT_NE(at, std::string::npos) << *done.text;
        const std::size_t from = at + said.size();
        EXPECT_EQ(words_of(done.text->substr(from, done.text->find('"', from) - from)).size(), 5U);
    }
    // With --fold-to it is not known how far they go in the end.
    DrawingEditOptions half;
    half.fold.to = 0.5;
    const Done part = edit(kTray, {"edge front.1-2 --by 0,-1,0"}, half);
    ASSERT_TRUE(part.text) << part.told;
    EXPECT_EQ(part.text->find("data-fold-angle"), std::string::npos) << *part.text;
}

// Two walls on one side with a gap between them, which the crease is drawn across: their angles differ, and
// the side stays straight. A path is parted, and goes on drawing what folds nothing; others cannot say it.
TEST(EditDrawingAngles, WallsWithAGapBetweenThemHaveAnglesOfTheirOwn) {
    const std::string crease =
        "<path id=\"crease\" class=\"mountain\" stroke=\"#ff0000\" d=\"M50 50H150V150H50Z\"/>";
    std::string drawing = kTray;
    const std::string wall = "V190H50V150H10";
    drawing.replace(drawing.find(wall), wall.size(), "V190H105V150H95V190H50V150H10");
    const std::string move = "edge panel-4.1-2 --by 0,-10,0";
    const Done done = edit(drawing, {move});
    ASSERT_TRUE(done.text) << done.told;
    EXPECT_NE(done.text->find("data-fold-angle=\"90 90 75.963757 90 90 auto\""), std::string::npos)
        << *done.text;
    EXPECT_NE(done.text->find("M 105,150 95,150\""), std::string::npos) << *done.text;
    const Vec3 was = vertices_of(drawing).at("panel-4.1");
    EXPECT_LT(distance(vertices_of(*done.text).at("panel-4.1"), was + Vec3{0, -10, 0}), 1e-4);
    EXPECT_TRUE(edit(*done.text, {"edge panel-4.1-2 --by 0,-1,0"}).text);
    const std::string polygon =
        "<polygon class='mountain' stroke='#f00' points='50,50 150,50 150,150 50,150'/>";
    for (const auto& [element, tag] : {std::pair{kRectangle, "rect"}, std::pair{polygon, "polygon"}}) {
        std::string other = drawing;
        other.replace(other.find(crease), crease.size(), element);
        const Done told = edit(other, {move});
        ASSERT_TRUE(told.text) << told.told;
        EXPECT_NE(told.told.find("folds on one side of this <" + std::string(tag) +
                                 "> have different angles now, and it has one data-fold-angle for each side "
                                 "[folds-turn]"),
                  std::string::npos)
            << told.told;
        EXPECT_EQ(told.text->find("data-fold-angle"), std::string::npos) << *told.text;
    }
    // One wall on the side says the angle of the side, also of a rectangle.
    std::string alone = kTray;
    alone.replace(alone.find(wall), wall.size(), "V190H105V150H50H10");
    alone.replace(alone.find(crease), crease.size(), kRectangle);
    const Done one = edit(alone, {"edge panel-4.1-2 --by 0,-10,0"});
    ASSERT_TRUE(one.text) << one.told;
    EXPECT_NE(one.text->find("data-fold-angle=\"90 90 75.963757 90\""), std::string::npos) << *one.text;
}

}  // namespace
}  // namespace popup::test
