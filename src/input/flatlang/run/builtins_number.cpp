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
    Builtin{"sqrt", 1, 1, of_number<square_root>},
    Builtin{"sin", 1, 1, of_number<sine>},
    Builtin{"cos", 1, 1, of_number<cosine>},
    Builtin{"tan", 1, 1, of_number<tangent>},
    Builtin{"asin", 1, 1, of_number<arc_sine>},
    Builtin{"acos", 1, 1, of_number<arc_cosine>},
    Builtin{"atan", 1, 1, of_number<arc_tangent>},
    Builtin{"pi", 0, 0, [](const Call& call) { return call.in.heap.number(std::numbers::pi); }},
};

}  // namespace

std::span<const Builtin> number_builtins() { return kBuiltins; }

}  // namespace popup::flatlang
