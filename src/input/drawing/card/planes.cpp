#include "input/drawing/card/planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "base/geometry/mend_ends.h"
#include "base/geometry/regions.h"
#include "base/nth.h"

namespace popup::drawing::card {
namespace {

// More are no drawing of a card, and take too long to look at.
constexpr std::size_t kMostPlates = 500;

class PlaneFinder {
 public:
    PlaneFinder(const SheetGraph& graph, const CardPage& page, const Features& features,
                const std::vector<Vec2>& corners, NotUnderstood& why)
        : graph_(graph), page_(page), features_(features), corners_(corners), why_(why) {}

    std::optional<Planes> run(DrawnOn drawn_on) {
        const auto faces = static_cast<std::size_t>(graph_.faces());
        out_.of.resize(faces);
        in_doubt_.assign(graph_.edges.size(), 0);
        if (drawn_on == DrawnOn::looked_for) find_doubtful();
        reach(page_.left, {true, true, 0.0});
        reach(page_.right, {true, false, 0.0});
        if (!follow()) return std::nullopt;
        while (!doubtful_.empty()) {
            const auto known = std::find_if(doubtful_.begin(), doubtful_.end(), [&](int edge) {
                return plane(2 * edge).known || plane(2 * edge + 1).known;
            });
            if (known == doubtful_.end()) break;
            const int edge = *known;
            doubtful_.erase(known);
            if (!settle(edge) || !follow()) return std::nullopt;
        }
        std::sort(out_.drawn_on.begin(), out_.drawn_on.end());
        return std::move(out_);
    }

 private:
    [[nodiscard]] Plane& plane(int half) { return nth(out_.of, graph_.face_of(half)); }

    void reach(int face, const Plane& at) {
        nth(out_.of, face) = at;
        out_.order.push_back(face);
    }

    [[nodiscard]] Segment segment(int half) const {
        return {nth(corners_, graph_.from(half)), nth(corners_, graph_.to(half))};
    }

    [[nodiscard]] static bool runs_along_gutter(const Segment& line) {
        constexpr double kLean = 0.2;
        const double aside = std::abs(line.a.x - line.b.x);
        if (distance(line.a, line.b) <= kSilentMm) return true;
        return aside <= kSnapMm && aside <= kLean * std::abs(line.a.y - line.b.y);
    }

    bool refuse(int half, std::string what) {
        why_ = {graph_.edge(half).element, std::move(what), graph_.at(graph_.edge(half).a)};
        return false;
    }
    bool is_along(int half) {
        return runs_along_gutter(segment(half)) || refuse(half, "this fold does not run along the gutter");
    }
    bool has_room(int half) {
        return out_.order.size() <= kMostPlates ||
               refuse(half, fmt::format("it has more than {} plates", kMostPlates));
    }

    // Beyond a fold of what stands the paper lies, and beyond one of what lies it stands.
    [[nodiscard]] Plane beyond(int half) {
        const Plane here = plane(half);
        const Segment line = segment(half);
        const double x = 0.5 * (line.a.x + line.b.x);
        return {true, !here.upright, here.upright ? here.offset - x : x + here.offset};
    }

    static bool is_one(const Plane& a, const Plane& b) {
        return a.upright == b.upright && std::abs(a.offset - b.offset) <= kSnapMm;
    }

    // Goes over the folds of all that was reached and not yet looked at.
    bool follow() {
        for (; next_ < out_.order.size(); ++next_) {
            for (const int half : graph_.halves_of(out_.order[next_])) {
                if (nth(in_doubt_, half / 2) != 0 || !folds_paper(graph_, features_, half)) continue;
                if (!is_along(half) || !cross_over(half)) return false;
            }
        }
        return true;
    }

    bool cross_over(int half) {
        Plane there = beyond(half);
        if (plane(half ^ 1).known)
            return is_one(plane(half ^ 1), there) ||
                   refuse(half, "the folds that lead round this one do not come back to where they began");
        there.offset = on_grid({there.offset, 0.0}).x;
        reach(graph_.face_of(half ^ 1), there);
        return has_room(half);
    }

    // Stretches of folds between cuts across them, but not those between the halves of the page. Where a line
    // begins, it is a fold.
    void find_doubtful() {
        std::map<int, int> stretches;  // by line
        for (const GraphEdge& edge : graph_.edges) stretches[edge.line] += is_fold(edge) ? 1 : 0;
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            if (!folds_paper(graph_, features_, half) || stretches[graph_.edges[i].line] < 2) continue;
            const std::pair<int, int> sides{graph_.face_of(half), graph_.face_of(half ^ 1)};
            if (sides == std::pair(page_.left, page_.right) || sides == std::pair(page_.right, page_.left))
                continue;
            if (!goes_on(half) || !goes_on(half ^ 1)) continue;
            in_doubt_[i] = 1;
            doubtful_.push_back(static_cast<int>(i));
        }
    }

    // Whether the same line goes on as a fold where a half ends, beyond a cut that comes from either side.
    [[nodiscard]] bool goes_on(int half) const {
        const int corner = graph_.to(half);
        const Vec2 along = graph_.at(corner) - graph_.at(graph_.from(half));
        bool on = false;
        bool left = false;
        bool right = false;
        for (const int other : graph_.around(corner)) {
            if (other == (half ^ 1)) continue;
            const Vec2 there = graph_.at(graph_.to(other)) - graph_.at(corner);
            if (is_fold(graph_.edge(other))) {
                on = on || (graph_.edge(other).line == graph_.edge(half).line && dot(along, there) > 0.0);
                continue;
            }
            left = left || cross(along, there) > 0.0;
            right = right || cross(along, there) < 0.0;
        }
        return on && left && right;
    }

    bool settle(int edge) {
        const int half = plane(2 * edge).known ? 2 * edge : 2 * edge + 1;
        if (!is_along(half)) return false;
        if (plane(half ^ 1).known && !is_one(plane(half), plane(half ^ 1))) {
            nth(in_doubt_, edge) = 0;
            return cross_over(half);
        }
        out_.drawn_on.push_back(edge);
        if (!plane(half ^ 1).known) reach(graph_.face_of(half ^ 1), plane(half));
        return has_room(half);
    }

    const SheetGraph& graph_;
    const CardPage& page_;
    const Features& features_;
    const std::vector<Vec2>& corners_;
    NotUnderstood& why_;
    std::vector<char> in_doubt_;  // by edge
    std::vector<int> doubtful_;   // edges, ascending
    std::size_t next_ = 0;        // in the order
    Planes out_;
};

}  // namespace

bool folds_paper(const SheetGraph& graph, const Features& features, int half) {
    const int a = graph.face_of(half);
    const int b = graph.face_of(half ^ 1);
    return is_fold(graph.edge(half)) && a != 0 && b != 0 && a != b &&
           nth(features.group_of, a) == nth(features.group_of, b);
}

std::optional<Planes> find_planes(const SheetGraph& graph, const CardPage& page, const Features& features,
                                  const std::vector<Vec2>& corners, DrawnOn drawn_on, NotUnderstood& why) {
    return PlaneFinder(graph, page, features, corners, why).run(drawn_on);
}

}  // namespace popup::drawing::card
