// Points of space that are the same up to rounding, as numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "popup/geometry.h"

namespace popup::flatlang {

// Points no further apart than `tolerance` on any axis are the same: the first of them stands for all. Cost
// of each: constant. Coordinates must be finite and within ±1e12 tolerances.
class SamePoints {
 public:
    explicit SamePoints(double tolerance) : tolerance_(tolerance), cell_(16 * tolerance) {}

    // The number of the point, from 0 in the order in which they came.
    int of(Vec3 p);
    // -1: it has none.
    [[nodiscard]] int find(Vec3 p) const;
    [[nodiscard]] Vec3 point(int number) const { return points_[static_cast<std::size_t>(number)]; }
    [[nodiscard]] std::size_t size() const { return points_.size(); }

 private:
    using Cell = std::array<std::int64_t, 3>;
    struct CellHash {
        std::size_t operator()(const Cell& cell) const;
    };
    [[nodiscard]] std::int64_t cell_of(double x) const;

    double tolerance_;
    double cell_;  // its width: few points fit in one, and mostly one has to be looked at
    std::vector<Vec3> points_;
    std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
};

}  // namespace popup::flatlang
