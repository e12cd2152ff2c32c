// A small Layout made by hand, with something in every layer, for tests of the sheet writers.
#pragma once

#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "popup/layout.h"
#include "popup/output.h"

namespace popup::test {

// The files of a sheet writer that must succeed, without their names.
inline std::vector<std::string> bytes_of(const std::optional<std::vector<SheetFile>>& files) {
    std::vector<std::string> bytes;
    for (const SheetFile& file : files.value()) bytes.push_back(file.bytes);
    return bytes;
}

inline Ring rectangle(double left, double low, double right, double high) {
    return {{left, low}, {right, low}, {right, high}, {left, high}};
}

// "page": 200 × 160 mm with two slits, folds, a drawn line, fills (one with a hole), and a target.
// "house": a gabled piece with a tab. Origins in the middle of the page, at the foot of the house.
inline Pattern example_pattern() {
    constexpr double kQuarter = std::numbers::pi / 2;
    Pattern pattern;
    pattern.plate_names = {"page/left", "page/right", "house/left", "house/right"};

    PatternPiece page;
    page.name = "page";
    page.cuts = {{{{-20, -10}, {25, -10}}, false, 1},
                 {{{-20, 20}, {25, 20}}, false, 1},
                 {rectangle(-100, -80, 100, 80), true}};
    page.lines = {{LineKind::valley, {{0, -80}, {0, -10}}, 0},
                  {LineKind::valley, {{0, 20}, {0, 80}}, 0},
                  {LineKind::mountain, {{5, -10}, {5, 20}}, 1},
                  {LineKind::valley, {{60, 0}, {61, 0.5}}, 1},
                  {LineKind::mark, {{-50, -70}, {-50, -60}}, 0}};
    PatternPrint yellow{Area{{rectangle(-20, -10, 5, 20), {}}, {0xff, 0xcc, 0x00}}, 0};
    // The hole runs the same way as the outline: filled by even-odd it is a hole all the same.
    PatternPrint brown{Area{{rectangle(5, -10, 25, 20), {rectangle(10, 0, 15, 5)}}, {0xcc, 0x66, 0x00}}, 1};
    page.prints = {yellow, brown, {Stroke{{{-90, -60}, {-70, -40}, {-50, -65}}, 0.7, {0x00, 0x99, 0x33}}, 0}};
    page.targets = {{{{40, -60}, {50, -56}, {50, -24}, {40, -20}}, 1}};
    page.labels = {{LabelKind::piece, "page", {-80, 70}, 4.0, 0.0},
                   {LabelKind::target, "1R", {45, -40}, 3.2, -kQuarter}};
    page.silhouette = {{rectangle(-100, -80, 100, 80), {}}};
    page.bounds = {{-100, -80}, {100, 80}};

    PatternPiece house;
    house.name = "house";
    house.cuts = {{{{0, 0}, {5, -10}, {35, -10}, {40, 0}, {40, 60}, {0, 75}, {-40, 60}, {-40, 0}}, true}};
    house.lines = {{LineKind::mountain, {{0, 0}, {0, 75}}, 2}, {LineKind::seam, {{0, 0}, {40, 0}}, 3}};
    house.prints = {{Area{{{{-40, 0}, {0, 0}, {0, 75}, {-40, 60}}, {}}, {0xd0, 0xe8, 0xff}}, 2},
                    {Area{{{{0, 0}, {5, -10}, {35, -10}, {40, 0}}, {}}, {0xa0, 0xc8, 0xf0}}, -1}};
    house.labels = {{LabelKind::piece, "house", {-20, 30}, 4.0, 0.0},
                    {LabelKind::tab, "1R", {20, -5}, 3.2, 0.0}};
    house.silhouette = {{house.cuts[0].points, {}}};
    house.bounds = {{-40, -10}, {40, 75}};

    pattern.pieces = {page, house};
    return pattern;
}

// Two A4 sheets: the page on the first; on the second the house as it is and, a second copy, turned by 90°.
inline Layout example_layout(const std::string& stem = "castle") {
    Layout layout;
    layout.margin_mm = 5;
    layout.sheets = {{297, 210, 0.5562, {200, 160}}, {297, 210, 0.2, {180, 110}}};
    layout.leftover.extend({192, 5});
    layout.leftover.extend({292, 205});
    layout.designs = {{stem + ".xml", stem, example_pattern()}};
    layout.placements = {{0, 0, 0, 0, {148.5, 105}, Angle::degrees(0)},
                         {0, 1, 0, 1, {60.25, 40.125}, Angle::degrees(0)},
                         {0, 1, 1, 1, {200, 100}, Angle::degrees(90)}};
    return layout;
}

// The example with a window in the page: something to cut out before the outline. Its corners are on no whole
// unit of a plotter.
inline Layout windowed_layout() {
    Layout layout = example_layout();
    PatternPiece& page = layout.designs[0].pattern.pieces[0];
    page.cuts.insert(page.cuts.begin(), {rectangle(-90.011, 30.007, -60.003, 60.019), true, 1});
    return layout;
}

// Lengths of folds and cuts on one sheet, straight from the pattern. All open cuts are slits.
inline std::map<Operation, double> pattern_lengths(const Layout& layout, int sheet) {
    std::map<Operation, double> all;
    for (const Placement& placement : layout.placements) {
        if (placement.sheet != sheet) continue;
        const PatternPiece& piece =
            layout.designs[0].pattern.pieces[static_cast<std::size_t>(placement.piece)];
        for (const Contour& cut : piece.cuts) {
            double sum = 0.0;
            for (std::size_t i = 1; i < cut.points.size(); ++i)
                sum += distance(cut.points[i - 1], cut.points[i]);
            if (cut.closed) sum += distance(cut.points.back(), cut.points.front());
            all[!cut.closed      ? Operation::slit
                : cut.depth == 0 ? Operation::outer_cut
                                 : Operation::inner_cut] += sum;
        }
        for (const PatternLine& line : piece.lines) {
            const double mm = distance(line.at.a, line.at.b);
            if (line.kind == LineKind::valley) all[Operation::valley] += mm;
            if (line.kind == LineKind::mountain) all[Operation::mountain] += mm;
            if (line.kind == LineKind::seam) all[Operation::seam] += mm;
        }
    }
    return all;
}

}  // namespace popup::test
