#include "fabrication/broken_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
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

// Chords of an arc of this radius, of so many degrees.
std::vector<Segment> arc(double radius, double deg, int chords) {
    const auto at = [&](int i) {
        const double turn = deg / 180.0 * std::acos(-1.0) * i / chords;
        return Vec2{radius * std::cos(turn), radius * std::sin(turn)};
    };
    std::vector<Segment> lines;
    for (int i = 0; i < chords; ++i) lines.push_back({at(i), at(i + 1)});
    return lines;
}

// What is scored of all lines, by how far along the arc it lies: from, to; ascending, what touches is one.
std::vector<std::pair<double, double>> scored_along_arc(const std::vector<Segment>& lines, double radius) {
    std::vector<std::pair<double, double>> all;
    const auto along = [radius](Vec2 p) { return radius * std::atan2(p.y, p.x); };
    const std::vector<FoldPart> parts = parts_of_folds(lines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        for (const Segment& one : broken_score(lines[i], parts[i]))
            all.push_back(std::minmax({along(one.a), along(one.b)}));
    }
    std::sort(all.begin(), all.end());
    std::vector<std::pair<double, double>> joined;
    for (const auto& one : all) {
        if (!joined.empty() && one.first - joined.back().second < 1e-6) {
            joined.back().second = one.second;
        } else {
            joined.push_back(one);
        }
    }
    return joined;
}

// Chords of 0.4 mm, shorter than a gap, of which half run the other way, in no order.
TEST(BrokenScore, OfACurveFollowsItsLength) {
    const double radius = 40.0;
    std::vector<Segment> lines = arc(radius, 160.0, 279);
    const double length = radius * std::atan2(lines.back().b.y, lines.back().b.x);
    for (std::size_t i = 0; i < lines.size(); i += 2) std::swap(lines[i].a, lines[i].b);
    for (std::size_t i = 0; i < lines.size(); ++i) std::swap(lines[i], lines[i * 7 % lines.size()]);
    const auto scored = scored_along_arc(lines, radius);
    ASSERT_EQ(scored.size(), 15U);  // 111.7 mm have 14 gaps
    EXPECT_NEAR(scored.front().first, 0.0, 1e-6);
    EXPECT_NEAR(scored.back().second, length, 1e-6);
    for (std::size_t i = 0; i + 1 < scored.size(); ++i) {
        EXPECT_NEAR(scored[i + 1].first - scored[i].second, 1.0, 1e-3) << i;
        EXPECT_NEAR(scored[i].second + 0.5, length * (static_cast<double>(i) + 0.5) / 14.0, 1e-3) << i;
    }
}

// However a fold is cut into lines, it has its gaps, also where one ends at an end of a line.
TEST(BrokenScore, OfAFoldInPartsHasAllItsGaps) {
    const auto scored_of = [](const std::vector<double>& lengths) {
        std::vector<Segment> lines;
        double at = 0.0;
        for (const double length : lengths) {
            lines.push_back({{at, 0}, {at + length, 0}});
            at += length;
        }
        const std::vector<FoldPart> parts = parts_of_folds(lines);
        double scored = 0.0;
        for (std::size_t i = 0; i < lines.size(); ++i) scored += sum(broken_score(lines[i], parts[i]));
        return scored;
    };
    EXPECT_NEAR(scored_of({5.25, 4.25}), 8.5, 1e-5);
    EXPECT_NEAR(scored_of({11.75, 25.75}), 32.5, 1e-5);
    for (int tenths = 10; tenths <= 60; ++tenths) {
        for (std::size_t count = 2; count <= 60; ++count) {
            const double whole = 0.1 * tenths * static_cast<double>(count);
            if (std::abs(whole / 8.0 - std::floor(whole / 8.0) - 0.5) < 1e-6) continue;  // either is right
            const double gaps = std::max(1.0, std::round(whole / 8.0));
            const double left = whole - gaps * std::min(1.0, 0.25 * whole / gaps);
            EXPECT_NEAR(scored_of(std::vector<double>(count, 0.1 * tenths)), left, 1e-4)
                << count << " lines of " << tenths << " tenths";
        }
    }
}

// A round fold has neither beginning nor end.
TEST(BrokenScore, OfARingHasGapsAllRound) {
    const std::vector<Segment> lines = arc(20.0, 360.0, 90);
    const std::vector<FoldPart> parts = parts_of_folds(lines);
    double all = 0.0;
    double whole = 0.0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        all += sum(broken_score(lines[i], parts[i]));
        whole += distance(lines[i].a, lines[i].b);
        EXPECT_NEAR(parts[i].whole, parts[0].whole, 1e-9);
    }
    EXPECT_NEAR(all, whole - 16.0, 1e-6);  // 125.6 mm
}

// What turns a corner, or meets a third fold, is another fold: a corner is scored.
TEST(BrokenScore, EndsAtCornersAndCrossings) {
    const std::vector<Segment> square{{{0, 0}, {20, 0}}, {{20, 0}, {20, 20}}};
    for (const FoldPart& part : parts_of_folds(square)) {
        EXPECT_EQ(part.before, 0.0);
        EXPECT_EQ(part.whole, 20.0);
    }
    const std::vector<Segment> fork{{{0, 0}, {20, 0}}, {{20, 0}, {40, 1}}, {{20, 0}, {40, -1}}};
    for (const FoldPart& part : parts_of_folds(fork)) EXPECT_EQ(part.before, 0.0);
    const std::vector<Segment> bend{{{40, 1}, {20, 0}}, {{0, 0}, {20, 0}}};
    const std::vector<FoldPart> parts = parts_of_folds(bend);
    EXPECT_EQ(parts[0].before, 0.0);
    EXPECT_NEAR(parts[1].before, 20.025, 1e-3);
    EXPECT_TRUE(parts[1].back);
    EXPECT_FALSE(parts[0].back);
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
