// From which equations the steps that close a sheet's loops are found.
#pragma once

#include <vector>

#include "folded/sheet.h"
#include "folded/work.h"

namespace popup::folded {

// With the slopes J of the loops' conditions by the folds' angles, and eases D = S² of the angles, the
// smallest step for a change r of the conditions is
//
//     D Jᵀ (J D Jᵀ + d)⁻¹ r  =  S (S Jᵀ J S + d)⁻¹ S Jᵀ r
//
// with a damping d, so it is found from as many equations as there are conditions, or as there are angles. A
// tessellation has two folds for the three conditions of a corner, and a line that parts it crosses one for
// each: there the factors of the angles' equations are a small part of the others. A loop of many folds joins
// all of these, and may have six conditions.
struct StepPlan {
    // False if the work that is left does not do for the steps that it takes to find anything.
    bool affordable = false;
    // Of the sheet. Where the equations are those of conditions, in their order.
    std::vector<int> loops;
    // By fold, the place of its equation. Empty where the equations are those of conditions.
    std::vector<int> angle_order;
    // Steps: for the factors and for what is solved with them, and what one of these solutions takes.
    double work = 0.0, solution = 0.0;
    [[nodiscard]] double factors() const;  // without solutions
};

// For these loops and the folds that they cross: of the two what takes less. Cost: of a few factorisations at
// most, and never more than a small part of the work that is left.
StepPlan plan_steps(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops,
                    const Work& work);

}  // namespace popup::folded
