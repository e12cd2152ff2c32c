#include "output/arcs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace popup {
namespace {

constexpr double kArcMm = 1e-3;
// A flatter arc is told from a line by no one.
constexpr double kLargestRadius = 1e6;
// Half a turn, and what rounding adds.
constexpr double kMostTurn = std::numbers::pi + 1e-3;
// Arcs drawn in more parts than this remain several.
constexpr std::size_t kMostParts = 16;

struct Circle {
    Vec2 centre;
    double radius = 0.0;
};

std::optional<Circle> circle_through(Vec2 a, Vec2 b, Vec2 c) {
    const Vec2 p = b - a;
    const Vec2 q = c - a;
    const double twice = 2.0 * cross(p, q);
    if (twice == 0.0) return std::nullopt;
    const Vec2 away{(q.y * dot(p, p) - p.y * dot(q, q)) / twice, (p.x * dot(q, q) - q.x * dot(p, p)) / twice};
    const double radius = length(away);
    if (!(radius <= kLargestRadius)) return std::nullopt;
    return Circle{a + away, radius};
}

// The arc through points that a curve, or several, pass in this order; nullopt when there is none, or it is
// more than half a turn.
std::optional<double> bulge_of(const std::vector<Vec2>& points) {
    const Vec2 from = points.front();
    const Vec2 middle = points[points.size() / 2];
    const Vec2 to = points.back();
    const auto circle = circle_through(from, middle, to);
    if (!circle) return std::nullopt;
    const bool left = cross(middle - from, to - middle) > 0.0;
    Vec2 before = from - circle->centre;
    double turned = 0.0;
    for (const Vec2 p : points) {
        const Vec2 now = p - circle->centre;
        if (std::abs(length(now) - circle->radius) > kArcMm) return std::nullopt;
        const double step = std::atan2(cross(before, now), dot(before, now));
        if ((left ? step : -step) < -1e-9) return std::nullopt;  // it turns back
        turned += step;
        before = now;
    }
    if (std::abs(turned) > kMostTurn) return std::nullopt;
    return std::tan(0.25 * turned);
}

void add_samples(const Cubic& curve, std::vector<Vec2>& points) {
    constexpr int kSamples = 8;
    for (int i = 1; i <= kSamples; ++i) points.push_back(curve.at(static_cast<double>(i) / kSamples));
}

}  // namespace

std::optional<std::vector<ArcCorner>> as_arcs(const Subpath& path) {
    std::vector<ArcCorner> corners{{path.start, 0.0}};
    std::vector<Vec2> arc;  // points of the curves that are one arc so far
    std::size_t parts = 0;
    Vec2 at = path.start;
    const auto add = [&](Vec2 to, double bulge) {
        corners.back().bulge = bulge;
        corners.push_back({to, 0.0});
    };
    for (const PathStep& step : path.steps) {
        if (!step.curve) {
            parts = 0;
            add(step.to, 0.0);
            at = step.to;
            continue;
        }
        const Cubic curve{at, step.control_1, step.control_2, step.to};
        at = step.to;
        if (parts > 0 && parts < kMostParts) {
            const std::size_t before = arc.size();
            add_samples(curve, arc);
            if (const auto bulge = bulge_of(arc)) {
                corners.pop_back();
                add(step.to, *bulge);
                ++parts;
                continue;
            }
            arc.resize(before);
        }
        arc = {curve.from};
        add_samples(curve, arc);
        const auto bulge = bulge_of(arc);
        if (!bulge) return std::nullopt;
        add(step.to, *bulge);
        parts = 1;
    }
    if (path.closed && corners.size() > 1 && corners.back().at == path.start) corners.pop_back();
    return corners;
}

}  // namespace popup
