#include "fabrication/broken_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "output/sheet_drawing.h"
#include "support/profiles.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

double sum(const std::vector<Segment>& parts) {
    double all = 0.0;
    for (const Segment& one : parts) all += distance(one.a, one.b);
    return all;
}

TEST(BrokenScore, LeavesOutAMillimetreInEveryEight) {
    const std::vector<Segment> parts = broken_score({{10, 20}, {10, 100}});
    ASSERT_EQ(parts.size(), 11U);
    EXPECT_EQ(parts.front().a, (Vec2{10, 20}));
    EXPECT_EQ(parts.back().b, (Vec2{10, 100}));
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        EXPECT_NEAR(distance(parts[i].b, parts[i + 1].a), 1.0, 1e-9);
        EXPECT_NEAR(parts[i].b.y, 20.0 + 8.0 * static_cast<double>(i) + 3.5, 1e-9);
    }
}

// However short a fold is, it has a gap, and three quarters of it are scored.
TEST(BrokenScore, LeavesMostOfEveryLine) {
    for (double mm = 0.1; mm < 60.0; mm *= 1.3) {
        const std::vector<Segment> parts = broken_score({{0, 0}, {0.6 * mm, 0.8 * mm}});
        EXPECT_GE(parts.size(), 2U) << mm;
        EXPECT_GE(sum(parts), 0.75 * mm - 1e-9) << mm;
        EXPECT_LT(sum(parts), mm) << mm;
        const double gap = distance(parts[0].b, parts[1].a);
        EXPECT_LE(gap, 1.0 + 1e-9) << mm;
        if (mm >= 4.0) {
            EXPECT_NEAR(gap, 1.0, 1e-9) << mm;
        }
    }
}

// In how many parts the folds of the example are drawn: "mountain 1 10, seam 6, valley 1 1 1".
std::string parts(const OutputOptions& options, bool back) {
    std::string text;
    for (const Operation fold : {Operation::mountain, Operation::seam, Operation::valley}) {
        std::vector<std::size_t> runs;
        for (const int sheet : {0, 1}) {
            const SheetDrawing drawing =
                draw_sheet(test::example_layout(), options, test::view_of(sheet, back));
            for (const SheetShape& shape : drawing.shapes) {
                if (shape.operation == fold && shape.runs > 0) runs.push_back(shape.runs);
            }
        }
        std::sort(runs.begin(), runs.end());
        text += std::string(text.empty() ? "" : ", ") + std::string(to_string(fold));
        for (const std::size_t one : runs) text += " " + std::to_string(one);
    }
    return text;
}

// Folds of 30 mm and twice 75 mm, seams of 40 mm, and valleys of 70, 60 and 1.1 mm.
TEST(BrokenScore, IsOfFoldsAwayFromWhoLooks) {
    EXPECT_EQ(parts(test::options_for("lightburn", false, ScoreSide::front, false), false),
              "mountain 5 10 10, seam 6 6, valley 1 1 1");
    EXPECT_EQ(parts(test::options_for("lightburn", false, ScoreSide::back, false), true),
              "mountain 1 1 1, seam 1 1, valley 2 9 10");
    // Paper folds away from each score.
    const OutputOptions both = test::options_for("lightburn", false, ScoreSide::both, false);
    EXPECT_EQ(parts(both, false), "mountain 1 1 1, seam 1 1, valley");
    EXPECT_EQ(parts(both, true), "mountain, seam, valley 1 1 1");
}

TEST(BrokenScore, IsOfLasersAlone) {
    for (const Profile& profile : profile_table()) {
        const bool broken = is_broken(Operation::mountain, profile, ScoreSide::front);
        EXPECT_EQ(broken, profile.one_sided) << profile.name;
        EXPECT_FALSE(is_broken(Operation::valley, profile, ScoreSide::front)) << profile.name;
    }
    OutputOptions whole = test::options_for("lightburn", false, ScoreSide::front, false);
    whole.profile.away_folds = AwayFolds::whole;
    EXPECT_EQ(parts(whole, false), "mountain 1 1 1, seam 1 1, valley 1 1 1");
    Profile dashed = *find_profile("lightburn");
    for (const FoldStyle style : {FoldStyle::dashed, FoldStyle::perforated, FoldStyle::both}) {
        dashed.folds = style;
        EXPECT_FALSE(is_broken(Operation::mountain, dashed, ScoreSide::front)) << to_string(style);
    }
}

}  // namespace
}  // namespace popup
