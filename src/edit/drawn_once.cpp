#include "edit/drawn_once.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "edit/drawn_feet.h"

namespace popup::edit {
namespace {

struct Line {
    DrawnOutline outline;
    Box box;
};

bool near(Vec2 p, Vec2 q) { return distance(p, q) <= kFlatMm; }
bool near(const Box& a, const Box& b) { return near(a.min, b.min) && near(a.max, b.max); }

// Whether b is a, begun at its step `shift`.
bool same_from(const DrawnOutline& a, const DrawnOutline& b, std::size_t shift) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const DrawnStep& one = a[i];
        const DrawnStep& other = b[(i + shift) % b.size()];
        if (one.curve != other.curve || !near(one.line.from, other.line.from)) return false;
        if (one.curve && (!near(one.line.control_1, other.line.control_1) ||
                          !near(one.line.control_2, other.line.control_2)))
            return false;
    }
    return true;
}

bool same(const Line& a, const Line& b) {
    if (a.outline.size() != b.outline.size() || !near(a.box, b.box)) return false;
    for (const DrawnOutline& other : {b.outline, reversed(b.outline)}) {
        for (std::size_t shift = 0; shift < other.size(); ++shift) {
            if (near(a.outline.front().line.from, other[shift].line.from) &&
                same_from(a.outline, other, shift))
                return true;
        }
    }
    return false;
}

}  // namespace

Path drawn_once(const Path& drawn, std::vector<Vec2>& repeated) {
    const std::vector<Subpath>& subpaths = drawn.subpaths();
    std::vector<Line> lines;
    Box all;
    for (const Subpath& subpath : subpaths) {
        DrawnOutline outline = outline_of(subpath);
        const Box box = box_of(outline);
        all.extend(box.min);
        all.extend(box.max);
        lines.push_back({std::move(outline), box});
    }
    std::vector<std::size_t> order(lines.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return lines[a].box.min.x < lines[b].box.min.x; });
    std::vector<bool> again(lines.size(), false);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Line& one = lines[order[i]];
        if (again[order[i]] || one.outline.empty()) continue;
        for (std::size_t k = i + 1; k < order.size() && lines[order[k]].box.min.x <= one.box.min.x + kFlatMm;
             ++k) {
            if (!again[order[k]]) again[order[k]] = same(one, lines[order[k]]);
        }
    }
    Path made;
    for (std::size_t i = 0; i < subpaths.size(); ++i) {
        if (again[i]) {
            repeated.push_back(subpaths[i].start - all.min);
            continue;
        }
        made.move(subpaths[i].start);
        for (const PathStep& step : subpaths[i].steps) {
            if (step.curve) {
                made.cubic(step.control_1, step.control_2, step.to);
            } else {
                made.line(step.to);
            }
        }
        if (subpaths[i].closed) made.close();
    }
    return made;
}

}  // namespace popup::edit
