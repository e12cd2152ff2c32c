// Patterns made larger: curves stay as round as they were.
#include "layout/scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "popup/path.h"

namespace popup {
namespace {

// A round piece with a hole, a round score and a round line printed: chords stray no further from the circles
// once these are larger. What is scored keeps its chords, and is drawn as curves.
TEST(Scale, CurvesAreAsRoundAsBefore) {
    const auto circle = [](double radius, Flattened& flat) {
        Path path;
        path.move({radius, 0});
        path.arc(radius, radius, 0, false, true, {-radius, 0});
        path.arc(radius, radius, 0, false, true, {radius, 0});
        path.close();
        EXPECT_EQ(flatten(path, flat), FlatteningFault::none);
        return flat.lines.back().points;
    };
    for (const double by : {0.3, 1.7, 12.5, 60.0}) {
        Flattened flat;
        PatternPiece piece;
        piece.cuts.push_back({circle(8, flat), true});
        piece.cuts.push_back({circle(20, flat), true});
        piece.silhouette = {{piece.cuts[1].points, {piece.cuts[0].points}}};
        std::reverse(piece.silhouette[0].holes[0].begin(), piece.silhouette[0].holes[0].end());
        const Ring score = circle(12, flat);
        for (std::size_t i = 0; i + 1 < score.size(); ++i)
            piece.lines.push_back({LineKind::valley, {score[i], score[i + 1]}, 3});
        piece.prints.push_back({Stroke{circle(16, flat), 0.5, {}}, -1});
        piece.bounds = bounds(piece.cuts[1].points);
        Pattern pattern;
        pattern.pieces.push_back(piece);
        pattern.curves = CurveTable(flat.curves);
        scale_pattern(pattern, by);
        const PatternPiece& scaled = pattern.pieces[0];
        const auto expect_round = [&](std::vector<Vec2> points, double radius, bool closed) {
            if (closed) points.push_back(points.front());
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                EXPECT_NEAR(length(points[i]), by * radius, 3e-4 * by);
                EXPECT_NEAR(length(lerp(points[i], points[i + 1], 0.5)), by * radius, kFlatMm + 3e-4 * by);
            }
        };
        expect_round(scaled.cuts[0].points, 8, true);
        expect_round(scaled.cuts[1].points, 20, true);
        expect_round(scaled.silhouette[0].outer, 20, true);
        expect_round(scaled.silhouette[0].holes[0], 8, true);
        expect_round(std::get<Stroke>(scaled.prints[0].print).points, 16, false);
        std::vector<Vec2> along{scaled.lines[0].at.a};
        for (const PatternLine& line : scaled.lines) along.push_back(line.at.b);
        EXPECT_EQ(along.size(), score.size());
        const Restored scored = pattern.curves.restored(along, false, true);
        EXPECT_LE(scored.steps.size(), 12U) << by;
        for (const CurveStep& step : scored.steps) EXPECT_TRUE(step.curve) << by;
        EXPECT_FALSE(scored.steps.empty());
        EXPECT_GE(scaled.bounds.max.x, bounds(scaled.silhouette[0].outer).max.x);
        // What draws curves finds all of them again.
        for (const Contour& cut : scaled.cuts) {
            const Restored restored = pattern.curves.restored(cut.points, true, true);
            ASSERT_FALSE(restored.steps.empty());
            EXPECT_LE(restored.steps.size(), 12U) << by;  // arcs of 30°
            for (const CurveStep& step : restored.steps) EXPECT_TRUE(step.curve) << by;
        }
    }
}

}  // namespace
}  // namespace popup
