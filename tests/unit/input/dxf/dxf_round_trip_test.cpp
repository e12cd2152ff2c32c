// Sheets that are written as DXF and read back: the same lines at the same places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "output/dxf.h"
#include "popup/compile.h"
#include "support/dxf_text.h"
#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using drawing::Named;

double length_of(const drawing::TracedLine& line) {
    double sum = line.closed ? distance(line.points.back(), line.points.front()) : 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i) sum += distance(line.points[i - 1], line.points[i]);
    return sum;
}

TEST(DxfRoundTrip, EveryCornerComesBack) {
    const Layout layout = test::example_layout();
    Diagnostics diagnostics;
    const auto files = write_dxf(layout, {}, diagnostics);
    ASSERT_TRUE(files);
    ASSERT_EQ(files->size(), layout.sheets.size());
    for (std::size_t sheet = 0; sheet < files->size(); ++sheet) {
        const test::TracedDxf read = test::traced_dxf((*files)[sheet].bytes);
        ASSERT_TRUE(read.tracing) << read.told;
        std::vector<Vec2> wanted;
        for (const Placement& placed : layout.placements) {
            if (placed.sheet != static_cast<int>(sheet)) continue;
            const PatternPiece& piece =
                layout.designs[0].pattern.pieces[static_cast<std::size_t>(placed.piece)];
            for (const Contour& cut : piece.cuts) {
                for (const Vec2 p : cut.points) wanted.push_back(placed.apply(p));
            }
        }
        std::vector<Vec2> there;
        std::map<Named, double> lengths;
        for (const drawing::TracedLine& line : read.tracing->lines) {
            lengths[line.named] += length_of(line);
            if (line.named == Named::cut) there.insert(there.end(), line.points.begin(), line.points.end());
        }
        const auto near = [](Vec2 p, const std::vector<Vec2>& all) {
            return std::any_of(all.begin(), all.end(), [p](Vec2 q) { return distance(p, q) <= 1e-6; });
        };
        for (const Vec2 p : wanted) EXPECT_TRUE(near(p, there)) << p.x << " " << p.y;
        for (const Vec2 p : there) EXPECT_TRUE(near(p, wanted)) << p.x << " " << p.y;
        const auto drawn = test::pattern_lengths(layout, static_cast<int>(sheet));
        const auto of = [&drawn](Operation one) { return drawn.count(one) == 0 ? 0.0 : drawn.at(one); };
        EXPECT_NEAR(lengths[Named::valley], of(Operation::valley), 1e-5);
        EXPECT_NEAR(lengths[Named::mountain], of(Operation::mountain), 1e-5);
        EXPECT_NEAR(lengths[Named::cut],
                    of(Operation::slit) + of(Operation::inner_cut) + of(Operation::outer_cut), 1e-5);
    }
}

std::vector<double> areas_of(const Compilation& run) {
    std::vector<double> areas;
    for (const PatternPiece& piece : run.designs.at(0).pattern.value().pieces) {
        double sum = 0.0;
        for (const Contour& cut : piece.cuts) {
            if (cut.closed) sum += (cut.depth % 2 == 0 ? 1.0 : -1.0) * std::abs(signed_area(cut.points));
        }
        areas.push_back(sum);
    }
    std::sort(areas.begin(), areas.end());
    return areas;
}

// Curved parts: arcs come back as bulges, to 0.001 mm, and other curves as splines.
TEST(DxfRoundTrip, CurvedPartsAreAsLarge) {
    const std::string path = std::string(POPUP_SOURCE_DIR) + "/samples/parts.svg";
    const Compilation first = compile({Source{"parts.svg", test::read_file(path)}}, {}, {});
    ASSERT_TRUE(first.layout);
    Diagnostics diagnostics;
    const auto files = write_dxf(*first.layout, {}, diagnostics);
    ASSERT_TRUE(files);
    ASSERT_EQ(files->size(), 1U);
    CompileOptions options;
    options.read.drawing.as = DrawnAs::parts;
    const Compilation second = compile({Source{"parts.dxf", files->front().bytes}}, options, {});
    ASSERT_TRUE(second.layout) << test::findings(second.designs.at(0).diagnostics);
    const std::vector<double> a = areas_of(first);
    const std::vector<double> b = areas_of(second);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-3 * std::sqrt(a[i]) * 12.0) << i;
}

// A grid of n × n lines.
std::string dashes(int n) {
    std::string rows;
    for (int i = 0; i < n * n; ++i) {
        const int x = i % n;
        const int y = i / n;
        rows += "0\nLINE\n8\nCUT\n10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + ".5\n11\n" +
                std::to_string(x) + ".9\n21\n" + std::to_string(y) + ".5\n";
    }
    return "0\nSECTION\n2\nENTITIES\n" + rows + "0\nENDSEC\n0\nEOF\n";
}

TEST(DxfRoundTrip, ReadsManyEntitiesAndRefusesMore) {
    EXPECT_TRUE(test::traced_dxf(dashes(400)).tracing);
    // More than is read is refused, and not for want of memory.
    const test::TracedDxf most = test::traced_dxf(dashes(800));
    EXPECT_FALSE(most.tracing);
    EXPECT_NE(most.told.find("document-too-large"), std::string::npos);
}

}  // namespace
}  // namespace popup
