// Curves on sheets: a drawing's curves are written as curves by every format that has them, and counted here.
#include "output/sheet_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "output/arcs.h"
#include "output/dxf.h"
#include "output/lightburn.h"
#include "output/pdf.h"
#include "output/sheet_drawing.h"
#include "output/svg.h"
#include "popup/compile.h"
#include "support/drawings.h"
#include "support/profiles.h"
#include "support/restored.h"
#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::bytes_of;

// A heart of four cubics, in which there are a circle of twelve (30° each), and a cut of one; and an
// outline of two half circles and two lines. 29 curves, of which 24 are parts of circles.
constexpr std::size_t kCubics = 5;
constexpr std::size_t kRound = 24;
constexpr const char* kShapes =
    "<path d='M50 80 C20 60 10 40 30 30 C40 25 50 35 50 40 C50 35 60 25 70 30 C90 40 80 60 50 80 Z'/>"
    "<circle cx='35' cy='45' r='6'/><path d='M50 50 C55 60 60 40 65 50'/>"
    "<path d='M10 85 H40 A5 5 0 0 1 40 95 H10 A5 5 0 0 1 10 85 Z'/>";

Layout layout_of(const std::string& body, double scale = 1.0, double turn = 0.0) {
    CompileOptions options;
    options.layout.scale = scale;
    std::vector<Source> sources;
    sources.push_back({"drawing.svg", test::drawing(body)});
    Compilation made = compile(std::move(sources), options, {});
    EXPECT_FALSE(made.has_errors());
    for (Placement& placement : made.layout->placements) {
        placement.angle = Angle::degrees(turn);
        placement.offset = {100.0, 100.0};
    }
    return std::move(*made.layout);
}

SheetDrawing drawn(const Layout& layout, const Profile& profile, bool back = false) {
    OutputOptions options;
    options.profile = profile;
    SheetView view;
    view.back = back;
    return draw_sheet(layout, options, view);
}

std::size_t count(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()));
}

// The furthest that a run's curves are from its points.
double strays(const SheetDrawing& drawing, const popup::Run& run) {
    const std::span<const Vec2> points = drawing.points_of(run);
    Subpath path = drawing.path_of(run);
    if (path.closed && path.steps.back().to != path.start) path.steps.push_back({path.start, false, {}, {}});
    Restored restored{run.start, {}};
    for (const PathStep& step : path.steps) {
        const auto at = std::find(points.begin(), points.end(), step.to);
        if (at == points.end()) return HUGE_VAL;
        restored.steps.push_back(
            {static_cast<std::size_t>(at - points.begin()), step.curve, step.control_1, step.control_2});
    }
    return test::strays(points, run.closed, restored);
}

std::size_t curves_in(const SheetDrawing& drawing) {
    std::size_t sum = 0;
    for (const PathStep& step : drawing.steps) sum += step.curve ? 1 : 0;
    return sum;
}

TEST(SheetCurves, EveryCurveOfADrawingIsOneInSvg) {
    const auto sheets = bytes_of([&] {
        Diagnostics diagnostics("a");
        return write_svg(layout_of(kShapes), {}, diagnostics);
    }());
    EXPECT_EQ(count(sheets.at(0), "C-?[\\d.]+,-?[\\d.]+ "), kCubics + kRound);
}

TEST(SheetCurves, EveryCurveOfADrawingIsOneInLightBurn) {
    Diagnostics diagnostics("a");
    const auto sheets = bytes_of(write_lightburn(layout_of(kShapes), {}, diagnostics));
    EXPECT_EQ(count(sheets.at(0), "B\\d+ \\d+"), kCubics + kRound);
    EXPECT_EQ(count(sheets.at(0), "c0x-?[\\d.]+c0y"), kCubics + kRound);
    EXPECT_EQ(count(sheets.at(0), "c1x-?[\\d.]+c1y"), kCubics + kRound);
}

TEST(SheetCurves, ArcsAreBulgesAndOtherCurvesSplinesInDxf) {
    Diagnostics diagnostics("a");
    const std::string text = bytes_of(write_dxf(layout_of(kShapes), {}, diagnostics)).at(0);
    EXPECT_EQ(count(text, "\nSPLINE\n"), 2U);
    // Of four curves and of one: as many controls as there are, three a curve and one.
    EXPECT_EQ(count(text, "\n73\n13\n"), 1U);
    EXPECT_EQ(count(text, "\n73\n4\n"), 1U);
    // Half circles have a bulge of 1. The outline begins in the middle of one: that is two quarters.
    EXPECT_EQ(count(text, "\n42\n-?(1|1\\.0000|0\\.9999)\\d*\n"), 3U);
    EXPECT_EQ(count(text, "\n42\n-?0\\.41421\\d*\n"), 2U);
}

TEST(SheetCurves, EveryCurveOfADrawingIsOneInPdf) {
    if (!test::have_program("qpdf")) GTEST_SKIP() << "qpdf is not installed";
    const test::ScratchDirectory scratch;
    for (const char* name : {"workshop", "print-and-cut"}) {
        const Profile* profile = find_profile(name);
        ASSERT_NE(profile, nullptr) << name;
        Diagnostics diagnostics("a");
        OutputOptions options;
        options.profile = *profile;
        test::write_file(scratch / "a.pdf",
                         bytes_of(write_pdf(layout_of(kShapes), options, diagnostics)).at(0));
        const auto unpacked = test::run({"qpdf", "--qdf", "--object-streams=disable",
                                         (scratch / "a.pdf").string(), (scratch / "b.pdf").string()});
        EXPECT_EQ(unpacked.exit, 0);
        // Six numbers and the operator, wherever lines are broken.
        std::size_t curves = 0;
        std::size_t numbers = 0;
        std::istringstream words(test::read_file(scratch / "b.pdf"));
        for (std::string word; words >> word;) {
            if (word == "c" && numbers >= 6) ++curves;
            numbers = word.find_first_not_of("-.0123456789") == std::string::npos ? numbers + 1 : 0;
        }
        EXPECT_GE(curves, kCubics + kRound) << name;
        // In machine order a contour may begin in the middle of a curve.
        EXPECT_LE(curves, kCubics + kRound + (profile->machine_order ? 3 : 0)) << name;
    }
}

TEST(SheetCurves, ProfilesTurnsBacksAndScalesKeepThemNearTheirChords) {
    for (const double scale : {1.0, 0.37}) {
        for (const double turn : {0.0, 33.3, 270.0}) {
            const Layout layout = layout_of(kShapes, scale, turn);
            for (const Profile& profile : profile_table()) {
                for (const bool back : {false, true}) {
                    const SheetDrawing drawing = drawn(layout, profile, back);
                    if (back && drawing.runs.empty()) continue;
                    SCOPED_TRACE(profile.name + (back ? ", back" : ""));
                    for (const SheetShape& shape : drawing.shapes) {
                        for (const popup::Run& run : drawing.runs_of(shape)) {
                            if (run.steps > 0) {
                                EXPECT_LE(strays(drawing, run), 0.011);
                            }
                        }
                    }
                    if (back) continue;
                    // In machine order a contour may begin in the middle of a curve.
                    EXPECT_GE(curves_in(drawing), kCubics + kRound);
                    EXPECT_LE(curves_in(drawing), kCubics + kRound + (profile.machine_order ? 3 : 0));
                }
            }
        }
    }
}

TEST(SheetCurves, PointsAndLengthsAreThoseOfChords) {
    const Layout layout = layout_of(kShapes);
    Layout straight = layout;
    for (DesignPattern& design : straight.designs) design.pattern.curves = {};
    for (const Profile& profile : profile_table()) {
        const SheetDrawing curved = drawn(layout, profile);
        const SheetDrawing chords = drawn(straight, profile);
        EXPECT_EQ(curved.points, chords.points);
        EXPECT_TRUE(chords.steps.empty());
        ASSERT_EQ(curved.shapes.size(), chords.shapes.size());
        for (std::size_t i = 0; i < curved.shapes.size(); ++i)
            EXPECT_EQ(curved.length_of(curved.shapes[i]), chords.length_of(chords.shapes[i]));
    }
}

TEST(SheetCurves, ACurveThatEndsWhereItBeginsHasTwoVerticesInLightBurn) {
    Diagnostics diagnostics("a");
    const auto sheets =
        bytes_of(write_lightburn(layout_of("<path d='M50 20 C90 80 10 80 50 20 Z'/>"), {}, diagnostics));
    EXPECT_NE(sheets.at(0).find("<PrimList>B0 1B1 0</PrimList>"), std::string::npos) << sheets.at(0);
}

// --- arcs

Subpath only_subpath(const std::string& data) {
    Path path;
    EXPECT_FALSE(parse_path(data, path));
    return path.subpaths().at(0);
}

TEST(SheetCurves, CurvesOnOneCircleAreOneArc) {
    const auto round = as_arcs(only_subpath("M0 0 H10 A5 5 0 0 1 10 10 H0 A5 5 0 0 1 0 0 Z"));
    ASSERT_TRUE(round);
    ASSERT_EQ(round->size(), 4U);
    EXPECT_NEAR((*round)[1].bulge, 1.0, 1e-5);
    EXPECT_NEAR((*round)[3].bulge, 1.0, 1e-5);
    EXPECT_EQ((*round)[0].bulge, 0.0);
    // A quarter the other way round, open.
    const auto quarter = as_arcs(only_subpath("M0 0 A20 20 0 0 0 20 20"));
    ASSERT_TRUE(quarter);
    ASSERT_EQ(quarter->size(), 2U);
    EXPECT_NEAR((*quarter)[0].bulge, -std::tan(std::acos(-1.0) / 8.0), 1e-5);
}

TEST(SheetCurves, WhatIsNoCircleIsNoArc) {
    EXPECT_FALSE(as_arcs(only_subpath("M0 0 A20 15 0 0 0 20 20")));
    EXPECT_FALSE(as_arcs(only_subpath("M0 0 C10 10 20 -10 30 0")));
    EXPECT_FALSE(as_arcs(only_subpath("M0 0 L5 5 C10 10 20 0 30 0")));
}

}  // namespace
}  // namespace popup
