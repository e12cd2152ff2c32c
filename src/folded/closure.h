// The loops of a cluster as equations of its folds' angles, and their solution.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "folded/sheet.h"
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
    using Matrix = Eigen::SparseMatrix<double>;
    struct Term {
        int column = 0;
        double sign = 1.0;
        Vec3 at, dir;  // of the fold's line on the sheet, from the loop's own point; lengths over its size
    };
    struct Row {
        int loop = 0;
        int first = 0;  // condition
        int count = 0;  // of conditions: 3 around a corner, else 6
        double size = 0.0;
        std::size_t begin = 0, end = 0;  // in terms_
    };
    // What two terms of one fold add to the normal equations: a block of them, whose columns are at these
    // places among the values of the matrix.
    struct Product {
        std::size_t upper = 0, left = 0;  // terms; the conditions of `upper` come before those of `left`
        int rows = 0, columns = 0;
        bool diagonal = false;  // of one loop: entries below the diagonal are left out
        std::array<int, 6> at{};
    };

    [[nodiscard]] bool can_afford(const Sheet& sheet, const std::vector<int>& loops);
    void add_rows(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops);
    void add_products(std::size_t folds);
    // Residuals of all loops, and with `slopes` their derivatives.
    void evaluate(const Eigen::VectorXd& angles, bool slopes);
    // The smallest step that adds `by` to the residuals, to the first order.
    bool step(const Eigen::VectorXd& residuals, Eigen::VectorXd& by);
    // What a step adds to the residuals, to the first order.
    [[nodiscard]] Eigen::VectorXd change_by(const Eigen::VectorXd& by) const;
    bool factorise();

    Work* work_;
    bool affordable_ = false;
    double factor_steps_ = 0.0;  // what a factorisation takes
    std::vector<Row> rows_;      // in an order that leaves the factors sparse
    std::vector<Term> terms_;
    std::vector<std::array<double, 6>> slopes_;  // by term: of its loop's conditions by its fold's angle
    Eigen::VectorXd ease_;                       // by angle: what it costs, inverted and squared
    bool bends_ = false;
    Eigen::VectorXd residual_;
    std::vector<Product> products_;
    Matrix normal_;              // the upper triangle
    std::vector<int> diagonal_;  // by condition: its place among the values
    Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> solver_;
    bool analysed_ = false;
};

}  // namespace popup::folded
