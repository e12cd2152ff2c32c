// Functions as the program sees its own source.
#pragma once

#include <string>

#include "input/flatlang/run/value.h"

namespace popup::flatlang {

// source(f): the definition as a list of words and lists, from which source() of a list makes a text again.
// Statements other than expressions and `repeat` come out as "{{broken}}": so the language has it.
Value source_list(const FunctionBody& function, Heap& heap, const Symbols& symbols);
// The words of a list and of all lists in it, with spaces between.
std::string words_of(const Value& list, const Symbols& symbols, std::size_t most);
// pprint(f): the definition over several lines.
std::string pretty(const FunctionBody& function, const Symbols& symbols);

}  // namespace popup::flatlang
