#include "fabrication/glue_marks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "popup/diagnostics.h"

namespace popup {
namespace {

constexpr double kCornerTickMm = 1.5;
constexpr double kTickInsideMm = 0.25;
constexpr double kDashEveryMm = 6.0;
// Where an outline turns by less, it goes on.
constexpr double kCornerRad = 20.0 * std::numbers::pi / 180.0;

Vec2 unit(Vec2 from, Vec2 to) { return (1.0 / distance(from, to)) * (to - from); }

// Counter-clockwise, without doubled points.
Ring cleaned(const Ring& outline) {
    constexpr double kSame = 1e-6;
    Ring ring;
    for (const Vec2 p : outline) {
        if (ring.empty() || distance(ring.back(), p) > kSame) ring.push_back(p);
    }
    while (ring.size() > 1 && distance(ring.back(), ring.front()) <= kSame) ring.pop_back();
    if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
    return ring;
}

// Lines along the outline, which lies to their left.
std::vector<std::vector<Vec2>> dashes_along(const Ring& ring) {
    std::vector<std::vector<Vec2>> dashes;
    double left = 0.5 * kDashEveryMm;  // until the middle of the next dash
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i];
        const Vec2 b = ring[(i + 1) % ring.size()];
        const double whole = distance(a, b);
        const Vec2 along = unit(a, b);
        const Vec2 inward = kTickInsideMm * Vec2{-along.y, along.x};
        for (; left < whole; left += kDashEveryMm) {
            const double from = std::max(left - 0.5 * kCornerTickMm, 0.0);
            const double to = std::min(left + 0.5 * kCornerTickMm, whole);
            dashes.push_back({a + from * along + inward, a + to * along + inward});
        }
        left -= whole;
    }
    return dashes;
}

// A corner of the outline moved inwards; where it is sharp no further than the tick is long.
Vec2 moved_in(const Ring& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const Vec2 in = unit(ring[(i + n - 1) % n], ring[i]);
    const Vec2 out = unit(ring[i], ring[(i + 1) % n]);
    const double meet = std::max(1.0 + dot(in, out), 0.3);
    return ring[i] + (kTickInsideMm / meet) * (Vec2{-in.y, in.x} + Vec2{-out.y, out.x});
}

double turn_at(const Ring& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const Vec2 in = unit(ring[(i + n - 1) % n], ring[i]);
    const Vec2 out = unit(ring[i], ring[(i + 1) % n]);
    return std::atan2(cross(in, out), dot(in, out));
}

// From a corner along the outline, chord by chord where that is a curve: a tick's length, or a third of the
// way to the next corner. `step`: 1 or n - 1.
std::vector<Vec2> arm(const Ring& ring, const std::vector<bool>& corner, std::size_t i, std::size_t step) {
    const std::size_t n = ring.size();
    double whole = 0.0;
    for (std::size_t k = i; whole < 3.0 * kCornerTickMm;) {
        const std::size_t next = (k + step) % n;
        whole += distance(ring[k], ring[next]);
        k = next;
        if (corner[k]) break;
    }
    double left = std::min(kCornerTickMm, whole / 3.0);
    std::vector<Vec2> points;
    Vec2 at = moved_in(ring, i);
    for (std::size_t k = i; left > 0.0;) {
        const std::size_t next = (k + step) % n;
        const double size = distance(ring[k], ring[next]);
        at = size > left ? at + left * unit(ring[k], ring[next]) : moved_in(ring, next);
        points.push_back(at);
        left -= size;
        k = next;
    }
    return points;
}

}  // namespace

std::vector<std::vector<Vec2>> target_ticks(const Ring& outline) {
    const Ring ring = cleaned(outline);
    const std::size_t n = ring.size();
    if (n < 3) return {};
    std::vector<bool> corner(n);
    for (std::size_t i = 0; i < n; ++i) corner[i] = std::abs(turn_at(ring, i)) >= kCornerRad;
    std::vector<std::vector<Vec2>> ticks;
    for (std::size_t i = 0; i < n; ++i) {
        if (!corner[i]) continue;
        std::vector<Vec2> tick = arm(ring, corner, i, n - 1);
        std::reverse(tick.begin(), tick.end());
        tick.push_back(moved_in(ring, i));
        for (const Vec2 p : arm(ring, corner, i, 1)) tick.push_back(p);
        ticks.push_back(std::move(tick));
    }
    return ticks.size() < 3 ? dashes_along(ring) : ticks;
}

bool marks_joints(MarksOn where, ScoreSide side, bool back) {
    switch (where) {
        case MarksOn::front:
            return !back;
        case MarksOn::back:
            return back;
        case MarksOn::hidden:
            return back == (side == ScoreSide::back);
        case MarksOn::none:
            return false;
    }
    broken_invariant("where marks are is one of its enumerators", __FILE__, __LINE__);
}

bool marks_names(MarksOn where, ScoreSide side, bool back) {
    if (where == MarksOn::hidden) return back && side != ScoreSide::front;
    return marks_joints(where, side, back);
}

bool marks_covered_backs(MarksOn where, ScoreSide side, bool back) {
    return where == MarksOn::hidden && back && side != ScoreSide::back;
}

}  // namespace popup
