// Motion: where every plate is at every opening angle, and whether it may be.
//
// Opening angle: 0° closed, 180° flat open. The spine stays still and both base planes move alike
// (Hendrix 5.4.4): a point at distance c from the gutter goes to x = ±c sin(θ/2), z = c cos(θ/2).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "popup/assembly.h"
#include "popup/units.h"

namespace popup {

enum class Solver {
    closed_form,  // one closed-form solve a linkage; exact to rounding at every angle
    iterative,    // Hendrix's placement by distances (thesis, figure 5.16), 5000 repeats: baseline and
                  // cross-check
};

// What an examination has found, for the next one of the same design, of which a little has changed since. A
// pair of plates that did not change keeps its findings, and what moves as it did is not taken through the
// sweep again. Results are those of an examination without a memory, but for Examination::pairs and poses,
// which count what was looked at at any time, and `locks` that only finer steps of others would show.
//
//     ExaminationMemory memory;
//     MotionOptions options;
//     options.memory = &memory;
//     simulate(assembly, options, diagnostics);          // looks at everything
//     simulate(changed, options, more);                  // looks at what has changed
//     fmt::print("{} of {} pairs", memory.share().examined_pairs, memory.share().pairs);
//
// Another design, other options, a fold that moves by a law, folds that all run one way, or a change of more
// than a quarter of the plates, cost a whole examination. Memory: some kilobytes a plate. Movable; one caller
// at a time.
class ExaminationMemory {
 public:
    ExaminationMemory();
    ~ExaminationMemory();
    ExaminationMemory(ExaminationMemory&&) noexcept;
    ExaminationMemory& operator=(ExaminationMemory&&) noexcept;

    // How much the last examination looked at.
    struct Share {
        std::size_t plates = 0, changed_plates = 0;   // changed: they move otherwise, or have another outline
        std::size_t pairs = 0, examined_pairs = 0;    // pairs of plates that come near each other
        std::size_t layers = 0, examined_layers = 0;  // pairs of plates over one another in the closed card
    };
    [[nodiscard]] const Share& share() const { return share_; }

 private:
    friend class Recall;
    struct Kept;
    std::unique_ptr<Kept> kept_;
    Share share_;
};

struct MotionOptions {
    std::vector<Angle> angles;  // empty: 0, 5, … 180. Each in [0°, 180°], ascending
    Solver solver = Solver::closed_form;
    bool examine = true;                 // look for collisions, protrusion and layers
    std::optional<double> clearance_mm;  // > 0: also name the pairs that come closer than this
    std::optional<double> paper_mm;  // > 0: thickness of the paper; gives the thickness of the closed card
    Tolerances tolerances;
    // Look for moves of elements that would part what collides, sticks out or lies on another: for hints, and
    // for Motion::moves. It can take longer than all else.
    bool find_moves = true;
    // Of earlier examinations of the design, looked up and renewed. Null: there is none. Not used where folds
    // are put in an order. It must outlive the call.
    ExaminationMemory* memory = nullptr;
    // Called for an element that sticks out of the closed card by `by_mm`. Returns a size that was tried and
    // keeps it inside, in the words of a hint; nullopt: none does. Empty: hints name no size.
    std::function<std::optional<std::string>(const std::string& element, double by_mm)> fitting_size = {};
    // Called for a move of an element that was tried and would be told. Returns whether it may be: whether
    // the design, changed so, is the one that was tried, and what else the caller asks. If not, another move
    // is looked for. Empty: all moves are told.
    std::function<bool(const std::string& element, Vec2 by)> move_holds = {};
    // Called for a move of an element that a hint tells, by so many mm on the page of its left driving plate.
    // Returns what to type for it; nullopt: nothing does it. Empty: hints name no command.
    std::function<std::optional<std::string>(const std::string& element, Vec2 by)> move_command = {};
};

// Two plates that cross, from the first to the last angle of one contact (each to 0.001°).
//
// Plates cross where they share a point more than 0.01 mm from every edge of both, and the largest disc of
// paper round it that both have rises more than 0.0025 mm out of the other plate on either side. So what
// touches along folds, seams, corners or cut edges, or lies flat on one another, does not cross. Contact
// begins and ends where that is 0.0001 mm (below 1°, where all shrinks, that times the angle in degrees), and
// plates that go wholly through each other between two angles, face to face, are in contact there. Where a
// fold lies in a plate's plane, each of its two plates only touches that plate, and yet the paper that is
// folded there may lie on both sides of it: a contact with either, `at_fold`.
struct Contact {
    int a = 0, b = 0;       // plates, a < b
    double from_deg = 0.0;  // Sweep::from_deg when they still cross at the smallest angle looked at
    double to_deg = 0.0;    // the first contact as the card closes
    // The shortest way by which one must move, square to itself or to the other, until the two are apart; at
    // the angle where that is longest.
    double depth_mm = 0.0;
    double deepest_deg = 0.0;
    double excess_mm = 0.0;  // the most that `longer` reaches through the other, measured on its own paper
    int longer = 0;  // a or b: the one that needs to be shortened the least; it is too long by excess_mm
    Vec3 point;      // of both, at to_deg
    Vec2 corner{};   // of `longer`, on its page: what reaches furthest through, at deepest_deg
    bool at_fold = false;  // `longer` goes through a fold of the other: depth and excess are 0
};

// Two plates that cannot be told apart or together within the work allowed.
struct Undecided {
    int a = 0, b = 0;
    double from_deg = 0.0, to_deg = 0.0;
};

// Two plates that come closer than MotionOptions::clearance_mm without crossing. Not looked at: plates that
// share a fold, a seam or a corner, or never move against each other; below 45° those that stay as close
// until the card is closed, because folding flat brings everything together; and above 135° those that stay
// as close until they lie in one plane, or touch, on the open card: as a wall that stands on the page.
struct Approach {
    int a = 0, b = 0;
    double from_deg = 0.0, to_deg = 0.0;  // closer than that from … to
    double least_mm = 0.0;                // the smallest distance, and where
    double least_deg = 0.0;
    Vec3 point;  // on plate a, at least_deg
};

// A plate that sticks out of the closed card.
struct Protrusion {
    int plate = 0;
    double by_mm = 0.0;  // how far its furthest point is from the card
    Vec3 direction;      // unit, in the world at 0°: from the card's edge to that point. y runs along the
                         // gutter, z away from it
    Vec3 point;          // that point
    Vec2 corner{};       // the same on the plate's page
};

// What sticks out of the closed card as the assembly stands, by plate. Precondition: it has covers and closes
// flat. Protrusion is judged at the beginning of the sweep, against the covers before anything was cut from
// them, and counts from 0.02 mm. Cost: that of placing all plates, and linear in their corners.
std::vector<Protrusion> find_protrusions(const Assembly& assembly);

// The closed card: plates one above the other.
struct ClosedCard {
    std::vector<Protrusion> protrusions;  // by plate
    int max_layers = 0;  // the most plates over one point, tabs not counted; 0: too many to count
    Vec3 thickest;       // such a point
    // All plates in an order in which they can lie on one another, from the left cover to the right one;
    // nullopt when there is none, or when there are too many layers to count.
    std::optional<std::vector<int>> order;
    // When there is none: plates of which each lies below the next somewhere, and the last below the first.
    std::vector<int> cycle;
    std::optional<double> thickness_mm;  // max_layers sheets of MotionOptions::paper_mm
};

// What was found out about the motion, for every angle between undecided_below_deg and decided_up_to_deg.
struct Examination {
    double undecided_below_deg = 0.0;
    double decided_up_to_deg =
        180.0;  // less where mechanisms stand so high on one another that the work ended there
    std::vector<Contact> contacts;                    // by a, b, from_deg
    std::vector<Undecided> undecided;                 // by a, b, from_deg
    std::optional<std::vector<Approach>> approaches;  // none: not asked for. By a, b, from_deg
    ClosedCard closed;
    std::size_t pairs =
        0;  // pairs of plates that were near enough to be looked at, counted once an angle cell
    std::size_t poses = 0;  // poses of pairs that were looked at
};

// Plates that hang together and can still move while the card stands still at an opening, as a finger that
// pushes them shows: the opening does not force them.
struct FreePlates {
    std::vector<int> plates;  // ascending
    int ways = 1;             // how many: so many numbers settle, besides the opening, where the plates are
    int lines = 0;            // folds and seams that hold them, among themselves and to others
    bool parallel = false;    // all of these run in one direction
};

// What would keep two elements from colliding, or from lying on one another: tried out by the examination,
// not guessed. The element is moved along what it stands on, as if its points had been drawn there, stays on
// that, and meets nothing and lets nothing stick out that did not before. Tabs, and cuts of others on its
// way, are not looked at.
struct FreeingMove {
    std::string element;     // the one that moves: the name of its joint
    std::string other;       // that of the other
    Place place;             // of the finding that the two collide, or lie on one another
    Place other_place;       // of the other element that this names
    Vec2 by;                 // mm, on the page of its left driving plate
    std::string_view along;  // what it moves along, in words: "fold"
};

// What the simulation found. Frames are not stored (they cost 96 bytes a plate and angle): ask for them
// again.
struct Motion {
    std::vector<Angle> angles;  // those asked for, and the first and last angle of every contact
    Solver solver = Solver::closed_form;
    double max_closure_mm = 0.0;         // largest opening of any fold or seam at any of the angles asked for
    double flat_error_deg = 0.0;         // largest angle of a plate to the closed card, at 0°
    bool flat_closed = false;            // flat_error_deg within tolerance
    std::vector<FreePlates> not_forced;  // as free_plates() has them; none with Solver::iterative
    std::optional<Examination> examination;  // none: not examined, not asked for or as Sweep::bends says
    std::vector<FreeingMove>
        moves;  // of the first that collide, then of those that lie on one another, as many as could be tried
};

// Frames of all plates at one angle, in closed form. `frames` has one entry a plate.
// False when a linkage cannot reach the angle; *stuck (if given) is then the index of the joint. Frames of
// plates placed after it are unspecified. Cost: one square root and two dozen products a four-bar; no
// allocation.
bool place(const Assembly& assembly, Angle theta, std::span<Frame> frames, int* stuck = nullptr);

// Ends the sweep at this opening, above 0° and at most 180°, whatever it was. What does not move stays as it
// is. Error: `opens-too-little`, and false, where the sweep begins there or beyond.
bool open_to(Assembly& assembly, Angle opening, Diagnostics& diagnostics);

// Puts the folds of a folded sheet in an order, where all of them at once would take plates through one
// another, and those of a box with a lid or a bottom always, if there is one: its walls stand, and are glued,
// before its flaps are closed.
//
//     std::optional<Assembly> box = fold_sheet(pattern, {}, diagnostics);
//     if (box) order_folds(*box, {}, diagnostics);
//
// Folds that a loop joins go together. The rest is tried, each step certified by examine(); steps that can go
// at once do. A flap that is tucked in turns beyond its angle first, and back while its lid closes. Each of n
// steps takes an nth of the sweep, so that what stands at 0° and at 180° stays as it is. Plates that cross in
// the end cross in any order, and are left to simulate(), as is what could not be put in one. Remark:
// `folds-in-order`. Nothing is done where all may go at once and close no box, where panels bend, for other
// than folded sheets, and where there are more than 64 parts that could go on their own. Returns true if the
// folds were put in an order. `at_once` is what examine() found when all folds go at once; if it is null,
// that is examined here. Cost: that of some examinations a part.
bool order_folds(Assembly& assembly, const MotionOptions& options, Diagnostics& diagnostics,
                 const Examination* at_once = nullptr);

// Horizon-line correction (Glassner, "Interactive Pop-up Card Design", section 8): seen along the base of the
// open card, the horizon of a picture is straight and parallel to the base, whatever plates it runs over.
//
// On the open card (Sweep::to_deg) lines of constant height on a plate have one direction. On both plates of
// a piece's first fold that rises there, its centre fold, the picture is sheared along that fold, so that
// points of the fold stay on it, until its rows have that direction; then it is moved along the fold until
// the row is at the horizon's height. On what is folded to these plates it is sheared along the fold between
// them in the same way. Without a fold that rises, it is sheared along the line of steepest rise, about the
// middle of the row, and moved along it.
//
// Afterwards no image has a horizon, those that do not show on a plate are gone from it, and the numbers are
// settled again. Guarantees: every point of the row is at the height (without a row: every row at the height
// that it has on the fold) to 1e-6 mm; on either side of a fold over which it was sheared the same points of
// the picture meet, to 1e-6 mm. Remarks: `horizon-flat`, where a plate is parallel to the base or nothing
// moves; `horizon-upright`, of rows that no such shear can level. Both leave the picture as it was there.
// Cost: that of place() once, and linear in images.
void level_horizons(Assembly& assembly, Diagnostics& diagnostics);

// The iterative baseline. Keeps the last positions as starting points, as Popup Workshop does; the first call
// starts from its heuristic guess. `repeats` is the limit of figure 5.16, `precision` its "close enough" in
// mm.
class IterativePlacer {
 public:
    explicit IterativePlacer(const Assembly& assembly, int repeats = 5000, double precision = 1e-3);
    void place(Angle theta, std::span<Frame> frames);

 private:
    const Assembly* assembly_;
    int repeats_;
    double precision_;
    std::vector<std::array<Vec3, 2>> centres_;  // of each joint, from the last call
    bool started_ = false;
};

// Largest distance between the two images of a hinge's ends over all hinges of the assembly.
// *worst (if given) is set to the index of that hinge, and stays as it was where the distance is 0.
double closure_error(const Assembly& assembly, std::span<const Frame> frames, int* worst = nullptr);

// Certifies every pair of plates, over the whole opening, to be clear of each other or finds where they
// cross; looks at the closed card. Nothing is sampled: a pair is clear over a range of angles when its
// distance in the middle is more than its points can move on the way there, by the turning of the hinges
// between the two plates. Precondition: the linkages reach every angle (simulate() has seen to that). Cost:
// near linear in plates, for plates that each have few others near.
Examination examine(const Assembly& assembly, const MotionOptions& options);

// The same of a folded sheet in the state in which its motion ends, and of no other.
Examination examine_folded(Assembly assembly, const MotionOptions& options);

// Which plates the opening does not force, by their first plates; empty: it forces all of them. Each plate is
// in at most one of the groups, and groups move independently of one another. A floating layer on a pillar
// and two walls, all parallel and of one height, is one group of five plates and one way.
//
// Known from the rank of the loop closures' Jacobian (motion/forced.h has the formula), which is made of the
// hinges, glued areas and drives alone, whatever elements and kinds of joints they belong to. A plate is
// named when it is free at each of three openings that have nothing to do with each other, for at single ones
// a linkage may lie so that it is free for a moment; `ways` is the least of theirs. Thickness and bending of
// paper, and friction, force nothing. Openings that a joint cannot reach are left out. Cost: near linear in
// plates, as long as not many of them are free together.
std::vector<FreePlates> free_plates(const Assembly& assembly);

// Simulates and judges. Errors name the element that is not flat where the sweep begins (`not-flat`), whose
// seams do not meet at an angle asked for (`seam-open`), or that, at any angle, jumps to its mirror image
// (`jumps`) or stops before the card is open (`locks`). Warnings: `collision`, `lies-on-another`,
// `across-fold`, `protrusion`, `layer-order`, `clearance-low`; remarks: `undecided`, and `not-forced` for
// each of free_plates(), which is looked at whether or not the motion is examined. With Solver::iterative
// only figures are taken; its inaccuracy is not held against the design, and nothing is examined. Cost:
// angles × plates, and that of examine().
std::optional<Motion> simulate(const Assembly& assembly, const MotionOptions& options,
                               Diagnostics& diagnostics);

// The same of a folded sheet, whose folds are put in an order as order_folds() says. Cost: where none is
// looked for, that of simulate().
std::optional<Motion> simulate_sheet(Assembly& assembly, const MotionOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace popup
