#include "parts/work.h"

#include <algorithm>

namespace popup {
namespace {

bool take(std::size_t& left, std::size_t count) {
    if (count > left) {
        left = 0;
        return false;
    }
    left -= count;
    return true;
}

}  // namespace

bool Work::sweep(std::span<const Ring* const> rings) {
    std::vector<double> heights;
    for (const Ring* ring : rings) {
        for (const Vec2 p : *ring) heights.push_back(p.y);
    }
    // Corners of one height count each: what begins there is sorted in one by one.
    std::sort(heights.begin(), heights.end());
    const auto rank = [&](double y) {
        return static_cast<std::size_t>(std::lower_bound(heights.begin(), heights.end(), y) -
                                        heights.begin());
    };
    std::size_t cost = 0;
    for (const Ring* ring : rings) {
        if (ring->empty()) continue;
        std::size_t before = rank(ring->back().y);
        for (const Vec2 p : *ring) {
            const std::size_t here = rank(p.y);
            cost += 1 + (here > before ? here - before : before - here);
            before = here;
        }
        if (cost > sweeps_left_) break;
    }
    return take(sweeps_left_, cost);
}

bool Work::sweep(const Ring& ring) {
    const Ring* one = &ring;
    return sweep(std::span(&one, 1));
}

bool Work::sweep(const std::vector<Polygon>& regions) {
    std::vector<const Ring*> rings;
    for (const Polygon& region : regions) {
        rings.push_back(&region.outer);
        for (const Ring& hole : region.holes) rings.push_back(&hole);
    }
    return sweep(rings);
}

bool Work::crossings(const EdgeIndex& index, std::span<const Segment> segments) {
    std::vector<int> found;
    for (const Segment& segment : segments) {
        Box box;
        box.extend(segment.a);
        box.extend(segment.b);
        index.query(box, found);
        if (!take(crossings_left_, found.size())) return false;
    }
    return true;
}

bool Work::looks(std::size_t count) { return take(looks_left_, count); }

}  // namespace popup
