#include "input/flatlang/pieces/same_points.h"

#include <cmath>

namespace popup::flatlang {

std::size_t SamePoints::CellHash::operator()(const Cell& cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t one : cell) {
        h = (h ^ (h >> 29U)) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(one);
    }
    return static_cast<std::size_t>((h ^ (h >> 31U)) * 0xBF58476D1CE4E5B9ULL);
}

// Sides of cells stand off the numbers that people write, so that mostly one cell has to be looked at.
std::int64_t SamePoints::cell_of(double x) const {
    return static_cast<std::int64_t>(std::floor(x / cell_ + 0.3771));
}

int SamePoints::find(Vec3 p) const {
    const std::array<double, 3> place{p.x, p.y, p.z};
    std::array<std::array<std::int64_t, 2>, 3> range{};
    for (std::size_t k = 0; k < 3; ++k) {
        range[k] = {cell_of(place[k] - tolerance_), cell_of(place[k] + tolerance_)};
    }
    int found = -1;
    for (std::int64_t x = range[0][0]; x <= range[0][1]; ++x) {
        for (std::int64_t y = range[1][0]; y <= range[1][1]; ++y) {
            for (std::int64_t z = range[2][0]; z <= range[2][1]; ++z) {
                const auto cell = cells_.find({x, y, z});
                if (cell == cells_.end()) continue;
                for (const int number : cell->second) {
                    const Vec3 off = point(number) - p;
                    const bool same = std::fabs(off.x) <= tolerance_ && std::fabs(off.y) <= tolerance_ &&
                                      std::fabs(off.z) <= tolerance_;
                    if (same && (found < 0 || number < found)) found = number;
                }
            }
        }
    }
    return found;
}

int SamePoints::of(Vec3 p) {
    if (const int known = find(p); known >= 0) return known;
    const int number = static_cast<int>(points_.size());
    points_.push_back(p);
    cells_[{cell_of(p.x), cell_of(p.y), cell_of(p.z)}].push_back(number);
    return number;
}

}  // namespace popup::flatlang
