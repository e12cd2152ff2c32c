#include "input/origamic/folds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "base/geometry/tolerances.h"

namespace popup::origamic {
namespace {

// An edge along the gutter, and whose it is.
struct Border {
    double y0, y1;
    int region;
};

// The edges at one x: of what ends there from above, and of what begins there.
struct Meeting {
    std::vector<Border> above, below;
};

void collect(const Ring& ring, int region, std::map<double, Meeting>& meetings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i];
        const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (a.x != b.x || a.y == b.y) continue;
        // The area is on the left: on the side of the back where the edge goes up.
        Meeting& at = meetings[a.x];
        (b.y > a.y ? at.above : at.below).push_back({std::min(a.y, b.y), std::max(a.y, b.y), region});
    }
}

// The x at which the planes of two regions meet, if their border at x lies there. Rounding may have put the
// border one step of the grid beside it; the fold must stand in line with the others of the two.
std::optional<double> meet_in_space(const Region& above, const Region& below, double x) {
    if (above.upright == below.upright) return std::nullopt;
    const double depth = above.upright ? above.offset : below.offset;
    const double height = above.upright ? below.offset : above.offset;
    const double off = std::abs(depth - height - x);
    if (off >= 1.5 * kGridMm) return std::nullopt;
    return off < 0.75 * kGridMm ? x : depth - height;
}

std::size_t at(int number) { return static_cast<std::size_t>(number); }

}  // namespace

std::vector<Fold> folds_between(const std::vector<Region>& regions) {
    std::map<double, Meeting> meetings;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        collect(regions[i].area.outer, static_cast<int>(i), meetings);
        for (const Ring& hole : regions[i].area.holes) collect(hole, static_cast<int>(i), meetings);
    }
    std::vector<Fold> folds;
    const auto by_place = [](const Border& a, const Border& b) {
        return std::pair(a.y0, a.region) < std::pair(b.y0, b.region);
    };
    for (auto& [x, meeting] : meetings) {
        std::sort(meeting.above.begin(), meeting.above.end(), by_place);
        std::sort(meeting.below.begin(), meeting.below.end(), by_place);
        std::size_t first = 0;
        for (const Border& above : meeting.above) {
            // Regions do not overlap, so what ends before this one begins meets none of the next either.
            while (first < meeting.below.size() && meeting.below[first].y1 <= above.y0) ++first;
            for (std::size_t i = first; i < meeting.below.size() && meeting.below[i].y0 < above.y1; ++i) {
                const Border& below = meeting.below[i];
                const double y0 = std::max(above.y0, below.y0);
                const double y1 = std::min(above.y1, below.y1);
                const Region& upper = regions[at(above.region)];
                if (y1 - y0 < kTouchMm) continue;
                const auto fold_x = meet_in_space(upper, regions[at(below.region)], x);
                if (fold_x) folds.push_back({above.region, below.region, *fold_x, y0, y1, upper.upright});
            }
        }
    }
    return folds;
}

Holding holding(const std::vector<Region>& regions, const std::vector<Fold>& folds) {
    Holding result;
    result.held.assign(regions.size(), false);
    std::vector<double> gutter(regions.size());
    std::vector<std::vector<int>> of(regions.size());
    for (std::size_t i = 0; i < folds.size(); ++i) {
        const Fold& fold = folds[i];
        for (const int region : {fold.above, fold.below}) {
            of[at(region)].push_back(static_cast<int>(i));
            if (fold.x == 0.0) gutter[at(region)] += fold.y1 - fold.y0;
        }
    }
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (!regions[i].of_cover) continue;
        int& cover = regions[i].upright ? result.back : result.floor;
        const auto weight = [&](std::size_t region) {
            return std::pair(gutter[region], area(regions[region].area));
        };
        if (cover < 0 || weight(i) > weight(at(cover))) cover = static_cast<int>(i);
    }
    if (result.back < 0 || result.floor < 0) return result;
    for (const int cover : {result.back, result.floor}) {
        result.order.push_back({cover, -1});
        result.held[at(cover)] = true;
    }
    for (std::size_t next = 0; next < result.order.size(); ++next) {
        const int from = result.order[next].region;
        for (const int fold : of[at(from)]) {
            const int to = folds[at(fold)].above == from ? folds[at(fold)].below : folds[at(fold)].above;
            if (result.held[at(to)]) continue;
            result.held[at(to)] = true;
            result.order.push_back({to, fold});
        }
    }
    return result;
}

}  // namespace popup::origamic
