// The loops of a cluster as equations of its folds' angles, and their solution.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "folded/least_step.h"
#include "folded/sheet.h"

namespace popup::folded {

class Closure {
 public:
    // Loops of the sheet, and the folds that they cross; angles have the order of `folds`.
    Closure(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops);

    // How far the worst loop is from closed: radians of its turn, or its shift as a share of its size.
    // *worst (if given) is its number in the sheet.
    double residual(const Eigen::VectorXd& angles, int* worst = nullptr);

    // Brings the angles nearer to closure, each step the smallest one that closes the loops to the first
    // order, with the angles of bends counted as kBendCost, until the residual is `enough` or no step helps.
    // Returns the residual.
    double approach(Eigen::VectorXd& angles, double enough = kRounding);
    // The same for angles at several shares, all by the same number of whole steps, so that where they end
    // depends smoothly on where they begin. Returns the number of those that stay open by more than `enough`
    // or that a step does not help, -1 for none.
    int approach_smoothly(std::span<Eigen::VectorXd> all, double enough);
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

    LeastStep equations(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops);
    // Residuals of all loops, and with `slopes` their derivatives.
    void evaluate(const Eigen::VectorXd& angles, bool slopes);
    // What a step adds to the residuals, to the first order.
    [[nodiscard]] Eigen::VectorXd change_by(const Eigen::VectorXd& by) const;
    void factorise();

    std::vector<Term> terms_;
    std::vector<LeastStep::Slope> slopes_;  // by term: of its loop's conditions by its fold's angle
    bool bends_ = false;
    Eigen::VectorXd residual_;
    LeastStep least_;
};

}  // namespace popup::folded
