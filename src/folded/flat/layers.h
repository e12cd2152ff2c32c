// Which of two panels that lie on each other is above: conditions on such pairs, and an order that meets
// them.
//
// The conditions are those of Justin (Towards a mathematical theory of origami, 1997) as Akitaya, Demaine and
// Ku solve them (Computing flat-folded states, 2024): what is above is a value of +1 or -1 for each pair;
// that a panel does not pass between two others at their fold says that two values are equal, that two folds
// on one line do not interleave says that four of them multiply to +1, and that above is an order says that
// three around a triangle are not all the same.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace popup::folded {

class Layers {
 public:
    // Makes a pair known; a != b. Returns its number. The same pair has one number.
    int pair(int a, int b);
    [[nodiscard]] std::size_t pairs() const { return pairs_.size(); }
    [[nodiscard]] std::array<int, 2> panels_of(int pair) const {
        return pairs_[static_cast<std::size_t>(pair)];
    }

    // Conditions; all pairs that they name must be known, or they say nothing.
    void lies_above(int a, int b);                     // a above b
    void not_between(int a, int b, int c);             // c is not between a and b
    void not_interleaved(int a, int b, int c, int d);  // of c and d none or both are between a and b
    void in_order(int a, int b, int c);                // above is transitive among them
    [[nodiscard]] std::size_t conditions() const { return conditions_.size(); }

    struct Solution {
        enum Kind { found, none, undecided } kind = undecided;
        std::vector<signed char> above;  // found: by pair, +1 where its first panel is above
        std::vector<int> panels;  // none: as few as were found that have no order among them, ascending
    };
    // An order, or that there is none. `most_work`: looks at conditions, after which it is undecided; above
    // 0.
    [[nodiscard]] Solution solve(std::size_t most_work) const;
    // Whether a lies above b in what was found; nullopt if they are no pair.
    [[nodiscard]] std::optional<bool> is_above(const Solution& found, int a, int b) const;

 private:
    friend class LayerSearch;
    struct Literal {
        int pair = -1;
        signed char sign = 1;
    };
    enum class Kind : char { fixed, equal, even, cycle };
    struct Condition {
        Kind kind;
        std::array<Literal, 4> of;
    };
    [[nodiscard]] static int count(Kind kind);
    // +1 where the first panel is above.
    [[nodiscard]] std::optional<Literal> literal(int a, int b) const;
    void add(Kind kind, const std::array<std::optional<Literal>, 4>& of);

    std::vector<std::array<int, 2>> pairs_;
    std::unordered_map<unsigned long long, int> number_;
    std::vector<Condition> conditions_;
};

}  // namespace popup::folded
