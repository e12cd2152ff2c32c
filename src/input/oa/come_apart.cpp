#include "input/oa/come_apart.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace popup::oa {
namespace {

bool passes_twice(const Ring& ring) {
    std::vector<std::pair<double, double>> corners;
    corners.reserve(ring.size());
    for (const Vec2 p : ring) corners.emplace_back(p.x, p.y);
    std::sort(corners.begin(), corners.end());
    return std::adjacent_find(corners.begin(), corners.end()) != corners.end();
}

// The loops of a ring, each of which passes no corner twice.
std::vector<Ring> loops_of(const Ring& ring) {
    std::vector<Ring> loops;
    Ring open;                                            // what has been passed and is in no loop yet
    std::map<std::pair<double, double>, std::size_t> at;  // where a corner stands in it
    for (const Vec2 p : ring) {
        const auto [found, fresh] = at.try_emplace({p.x, p.y}, open.size());
        if (!fresh) {
            const std::size_t from = found->second;
            loops.emplace_back(open.begin() + static_cast<std::ptrdiff_t>(from), open.end());
            for (std::size_t i = from + 1; i < open.size(); ++i) at.erase({open[i].x, open[i].y});
            open.resize(from);
        }
        open.push_back(p);
    }
    loops.push_back(std::move(open));
    std::erase_if(loops, [](const Ring& loop) { return loop.size() < 3 || signed_area(loop) == 0.0; });
    return loops;
}

}  // namespace

std::vector<Polygon> come_apart(std::vector<Polygon> regions) {
    std::vector<Polygon> result;
    for (Polygon& region : regions) {
        const bool any =
            passes_twice(region.outer) || std::any_of(region.holes.begin(), region.holes.end(), passes_twice);
        if (!any) {
            result.push_back(std::move(region));
            continue;
        }
        std::vector<Polygon> parts;
        std::vector<Ring> holes;
        const auto sort_out = [&](Ring loop) {
            if (signed_area(loop) > 0.0) {
                parts.push_back({std::move(loop), {}});
            } else {
                holes.push_back(std::move(loop));
            }
        };
        for (Ring& loop : loops_of(region.outer)) sort_out(std::move(loop));
        for (const Ring& hole : region.holes) {
            for (Ring& loop : loops_of(hole)) sort_out(std::move(loop));
        }
        // A hole lies in the smallest part that holds a point of its inside.
        for (Ring& hole : holes) {
            Ring turned(hole.rbegin(), hole.rend());
            const Vec2 inside = inner_point({std::move(turned), {}}, 1e-3).at;
            Polygon* best = nullptr;
            for (Polygon& part : parts) {
                if (!contains({part.outer, {}}, inside)) continue;
                if (best == nullptr || signed_area(part.outer) < signed_area(best->outer)) best = &part;
            }
            if (best != nullptr) best->holes.push_back(std::move(hole));
        }
        for (Polygon& part : parts) result.push_back(std::move(part));
    }
    return result;
}

}  // namespace popup::oa
