// Folds as lines to draw: curved ones whole, for machines; elsewhere as far as plate and angle go.
#include "output/sheet_folds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "output/sheet_drawing.h"
#include "popup/compile.h"
#include "support/drawings.h"
#include "support/profiles.h"

namespace popup {
namespace {

constexpr int kChords = 20;

Vec2 on_circle(int i) {
    const double turn = 0.5 * std::numbers::pi * i / kChords;
    return 50.0 * Vec2{std::cos(turn), std::sin(turn)};
}

// A quarter of a circle as mountains, every second chord the other way round and the last ones first; and a
// straight one by itself, between them in the list.
PatternPiece curved(const std::function<int(int)>& plate_of) {
    PatternPiece piece;
    for (int i = kChords; i-- > 0;) {
        const Segment chord{on_circle(i), on_circle(i + 1)};
        piece.lines.push_back(
            {LineKind::mountain, i % 2 == 0 ? chord : Segment{chord.b, chord.a}, plate_of(i)});
        if (i == kChords / 2) piece.lines.push_back({LineKind::mountain, {{0, 0}, {0, 20}}, 7});
    }
    return piece;
}

double length_of(const std::vector<Vec2>& line) {
    double sum = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) sum += distance(line[i - 1], line[i]);
    return sum;
}

TEST(SheetFolds, ThatAreCurvedAreOneLine) {
    const PatternPiece piece = curved([](int) { return 3; });
    for (const char* profile : {"workshop", "lightburn"}) {
        const auto folds = folds_to_draw(piece, Operation::mountain, *find_profile(profile));
        ASSERT_EQ(folds.size(), 2U) << profile;
        EXPECT_EQ(folds[0].points.size(), kChords + 1U);
        EXPECT_NEAR(length_of(folds[0].points), kChords * distance(on_circle(0), on_circle(1)), 1e-9);
        EXPECT_EQ(folds[0].plate, 3);
        EXPECT_EQ(folds[0].first, 0U);
        // By itself a line runs as it is given.
        EXPECT_EQ(folds[1].points, (std::vector<Vec2>{{0, 0}, {0, 20}}));
        EXPECT_EQ(folds[1].plate, 7);
        EXPECT_TRUE(folds_to_draw(piece, Operation::valley, *find_profile(profile)).empty());
    }
}

TEST(SheetFolds, EndWhereTheirPlateDoesUnlessAMachineFollowsThem) {
    const PatternPiece piece = curved([](int i) { return i < 5 ? 1 : 2; });
    const auto read_back = folds_to_draw(piece, Operation::mountain, *find_profile("workshop"));
    ASSERT_EQ(read_back.size(), 3U);
    EXPECT_EQ(read_back[0].plate, 2);
    EXPECT_EQ(read_back[1].plate, 7);
    EXPECT_EQ(read_back[2].plate, 1);
    EXPECT_EQ(read_back[2].points.size(), 6U);
    const auto followed = folds_to_draw(piece, Operation::mountain, *find_profile("lightburn"));
    ASSERT_EQ(followed.size(), 2U);
    EXPECT_EQ(followed[0].plate, -1);
    EXPECT_EQ(followed[0].points.size(), kChords + 1U);
}

TEST(SheetFolds, KeepTheirAngleWhereAllOfItHasOne) {
    PatternPiece piece = curved([](int) { return 0; });
    for (PatternLine& line : piece.lines) line.fold_angle = 1.5;
    EXPECT_EQ(folds_to_draw(piece, Operation::mountain, *find_profile("lightburn"))[0].fold_angle, 1.5);
    piece.lines[4].fold_angle = 1.25;
    EXPECT_EQ(folds_to_draw(piece, Operation::mountain, *find_profile("lightburn"))[0].fold_angle,
              std::nullopt);
    EXPECT_EQ(folds_to_draw(piece, Operation::mountain, *find_profile("workshop")).size(), 4U);
}

// A gap in the middle of each 8 mm or so, wherever the corners are.
TEST(SheetFolds, WithGapsAreScoredOverCorners) {
    const PatternPiece piece = curved([](int i) { return i; });
    const auto folds = broken_folds(piece, Operation::mountain, *find_profile("generic-laser"));
    ASSERT_EQ(folds.size(), 2U);
    const double whole = length_of(folds[0].points);
    const auto gaps = static_cast<std::size_t>(std::round(whole / 8.0));
    EXPECT_EQ(folds[0].parts.size(), gaps + 1);
    double scored = 0.0;
    for (const std::vector<Vec2>& part : folds[0].parts) {
        EXPECT_GE(part.size(), 2U);
        scored += length_of(part);
    }
    EXPECT_NEAR(scored, whole - static_cast<double>(gaps), 1e-6);
    EXPECT_EQ(folds[0].parts.front().front(), folds[0].points.front());
    EXPECT_EQ(folds[0].parts.back().back(), folds[0].points.back());
}

// The curve that was drawn, on flat parts and on folded sheets.
TEST(SheetFolds, ThatAreDrawnAsACurveAreOneOnSheets) {
    for (const DrawnAs as : {DrawnAs::parts, DrawnAs::folded}) {
        CompileOptions options;
        options.read.drawing.as = as;
        std::vector<Source> sources;
        sources.push_back({"drawing.svg", test::drawing("<rect x='5' y='5' width='90' height='70'/>"
                                                        "<circle cx='30' cy='65' r='6'/>"
                                                        "<path stroke='#f0f' stroke-dasharray='3 2' "
                                                        "d='M5 40 C40 20 60 60 95 40'/>")});
        const Compilation made = compile(std::move(sources), options, {});
        ASSERT_TRUE(made.layout.has_value());
        OutputOptions output;
        output.profile = *find_profile("lightburn");
        const SheetDrawing drawing = draw_sheet(*made.layout, output, {});
        int valleys = 0;
        for (const SheetShape& shape : drawing.shapes) {
            if (shape.operation != Operation::valley) continue;
            for (const popup::Run& run : drawing.runs_of(shape)) {
                ++valleys;
                EXPECT_EQ(run.steps, 1U);
                EXPECT_TRUE(drawing.steps[run.first_step].curve);
            }
        }
        EXPECT_EQ(valleys, 1);
        std::size_t curves = 0;
        for (const PathStep& step : drawing.steps) curves += step.curve ? 1 : 0;
        EXPECT_GE(curves, 13U) << "the circle's, too";
    }
}

}  // namespace
}  // namespace popup
