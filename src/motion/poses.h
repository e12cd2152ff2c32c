// Where plates are at the openings that the examination of one range halves it at.
//
// Every pair of plates that is looked at more closely asks for the same openings: the middle of the range, of
// its halves, of their halves. What one pair has placed there the next one finds.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/linkage.h"
#include "popup/assembly.h"

namespace popup {

class Poses {
 public:
    // Both must outlive the object.
    Poses(const Assembly& assembly, const Linkage& linkage);

    // Halves of a range have numbers, as nodes of a binary tree have: the whole is 1, its lower half 2, its
    // upper half 3, those of number n 2 n and 2 n + 1. 0: a part so small that nothing is kept of it.
    [[nodiscard]] std::size_t lower(std::size_t number) const { return kept(2 * number); }
    [[nodiscard]] std::size_t upper(std::size_t number) const {
        return number == 0 ? 0 : kept(2 * number + 1);
    }

    // Forgets all that is kept, if the range is not the one that was named last.
    void begin(double from_deg, double to_deg);
    // Places the joints (numbers, in an order in which they can be placed) at the middle of a part, given as
    // its opening too. False if one of them does not get there.
    bool place(std::size_t number, double deg, std::span<const std::size_t> joints);
    // Where place() put plates; those of other joints are anywhere. Good until the next call of place().
    [[nodiscard]] std::span<const Frame> frames() const { return now_->frames; }
    // The bend of a turn between plates that were placed, and place() was true (Linkage::bend).
    double bend(int turn);

 private:
    enum State : char { unknown, placed, out_of_reach };
    struct Pose {
        std::vector<Frame> frames;
        std::vector<State> joints;
        std::vector<double> bends;  // NaN: not known
    };
    [[nodiscard]] std::size_t kept(std::size_t number) const { return number < kept_.size() ? number : 0; }
    void forget(Pose& pose) const;

    const Assembly& assembly_;
    const Linkage& linkage_;
    double from_deg_ = 0.0, to_deg_ = -1.0;
    std::vector<Pose> kept_;  // by number; 0: for parts of which nothing is kept
    std::vector<std::size_t> used_;
    Pose* now_ = nullptr;
};

}  // namespace popup
