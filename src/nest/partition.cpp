#include "nest/partition.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace popup {
namespace {

// A line through two points of the grid: its reduced direction and its offset from the origin along the
// normal.
struct Line {
    GridPoint direction;
    Wide offset;
    friend bool operator<(const Line& a, const Line& b) {
        return std::tie(a.direction, a.offset) < std::tie(b.direction, b.offset);
    }
};

// Directed edges, added up along their lines: where as many run one way as the other, nothing is left.
class Chain {
 public:
    void add(const GridRing& ring, int times) {
        for (std::size_t i = 0; i < ring.size(); ++i) add(ring[i], ring[(i + 1) % ring.size()], times);
    }
    [[nodiscard]] bool is_zero() const {
        return std::all_of(lines_.begin(), lines_.end(), [](const auto& line) {
            return std::all_of(line.second.begin(), line.second.end(),
                               [](const auto& change) { return change.second == 0; });
        });
    }

 private:
    void add(GridPoint a, GridPoint b, int times) {
        if (a == b) return;
        if (b < a) {
            std::swap(a, b);
            times = -times;
        }
        GridPoint direction = b - a;
        const GridLength divisor = std::gcd(direction.x, direction.y);
        direction = {direction.x / divisor, direction.y / divisor};
        std::map<GridPoint, int>& changes = lines_[{direction, cross(direction, a)}];
        changes[a] += times;
        changes[b] -= times;
    }

    std::map<Line, std::map<GridPoint, int>> lines_;
};

}  // namespace

bool make_up(const std::vector<GridRing>& parts, const std::vector<GridRegion>& outline) {
    Chain chain;
    for (const GridRing& part : parts) chain.add(part, 1);
    for (const GridRegion& region : outline) {
        chain.add(region.outer, -1);
        for (const GridRing& hole : region.holes) chain.add(hole, -1);
    }
    return chain.is_zero();
}

std::optional<std::vector<GridRing>> partition(const std::vector<GridRegion>& outline) {
    std::vector<GridRing> parts;
    for (const GridRegion& region : outline) {
        for (GridRing& part : convex_parts(region)) parts.push_back(std::move(part));
    }
    if (!make_up(parts, outline)) return std::nullopt;
    return parts;
}

}  // namespace popup
