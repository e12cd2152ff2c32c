#include "edit/drawn_feet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace popup::edit {
namespace {

// What is straight for at least this share of the drawing is an edge that it can stand on.
constexpr double kBaseShare = 0.2;
// A drawing that is round below is cut where it is so wide, and no higher up than that.
constexpr double kCutWidthShare = 0.5;
constexpr double kCutHeightShare = 0.25;
// Feet of a V may lie so much higher than each other, in shares of what is between them.
constexpr double kSlope = 0.1;
constexpr int kLevels = 100;       // that are looked at
constexpr int kPartsOfCurve = 64;  // that are looked at for a crossing

Vec2 at(const DrawnStep& step, double t) {
    return step.curve ? step.line.at(t) : lerp(step.line.from, step.line.to, t);
}

// Grows a straight line step by step: all points stay within a width of the ray through the last one. Steps
// that each go on nearly straight may bend a long way together, so it is the whole that is looked at.
class Straight {
 public:
    Straight(Vec2 from, double within) : from_(from), within_(within) {}

    // Whether it goes on to p; then it does.
    bool take(Vec2 p) {
        const Vec2 way = p - from_;
        const double far = length(way);
        if (far < furthest_ || far == 0.0) return far == furthest_;
        if (furthest_ == 0.0) along_ = unit(way);
        // The directions in which the ray passes the point nearly enough.
        const double at = std::atan2(cross(along_, way), dot(along_, way));
        const double half = std::asin(std::min(1.0, within_ / far));
        if (at < low_ || at > high_) return false;
        low_ = std::max(low_, at - half);
        high_ = std::min(high_, at + half);
        furthest_ = far;
        return true;
    }

 private:
    Vec2 from_, along_;
    double within_, furthest_ = 0.0;
    double low_ = -0.25 * std::numbers::pi, high_ = 0.25 * std::numbers::pi;
};

// A run of lines that are one straight line: its first and last step.
struct Run {
    std::size_t first = 0, last = 0;
};

std::vector<Run> straight_runs(const DrawnOutline& outline, double within) {
    std::vector<Run> runs;
    std::optional<Straight> line;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        if (outline[i].curve) {
            line.reset();
            continue;
        }
        if (line && line->take(outline[i].line.to)) {
            runs.back().last = i;
            continue;
        }
        line.emplace(outline[i].line.from, within);
        line->take(outline[i].line.to);
        runs.push_back({i, i});
    }
    // The outline may begin in the middle of a line.
    if (runs.size() < 2 || runs.front().first != 0 || runs.back().last + 1 != outline.size()) return runs;
    Straight joined(outline[runs.back().first].line.from, within);
    bool straight = true;
    for (std::size_t i = runs.back().first; straight && i <= runs.back().last; ++i)
        straight = joined.take(outline[i].line.to);
    for (std::size_t i = 0; straight && i <= runs.front().last; ++i)
        straight = joined.take(outline[i].line.to);
    if (!straight) return runs;
    runs.front().first = runs.back().first;
    runs.pop_back();
    return runs;
}

// Where the outline crosses a level: furthest left going down, and furthest right going up.
std::optional<Foot> crossed_at(const DrawnOutline& outline, double level) {
    Foot made;
    made.begin.at.x = HUGE_VAL;
    made.end.at.x = -HUGE_VAL;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const int parts = outline[i].curve ? kPartsOfCurve : 1;
        for (int k = 0; k < parts; ++k) {
            double above = static_cast<double>(k) / parts;
            double below = static_cast<double>(k + 1) / parts;
            const bool down = at(outline[i], above).y > level;
            if (down == (at(outline[i], below).y > level)) continue;
            if (!down) std::swap(above, below);
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = 0.5 * (above + below);
                (at(outline[i], middle).y > level ? above : below) = middle;
            }
            const OutlineMark mark{i, below, at(outline[i], below)};
            if (down && mark.at.x < made.begin.at.x) made.begin = mark;
            if (!down && mark.at.x > made.end.at.x) made.end = mark;
        }
    }
    if (made.end.at.x <= made.begin.at.x) return std::nullopt;
    return made;
}

}  // namespace

DrawnOutline outline_of(const Subpath& line) {
    DrawnOutline made;
    Vec2 at = line.start;
    const auto add = [&](const PathStep& step) {
        if (step.to == at && !step.curve) return;
        made.push_back({{at, step.control_1, step.control_2, step.to}, step.curve});
        at = step.to;
    };
    for (const PathStep& step : line.steps) add(step);
    add({line.start, false, {}, {}});
    return made;
}

DrawnOutline reversed(const DrawnOutline& outline) {
    DrawnOutline made;
    for (auto step = outline.rbegin(); step != outline.rend(); ++step)
        made.push_back(
            {{step->line.to, step->line.control_2, step->line.control_1, step->line.from}, step->curve});
    return made;
}

Box box_of(const DrawnOutline& outline) {
    Box box;
    for (const DrawnStep& step : outline) {
        const Cubic& c = step.line;
        box.extend(c.from);
        box.extend(c.to);
        if (!step.curve) continue;
        // Where it turns back: its derivative is 0 in x or in y.
        for (const auto axis : {&Vec2::x, &Vec2::y}) {
            const double a = c.control_1.*axis - c.from.*axis;
            const double b = c.control_2.*axis - c.control_1.*axis;
            const double d = c.to.*axis - c.control_2.*axis;
            const double root =
                (b - a) * (b - a) - a * (a - 2.0 * b + d);  // of (a − 2b + d) t² + 2(b − a) t + a
            if (root < 0.0) continue;
            // Both without a difference of what is nearly equal.
            const double q = (a - b) + std::copysign(std::sqrt(root), a - b);
            for (const double t : {q / (a - 2.0 * b + d), a / q}) {
                if (t > 0.0 && t < 1.0) box.extend(c.at(t));
            }
        }
    }
    return box;
}

double area_of(const DrawnOutline& outline) {
    Ring ring;
    for (const DrawnStep& step : outline) {
        const int parts = step.curve ? kPartsOfCurve : 1;
        for (int k = 0; k < parts; ++k) ring.push_back(at(step, static_cast<double>(k) / parts));
    }
    return signed_area(ring);
}

DrawnOutline mapped(const DrawnOutline& outline, const std::function<Vec2(Vec2)>& map) {
    DrawnOutline made = outline;
    for (DrawnStep& step : made)
        for (Vec2* p : {&step.line.from, &step.line.control_1, &step.line.control_2, &step.line.to})
            *p = map(*p);
    return made;
}

PlaneMap onto(Vec2 a, Vec2 b, Vec2 p, Vec2 q, double scale) {
    const double turn = std::atan2(cross(b - a, q - p), dot(b - a, q - p));
    PlaneMap map;
    map.x = scale * rotated({1.0, 0.0}, turn);
    map.y = left_of(map.x);
    map.origin = 0.5 * (p + q) - map(0.5 * (a + b));
    return map;
}

std::optional<Foot> corner_of(const DrawnOutline& outline, const Box& box, std::span<const Vec2> chain,
                              double within) {
    if (chain.size() != 3) return std::nullopt;
    const std::vector<Run> runs = straight_runs(outline, within);
    const std::size_t count = outline.size();
    std::optional<Foot> best;
    double best_off = kMeantMm;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const auto& [first, last] = runs[k];
        const auto& [next, end] = runs[(k + 1) % runs.size()];
        if ((last + 1) % count != next || runs.size() < 2) continue;
        const Vec2 g = outline[first].line.from;
        const Vec2 e = outline[next].line.from;
        const Vec2 h = outline[end].line.to;
        if (distance(g, h) < kBaseShare * box.width() || distance(g, h) == 0.0) continue;
        const PlaneMap map =
            onto(g, h, chain.front(), chain.back(), distance(chain.front(), chain.back()) / distance(g, h));
        double off = distance(map(e), chain[1]);
        const bool wide_v = e.y <= box.min.y + kEdgeShare * box.height() && g.y > e.y && h.y > e.y &&
                            std::max(g.y, h.y) <= box.min.y + kCutHeightShare * box.height() &&
                            h.x - g.x >= kCutWidthShare * box.width() &&
                            std::abs(h.y - g.y) <= kSlope * (h.x - g.x);
        if (wide_v) off = std::min(off, kMeantMm);
        if (off > best_off) continue;
        best_off = off;
        best = Foot{{first, 0.0, g}, {end, 1.0, h}};
    }
    return best;
}

std::optional<Foot> base_of(const DrawnOutline& outline, const Box& box, double within) {
    const double level = box.min.y + within;
    const auto low = [&](const DrawnStep& step) {
        const Cubic& c = step.line;
        return c.from.y <= level && c.to.y <= level &&
               (!step.curve || (c.control_1.y <= level && c.control_2.y <= level));
    };
    Foot made;
    made.begin.at.x = HUGE_VAL;
    made.end.at.x = -HUGE_VAL;
    double long_mm = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        if (!low(outline[i])) continue;
        const Cubic& c = outline[i].line;
        long_mm += c.to.x - c.from.x;
        if (c.from.x < made.begin.at.x) made.begin = {i, 0.0, c.from};
        if (c.to.x > made.end.at.x) made.end = {i, 1.0, c.to};
    }
    if (long_mm < kBaseShare * box.width() || made.end.at.x <= made.begin.at.x) return std::nullopt;
    return made;
}

DrawnOutline between(const DrawnOutline& outline, const OutlineMark& from, const OutlineMark& to) {
    DrawnOutline made;
    const auto add = [&](std::size_t i, double t0, double t1) {
        const DrawnStep& step = outline[i];
        if (t1 <= t0) return;
        if (step.curve) {
            made.push_back({t0 == 0.0 && t1 == 1.0 ? step.line : step.line.part(t0, t1), true});
        } else {
            made.push_back({{at(step, t0), {}, {}, at(step, t1)}, false});
        }
    };
    if (from.step == to.step && from.t < to.t) {
        add(from.step, from.t, to.t);
        return made;
    }
    add(from.step, from.t, 1.0);
    for (std::size_t i = (from.step + 1) % outline.size(); i != to.step; i = (i + 1) % outline.size())
        add(i, 0.0, 1.0);
    add(to.step, 0.0, to.t);
    return made;
}

std::pair<double, double> strays(const DrawnOutline& outline, const Foot& foot) {
    const Vec2 along = unit(foot.end.at - foot.begin.at);
    double above = 0.0;
    double below = 0.0;
    for (const DrawnStep& step : between(outline, foot.begin, foot.end)) {
        const int parts = step.curve ? kPartsOfCurve : 1;
        for (int k = 1; k <= parts; ++k) {
            const double off = cross(along, at(step, static_cast<double>(k) / parts) - foot.begin.at);
            above = std::max(above, off);
            below = std::max(below, -off);
        }
    }
    return {above, below};
}

std::optional<Foot> cut_of(const DrawnOutline& outline, const Box& box) {
    std::optional<Foot> lowest;
    for (int k = 1; k <= kLevels; ++k) {
        const double level = box.min.y + kCutHeightShare * box.height() * k / kLevels;
        const auto foot = crossed_at(outline, level);
        if (!foot || foot->end.at.x - foot->begin.at.x < kCutWidthShare * box.width()) continue;
        if (strays(outline, *foot).first <= kEdgeShare * box.height()) return foot;
        if (!lowest) lowest = foot;
    }
    return lowest;
}

std::optional<Foot> left_edge(const DrawnOutline& outline, double within) {
    // Turned by a quarter the left end is the lower one.
    const DrawnOutline turned = mapped(outline, [](Vec2 p) { return left_of(p); });
    auto foot = base_of(turned, box_of(turned), within);
    if (!foot) return std::nullopt;
    foot->begin.at = right_of(foot->begin.at);
    foot->end.at = right_of(foot->end.at);
    return foot;
}

std::optional<Foot> right_edge(const DrawnOutline& outline, double within) {
    const DrawnOutline turned = mapped(outline, [](Vec2 p) { return -p; });
    auto foot = left_edge(turned, within);
    if (!foot) return std::nullopt;
    foot->begin.at = -foot->begin.at;
    foot->end.at = -foot->end.at;
    return foot;
}

double lost_beyond(const DrawnOutline& outline, const Foot& foot, std::span<const Vec2> chain) {
    double most = 0.0;
    for (const DrawnStep& step : between(outline, foot.begin, foot.end)) {
        const int parts = step.curve ? kPartsOfCurve : 1;
        for (int k = 1; k <= parts; ++k) {
            const Vec2 p = at(step, static_cast<double>(k) / parts);
            double nearest = HUGE_VAL;
            bool beyond = false;  // beside the line that is nearest
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                const Segment line{chain[i], chain[i + 1]};
                const double off = distance(p, line);
                if (off >= nearest) continue;
                nearest = off;
                beyond = cross(line.b - line.a, p - line.a) < 0.0;
            }
            if (beyond) most = std::max(most, nearest);
        }
    }
    return most;
}

}  // namespace popup::edit
