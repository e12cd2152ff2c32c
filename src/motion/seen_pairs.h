// What earlier examinations of one assembly have found of pairs of plates, for one that differs in what folds
// do.
//
// How two plates of a folded sheet go against each other is said by the folds between them alone. When an
// order of folds is sought, the same assembly is examined again and again while a fold or two go and all the
// rest stands still; most pairs do then what they did before.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "motion/contacts.h"
#include "motion/pair_search.h"

namespace popup {

class SeenPairs {
 public:
    // By plate: the plate that it hangs on, -1 for none, and the number of what turns it there, -1 where that
    // never does anything else. Loops need no more: what closes them goes as those folds do.
    SeenPairs(std::span<const int> base, std::span<const int> mover);

    // What each mover does from now on. The same number means the same law; `still`, by that number: it does
    // not turn at all.
    void set(std::vector<int> doing, const std::vector<char>& still);

    // Of a pair that moves as it does now.
    struct Way {
        std::vector<int> doing;  // of the movers between the two
        bool still = false;      // none of them turns
        bool crosses = false;    // firmly, somewhere
        struct InCell {
            double from, to;
            std::vector<ContactRange> found;
        };
        std::vector<InCell> cells;
        // What find_contacts() has made of stretches.
        std::optional<Contacts> contacts;
        std::vector<ContactRange> stretches;

        // What PairSearch::contacts() finds in a cell, if that is known. What stands still has the same in
        // all.
        [[nodiscard]] bool knows(double from, double to, std::vector<ContactRange>& found) const;
        void keep(double from, double to, const std::vector<ContactRange>& found);
    };
    Way& of(int a, int b);  // a < b

    // Whether any pair but those of `aside` is known to cross firmly, moving as it does now.
    [[nodiscard]] bool any_crosses(const std::set<std::pair<int, int>>& aside) const;

 private:
    struct Pair {
        std::vector<int> movers;  // between them
        std::vector<Way> ways;
    };
    Pair& pair_of(int a, int b);
    [[nodiscard]] const Way* find(const Pair& pair) const;

    std::vector<int> base_, mover_;
    std::vector<int> depth_;                     // of each plate: how many it hangs on
    std::map<std::pair<int, int>, Pair> pairs_;  // those that were asked for: few come near each other
    std::vector<int> doing_;
    std::vector<char> still_;
};

}  // namespace popup
