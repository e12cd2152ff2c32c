// Crease patterns that formulas draw, for tests.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "popup/crease_pattern.h"

namespace popup::test {

// A Miura sheet of columns × rows parallelograms with sides a (up, leaning by `lean` to either side in turn)
// and b (across), with its border. Lines that go up are mountains and valleys in turn; those across change at
// each corner.
inline CreasePattern miura(int columns, int rows, double a, double b, double lean) {
    CreasePattern pattern;
    pattern.fold_deg = 180.0;
    const auto corner = [&](int i, int j) {
        return Vec2{b * i + (j % 2 == 0 ? 0.0 : a * std::sin(lean)), a * std::cos(lean) * j};
    };
    for (int i = 0; i <= columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            const CreaseUse use = i == 0 || i == columns ? CreaseUse::cut
                                  : i % 2 == 0           ? CreaseUse::mountain
                                                         : CreaseUse::valley;
            pattern.lines.push_back({{corner(i, j), corner(i, j + 1)}, false, use});
        }
    }
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const CreaseUse use = j == 0 || j == rows ? CreaseUse::cut
                                  : (i + j) % 2 == 1  ? CreaseUse::mountain
                                                      : CreaseUse::valley;
            pattern.lines.push_back({{corner(i, j), corner(i + 1, j)}, false, use});
        }
    }
    return pattern;
}

}  // namespace popup::test
