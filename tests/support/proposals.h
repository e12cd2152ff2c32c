// What the generators of designs share: random numbers, and elements proposed at random.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/builder.h"
#include "mechanism/site.h"
#include "popup/mechanism.h"

namespace popup::test {

// splitmix64: the same numbers on every machine.
struct Dice {
    std::uint64_t state;
    std::uint64_t next() {
        state += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(next() >> 11) * 0x1p-53;
    }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
    bool chance(double p) { return uniform(0, 1) < p; }
};

struct Proposal {
    std::string type;
    std::vector<std::pair<Side, SitePoint>> on;  // in the row's order
    std::vector<Vec2> extra;
    std::vector<Argument> arguments;  // in the row's order
    bool finds_ground = false;        // it does not name its fold
};

// Whether the fold is one that such an element may stand on.
bool stands_on(const ElementInfo& info, const Fold& fold);
// Points and required values of any element that stands on folds, from its row alone. check() then mends them
// into an element.
Proposal propose_of(Dice& random, const Fold& fold, const ElementInfo& info);
// Adds it to the design.
void put(Design& design, const Fold& fold, const Proposal& made);
// A path round a point, at distances from `least` to `most` mm, with lines and curves.
Argument star_path(Dice& random, Vec2 middle, double least, double most);

}  // namespace popup::test
