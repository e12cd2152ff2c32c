// Symmetric systems of equations between points in space: matrices of blocks of 3 x 3, and their factors.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "popup/geometry.h"

namespace popup::folded {

// Knows which points have equations in common, and finds the factors L D L' of matrices that have blocks for
// these. Its order of elimination is that of the pattern alone, so that the same input gives the same bytes.
// Systems of shapes are small, and blocks of three are worked out by hand: with SparseFactors, which are made
// for large ones, suggestions for a tray of 40 panels take 1.7 times as long.
//
//     PointSystem system(3, {{0, 1}, {1, 2}});
//     std::vector<double> matrix = system.nought();
//     system.add(matrix, system.block(0, 1), {1, 0, 0}, {0, 1, 0});
//     if (system.factorize(matrix, 1e-3)) system.solve(right);
class PointSystem {
 public:
    // Of a block below the diagonal, or on it.
    struct Block {
        std::size_t at = 0;   // of its nine values, which stand by rows
        bool turned = false;  // the rows are of the second point
    };

    // `pairs`: of numbers from 0 to points - 1, in any order and as often as one likes. Cost: that of an
    // order of least degree, near linear in the pairs for what hangs together like a sheet.
    PointSystem(int points, const std::vector<std::pair<int, int>>& pairs);

    // A matrix of noughts.
    [[nodiscard]] std::vector<double> nought() const { return std::vector<double>(9 * rows_.size(), 0.0); }
    // Precondition: a pair that was given, or twice the same point.
    [[nodiscard]] Block block(int a, int b) const;
    // Adds a times b' to the block of two points, and its mirror image with it. Of one point: a = b.
    static void add(std::vector<double>& matrix, Block to, Vec3 a, Vec3 b) {
        if (to.turned) std::swap(a, b);
        double* const values = matrix.data() + to.at;
        values[0] += a.x * b.x, values[1] += a.x * b.y, values[2] += a.x * b.z;
        values[3] += a.y * b.x, values[4] += a.y * b.y, values[5] += a.y * b.z;
        values[6] += a.z * b.x, values[7] += a.z * b.y, values[8] += a.z * b.z;
    }
    // Adds so many units.
    static void add_units(std::vector<double>& matrix, Block to, double units) {
        for (const std::size_t i : {0U, 4U, 8U}) matrix[to.at + i] += units;
    }

    // The factors of the matrix with `more` on its diagonal. False: there are none.
    [[nodiscard]] bool factorize(const std::vector<double>& matrix, double more);
    // Puts the solution in the place of the right side, x, y and z by point.
    void solve(Eigen::VectorXd& right) const;

 private:
    void eliminate(std::size_t column);

    std::vector<int> place_;          // in the order of elimination, by point
    std::vector<int> point_;          // the other way round
    std::vector<std::size_t> begin_;  // of the blocks of a column: that on the diagonal first, then downwards
    std::vector<int> rows_;           // by block
    std::vector<double> factors_;     // nine a block; on the diagonal L, and D upside down
    std::vector<double> column_;      // L D, of the column that is being eliminated
};

}  // namespace popup::folded
