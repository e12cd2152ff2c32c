#include "base/geometry/sheet_graph.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/geometry/cells.h"
#include "base/geometry/edge_index.h"
#include "base/nth.h"

namespace popup {
namespace {

// More looks at two chords than this are no drawing that somebody made.
constexpr std::size_t kMostLooks = 20'000'000;

struct Chord {
    int a = 0, b = 0;
    int line = 0;
};

// A point on a chord at which another meets it.
struct Meeting {
    int chord = 0;
    double t = 0.0;
    int corner = 0;
};

}  // namespace

class GraphMaker {
 public:
    GraphMaker(const std::vector<SheetLine>& lines, double one_point_mm, std::size_t most_meetings)
        : lines_(lines), one_point_mm_(one_point_mm), most_meetings_(most_meetings) {}

    std::optional<SheetGraph> run() {
        for (std::size_t i = 0; i < lines_.size(); ++i) add_line(lines_[i], static_cast<int>(i));
        if (!meet()) return std::nullopt;
        cut_chords();
        turn();
        trace_faces();
        return std::move(graph_);
    }

 private:
    // The corner at a point: one that is there already, or a new one.
    int corner_at(Vec2 p) {
        const auto cell = [this](double v) {
            return static_cast<std::int64_t>(std::floor(v / one_point_mm_));
        };
        const PlaneCell at{cell(p.x), cell(p.y)};
        int nearest = -1;
        double best = one_point_mm_;
        for (std::int64_t x = at.x - 1; x <= at.x + 1; ++x) {
            for (std::int64_t y = at.y - 1; y <= at.y + 1; ++y) {
                const auto found = cells_.find({x, y});
                if (found == cells_.end()) continue;
                for (const int corner : found->second) {
                    const double off = distance(graph_.at(corner), p);
                    if (off > best || (off == best && nearest >= 0)) continue;
                    best = off;
                    nearest = corner;
                }
            }
        }
        if (nearest >= 0) return nearest;
        const int made = static_cast<int>(graph_.corners.size());
        graph_.corners.push_back(p);
        cells_[at].push_back(made);
        return made;
    }

    void add_line(const SheetLine& line, int number) {
        std::vector<int> corners;
        for (const Vec2 p : line.points) {
            corners.push_back(corner_at(p));
            if (graph_.at(corners.back()) != p) graph_.merged.push_back({p, graph_.at(corners.back())});
        }
        graph_.ends.push_back({corners.front(), line.closed ? corners.front() : corners.back()});
        if (line.closed) corners.push_back(corners.front());
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
            if (corners[i] != corners[i + 1]) chords_.push_back({corners[i], corners[i + 1], number});
        }
    }

    [[nodiscard]] Segment segment(const Chord& chord) const {
        return {graph_.at(chord.a), graph_.at(chord.b)};
    }

    // Finds where chords meet one another.
    bool meet() {
        std::vector<Segment> segments;
        segments.reserve(chords_.size());
        for (const Chord& chord : chords_) segments.push_back(segment(chord));
        const EdgeIndex index({}, segments);
        std::vector<int> found;
        std::size_t looks = 0;
        for (std::size_t i = 0; i < chords_.size(); ++i) {
            Box box;
            box.extend(segments[i].a);
            box.extend(segments[i].b);
            box.min = box.min - Vec2{one_point_mm_, one_point_mm_};
            box.max = box.max + Vec2{one_point_mm_, one_point_mm_};
            found.clear();
            index.query(box, found);
            looks += found.size();
            if (looks > kMostLooks) return false;
            for (const int j : found) {
                if (j > static_cast<int>(i)) meet(static_cast<int>(i), j);
            }
            if (meetings_.size() > most_meetings_) return false;
        }
        return true;
    }

    // Whether the corner lies on the chord, not at its ends: then the two meet there.
    bool touch(int chord, int corner) {
        const Chord& c = nth(chords_, chord);
        if (corner == c.a || corner == c.b) return false;
        const Segment s = segment(c);
        if (distance(graph_.at(corner), s) > one_point_mm_) return false;
        const Vec2 along = s.b - s.a;
        meetings_.push_back({chord, dot(graph_.at(corner) - s.a, along) / dot(along, along), corner});
        return true;
    }

    void meet(int i, int j) {
        const Chord& c = nth(chords_, i);
        const Chord& d = nth(chords_, j);
        bool touches = c.a == d.a || c.a == d.b || c.b == d.a || c.b == d.b;
        for (const int corner : {d.a, d.b}) touches = touch(i, corner) || touches;
        for (const int corner : {c.a, c.b}) touches = touch(j, corner) || touches;
        if (touches) return;
        const Segment s = segment(c);
        const Segment o = segment(d);
        const Vec2 u = s.b - s.a;
        const Vec2 v = o.b - o.a;
        const double by = cross(u, v);
        if (by == 0.0) return;
        const double t = cross(o.a - s.a, v) / by;
        const double w = cross(o.a - s.a, u) / by;
        if (!(t > 0.0 && t < 1.0 && w > 0.0 && w < 1.0)) return;
        const int corner = corner_at(lerp(s.a, s.b, t));
        if (corner != c.a && corner != c.b) meetings_.push_back({i, t, corner});
        if (corner != d.a && corner != d.b) meetings_.push_back({j, w, corner});
    }

    // Chords become edges between the corners on them; what lies on each other is one edge.
    void cut_chords() {
        std::sort(meetings_.begin(), meetings_.end(), [](const Meeting& a, const Meeting& b) {
            return std::tie(a.chord, a.t, a.corner) < std::tie(b.chord, b.t, b.corner);
        });
        auto next = meetings_.begin();
        for (std::size_t i = 0; i < chords_.size(); ++i) {
            const Chord& chord = chords_[i];
            int from = chord.a;
            for (; next != meetings_.end() && next->chord == static_cast<int>(i); ++next) {
                add_edge(from, next->corner, chord, static_cast<int>(i));
                from = next->corner;
            }
            add_edge(from, chord.b, chord, static_cast<int>(i));
        }
    }

    void add_edge(int a, int b, const Chord& chord, int number) {
        if (a == b) return;
        const auto key =
            (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | static_cast<std::uint64_t>(std::max(a, b));
        const auto [at, fresh] = edge_of_.try_emplace(key, graph_.edges.size());
        const SheetLine& line = nth(lines_, chord.line);
        if (fresh) {
            graph_.edges.push_back({a, b, line.ink, chord.line, line.element, {number, -1}, false});
            return;
        }
        GraphEdge& edge = graph_.edges[at->second];
        edge.ink |= line.ink;
        edge.doubled = edge.doubled || edge.element != line.element;
        if (edge.of[0] != number && edge.of[1] < 0) edge.of[1] = number;
    }

    // Sorts the halves around each corner, and finds what follows each of them.
    void turn() {
        graph_.around_.resize(graph_.corners.size());
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            nth(graph_.around_, graph_.edges[i].a).push_back(static_cast<int>(2 * i));
            nth(graph_.around_, graph_.edges[i].b).push_back(static_cast<int>(2 * i + 1));
        }
        graph_.next_.resize(2 * graph_.edges.size());
        for (std::vector<int>& halves : graph_.around_) {
            const auto way = [&](int half) {
                return graph_.at(graph_.to(half)) - graph_.at(graph_.from(half));
            };
            // By half planes and cross products: no angle is rounded.
            std::sort(halves.begin(), halves.end(), [&](int a, int b) {
                const Vec2 u = way(a);
                const Vec2 v = way(b);
                const bool u_low = u.y < 0.0 || (u.y == 0.0 && u.x < 0.0);
                const bool v_low = v.y < 0.0 || (v.y == 0.0 && v.x < 0.0);
                if (u_low != v_low) return v_low;
                const double by = cross(u, v);
                return by != 0.0 ? by > 0.0 : a < b;
            });
            // Arriving at a corner, the border of the face on the left goes on with the next half clockwise.
            for (std::size_t i = 0; i < halves.size(); ++i) {
                const int arriving = halves[i] ^ 1;
                nth(graph_.next_, arriving) = halves[(i + halves.size() - 1) % halves.size()];
            }
        }
    }

    void trace_faces() {
        graph_.face_.assign(graph_.next_.size(), -1);
        graph_.halves_.emplace_back();
        std::vector<int> inward;  // a half of each border that has its face on the outside
        std::vector<int> loop;
        std::vector<int> seen(graph_.next_.size(), 0);  // in which walk
        int walk = 0;
        for (std::size_t first = 0; first < graph_.next_.size(); ++first) {
            if (seen[first] != 0) continue;
            ++walk;
            loop.clear();
            double twice_area = 0.0;
            const Vec2 origin = graph_.at(graph_.from(static_cast<int>(first)));
            for (int half = static_cast<int>(first); nth(seen, half) == 0; half = graph_.next(half)) {
                nth(seen, half) = walk;
                loop.push_back(half);
                twice_area +=
                    cross(graph_.at(graph_.from(half)) - origin, graph_.at(graph_.to(half)) - origin);
            }
            // There and back along open lines: what this encloses is rounding, and may be more than nothing.
            const bool open =
                std::all_of(loop.begin(), loop.end(), [&](int half) { return nth(seen, half ^ 1) == walk; });
            if (open || twice_area <= 0.0) {
                inward.push_back(loop.front());
                continue;
            }
            for (const int half : loop) nth(graph_.face_, half) = graph_.faces();
            graph_.halves_.push_back(loop);
        }
        place_inward(inward);
    }

    // The number of what is connected, for each corner.
    [[nodiscard]] std::vector<int> components() const {
        std::vector<int> of(graph_.corners.size(), -1);
        std::vector<int> todo;
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (of[i] >= 0) continue;
            of[i] = static_cast<int>(i);
            todo.push_back(static_cast<int>(i));
            while (!todo.empty()) {
                const int corner = todo.back();
                todo.pop_back();
                for (const int half : graph_.around(corner)) {
                    if (nth(of, graph_.to(half)) >= 0) continue;
                    nth(of, graph_.to(half)) = static_cast<int>(i);
                    todo.push_back(graph_.to(half));
                }
            }
        }
        return of;
    }

    // Borders that run clockwise lie in the face that is found to the left of them. That face may only be
    // known through another such border, so they are looked at from left to right.
    void place_inward(const std::vector<int>& inward) {
        const std::vector<int> component = components();
        std::vector<Segment> segments;
        for (std::size_t i = 0; i < graph_.edges.size(); ++i)
            segments.push_back(graph_.segment(static_cast<int>(2 * i)));
        const EdgeIndex index({}, segments);
        double leftmost = 0.0;
        for (const Vec2 p : graph_.corners) leftmost = std::min(leftmost, p.x);
        struct Border {
            Vec2 at;
            int half;
        };
        std::vector<Border> borders;
        for (const int first : inward) {
            Border border{graph_.at(graph_.from(first)), first};
            int half = first;
            do {
                const Vec2 p = graph_.at(graph_.from(half));
                if (std::pair(p.x, p.y) < std::pair(border.at.x, border.at.y)) border.at = p;
                half = graph_.next(half);
            } while (half != first);
            borders.push_back(border);
        }
        std::sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) {
            return std::tie(a.at.x, a.at.y, a.half) < std::tie(b.at.x, b.at.y, b.half);
        });
        std::vector<int> found;
        for (const Border& border : borders) {
            found.clear();
            Box box;
            box.extend(border.at);
            box.extend({leftmost, border.at.y});
            index.query(box, found);
            int face = 0;
            std::pair best{-HUGE_VAL, 0.0};  // where, and how it leans just above
            const int own = nth(component, graph_.from(border.half));
            for (const int edge : found) {
                const Segment s = segments[static_cast<std::size_t>(edge)];
                if (nth(component, graph_.edges[static_cast<std::size_t>(edge)].a) == own) continue;
                if ((s.a.y <= border.at.y) == (s.b.y <= border.at.y)) continue;
                const double lean = (s.b.x - s.a.x) / (s.b.y - s.a.y);
                const std::pair here{s.a.x + (border.at.y - s.a.y) * lean, lean};
                if (here.first > border.at.x || here <= best) continue;
                best = here;
                // The half that has its left towards the border: the one that runs down.
                face = graph_.face_of(s.a.y > s.b.y ? 2 * edge : 2 * edge + 1);
            }
            face = std::max(face, 0);
            int half = border.half;
            do {
                nth(graph_.face_, half) = face;
                nth(graph_.halves_, face).push_back(half);
                half = graph_.next(half);
            } while (half != border.half);
        }
    }

    const std::vector<SheetLine>& lines_;
    double one_point_mm_;
    std::size_t most_meetings_;
    SheetGraph graph_;
    std::vector<Chord> chords_;
    std::vector<Meeting> meetings_;
    std::unordered_map<PlaneCell, std::vector<int>, PlaneCellHash> cells_;
    std::unordered_map<std::uint64_t, std::size_t> edge_of_;
};

std::optional<SheetGraph> make_graph(const std::vector<SheetLine>& lines, double one_point_mm,
                                     std::size_t most_meetings) {
    return GraphMaker(lines, one_point_mm, most_meetings).run();
}

}  // namespace popup
