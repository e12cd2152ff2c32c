// A linkage has two states that close: the wanted one and its mirror image, which a placement by distances
// falls into where elements stand far out of the page (thesis, 5.4.4). Here every element is looked at, on
// every kind of fold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/designs.h"

namespace popup::test {
namespace {

// How far the far end of the centre fold stands before the two driving plates, per mm from the parent fold:
// the sines of its angles to them, or for parallel linkages the heights.
struct Heights {
    double left, right;
};
Heights heights(const FourBar& bars, std::span<const Frame> frames) {
    const Frame& left = frames[static_cast<std::size_t>(bars.left.drive)];
    const Frame& right = frames[static_cast<std::size_t>(bars.right.drive)];
    const Frame& own = frames[static_cast<std::size_t>(bars.left.plate)];
    const Bar& bar = bars.left;
    const Vec3 centre = own.point(bar.own_at + (bars.parallel ? bar.far : 1.0) * bar.own_centre);
    return {dot(left.normal(), centre - left.point(bars.left.fold_at)),
            dot(right.normal(), centre - right.point(bars.right.fold_at))};
}

TEST(WrongSide, CentreFoldsStayOnTheirSideOfBothDrivingPlatesOnEveryKindOfFold) {
    std::map<std::string, int> seen;  // kinds of linkages and folds
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        const Built built = build(generate(seed, 3 + static_cast<int>(seed % 14)));
        const Assembly& assembly = *built.assembly;
        std::vector<Frame> frames(assembly.plates.size());
        std::vector<int> side(assembly.joints.size(), 0);
        for (double deg = 179.5; deg > 0.5; deg -= 1.5) {
            ASSERT_TRUE(place(assembly, Angle::degrees(deg), frames));
            for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
                const Joint& joint = assembly.joints[j];
                const auto* bars = std::get_if<FourBar>(&joint.how);
                if (bars == nullptr) continue;
                const Heights at = heights(*bars, frames);
                const auto where = ::testing::Message()
                                   << "seed " << seed << " " << joint.name << " at " << deg;
                if (bars->closing != Closing::half_turn) {
                    // A glued piece is on the printed side.
                    EXPECT_GT(at.left, -1e-9) << where;
                    EXPECT_GT(at.right, -1e-9) << where;
                    continue;
                }
                // What is cut from the page leaves a valley to the front and a mountain to the back: for
                // good.
                const int here = std::min(at.left, at.right) > 0.0   ? 1
                                 : std::max(at.left, at.right) < 0.0 ? -1
                                                                     : 0;
                EXPECT_NE(here, 0) << where;
                if (side[j] == 0) side[j] = here;
                EXPECT_EQ(here, side[j]) << where;
            }
        }
        for (const Joint& joint : assembly.joints) {
            const auto* bars = std::get_if<FourBar>(&joint.how);
            if (bars == nullptr) continue;
            const bool on_seam = assembly.plates[static_cast<std::size_t>(bars->left.drive)].piece !=
                                 assembly.plates[static_cast<std::size_t>(bars->right.drive)].piece;
            ++seen[std::string(bars->closing == Closing::half_turn ? "cut"
                               : bars->closing == Closing::inside  ? "inside"
                                                                   : "outside") +
                   (bars->parallel ? " parallel" : " angled") + (on_seam ? " on a seam" : "")];
        }
    }
    for (const char* kind :
         {"cut parallel", "cut angled", "inside parallel", "inside angled", "outside parallel",
          "outside angled", "inside parallel on a seam", "inside angled on a seam"}) {
        EXPECT_GE(seen[kind], 20) << kind;
    }
}

// An element stacked on the tip of another, away from the page as far as a card allows, in both directions of
// the V.
TEST(WrongSide, ElementsOnTheFarEndsOfVFoldsStayOnTheirSide) {
    for (const std::string type : {"v-fold", "inverted-v-fold"}) {
        SCOPED_TRACE(type);
        const double way = type == "v-fold" ? 1.0 : -1.0;
        Design design = card(600, 600);
        add(design, type,
            {{-30, way * 20},
             {0, 0},
             {30, way * 20},
             {-35.9, 3.2},
             {0, 0},
             {35.9, 3.2},
             {40, 250},
             {-40, 250}});
        // On its centre fold, near the tip: a mountain that opens far from the page.
        add(design, "tent",
            {{-8, 200}, {-8, 230}, {8, 200}, {8, 230}, {-14, -15}, {-14, 15}, {14, -15}, {14, 15}}, {0, 0},
            {0, 250}, 1);
        add(design, way > 0.0 ? "inverted-step" : "step", {{-8, 100}, {-8, 150}, {8, 100}, {8, 150}}, {0, 0},
            {0, 250}, 1);
        const Built built = build(design);
        ASSERT_TRUE(built.assembly);
        std::vector<Frame> frames(built.assembly->plates.size());
        for (double deg = 0.25; deg < 180.0; deg += 0.25) {
            ASSERT_TRUE(place(*built.assembly, Angle::degrees(deg), frames));
            for (const Joint& joint : built.assembly->joints) {
                const auto* bars = std::get_if<FourBar>(&joint.how);
                if (bars == nullptr) continue;
                const Heights at = heights(*bars, frames);
                // The centre fold is a mountain, an inverted v-fold's a valley.
                const double sign = bars->closing == Closing::half_turn ? -way : 1.0;
                EXPECT_GT(sign * at.left, 0.0) << joint.name << " " << deg;
                EXPECT_GT(sign * at.right, 0.0) << joint.name << " " << deg;
            }
        }
        Diagnostics diagnostics;
        EXPECT_TRUE(simulate(*built.assembly, {}, diagnostics)) << findings(diagnostics);
    }
}

}  // namespace
}  // namespace popup::test
