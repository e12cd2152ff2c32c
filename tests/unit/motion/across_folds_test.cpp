// What lies flat and reaches across a fold: held against points of it, and the paper beyond, one by one.
#include "motion/across_folds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "popup/motion.h"
#include "support/designs.h"
#include "support/random.h"

namespace popup {
namespace {

// Its halves meet in x = 0, and fold towards the viewer's back.
const std::string kVFold =
    "<structure type='v-fold' id='v'><outerpoints><point x='-20' y='3.8351'/><point x='0' y='-20'/>"
    "<point x='20' y='3.8351'/><point x='-26.9459' y='15.5572'/><point x='0' y='0'/>"
    "<point x='26.9459' y='15.5572'/><point x='26' y='50'/><point x='-26' y='50'/></outerpoints>"
    "<parentfold on='gutter'/></structure>";

struct Rectangle {
    double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;
};

// A rectangle glued on a plate, at the line x = `at`. Its own page is that of the plate, moved there, and on
// the back seen from behind.
std::string plane(const std::string& page, double at, double from, double to, const Rectangle& r, bool back) {
    const double middle = 0.5 * (from + to);
    const double left = back ? at - r.x1 : r.x0 - at;
    const double right = back ? at - r.x0 : r.x1 - at;
    return fmt::format(
        "<structure type='attached-plane' id='ap' side='{}'><outerpoints><point x='{}' y='{}'/>"
        "<point x='{}' y='{}'/><point x='0' y='{}'/><point x='0' y='{}'/></outerpoints>"
        "<outline d='M {} {} H {} V {} H {} Z'/><parentplate page='{}' x='{}' y='{}'/></structure>",
        back ? "back" : "front", at, from, at, to, from - middle, to - middle, left, r.y0 - middle, right,
        r.y1 - middle, left, page, at, middle);
}

// Whether points of the plate that lie over another while they are flat are behind its paper later, by what
// side of it they are on: front is where the first plate's front is.
bool passes_through(const Assembly& assembly, int plate, int on, int beyond, bool on_back) {
    std::vector<Frame> frames(assembly.plates.size());
    if (!place(assembly, Angle::degrees(90), frames)) return false;
    const auto at = [&](int number) -> const Frame& { return frames[static_cast<std::size_t>(number)]; };
    const auto outline = [&](int number) -> const Polygon& {
        return assembly.plates[static_cast<std::size_t>(number)].outline;
    };
    const Box box = bounds(outline(plate).outer);
    for (double x = box.min.x + 0.05; x < box.max.x; x += 0.1) {
        for (double y = box.min.y + 0.05; y < box.max.y; y += 1.3) {
            const Vec3 p = at(plate).point({x, y});
            const Vec3 off = p - at(on).origin;
            const Vec2 on_page{dot(off, at(on).axes[0]), dot(off, at(on).axes[1])};
            if (!contains(outline(beyond), on_page)) continue;
            const double before = dot(p - at(beyond).origin, at(beyond).normal());
            if (std::abs(before) > 1e-3 && (before < 0.0) != on_back) return true;
        }
    }
    return false;
}

TEST(AcrossFolds, AreThoseWhosePointsComeOutOnTheOtherSide) {
    test::Random random(7);
    const auto between = [&](double low, double high) { return low + (high - low) * random.unit(); };
    int across = 0;
    int free = 0;
    for (int i = 0; i < 120; ++i) {
        const bool back = random.below(2) == 0;
        const bool left = random.below(2) == 0;
        // One edge is at the fold, a little off it, or far from it.
        const double reach = random.below(3) == 0 ? 0.0 : between(-9.0, 6.0);
        Rectangle r{reach, between(14.0, 18.0), between(21.0, 24.0), between(36.0, 39.0)};
        if (left) std::swap(r.x0 = -r.x0, r.x1 = -r.x1);
        const test::FromXml made = test::from_xml(kVFold + plane("v", left ? -10 : 10, 24.0, 36.0, r, back));
        ASSERT_TRUE(made.assembly) << made.text;
        const auto number = [&](const char* name) { return static_cast<int>(made.plate(name)); };
        const int on = number(left ? "v/left" : "v/right");
        const int beyond = number(left ? "v/right" : "v/left");
        const auto ap = static_cast<int>(
            std::find_if(made.assembly->plates.begin(), made.assembly->plates.end(),
                         [](const Plate& one) {
                             return one.lying == Lying::on_front || one.lying == Lying::on_back;
                         }) -
            made.assembly->plates.begin());
        const bool expected = passes_through(*made.assembly, ap, on, beyond, back);
        const std::vector<AcrossFold> found = find_across_folds(*made.assembly);
        ASSERT_EQ(found.size(), expected ? 1U : 0U) << "number " << i << ", reach " << reach;
        (expected ? across : free) += 1;
        if (!expected) continue;
        EXPECT_EQ(found[0].plate, ap);
        EXPECT_EQ(found[0].on, on);
        EXPECT_EQ(found[0].through, beyond);
        EXPECT_NEAR(found[0].by_mm, -reach, 0.02);
        EXPECT_NEAR(distance(found[0].at.a, found[0].at.b), r.y1 - r.y0, 0.05);
    }
    EXPECT_GT(across, 20);
    EXPECT_GT(free, 20);
}

// The base page's own fold, from both sides: inside the card what lies across it is in the way of the other
// page.
TEST(AcrossFolds, OfTheBasePageIsTheGutter) {
    for (const bool back : {false, true}) {
        const test::FromXml made =
            test::from_xml(plane("page", 12, -10, 10, {-5.0, 20.0, -12.0, 12.0}, back));
        ASSERT_TRUE(made.assembly) << made.text;
        const std::vector<AcrossFold> found = find_across_folds(*made.assembly);
        ASSERT_EQ(found.size(), back ? 0U : 1U);
        if (back) continue;
        EXPECT_NEAR(found[0].by_mm, 5.0, 0.02);
    }
}

// Where the paper beyond the fold is cut out, there is nothing to go through.
TEST(AcrossFolds, NeedPaperOnBothSides) {
    const std::string hole =
        "<structure type='hole' id='h'><outline page='0' d='M -14 -15 H 4 V 15 H -14 Z'/></structure>";
    const std::string ap = plane("page", 12, -10, 10, {-5.0, 20.0, -12.0, 12.0}, false);
    const test::FromXml made = test::from_xml(hole + ap);
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(find_across_folds(*made.assembly).size(), 0U) << made.text;
}

// Turned about its rivet it sweeps a circle; what is glued to its side of the plate is in its way, and what
// stands on the other side is not.
TEST(AcrossFolds, WhatIsTurnedByHandReachesAllRound) {
    const std::string box =
        "<structure type='box' id='b' height='20'><outerpoints><point x='-15' y='-20'/>"
        "<point x='-15' y='20'/><point x='15' y='-20'/><point x='15' y='20'/></outerpoints>"
        "<parentfold on='gutter'/></structure>";
    const auto arm = [](double length, const char* side) {
        return fmt::format(
            "<structure type='disc' id='d' side='{}'><outerpoints><point x='45' y='0'/><point x='45' y='0'/>"
            "</outerpoints><outline d='M -3 -3 H 3 V {} H -3 Z'/><parentplate page='page' x='60' y='0'/>"
            "</structure>",
            side, length);
    };
    // The wall stands 30 mm from the rivet.
    for (const double length : {25.0, 29.5, 30.5, 35.0}) {
        for (const char* side : {"front", "back"}) {
            const test::FromXml made = test::from_xml(box + arm(length, side));
            ASSERT_TRUE(made.assembly) << made.text;
            const std::vector<AcrossFold> found = find_across_folds(*made.assembly);
            const bool in_the_way = length > 30.0 && side == std::string("front");
            ASSERT_EQ(found.size(), in_the_way ? 1U : 0U) << length << side << made.text;
            EXPECT_TRUE(
                std::all_of(found.begin(), found.end(), [](const AcrossFold& one) { return one.seam; }));
        }
    }
}

}  // namespace
}  // namespace popup
