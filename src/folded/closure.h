// The loops of a cluster as equations of its folds' angles, and their solution.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "folded/closing_step.h"
#include "folded/rigid.h"
#include "folded/sheet.h"
#include "folded/sine.h"
#include "folded/step_plan.h"
#include "folded/work.h"

namespace popup::folded {

class Closure {
 public:
    // Loops of the sheet, and the folds that they cross; angles have the order of `folds`. `work`, which must
    // outlive this object, pays for all that follows. Once it is spent, no step helps.
    Closure(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops, Work& work);

    // False if the work that is left does not do for the steps that it takes to find anything: then it is
    // left for others, and nothing below may be used.
    [[nodiscard]] bool is_affordable() const { return affordable_; }

    // How far the worst loop is from closed: radians of its turn, or its shift as a share of its size.
    // *worst (if given) is its number in the sheet.
    double residual(const Eigen::VectorXd& angles, int* worst = nullptr);

    // Brings the angles nearer to closure, each step the smallest one that closes the loops to the first
    // order, with the angles of bends counted as kBendCost, until the residual is `enough` or no step helps.
    // Returns the residual. `gives_up`, if given, is asked before each step, with the angles and the
    // residual.
    using GivesUp = std::function<bool(const Eigen::VectorXd&, double)>;
    double approach(Eigen::VectorXd& angles, double enough = kRounding, const GivesUp& gives_up = {});
    // The same for angles at several shares, all by the same number of whole steps, so that where they end
    // depends smoothly on where they begin. `near`: they begin near to closure. Returns the number of those
    // that stay open by more than `enough` or that a step does not help, -1 for none.
    int approach_smoothly(std::span<Eigen::VectorXd> all, double enough, bool near);
    // Brings angles at which the loops are closed as near to others as closure allows, or nearly so: until a
    // step does not gain a hundredth. Bends count as above.
    void draw_near(Eigen::VectorXd& angles, const Eigen::VectorXd& to);
    [[nodiscard]] bool has_bends() const { return bends_; }
    // What is left of a direction when all is taken out that opens loops, to the first order.
    Eigen::VectorXd along_loops(const Eigen::VectorXd& angles, const Eigen::VectorXd& direction);
    static constexpr double kRounding = 2e-14;  // of a few dozen turns
    // Paper is creased where it is folded, and bends elsewhere only if it must.
    static constexpr double kBendCost = 3.0;

 private:
    struct Term {
        double sign = 1.0;
        Vec3 at, dir;  // of the fold's line on the sheet, from the loop's own point; lengths over its size
    };

    Closure(const Sheet& sheet, const std::vector<int>& folds, StepPlan plan, Work& work);
    // Of the plan's loops; what is asked of them in each state goes to the members above.
    ClosingStep equations(const Sheet& sheet, const std::vector<int>& folds, StepPlan plan);
    // Residuals of all loops, and with `slopes` their derivatives.
    void evaluate(const Eigen::VectorXd& angles, bool slopes);
    // Of one loop: the motion around it.
    Rigid3 around_corner(const LoopRow& row, bool slopes);
    Rigid3 around(const LoopRow& row, bool slopes);
    [[nodiscard]] SineCosine turn_in(std::size_t term) const;
    // The smallest step that adds this to the residuals, to the first order.
    bool step(const Eigen::VectorXd& change, Eigen::VectorXd& by, int most = kUntilRounding);
    bool factorise();
    bool keep_slopes(Eigen::VectorXd& angles);

    Work* work_;
    bool affordable_ = false;
    double factor_work_ = 0.0, solution_work_ = 0.0;  // what one takes
    std::vector<Term> terms_;
    std::vector<ClosingStep::Slope> slopes_;  // by term: of its loop's conditions by its fold's angle
    std::vector<SineCosine> turns_;           // by angle; most are turned by in two loops
    bool bends_ = false;
    Eigen::VectorXd residual_;
    ClosingStep closing_;
};

}  // namespace popup::folded
