// The box: two walls at one distance p on either side of a fold, held upright by ends that fold in their
// middle.
//
// All hinges of the ends are parallel, so both walls have one upright direction u, square to the fold. The
// lower edges of an end are square to u, too, so the line between its feet is; and since both feet are p away
// from the fold, u is the bisector. That line is 2 p s long, with c and s the cosine and sine of half the
// dihedral angle. The halves of an end are p wide: the middle fold lies p |c| beside it, along the fold.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "motion/joints/upright.h"

namespace popup {
namespace {

// The turns as they stand in the list: those of the walls, then of the front end, then of the back end.
constexpr int kLeftFootTurn = 0;
constexpr int kRightFootTurn = 1;
enum EndTurn { kLeftCornerTurn, kRightCornerTurn, kMiddleTurn };
constexpr int begin_turn(EndTurn turn) { return 2 + static_cast<int>(turn); }
constexpr int end_turn(EndTurn turn) { return 5 + static_cast<int>(turn); }

void place_end(const Prism& how, const PrismEnd& end, const FoldFrame& fold, std::span<Frame> frames) {
    const auto put = [&](const Upright& wall, const Leaf& leaf, double across) {
        const Frame& drive = frames[static_cast<std::size_t>(wall.drive)];
        const Vec3 foot = drive.point(wall.foot_at + end.along * wall.fold_dir);
        const Vec3 middle = across * fold.s * fold.across + (end.into * std::abs(fold.c)) * fold.along;
        frames[static_cast<std::size_t>(leaf.plate)] = leaf_frame(leaf, foot, fold.bisector, middle);
    };
    put(how.left, end.left, 1.0);
    put(how.right, end.right, -1.0);
}

}  // namespace

JointPlates plates_of(const Prism& how) {
    JointPlates result;
    for (const Upright* wall : {&how.left, &how.right}) {
        result.places.push_back({wall->plate, wall->drive, wall->own_at, Lying::free});
        result.needs.push_back(wall->drive);
    }
    for (const PrismEnd* end : {&how.begin, &how.end}) {
        result.places.push_back({end->left.plate, how.left.plate, end->left.own_at, Lying::free});
        result.places.push_back({end->right.plate, how.right.plate, end->right.own_at, Lying::free});
    }
    return result;
}

// All turns follow the parent fold. Those of the ends go back where it passes flat, which stretches the ends.
JointTurns turns_of(const Prism& how) {
    JointTurns result;
    result.stands_on = {how.left.drive, how.right.drive};
    result.turns = {turn_of(how.left), turn_of(how.right)};
    const std::array<int, 2> beside{kLeftFootTurn, kRightFootTurn};
    for (const PrismEnd* end : {&how.begin, &how.end}) {
        const Leaf& l = end->left;
        const Leaf& r = end->right;
        result.turns.push_back({l.plate, how.left.plate, l.own_at, l.own_along, JointTurn::kParent, beside});
        result.turns.push_back({r.plate, how.right.plate, r.own_at, r.own_along, JointTurn::kParent, beside});
        result.turns.push_back({l.plate, r.plate, l.own_at + how.left.near * l.own_across, l.own_along,
                                JointTurn::kParent, beside});
    }
    result.ways = {{kLeftFootTurn, JointTurn::kNone},
                   {kRightFootTurn, JointTurn::kNone},
                   {begin_turn(kLeftCornerTurn), begin_turn(kMiddleTurn)},
                   {begin_turn(kRightCornerTurn), begin_turn(kMiddleTurn)},
                   {end_turn(kLeftCornerTurn), end_turn(kMiddleTurn)},
                   {end_turn(kRightCornerTurn), end_turn(kMiddleTurn)}};
    return result;
}

bool place_plates(const Prism& how, Angle /*theta*/, std::span<Frame> frames) {
    const FoldFrame fold = fold_frame(how.left, how.right, frames, how.outside);
    for (const Upright* wall : {&how.left, &how.right}) {
        frames[static_cast<std::size_t>(wall->plate)] =
            wall_frame(*wall, fold, frames[static_cast<std::size_t>(wall->drive)]);
    }
    place_end(how, how.begin, fold, frames);
    place_end(how, how.end, fold, frames);
    return true;
}

// The walls of boxes beside one another move as one body, but their ends do not: each turns about its own
// corner.
Likeness likeness(const Prism& /*how*/) { return {}; }

std::optional<Slid> slid(const Prism& how, double mm) { return slid_along_fold(how, mm); }

std::optional<std::string> fault_of(const Prism& how) {
    if (auto fault = fault_of(how.left, how.right)) return fault;
    for (const auto& [leaf, name] :
         {std::pair(&how.begin.left, "begin.left"), std::pair(&how.begin.right, "begin.right"),
          std::pair(&how.end.left, "end.left"), std::pair(&how.end.right, "end.right")}) {
        if (auto fault = fault_of(*leaf, name)) return fault;
    }
    if (!same_length(how.left.near, how.right.near)) {
        return fmt::format("it does not fold flat: its walls are {:.6f} and {:.6f} mm away from the fold",
                           how.left.near, how.right.near);
    }
    const double across = dot(how.right.foot_at - how.right.fold_at, how.right.fold_dir) -
                          dot(how.left.foot_at - how.left.fold_at, how.left.fold_dir);
    if (!same_length(across, 0.0))
        return fmt::format("its walls begin {:.6f} mm apart along the fold, and their ends must be opposite",
                           std::abs(across));
    return std::nullopt;
}

std::optional<Parallelism> parallelism(const Prism& /*how*/) { return std::nullopt; }

}  // namespace popup
