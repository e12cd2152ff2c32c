// Lines of flat paper as sets of points: how far two of them are apart, by sampling alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "popup/geometry.h"
#include "popup/pattern.h"

namespace popup::test {

// By what they are: "cut", "mountain", "valley".
using LineSets = std::map<std::string, std::vector<Segment>>;

inline void add_polyline(LineSets& sets, const std::string& kind, const std::vector<Vec2>& points,
                         bool closed = false) {
    for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i)
        sets[kind].push_back({points[i], points[(i + 1) % points.size()]});
}

inline LineSets lines_of(const PatternPiece& piece) {
    LineSets sets;
    for (const auto& cut : piece.cuts) add_polyline(sets, "cut", cut.points, cut.closed);
    for (const auto& line : piece.lines) {
        if (line.kind != LineKind::mountain && line.kind != LineKind::valley) continue;
        sets[line.kind == LineKind::mountain ? "mountain" : "valley"].push_back(line.at);
    }
    return sets;
}

// The largest distance of a point of `a`, one every `step` mm, to `b`.
inline double furthest(const std::vector<Segment>& a, const std::vector<Segment>& b, double step) {
    double worst = 0.0;
    for (const Segment& s : a) {
        const int count = 1 + static_cast<int>(distance(s.a, s.b) / step);
        for (int i = 0; i <= count; ++i) {
            const Vec2 p = lerp(s.a, s.b, static_cast<double>(i) / count);
            double nearest = HUGE_VAL;
            for (const Segment& t : b) nearest = std::min(nearest, distance(p, t));
            worst = std::max(worst, nearest);
        }
    }
    return worst;
}

// The same both ways, of all kinds.
inline double apart(const LineSets& a, const LineSets& b, double step = 1.0) {
    const auto of = [](const LineSets& sets, const std::string& kind) {
        const auto found = sets.find(kind);
        return found == sets.end() ? std::vector<Segment>{} : found->second;
    };
    double worst = 0.0;
    for (const std::string kind : {"cut", "mountain", "valley"}) {
        worst = std::max(worst, furthest(of(a, kind), of(b, kind), step));
        worst = std::max(worst, furthest(of(b, kind), of(a, kind), step));
    }
    return worst;
}

}  // namespace popup::test
