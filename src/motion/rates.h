// Rates of turning about the lines of a linkage, and what its loops decide of them.
//
// Every closed loop says Σ rate × screw = 0 of the lines that it goes through. Loops may come in any order;
// what they have decided so far is kept as sums of the rates that are still open.
//
//     Rates rates(lines);
//     for (const auto& loop : loops) rates.close(loop);   // the null space of all loops together
//     if (rates.is_nought(line)) ...                      // its two plates do not turn against each other
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace popup {

// (direction, moment): what a turn at rate 1 does, as a twist. Moments are divided by a length of about the
// size of the loop, so that no entry is much larger than 1.
using Screw = std::array<double, 6>;

struct LoopStep {
    int line = 0;
    Screw screw;  // with the sign of the way through the line
};

// Rank is told by QR with column pivoting: a column that has less than 1e-6 of the largest contribution to
// its loop left, outside of those before it, depends on them. An assembly is exact to 1e-10 mm, and one that
// others wrote to 1e-6 mm; a linkage that holds by less than that holds nothing.
inline constexpr double kHolds = 1e-6;

class Rates {
 public:
    explicit Rates(std::size_t lines);

    // Cost: that of a QR of six rows and as many columns as open rates take part.
    void close(std::span<const LoopStep> loop);

    // No loop has decided it: it may have any value.
    [[nodiscard]] bool is_open(int line) const { return all_[static_cast<std::size_t>(line)].open; }
    // Whatever values open ones have.
    [[nodiscard]] bool is_nought(int line);
    // All rates, when open ones have values that have nothing to do with each other: of the size of 1, and
    // the same for equal numbers of lines. What is not nought in all of the null space is not nought then.
    [[nodiscard]] std::vector<double> example();

 private:
    struct Term {
        int line;
        double factor;
    };
    struct Rate {
        bool open = true;
        int decided = 0;          // by which loop, counted from 1
        std::vector<Term> terms;  // if not open: their sum. They were open at that moment
    };

    const std::vector<Term>& reduced(int line);
    void add(int line, double factor);
    void gather(std::span<const LoopStep> loop);
    std::size_t triangulate();
    void decide(std::size_t rank);

    std::vector<Rate> all_;
    int loops_ = 0;
    // Of the loop that is closed: columns of its matrix, by the lines whose rates they multiply.
    std::vector<int> lines_;
    std::vector<Screw> columns_;
    std::vector<int> column_of_;  // by line; -1: none
    double largest_ = 0.0;        // contribution
    // Of a sum that is reduced, by line.
    struct Part {
        double factor = 0.0, most = 0.0;  // `most`: the largest that was added up
        bool there = false;
    };
    std::vector<Part> parts_;
    std::vector<int> there_;
    std::vector<std::array<int, 2>> waiting_;  // a heap of (-decided, line)
};

}  // namespace popup
