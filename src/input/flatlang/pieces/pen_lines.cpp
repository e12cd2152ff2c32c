#include "input/flatlang/pieces/pen_lines.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "input/flatlang/pieces/same_points.h"

namespace popup::flatlang {
namespace {

// A loop's last point is its first to within this, in inches an axis.
constexpr double kSameInch = 1.5e-4;
constexpr double kNoLength = 1e-9;

struct PairHash {
    std::size_t operator()(const std::pair<int, int>& key) const {
        const std::uint64_t both =
            static_cast<std::uint64_t>(key.first) << 32U | static_cast<std::uint32_t>(key.second);
        return static_cast<std::size_t>((both ^ (both >> 31U)) * 0x9E3779B97F4A7C15ULL);
    }
};

// The edges of loops by their ends. What is too short to have two is an edge there as well.
class EdgeTable {
 public:
    // Of edges that are drawn again the first counts.
    void add(Vec3 from, Vec3 to, int face) {
        const int a = points_.of(from);
        const int b = points_.of(to);
        faces_.try_emplace(std::minmax(a, b), face);
    }

    [[nodiscard]] int find(Vec3 from, Vec3 to) const {
        const int a = points_.find(from);
        const int b = points_.find(to);
        const auto found = faces_.find(std::minmax(a, b));
        return found == faces_.end() ? PenLines::kOpen : found->second;
    }

 private:
    SamePoints points_{kSameInch};
    std::unordered_map<std::pair<int, int>, int, PairHash> faces_;
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
