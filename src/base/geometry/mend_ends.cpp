#include "base/geometry/mend_ends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/nth.h"

namespace popup {
namespace {

// Mending one end may show that another misses. What is not mended after so many rounds stays.
constexpr int kMostRounds = 4;
// Lines that meet at a smaller angle (its sine) do not say where.
constexpr double kLeastSine = 0.2;
// More looks at an edge beside an end than this are no drawing that somebody made.
constexpr std::size_t kMostLooks = 20'000'000;

struct LooseEnd {
    int line = 0;
    bool last = false;
    int corner = 0;
    int half = 0;  // that leads away from the corner, along the line
    Vec2 at;
    Vec2 onwards;  // unit, out of the line
};

struct Move {
    int line = 0;
    bool last = false;
    Vec2 to;
};

class Round {
 public:
    Round(const std::vector<SheetLine>& lines, const SheetGraph& graph, double snap_mm)
        : lines_(lines), graph_(graph), snap_mm_(snap_mm) {
        std::vector<Segment> segments;
        for (std::size_t i = 0; i < graph.edges.size(); ++i)
            segments.push_back(graph.segment(static_cast<int>(2 * i)));
        index_ = EdgeIndex({}, segments);
        find_loose();
    }

    // Nullopt when there are more looks than a drawing takes.
    std::optional<std::vector<Move>> moves() {
        // What is only rounding is no reason to look further.
        weld();
        trim(kSilentMm);
        go_ahead(kSilentMm);
        join_groups(false);
        trim(snap_mm_);
        go_ahead(snap_mm_);
        join_groups(true);
        for (std::size_t i = 0; i < loose_.size(); ++i) {
            if (done_[i]) continue;
            if (const auto near = nearest(loose_[i])) move(i, *near);
        }
        return taken();
    }

    // Three and more ends of folds near each other, with no cut there, are one point: where most of them are,
    // else where their lines meet. One may lie on another fold just beside it, and would be no loose end.
    // Nullopt as above.
    std::optional<std::vector<Move>> gathered() {
        gather();
        return taken();
    }

 private:
    std::optional<std::vector<Move>> taken() {
        if (looks_ > kMostLooks) return std::nullopt;
        return std::exchange(moves_, {});
    }

    // Edges whose boxes are that near to a point, in found_; none once there have been too many.
    void look(Vec2 at, double reach) {
        found_.clear();
        if (looks_ > kMostLooks) return;
        Box box;
        box.extend(at - Vec2{reach, reach});
        box.extend(at + Vec2{reach, reach});
        index_.query(box, found_);
        looks_ += found_.size();
    }

    void find_loose() {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (lines_[i].closed) continue;
            for (const bool last : {false, true}) {
                const int corner = graph_.ends[i][last ? 1 : 0];
                const std::vector<int>& around = graph_.around(corner);
                if (around.size() != 1) continue;
                const Segment away = graph_.segment(around.front());
                loose_.push_back(
                    {static_cast<int>(i), last, corner, around.front(), away.a, unit(away.a - away.b)});
                loose_at_.emplace(corner, loose_.size() - 1);
            }
        }
        done_.assign(loose_.size(), false);
    }

    void gather() {
        std::vector<LooseEnd> ends;
        std::multimap<int, std::size_t> at_corner;
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const SheetLine& line = lines_[i];
            if (line.closed || (line.ink & kAnyFold) == 0) continue;
            for (const bool last : {false, true}) {
                const int corner = graph_.ends[i][last ? 1 : 0];
                // Where a cut is, folds end at it, each for itself.
                if (is_near_cut(graph_.at(corner))) continue;
                const Vec2 before = last ? line.points[line.points.size() - 2] : line.points[1];
                at_corner.emplace(corner, ends.size());
                ends.push_back({static_cast<int>(i), last, corner, -1, graph_.at(corner),
                                unit(graph_.at(corner) - before)});
            }
        }
        std::vector<bool> gathered(ends.size(), false);
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (gathered[i]) continue;
            std::vector<std::size_t> group = ends_within(at_corner, ends[i].at, snap_mm_);
            std::erase_if(group, [&](std::size_t one) { return gathered[one]; });
            const std::optional<Vec2> to = apex_of(ends, group);
            if (!to) continue;
            for (const std::size_t one : group) {
                gathered[one] = true;
                if (ends[one].at != *to) moves_.push_back({ends[one].line, ends[one].last, *to});
            }
        }
    }

    // Where these ends of folds are one point; nullopt where they are meant to be as they are, or too far
    // off.
    [[nodiscard]] std::optional<Vec2> apex_of(const std::vector<LooseEnd>& ends,
                                              const std::vector<std::size_t>& group) const {
        std::map<int, int> lines;
        std::map<int, int> corners;
        for (const std::size_t one : group) {
            ++lines[ends[one].line];
            ++corners[ends[one].corner];
        }
        // A line with both its ends there is too short to say where it leads.
        const bool has_short =
            std::any_of(lines.begin(), lines.end(), [](const auto& one) { return one.second > 1; });
        // In paper that folds flat an even number of folds meets (Maekawa's theorem): where that holds, what
        // is near each other is meant to be.
        const bool is_odd = std::any_of(corners.begin(), corners.end(), [this](const auto& one) {
            return graph_.around(one.first).size() % 2 == 1;
        });
        if (lines.size() < 3 || corners.size() < 2 || has_short || !is_odd) return std::nullopt;
        const auto most = std::max_element(corners.begin(), corners.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        const auto to =
            most->second > 1 ? std::optional(graph_.at(most->first)) : meeting(ends, group, false);
        const auto far = [&](std::size_t one) { return distance(ends[one].at, *to) > snap_mm_; };
        return to && std::none_of(group.begin(), group.end(), far) ? to : std::nullopt;
    }

    [[nodiscard]] bool is_near_cut(Vec2 at) {
        look(at, snap_mm_);
        return std::any_of(found_.begin(), found_.end(), [&](int edge) {
            return !is_fold(nth(graph_.edges, edge)) && distance(at, graph_.segment(2 * edge)) <= snap_mm_;
        });
    }

    // In their order.
    [[nodiscard]] std::vector<std::size_t> ends_within(const std::multimap<int, std::size_t>& at_corner,
                                                       Vec2 at, double reach) {
        look(at, reach);
        std::set<int> corners;
        for (const int edge : found_) {
            for (const int corner : {nth(graph_.edges, edge).a, nth(graph_.edges, edge).b}) {
                if (distance(at, graph_.at(corner)) <= reach) corners.insert(corner);
            }
        }
        std::vector<std::size_t> group;
        for (const int corner : corners) {
            const auto [begin, end] = at_corner.equal_range(corner);
            for (auto other = begin; other != end; ++other) group.push_back(other->second);
        }
        std::sort(group.begin(), group.end());
        return group;
    }

    // Ends at a corner that is another up to rounding go there.
    void weld() {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (lines_[i].closed) continue;
            for (const bool last : {false, true}) {
                const int corner = graph_.ends[i][last ? 1 : 0];
                if (const int other = corner_beside(corner, graph_.ends[i][last ? 0 : 1]); other != corner)
                    moves_.push_back({static_cast<int>(i), last, graph_.at(other)});
            }
        }
    }

    // The corner within kSilentMm where most lines meet, the first of several.
    [[nodiscard]] int corner_beside(int corner, int never) {
        const Vec2 p = graph_.at(corner);
        look(p, kSilentMm);
        int best = corner;
        const auto rank = [&](int c) { return std::pair(-static_cast<int>(graph_.around(c).size()), c); };
        for (const int edge : found_) {
            for (const int other : {nth(graph_.edges, edge).a, nth(graph_.edges, edge).b}) {
                if (other == never || distance(graph_.at(other), p) > kSilentMm || rank(other) >= rank(best))
                    continue;
                best = other;
            }
        }
        return best;
    }

    void move(std::size_t loose, Vec2 to) {
        done_[loose] = true;
        moves_.push_back({loose_[loose].line, loose_[loose].last, to});
    }

    // Ends that run over what they meet are cut off there.
    void trim(double most) {
        for (std::size_t i = 0; i < loose_.size(); ++i) {
            if (done_[i]) continue;
            double way = 0.0;
            int half = loose_[i].half;
            while (true) {
                way += distance(graph_.at(graph_.from(half)), graph_.at(graph_.to(half)));
                const std::vector<int>& around = graph_.around(graph_.to(half));
                if (way > most || around.size() == 1) break;
                if (around.size() > 2) {
                    move(i, graph_.at(graph_.to(half)));
                    break;
                }
                half = around.front() == (half ^ 1) ? around.back() : around.front();
            }
        }
    }

    // Loose ends near each other, all of them.
    [[nodiscard]] std::vector<std::size_t> ends_near(std::size_t first) {
        std::vector<std::size_t> group = ends_within(loose_at_, loose_[first].at, 2.0 * snap_mm_);
        std::erase_if(group, [&](std::size_t one) { return one != first && done_[one]; });
        return group;
    }

    // Loose ends near each other meet where their lines do: all that are near, else the nearest two. `level`:
    // those of lines that go on in each other.
    void join_groups(bool level) {
        for (std::size_t i = 0; i < loose_.size(); ++i) {
            if (done_[i]) continue;
            std::vector<std::size_t> group = ends_near(i);
            // A line that is drawn twice ends twice in one corner.
            const auto elsewhere = [&](std::size_t other) {
                return loose_[other].corner != loose_[i].corner;
            };
            if (std::none_of(group.begin(), group.end(), elsewhere)) continue;
            auto to = meeting(loose_, group, level);
            if (!to) {
                const auto off = [&](std::size_t other) {
                    return elsewhere(other) ? distance(loose_[i].at, loose_[other].at) : HUGE_VAL;
                };
                const auto nearest = std::min_element(group.begin(), group.end(),
                                                      [&](auto a, auto b) { return off(a) < off(b); });
                group = {i, *nearest};
                to = meeting(loose_, group, level);
            }
            if (!to) continue;
            for (const std::size_t one : group) move(one, *to);
        }
    }

    // The point nearest to the lines of all these ends, which cross; of level ones their middle.
    [[nodiscard]] std::optional<Vec2> meeting(const std::vector<LooseEnd>& ends,
                                              const std::vector<std::size_t>& group, bool level) const {
        double xx = 0.0;
        double xy = 0.0;
        double yy = 0.0;
        Vec2 right;
        Vec2 middle;
        for (const std::size_t one : group) {
            const Vec2 n = left_of(ends[one].onwards);
            const double by = dot(n, ends[one].at);
            xx += n.x * n.x;
            xy += n.x * n.y;
            yy += n.y * n.y;
            right = right + by * n;
            middle = middle + (1.0 / static_cast<double>(group.size())) * ends[one].at;
        }
        const double det = xx * yy - xy * xy;
        if ((det <= kLeastSine * kLeastSine) != level) return std::nullopt;
        Vec2 to = middle;
        if (!level) to = {(yy * right.x - xy * right.y) / det, (xx * right.y - xy * right.x) / det};
        for (const std::size_t one : group) {
            if (distance(ends[one].at, to) > snap_mm_) return std::nullopt;
        }
        return to;
    }

    void go_ahead(double most) {
        for (std::size_t i = 0; i < loose_.size(); ++i) {
            if (done_[i]) continue;
            if (const auto to = ahead(loose_[i], most)) move(i, *to);
        }
    }

    // What its line would meet next.
    std::optional<Vec2> ahead(const LooseEnd& end, double most) {
        look(end.at, snap_mm_);
        std::optional<Vec2> to;
        double best = most;
        for (const int edge : found_) {
            if (edge == end.half / 2) continue;
            const Segment s = graph_.segment(2 * edge);
            const Vec2 along = s.b - s.a;
            const double by = cross(end.onwards, along);
            if (std::abs(by) < kLeastSine * length(along)) continue;
            const double way = cross(s.a - end.at, along) / by;
            const double t = cross(s.a - end.at, end.onwards) / by;
            if (way < 0.0 || way > best || t < 0.0 || t > 1.0) continue;
            best = way;
            to = end.at + way * end.onwards;
        }
        return to;
    }

    // The nearest point of another line, its corners first.
    std::optional<Vec2> nearest(const LooseEnd& end) {
        look(end.at, snap_mm_);
        std::optional<Vec2> corner_to;
        std::optional<Vec2> to;
        double corner_best = snap_mm_;
        double best = snap_mm_;
        for (const int edge : found_) {
            const GraphEdge& other = nth(graph_.edges, edge);
            if (edge == end.half / 2 || is_own(end, other)) continue;
            const Segment s = graph_.segment(2 * edge);
            for (const Vec2 p : {s.a, s.b}) {
                if (distance(p, end.at) >= corner_best) continue;
                corner_best = distance(p, end.at);
                corner_to = p;
            }
            const Vec2 along = s.b - s.a;
            const double t = std::clamp(dot(end.at - s.a, along) / dot(along, along), 0.0, 1.0);
            const Vec2 p = lerp(s.a, s.b, t);
            if (distance(p, end.at) >= best) continue;
            best = distance(p, end.at);
            to = p;
        }
        return corner_to ? corner_to : to;
    }

    // Edges of the line itself, just before its end.
    static bool is_own(const LooseEnd& end, const GraphEdge& edge) { return edge.line == end.line; }

    const std::vector<SheetLine>& lines_;
    const SheetGraph& graph_;
    double snap_mm_;
    EdgeIndex index_;
    std::vector<LooseEnd> loose_;
    std::multimap<int, std::size_t> loose_at_;  // by corner
    std::vector<bool> done_;
    std::vector<Move> moves_;
    std::vector<int> found_;
    std::size_t looks_ = 0;
};

}  // namespace

std::optional<SheetGraph> mend_ends(std::vector<SheetLine>& lines, const EndTolerances& tolerances,
                                    std::vector<MovedEnd>& moved) {
    // Where each end was drawn, of those that moved.
    std::map<std::pair<int, bool>, Vec2> drawn;
    const auto end_of = [&](int line, bool last) -> Vec2& {
        std::vector<Vec2>& points = nth(lines, line).points;
        return last ? points.back() : points.front();
    };
    std::optional<SheetGraph> graph;
    // False when a drawing does not take so much.
    const auto repeat = [&](std::optional<std::vector<Move>> (Round::*look)()) {
        for (int round = 0;; ++round) {
            graph = make_graph(lines, tolerances.one_point_mm);
            if (!graph) return false;
            if (round == kMostRounds) return true;
            bool any = false;
            Round here(lines, *graph, tolerances.snap_mm);
            const std::optional<std::vector<Move>> moves = (here.*look)();
            if (!moves) return false;
            for (const Move& move : *moves) {
                Vec2& end = end_of(move.line, move.last);
                const Vec2 from = drawn.try_emplace({move.line, move.last}, end).first->second;
                if (distance(from, move.to) > tolerances.snap_mm || end == move.to) continue;
                end = move.to;
                any = true;
            }
            if (!any) return true;
        }
    };
    if (tolerances.gathers_folds && !repeat(&Round::gathered)) return std::nullopt;
    if (!repeat(&Round::moves)) return std::nullopt;
    for (const auto& [which, from] : drawn) {
        const Vec2 to = end_of(which.first, which.second);
        if (from != to) moved.push_back({which.first, which.second, from, to});
    }
    return graph;
}

}  // namespace popup
