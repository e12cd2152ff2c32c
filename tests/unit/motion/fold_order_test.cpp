// The order in which the folds of a sheet go.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "support/brute_force.h"
#include "support/designs.h"
#include "support/dielines.h"

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

// What is said of the order, its hint included.
std::string ordered(Assembly& assembly) {
    Diagnostics diagnostics("sheet");
    order_folds(assembly, {}, diagnostics);
    std::string told;
    for (const Diagnostic& one : diagnostics.sorted()) {
        told += one.code + ": " + one.message;
        for (const std::string& hint : one.hints) told += "; " + hint;
    }
    return told;
}

// From where to where on the way of a sheet a panel turns against what it hangs on: 0 flat, 1 folded.
struct Turns {
    double begin = 2.0, end = -1.0;
};
std::map<std::string, Turns> turns_of(const Assembly& assembly) {
    std::map<std::string, Turns> all;
    for (const Joint& joint : assembly.joints) {
        const auto* const folded = std::get_if<Folded>(&joint.how);
        if (folded == nullptr) continue;
        const std::string& name = assembly.plates[static_cast<std::size_t>(folded->plate)].name;
        Turns& turns = all[name.substr(name.find('/') + 1)];
        for (std::size_t i = 1; i < folded->law.size(); ++i) {
            const Vec2 low = folded->law[i - 1];
            const Vec2 high = folded->law[i];
            if (std::abs(low.y - high.y) < 1e-9) continue;
            turns.begin = std::min(turns.begin, 1.0 - high.x / 180.0);
            turns.end = std::max(turns.end, 1.0 - low.x / 180.0);
        }
    }
    return all;
}

// The first is folded when the second begins to.
void expect_before(const Assembly& assembly, const std::string& first, const std::string& second) {
    const std::map<std::string, Turns> turns = turns_of(assembly);
    ASSERT_TRUE(turns.contains(first) && turns.contains(second)) << first << ", " << second;
    EXPECT_LE(turns.at(first).end, turns.at(second).begin + 1e-9) << first << ", " << second;
}

// Four walls with a glue flap; a lid with a tuck on either end of the first, dust flaps on the walls beside.
// `dust`: at their ends, as much narrower than their walls as lets a tuck go by.
CreasePattern tuck_end(double length, double width, double height, double dust) {
    CreasePattern pattern;
    cut(pattern, {{0.0, 0.0}, {-12.0, 4.0}, {-12.0, height - 4.0}, {0.0, height}});
    double x = 0.0;
    for (const int wall : {0, 1, 2, 3}) {
        const double wide = wall % 2 == 0 ? length : width;
        const double end = x + wide;
        fold(pattern, {x, 0.0}, {x, height});
        for (const double way : {-1.0, 1.0}) {
            const double y = way > 0.0 ? height : 0.0;
            const auto out = [&](double at, double by) { return Vec2{at, y + way * by}; };
            if (wall == 0) {
                fold(pattern, out(x, 0.0), out(end, 0.0));
                fold(pattern, out(x, width), out(end, width));
                cut(pattern, {out(x, 0.0), out(x, width), out(x + 4.0, width + 12.0),
                              out(end - 4.0, width + 12.0), out(end, width), out(end, 0.0)});
            } else if (wall == 2) {
                cut(pattern, {out(x, 0.0), out(end, 0.0)});
            } else {
                fold(pattern, out(x + dust, 0.0), out(end - dust, 0.0));
                cut(pattern, {out(x, 0.0), out(x + dust, 0.0), out(x + 6.0, 18.0), out(end - 6.0, 18.0),
                              out(end - dust, 0.0), out(end, 0.0)});
            }
        }
        x = end;
    }
    cut(pattern, {{x, 0.0}, {x, height}});
    return pattern;
}

void expect_clear(const Assembly& assembly) {
    const Examination found = examine(assembly, {});
    EXPECT_TRUE(found.contacts.empty());
    EXPECT_TRUE(found.undecided.empty());
    EXPECT_EQ(found.decided_up_to_deg, 180.0);
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

// Nothing would pass through anything, and yet nobody could reach the strip that is glued.
TEST(FoldOrder, ClosesABoxAfterItsWallsStand) {
    constexpr double kSide = 30.0, kHeight = 40.0;
    CreasePattern pattern;
    cut(pattern, {{0.0, 0.0}, {-10.0, 4.0}, {-10.0, kHeight - 4.0}, {0.0, kHeight}});
    cut(pattern, {{6 * kSide, 0.0}, {6 * kSide, kHeight}});
    for (int i = 0; i < 6; ++i) {
        const double x = kSide * i;
        pattern.lines.push_back({{{x, 0.0}, {x, kHeight}}, false, CreaseUse::valley, 60.0});
        if (i != 2) cut(pattern, {{x, 0.0}, {x + kSide, 0.0}});
        if (i != 2) cut(pattern, {{x, kHeight}, {x + kSide, kHeight}});
    }
    const double mid = 2.5 * kSide, wide = kSide, far = kSide * std::sqrt(3.0);
    for (const double way : {-1.0, 1.0}) {
        const double y = way > 0.0 ? kHeight : 0.0;
        fold(pattern, {mid - 0.5 * kSide, y}, {mid + 0.5 * kSide, y});
        cut(pattern, {{mid - 0.5 * kSide, y},
                      {mid - wide, y + 0.5 * way * far},
                      {mid - 0.5 * kSide, y + way * far},
                      {mid + 0.5 * kSide, y + way * far},
                      {mid + wide, y + 0.5 * way * far},
                      {mid + 0.5 * kSide, y}});
    }
    const Assembly at_once = folded(pattern);
    expect_clear(at_once);
    Assembly box = at_once;
    const std::string told = ordered(box);
    EXPECT_NE(told.find("as a box is closed, in 3 steps"), std::string::npos) << told;
    // The bottom is the largest panel and stays: the wall that it hangs on turns.
    expect_before(box, "glue-flap", "wall-3");
    expect_before(box, "wall-3", "top");
    expect_same_at(at_once, box, 0.0);
    expect_same_at(at_once, box, 180.0);
    expect_clear(box);
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
    const std::string told = ordered(after);
    EXPECT_EQ(told.find("fold it in that order, too"), std::string::npos) << told;
    Diagnostics diagnostics("box");
    ASSERT_TRUE(simulate(after, {}, diagnostics));
    EXPECT_NE(test::findings(diagnostics).find("until the card is closed"), std::string::npos)
        << test::findings(diagnostics);
}

// Plates without thickness pass through nothing as they come to lie on one another, whichever comes first.
TEST(FoldOrder, FoldsInnerFlapsBeforeThoseThatLieOnThem) {
    Assembly box = folded(carton(60.0, 40.0, 50.0));
    ASSERT_NE(ordered(box).find("fold it in that order, too"), std::string::npos);
    for (const std::string end : {"top", "bottom"}) {
        for (const std::string& inner : std::vector<std::string>{"left", "right"}) {
            for (const std::string outer : {"front", "back"})
                expect_before(box, end + "-flap-" + inner, end + "-flap-" + outer);
        }
    }
    expect_before(box, "glue-flap", "top-flap-front");
    expect_clear(box);
}

TEST(FoldOrder, FoldsDustFlapsBeforeLidsAndTucksLast) {
    // Where dust flaps are as wide as their walls, paper gives way: the tuck goes by itself.
    for (const double dust : {0.0, 1.0}) {
        SCOPED_TRACE(dust);
        Assembly box = folded(tuck_end(60.0, 30.0, 90.0, dust));
        const std::string told = ordered(box);
        EXPECT_NE(told.find("fold it in that order, too"), std::string::npos) << told;
        EXPECT_EQ(told.find("top-tuck to") != std::string::npos, dust > 0.0) << told;
        for (const std::string end : {"top", "bottom"}) {
            for (const std::string& inner : std::vector<std::string>{
                     end + "-dust-flap-left", end + "-dust-flap-right", "left", "right", "back", "glue-flap"})
                expect_before(box, inner, end);
            EXPECT_GE(turns_of(box).at(end + "-tuck").end, turns_of(box).at(end).end);
        }
        expect_clear(box);
    }
}

// Corners lie between the two layers of a wall that is rolled in.
TEST(FoldOrder, RollsWallsInOverCorners) {
    CreasePattern tray;
    constexpr double kWide = 100.0, kDeep = 70.0, kHigh = 25.0, kCorner = 20.0;
    const std::array<Vec2, 4> base{Vec2{0, 0}, {kWide, 0}, {kWide, kDeep}, {0, kDeep}};
    for (std::size_t i = 0; i < base.size(); ++i) fold(tray, base.at(i), base.at((i + 1) % base.size()));
    for (const double way : {-1.0, 1.0}) {
        const double y = way > 0.0 ? kDeep : 0.0;
        const auto out = [&](double at, double by) { return Vec2{at, y + way * by}; };
        cut(tray, {out(0, 0), out(-kCorner, 2), out(-kCorner, kHigh - 2), out(0, kHigh), out(kWide, kHigh),
                   out(kWide + kCorner, kHigh - 2), out(kWide + kCorner, 2), out(kWide, 0)});
        fold(tray, out(0, 0), out(0, kHigh));
        fold(tray, out(kWide, 0), out(kWide, kHigh));
        const double x = way > 0.0 ? kWide : 0.0;
        const auto aside = [&](double by, double at) { return Vec2{x + way * by, at}; };
        const double in = 2 * kHigh;
        fold(tray, aside(kHigh, 0.5), aside(kHigh, kDeep - 0.5));
        fold(tray, aside(kHigh + 1, 0.5), aside(kHigh + 1, kDeep - 0.5));
        cut(tray, {aside(0, 0), aside(kHigh, 0), aside(kHigh, 0.5), aside(in, 0.5), aside(in, kDeep - 0.5),
                   aside(kHigh, kDeep - 0.5), aside(kHigh, kDeep), aside(0, kDeep)});
    }
    Assembly box = folded(tray);
    const std::string told = ordered(box);
    EXPECT_NE(told.find("fold it in that order, too"), std::string::npos) << told;
    for (const std::string end : {"front", "back"}) {
        for (const std::string side : {"left", "right"})
            expect_before(box, fmt::format("{}-corner-{}", end, side), side + "-lining");
    }
    expect_clear(box);
}

// As a maker closes it: walls up, corners in, sides rolled over them, and the lid last, with its tuck.
TEST(FoldOrder, ClosesTheLidOfAMailerLast) {
    for (const bool ears : {true, false}) {
        Diagnostics diagnostics("box.svg");
        ReadOptions options;
        options.drawing.as = DrawnAs::folded;
        const Reading reading =
            read_source_text({"box.svg", test::tucked_mailer(true, ears)}, options, diagnostics);
        ASSERT_TRUE(reading.creases) << test::findings(diagnostics);
        Assembly box = folded(*reading.creases);
        const std::string told = ordered(box);
        EXPECT_NE(told.find("fold it in that order, too"), std::string::npos) << told;
        std::vector<std::string> first{"front", "back"};
        for (const std::string side : {"left", "right"}) {
            for (const std::string end : {"front", "back"})
                expect_before(box, fmt::format("{}-corner-{}", end, side), side + "-lining");
            first.insert(first.end(), {side, side + "-rim", side + "-lining"});
            if (ears) first.insert(first.end(), {"lid-ear-" + side, "lid-tuck-ear-" + side});
        }
        for (const std::string& panel : first) expect_before(box, panel, "lid");
        EXPECT_GE(turns_of(box).at("lid-tuck").end, turns_of(box).at("lid").end) << told;
        expect_clear(box);
    }
}

// 0 walls, 1 bottom, 2 top.
int part_called(const std::string& name) {
    return name.starts_with("top") ? 2 : name.starts_with("bottom") ? 1 : 0;
}

// As packers do: the box stands, its bottom is closed, it is filled, its top is closed. A tuck alone may be
// bent before, for it hangs on its lid.
TEST(FoldOrder, ClosesTheBottomBeforeTheTop) {
    for (const CreasePattern& pattern : {carton(60.0, 40.0, 50.0), carton(60.0, 60.0, 60.0),
                                         tuck_end(60.0, 30.0, 90.0, 1.0), tuck_end(60.0, 30.0, 90.0, 0.0)}) {
        Assembly box = folded(pattern);
        const std::string told = ordered(box);
        EXPECT_NE(told.find("fold it in that order, too"), std::string::npos) << told;
        const std::map<std::string, Turns> turns = turns_of(box);
        for (const auto& [first, one] : turns) {
            for (const auto& [second, other] : turns) {
                if (part_called(first) >= part_called(second) || second.ends_with("-tuck")) continue;
                EXPECT_LE(one.end, other.begin + 1e-9) << first << ", " << second << ": " << told;
            }
        }
        expect_clear(box);
    }
}

// Of a box as wide as it is long all flaps are alike: those of opposite walls go at once, and so do both
// ends.
TEST(FoldOrder, FoldsEqualOppositeFlapsInOneStep) {
    for (const double height : {60.0, 45.0}) {
        Assembly box = folded(carton(60.0, 60.0, height));
        const std::string told = ordered(box);
        EXPECT_NE(told.find("fold it in that order, too"), std::string::npos) << told;
        const std::map<std::string, Turns> turns = turns_of(box);
        for (const std::string end : {"top", "bottom"}) {
            for (const auto& [one, other] : {std::pair{"front", "back"}, std::pair{"left", "right"}}) {
                const Turns a = turns.at(fmt::format("{}-flap-{}", end, one));
                const Turns b = turns.at(fmt::format("{}-flap-{}", end, other));
                EXPECT_EQ(a.begin, b.begin) << told;
                EXPECT_EQ(a.end, b.end) << told;
            }
            EXPECT_NE(turns.at(end + "-flap-front").begin, turns.at(end + "-flap-left").begin) << told;
        }
        expect_clear(box);
    }
}

// Two squares lie on one another between two steps; the next would part them to the other side.
TEST(FoldOrder, RemembersFromStepToStepOnWhichSidePlatesLie) {
    CreasePattern pattern;
    cut(pattern, {{0, 20},
                  {0, 40},
                  {20, 40},
                  {20, 20},
                  {20, 0},
                  {20, -20},
                  {0, -20},
                  {-20, -20},
                  {-20, 0},
                  {-20, 20},
                  {0, 20},
                  {0, 0}});
    pattern.lines.push_back({{{0, 20}, {20, 20}}, false, CreaseUse::mountain, 90.0});
    fold(pattern, {0, 0}, {20, 0});
    pattern.lines.push_back({{{0, -20}, {0, 0}}, false, CreaseUse::valley, 45.0});
    fold(pattern, {-20, 0}, {0, 0});
    Assembly sheet = folded(pattern);
    const std::string told = ordered(sheet);
    EXPECT_NE(told.find("fold it in that order, too"), std::string::npos) << told;
    expect_clear(sheet);
}

}  // namespace
}  // namespace popup
