#include "input/flatlang/polygons.h"

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

// From a closed way: each point whose neighbours are the same, with one of these, until there is none.
void drop_ways_there_and_back(std::vector<Vec3>& loop) {
    std::size_t kept = 0;
    for (const Vec3 point : loop) {
        if (kept >= 2 && same(loop[kept - 2], point)) {
            --kept;
        } else {
            loop[kept++] = point;
        }
    }
    // The same across the place where it is closed.
    std::size_t first = 0;
    while (kept - first >= 3) {
        if (same(loop[first], loop[kept - 2])) {
            kept -= 2;
        } else if (same(loop[first + 1], loop[kept - 1])) {
            ++first;
            --kept;
        } else {
            break;
        }
    }
    loop.resize(kept);
    loop.erase(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first));
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
    Loop found = Loop::none;
    if (oldest >= 0) found = as_2008_ ? loop_of_2008(oldest, newest) : loop(oldest, newest);
    switch (found) {
        case Loop::none:
        case Loop::there_and_back:
            // One that stands exactly where an older one does is never the oldest while that is in the run.
            push(point, oldest < 0 || run(oldest) != point, found == Loop::there_and_back ? oldest : -1);
            return false;
        case Loop::on_a_line:
        case Loop::flat:
            while (static_cast<int>(run_.size()) > oldest) pop();
            push(point, true);
            return found == Loop::flat;
    }
    return false;
}

void PolygonFinder::push(Vec3 point, bool list, int back_at) {
    const int index = static_cast<int>(run_.size());
    Point added;
    added.at = point;
    added.back_at = back_at;
    added.listed = list;
    // Loops may go past what lies in between from now on.
    if (back_at >= 0 && odd_one_ >= back_at) odd_one_ = -1;
    if (!run_.empty()) {
        const Point& last = run_.back();
        const Vec3 begin = run(0);
        added.swept = last.swept + cross(last.at - begin, point - begin);
        added.way = last.way + distance(last.at, point);
    }
    run_.push_back(added);
    if (!list) return;
    CellPoints& cell = cells_[{cell_of(point.x), cell_of(point.y), cell_of(point.z)}];
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

bool PolygonFinder::encloses_something(int oldest, int newest) const {
    const Point& first = run_[static_cast<std::size_t>(oldest)];
    const Point& last = run_[static_cast<std::size_t>(newest)];
    const Vec3 begin = run(0);
    const Vec3 swept = last.swept - first.swept + cross(last.at - begin, first.at - begin);
    // As wide as the tolerance on its whole way round.
    return length(swept) > tolerance * (last.way - first.way + distance(first.at, last.at));
}

int PolygonFinder::before(int i, int oldest) const {
    const int back_at = run_[static_cast<std::size_t>(i)].back_at;
    return (back_at >= oldest ? back_at : i) - 1;
}

void PolygonFinder::gather(int oldest, int newest) {
    polygon_.clear();
    for (int i = newest; i >= oldest; i = before(i, oldest)) polygon_.push_back(run(i));
}

bool PolygonFinder::all_in_plane(int oldest, int i, Vec3 on, Vec3 normal) {
    const auto in_plane = [&](int each) {
        // What is the same point counts as lying in its plane.
        return same(run(each), on) || std::fabs(dot(run(each) - on, normal)) < tolerance;
    };
    if (odd_one_ >= oldest && odd_one_ <= i && !in_plane(odd_one_)) return false;
    bool in_all_loops = true;
    for (; i >= oldest; i = before(i, oldest)) {
        if (!in_plane(i)) {
            if (in_all_loops) odd_one_ = i;
            return false;
        }
        const int back_at = run_[static_cast<std::size_t>(i)].back_at;
        if (back_at >= 0 && back_at < oldest) in_all_loops = false;
    }
    return true;
}

PolygonFinder::Loop PolygonFinder::loop(int oldest, int newest) {
    const Vec3 on = run(newest);
    const int second = before(newest, oldest);
    const int third = second < oldest ? second : before(second, oldest);
    if (third < oldest) return Loop::none;
    const Vec3 along = unit(run(second) - on);
    int aside = third;
    while (aside >= oldest && length(cross(along, run(aside) - on)) <= tolerance)
        aside = before(aside, oldest);
    if (aside < oldest) return Loop::on_a_line;
    if (aside != third && !encloses_something(oldest, newest)) {
        gather(oldest, newest);
        drop_ways_there_and_back(polygon_);
        if (polygon_.size() < 3) return Loop::there_and_back;
    }
    if (!all_in_plane(oldest, aside, on, unit(cross(along, run(aside) - on)))) return Loop::none;
    gather(oldest, newest);
    if (aside != third) drop_ways_there_and_back(polygon_);
    return Loop::flat;
}

PolygonFinder::Loop PolygonFinder::loop_of_2008(int oldest, int newest) {
    if (newest - oldest + 1 < 3) return Loop::none;
    const Vec3 on = run(newest);
    const Vec3 normal = unit_or_zero(cross(run(newest - 1) - on, run(newest - 2) - on));
    if (!all_in_plane(oldest, newest - 3, on, normal)) return Loop::none;
    gather(oldest, newest);
    return Loop::flat;
}

}  // namespace popup::flatlang
