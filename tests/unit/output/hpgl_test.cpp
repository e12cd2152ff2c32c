// HP-GL: followed by a plotter of this test's own; what it must have drawn is counted in the layout's
// pattern.
#include "output/hpgl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "support/profiles.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::pattern_lengths;
using test::pen_of;
using test::windowed_layout;
using test::with_slits;

// Half a unit in x and in y.
constexpr double kOff = 0.0177;

struct PenStroke {
    int pen = 0;
    std::vector<Vec2> points;  // mm

    [[nodiscard]] bool closed() const { return points.size() > 2 && points.front() == points.back(); }
    [[nodiscard]] double length() const {
        double sum = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
        return sum;
    }
};

struct Plotted {
    std::vector<PenStroke> strokes;
    std::size_t most_points = 0;  // of a command
    int last_pen = -1;
    bool down = false;

    [[nodiscard]] double length(int pen) const {
        double sum = 0.0;
        for (const PenStroke& stroke : strokes) sum += stroke.pen == pen ? stroke.length() : 0.0;
        return sum;
    }
    [[nodiscard]] std::size_t points(int pen) const {
        std::size_t sum = 0;
        for (const PenStroke& stroke : strokes) sum += stroke.pen == pen ? stroke.points.size() : 0;
        return sum;
    }
    [[nodiscard]] std::set<int> pens() const {
        std::set<int> all;
        for (const PenStroke& stroke : strokes) all.insert(stroke.pen);
        return all;
    }
};

// A plotter that knows five commands. All else fails the test.
Plotted plotted(const std::string& text) {
    Plotted plot;
    Vec2 at;
    int pen = 0;
    bool ready = false;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == '\n') {
            ++i;
            continue;
        }
        const std::size_t end = text.find(';', i);
        if (end == std::string::npos) {
            ADD_FAILURE() << "a command without an end";
            break;
        }
        const std::string command = text.substr(i, 2);
        std::vector<long> numbers;
        for (const char* p = text.data() + i + 2; p < text.data() + end;) {
            char* after = nullptr;
            numbers.push_back(std::strtol(p, &after, 10));
            EXPECT_NE(after, p) << text.substr(i, end - i);
            EXPECT_TRUE(*after == ',' || after == text.data() + end) << text.substr(i, end - i);
            p = after == p ? text.data() + end : after + (*after == ',' ? 1 : 0);
        }
        i = end + 1;
        if (command == "IN") {
            EXPECT_TRUE(numbers.empty());
            ready = true;
        } else if (command == "PA") {
            EXPECT_TRUE(ready && numbers.empty());
        } else if (command == "SP") {
            EXPECT_EQ(numbers.size(), 1U);
            EXPECT_FALSE(plot.down) << "a pen is changed on the paper";
            pen = static_cast<int>(numbers.at(0));
            EXPECT_TRUE(pen >= 0 && pen <= 8) << pen;
        } else if (command == "PU" || command == "PD") {
            const bool down = command == "PD";
            EXPECT_EQ(numbers.size() % 2, 0U);
            plot.most_points = std::max(plot.most_points, numbers.size() / 2);
            if (down && !plot.down) {
                EXPECT_GT(pen, 0) << "nothing in the holder";
                plot.strokes.push_back({pen, {at}});
            }
            plot.down = down;
            for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) {
                EXPECT_TRUE(numbers[k] >= 0 && numbers[k + 1] >= 0);
                const Vec2 next{0.025 * static_cast<double>(numbers[k]),
                                0.025 * static_cast<double>(numbers[k + 1])};
                if (down) {
                    EXPECT_NE(next, at) << "a step of no length";
                    plot.strokes.back().points.push_back(next);
                }
                at = next;
            }
        } else {
            ADD_FAILURE() << command;
        }
    }
    plot.last_pen = pen;
    return plot;
}

struct Written {
    std::vector<std::string> sheets;
    std::vector<Diagnostic> findings;
};

Written written(const Layout& layout, const Profile& profile, OutputOptions options = {}) {
    options.profile = profile;
    Diagnostics diagnostics;
    Written all;
    const std::vector<SheetFile> files = write_hpgl(layout, options, diagnostics).value();
    for (const SheetFile& file : files) all.sheets.push_back(file.bytes);
    all.findings = diagnostics.sorted();
    return all;
}

// Pens as the pattern has its lines; marks are looked at in sheet_notes_test.cpp.
Profile cutting_profile() {
    Profile profile = with_slits("lightburn");
    profile.marks_on = MarksOn::none;
    profile.away_folds = AwayFolds::whole;
    return profile;
}

TEST(Hpgl, PensDrawWhatThePatternHasToWithinHalfAUnit) {
    const Layout layout = windowed_layout();
    const std::vector<std::string> sheets = written(layout, cutting_profile()).sheets;
    ASSERT_EQ(sheets.size(), 2U);
    for (int sheet = 0; sheet < 2; ++sheet) {
        const Plotted plot = plotted(sheets[static_cast<std::size_t>(sheet)]);
        std::map<Operation, double> mm = pattern_lengths(layout, sheet);
        const std::map<int, double> expected{
            {1, mm[Operation::valley] + mm[Operation::mountain] + mm[Operation::seam]},
            {2, mm[Operation::slit]},
            {3, mm[Operation::inner_cut]},
            {4, mm[Operation::outer_cut]}};
        for (const auto& [pen, length] : expected) {
            // Each point may have moved, and with it the two lines that end there.
            EXPECT_NEAR(plot.length(pen), length, 2.0 * kOff * static_cast<double>(plot.points(pen))) << pen;
            EXPECT_EQ(plot.length(pen) > 0.0, length > 0.0) << pen;
        }
        for (const PenStroke& stroke : plot.strokes) EXPECT_EQ(stroke.closed(), stroke.pen >= 3);
    }
}

TEST(Hpgl, PointsLieWhereTheLayoutPutsThem) {
    const Plotted plot = plotted(written(windowed_layout(), cutting_profile()).sheets.front());
    Box outline;
    Box window;
    for (const PenStroke& stroke : plot.strokes) {
        for (const Vec2 p : stroke.points) {
            if (stroke.pen == 3) window.extend(p);
            if (stroke.pen == 4) outline.extend(p);
        }
    }
    EXPECT_EQ(outline.min, (Vec2{48.5, 25.0}));
    EXPECT_EQ(outline.max, (Vec2{248.5, 185.0}));
    EXPECT_NEAR(window.min.x, 148.5 - 90.011, 0.01251);
    EXPECT_NEAR(window.min.y, 105.0 + 30.007, 0.01251);
    EXPECT_NEAR(window.max.x, 148.5 - 60.003, 0.01251);
    EXPECT_NEAR(window.max.y, 105.0 + 60.019, 0.01251);
}

TEST(Hpgl, StaysOnTheSheetAndPutsThePenAway) {
    for (const Profile& profile : profile_table()) {
        const Layout layout = windowed_layout();
        for (const std::string& text : written(layout, profile).sheets) {
            EXPECT_TRUE(text.starts_with("IN;PA;")) << text.substr(0, 20);
            EXPECT_TRUE(text.ends_with("PU;SP0;\n"));
            const Plotted plot = plotted(text);
            EXPECT_FALSE(plot.strokes.empty());
            EXPECT_FALSE(plot.down);
            EXPECT_EQ(plot.last_pen, 0);
            EXPECT_LE(plot.most_points, 40U);
            for (const PenStroke& stroke : plot.strokes) {
                for (const Vec2 p : stroke.points) {
                    EXPECT_LE(p.x, 297.0);
                    EXPECT_LE(p.y, 210.0);
                }
            }
        }
    }
}

TEST(Hpgl, PensFollowTheOrderOfOperations) {
    const Plotted plot = plotted(written(windowed_layout(), cutting_profile()).sheets.front());
    std::vector<int> order;
    for (const PenStroke& stroke : plot.strokes) {
        if (order.empty() || order.back() != stroke.pen) order.push_back(stroke.pen);
    }
    EXPECT_EQ(order, (std::vector<int>{1, 2, 3, 4}));
}

// The second sheet has no slits and no holes, and its outlines keep their pen. Workshop draws notes, too:
// strokes and glue come first, texts are left out.
TEST(Hpgl, PensAreTheSameOnAllSheets) {
    const std::vector<std::string> cutting = written(windowed_layout(), cutting_profile()).sheets;
    EXPECT_EQ(plotted(cutting.back()).pens(), (std::set<int>{1, 4}));
    const std::vector<std::string> drawn = written(windowed_layout(), profile_table().front()).sheets;
    // draw 1, glue 2, valley 3, mountain 4, seam 5, cut 6.
    EXPECT_EQ(plotted(drawn.front()).pens(), (std::set<int>{1, 2, 3, 4, 6}));
    EXPECT_EQ(plotted(drawn.back()).pens(), (std::set<int>{4, 5, 6}));
}

TEST(Hpgl, WithMoreLayersThanPensAllThatIsPrintedIsOnePen) {
    Profile profile = with_slits("workshop");
    profile.folds = FoldStyle::both;
    profile.outlined_text = true;
    profile.marks = Marks::corners;
    for (const Operation operation : kOperations) pen_of(profile, operation).layer = to_string(operation);
    const Layout layout = windowed_layout();
    const Plotted plot = plotted(written(layout, profile).sheets.front());
    std::map<Operation, double> mm = pattern_lengths(layout, 0);
    const std::map<int, double> expected{{2, mm[Operation::valley]},
                                         {3, mm[Operation::mountain]},
                                         {6, mm[Operation::slit]},
                                         {7, mm[Operation::inner_cut]},
                                         {8, mm[Operation::outer_cut]}};
    for (const auto& [pen, length] : expected)
        EXPECT_NEAR(plot.length(pen), length, 2.0 * kOff * static_cast<double>(plot.points(pen))) << pen;
    EXPECT_GT(plot.length(1), 0.0);
    // Perforations are shorter than the folds they are on.
    EXPECT_GT(plot.length(5), 0.0);
    EXPECT_LT(plot.length(5), plot.length(2) + plot.length(3));
}

TEST(Hpgl, LettersAreDrawnOnlyWhereTheProfileOutlinesTexts) {
    Profile profile = profile_table().front();
    const auto near_name = [](const Plotted& plot) {
        return std::count_if(plot.strokes.begin(), plot.strokes.end(), [](const PenStroke& stroke) {
            const Vec2 p = stroke.points.front();
            return std::abs(p.x - 68.5) < 10.0 && std::abs(p.y - 175.0) < 4.0;
        });
    };
    EXPECT_EQ(near_name(plotted(written(windowed_layout(), profile).sheets.front())), 0);
    profile.outlined_text = true;
    // p, a, g and e: an outline and a hole each.
    EXPECT_EQ(near_name(plotted(written(windowed_layout(), profile).sheets.front())), 8);
}

TEST(Hpgl, LongLinesAreSplitAndStayOneLine) {
    Layout layout = windowed_layout();
    Contour& outline = layout.designs[0].pattern.pieces[0].cuts.back();
    constexpr int kCorners = 401;
    outline.points.clear();
    for (int i = 0; i < kCorners; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / kCorners;
        outline.points.push_back({90.0 * std::cos(turn), 75.0 * std::sin(turn)});
    }
    const Plotted plot = plotted(written(layout, cutting_profile()).sheets.front());
    std::vector<PenStroke> outlines;
    for (const PenStroke& stroke : plot.strokes) {
        if (stroke.pen == 4) outlines.push_back(stroke);
    }
    ASSERT_EQ(outlines.size(), 1U);
    EXPECT_EQ(outlines[0].points.size(), kCorners + 1U);
    EXPECT_TRUE(outlines[0].closed());
    EXPECT_EQ(plot.most_points, 40U);
    // Wherever the machine began: each point of the plot is where a corner is.
    for (const Vec2 p : outlines[0].points) {
        const bool found = std::any_of(outline.points.begin(), outline.points.end(), [p](Vec2 q) {
            return std::abs(q.x + 148.5 - p.x) < 0.01251 && std::abs(q.y + 105.0 - p.y) < 0.01251;
        });
        EXPECT_TRUE(found) << p.x << " " << p.y;
    }
}

TEST(Hpgl, PointsThatFallTogetherAreOneAndPricksAreLeftOut) {
    Layout layout = windowed_layout();
    PatternPiece& page = layout.designs[0].pattern.pieces[0];
    const std::size_t before =
        plotted(written(layout, profile_table().front()).sheets.front()).strokes.size();
    // In sheet coordinates from (148.5, 105), which is on a whole unit.
    page.cuts.push_back({{{30.0, 30.0}, {30.004, 30.003}}, false});
    page.cuts.push_back({{{30.0, 40.0}, {30.004, 40.003}, {31.0, 40.0}, {31.002, 40.0}}, false});
    // The plotter fails the test for steps of no length.
    const Plotted plot = plotted(written(layout, profile_table().front()).sheets.front());
    EXPECT_EQ(plot.strokes.size(), before + 1);
    const bool there = std::any_of(plot.strokes.begin(), plot.strokes.end(), [](const PenStroke& stroke) {
        return stroke.points.size() == 2 && distance(stroke.points[0], Vec2{178.5, 145.0}) < 1e-9 &&
               distance(stroke.points[1], Vec2{179.5, 145.0}) < 1e-9;
    });
    EXPECT_TRUE(there);
}

TEST(Hpgl, WhatLiesAHairBeyondTheSheetIsDrawnOnItsEdge) {
    Layout layout = windowed_layout();
    layout.placements[0].offset = {99.97, 79.98};
    // The plotter fails the test for negative numbers.
    Box outline;
    for (const PenStroke& stroke : plotted(written(layout, cutting_profile()).sheets.front()).strokes) {
        for (const Vec2 p : stroke.points) outline.extend(p);
    }
    EXPECT_EQ(outline.min, (Vec2{0.0, 0.0}));
}

TEST(Hpgl, SaysWhenASheetGoesBeyondTheFirstPlottersRange) {
    Layout layout = windowed_layout();
    EXPECT_TRUE(written(layout, cutting_profile()).findings.empty());
    layout.sheets[0].width_mm = 1000.0;
    EXPECT_TRUE(written(layout, cutting_profile()).findings.empty()) << "nothing lies out there";
    layout.placements[0].offset.x = 800.0;
    const Written wide = written(layout, cutting_profile());
    ASSERT_EQ(wide.findings.size(), 1U);
    EXPECT_EQ(wide.findings[0].code, "plotter-range");
    EXPECT_EQ(wide.findings[0].severity, Severity::remark);
    EXPECT_NE(wide.findings[0].message.find("900.0 mm"), std::string::npos) << wide.findings[0].message;
    Box outline;
    for (const PenStroke& stroke : plotted(wide.sheets.front()).strokes) {
        for (const Vec2 p : stroke.points) outline.extend(p);
    }
    EXPECT_NEAR(outline.max.x, 900.0, 1e-9);
}

TEST(Hpgl, AnEmptySheetIsAPlotOfNothing) {
    Layout layout = windowed_layout();
    layout.placements.clear();
    for (const std::string& text : written(layout, cutting_profile()).sheets)
        EXPECT_TRUE(plotted(text).strokes.empty());
}

TEST(Hpgl, IsTheSameEachTime) {
    for (const Profile& profile : profile_table())
        EXPECT_EQ(written(windowed_layout(), profile).sheets, written(windowed_layout(), profile).sheets);
}

}  // namespace
}  // namespace popup
