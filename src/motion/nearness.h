// How near two plates come to each other within a range of angles, judged from one pose in the middle of it.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "motion/drift.h"
#include "motion/plate_shape.h"
#include "motion/triangle_distance.h"

namespace popup {

// One line about which a plate turns on the way to another, in the page coordinates of that other one (z: its
// front), and how far at most within the range, radians.
struct Arm {
    Vec3 at, dir;  // dir: unit
    double turn = 0.0;
};

// What moves a plate, the nearest arm first; and how it drifts, where all arms have laws.
struct Moves {
    std::span<const Arm> arms;
    std::optional<Drift> drift;

    // Radians by which the plate turns at most.
    [[nodiscard]] double turns() const;
};

// How far a point can get from where it is, when what it is on moves so. Each turn about an arm moves it
// along an arc no longer than the turn times its distance from the line, which the turns before may have
// lengthened. No point of a triangle or a hull goes further than the corner for which this is largest.
double stray(Vec3 point, const Moves& moves);
double stray(const Triangle3& triangle, const Moves& moves);
// How far it can get along the page in whose coordinates this is, whatever it does square to it. On the
// nearly open card plates lie in nearly one plane and turn about lines of it: they rise, and hardly move
// along it.
double level_stray(Vec3 point, const Moves& moves);
double level_stray(const Triangle3& triangle, const Moves& moves);

// Plates a and b in the page coordinates of a. `from_b`: how b moves against a; `from_a`: a against b.
struct PairPose {
    const PlateShape* a = nullptr;
    const PlateShape* b = nullptr;
    Frame b_in_a;
    Moves from_b, from_a;
};

// The pose of b in a's page coordinates, from their frames.
Frame relative(const Frame& a, const Frame& b);
// Where a point of the world is in a frame's own coordinates.
Vec3 in_frame(const Frame& frame, Vec3 point);
Vec3 direction_in_frame(const Frame& frame, Vec3 direction);
// A point of space (in a's coordinates) in the coordinates of a frame, dropped to its page.
inline Vec2 on_page(const Frame& frame, Vec3 p) {
    const Vec3 local = in_frame(frame, p);
    return {local.x, local.y};
}

// Whether the plates are kept apart in the whole range, for certain or but for kFirmMm: one of them stays on
// one side of the other's plane, which is how plates are that share a fold, a seam or an apex; or all corners
// of b stay beyond one side of a box round a. Cost: corners of the hulls.
enum class Sides { both, one_nearly, one };
Sides sides_of(const PairPose& pose);

enum class Nearness {
    clear,    // further apart than the distance asked for, in the whole range
    unknown,  // not that
    within,  // nearer than the distance asked for, in the whole range; for distance 0: they meet in this pose
};
struct Found {
    Nearness nearness = Nearness::clear;
    double least_mm = std::numeric_limits<double>::infinity();  // in this pose, of what could not be cleared
};

// Compares `distance_mm` with the distance of the plates' cores (whole: of the plates). Memory is kept for
// the next call; one caller at a time. Cost: triangles of one that come near the other's, found by a tree.
class NearnessTest {
 public:
    // True only if the cores do not meet in the whole range.
    bool clear(const PairPose& pose);
    Found operator()(const PairPose& pose, double distance_mm, bool whole);
    // How far points of one plate's core that may meet the other's move at most within the range.
    double stray_of_near(const PairPose& pose);
    // The smallest distance of the plates in this pose and its points, in a's page coordinates; the distance
    // is `limit_mm` when it is not less. The arms are not looked at.
    ClosestPoints least(const PairPose& pose, double limit_mm);

 private:
    Found look(const PairPose& pose, double distance_mm, bool whole, bool to_the_end, std::size_t& first);
    template <typename Margin, typename Use>
    std::size_t each_near(const PairPose& pose, bool whole, const Margin& margin, const Use& use,
                          std::size_t first = 0);
    struct Piece {
        Triangle3 corners;
        std::array<double, 3> strays;  // of each corner
        int level;
    };
    bool cleared(const Triangle3& fixed, const Triangle3& moving, const Moves& moves, double distance_mm,
                 Found& found);
    // The triangle for which clear() was last false: of a range next to that it mostly is, too.
    std::size_t not_cleared_ = 0;
    std::vector<int> near_;
    std::vector<Piece> pieces_;
};

}  // namespace popup
