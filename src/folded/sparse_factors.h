// Factors of sparse symmetric matrices that have one pattern, by dense blocks.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

namespace popup::folded {

// L D Lᵀ of a matrix. Columns of L with nearly the same rows are one block, and what a block adds to those
// after it is a small dense matrix (the multifrontal method; Duff and Reid, The multifrontal solution of
// indefinite sparse symmetric linear equations, 1983). A third of what Eigen's factors take, which go entry
// by entry; factors by blocks that there are (CHOLMOD) leave sums to a BLAS, which are others on other
// machines. Here they are in one order, and the same matrix gives the same bits on all.
//
//     SparseFactors factors;
//     factors.analyse(matrix, {});
//     if (factors.factorise(matrix)) factors.solve(x);
class SparseFactors {
 public:
    using Matrix = Eigen::SparseMatrix<double>;

    // Takes where entries are, on the diagonal, all of which there are, and above it; what is below is not
    // looked at. `order`: by equation, its place in the order of elimination; empty: as they are. Cost: near
    // linear in the entries of the factors.
    void analyse(const Matrix& matrix, const std::vector<int>& order);
    [[nodiscard]] bool is_analysed() const { return analysed_; }

    // Of a matrix with the entries that were analysed. False where a pivot is 0; then there are no factors.
    bool factorise(const Matrix& matrix);
    // x becomes what the matrix takes to x.
    void solve(Eigen::VectorXd& x);

    // Entries of L with its diagonal, and the sum of the squares of how many a column has, which is what the
    // factors take; without those that are nought and stand in a block.
    [[nodiscard]] double entries() const { return entry_count_; }
    [[nodiscard]] double steps() const { return steps_; }

 private:
    // Columns that are eliminated together, and the rows below them, ascending.
    struct Block {
        std::size_t first = 0, width = 0;
        std::size_t rows = 0, below = 0;           // where its rows below begin, and how many there are
        std::size_t values = 0;                    // where its columns begin, each of the height of the block
        std::size_t entries = 0, entries_end = 0;  // of the matrix, that it has
        std::vector<std::size_t> from;             // blocks that add to it
        [[nodiscard]] std::size_t height() const { return width + below; }
    };

    // An entry of the matrix, by its number among them, and its place among the values of its block.
    struct Entry {
        int entry = 0, target = 0;
    };

    void find_blocks(const std::vector<std::vector<int>>& above, const std::vector<int>& parent);
    void lay_out(const std::vector<std::vector<int>>& rows_of);
    void place_values(const Matrix& matrix);
    // Where a row stands in a block that has it.
    [[nodiscard]] std::size_t row_in(const Block& block, int row) const;
    void take_entries(const Block& block, const double* entries);
    void solve_onwards(const Block& block);
    void solve_back(const Block& block);

    bool analysed_ = false;
    double entry_count_ = 0.0, steps_ = 0.0;
    std::vector<int> place_;            // by equation: its column
    std::vector<Block> blocks_;         // each before the one that it adds to
    std::vector<int> block_of_;         // by column
    std::vector<int> rows_;             // below, of all blocks
    std::vector<std::size_t> at_next_;  // by row of a block: where it stands in the block that it adds to
    std::vector<Entry> entries_;        // those that are looked at, block by block
    std::vector<double> values_;        // of L; on its diagonal D
    std::vector<double> added_;         // what blocks add, one on top of the other
    std::vector<double> sums_;          // of one block
    Eigen::VectorXd ordered_;
};

}  // namespace popup::folded
