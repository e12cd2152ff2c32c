// Kerf compensation where paper or waste is too narrow for the tool, of whole layouts, and of real designs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "fabrication/kerf.h"
#include "popup/compile.h"
#include "popup/files.h"
#include "support/designs.h"
#include "support/kerf_example.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::attempt;
using test::closed;
using test::distance_to;
using test::edges;
using test::expect_error;
using test::move_hole;
using test::Outcome;
using test::piece_of;
using test::rectangle_at;
using test::reversed;
using test::turned;

// ---- what the path cannot make ----

Ring notched(double width) {
    return {{-10, 0},         {10, 0},           {10, 8},           {0.5 * width, 8},
            {0.5 * width, 5}, {-0.5 * width, 5}, {-0.5 * width, 8}, {-10, 8}};
}

TEST(KerfLimits, ANotchNarrowerThanTheKerfIsAnError) {
    expect_error(attempt(piece_of({closed(notched(0.15))}), {0.2, 0.2}), "the notch at (0, ");
    expect_error(attempt(piece_of({closed(notched(0.15))}), {0.2, 0.2}), "about 0.15 mm wide");
    EXPECT_TRUE(attempt(piece_of({closed(notched(0.25))}), {0.2, 0.2}).cuts.has_value());
    // It is the edge's kerf that counts.
    EXPECT_TRUE(attempt(piece_of({closed(notched(0.15))}), {0.2, 0.1}).cuts.has_value());
}

TEST(KerfLimits, NotchesOfAnyWidthAreJudgedByTheKerf) {
    test::Random random(6);
    int errors = 0;
    for (int round = 0; round < test::sanitized_count(300); ++round) {
        const double width = 0.02 + 0.5 * random.unit();
        const double kerf = 0.02 + 0.5 * random.unit();
        if (std::abs(width - kerf) < 1e-3) continue;
        const Ring ring = turned(notched(width), 7 * random.unit(), {50 * random.unit(), 50 * random.unit()});
        const Outcome edge = attempt(piece_of({closed(ring)}), {kerf, kerf});
        EXPECT_EQ(edge.cuts.has_value(), width > kerf) << width << " " << kerf;
        EXPECT_EQ(edge.found.empty(), width > kerf);
        // The same contour as a hole has a tongue of paper there instead, which only grows.
        EXPECT_TRUE(move_hole(reversed(ring), kerf).cuts.has_value());
        errors += edge.cuts ? 0 : 1;
    }
    EXPECT_GT(errors, test::sanitized_count(50));
}

TEST(KerfLimits, AHoleNarrowerThanTheKerfIsAnError) {
    const Outcome lost = move_hole(reversed(rectangle_at(20, 30, 0.1, 5)), 0.2);
    expect_error(lost, "the hole at (20.05, 3");
    expect_error(lost, "about 0.1 mm wide, and nothing is left");
    EXPECT_TRUE(move_hole(reversed(rectangle_at(20, 30, 0.25, 5)), 0.2).cuts.has_value());
}

TEST(KerfLimits, TheHintMendsIt) {
    const Outcome lost = move_hole(reversed(rectangle_at(20, 30, 0.15, 5)), 0.2);
    expect_error(lost, "about 0.15 mm wide");
    EXPECT_EQ(
        lost.found[0].hints.at(0),
        "take a --kerf of 0.14 mm or less, or make the design at least 1.5 times as large with --scale");
    EXPECT_TRUE(move_hole(reversed(rectangle_at(20, 30, 0.15, 5)), 0.14).cuts.has_value());
    EXPECT_TRUE(move_hole(reversed(rectangle_at(30, 45, 0.15 * 1.5, 7.5)), 0.2).cuts.has_value());
}

TEST(KerfLimits, AHoleThatFallsIntoSeveralIsAnError) {
    const auto bone = [](double width) {
        const double w = 0.5 * width;
        return Ring{{-5, -2}, {-2, -2}, {-2, -w}, {2, -w}, {2, -2}, {5, -2},
                    {5, 2},   {2, 2},   {2, w},   {-2, w}, {-2, 2}, {-5, 2}};
    };
    const Outcome parted = move_hole(reversed(bone(0.15)), 0.2);
    expect_error(parted, "falls apart");
    expect_error(parted, "about 0.15 mm wide");
    EXPECT_TRUE(move_hole(reversed(bone(0.25)), 0.2).cuts.has_value());
    // Two wedges with their points towards each other leave nothing that is long and narrow.
    const auto hourglass = [](double width) {
        const double w = 0.5 * width;
        return Ring{{-5, -5}, {0, -w}, {5, -5}, {5, 5}, {0, w}, {-5, 5}};
    };
    const Outcome pinched = move_hole(reversed(hourglass(0.1)), 0.2);
    expect_error(pinched, "the hole at (0, 0) mm");
    // Here mitres would meet though the place is wider than the kerf.
    const Ring wide = hourglass(0.25);
    const Outcome whole = move_hole(reversed(wide), 0.2);
    ASSERT_TRUE(whole.cuts.has_value());
    for (const Segment& s : edges(whole.cuts->at(0).points)) {
        for (const Segment& t : edges(wide)) EXPECT_GE(distance(s, t), 0.1 - 1e-5);
        EXPECT_LE(distance_to(wide, s.a), 0.11);
    }
}

TEST(KerfLimits, ANotchWithANarrowMouthIsAnError) {
    const auto keyhole = [](double width) {
        const double w = 0.5 * width;
        return Ring{{-10, 0}, {10, 0}, {10, 10}, {w, 10}, {w, 8},   {3, 8},
                    {3, 4},   {-3, 4}, {-3, 8},  {-w, 8}, {-w, 10}, {-10, 10}};
    };
    const Outcome shut = attempt(piece_of({closed(keyhole(0.1))}), {0.2, 0.2});
    expect_error(shut, "the way into a notch at (");
    EXPECT_TRUE(attempt(piece_of({closed(keyhole(0.3))}), {0.2, 0.2}).cuts.has_value());
}

TEST(KerfLimits, AHoleWithALongNarrowEndIsAnError) {
    const auto pan = [](double width) {
        return Ring{{0, 0}, {8, 0}, {8, 3}, {20, 3}, {20, 3 + width}, {8, 3 + width}, {8, 8}, {0, 8}};
    };
    expect_error(move_hole(reversed(pan(0.15)), 0.2), "the end of a hole at (");
    EXPECT_TRUE(move_hole(reversed(pan(0.25)), 0.2).cuts.has_value());
}

TEST(KerfLimits, ContoursWithTooLittleWasteBetweenThemAreAnError) {
    const auto pair = [](double gap) {
        return piece_of({closed(rectangle_at(0, 0, 10, 10)), closed(rectangle_at(10 + gap, 0, 10, 10))});
    };
    expect_error(attempt(pair(0.1), {0.0, 0.2}), "0.1 mm apart at (10");
    EXPECT_TRUE(attempt(pair(0.3), {0.0, 0.2}).cuts.has_value());
    const auto nested = [](double gap) {
        return piece_of({closed(rectangle_at(10 + gap, 12, 5, 5), 2),
                         closed(reversed(rectangle_at(10, 10, 10, 10)), 1),
                         closed(rectangle_at(0, 0, 40, 40))});
    };
    expect_error(attempt(nested(0.1), {0.2, 0.0}), "0.1 mm apart");
    EXPECT_TRUE(attempt(nested(0.1), {0.0, 0.2}).cuts.has_value());
    EXPECT_TRUE(attempt(nested(0.3), {0.2, 0.2}).cuts.has_value());
    // Between two holes, and between a hole and the edge, there is paper, which only gets wider.
    const PatternPiece bridges =
        piece_of({closed(rectangle_at(7, 7, 1, 1), 2), closed(reversed(rectangle_at(5, 5, 5, 5)), 1),
                  closed(reversed(rectangle_at(10.05, 5, 5, 5)), 1), closed(rectangle_at(4.95, 0, 40, 40))});
    EXPECT_TRUE(attempt(bridges, {0.2, 0.2}).cuts.has_value());
}

TEST(KerfLimits, OneFindingNamesTheNarrowestAndCountsTheOthers) {
    PatternPiece piece = piece_of({});
    for (int i = 0; i < 5; ++i) {
        piece.cuts.push_back(closed(reversed(rectangle_at(10.0 * i, 5, i == 3 ? 0.05 : 0.12, 4)), 1));
    }
    piece.cuts.push_back(closed(rectangle_at(-10, -10, 100, 100)));
    const Outcome result = attempt(piece, {0.2, 0.2});
    expect_error(result, "the hole at (30.0");
    expect_error(result, "about 0.05 mm wide");
    expect_error(result, "4 more places");
}

// ---- layouts ----

Layout layout_of(std::vector<PatternPiece> pieces, int copies) {
    Layout layout;
    layout.margin_mm = 5.0;
    layout.prefix_names = true;
    layout.sheets.resize(1);
    DesignPattern design;
    design.file = "castle.xml";
    design.stem = "castle";
    design.pattern.pieces = std::move(pieces);
    for (int copy = 0; copy < copies; ++copy) {
        for (int p = 0; p < static_cast<int>(design.pattern.pieces.size()); ++p)
            layout.placements.push_back({0, p, copy, 0, {20.0 * copy, 20.0 * p}, {}});
    }
    layout.designs.push_back(std::move(design));
    return layout;
}

TEST(KerfLimits, PiecesAreMovedOnceHoweverManyCopiesThereAre) {
    Layout layout = layout_of({piece_of({closed(rectangle_at(0, 0, 10, 10))})}, 3);
    Diagnostics diagnostics;
    EXPECT_TRUE(apply_kerf(layout, {0.2, 0.2}, 2.0, diagnostics));
    EXPECT_FALSE(diagnostics.has_findings());
    EXPECT_EQ(layout.designs[0].pattern.pieces[0].cuts[0].points,
              (Ring{{-0.1, -0.1}, {10.1, -0.1}, {10.1, 10.1}, {-0.1, 10.1}}));
}

TEST(KerfLimits, EveryFailingPieceIsNamedOnceAndTheLayoutStays) {
    PatternPiece good = piece_of({closed(rectangle_at(0, 0, 10, 10))});
    PatternPiece bad =
        piece_of({closed(reversed(rectangle_at(2, 2, 0.1, 5)), 1), closed(rectangle_at(0, 0, 10, 10))});
    for (const int failing : {1, 7, 20, 25}) {
        std::vector<PatternPiece> pieces{good};
        for (int i = 0; i < failing; ++i) {
            pieces.push_back(bad);
            pieces.back().name = "p" + std::to_string(i);
        }
        Layout layout = layout_of(pieces, 4);
        Diagnostics diagnostics;
        EXPECT_FALSE(apply_kerf(layout, {0.2, 0.2}, 2.0, diagnostics));
        const auto found = diagnostics.sorted();
        ASSERT_EQ(found.size(), static_cast<std::size_t>(std::min(failing, 20)));
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].element, "p" + std::to_string(i));
            EXPECT_NE(found[i].message.find("castle:p" + std::to_string(i)), std::string::npos);
            EXPECT_EQ(found[i].file, "castle.xml");
        }
        EXPECT_EQ(found.back().message.find("(5 more pieces are not listed)") != std::string::npos,
                  failing == 25);
        EXPECT_EQ(layout.designs[0].pattern.pieces[0].cuts[0].points, good.cuts[0].points);
    }
}

TEST(KerfLimits, NeighboursMustBeAsFarApartAsTheKerfIsWide) {
    const PatternPiece plain = piece_of({closed(rectangle_at(0, 0, 10, 10))});
    const PatternPiece holed =
        piece_of({closed(reversed(rectangle_at(2, 2, 5, 5)), 1), closed(rectangle_at(0, 0, 10, 10))});
    const auto works = [](const PatternPiece& piece, int copies, const KerfWidths& kerf, double spacing) {
        Layout layout = layout_of({piece}, copies);
        Diagnostics diagnostics;
        const bool good = apply_kerf(layout, kerf, spacing, diagnostics);
        const auto found = diagnostics.sorted();
        EXPECT_EQ(found.size(), good ? 0U : 1U);
        if (!good) {
            EXPECT_EQ(found[0].code, "kerf-too-wide");
            EXPECT_NE(found[0].hints.at(0).find("--spacing"), std::string::npos);
        }
        return good;
    };
    EXPECT_FALSE(works(plain, 2, {0.2, 0.2}, 0.1));
    EXPECT_TRUE(works(plain, 2, {0.2, 0.2}, 0.2));
    EXPECT_TRUE(works(plain, 1, {0.2, 0.2}, 0.1));  // no neighbour
    EXPECT_TRUE(works(plain, 2, {0.4, 0.2}, 0.2));
    EXPECT_FALSE(works(holed, 2, {0.4, 0.2}, 0.2));  // one might lie in the other's hole
    EXPECT_TRUE(works(holed, 2, {0.4, 0.2}, 0.3));
}

// Two diamonds, tip to tip, on a sheet that has just their size and the margin. A tip of 70° moves by
// 0.5 kerf / sin 35°, which is 0.872 kerf.
std::vector<Diagnostic> diamonds(double spacing, double margin) {
    const double high = 20.0 * std::tan(35.0 * std::numbers::pi / 180.0);
    const PatternPiece diamond = piece_of({closed({{-20, 0}, {0, -high}, {20, 0}, {0, high}})});
    Layout layout = layout_of({diamond}, 2);
    layout.margin_mm = margin;
    layout.sheets[0].width_mm = 80.0 + spacing + 2.0 * margin;
    layout.sheets[0].height_mm = 2.0 * high + 2.0 * margin;
    layout.placements[0].offset = {margin + 20.0, margin + high};
    layout.placements[1].offset = {margin + 60.0 + spacing, margin + high};
    Diagnostics diagnostics;
    const bool good = apply_kerf(layout, {1.0, 1.0}, spacing, diagnostics);
    EXPECT_EQ(good, !diagnostics.has_errors());
    return diagnostics.sorted();
}

TEST(KerfLimits, CutsOfSharpCornersNeitherCrossNorLeaveTheSheet) {
    EXPECT_TRUE(diamonds(2.0, 1.0).empty());
    EXPECT_TRUE(diamonds(1.745, 0.873).empty());
    const auto crossing = diamonds(1.7, 1.0);
    ASSERT_EQ(crossing.size(), 1U);
    EXPECT_NE(crossing[0].message.find("lie 1.7 mm apart on sheet 1, cross"), std::string::npos)
        << crossing[0].message;
    EXPECT_EQ(crossing[0].hints.at(0), "take a --spacing of 2 mm, which is enough for all corners");
    const auto beyond = diamonds(2.0, 0.6);
    ASSERT_EQ(beyond.size(), 1U);
    EXPECT_NE(beyond[0].message.find("runs 0.272 mm beyond the edge of sheet 1"), std::string::npos)
        << beyond[0].message;
    EXPECT_NE(beyond[0].message.find("so does 1 more piece"), std::string::npos) << beyond[0].message;
    EXPECT_EQ(beyond[0].hints.at(0), "take a --margin of 1 mm, which is enough for all corners");
    EXPECT_EQ(diamonds(1.0, 0.5).size(), 2U);
}

// ---- real designs ----

TEST(KerfLimits, SamplesCanBeCutWithALaser) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(POPUP_SOURCE_DIR) + "/samples")) {
        const auto suffix = entry.path().extension();
        if (suffix == ".xml" || suffix == ".svg") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    ASSERT_GT(files.size(), 10U);
    for (const auto& file : files) {
        Diagnostics reading;
        const auto source = read_source(file.string(), reading);
        ASSERT_TRUE(source.has_value()) << file;
        CompileOptions options;
        options.until = Stage::pattern;
        const Compilation compiled = compile({*source}, options, {});
        ASSERT_EQ(compiled.designs.size(), 1U);
        ASSERT_TRUE(compiled.designs[0].pattern.has_value()) << file;
        for (const PatternPiece& piece : compiled.designs[0].pattern->pieces) {
            const Outcome result = attempt(piece, {0.2, 0.2});
            ASSERT_TRUE(result.cuts.has_value()) << file << ": " << result.found[0].message;
            for (std::size_t i = 0; i < piece.cuts.size(); ++i) {
                if (!piece.cuts[i].closed) continue;
                for (const Vec2 p : (*result.cuts)[i].points) {
                    EXPECT_GE(distance_to(piece.cuts[i].points, p), 0.1 - 1e-5) << file;
                }
            }
        }
    }
}

// Whether two edges that are not neighbours come nearer to each other than `width`.
bool has_narrow_place(const Ring& ring, double width) {
    const auto all = edges(ring);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 2; j < all.size(); ++j) {
            if (i == 0 && j + 1 == all.size()) continue;
            if (distance(all[i], all[j]) < width) return true;
        }
    }
    return false;
}

// Where tabs are trimmed by others wedges can be left between them that are too narrow for any tool. There
// are few, and only there may a piece be refused.
TEST(KerfLimits, TabsOfGeneratedDesignsCanBeCutWithALaser) {
    int pieces = 0;
    int refused = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const auto built = test::build(test::generate(seed, 4 + static_cast<int>(seed % 20)));
        ASSERT_TRUE(built.assembly.has_value());
        Diagnostics diagnostics;
        const auto pattern = make_pattern(*built.assembly, {}, diagnostics);
        ASSERT_TRUE(pattern.has_value());
        for (const PatternPiece& piece : pattern->pieces) {
            ++pieces;
            const Outcome result = attempt(piece, {0.2, 0.2});
            if (result.cuts) continue;
            ++refused;
            EXPECT_TRUE(std::any_of(
                piece.cuts.begin(), piece.cuts.end(),
                [](const Contour& cut) { return cut.closed && has_narrow_place(cut.points, 0.2); }))
                << seed << ": " << result.found[0].message;
        }
    }
    EXPECT_GT(pieces, 200);
    EXPECT_LE(refused, pieces / 100);
}

}  // namespace
}  // namespace popup
