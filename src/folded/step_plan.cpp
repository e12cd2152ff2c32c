#include "folded/step_plan.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include "base/nth.h"
#include "folded/plane_order.h"

namespace popup::folded {
namespace {

// No motion is found in fewer factorisations.
constexpr double kLeastFactorisations = 60.0;
// Steps of work: of an entry of the equations of conditions; of a pair of angles in a loop, which is summed
// over its conditions.
constexpr double kEntrySteps = 4.0;
constexpr double kPairSteps = 36.0;
// Solutions, with the factors of one factorisation, of a step that is right to the last digits.
constexpr double kSolutions = 4.0;

using Joined = std::vector<std::vector<int>>;

// The places of folds among those that a plan is for.
using Columns = std::unordered_map<int, int>;

// By fold of the plan: the loops that cross it, in their order.
Joined loops_across(const Sheet& sheet, const Columns& columns, const std::vector<int>& loops) {
    Joined across(columns.size());
    for (std::size_t i = 0; i < loops.size(); ++i) {
        for (const Step& step : nth(sheet.loops, loops[i]).steps)
            nth(across, columns.at(step.fold)).push_back(static_cast<int>(i));
    }
    return across;
}

// Loops in the order of least degree (Amestoy, Davis and Duff, An approximate minimum degree ordering
// algorithm, 1996), so that the factors of their normal equations stay sparse: for loops as a whole, which
// takes a ninth of what it takes for conditions.
std::vector<int> ordered(const Joined& across, const std::vector<int>& loops) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::vector<int>& beside : across) {
        for (const int a : beside) {
            for (const int b : beside) entries.emplace_back(a, b, 1.0);
        }
    }
    const auto count = static_cast<Eigen::Index>(loops.size());
    Eigen::SparseMatrix<double> joined(count, count);
    joined.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(joined, order);
    std::vector<int> result;
    result.reserve(loops.size());
    for (Eigen::Index i = 0; i < count; ++i)
        result.push_back(loops[static_cast<std::size_t>(order.indices()[i])]);
    return result;
}

// What factors take where these sets hang together, and are eliminated one place after the other, each of so
// many equations as `own` says: each joins those after it that it hangs together with, and all that is told
// of it goes to the first of these (its parent in the elimination tree; Liu, The role of elimination trees in
// sparse factorization, 1990). False if the work does not do for enough of them.
bool count_steps(const Joined& sets, const std::vector<double>& own, const Work& work, StepPlan& plan) {
    const std::size_t count = own.size();
    Joined before(count);  // by place: those earlier in the order that share a set
    for (const std::vector<int>& set : sets) {
        for (const int one : set) {
            for (const int other : set) {
                if (other < one) nth(before, one).push_back(other);
            }
        }
    }
    std::vector<int> parent(count, -1);
    std::vector<int> seen(count, -1);       // the last place whose row has an entry in this column
    std::vector<double> below(count, 0.0);  // equations below the diagonal, by column
    double entries = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        seen[i] = static_cast<int>(i);
        for (int at : before[i]) {
            for (; nth(seen, at) != static_cast<int>(i); at = nth(parent, at)) {
                if (nth(parent, at) < 0) nth(parent, at) = static_cast<int>(i);
                nth(seen, at) = static_cast<int>(i);
                nth(below, at) += own[i];
                entries += 1.0;
            }
        }
        if (!work.has(kLeastFactorisations * entries)) return false;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double column = own[i] + below[i];
        plan.work += own[i] * column * column;
        plan.solution += 2.0 * own[i] * column;
    }
    plan.work += kSolutions * plan.solution;
    return work.has(kLeastFactorisations * plan.work);
}

StepPlan plan_conditions(const Sheet& sheet, const Columns& columns, const std::vector<int>& loops,
                         const Work& work) {
    StepPlan plan;
    // A fold that many loops cross joins each of them to each other.
    Joined across = loops_across(sheet, columns, loops);
    for (const std::vector<int>& beside : across)
        plan.work += kEntrySteps * 36.0 * static_cast<double>(beside.size() * beside.size());
    if (!work.has(kLeastFactorisations * plan.work)) return plan;
    plan.loops = ordered(across, loops);
    std::vector<double> conditions;
    conditions.reserve(loops.size());
    for (const int loop : plan.loops) conditions.push_back(nth(sheet.loops, loop).corner ? 3.0 : 6.0);
    plan.affordable = count_steps(loops_across(sheet, columns, plan.loops), conditions, work, plan);
    return plan;
}

StepPlan plan_angles(const Sheet& sheet, const std::vector<int>& folds, const Columns& columns,
                     const std::vector<int>& loops, const Work& work) {
    StepPlan plan;
    plan.loops = loops;
    for (const int loop : loops) {
        const std::size_t around = nth(sheet.loops, loop).steps.size();
        plan.work += kPairSteps * 0.5 * static_cast<double>(around * (around + 1));
    }
    if (!work.has(kLeastFactorisations * plan.work)) return plan;
    std::vector<Vec2> places;
    places.reserve(folds.size());
    for (const int fold : folds) {
        const Segment line = sheet.line_of(nth(sheet.folds, fold));
        places.push_back(0.5 * (line.a + line.b));
    }
    Joined sets;
    sets.reserve(loops.size());
    for (const int loop : loops) {
        sets.emplace_back();
        for (const Step& step : nth(sheet.loops, loop).steps) sets.back().push_back(columns.at(step.fold));
    }
    plan.angle_order = plane_order(sets, places);
    for (std::vector<int>& set : sets) {
        for (int& one : set) one = nth(plan.angle_order, one);
    }
    const std::vector<double> each(folds.size(), 1.0);
    plan.affordable = count_steps(sets, each, work, plan);
    return plan;
}

}  // namespace

double StepPlan::factors() const { return work - kSolutions * solution; }

StepPlan plan_steps(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops,
                    const Work& work) {
    Columns columns;
    for (std::size_t i = 0; i < folds.size(); ++i) columns[folds[i]] = static_cast<int>(i);
    const StepPlan of_conditions = plan_conditions(sheet, columns, loops, work);
    const StepPlan of_angles = plan_angles(sheet, folds, columns, loops, work);
    if (!of_angles.affordable && !of_conditions.affordable) return {};
    const bool takes_angles =
        of_angles.affordable && (!of_conditions.affordable || of_angles.work < of_conditions.work);
    return takes_angles ? of_angles : of_conditions;
}

}  // namespace popup::folded
