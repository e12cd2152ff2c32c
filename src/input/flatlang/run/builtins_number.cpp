// Mathematics, in radians.
#include <array>
#include <cmath>
#include <numbers>

#include "input/flatlang/run/interpreter.h"

namespace popup::flatlang {
namespace {

// Arguments are rounded to float, results are not: so the language has it.
template <double (*kFunction)(double)>
Value of_number(const Call& call) {
    return call.in.heap.number(kFunction(to_number(call.arguments[0], call.in.symbols)));
}

double square_root(double v) { return std::sqrt(v); }
double sine(double v) { return std::sin(v); }
double cosine(double v) { return std::cos(v); }
double tangent(double v) { return std::tan(v); }
double arc_sine(double v) { return std::asin(v); }
double arc_cosine(double v) { return std::acos(v); }
double arc_tangent(double v) { return std::atan(v); }

constexpr std::array kBuiltins{
    Builtin{"sqrt", 1, 1, of_number<square_root>, nullptr, "sqrt(x): the square root"},
    Builtin{"sin", 1, 1, of_number<sine>, nullptr, "sin(x): the sine of an angle in radians"},
    Builtin{"cos", 1, 1, of_number<cosine>, nullptr, "cos(x): the cosine of an angle in radians"},
    Builtin{"tan", 1, 1, of_number<tangent>, nullptr, "tan(x): the tangent of an angle in radians"},
    Builtin{"asin", 1, 1, of_number<arc_sine>, nullptr, "asin(x): the angle of that sine, in radians"},
    Builtin{"acos", 1, 1, of_number<arc_cosine>, nullptr, "acos(x): the angle of that cosine, in radians"},
    Builtin{"atan", 1, 1, of_number<arc_tangent>, nullptr, "atan(x): the angle of that tangent, in radians"},
    Builtin{"pi", 0, 0, [](const Call& call) { return call.in.heap.number(std::numbers::pi); }, nullptr,
            "pi(): half a turn in radians"},
};

}  // namespace

std::span<const Builtin> number_builtins() { return kBuiltins; }

}  // namespace popup::flatlang
