// Joints: how the frames of plates follow from the opening and from the frames of others.
//
// A closed set, one row a kind: its struct here, its place in POPUP_JOINT_KINDS, and what it says of its
// motion in a file of its own, src/motion/joints/KIND.cpp. No pass over a motion knows a kind: it asks which
// plates a joint places and needs (plates_of), where they are (place), and how they turn over a range
// (motion/joints/joint.h).
//
// A kind names its values once, in fields(): what writes or reads a joint goes through that.
//
//     for (const PlacedPlate& one : plates_of(joint).places) parent[one.plate] = one.parent;
//     if (const auto* bars = std::get_if<FourBar>(&joint.how)) ...   // only the kind's own file and its
//     tests
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup {

// A plate that turns with the opening about a line of the world: half the opening to its side.
struct Drive {
    int plate = -1;
    Vec2 axis_at;   // a point of the line; the plate's page lies in the world as the card lies open
    Vec2 axis_dir;  // unit
    int turns = 1;  // -1: the plate on the left of the line, +1: the one on its right

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("plate", self.plate);
        to.point("axis_at", self.axis_at);
        to.direction("axis_dir", self.axis_dir);
        to.sign("turns", self.turns);
    }
};

// One side of a four-bar linkage: a driving plate, and the element plate hinged to it along the seam.
// Angled: directions are seen from the apex. Parallel: across the fold.
struct Bar {
    int drive = -1;   // driving plate
    int plate = -1;   // plate this joint places
    Vec2 fold_at;     // on the driving plate's page: the apex (angled), any point of the fold (parallel)
    Vec2 fold_dir;    // unit, along the parent fold, into the V
    Vec2 fold_out;    // unit, perpendicular to fold_dir, from the fold into the driving plate
    Vec2 seam_at;     // a point of the seam or side fold on the driving plate's page (angled: the apex)
    Vec2 seam_dir;    // unit, on the driving plate's page: along the seam, away from the apex (parallel:
                      // fold_dir)
    Vec2 own_at;      // the same point on the element plate's own page
    Vec2 own_seam;    // unit, on its own page: along the seam, away from the apex (parallel: along fold_dir)
    Vec2 own_centre;  // unit, on its own page: along the centre fold, away from the apex (parallel: across,
                      // from the seam towards the centre fold)
    double near = 0.0;  // a, b: angle fold–seam (rad); parallel p, q: distance fold–seam (mm). > 0
    double far = 0.0;   // g, h: angle seam–centre fold; parallel s1, s2: distance

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to, bool parallel) {
        to.plate("drive", self.drive);
        to.plate("plate", self.plate);
        to.point("fold_at", self.fold_at);
        to.direction("fold_dir", self.fold_dir);
        to.direction("fold_out", self.fold_out);
        to.point("seam_at", self.seam_at);
        to.direction("seam_dir", self.seam_dir);
        to.point("own_at", self.own_at);
        to.direction("own_seam", self.own_seam);
        to.direction("own_centre", self.own_centre);
        if (parallel) {
            to.length("near_mm", self.near);
            to.length("far_mm", self.far);
        } else {
            to.angle("near_deg", self.near);
            to.angle("far_deg", self.far);
        }
    }
};

// How a four-bar lies in the closed card.
enum class Closing {
    half_turn,  // its far sides equal the opposite near ones; the centre is the half turn of the fold
    inside,     // it closes inside the fold (closed dihedral 0°)
    outside,    // it closes beyond the fold (closed dihedral 360°)
};
inline constexpr std::array<std::string_view, 3> kClosingNames{"half-turn", "inside", "outside"};

// Two plates that share a centre fold, on two driving plates that share the parent fold:
// motion/joints/four_bar.h.
struct FourBar {
    Closing closing = Closing::half_turn;
    bool parallel = false;  // else the four lines meet in one point, the apex
    Bar left, right;

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.word("closing", self.closing, kClosingNames);
        to.flag("parallel", self.parallel);
        to.object("left", [&](auto& inside) { Bar::fields(self.left, inside, self.parallel); });
        to.object("right", [&](auto& inside) { Bar::fields(self.right, inside, self.parallel); });
    }
};

// A plate that is glued flat on another, or lies beside it in one plane.
struct Rigid {
    int plate = -1;
    int base = -1;  // the plate that it lies on
    Vec2 base_at,
        base_dir;          // a point of the base's page, and a direction (unit): where own_at and own_dir lie
    Vec2 own_at, own_dir;  // the same on its own page
    bool back = false;     // it lies on the base's back, with its own front away from it
    bool behind = false;   // it lies on the base's back, with its own front towards it; not both
    // It is not glued on the base: both are parts of one plane that a hinge beside them keeps level, such as
    // two lugs on one fold. Not with back or behind.
    bool beside = false;

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("plate", self.plate);
        to.plate("base", self.base);
        to.point("base_at", self.base_at);
        to.direction("base_dir", self.base_dir);
        to.point("own_at", self.own_at);
        to.direction("own_dir", self.own_dir);
        to.flag("back", self.back);
        to.flag_if_set("behind", self.behind);
        to.flag_if_set("beside", self.beside);
    }
};

// A plate that stands on a driving plate along a line parallel to the parent fold, upright: in the direction
// of the bisector of the two driving plates.
struct Upright {
    int drive = -1;     // driving plate
    int plate = -1;     // plate this joint places
    Vec2 fold_at;       // on the driving plate's page: any point of the fold
    Vec2 fold_dir;      // unit, along the parent fold
    Vec2 fold_out;      // unit, perpendicular to fold_dir, from the fold into the driving plate
    Vec2 foot_at;       // a point of the line that it stands on, on the driving plate's page
    Vec2 own_at;        // the same point on its own page
    Vec2 own_along;     // unit, on its own page: along fold_dir
    Vec2 own_across;    // unit, on its own page: up
    double near = 0.0;  // from the fold to that line, mm. > 0

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("drive", self.drive);
        to.plate("plate", self.plate);
        to.point("fold_at", self.fold_at);
        to.direction("fold_dir", self.fold_dir);
        to.direction("fold_out", self.fold_out);
        to.point("foot_at", self.foot_at);
        to.point("own_at", self.own_at);
        to.direction("own_along", self.own_along);
        to.direction("own_across", self.own_across);
        to.length("near_mm", self.near);
    }
};

// A plate that hangs on others by its joint: a point of it and two directions on its own page, which say what
// the joint makes of them.
struct Leaf {
    int plate = -1;
    Vec2 own_at;
    Vec2 own_along, own_across;  // unit, perpendicular

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("plate", self.plate);
        to.point("own_at", self.own_at);
        to.direction("own_along", self.own_along);
        to.direction("own_across", self.own_across);
    }
};

// One end of a prism: two plates, each as wide as the walls are from the fold, hinged to the walls along
// lines that stand up from the fold's planes, and to each other along the middle fold.
struct PrismEnd {
    double along = 0.0;  // of its hinges to the walls, from foot_at in fold_dir, mm
    int into = 1;        // the middle fold goes along fold_dir (1) or against it (-1) as the card closes
    Leaf left, right;    // own_at: the foot of the hinge to the wall; own_along: up it; own_across: towards
                         // the middle fold

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.length("along_mm", self.along);
        to.sign("into", self.into);
        to.object("left", [&](auto& inside) { Leaf::fields(self.left, inside); });
        to.object("right", [&](auto& inside) { Leaf::fields(self.right, inside); });
    }
};

// Two walls at one distance on either side of a fold, and two ends that fold in their middle: the box. The
// hinges of the ends are parallel and hold the walls in the bisector: motion/joints/prism.cpp.
struct Prism {
    bool outside = false;  // over a mountain fold (closed dihedral 360°); else over a valley fold (0°)
    Upright left, right;
    PrismEnd begin, end;  // in the order in which they stand along fold_dir

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.flag("outside", self.outside);
        to.object("left", [&](auto& inside) { Upright::fields(self.left, inside); });
        to.object("right", [&](auto& inside) { Upright::fields(self.right, inside); });
        to.object("begin", [&](auto& inside) { PrismEnd::fields(self.begin, inside); });
        to.object("end", [&](auto& inside) { PrismEnd::fields(self.end, inside); });
    }
};

// Two walls and a pillar on the fold, all equally high, and on them a top of two halves, each parallel to its
// driving plate: the floating layer. Walls and pillar may lean together, one way: it is shown in the
// bisector, where its symmetry has it.
struct Lift {
    bool outside = false;  // as of Prism
    double height = 0.0;   // of walls and pillar, mm. > 0
    Upright left, right;   // the walls
    // Halves of the top. own_at: the point over the wall's foot_at; own_along: along fold_dir; own_across:
    // towards the centre fold, which is `near` of the wall away.
    Leaf top_left, top_right;
    Leaf pillar;  // own_at: the point at fold_at of the left wall; own_along: along fold_dir; own_across: up

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.flag("outside", self.outside);
        to.length("height_mm", self.height);
        to.object("left", [&](auto& inside) { Upright::fields(self.left, inside); });
        to.object("right", [&](auto& inside) { Upright::fields(self.right, inside); });
        to.object("top_left", [&](auto& inside) { Leaf::fields(self.top_left, inside); });
        to.object("top_right", [&](auto& inside) { Leaf::fields(self.top_right, inside); });
        to.object("pillar", [&](auto& inside) { Leaf::fields(self.pillar, inside); });
    }
};

// A plate that turns about a line of `carrier`, and stays parallel to `like`: one of the plates of an
// origamic architecture, where all that stands is parallel to the back and all that lies to the floor. `like`
// and `carrier` turn against each other about a line parallel to that one. Whatever folds lead from the plate
// to the two, its parallelograms hold it there: motion/joints/parallel.cpp.
struct Parallel {
    int plate = -1;                // the plate that it places
    int base = -1;                 // the plate whose hinge it hangs on; any that is placed before it
    Vec2 base_at;                  // a point of that hinge, on the plate's own page
    int like = -1;                 // their fronts face the same way
    int carrier = -1;              // or the extension of its plane: the line need not lie on its paper
    Vec2 carrier_at, carrier_dir;  // a point of the line, and its direction (unit), on the carrier's page
    Vec2 own_at, own_dir;          // the same point and direction on the plate's own page

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("plate", self.plate);
        to.plate("base", self.base);
        to.point("base_at", self.base_at);
        to.plate("like", self.like);
        to.plate("carrier", self.carrier);
        to.point("carrier_at", self.carrier_at);
        to.direction("carrier_dir", self.carrier_dir);
        to.point("own_at", self.own_at);
        to.direction("own_dir", self.own_dir);
    }
};

// A plate that the world holds still, on the page as it is: the one that a folded sheet is folded from.
struct Still {
    int plate = -1;

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("plate", self.plate);
    }
};

// A plate that is folded from its base along a line of the page that both share, by an angle that the opening
// alone says. Of the folds of one sheet each has its own law; that its loops stay closed is their maker's
// affair (src/folded/).
struct Folded {
    int plate = -1;
    int base = -1;  // lies on the right of the line
    Vec2 at, dir;   // a point of the line, and its direction (unit)
    // (opening, angle), both in degrees, by opening. The angle is 0 where both plates lie in one plane,
    // positive where they are folded to their front. Between two points alone it goes straight. Else there
    // are kLawSteps of them, and one more, to a range, neighbours sharing their end: in each range the angle
    // is the polynomial through its points, whose openings are Chebyshev points of the second kind. Before
    // the first point and behind the last it stays as it is.
    std::vector<Vec2> law;
    static constexpr std::size_t kLawSteps = 12;

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("plate", self.plate);
        to.plate("base", self.base);
        to.point("at", self.at);
        to.direction("dir", self.dir);
        to.value("law_deg", self.law);
    }
};
// A fold that closes a loop of a folded sheet: both its plates are placed by other joints, and it says how
// they turn against each other.
struct LoopFold {
    int plate = -1;
    int base = -1;          // on the right of the line
    Vec2 at, dir;           // as of Folded
    std::vector<Vec2> law;  // as of Folded

    template <typename Self, typename Fields>
    static void fields(Self& self, Fields& to) {
        to.plate("plate", self.plate);
        to.plate("base", self.base);
        to.point("at", self.at);
        to.direction("dir", self.dir);
        to.value("law_deg", self.law);
    }
};

// Where the Chebyshev point `i` of the second kind lies in its range, from 0 at its begin to 1 at its end, of
// 0 <= i <= Folded::kLawSteps: (1 - cos(pi i / kLawSteps)) / 2.
double chebyshev_share(std::size_t i);
// The angle of a law at an opening, in degrees: its polynomial by the barycentric formula (Berrut and
// Trefethen, Barycentric Lagrange Interpolation, 2004). Precondition: the law is one, as fault_of() has it.
double fold_angle_deg(const std::vector<Vec2>& law, double opening_deg);

// All kinds, and the names by which files know them: the table. Its row is ROW(struct, name).
#define POPUP_JOINT_KINDS(ROW) \
    ROW(Drive, "drive")        \
    ROW(FourBar, "four-bar")   \
    ROW(Rigid, "rigid")        \
    ROW(Prism, "prism")        \
    ROW(Lift, "lift")          \
    ROW(Parallel, "parallel")  \
    ROW(Still, "still")        \
    ROW(Folded, "folded")      \
    ROW(LoopFold, "loop-fold")

template <typename Nothing, typename... Kinds>
using JointVariant = std::variant<Kinds...>;
#define POPUP_KIND(Kind, name) , Kind
using JointKind = JointVariant<void POPUP_JOINT_KINDS(POPUP_KIND)>;
#undef POPUP_KIND
#define POPUP_KIND_NAME(Kind, name) std::string_view{name},
// By the variant's index.
inline constexpr std::array<std::string_view, std::variant_size_v<JointKind>> kJointNames{
    POPUP_JOINT_KINDS(POPUP_KIND_NAME)};
#undef POPUP_KIND_NAME

// Places its plates from plates placed before it.
struct Joint {
    std::string name;  // the element, or "page"
    Place place;       // of the element in the source
    JointKind how;
};

// How a plate lies on its parent.
enum class Lying {
    free,      // it turns against it
    on_front,  // it is glued flat on its front
    on_back,
    beside,  // it moves with it in one plane, and lies nowhere on it
};

// A plate that a joint places.
struct PlacedPlate {
    int plate = -1;
    int parent = -1;  // the plate it turns about or lies on; -1: the world
    Vec2 pivot;       // a point of the line it turns about, on its own page
    Lying lying = Lying::free;
};

struct JointPlates {
    std::vector<PlacedPlate> places;
    std::vector<int> needs;  // plates that must have been placed before
};
JointPlates plates_of(const Joint& joint);

// What is wrong with the joint's own values, as half a sentence with the numbers: "near_deg is 30, but its
// lines make 31.5". nullopt: nothing; then it moves as the kind promises, if its plates are hinged as it
// says. For joints that others wrote.
std::optional<std::string> fault_of(const Joint& joint);

}  // namespace popup
