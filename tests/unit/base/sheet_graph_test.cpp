// The graph of a sheet's lines: which faces there are.
#include "base/geometry/sheet_graph.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "support/random.h"

namespace popup {
namespace {

TEST(SheetGraph, OpenLinesEncloseNothing) {
    test::Random random(3);
    for (int round = 0; round < 400; ++round) {
        const auto number = [&](double low, double high) { return low + (high - low) * random.unit(); };
        SheetLine slit;
        Vec2 at{number(40.0, 60.0), number(40.0, 60.0)};
        Vec2 way{number(1.0, 3.0), number(-3.0, 3.0)};
        // To the right all the way, so that it meets nothing.
        for (std::size_t i = 0; i < 3 + random.below(8); ++i) {
            slit.points.push_back(at);
            at = at + way;
            way = {number(0.1, 3.0), number(-3.0, 3.0)};
        }
        slit.element = 1;
        const std::vector<SheetLine> lines{{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}, true, kCut, 0}, slit};
        const auto graph = make_graph(lines);
        ASSERT_TRUE(graph);
        EXPECT_EQ(graph->faces(), 2) << "round " << round << ": the outside and the sheet";
        for (std::size_t i = 0; i < graph->edges.size(); ++i) {
            if (graph->edges[i].element != 1) continue;
            const int half = static_cast<int>(2 * i);
            EXPECT_EQ(graph->face_of(half), 1) << round;
            EXPECT_EQ(graph->face_of(half ^ 1), 1) << round;
        }
    }
}

}  // namespace
}  // namespace popup
