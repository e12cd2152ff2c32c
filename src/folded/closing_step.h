// The smallest step of folds' angles that changes the conditions of loops as asked, to the first order.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <vector>

#include "folded/corrections.h"
#include "folded/sparse_factors.h"

namespace popup::folded {

// The conditions of a loop, and its terms: one for each fold on its way.
struct LoopRow {
    int loop = 0;                    // of the sheet
    int first = 0;                   // condition
    int count = 0;                   // of conditions: 3 around a corner, else 6
    std::size_t begin = 0, end = 0;  // terms
};

class ClosingStep {
 public:
    // How a loop's conditions change with an angle.
    using Slope = std::array<double, 6>;

    // `columns`: by term, its angle. `ease`: by angle, the inverse of what its square costs; > 0.
    // `angle_order`: by angle, the place of its equation; empty if equations are those of the conditions, in
    // the order of the rows (StepPlan says which, and why). Cost: near linear in what the terms of one loop,
    // or of one fold, have to do with each other.
    ClosingStep(std::vector<LoopRow> rows, std::vector<int> columns, Eigen::VectorXd ease,
                std::vector<int> angle_order);

    [[nodiscard]] const std::vector<LoopRow>& rows() const { return rows_; }
    [[nodiscard]] int angle_of(std::size_t term) const { return columns_[term]; }
    [[nodiscard]] const Eigen::VectorXd& ease() const { return ease_; }

    // Takes slopes, by term, whose entries are of the size of 1; damping > 0. False if there are no factors.
    bool factorise(const std::vector<Slope>& slopes, double damping);
    // The step for a change of the conditions, with the slopes that were factorised: right but for rounding,
    // or after `most` solutions with the factors. Returns how many there were; 0 if the step is not of finite
    // numbers.
    [[nodiscard]] int find(const std::vector<Slope>& slopes, const Eigen::VectorXd& change,
                           Eigen::VectorXd& by, int most = kUntilRounding);
    // What a step adds to the conditions, to the first order.
    [[nodiscard]] Eigen::VectorXd change_by(const std::vector<Slope>& slopes,
                                            const Eigen::VectorXd& by) const;

 private:
    using Matrix = Eigen::SparseMatrix<double>;
    // What two terms of one fold add to the equations of the conditions: a block of them, whose columns are
    // at these places among the values of the matrix.
    struct Product {
        std::size_t upper = 0, left = 0;  // terms; the conditions of `upper` come before those of `left`
        int rows = 0, columns = 0;
        bool diagonal = false;  // of one loop: entries below the diagonal are left out
        std::array<int, 6> at{};
    };

    void arrange_angles();
    void arrange_conditions();
    // Calls visit<Count>(row) with the number of its conditions.
    template <typename Visit>
    void each_row(const Visit& visit) const;
    void add_angles(const std::vector<Slope>& slopes);
    void add_conditions(const std::vector<Slope>& slopes);
    // Makes the matrix of these entries, and notes its diagonal.
    void make_matrix(int size, const std::vector<Eigen::Triplet<double>>& entries);
    [[nodiscard]] int place_of(int row, int column) const;
    [[nodiscard]] bool of_angles() const { return !order_.empty(); }
    // The transposed slopes times a vector of conditions.
    void slope_back(const std::vector<Slope>& slopes, const Eigen::VectorXd& conditions,
                    Eigen::VectorXd& by) const;
    int find_by_angles(const std::vector<Slope>& slopes, const Eigen::VectorXd& change, Eigen::VectorXd& by,
                       int most);
    int find_by_conditions(const std::vector<Slope>& slopes, const Eigen::VectorXd& change,
                           Eigen::VectorXd& by, int most);

    std::vector<LoopRow> rows_;
    std::vector<int> columns_;
    Eigen::VectorXd ease_, root_;    // by angle: D and S
    std::vector<int> order_;         // by angle: its equation
    std::vector<int> pairs_;         // of angles: by row and pair of its terms, the place among the values
    std::vector<Product> products_;  // of conditions
    Matrix normal_;                  // the upper triangle
    std::vector<int> diagonal_;      // by equation: its place among the values
    double damping_ = 0.0;
    SparseFactors factors_;
    CorrectionRate rate_;  // of these factors
};

}  // namespace popup::folded
