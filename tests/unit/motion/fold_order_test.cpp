// The order in which the folds of a sheet go.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/motion.h"
#include "support/brute_force.h"
#include "support/designs.h"

namespace popup {
namespace {

constexpr double kGap = 1.0;  // between flaps

void cut(CreasePattern& pattern, const std::vector<Vec2>& points) {
    pattern.lines.push_back({points, false, CreaseUse::cut});
}
void fold(CreasePattern& pattern, Vec2 a, Vec2 b) {
    pattern.lines.push_back({{a, b}, false, CreaseUse::valley, 90.0});
}

// A carton as they are sent by post: four walls and a strip to glue in a row, with flaps at both ends of each
// wall that reach to the middle of the box.
CreasePattern carton(double length, double width, double height) {
    CreasePattern pattern;
    const double flap = 0.5 * width - 0.5;
    const std::vector<double> walls{length, width, length, width};
    cut(pattern, {{0.0, 0.0}, {-12.0, 4.0}, {-12.0, height - 4.0}, {0.0, height}});
    double x = 0.0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const double wide = walls[i];
        fold(pattern, {x, 0.0}, {x, height});
        for (const bool top : {false, true}) {
            const double y = top ? height : 0.0;
            const double out = top ? height + flap : -flap;
            fold(pattern, {x + kGap, y}, {x + wide - kGap, y});
            cut(pattern,
                {{x, y}, {x + kGap, y}, {x + kGap, out}, {x + wide - kGap, out}, {x + wide - kGap, y}});
            cut(pattern, {{x + wide - kGap, y}, {x + wide, y}});
        }
        x += wide;
    }
    cut(pattern, {{x, 0.0}, {x, height}});
    return pattern;
}

Assembly folded(const CreasePattern& pattern) {
    Diagnostics diagnostics("sheet");
    auto assembly = fold_sheet(pattern, {}, diagnostics);
    EXPECT_TRUE(assembly) << test::findings(diagnostics);
    EXPECT_FALSE(diagnostics.has_findings()) << test::findings(diagnostics);
    return assembly ? std::move(*assembly) : Assembly{};
}

std::vector<Frame> frames_at(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames));
    return frames;
}

std::string ordered(Assembly& assembly) {
    Diagnostics diagnostics("sheet");
    order_folds(assembly, {}, diagnostics);
    return test::findings(diagnostics);
}

void expect_same_at(const Assembly& before, const Assembly& after, double deg) {
    const std::vector<Frame> a = frames_at(before, deg);
    const std::vector<Frame> b = frames_at(after, deg);
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (const Vec2 p : before.plates[i].outline.outer)
            EXPECT_LT(distance(a[i].point(p), b[i].point(p)), 1e-9) << before.plates[i].name << " at " << deg;
    }
}

TEST(FoldOrder, ClosesACartonWhoseFlapsWouldMeet) {
    const Assembly at_once = folded(carton(60.0, 40.0, 50.0));
    EXPECT_FALSE(examine(at_once, {}).contacts.empty());
    Assembly box = at_once;
    const std::string told = ordered(box);
    EXPECT_NE(told.find("folds-in-order"), std::string::npos) << told;
    expect_same_at(at_once, box, 0.0);
    expect_same_at(at_once, box, 180.0);
    Diagnostics diagnostics("box");
    const auto motion = simulate(box, {}, diagnostics);
    ASSERT_TRUE(motion);
    EXPECT_EQ(test::findings(diagnostics), "");
    EXPECT_EQ(motion->examination->decided_up_to_deg, 180.0);
    if (!test::BruteForce::available()) GTEST_SKIP() << test::BruteForce::kMissing;
    const test::BruteForce brute(box);
    for (double deg = 0.0; deg <= 180.0; deg += 2.5) EXPECT_TRUE(brute.crossing_at(deg).empty()) << deg;
}

TEST(FoldOrder, LeavesWhatMayGoAtOnce) {
    CreasePattern pattern;
    pattern.lines.push_back({{{0, 0}, {90, 0}, {90, 40}, {0, 40}}, true, CreaseUse::cut});
    fold(pattern, {30, 0}, {30, 40});
    fold(pattern, {60, 0}, {60, 40});
    const Assembly before = folded(pattern);
    Assembly after = before;
    EXPECT_EQ(ordered(after), "");
    for (const double deg : {0.0, 45.0, 120.0, 180.0}) expect_same_at(before, after, deg);
}

// Two walls face each other, each with a flap that reaches through the other wall: in the end they cross,
// whatever goes first.
TEST(FoldOrder, LeavesWhatCrossesInTheEnd) {
    CreasePattern pattern;
    cut(pattern, {{0, 10}, {0, 0}, {40, 0}, {40, 10}});
    cut(pattern, {{0, 30}, {0, 40}, {40, 40}, {40, 30}});
    cut(pattern, {{40, 10}, {65, 10}, {115, 10}, {115, 30}, {65, 30}, {40, 30}});
    cut(pattern, {{0, 10}, {-25, 10}, {-25, 30}, {0, 30}});
    fold(pattern, {0, 10}, {0, 30});
    fold(pattern, {40, 10}, {40, 30});
    fold(pattern, {55, 10}, {55, 30});
    const Assembly before = folded(pattern);
    Diagnostics first("box");
    ASSERT_TRUE(simulate(before, {}, first));
    EXPECT_NE(test::findings(first).find("collision"), std::string::npos);
    Assembly after = before;
    ordered(after);
    Diagnostics diagnostics("box");
    ASSERT_TRUE(simulate(after, {}, diagnostics));
    EXPECT_NE(test::findings(diagnostics).find("until the card is closed"), std::string::npos)
        << test::findings(diagnostics);
}

}  // namespace
}  // namespace popup
