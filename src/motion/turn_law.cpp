// Chebyshev polynomials: Mason and Handscomb, Chebyshev Polynomials, 2003, chapters 2 and 6.
#include "motion/turn_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace popup {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

// cos(pi i / n), once around.
template <std::size_t Steps>
std::array<double, 2 * Steps> cosines() {
    std::array<double, 2 * Steps> result{};
    for (std::size_t i = 0; i < result.size(); ++i)
        result.at(i) = std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(Steps));
    return result;
}

}  // namespace

TurnLaw::TurnLaw(std::span<const Vec2> law) {
    if (law.size() == 2) {
        const double slope = (law[1].y - law[0].y) / (law[1].x - law[0].x);
        Piece piece{};
        piece.first[0] = slope;
        pieces_.push_back(piece);
        ends_ = {law[0].x, law[1].x};
        return;
    }
    // Sheets have thousands of laws.
    static const std::array<double, 2 * kSteps> cosine = cosines<kSteps>();
    const std::size_t count = (law.size() - 1) / kSteps;
    pieces_.reserve(count);
    ends_.reserve(count + 1);
    for (std::size_t begin = 0; begin + kSteps < law.size(); begin += kSteps) {
        ends_.push_back(law[begin].x);
        // The points stand at x = -cos(pi i / n).
        Parts parts{};
        constexpr auto n = static_cast<double>(kSteps);
        for (std::size_t k = 0; k <= kSteps; ++k) {
            for (std::size_t i = 0; i <= kSteps; ++i) {
                const double weight = i == 0 || i == kSteps ? 0.5 : 1.0;
                // cos(k (pi - pi i / n)), from an angle within a turn.
                parts.at(k) +=
                    weight * law[begin + i].y * kRadPerDeg * cosine.at(k * (kSteps - i) % (2 * kSteps));
            }
            parts.at(k) *= (k == 0 || k == kSteps ? 1.0 : 2.0) / n;
        }
        const double stretch = 2.0 / ((law[begin + kSteps].x - law[begin].x) * kRadPerDeg);
        Piece piece{};
        piece.first = derivative(parts, stretch);
        piece.second = derivative(piece.first, stretch);
        for (const double part : derivative(piece.second, stretch)) piece.third_most += std::abs(part);
        pieces_.push_back(piece);
    }
    ends_.push_back(law.back().x);
}

TurnLaw::Parts TurnLaw::derivative(const Parts& parts, double stretch) {
    Parts result{};
    double above = 0.0;  // two further on
    double last = 0.0;   // one further on
    for (std::size_t k = kSteps; k-- > 0;) {
        const double here = above + 2.0 * static_cast<double>(k + 1) * parts.at(k + 1);
        result.at(k) = here;
        above = last;
        last = here;
    }
    result[0] *= 0.5;
    for (double& part : result) part *= stretch;
    return result;
}

// Clenshaw's sum.
double TurnLaw::value(const Parts& parts, double x) {
    double above = 0.0;
    double last = 0.0;
    for (std::size_t k = kSteps; k > 0; --k) {
        const double here = parts.at(k) + 2.0 * x * last - above;
        above = last;
        last = here;
    }
    return parts[0] + x * last - above;
}

TurnRate TurnLaw::rate(double from_deg, double to_deg) const {
    const double middle = 0.5 * (from_deg + to_deg);
    if (middle <= ends_.front() || middle >= ends_.back()) return {};  // it stays as it is
    const auto next = std::upper_bound(ends_.begin(), ends_.end(), middle);
    const auto number = static_cast<std::size_t>(next - ends_.begin()) - 1;
    const Piece& piece = pieces_[number];
    const double width = ends_[number + 1] - ends_[number];
    const double x = (2.0 * middle - ends_[number] - ends_[number + 1]) / width;
    const double half = 0.5 * (to_deg - from_deg) * kRadPerDeg;
    TurnRate rate;
    rate.at_middle = value(piece.first, x);
    rate.change = std::abs(value(piece.second, x)) + half * piece.third_most;
    rate.most = std::abs(rate.at_middle) + half * rate.change;
    rate.one_way = half * rate.change <= std::abs(rate.at_middle);
    return rate;
}

}  // namespace popup
