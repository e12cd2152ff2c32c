#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/geometry/tolerances.h"
#include "base/geometry/triangulate.h"

namespace popup {
namespace {

// A run of corners on one side of the line, and where along the line it comes from it and goes back to it.
struct Chain {
    Ring corners;
    double from = 0.0, to = 0.0;
};

struct End {
    double at;
    std::size_t chain;
    bool comes;  // it is where the chain comes from the line
};

// What lies on one side of the line.
struct Side {
    std::vector<Chain> chains;
    std::vector<Ring> outers, holes;  // that the line does not cut
};

// Across the line, and along it: turned so that what lies before the line is on the left of one who goes
// along it.
struct Axes {
    bool upright;
    [[nodiscard]] double across(Vec2 p) const { return upright ? p.x : -p.y; }
    [[nodiscard]] double along(Vec2 p) const { return upright ? p.y : p.x; }
    [[nodiscard]] Vec2 point(double across, double along) const {
        return upright ? Vec2{across, along} : Vec2{along, -across};
    }
};

// Half of the corners lie to either side of it, and all of them further off than the grid.
std::optional<double> middle(const Polygon& polygon, const Axes& axes) {
    std::vector<double> values;
    for (const Vec2 p : polygon.outer) values.push_back(axes.across(p));
    for (const Ring& hole : polygon.holes) {
        for (const Vec2 p : hole) values.push_back(axes.across(p));
    }
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    double next = HUGE_VAL;
    for (auto one = half; one != values.end(); ++one) {
        if (*one > *half) next = std::min(next, *one);
    }
    if (!(next - *half > 4.0 * kGridMm) || std::isinf(next)) return std::nullopt;
    return std::round(0.5 * (*half + next) / kGridMm) * kGridMm;
}

// Deals out a ring, which runs as the polygon's rings do, to both sides.
void deal(const Ring& ring, bool outer, const Axes& axes, double line, Side& before, Side& beyond) {
    const std::size_t n = ring.size();
    const auto is_beyond = [&](std::size_t i) { return axes.across(ring[i % n]) > line; };
    std::size_t first = 0;  // the first corner after the line
    while (first < n && is_beyond(first) == is_beyond(first + n - 1)) ++first;
    if (first == n) {
        Side& side = is_beyond(0) ? beyond : before;
        (outer ? side.outers : side.holes).push_back(ring);
        return;
    }
    const auto crossing = [&](std::size_t i) {
        const Vec2 p = ring[i % n];
        const Vec2 q = ring[(i + 1) % n];
        const double share = (line - axes.across(p)) / (axes.across(q) - axes.across(p));
        return std::lerp(axes.along(p), axes.along(q), share);
    };
    for (std::size_t i = first; i < first + n;) {
        Chain chain;
        chain.from = crossing(i + n - 1);
        const bool side = is_beyond(i);
        for (; i < first + n && is_beyond(i) == side; ++i) chain.corners.push_back(ring[i % n]);
        chain.to = crossing(i + n - 1);
        (side ? beyond : before).chains.push_back(std::move(chain));
    }
}

// Joins the chains of a side along the line. False: they do not take turns there.
bool join(const Side& side, bool beyond, const Axes& axes, double line, std::vector<Polygon>& parts) {
    std::vector<End> ends;
    for (std::size_t i = 0; i < side.chains.size(); ++i) {
        ends.push_back({side.chains[i].from, i, true});
        ends.push_back({side.chains[i].to, i, false});
    }
    // In the order in which one goes who has the part on the left.
    std::sort(ends.begin(), ends.end(),
              [beyond](const End& a, const End& b) { return beyond ? a.at > b.at : a.at < b.at; });
    std::vector<std::size_t> next(side.chains.size());
    for (std::size_t i = 0; i < ends.size(); i += 2) {
        const bool last = i + 2 == ends.size();
        if (ends[i].comes || !ends[i + 1].comes || std::abs(ends[i + 1].at - ends[i].at) <= 2.0 * kGridMm ||
            (!last && std::abs(ends[i + 2].at - ends[i + 1].at) <= 2.0 * kGridMm))
            return false;
        next[ends[i].chain] = ends[i + 1].chain;
    }
    const auto on_line = [&](double along) {
        return axes.point(line, std::round(along / kGridMm) * kGridMm);
    };
    std::vector<char> used(side.chains.size(), 0);
    for (std::size_t i = 0; i < side.chains.size(); ++i) {
        if (used[i] != 0) continue;
        Ring ring;
        for (std::size_t at = i; used[at] == 0; at = next[at]) {
            used[at] = 1;
            const Chain& chain = side.chains[at];
            ring.push_back(on_line(chain.from));
            ring.insert(ring.end(), chain.corners.begin(), chain.corners.end());
            ring.push_back(on_line(chain.to));
        }
        if (signed_area(ring) <= 0.0) return false;
        parts.push_back({std::move(ring), {}});
    }
    for (const Ring& ring : side.outers) parts.push_back({ring, {}});
    return true;
}

// Gives each hole to the part around it. False: none is, or it touches its edge with all corners.
bool give_holes(std::vector<Ring> holes, std::vector<Polygon>& parts, std::size_t first) {
    std::vector<Box> boxes;
    for (std::size_t i = first; i < parts.size(); ++i) boxes.push_back(bounds(parts[i].outer));
    for (Ring& hole : holes) {
        const Box box = bounds(hole);
        std::size_t found = boxes.size() == 1 ? 0 : boxes.size();
        for (std::size_t i = 0; i < boxes.size() && found == boxes.size(); ++i) {
            const Box& round = boxes[i];
            if (box.min.x >= round.min.x && box.min.y >= round.min.y && box.max.x <= round.max.x &&
                box.max.y <= round.max.y && std::all_of(hole.begin(), hole.end(), [&](Vec2 p) {
                    return contains({parts[first + i].outer, {}}, p);
                }))
                found = i;
        }
        if (found == boxes.size()) return false;
        parts[first + found].holes.push_back(std::move(hole));
    }
    return true;
}

}  // namespace

std::vector<Polygon> slice(const Polygon& polygon, bool upright) {
    const Axes axes{upright};
    const std::optional<double> line = middle(polygon, axes);
    if (!line) return {};
    Side before;
    Side beyond;
    const auto dealt = [&](Ring ring, bool outer) {
        if (ring.size() < 3) return;
        if ((signed_area(ring) > 0.0) != outer) std::reverse(ring.begin(), ring.end());
        deal(ring, outer, axes, *line, before, beyond);
    };
    dealt(polygon.outer, true);
    for (const Ring& hole : polygon.holes) dealt(hole, false);
    std::vector<Polygon> parts;
    for (Side* side : {&before, &beyond}) {
        const std::size_t first = parts.size();
        if (!join(*side, side == &beyond, axes, *line, parts) ||
            !give_holes(std::move(side->holes), parts, first))
            return {};
    }
    return parts;
}

}  // namespace popup
