// Numbers as the document writes them: decimal, with an optional exponent, in no locale.
#pragma once

#include <string>
#include <string_view>

namespace popup::xml {

enum class NumberFault {
    none,
    empty,
    malformed,
    comma,  // a decimal comma
    hexadecimal,
    not_finite,  // nan, inf
    too_large,   // no double holds it
};

struct ParsedNumber {
    double value = 0.0;  // finite; 0 when there is a fault
    NumberFault fault = NumberFault::none;
};

// All of `text`, blanks around disregarded, as one number. What is too small for a double is 0.
ParsedNumber parse_number(std::string_view text);

// With at most six decimals, no zeros at the end, no exponent, never "-0". Precondition: finite.
std::string format_number(double value);

}  // namespace popup::xml
