// How far every fold is folded on the way from the flat sheet to its final angles, with all loops closed.
//
// A loop crosses the folds 1 … n. With the sheet's own lines as axes, the turn about fold i by its angle,
// taken in the direction in which the loop crosses it, is a rigid motion R_i of space, and the loop is closed
// when
//
//     R_1 R_2 … R_n = identity.
//
// How the left side departs from the identity, as a turn and a shift, is the residual of the loop; its
// derivative by an angle is the line of that fold where it is at that moment, a screw. All residuals together
// are brought to nought by Newton's method, each step the smallest one that does (of the normal equations,
// with a regularisation far below what loops need: loops of parallel folds, and those around the corners of
// one panel, depend on each other).
//
// The flat sheet is a singular point: there the loops have one condition less each, and many ways lead on.
// The way is left with a share of the final angles, mountains and valleys as drawn, brought to closure. From
// there to the flat sheet the angles shrink in proportion, and onwards they go straight to the final ones;
// both ways are brought to closure again at the Chebyshev points of ranges, which are as wide as
// closure between the points allows. So a fold's law is a polynomial in each range (Folded of
// popup/joints.h).
//
// Not all folds can go at once: those of a map go one line after another. What has not left the flat sheet
// when the others are where they go leaves then, in a stage of its own, which begins at a singular point as
// well.
#pragma once

#include <vector>

#include "folded/sheet.h"
#include "folded/work.h"

namespace popup::folded {

struct PathOptions {
    double closure_mm = 1e-7;  // of loops, at any share; > 0
};

// The share of the final angles, from 0 at the flat sheet to 1, and the angle of a fold there, in radians.
struct SharePoint {
    double share = 0.0, angle = 0.0;
};

// A set of folds whose loops hang together, and how they went.
struct Cluster {
    std::vector<int> folds;  // ascending
    std::vector<int> loops;
    double reached = 1.0;  // the share up to which the loops close; 0: they do not leave the flat sheet
    // Where `reached` is less than 1: the loop that does not close beyond it; and where it is 0, how far that
    // is open half way when each fold has its share, in radians or as a share of its size.
    double residual = 0.0;
    int worst_loop = -1;
    bool all_fold = true;   // no fold stays flat that is to be folded; of reached > 0
    bool given_up = false;  // the work was spent before it was known how it goes any further
    // Not less than 0: it goes along the way that was found up to this share of it alone, and from there at
    // once to the angles that are asked for, which close (folded/asked.h).
    double jumps_from = -1.0;
    bool other_way = false;  // it only leaves the flat sheet with folds that go the other way than drawn
};

struct Paths {
    // By fold: its law over the share, as Folded has it over the opening. Folds of no loop go straight, those
    // of a cluster that does not leave the flat sheet stay flat.
    std::vector<std::vector<SharePoint>> laws;
    std::vector<Cluster> clusters;  // of folds in loops
    double reached = 1.0;           // the least of all clusters
    // Whether a cluster does not leave the flat sheet.
    [[nodiscard]] bool any_stays() const { return reached == 0.0; }
    [[nodiscard]] bool any_given_up() const;
    [[nodiscard]] bool any_jumps() const;
};

// The angle of a law at a share.
double angle_at(const std::vector<SharePoint>& law, double share);

// Clusters of few loops come first, so that what a large one spends is not missed by them. Cost: that of some
// dozens of sparse factorisations a range, of as many rows as loops have conditions, all of which `work` pays
// for.
Paths find_paths(const Sheet& sheet, const PathOptions& options, Work& work);

}  // namespace popup::folded
