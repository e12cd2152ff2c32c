// Variables that a program reads and nothing ever sets: mostly slips of the pen.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/syntax/syntax.h"

namespace popup::flatlang {

struct UnknownName {
    int symbol = -1;
    Place place;                    // where it is read first
    std::vector<std::string> like;  // names that are known and nearly the same
};

// The names that stand for values in `program` and are nowhere in `units` (what was loaded, the program among
// them) a variable that is assigned, a parameter, a function, or a member that is set; `nil` and builtins are
// known. In the order of the text, each once. Nothing where texts are evaluated: these may set any variable.
// Cost: linear in nodes.
std::vector<UnknownName> unknown_names(const Syntax& program, const std::deque<Syntax>& units,
                                       const std::vector<int>& defined, const Symbols& symbols);

// The variables and members that `name` may be meant to be, of those that `units` set, but for the first.
std::vector<std::string> variables_like(std::string_view name, const std::deque<Syntax>& units,
                                        const Symbols& symbols);
// The functions that `name` may be meant to be, of the builtins and those that `units` define.
std::vector<std::string> functions_like(std::string_view name, const std::deque<Syntax>& units,
                                        const Symbols& symbols);

}  // namespace popup::flatlang
