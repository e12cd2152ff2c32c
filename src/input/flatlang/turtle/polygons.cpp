#include "input/flatlang/turtle/polygons.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace popup::flatlang {

namespace {

constexpr double tolerance = 1e-4;

bool same(Vec3 a, Vec3 b) {
    return std::fabs(a.x - b.x) < tolerance && std::fabs(a.y - b.y) < tolerance &&
           std::fabs(a.z - b.z) < tolerance;
}

bool finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

// Cells are ten times as wide as the tolerance, and begin where drawings seldom have points, so that mostly
// one has to be looked at. As doubles: no coordinate is too large for them.
double cell_of(double coordinate) { return std::floor(coordinate * 1024.0 + 0.37) + 0.0; }

Vec3 unit_or_zero(Vec3 a) {
    const double size = length(a);
    return size != 0.0 ? (1.0 / size) * a : Vec3{};
}

}  // namespace

std::size_t PolygonFinder::CellHash::operator()(const Cell& cell) const {
    std::uint64_t h = 0;
    for (const double part : {cell.x, cell.y, cell.z}) {
        h = (h ^ std::bit_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15ULL;
        h = (h ^ (h >> 31U)) * 0xBF58476D1CE4E5B9ULL;
        h ^= h >> 29U;
    }
    return static_cast<std::size_t>(h);
}

void PolygonFinder::lift() {
    while (!run_.empty()) pop();
}

bool PolygonFinder::add(Vec3 point) {
    if (!finite(point)) return false;
    if (run_.empty()) {
        push(point, true);
        return false;
    }
    if (same(run_.back().at, point)) return false;
    const int oldest = oldest_same(point);
    const int newest = static_cast<int>(run_.size()) - 1;
    if (oldest < 0 || !is_flat_loop(oldest, newest)) {
        // One that stands exactly where an older one does is never the oldest while that is in the run.
        push(point, oldest < 0 || run(oldest) != point);
        return false;
    }
    polygon_.clear();
    for (int i = newest; i >= oldest; --i) {
        polygon_.push_back(run(i));
        pop();
    }
    push(point, true);
    return true;
}

void PolygonFinder::push(Vec3 point, bool list) {
    const int index = static_cast<int>(run_.size());
    run_.push_back({.at = point, .older = -1, .newer = -1, .listed = list});
    if (!list) return;
    CellPoints& cell = cells_[{cell_of(point.x), cell_of(point.y), cell_of(point.z)}];
    // A crowd would be walked through by each point that comes near it.
    constexpr int most = 200;
    if (cell.count == most) {
        run_.back().listed = false;
        return;
    }
    ++cell.count;
    run_.back().older = cell.newest;
    if (cell.newest >= 0) {
        run_[static_cast<std::size_t>(cell.newest)].newer = index;
    } else {
        cell.oldest = index;
    }
    cell.newest = index;
}

void PolygonFinder::pop() {
    const Point& last = run_.back();
    if (last.listed) {
        const auto cell = cells_.find({cell_of(last.at.x), cell_of(last.at.y), cell_of(last.at.z)});
        cell->second.newest = last.older;
        --cell->second.count;
        if (last.older >= 0) {
            run_[static_cast<std::size_t>(last.older)].newer = -1;
        } else {
            cells_.erase(cell);
        }
    }
    run_.pop_back();
    if (odd_one_ >= static_cast<int>(run_.size())) odd_one_ = -1;
}

int PolygonFinder::oldest_same(Vec3 point) const {
    struct Range {
        std::array<double, 2> cells;
        int count;
    };
    const auto range = [](double coordinate) {
        const double low = cell_of(coordinate - tolerance);
        const double high = cell_of(coordinate + tolerance);
        return Range{{low, high}, low == high ? 1 : 2};
    };
    const Range xs = range(point.x);
    const Range ys = range(point.y);
    const Range zs = range(point.z);
    int oldest = -1;
    for (int i = 0; i < xs.count; ++i) {
        for (int j = 0; j < ys.count; ++j) {
            for (int k = 0; k < zs.count; ++k) {
                const auto cell =
                    cells_.find({xs.cells[static_cast<std::size_t>(i)], ys.cells[static_cast<std::size_t>(j)],
                                 zs.cells[static_cast<std::size_t>(k)]});
                if (cell == cells_.end()) continue;
                int each = cell->second.oldest;
                while (each >= 0 && !same(run(each), point))
                    each = run_[static_cast<std::size_t>(each)].newer;
                if (each >= 0 && (oldest < 0 || each < oldest)) oldest = each;
            }
        }
    }
    return oldest;
}

bool PolygonFinder::is_flat_loop(int oldest, int newest) {
    if (newest - oldest + 1 < 3) return false;
    const Vec3 on = run(newest);
    const Vec3 normal = unit_or_zero(cross(run(newest - 1) - on, run(newest - 2) - on));
    const auto in_plane = [&](int each) {
        // What is the same point counts as lying in its plane.
        return same(run(each), on) || std::fabs(dot(run(each) - on, normal)) < tolerance;
    };
    if (odd_one_ >= oldest && odd_one_ <= newest - 3 && !in_plane(odd_one_)) return false;
    for (int i = newest - 3; i >= oldest; --i) {
        if (in_plane(i)) continue;
        odd_one_ = i;
        return false;
    }
    return true;
}

}  // namespace popup::flatlang
