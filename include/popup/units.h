// Lengths and angles as types, so that a bare number never has to be guessed at.
//
// Inside the library coordinates are plain doubles in millimetres and angles plain doubles in radians;
// these types stand at public boundaries (options, results).
#pragma once

#include <numbers>

namespace popup {

// A length. Stored in millimetres; any finite value, sign included.
struct Length {
    double mm = 0.0;

    static constexpr Length millimetres(double value) { return {value}; }
    static constexpr Length inches(double value) { return {value * 25.4}; }
    static constexpr Length points(double value) { return {value * 25.4 / 72.0}; }
    friend constexpr bool operator==(Length, Length) = default;
};

// An angle. Stored in degrees, because whole degrees (0, 90, 180) must stay exact.
struct Angle {
    double deg = 0.0;

    static constexpr Angle degrees(double value) { return {value}; }
    static constexpr Angle radians(double value) { return {value * 180.0 / std::numbers::pi}; }
    [[nodiscard]] constexpr double rad() const { return deg * std::numbers::pi / 180.0; }
    friend constexpr bool operator==(Angle, Angle) = default;
};

}  // namespace popup
