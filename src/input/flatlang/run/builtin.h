// The functions that are there before a program defines any: tables of rows.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "input/flatlang/run/value.h"
#include "popup/diagnostics.h"

namespace popup::flatlang {

class Interpreter;  // interpreter.h

// One call of a builtin. Arguments are evaluated; their number is within the row's range.
struct Call {
    Interpreter& in;
    std::span<const Value> arguments;
    const Node& node;       // of the call
    Place place;            // of the call, in the text that is run
    std::string_view name;  // as the program knows it: of the function of the prelude that has called it
    const void* data;       // the row's
};

// A row. `run` never returns an empty value; what is wrong it tells the interpreter: Interpreter::fail() ends
// the program, warn() does not.
struct Builtin {
    std::string_view name;
    int least = 0;
    int most = 0;  // arguments; -1: any number
    Value (*run)(const Call&) = nullptr;
    const void* data = nullptr;  // for rows made from another table
    // The call and what it does, for those that programs call: "sqrt(x): the square root".
    std::string_view about = {};
};

// The tables. A further one is one file and one row of `builtin_tables` in builtins.cpp.
std::span<const Builtin> turtle_builtins();
std::span<const Builtin> number_builtins();
std::span<const Builtin> list_builtins();
std::span<const Builtin> program_builtins();  // print, load, eval, source, object
std::span<const Builtin> card_builtins();     // popup, and one an element of the element table
std::span<const Builtin> sheet_builtins();    // sheet, cutline, and the kinds of folds

// By name; null: there is none.
const Builtin* find_builtin(std::string_view name);
// All names, in no certain order.
std::vector<std::string_view> builtin_names();

// FlatLang text that is run before every program: what the language calls forward(), cons() … in terms of
// builtins whose names begin with "__". What a function does stands in a comment behind it.
std::string_view prelude();

}  // namespace popup::flatlang
