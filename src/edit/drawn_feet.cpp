#include "edit/drawn_feet.h"

#include <algorithm>
#include <cmath>

namespace popup::edit {
namespace {

// What is no further from the end of a drawing, in shares of its height or width, lies on its edge there.
constexpr double kEdgeShare = 0.005;
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

bool straight_on(const DrawnStep& a, const DrawnStep& b) {
    const Vec2 u = a.line.to - a.line.from;
    const Vec2 v = b.line.to - b.line.from;
    return std::abs(cross(u, v)) <= 1e-3 * length(u) * length(v) && dot(u, v) > 0.0;
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
        const int parts = step.curve ? kPartsOfCurve : 1;
        for (int k = 0; k < parts; ++k) box.extend(at(step, static_cast<double>(k) / parts));
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

std::optional<Foot> corner_of(const DrawnOutline& outline, const Box& box, std::span<const Vec2> chain) {
    if (chain.size() != 3) return std::nullopt;
    // Runs of lines that go straight on are one line.
    std::vector<std::pair<std::size_t, std::size_t>> runs;  // first and last step
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (outline[i].curve) continue;
        const bool goes_on =
            !runs.empty() && runs.back().second + 1 == i && straight_on(outline[i - 1], outline[i]);
        if (goes_on) {
            runs.back().second = i;
        } else {
            runs.emplace_back(i, i);
        }
    }
    if (runs.size() > 1 && runs.front().first == 0 && runs.back().second + 1 == count &&
        straight_on(outline.back(), outline.front())) {
        runs.front().first = runs.back().first;
        runs.pop_back();
    }
    std::optional<Foot> best;
    double best_off = kMeantMm;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const auto& [first, last] = runs[k];
        const auto& [next, end] = runs[(k + 1) % runs.size()];
        if ((last + 1) % count != next || runs.size() < 2) continue;
        const Vec2 g = outline[first].line.from;
        const Vec2 e = outline[next].line.from;
        const Vec2 h = outline[end].line.to;
        if (distance(g, h) == 0.0) continue;
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

std::optional<Foot> base_of(const DrawnOutline& outline, const Box& box) {
    const double level = box.min.y + kEdgeShare * box.height();
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

std::optional<Foot> left_edge(const DrawnOutline& outline) {
    // Turned by a quarter the left end is the lower one.
    const DrawnOutline turned = mapped(outline, [](Vec2 p) { return left_of(p); });
    auto foot = base_of(turned, box_of(turned));
    if (!foot) return std::nullopt;
    foot->begin.at = right_of(foot->begin.at);
    foot->end.at = right_of(foot->end.at);
    return foot;
}

std::optional<Foot> right_edge(const DrawnOutline& outline) {
    const DrawnOutline turned = mapped(outline, [](Vec2 p) { return -p; });
    auto foot = left_edge(turned);
    if (!foot) return std::nullopt;
    foot->begin.at = -foot->begin.at;
    foot->end.at = -foot->end.at;
    return foot;
}

}  // namespace popup::edit
