// What is said of texts that are not programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/syntax/lexer.h"

namespace popup::flatlang {

struct Complaint {
    Place place;
    std::string message;
    std::vector<std::string> hints;
    std::vector<Related> related;
};

// A word as a message names it: "'done'", "the number 4", "the end of the file".
std::string found(std::string_view text, const Token& token);
// A kind as a message names it: "'('", "a name".
std::string wanted(TokenKind kind);
// "3:14"
std::string shown(Place place);

// Of letters that make no words.
Complaint lexical_complaint(std::string_view text, const Lexed& lexed, const LexicalError& error);

// What may mend that `tokens[wrong]` does not fit where it stands, from what stands around it; often nothing.
std::vector<std::string> hints_at(std::string_view text, const std::vector<Token>& tokens, std::size_t wrong);

// The first text that goes over the end of its line: where a quotation mark may be missing. The number of
// tokens when there is none.
std::size_t first_text_over_lines(std::string_view text, const std::vector<Token>& tokens);

}  // namespace popup::flatlang
