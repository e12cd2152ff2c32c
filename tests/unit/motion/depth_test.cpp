// How deep plates are in each other: by hand, and by moving one of them with brute force.
#include "motion/depth.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "popup/motion.h"
#include "support/brute_force.h"
#include "support/designs.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

const int kContacts = sanitized_count(200);
constexpr int kLongContacts = 2000;
constexpr double kSlackMm = 0.05;
constexpr int kSteps = 12;  // at which a shorter way out is looked for, each way

Plate plate(Ring outline) {
    Plate made;
    made.outline.outer = std::move(outline);
    made.uncut = made.outline.outer;
    return made;
}

Plate box(double x0, double y0, double x1, double y1) {
    return plate({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

// Of b, whose page stands on the line x = 0 of a's and leans by `deg` from it: its y is a's y, and its x
// leads away from the line.
double depth_of(const Plate& a, const Plate& b, double deg) {
    const double turn = deg * M_PI / 180.0;
    Frame frame;
    frame.axes[0] = {std::cos(turn), 0.0, std::sin(turn)};
    frame.axes[1] = {0.0, 1.0, 0.0};
    frame.axes[2] = cross(frame.axes[0], frame.axes[1]);
    return depth_mm(plate_shape(a), plate_shape(b), frame);
}

TEST(Depth, IsHowFarTheEndOfAPlateStandsOut) {
    // 3 of b's paper are below a, 20 above it.
    EXPECT_NEAR(depth_of(box(-50, -50, 50, 50), box(-3, -10, 20, 10), 90), 3.0, 1e-6);
    EXPECT_NEAR(depth_of(box(-50, -50, 50, 50), box(-3, -10, 20, 10), 30), 1.5, 1e-6);
    // Here a has only 2 to one side of b, which leans: it gets out there sooner.
    EXPECT_NEAR(depth_of(box(-50, -50, 2, 50), box(-30, -10, 30, 10), 90), 2.0, 1e-6);
    EXPECT_NEAR(depth_of(box(-50, -50, 2, 50), box(-30, -10, 30, 10), 30), 1.0, 1e-6);
}

TEST(Depth, OfPlatesThatMeetAtACornerIsSmall) {
    // b has a corner that points along the line, and reaches 30 to either side of a.
    const Plate arrow = plate({{0, 0.1}, {-30, -20}, {30, -20}});
    // a begins at y = 0: of b only a triangle 0.1 high lies beside it, 0.1 × 30 / 20.1 to either side.
    EXPECT_NEAR(depth_of(box(-50, 0, 50, 50), arrow, 90), 0.1 * 30.0 / 20.1, 1e-6);
    EXPECT_NEAR(depth_of(box(-50, 0.1, 50, 50), arrow, 90), 0.0, 1e-6);
}

TEST(Depth, PlatesComeApartInAHole) {
    Plate holed = box(-50, -50, 50, 50);
    holed.outline.holes.push_back({{4, -20}, {4, 20}, {30, 20}, {30, -20}});
    // b, which stands square to a, moves 4 over the hole, or 25 out of a.
    EXPECT_NEAR(depth_of(holed, box(-25, -10, 25, 10), 90), 4.0, 1e-6);
    EXPECT_NEAR(depth_of(box(-50, -50, 50, 50), box(-25, -10, 25, 10), 90), 25.0, 1e-6);
}

TEST(Depth, AlongAnEdgeThereIsNoPaper) {
    // The line runs along the edge of a notch from y = -20 to 20, and b reaches from there to beyond its end.
    const Plate notched =
        plate({{-50, -50}, {50, -50}, {50, 50}, {-50, 50}, {-50, 20}, {0, 20}, {0, -20}, {-50, -20}});
    // What lies beyond y = 20 of b is a triangle that ends 4 over a.
    EXPECT_NEAR(depth_of(notched, plate({{-30, -5}, {30, -5}, {4, 20}, {0, 30}, {-4, 20}}), 90), 4.0, 1e-6);
}

TEST(Depth, OfWhatDoesNotCrossIsNothing) {
    EXPECT_EQ(depth_of(box(-50, -50, 50, 50), box(1, -10, 20, 10), 90), 0.0);
    EXPECT_EQ(depth_of(box(-50, -50, 50, 50), box(-5, 60, 20, 80), 90), 0.0);
    EXPECT_EQ(depth_of(box(-50, -50, 50, 50), box(-5, -5, 20, 5), 0), 0.0) << "parallel";
}

// Moves b square to either plate, both ways: within the depth that is told they meet, just beyond it they are
// apart.
void holds_by_brute_force(const Assembly& assembly, const BruteForce& brute, const Contact& one) {
    std::vector<Frame> frames(assembly.plates.size());
    ASSERT_TRUE(place(assembly, Angle::degrees(one.deepest_deg), frames));
    bool apart = false;
    for (const int normal_of : {one.a, one.b}) {
        for (const double way : {-1.0, 1.0}) {
            const Vec3 by = way * frames[static_cast<std::size_t>(normal_of)].normal();
            const auto meet = [&](double mm, bool shrunk) {
                return brute.meet_when_moved(one.a, one.b, one.deepest_deg, mm * by, shrunk);
            };
            apart = apart || !meet(one.depth_mm + kSlackMm, true);
            for (int i = 0; i <= kSteps; ++i) {
                const double mm = (one.depth_mm - kSlackMm) * i / kSteps;
                EXPECT_TRUE(mm < 0.0 || meet(mm, false)) << "they are apart after " << mm << " mm";
            }
        }
    }
    EXPECT_TRUE(apart) << "they are not apart after " << one.depth_mm + kSlackMm << " mm";
}

void compare_with_brute_force(int count) {
    int contacts = 0;
    int shallow = 0;  // that reach at least ten times as far beyond each other
    for (std::uint64_t seed = 1; contacts < count; ++seed) {
        const Built built = build(seed % 2 == 0 ? generate(seed, 2 + static_cast<int>(seed % 13))
                                                : generate_any(seed, 2 + static_cast<int>(seed % 11)));
        ASSERT_TRUE(built.assembly) << seed;
        const Assembly& assembly = *built.assembly;
        const BruteForce brute(assembly);
        for (const Contact& one : examine(assembly, {}).contacts) {
            const auto rivet = [&](int of) { return assembly.plates[static_cast<std::size_t>(of)].rivet; };
            // What a disc sweeps is another plate; and what passes face to face has no depth.
            if (rivet(one.a) || rivet(one.b) || one.from_deg == one.to_deg) continue;
            SCOPED_TRACE(fmt::format("seed {}: {} and {} at {}°, {} mm", seed,
                                     assembly.plates[static_cast<std::size_t>(one.a)].name,
                                     assembly.plates[static_cast<std::size_t>(one.b)].name, one.deepest_deg,
                                     one.depth_mm));
            holds_by_brute_force(assembly, brute, one);
            if (testing::Test::HasFailure()) return;
            ++contacts;
            if (10.0 * one.depth_mm < one.excess_mm) ++shallow;
        }
    }
    EXPECT_GT(shallow, contacts / 100) << "there must be grazing ones";
}

TEST(Depth, OfAnyContactIsWhatBruteForceMovesThemBy) {
    if (!BruteForce::available()) GTEST_SKIP() << BruteForce::kMissing;
    compare_with_brute_force(kContacts);
}

TEST(LongDepth, OfManyContactsIsWhatBruteForceMovesThemBy) {
    if (!BruteForce::available()) GTEST_SKIP() << BruteForce::kMissing;
    compare_with_brute_force(kLongContacts);
}

}  // namespace
}  // namespace popup::test
