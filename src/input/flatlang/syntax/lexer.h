// The text of a FlatLang program as words.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup::flatlang {

enum class TokenKind : std::uint8_t {
    end,  // behind the last word
    number,
    text,  // with its quotation marks
    name,
    kw_define,
    kw_safe,
    kw_if,
    kw_alt,
    kw_else,
    kw_done,
    kw_while,
    kw_repeat,
    kw_for_each,
    kw_from,
    kw_shape,
    kw_replace,
    kw_replace_all,
    kw_and,
    kw_or,
    kw_true,
    kw_false,
    kw_infinity,
    kw_object,
    open,   // (
    close,  // )
    open_list,
    close_list,
    comma,
    dot,
    colon,
    assign,
    equal,
    unequal,
    less,
    less_equal,
    greater,
    greater_equal,
    plus,
    minus,
    star,
    slash,
    percent,
};

struct Token {
    TokenKind kind = TokenKind::end;
    Place place;  // of its first character
    std::size_t begin = 0;
    std::size_t end = 0;  // bytes of the text, [begin, end)
};

// What is wrong with letters, before there is any grammar.
enum class LexicalFault : std::uint8_t {
    bad_character,   // begins no word; the default mode tells a run of them once
    half_keyword,    // `for` and a blank, but no `each`
    half_operator,   // ! without =
    unfinished,      // a text without its closing quotation mark
    digits_missing,  // 2. without digits behind the dot
    glued_name,      // a number and a name without a blank between them; not in 2008 mode, where they are two
                     // words
};

struct LexicalError {
    LexicalFault fault = LexicalFault::bad_character;
    Place place;    // where it is told: in 2008 mode where the original told it
    Token concern;  // the word that it belongs to, as far as it goes
};

struct Lexed {
    std::vector<Token> tokens;  // the last one is `end`
    std::vector<LexicalError> errors;
};

// Any bytes may come. In 2008 mode half a word is dropped as the original did, with the character that was
// wrong and, but for numbers, the one behind it. In default mode `2.` is the number 2, `for` and a blank are
// `for each`, and half an operator and a glued name are left out, so that one mistake is told once. A text
// that is not closed is dropped in both, and ends the program. A byte order mark at the beginning is passed
// over. Lines end with \n; columns count code points. Cost: linear.
Lexed lex(std::string_view text, bool as_2008);

// As it is written in a program: "done", "(", "for each"; for kinds that are many, what they are: "a name".
std::string_view to_string(TokenKind kind);

}  // namespace popup::flatlang
