// How fast a fold with a law of its own turns, and how fast that changes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "popup/joints.h"

namespace popup {

// Of a fold over a range of openings: radians by radian of opening.
struct TurnRate {
    double at_middle = 0.0;  // the fold's own direction is positive
    double most = 0.0;       // no rate in the range is larger, whichever way it turns
    double change = 0.0;     // no second derivative in the range is larger
    bool one_way = true;     // it does not turn back in the range, for certain
};

// The derivatives of a law (Folded of popup/joints.h).
class TurnLaw {
 public:
    // Precondition: the law is one, as fault_of() has it.
    explicit TurnLaw(std::span<const Vec2> law);

    // Openings at which one polynomial ends and the next begins, the first and the last among them.
    [[nodiscard]] std::span<const double> ends() const { return ends_; }
    // Precondition: no end of a polynomial lies between the openings, from < to. Cost: a dozen products.
    [[nodiscard]] TurnRate rate(double from_deg, double to_deg) const;

 private:
    static constexpr std::size_t kSteps = Folded::kLawSteps;
    // A polynomial over [-1, 1] by its parts of Chebyshev polynomials.
    using Parts = std::array<double, kSteps + 1>;
    struct Piece {
        Parts first, second;      // derivatives, radians by radian of opening
        double third_most = 0.0;  // no third derivative is larger
    };
    static double value(const Parts& parts, double x);
    static Parts derivative(const Parts& parts, double stretch);
    std::vector<double> ends_;
    std::vector<Piece> pieces_;
};

}  // namespace popup
