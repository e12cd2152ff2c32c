// What the passes over a motion ask of a joint. Each kind answers all of it in its own file beside this one;
// a kind that leaves an answer out does not link.
//
//     for (const Joint& joint : assembly.joints)               // in their order
//         if (!place_plates(joint, opening, frames)) ...       // it cannot get there
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "popup/joints.h"
#include "popup/units.h"

namespace popup {

// A turn of a joint: two plates that turn against each other about a line, and what bounds how far they turn
// over a range of openings.
struct JointTurn {
    int plate = -1;  // on whose page the line is
    int other = -1;  // -1: the world
    Vec2 at, dir;    // a point of the line, and its direction (unit)
    // Numbers in JointTurns::turns, or one of the two below. A turn goes one way as long as its opposite is
    // neither unfolded nor folded flat; where it may turn back it goes no further than its opposite and its
    // two sides together.
    static constexpr int kNone = -1;    // opposite: it goes one way throughout; side: the opening of the card
    static constexpr int kParent = -2;  // the turn between the two plates that the joint stands on
    int opposite = kNone;
    std::array<int, 2> sides{kNone, kNone};
    bool still = false;  // against the world, of which it is a part: no opening turns it
    // Where its angle follows a law (Folded of popup/joints.h), that of the joint; it may turn back anywhere.
    // Else empty.
    std::span<const Vec2> law = {};
};

struct JointTurns {
    std::vector<JointTurn> turns;
    // Plates that share the parent fold; -1: there is none. The joint has least room where that fold passes
    // flat.
    std::array<int, 2> stands_on{-1, -1};
    // A turn whose plate the joint does not place leads from one plate to the other besides all others.
    // For each plate of plates_of().places: its turn towards the world, and another that leads on to a plate
    // of the same joint; kNone: there is none, it lies on its parent and moves with it.
    struct Ways {
        int up = JointTurn::kNone, across = JointTurn::kNone;
    };
    std::vector<Ways> ways;
};
JointTurns turns_of(const Joint& joint);

// Places the plates of the joint from frames placed before; false when it cannot reach the opening. `frames`:
// one a plate of the assembly.
bool place_plates(const Joint& joint, Angle theta, std::span<Frame> frames);

// Two joints with equal values move their plates alike, plate for plate, as one body. Empty: it is like no
// other.
using Likeness = std::vector<long long>;
Likeness likeness(const Joint& joint);

// The joint of an element that was drawn `mm` further along what it stands on, and by what its points would
// move on their page (that of its first driving plate). What stands on it follows. nullopt: it cannot be
// moved.
struct Slid {
    JointKind how;
    Vec2 by;
    std::string_view along;  // "fold", in messages
};
std::optional<Slid> slid(const Joint& joint, double mm);

// That a plate of the joint stays parallel to `like`, and crosses the plane of `carrier` in a line that keeps
// its place on both.
struct Parallelism {
    int plate = -1, like = -1, carrier = -1;
};
std::optional<Parallelism> parallelism(const Joint& joint);

// What each kind answers, for the functions above (and plates_of() and fault_of() of popup/joints.h).
#define POPUP_KIND_ANSWERS(Kind, name)                                        \
    JointPlates plates_of(const Kind& how);                                   \
    JointTurns turns_of(const Kind& how);                                     \
    bool place_plates(const Kind& how, Angle theta, std::span<Frame> frames); \
    Likeness likeness(const Kind& how);                                       \
    std::optional<Slid> slid(const Kind& how, double mm);                     \
    std::optional<Parallelism> parallelism(const Kind& how);                  \
    std::optional<std::string> fault_of(const Kind& how);
POPUP_JOINT_KINDS(POPUP_KIND_ANSWERS)
#undef POPUP_KIND_ANSWERS

// For fault_of(): whether a direction is one, lengths and angles (radians) are equal, and directions square.
bool is_unit(Vec2 direction);
bool same_length(double a, double b);
bool same_angle(double a, double b);
bool are_square(Vec2 a, Vec2 b);

// A length or the part of a direction as likeness() compares it: to 1e-9.
long long to_compare(double value);

}  // namespace popup
