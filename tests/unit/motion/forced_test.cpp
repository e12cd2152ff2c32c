// Which plates the opening forces. What is expected is counted by hand, or found from the whole system of
// equations at once: a twist for every plate, two common points for every hinge, and its null space by
// one-sided Jacobi rotations.
#include "motion/forced.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <set>

#include "motion/sweep.h"
#include "support/designs.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// --- the other method

using Column = std::vector<double>;

struct NullSpace {
    int ways = 0;
    std::set<int> free;  // plates that move in it
};

// Right singular vectors of the smallest singular values. `columns`: of the matrix; all of one length.
std::vector<Column> null_space(std::vector<Column> columns) {
    const std::size_t n = columns.size();
    std::vector<Column> turned(n, Column(n));
    for (std::size_t i = 0; i < n; ++i) turned[i][i] = 1.0;
    const auto inner = [](const Column& a, const Column& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    };
    const auto rotate = [](Column& a, Column& b, double c, double s) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double x = a[i];
            a[i] = c * x - s * b[i];
            b[i] = s * x + c * b[i];
        }
    };
    for (bool more = true; more;) {
        more = false;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = i + 1; k < n; ++k) {
                const double aa = inner(columns[i], columns[i]);
                const double bb = inner(columns[k], columns[k]);
                const double ab = inner(columns[i], columns[k]);
                if (std::abs(ab) <= 1e-14 * std::sqrt(aa * bb) || aa * bb < 1e-40) continue;
                more = true;
                const double z = (bb - aa) / (2.0 * ab);
                const double t = (z >= 0.0 ? 1.0 : -1.0) / (std::abs(z) + std::sqrt(1.0 + z * z));
                const double c = 1.0 / std::sqrt(1.0 + t * t);
                rotate(columns[i], columns[k], c, c * t);
                rotate(turned[i], turned[k], c, c * t);
            }
        }
    }
    std::vector<Column> nothing;
    for (std::size_t i = 0; i < n; ++i) {
        if (std::sqrt(inner(columns[i], columns[i])) < 1e-7) nothing.push_back(turned[i]);
    }
    return nothing;
}

NullSpace all_at_once(const Assembly& assembly, const std::vector<Frame>& frames) {
    constexpr double kUnitMm = 30.0;  // so that a turn and a way count alike
    std::set<int> driven;
    for (const Joint& joint : assembly.joints) {
        if (const auto* drive = std::get_if<Drive>(&joint.how)) driven.insert(drive->plate);
    }
    std::vector<int> first(assembly.plates.size(), -1);
    int unknowns = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (driven.contains(static_cast<int>(i))) continue;
        first[i] = unknowns;
        unknowns += 6;
    }
    std::vector<Column> columns(at(unknowns));
    const auto meet = [&](int a, int b, Vec3 where) {
        const Vec3 p = (1.0 / kUnitMm) * where;
        const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        for (Column& column : columns) column.resize(column.size() + 3);
        const auto move = [&](int plate, double sign) {
            if (first[at(plate)] < 0) return;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto put = [&](int unknown, Vec3 v) {
                    Column& column = columns[at(first[at(plate)] + unknown) + i];
                    column[column.size() - 3] += sign * v.x;
                    column[column.size() - 2] += sign * v.y;
                    column[column.size() - 1] += sign * v.z;
                };
                put(0, cross(axes.at(i), p));
                put(3, axes.at(i));
            }
        };
        move(a, 1.0);
        move(b, -1.0);
    };
    for (const Hinge& hinge : assembly.hinges) {
        const Frame& frame = frames[at(hinge.a)];
        meet(hinge.a, hinge.b, frame.point(hinge.a_line.a));
        meet(hinge.a, hinge.b, frame.point(hinge.a_line.b));
    }
    for (const Joint& joint : assembly.joints) {
        const auto* rigid = std::get_if<Rigid>(&joint.how);
        if (rigid == nullptr) continue;
        const Frame& frame = frames[at(rigid->base)];
        for (const Vec2 p : {Vec2{0, 0}, Vec2{20, 0}, Vec2{0, 20}})
            meet(rigid->base, rigid->plate, frame.point(p));
    }
    NullSpace result;
    std::vector<double> moved(assembly.plates.size());
    for (const Column& way : null_space(columns)) {
        ++result.ways;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            for (int k = 0; k < 6 && first[i] >= 0; ++k)
                moved[i] = std::max(moved[i], std::abs(way[at(first[i] + k)]));
        }
    }
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (moved[i] > 1e-6) result.free.insert(static_cast<int>(i));
    }
    return result;
}

std::vector<Frame> frames_at(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames)) << deg;
    return frames;
}

// --- linkages whose folds all run across a plane, drawn in that plane

struct Profile {
    Assembly assembly;
    std::vector<Frame> frames;

    // A plate that stands on the plane along from–to, `driven` by the card or not.
    int plate(Vec2 from, Vec2 to, bool driven = false) {
        const int number = static_cast<int>(frames.size());
        const Vec2 way = unit(to - from);
        const Vec3 along{way.x, 0, way.y};
        frames.push_back({{along, Vec3{0, 1, 0}, cross(along, {0, 1, 0})}, {from.x, 0, from.y}});
        assembly.plates.emplace_back().name = fmt::format("p{}", number);
        if (driven) assembly.joints.push_back({"page", {}, Drive{number, {0, 0}, {0, 1}, 1}});
        return number;
    }
    // Joins two plates by a fold through a point of the plane.
    void fold(int a, int b, Vec2 where) {
        const auto line = [&](int one) {
            const Frame& frame = frames[at(one)];
            const double u = dot(Vec3{where.x, 0, where.y} - frame.origin, frame.axes[0]);
            const Segment segment{{u, 0}, {u, 40}};
            EXPECT_LT(distance(frame.point(segment.a), {where.x, 0, where.y}), 1e-9);
            return segment;
        };
        assembly.hinges.push_back({a, b, line(a), line(b), false});
    }
    [[nodiscard]] std::vector<FreePlates> found() const {
        return free_plates(assembly, 1, [this](std::size_t, std::span<Frame> all) {
            std::copy(frames.begin(), frames.end(), all.begin());
            return true;
        });
    }
};

// A top parallel to the pages, on two walls and a pillar, all 25 mm high and upright.
struct FloatingLayer : Profile {
    static constexpr double kWall = 40.0, kHeight = 25.0;
    Vec2 out{std::sin(0.7), std::cos(0.7)};  // along the right page; the card is open by 1.4 rad
    Vec2 up{0, kHeight};
    int left = plate({0, 0}, {-out.x, out.y}, true);
    int right = plate({0, 0}, out, true);
    int pillar = plate({0, 0}, up);
    std::array<int, 2> walls{}, tops{};

    FloatingLayer() {
        fold(left, pillar, {0, 0});
        for (const std::size_t side : {0U, 1U}) {
            const Vec2 foot = on_page(side, kWall);
            walls.at(side) = plate(foot, foot + up);
            tops.at(side) = plate(up, foot + up);
            fold(walls.at(side), side == 0 ? left : right, foot);
            fold(walls.at(side), tops.at(side), foot + up);
            fold(tops.at(side), pillar, up);
        }
    }
    [[nodiscard]] Vec2 on_page(std::size_t side, double mm) const {
        return {side == 0 ? -mm * out.x : mm * out.x, mm * out.y};
    }
};

// Seven folds, two loops of plane parallelograms (three conditions each): the pillar's angle stays open.
TEST(Forced, FloatingLayerOnParallelWallsHasOneWay) {
    const FloatingLayer card;
    const auto found = card.found();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].ways, 1);
    EXPECT_EQ(found[0].plates, (std::vector<int>{2, 3, 4, 5, 6}));
    EXPECT_EQ(found[0].lines, 7);
    EXPECT_TRUE(found[0].parallel);
}

TEST(Forced, FurtherParallelWallOfTheSameHeightForcesNothing) {
    FloatingLayer card;
    const Vec2 foot = card.on_page(1, 15.0);
    const int more = card.plate(foot, foot + card.up);
    card.fold(more, card.right, foot);
    card.fold(more, card.tops[1], foot + card.up);
    const auto found = card.found();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].ways, 1);
    EXPECT_EQ(found[0].plates.size(), 6u);
}

// At this pose: a triangle that a card could not open.
TEST(Forced, SlantingStrutForcesTheWholeLayer) {
    FloatingLayer card;
    const Vec2 foot = card.on_page(1, 15.0);
    const Vec2 head = 0.5 * (card.up + card.up + card.on_page(1, FloatingLayer::kWall));
    const int more = card.plate(foot, head);
    card.fold(more, card.right, foot);
    card.fold(more, card.tops[1], head);
    EXPECT_TRUE(card.found().empty());
}

TEST(Forced, WhatStandsOnFreePlatesIsFreeWithThem) {
    FloatingLayer card;
    // A tent on the fold in the middle of the top: forced against the top, and so in no further way.
    const auto on_top = [&](std::size_t side) { return card.up + card.on_page(side, 10.0); };
    const Vec2 ridge = card.up + Vec2{0, 30};
    const int left = card.plate(on_top(0), ridge);
    const int right = card.plate(on_top(1), ridge);
    card.fold(left, card.tops[0], on_top(0));
    card.fold(left, right, ridge);
    card.fold(right, card.tops[1], on_top(1));
    const auto found = card.found();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].ways, 1);
    EXPECT_EQ(found[0].plates.size(), 7u);
}

TEST(Forced, FlapsOnOneFoldEachAreFreeByThemselves) {
    Profile card;
    const int page = card.plate({0, 0}, {50, 0}, true);
    const int first = card.plate({10, 0}, {10, 20});
    const int second = card.plate({30, 0}, {35, 20});
    const int third = card.plate({35, 20}, {50, 30});
    card.fold(page, first, {10, 0});
    card.fold(second, third, {35, 20});
    card.fold(page, second, {30, 0});
    const auto found = card.found();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].plates, std::vector<int>{first});
    EXPECT_EQ(found[0].ways, 1);
    EXPECT_EQ(found[0].lines, 1);
    EXPECT_EQ(found[1].plates, (std::vector<int>{second, third}));
    EXPECT_EQ(found[1].ways, 2);
}

// Two flaps and a bridge are a four-bar linkage that nothing drives; a bridge between flaps that meet makes a
// triangle, and a rigid one.
TEST(Forced, BridgeBetweenFlapsTakesAwayWhatItsLoopDoes) {
    Profile card;
    const int page = card.plate({0, 0}, {50, 0}, true);
    const int left = card.plate({10, 0}, {12, 20});
    const int right = card.plate({40, 0}, {33, 25});
    card.fold(page, left, {10, 0});
    card.fold(page, right, {40, 0});
    ASSERT_EQ(card.found().size(), 2u);
    const int bridge = card.plate({12, 20}, {33, 25});
    card.fold(left, bridge, {12, 20});
    card.fold(bridge, right, {33, 25});
    const auto found = card.found();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].ways, 1);
    EXPECT_EQ(found[0].plates.size(), 3u);
    const int strut = card.plate({20, 0}, {33, 25});
    card.fold(page, strut, {20, 0});
    card.fold(strut, right, {33, 25});
    EXPECT_TRUE(card.found().empty());
}

TEST(Forced, SeamsInOneLineHoldAFlapByOneLineOnly) {
    Profile card;
    const int page = card.plate({0, 0}, {50, 0}, true);
    const int flap = card.plate({0, 0}, {50, 0});
    const auto glue = [&](Segment line) { card.assembly.hinges.push_back({page, flap, line, line, true}); };
    for (const double y : {0.0, 15.0, 30.0}) glue({{10, y}, {10, y + 10}});
    const auto found = card.found();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].ways, 1);
    // One beside it, or one that runs across, holds it.
    glue({{20, 0}, {20, 10}});
    EXPECT_TRUE(card.found().empty());
    card.assembly.hinges.back() = card.assembly.hinges.front();
    EXPECT_EQ(card.found().size(), 1u);
    card.assembly.hinges.pop_back();
    glue({{10, 10}, {20, 10}});
    EXPECT_TRUE(card.found().empty());
}

TEST(Forced, WhatIsGluedFlatMovesWithItsBase) {
    Profile card;
    const int page = card.plate({0, 0}, {50, 0}, true);
    const int on_page = card.plate({5, 0}, {25, 0});
    const int flap = card.plate({30, 0}, {30, 20});
    const int on_flap = card.plate({30, 5}, {30, 40});
    card.fold(page, flap, {30, 0});
    card.assembly.joints.push_back({"a", {}, Rigid{on_page, page, {5, 0}, {1, 0}, {0, 0}, {1, 0}, false}});
    card.assembly.joints.push_back({"b", {}, Rigid{on_flap, flap, {0, 5}, {1, 0}, {0, 0}, {1, 0}, false}});
    const auto found = card.found();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].plates, (std::vector<int>{flap, on_flap}));
    EXPECT_EQ(found[0].ways, 1);
    // Glued to the page as well, by an area alone, both stand still.
    card.assembly.glued_areas.push_back({on_flap, on_page, {}, "1", "b", {}});
    EXPECT_TRUE(card.found().empty());
}

TEST(Forced, PlateThatNothingHoldsHasSixWays) {
    Profile card;
    const int page = card.plate({0, 0}, {50, 0}, true);
    const int loose = card.plate({10, 20}, {20, 30});
    const int wing = card.plate({20, 30}, {30, 20});
    card.fold(loose, wing, {20, 30});
    const auto found = card.found();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].plates, (std::vector<int>{loose, wing}));
    EXPECT_EQ(found[0].ways, 7);
    EXPECT_EQ(page, 0);
}

// A step lies flat at 180°: there its middle fold may go up or down, and at no other opening.
TEST(Forced, FreedomOfASingularPoseIsNone) {
    Design design = card();
    add(design, "step", {{-40, -30}, {-40, 30}, {25, -20}, {25, 35}});
    const Built built = build(design);
    std::vector<double> degs{180.0};
    const auto found = [&] {
        return free_plates(*built.assembly, degs.size(), [&](std::size_t pose, std::span<Frame> frames) {
            return place(*built.assembly, Angle::degrees(degs[pose]), frames);
        });
    };
    ASSERT_EQ(found().size(), 1u);
    EXPECT_EQ(found()[0].ways, 1);
    EXPECT_EQ(all_at_once(*built.assembly, frames_at(*built.assembly, 180.0)).ways, 1);
    degs = {180.0, 91.7};
    EXPECT_TRUE(found().empty());
}

// --- whole designs

TEST(Forced, OpeningForcesAllOfWhatElementsMake) {
    for (std::uint64_t seed = 1; seed <= test::sanitized_count<std::uint64_t>(60); ++seed) {
        SCOPED_TRACE(seed);
        const Built built = build(generate(seed, 14));
        ASSERT_TRUE(built.assembly);
        EXPECT_TRUE(free_plates(*built.assembly).empty());
    }
    EXPECT_TRUE(free_plates(*build(row(400)).assembly).empty());
}

// Designs with folds and seams taken away at random: as many ways, and the same plates.
TEST(Forced, AgreesWithTheWholeSystemOfEquations) {
    Random random(7);
    int with_some = 0;
    int bridged = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        Built built = build(generate(seed, 6));
        ASSERT_TRUE(built.assembly);
        Assembly& assembly = *built.assembly;
        const std::size_t fewer = 1 + random.below(4);
        for (std::size_t i = 0; i < fewer && assembly.hinges.size() > 1; ++i) {
            const std::size_t gone = 1 + random.below(assembly.hinges.size() - 1);
            assembly.hinges.erase(assembly.hinges.begin() + static_cast<std::ptrdiff_t>(gone));
        }
        // The order of the hinges costs time and changes nothing.
        if (seed % 2 == 0) std::reverse(assembly.hinges.begin(), assembly.hinges.end());
        int ways = 1 << 20;
        std::set<int> free;
        for (std::size_t i = 0; i < assembly.plates.size(); ++i) free.insert(static_cast<int>(i));
        for (const double deg : kTellingDegs) {
            const NullSpace there = all_at_once(assembly, frames_at(assembly, deg));
            ways = std::min(ways, there.ways);
            std::set<int> both;
            std::set_intersection(free.begin(), free.end(), there.free.begin(), there.free.end(),
                                  std::inserter(both, both.end()));
            free = both;
        }
        int found_ways = 0;
        std::set<int> found_free;
        for (const FreePlates& one : free_plates(assembly)) {
            found_ways += one.ways;
            EXPECT_TRUE(std::is_sorted(one.plates.begin(), one.plates.end()));
            for (const int plate : one.plates) EXPECT_TRUE(found_free.insert(plate).second);
        }
        EXPECT_EQ(found_ways, ways);
        EXPECT_EQ(found_free, free);
        with_some += ways > 0 ? 1 : 0;
        bridged += ways < static_cast<int>(fewer) ? 1 : 0;
    }
    EXPECT_GT(with_some, 20);
    EXPECT_GT(bridged, 1);
}

// --- what is said of it

// A tent on the gutter, and on its centre fold what `design` is given; that fold is cut through.
Built slit_tent(const std::function<void(Design&)>& add_more) {
    Design design = card();
    add(design, "tent",
        {{-18, -35}, {-18, 35}, {18, -35}, {18, 35}, {-30, -35}, {-30, 35}, {30, -35}, {30, 35}});
    add_more(design);
    Built built = build(design);
    auto& hinges = built.assembly->hinges;
    const auto centre = std::find_if(hinges.begin(), hinges.end(), [](const Hinge& hinge) {
        return std::minmax({hinge.a, hinge.b}) == std::pair{2, 3};
    });
    EXPECT_NE(centre, hinges.end());
    hinges.erase(centre);
    return built;
}

struct Told {
    Motion motion;
    std::vector<Diagnostic> remarks;
};
Told told_of(const Built& built, bool examine) {
    Diagnostics diagnostics;
    MotionOptions options;
    options.examine = examine;
    auto motion = simulate(*built.assembly, options, diagnostics);
    EXPECT_TRUE(motion) << findings(diagnostics);
    Told told{motion.value_or(Motion{}), {}};
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (one.code == "not-forced") told.remarks.push_back(one);
    }
    return told;
}

TEST(Forced, RemarkNamesThePlatesTheWaysAndWhatWouldForceThem) {
    const Built built = slit_tent([](Design&) {});
    for (const bool examine : {false, true}) {
        const Told told = told_of(built, examine);
        ASSERT_EQ(told.motion.not_forced.size(), 2u);
        EXPECT_EQ(told.motion.not_forced[0].plates, std::vector<int>{2});
        EXPECT_EQ(told.motion.not_forced[1].plates, std::vector<int>{3});
        ASSERT_EQ(told.remarks.size(), 2u);
        const Diagnostic& first = told.remarks[0];
        EXPECT_EQ(first.severity, Severity::remark);
        EXPECT_EQ(first.element, "e1");
        EXPECT_EQ(first.message, "the opening of the card does not force \"e1/left\": free in 1 way");
        ASSERT_EQ(first.hints.size(), 1u);
        EXPECT_NE(first.hints[0].find("one line only"), std::string::npos) << first.hints[0];
    }
}

// Two flaps joined by the halves of a tent: five parallel lines in one loop, three conditions.
TEST(Forced, RemarkOnParallelLinesSaysThatMoreOfThemWouldNotDo) {
    const Built built = slit_tent([](Design& design) {
        add(design, "tent",
            {{-8, -20}, {-8, 20}, {8, -20}, {8, 20}, {-12, -20}, {-12, 20}, {12, -20}, {12, 20}}, {0, -35},
            {0, 35}, 1);
    });
    const Told told = told_of(built, false);
    ASSERT_EQ(told.motion.not_forced.size(), 1u);
    EXPECT_EQ(told.motion.not_forced[0].plates, (std::vector<int>{2, 3, 4, 5}));
    EXPECT_EQ(told.motion.not_forced[0].ways, 2);
    ASSERT_EQ(told.remarks.size(), 1u);
    const Diagnostic& remark = told.remarks[0];
    EXPECT_EQ(remark.message,
              "the opening of the card does not force \"e1/left\" and 3 plates that hang together with it: "
              "free in 2 ways");
    ASSERT_EQ(remark.hints.size(), 1u);
    EXPECT_NE(remark.hints[0].find("all run in one direction"), std::string::npos) << remark.hints[0];
    EXPECT_NE(remark.hints[0].find("2 linkages more"), std::string::npos) << remark.hints[0];
    EXPECT_NE(remark.hints[0].find("nor does what stands on one of its folds"), std::string::npos);
    ASSERT_EQ(remark.related.size(), 1u);
    EXPECT_EQ(remark.related[0].text, "\"e2\"");
}

// What the hint says of a floating layer in a document: nothing on its folds forces it, and a step in its
// place is forced.
TEST(Forced, NothingOnTheFoldsOfAFloatingLayerForcesItAndAStepInItsPlaceIs) {
    const std::string points =
        "<outerpoints><point x='-40' y='-30'/><point x='-40' y='30'/><point x='40' y='-30'/><point x='40' "
        "y='30'/></outerpoints><parentfold on='gutter'/></structure>";
    const std::string layer = "<structure type='floating-layer' id='fl' height='20'>" + points;
    const auto is_free = [](const std::string& structures) {
        const test::FromXml built = test::from_xml(structures);
        EXPECT_TRUE(built.assembly) << built.text;
        return built.assembly && !free_plates(*built.assembly).empty();
    };
    EXPECT_TRUE(is_free(layer));
    EXPECT_FALSE(is_free("<structure type='step' id='fl'>" + points));
    for (const char* fold : {"fl.left", "fl.topleft", "fl.centre", "fl.topright", "fl.right"}) {
        EXPECT_TRUE(is_free(layer +
                            "<structure type='tent' id='t'><outerpoints><point x='-8' y='-8'/><point x='-8' "
                            "y='8'/><point x='8' y='-8'/><point x='8' y='8'/><point x='-12' y='-8'/><point "
                            "x='-12' y='8'/><point x='12' y='-8'/><point x='12' y='8'/></outerpoints>"
                            "<parentfold on='" +
                            std::string(fold) + "'/></structure>"))
            << fold;
    }
}

// The same bridge, but two of its lines parallel and three through one point: five lines without a way.
TEST(Forced, VFoldAcrossASlitForcesBothSides) {
    const Vec2 e{0, -30};
    const double seam = std::hypot(6, 6);
    const Vec2 g = e + rotated({0, seam}, std::numbers::pi / 3);
    const Vec2 h = e + rotated({0, seam}, -std::numbers::pi / 3);
    const Built built = slit_tent([&](Design& design) {
        add(design, "v-fold", {{-6, 6}, {0, 0}, {6, 6}, g, e, h, h + Vec2{0, 12}, g + Vec2{0, 12}}, {0, -35},
            {0, 35}, 1);
    });
    const Told told = told_of(built, false);
    EXPECT_TRUE(told.motion.not_forced.empty());
    EXPECT_TRUE(told.remarks.empty());
}

}  // namespace
}  // namespace popup::test
