// The names of a program, and where functions are defined: from its words, so that a program that is being
// typed has them too.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/syntax/lexer.h"
#include "lsp/text.h"

namespace popup::lsp {

struct FunctionText {
    std::string name;
    std::vector<std::string> parameters;
    Span name_at;
    Span all;           // from `define` to behind its `done`, or to where the text ends
    std::string about;  // the comment that tells of it; empty: there is none
};

struct ProgramText {
    std::string_view text;
    std::vector<flatlang::Token> tokens;  // without the end
    std::vector<FunctionText> functions;
    // Names that are assigned, parameters and names of loops, each where it stands first in a function, or
    // outside of them, in order.
    std::vector<Span> variables;

    [[nodiscard]] std::string_view word(const flatlang::Token& token) const {
        return text.substr(token.begin, token.end - token.begin);
    }
    // The number of the name that touches a byte; nullopt: there is none.
    [[nodiscard]] std::optional<std::size_t> name_at(std::size_t at) const;
    // All that are written so, as names.
    [[nodiscard]] std::vector<Span> all_of(std::string_view name) const;
    // The function that a byte is in; null: none.
    [[nodiscard]] const FunctionText* around(std::size_t at) const;
};

// Any bytes may come. `text` must outlive the result. A function's comment stands above it, behind it on its
// line, or elsewhere in the file in a comment that begins with its call, such as "; gear(teeth): a gear".
// Cost: linear, and the length of its comment a function.
ProgramText program_text(std::string_view text);

// A function that programs may call without defining it.
struct KnownFunction {
    std::string name;
    std::string call;      // "forward(amt)"
    std::string about;     // what it does
    std::string_view kit;  // the file of the kit that has it: "gear.fl"; empty: it is built in
};
// Builtins, those of the prelude and those of the kit, by name; none begins with "__".
const std::vector<KnownFunction>& known_functions();
// By name; null: there is none.
const KnownFunction* find_known_function(std::string_view name);

}  // namespace popup::lsp
