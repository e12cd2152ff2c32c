// The variables of a running program.
#pragma once

#include <cstddef>
#include <vector>

#include "input/flatlang/run/value.h"

namespace popup::flatlang {

// Scopes in a stack: the lowest holds functions, the next globals; calls and for-each rounds push further
// ones. A name means its newest variable, whoever defined it: scope is dynamic. Cost of everything: constant,
// of pop() the variables of that scope.
class Scopes {
 public:
    Scopes();

    void push();
    void pop();
    [[nodiscard]] std::size_t depth() const { return starts_.size(); }

    // The newest visible variable of that name, or null. Valid until the next change.
    [[nodiscard]] const Value* find(int symbol) const;
    // Overwrites the newest visible variable of that name; without one, makes it in the newest scope.
    void assign(int symbol, Value value);
    // Makes or overwrites it in the newest scope.
    void bind(int symbol, Value value);
    // Makes or overwrites it in the scope of functions.
    void bind_function(int symbol, Value value);

    // Variables of scopes below are not visible, functions are. 0: all are. As a safe function has it.
    void hide_below(std::size_t depth) { floor_ = depth; }
    [[nodiscard]] std::size_t hidden_below() const { return floor_; }
    // The original's: always those below the newest scope.
    void hide_below_newest(bool hide) { only_newest_ = hide; }
    [[nodiscard]] bool hides_below_newest() const { return only_newest_; }

 private:
    struct Variable {
        std::size_t depth;
        Value value;
    };
    using Stack = std::vector<Variable>;  // of one name, oldest first
    [[nodiscard]] std::size_t floor() const { return only_newest_ ? depth() : floor_; }
    Stack& stack(int symbol);

    std::vector<Stack> variables_;  // by symbol
    std::vector<int> bound_;        // symbols in the order in which they were bound, but for functions
    std::vector<std::size_t> starts_;
    std::size_t floor_ = 0;
    bool only_newest_ = false;
};

}  // namespace popup::flatlang
