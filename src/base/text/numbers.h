// Numbers as outputs write them: few digits, no locale, the same on every processor.
#pragma once

#include <fmt/format.h>

#include <string>

namespace popup {

// Appends `value` rounded to `decimals` decimals (0 to 9; halves away from zero), without trailing zeros,
// never "-0", always with a decimal point and never with an exponent. Precondition: the value is finite (an
// invariant: a drawing with a hole in it must not be written).
void append_number(fmt::memory_buffer& out, double value, int decimals);
std::string number_text(double value, int decimals);

// `value` rounded to `decimals` decimals (0 to 9), never -0: what JSON is given. Not finite: as it is, which
// JSON writes as null.
double rounded(double value, int decimals);

}  // namespace popup
