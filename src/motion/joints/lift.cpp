// The floating layer: two walls and a pillar, all of one height h, carry a top whose halves stay parallel to
// the planes that the walls stand on.
//
// On each side the plane, the wall, the half of the top and the pillar are a parallelogram with the sides p
// and h. So the pillar and both walls have one direction u, square to the fold, and the opening leaves open
// which: the bisector is what the symmetry of the two sides makes of it.
#include <fmt/format.h>

#include "motion/joints/upright.h"

namespace popup {
namespace {

// The turns as they stand in the list.
enum LiftTurn {
    kLeftWallTurn,
    kRightWallTurn,
    kTopLeftTurn,
    kTopRightTurn,
    kTopCentreTurn,
    kPillarFootTurn,
    kPillarHeadTurn
};

}  // namespace

JointPlates plates_of(const Lift& how) {
    JointPlates result;
    for (const Upright* wall : {&how.left, &how.right}) {
        result.places.push_back({wall->plate, wall->drive, wall->own_at, Lying::free});
        result.needs.push_back(wall->drive);
    }
    result.places.push_back({how.top_left.plate, how.left.plate, how.top_left.own_at, Lying::free});
    result.places.push_back({how.top_right.plate, how.right.plate, how.top_right.own_at, Lying::free});
    result.places.push_back({how.pillar.plate, how.left.drive, how.pillar.own_at, Lying::free});
    return result;
}

// All of them follow the parent fold.
JointTurns turns_of(const Lift& how) {
    JointTurns result;
    result.stands_on = {how.left.drive, how.right.drive};
    const Leaf& l = how.top_left;
    const Leaf& r = how.top_right;
    const Leaf& pillar = how.pillar;
    result.turns = {
        turn_of(how.left),
        turn_of(how.right),
        {l.plate, how.left.plate, l.own_at, l.own_along},
        {r.plate, how.right.plate, r.own_at, r.own_along},
        {l.plate, r.plate, l.own_at + how.left.near * l.own_across, l.own_along},
        {pillar.plate, how.left.drive, pillar.own_at, pillar.own_along},
        {pillar.plate, l.plate, pillar.own_at + how.height * pillar.own_across, pillar.own_along}};
    result.ways = {{kLeftWallTurn, JointTurn::kNone},
                   {kRightWallTurn, JointTurn::kNone},
                   {kTopLeftTurn, kTopCentreTurn},
                   {kTopRightTurn, kTopCentreTurn},
                   {kPillarFootTurn, kPillarHeadTurn}};
    return result;
}

bool place_plates(const Lift& how, Angle /*theta*/, std::span<Frame> frames) {
    const FoldFrame fold = fold_frame(how.left, how.right, frames, how.outside);
    const Vec3 up = how.height * fold.bisector;
    const auto put = [&](const Upright& wall, const Leaf& top) {
        const Frame& drive = frames[static_cast<std::size_t>(wall.drive)];
        frames[static_cast<std::size_t>(wall.plate)] = wall_frame(wall, fold, drive);
        frames[static_cast<std::size_t>(top.plate)] =
            leaf_frame(top, drive.point(wall.foot_at) + up, fold.along, -drive.direction(wall.fold_out));
    };
    put(how.left, how.top_left);
    put(how.right, how.top_right);
    const Frame& drive = frames[static_cast<std::size_t>(how.left.drive)];
    frames[static_cast<std::size_t>(how.pillar.plate)] =
        leaf_frame(how.pillar, drive.point(how.left.fold_at), fold.along, fold.bisector);
    return true;
}

Likeness likeness(const Lift& how) {
    return {how.outside ? 1 : 0,        how.left.drive,        how.right.drive, to_compare(how.left.near),
            to_compare(how.right.near), to_compare(how.height)};
}

std::optional<Slid> slid(const Lift& how, double mm) { return slid_along_fold(how, mm); }

std::optional<std::string> fault_of(const Lift& how) {
    if (auto fault = fault_of(how.left, how.right)) return fault;
    for (const auto& [leaf, name] :
         {std::pair(&how.top_left, "top_left"), std::pair(&how.top_right, "top_right"),
          std::pair(&how.pillar, "pillar")}) {
        if (auto fault = fault_of(*leaf, name)) return fault;
    }
    if (!(how.height > 0.0)) return "height_mm is not more than 0";
    return std::nullopt;
}

std::optional<Parallelism> parallelism(const Lift& /*how*/) { return std::nullopt; }

}  // namespace popup
