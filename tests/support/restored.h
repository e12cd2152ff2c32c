// Restored curves held against their polygons, by evaluation of this file's own.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "popup/curves.h"

namespace popup::test {

// By Bernstein's polynomials.
inline Vec2 bezier(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double t) {
    const double s = 1.0 - t;
    const auto mix = [&](double p, double q, double r, double u) {
        return s * s * s * p + 3 * s * s * t * q + 3 * s * t * t * r + t * t * t * u;
    };
    return {mix(a.x, b.x, c.x, d.x), mix(a.y, b.y, c.y, d.y)};
}

// Points of the step, close to each other beside the chords it stands for, its ends among them.
inline std::vector<Vec2> samples(Vec2 from, const CurveStep& step, Vec2 to, std::size_t chords) {
    const std::size_t count = step.curve ? 10 * chords : 1;
    std::vector<Vec2> points;
    for (std::size_t i = 0; i <= count; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(count);
        points.push_back(step.curve ? bezier(from, step.control_1, step.control_2, to, t)
                                    : from + t * (to - from));
    }
    return points;
}

inline double distance_to(Vec2 p, const std::vector<Vec2>& line) {
    double least = HUGE_VAL;  // squared
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Vec2 along = line[i] - line[i - 1];
        const Vec2 away = p - line[i - 1];
        const double squared = dot(along, along);
        const double t = squared > 0.0 ? std::clamp(dot(along, away) / squared, 0.0, 1.0) : 0.0;
        const Vec2 gap = away - t * along;
        least = std::min(least, dot(gap, gap));
    }
    return std::sqrt(least);
}

// How far the two lines are from each other where they are furthest apart: by their corners and the middles
// between them.
inline double hausdorff(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    double most = 0.0;
    const auto look = [&most](const std::vector<Vec2>& these, const std::vector<Vec2>& those) {
        for (std::size_t i = 0; i < these.size(); ++i) {
            most = std::max(most, distance_to(these[i], those));
            if (i > 0) most = std::max(most, distance_to(lerp(these[i - 1], these[i], 0.5), those));
        }
    };
    look(a, b);
    look(b, a);
    return most;
}

// The same of a restored polygon and the polygon itself, step by step. HUGE_VAL when the steps do not go once
// round it.
inline double strays(std::span<const Vec2> points, bool closed, const Restored& restored) {
    double most = 0.0;
    std::size_t at = restored.start;
    std::size_t edges = 0;
    for (const CurveStep& step : restored.steps) {
        std::vector<Vec2> chords{points[at]};
        std::size_t next = at;
        do {
            next = (next + 1) % points.size();
            chords.push_back(points[next]);
            at = next;
            ++edges;
        } while (next != step.to && edges <= points.size());
        most = std::max(most,
                        hausdorff(samples(chords.front(), step, chords.back(), chords.size() - 1), chords));
    }
    const std::size_t wanted = points.size() - (closed ? 0 : 1);
    if (!restored.steps.empty() && (edges != wanted || at != (closed ? restored.start : points.size() - 1)))
        return HUGE_VAL;
    return most;
}

inline std::size_t curves_in(const Restored& restored) {
    return static_cast<std::size_t>(std::count_if(restored.steps.begin(), restored.steps.end(),
                                                  [](const CurveStep& step) { return step.curve; }));
}

}  // namespace popup::test
