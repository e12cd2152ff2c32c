// The order of gluing: how a card is put together by somebody with two hands and a pot of glue.
//
//     const GluingOrder order = gluing_order(assembly);
//     for (const GluingStep& step : order.steps) fmt::print("{}\n", nth(assembly.pieces, step.piece).name);
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// What holds two pieces together.
struct Bond {
    enum class Kind { tab, area, rivet };
    Kind kind = Kind::tab;
    int number = -1;  // index into Assembly::glue or glued_areas; of a rivet that of the plate that turns
    int plate = -1;   // of the piece that is glued on
    int mate = -1;    // of what is there already; of a tab that closes a ring, of the same piece
    bool on_back = false;  // it is the back of what it is glued to that is covered
    bool theirs = false;   // the tab is on what is there already, and the piece comes to lie on it
};

// How the bonds of a step are made that lie in one plane.
enum class Touch {
    press,  // laid on, and pressed
    close,  // what bears them is closed onto them: they come to where they belong by themselves
    bend,   // by hand: the piece is bent until they are at their places
};
inline constexpr std::array<std::string_view, 3> kTouchNames{"press", "close", "bend"};

struct BondTurn {
    Touch touch = Touch::press;
    std::vector<Bond> bonds;
};

// How what is glued on lies.
enum class Lie {
    loose,      // off the card, on the table
    open,       // as far open as the card goes, flat if it opens so far
    half_open,  // some of what it is glued to stands up, and is held
    turned,     // turned over, its back up
};
inline constexpr std::array<std::string_view, 4> kLieNames{"loose", "open", "half-open", "turned"};

// One piece is glued on.
struct GluingStep {
    int piece = 0;
    int ground = 0;  // the piece that bears it: what lies before the maker, with all that is glued on so far
    Lie lie = Lie::open;
    std::vector<Bond> ring;       // tabs of the piece that are glued on itself, before anything else
    std::vector<BondTurn> turns;  // in their order, at least one; the first is pressed
    // Bonds of the turns that lie below something glued before, which does not carry the piece: hard to
    // reach.
    std::vector<Bond> under;
    std::vector<std::pair<Bond, int>> onto;  // those of its tabs whose targets lie under a piece (by number)
                                             // that is glued flat there already: they are glued onto it
};

// The steps, in their order. What a piece bears alone, and can be glued on it while it lies on the table, is
// a sub-assembly and comes before all steps on the card.
struct GluingOrder {
    int card = 0;  // the piece that the others come to be on: the one with the covers, else the first
    std::vector<GluingStep> steps;
    std::vector<int> bearers;  // of each piece the one that it is glued on, as `ground`; -1: it bears others
};

// Finds an order. Guarantees:
// * every piece that is glued to others has one step, every tab, area and rivet of the assembly is in one;
// * at its step all that a piece stands on is there, and hangs together with step.ground; a tab that lies
//   under the back of another piece's plate carries that piece, which is laid over it;
// * what a piece bears alone, on one plane or on two that share a fold of it, is glued on it before it is
//   glued on itself (a sub-assembly), deepest first;
// * what is glued flat is there before what rises out of it, for it could not be laid down round a wall; of
//   two flat pieces that lie over one another the one that the assembly names first;
// * where a piece, or what it bears, stands above a target of another, or its feet enclose it, the other
//   comes first, unless these rules go round in a circle; then `under` names the bond;
// * else backs come first (while nothing stands on the front), then what is glued while the card lies open,
//   then the small before the large, then the order of the assembly. The same input gives the same order.
// "Above" means in the way of whoever looks at the target from straight before it: most of some places of the
// target are hidden within 150 mm when the card is nearly open. Where no motion is known nothing is
// above anything. Precondition: the linkages reach every opening (simulate() has seen to that). Cost: near
// linear in plates and bonds, as long as few plates are before a target.
GluingOrder gluing_order(const Assembly& assembly);

// What is cut from a piece, hangs on its folds and is pushed out of it.
struct PushedOut {
    std::string name;  // the element
    int piece = 0;
    std::vector<int> plates;
    int level = 1;  // 1: it hangs on what the piece itself is, 2: on what has level 1, …
};
// All of them, by piece, level, and the order of the assembly. None of folded sheets. Cost: near linear.
std::vector<PushedOut> pushed_out(const Assembly& assembly);

// Folds of a sheet that are folded at one time.
struct FoldingStep {
    double from_deg = 180.0, to_deg = 0.0;  // openings, from flat to folded
    std::vector<int> hinges;                // that are folded meanwhile, ascending
    std::vector<int> plates;                // that turn against what they hang on, ascending
};
// Of a folded sheet, whose folds may be in an order (order_folds() of popup/motion.h); empty: it is none, or
// nothing is folded. A step ends where a fold begins, ends, turns back or waits; folds that move at a time
// with others are in one step with them, and a fold that turns in several steps is in each. Cost: 181 poses,
// and 12 a step.
std::vector<FoldingStep> folding_steps(const Assembly& assembly);

// How far a fold between two plates is folded at a pose, in degrees: 0 where they lie in one plane, positive
// where they are folded to their fronts (a valley), negative to their backs. -180 to 180.
double folded_deg(const Hinge& hinge, const Frame& a, const Frame& b);

}  // namespace popup
