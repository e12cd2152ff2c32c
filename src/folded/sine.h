// Sine, cosine and their angle, the same to the last bit on every processor. Those of the C library are not:
// where there is a fused multiply-add it is used, and a sheet that can close in many ways, or hardly, makes
// much of a last bit.
#pragma once

#include <span>

namespace popup::folded {

struct SineCosine {
    double sine = 0.0, cosine = 1.0;
};

// Right to three units of the last place, for angles (radians) up to 1e5.
SineCosine sine_cosine(double angle);
// Of all angles, the same bits at less cost. Precondition: there is room for as many.
void sines_cosines(std::span<const double> angles, std::span<SineCosine> to);

// The angle, in (-π, π], of a sine and a cosine that are both multiplied by one positive number. Right to
// three units of the last place.
double angle_of(double sine, double cosine);

}  // namespace popup::folded
