// Patterns of very many lines: folding ends, all that fits into the work for a sheet is folded, and of the
// rest it is said that it was given up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "folded/path.h"
#include "folded/sheet.h"
#include "folded/straighten.h"
#include "miura.h"
#include "popup/crease_pattern.h"
#include "support/random.h"

namespace popup {
namespace {

using test::miura;

constexpr double kSide = 200.0;

void add_border(CreasePattern& pattern) {
    pattern.lines.push_back({{{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}}, true, CreaseUse::cut});
}

// Lines from edge to edge of a sheet, that all cross.
CreasePattern lines_across(int lines) {
    test::Random random(7);
    CreasePattern pattern;
    add_border(pattern);
    for (int i = 0; i < lines; ++i) {
        const CreaseUse use = random.below(2) == 0 ? CreaseUse::mountain : CreaseUse::valley;
        pattern.lines.push_back({{{kSide * random.unit(), 0}, {kSide * random.unit(), kSide}}, false, use});
    }
    return pattern;
}

// Folds from the middle to the border.
CreasePattern star_of(int folds) {
    CreasePattern pattern;
    Ring ring;
    for (int i = 0; i < folds; ++i) {
        const double way = 2.0 * std::numbers::pi * i / folds;
        ring.push_back({100.0 * std::cos(way), 100.0 * std::sin(way)});
        const CreaseUse use = i % 2 == 0 ? CreaseUse::mountain : CreaseUse::valley;
        pattern.lines.push_back({{{0, 0}, ring.back()}, false, use});
    }
    pattern.lines.push_back({ring, true, CreaseUse::cut});
    return pattern;
}

// A large sheet, and beside it a small one.
CreasePattern large_and_small() {
    CreasePattern pattern = miura(14, 14, 10.0, 10.0, 0.3);
    for (CreaseLine line : miura(2, 2, 10.0, 10.0, 0.3).lines) {
        for (Vec2& p : line.points) p = p + Vec2{500.0, 0.0};
        pattern.lines.push_back(line);
    }
    return pattern;
}

TEST(LargePatterns, SmallSheetsFoldWhereALargeOneIsGivenUp) {
    Diagnostics diagnostics;
    const auto sheet = folded::make_sheet(large_and_small(), {}, diagnostics);
    ASSERT_TRUE(sheet);
    folded::Work enough;
    const folded::Paths whole = folded::find_paths(*sheet, {}, enough);
    ASSERT_EQ(whole.clusters.size(), 2U);
    EXPECT_FALSE(whole.any_given_up());
    EXPECT_EQ(whole.reached, 1.0);
    // The larger comes first in the sheet.
    EXPECT_GT(whole.clusters[0].loops.size(), whole.clusters[1].loops.size());
    // From next to nothing to what it takes: the small one is folded long before the large one is.
    bool between = false;
    for (const double share : {1e-7, 1e-3, 0.05, 0.5}) {
        folded::Work work(share * enough.spent());
        const folded::Paths paths = folded::find_paths(*sheet, {}, work);
        EXPECT_TRUE(paths.clusters[0].given_up) << share;
        EXPECT_LT(paths.clusters[0].reached, 1.0) << share;
        EXPECT_LE(work.spent(), work.most());
        between = between || !paths.clusters[1].given_up;
        if (paths.clusters[0].reached > 0.0) continue;
        for (const int fold : paths.clusters[0].folds)
            EXPECT_EQ(folded::angle_at(paths.laws[static_cast<std::size_t>(fold)], 1.0), 0.0);
    }
    EXPECT_TRUE(between);
    folded::Work same(enough.spent());
    EXPECT_FALSE(folded::find_paths(*sheet, {}, same).any_given_up()) << "steps are counted alike each time";
}

// Tens of thousands of corners hang together here.
TEST(LargePatterns, WhatIsTooMuchIsGivenUpAndStaysFlat) {
    Diagnostics diagnostics;
    const auto sheet = fold_sheet(lines_across(300), {}, diagnostics);
    ASSERT_TRUE(sheet);
    EXPECT_GT(sheet->plates.size(), 10'000U);
    EXPECT_EQ(sheet->sweep.from_deg, 0.0);
    const auto all = diagnostics.sorted();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [](const Diagnostic& one) { return one.code == "folding-undecided"; });
    ASSERT_NE(found, all.end());
    EXPECT_NE(found->message.find("million steps that are spent on a sheet"), std::string::npos);
}

TEST(LargePatterns, LinesThatCrossTooOftenAreRefused) {
    Diagnostics diagnostics;
    EXPECT_FALSE(fold_sheet(lines_across(4000), {}, diagnostics));
    EXPECT_EQ(diagnostics.sorted().front().code, "document-too-large");
}

TEST(LargePatterns, PanelsBeyondTheLimitAreRefusedWithTheirNumber) {
    CreasePattern pattern;
    add_border(pattern);
    const int lines = 230;
    for (int i = 1; i <= lines; ++i) {
        const double at = kSide * i / (lines + 1);
        pattern.lines.push_back({{{at, 0}, {at, kSide}}, false, CreaseUse::valley});
        pattern.lines.push_back({{{0, at}, {kSide, at}}, false, CreaseUse::valley});
    }
    Diagnostics diagnostics;
    EXPECT_FALSE(folded::make_sheet(pattern, {}, diagnostics));
    const Diagnostic told = diagnostics.sorted().front();
    EXPECT_EQ(told.code, "document-too-large");
    EXPECT_EQ(told.message, "the lines of the pattern enclose 53361 panels, the limit is 50000");
}

TEST(LargePatterns, OfVeryManyFoldsAroundOneCorner) {
    Diagnostics diagnostics;
    const auto sheet = folded::make_sheet(star_of(3000), {}, diagnostics);
    ASSERT_TRUE(sheet);
    EXPECT_EQ(sheet->panels.size(), 3000U);
    ASSERT_EQ(sheet->loops.size(), 1U);
    EXPECT_EQ(sheet->loops.front().steps.size(), 3000U);
    folded::Sheet straight = *sheet;
    folded::Work work;
    EXPECT_FALSE(folded::straighten(straight, 1.0, work).closes);
}

// A border of two panels that runs to and fro.
TEST(LargePatterns, OfAVeryLongBorderOfTwoPanels) {
    CreasePattern pattern;
    add_border(pattern);
    const int steps = 40'000;
    std::vector<Vec2> border;
    for (int i = 0; i <= steps; ++i) border.push_back({kSide * i / steps, 100.0 + (i % 2 == 0 ? 0.0 : 60.0)});
    pattern.lines.push_back({border, false, CreaseUse::valley});
    Diagnostics diagnostics;
    FoldOptions options;
    options.merge_mm = 1e-6;
    const auto sheet = folded::make_sheet(pattern, options, diagnostics);
    ASSERT_TRUE(sheet);
    EXPECT_EQ(sheet->panels.size(), 2U);
    EXPECT_GT(sheet->folds.size(), 1000U);
}

}  // namespace
}  // namespace popup
