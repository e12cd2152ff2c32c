// The digits that an assembly has.
//
// An assembly is a document, too (docs/assembly.md), and what is made of the document must be what is made of
// the assembly, byte for byte. So its numbers are rounded once, where it is made, to those that its text has:
// lengths to 1e-10 mm, directions to 1e-14, angles to 1e-11 degrees. All of that lies far below every
// tolerance of the stages after it (1e-6 mm, 1e-6°), and takes the last bits from it in which processors
// differ.
#pragma once

#include "popup/assembly.h"

namespace popup {

inline constexpr double kLengthsPerMm = 1e10;
inline constexpr double kDirectionsPerUnit = 1e14;
inline constexpr double kAnglesPerDegree = 1e11;

// `value` rounded to multiples of 1 / per_unit, never -0. A value of more than 1e15 such steps stays as it
// is. Settling it again changes nothing, and JSON writes it in no more decimals than the steps have.
double settled(double value, double per_unit);
// An angle as the text has it, in degrees; and back. There and back again it is the same number.
double settled_degrees(double radians);
double radians_of(double settled_degrees);

// Rounds all numbers of an assembly. Guarantee: a second call changes nothing. Cost: linear.
void settle_numbers(Assembly& assembly);

}  // namespace popup
