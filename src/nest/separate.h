// Taking overlapping pieces apart by guided local search.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include "nest/board.h"

namespace popup {

// Random numbers that are the same everywhere (the standard's distributions are not).
class Dice {
 public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }  // [0, 1)
    double between(double low, double high) { return low + (high - low) * unit(); }
    int below(int count) { return static_cast<int>(unit() * count); }
    template <typename Values>
    void shuffle(Values& values) {
        for (std::size_t i = values.size(); i > 1; --i) {
            std::swap(values[i - 1], values[static_cast<std::size_t>(unit() * static_cast<double>(i))]);
        }
    }

 private:
    std::mt19937_64 engine_;
};

// Which items may move, how they may be turned, and where to.
struct Freedom {
    std::vector<char> movable;             // an item
    std::vector<std::vector<int>> shapes;  // an item: the shapes it may take
    std::vector<std::vector<int>> sheets;  // an item: the sheets it may be on; empty: all
};

// How long to go on without a gain.
struct Persistence {
    int patience = 300;
    int strikes = 3;
};

// Moves items until none overlaps: in passes over those that do, in random order, each to the place of least
// weighted overlap that is found; pairs that keep overlapping weigh more and more, others less. After
// `patience` passes without a gain of 2 % it starts again from the least total overlap so far, and after
// `strikes` such starts without one it gives up. Works in slices, so that searches can take turns.
class Separator {
 public:
    enum class State { apart, stuck, paused };

    // Preconditions: the board, the freedom and the dice outlive it. Weights are reset.
    Separator(Board& board, const Freedom& freedom, Dice& dice, Persistence persistence);

    // Goes on until nothing overlaps, it is stuck, or the board's work exceeds `limit`. Unless paused, the
    // board is then as it was at the least total overlap.
    State run(double limit);
    // The least total overlap so far, and where items stood then.
    [[nodiscard]] double loss() const { return best_; }
    [[nodiscard]] const std::vector<Stand>& stands() const { return incumbent_; }

 private:
    struct Pair {
        int a, b;
        double overlap;
    };
    struct Extent {
        double x0, x1, y0, y1;
        int item;
    };

    void restore();
    void find_overlaps();
    void reweigh();
    // Moves each item that overlaps once, in random order, as long as there is work left.
    void pass(double limit);
    double settle(int item, Stand& stand, double cost);
    int any_of(const std::vector<int>& numbers);
    std::optional<Stand> anywhere(int item);
    std::optional<Stand> nearby(int item);
    void move(int item);

    Board& board_;
    const Freedom& freedom_;
    Dice& dice_;
    Persistence persistence_;
    std::vector<Pair> pairs_;
    std::vector<Pair> heavy_, next_heavy_;  // pairs whose weight is above 1
    std::vector<Extent> order_;
    std::vector<int> colliding_;
    std::vector<Stand> incumbent_;
    double total_ = 0.0;
    double best_ = 0.0;
    double at_start_ = 0.0;  // the least overlap when this start began
    int waited_ = 0;
    int strikes_ = 0;
};

}  // namespace popup
