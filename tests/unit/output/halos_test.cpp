// Whatever the paint, numbers, names, folds and places for glue can be told from it.
#include "output/halos.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "support/profiles.h"
#include "support/random.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::options_for;
using test::view_of;

TEST(Contrast, IsThatOfTheGuidelines) {
    EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21.0, 1e-9);
    EXPECT_NEAR(contrast({255, 255, 255}, {255, 255, 255}), 1.0, 1e-9);
    // The lightest grey that passes for text on white, as often published.
    EXPECT_GE(contrast({0x76, 0x76, 0x76}, {255, 255, 255}), 4.5);
    EXPECT_LT(contrast({0x77, 0x77, 0x77}, {255, 255, 255}), 4.5);
    EXPECT_NEAR(contrast({255, 0, 0}, {255, 255, 255}), 3.998, 1e-3);
}

// What is painted last over a point of a piece; white where nothing is.
Color paint_at(const SheetDrawing& drawing, int piece, Vec2 p) {
    Color made{255, 255, 255};
    for (const SheetShape& shape : drawing.shapes) {
        if (shape.operation != Operation::fill || shape.piece != piece) continue;
        bool inside = false;
        for (const Run& run : drawing.runs_of(shape)) {
            const auto ring = drawing.points_of(run);
            for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
                if ((ring[i].y > p.y) != (ring[j].y > p.y) &&
                    p.x < ring[i].x + (p.y - ring[i].y) * (ring[j].x - ring[i].x) / (ring[j].y - ring[i].y))
                    inside = !inside;
            }
        }
        if (inside) made = shape.color;
    }
    return made;
}

void expect_seen(const SheetDrawing& drawing) {
    for (const SheetText& text : drawing.texts) {
        if (text.operation != Operation::label) continue;
        EXPECT_GE(contrast(text.color, paint_at(drawing, text.piece, text.at)), 4.5) << text.text;
    }
    for (const SheetShape& shape : drawing.shapes) {
        const bool fold = shape.operation == Operation::valley || shape.operation == Operation::mountain ||
                          shape.operation == Operation::seam;
        if (!fold) continue;
        const auto points = drawing.points_of(drawing.runs_of(shape)[0]);
        const Vec2 middle = 0.5 * (points[0] + points[1]) + Vec2{0.013, 0.017};
        EXPECT_GE(contrast(shape.color, paint_at(drawing, shape.piece, middle)), 3.0);
    }
}

TEST(Halos, MakeLabelsAndFoldsSeenOnAnyPaint) {
    test::Random random(7);
    const OutputOptions options = options_for("workshop", false, ScoreSide::front, false);
    for (int round = 0; round < 100; ++round) {
        Layout layout = test::example_layout();
        for (PatternPiece& piece : layout.designs[0].pattern.pieces) {
            // All of it painted, and something on top.
            piece.prints.insert(piece.prints.begin(), {Area{piece.silhouette.front(), {}}, 0});
            for (PatternPrint& print : piece.prints) {
                auto* area = std::get_if<Area>(&print.print);
                if (area == nullptr) continue;
                const auto value = [&] { return static_cast<std::uint8_t>(256.0 * random.unit()); };
                area->color = {value(), value(), value()};
            }
        }
        for (const int sheet : {0, 1}) expect_seen(draw_sheet(layout, options, view_of(sheet, false)));
    }
}

std::size_t fills(const Layout& layout, const OutputOptions& options) {
    const SheetDrawing drawing = draw_sheet(layout, options, view_of(0, false));
    return static_cast<std::size_t>(
        std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                      [](const SheetShape& one) { return one.operation == Operation::fill; }));
}

TEST(Halos, AreNotWhereEverythingCanBeSeen) {
    Layout layout = test::example_layout();
    for (PatternPrint& print : layout.designs[0].pattern.pieces[0].prints) {
        if (auto* area = std::get_if<Area>(&print.print)) area->color = {0xff, 0xff, 0xf0};
    }
    const OutputOptions workshop = options_for("workshop", false, ScoreSide::front, false);
    EXPECT_EQ(fills(layout, workshop), 2U);
    // Folds on dark areas are on white.
    for (PatternPrint& print : layout.designs[0].pattern.pieces[0].prints) {
        if (auto* area = std::get_if<Area>(&print.print)) area->color = {0x20, 0x10, 0x40};
    }
    EXPECT_GT(fills(layout, workshop), 2U);
}

}  // namespace
}  // namespace popup
