// Where plates come nearer to each other than was asked for.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "motion/nearness.h"
#include "motion/pair_search.h"
#include "popup/motion.h"

namespace popup {

// Of pairs of plates, from their stretches in all cells. Both spans must outlive it.
class Approaches {
 public:
    Approaches(const Assembly& assembly, std::span<const PlateShape> shapes, double distance_mm);

    // Looks at a pair in one cell; cells of a pair come in their order.
    void add(const Cell& cell, int a, int b, PairSearch& search);

    // All but what flat folding brings about, and those that end in a contact. By a, b, from_deg.
    [[nodiscard]] std::vector<Approach> take(const std::vector<Contact>& contacts, PairSearch& search) const;

 private:
    bool joined(int a, int b);
    void find_least(Approach& one, PairSearch& search) const;
    // They lie in one plane, or one stands on the other as a wall does on the page.
    [[nodiscard]] bool meet_when_open(const Approach& one, PairSearch& search) const;

    Sweep sweep_;
    std::span<const PlateShape> shapes_;
    double distance_mm_;
    std::vector<std::vector<Frame>> frames_;
    std::vector<Frame> open_;
    std::vector<int> bodies_;  // by plate
    bool reached_ = true;      // all those angles
    NearnessTest nearness_;
    std::vector<ContactRange> stretches_;
    std::map<std::pair<int, int>, bool> joined_;  // the smaller number first
    std::map<std::pair<int, int>, std::vector<Approach>> found_;
};

}  // namespace popup
