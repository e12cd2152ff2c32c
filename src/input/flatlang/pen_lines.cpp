#include "input/flatlang/pen_lines.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace popup::flatlang {
namespace {

// A loop's last point is its first to within this, in inches an axis.
constexpr double kSameInch = 1.5e-4;
constexpr double kCell = 0.002;
// Off the numbers that people write, so that few points stand near the side of a cell.
constexpr double kShift = 0.00077;
constexpr double kNoLength = 1e-9;

using Cell = std::array<std::int64_t, 3>;

struct PairHash {
    std::size_t operator()(const std::pair<Cell, Cell>& key) const {
        std::uint64_t h = 0;
        for (const Cell& cell : {key.first, key.second}) {
            for (const std::int64_t one : cell) {
                h = (h ^ (h >> 29U)) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(one);
            }
        }
        return static_cast<std::size_t>((h ^ (h >> 31U)) * 0xBF58476D1CE4E5B9ULL);
    }
};

std::int64_t cell_of(double x) { return static_cast<std::int64_t>(std::floor((x + kShift) / kCell)); }
Cell cell_of(Vec3 p) { return {cell_of(p.x), cell_of(p.y), cell_of(p.z)}; }

// The cells that points within kSameInch of p may be in: mostly one.
std::vector<Cell> cells_near(Vec3 p) {
    std::vector<Cell> cells{cell_of(p)};
    const std::array<double, 3> place{p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t low = cell_of(place.at(k) - kSameInch);
        const std::int64_t high = cell_of(place.at(k) + kSameInch);
        if (low == high) continue;
        const std::size_t count = cells.size();
        for (std::size_t i = 0; i < count; ++i) {
            Cell other = cells[i];
            other.at(k) = other.at(k) == low ? high : low;
            cells.push_back(other);
        }
    }
    return cells;
}

bool same(Vec3 p, Vec3 q) {
    return std::abs(p.x - q.x) <= kSameInch && std::abs(p.y - q.y) <= kSameInch &&
           std::abs(p.z - q.z) <= kSameInch;
}

class EdgeTable {
 public:
    void add(Vec3 from, Vec3 to, int face) {
        const Edge edge{from, to, face};
        auto& bucket = table_[{cell_of(from), cell_of(to)}];
        // Loops are drawn again and again at one place.
        constexpr std::size_t kMost = 64;
        for (const Edge& one : bucket) {
            if (one.from == from && one.to == to) return;
        }
        if (bucket.size() < kMost) bucket.push_back(edge);
    }

    [[nodiscard]] int find(Vec3 from, Vec3 to) const {
        const std::vector<Cell> ends = cells_near(to);
        for (const Cell& a : cells_near(from)) {
            for (const Cell& b : ends) {
                for (const auto& key : {std::pair(a, b), std::pair(b, a)}) {
                    const auto bucket = table_.find(key);
                    if (bucket == table_.end()) continue;
                    for (const Edge& one : bucket->second) {
                        if ((same(one.from, from) && same(one.to, to)) ||
                            (same(one.from, to) && same(one.to, from))) {
                            return one.face;
                        }
                    }
                }
            }
        }
        return PenLines::kOpen;
    }

 private:
    struct Edge {
        Vec3 from, to;
        int face;
    };
    std::unordered_map<std::pair<Cell, Cell>, std::vector<Edge>, PairHash> table_;
};

}  // namespace

PenLines sort_segments(const Trail& trail, const Outlines& outlines) {
    EdgeTable table;
    for (std::size_t i = 0; i < trail.polygons.size(); ++i) {
        const int face = outlines.polygon_face[i];
        if (face < 0) continue;
        const std::vector<Vec3>& points = trail.polygons[i].points;
        for (std::size_t j = 0; j < points.size(); ++j) {
            table.add(points[j], points[j + 1 == points.size() ? 0 : j + 1], face);
        }
    }
    PenLines lines;
    lines.face.reserve(trail.segments.size());
    for (const TrailSegment& one : trail.segments) {
        lines.face.push_back(table.find(one.from, one.to));
        const double span = distance(one.from, one.to);
        if (lines.face.back() != PenLines::kOpen || span <= kNoLength) continue;
        ++lines.open;
        lines.open_inches += span;
    }
    return lines;
}

std::vector<std::vector<Vec3>> chained(const Trail& trail, const std::vector<std::size_t>& numbers) {
    std::vector<std::vector<Vec3>> lines;
    Vec3 last;
    bool open = false;
    for (const std::size_t i : numbers) {
        const TrailSegment& one = trail.segments[i];
        if (distance(one.from, one.to) <= kNoLength) continue;
        if (!open || !(one.from == last)) lines.push_back({kMmPerInch * one.from});
        lines.back().push_back(kMmPerInch * one.to);
        last = one.to;
        open = true;
    }
    return lines;
}

}  // namespace popup::flatlang
