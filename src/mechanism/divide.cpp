#include "mechanism/divide.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace popup {
namespace {

// Chords shorter than this are touches.
constexpr double kLeastChordMm = 1e-6;

// Of a point: on which side of the line it lies, and where along it.
int side_of(Vec2 p, const DirectedLine& line) {
    const double off = cross(line.dir, p - line.at);
    return std::abs(off) <= kOnLineMm ? 0 : off > 0.0 ? 1 : -1;
}

double along_of(Vec2 p, const DirectedLine& line) { return dot(line.dir, p - line.at); }

Vec2 at_of(double along, const DirectedLine& line) { return line.at + along * line.dir; }

// Where the edge from one side of the line to the other crosses it. `t`: on its curve.
Vec2 crossing_at(const Border& border, std::size_t i, const DirectedLine& line, double& t) {
    const BorderEdge& edge = border.edges[i];
    const Segment chord = border.chord(i);
    const double from = cross(line.dir, chord.a - line.at);
    const double to = cross(line.dir, chord.b - line.at);
    if (edge.curve < 0) {
        t = 0.0;
        return at_of(along_of(lerp(chord.a, chord.b, from / (from - to)), line), line);
    }
    // Halved until it cannot be halved: the chord's ends lie on either side, and so do the curve's.
    const Cubic& curve = border.cubics[static_cast<std::size_t>(edge.curve)];
    double lo = edge.t0;
    double hi = edge.t1;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (lo + hi);
        const bool beyond = cross(line.dir, curve.at(middle) - line.at) > 0.0;
        (beyond == (to > 0.0) ? hi : lo) = middle;
    }
    t = 0.5 * (lo + hi);
    return at_of(along_of(curve.at(t), line), line);
}

// Stretches of the line that have paper on one side of it: between edges that leave it to that side.
std::vector<std::pair<double, double>> stretches(const Border& border, const DirectedLine& line, int side) {
    std::vector<double> leaves;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        const Segment chord = border.chord(i);
        const int a = side_of(chord.a, line);
        const int b = side_of(chord.b, line);
        if (a == 0 && b == side) leaves.push_back(along_of(chord.a, line));
        if (b == 0 && a == side) leaves.push_back(along_of(chord.b, line));
    }
    std::sort(leaves.begin(), leaves.end());
    std::vector<std::pair<double, double>> made;
    for (std::size_t i = 0; i + 1 < leaves.size(); i += 2) {
        if (leaves[i + 1] - leaves[i] > kLeastChordMm) made.emplace_back(leaves[i], leaves[i + 1]);
    }
    return made;
}

std::vector<std::pair<double, double>> common(const std::vector<std::pair<double, double>>& a,
                                              const std::vector<std::pair<double, double>>& b) {
    std::vector<std::pair<double, double>> made;
    for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        const double lo = std::max(a[i].first, b[k].first);
        const double hi = std::min(a[i].second, b[k].second);
        if (hi - lo > kLeastChordMm) made.emplace_back(lo, hi);
        (a[i].second < b[k].second ? i : k) += 1;
    }
    return made;
}

// How far one turns clockwise from one direction to another, in (0, 2π].
double clockwise(double from, double to) {
    constexpr double kRound = 2.0 * std::numbers::pi;
    const double turn = std::fmod(from - to + 2.0 * kRound, kRound);
    return turn <= 1e-12 ? kRound : turn;
}

}  // namespace

Border with_corners_on(const Border& border, const DirectedLine& line) {
    Border made;
    made.cubics = border.cubics;
    made.edges.reserve(border.edges.size() + 8);
    // A corner between two chords of one curve that is as near as this to where the curve crosses the line
    // goes there: the chords need it nowhere else, and a sliver beside a fold is no use to anybody.
    constexpr double kNearMm = 0.05;
    const auto goes_on = [&](const BorderEdge& a, const BorderEdge& b) {
        return a.curve >= 0 && a.curve == b.curve && a.t1 == b.t0;
    };
    std::optional<BorderEdge> moved;  // where the next edge begins instead
    std::optional<BorderEdge> first;  // the same of the first edge
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        BorderEdge edge = border.edges[i];
        const Segment chord = border.chord(i);
        if (side_of(chord.a, line) == 0) edge.from = at_of(along_of(edge.from, line), line);
        const int from = side_of(chord.a, line);
        const int to = side_of(chord.b, line);
        const auto begin = std::exchange(moved, std::nullopt);
        if (begin) {
            edge.from = begin->from;
            edge.t0 = begin->t0;
        }
        made.edges.push_back(edge);
        if (from * to >= 0) continue;
        double t = 0.0;
        const Vec2 at = crossing_at(border, i, line, t);
        if (edge.curve < 0) {
            made.edges.push_back({at, -1, 0.0, 0.0, edge.of});
            continue;
        }
        const BorderEdge& next = border.edges[border.next(i)];
        if (made.edges.size() > 1 && !begin && distance(at, chord.a) < kNearMm &&
            goes_on(made.edges[made.edges.size() - 2], edge)) {
            made.edges.back().from = at;
            made.edges.back().t0 = t;
            made.edges[made.edges.size() - 2].t1 = t;
        } else if (distance(at, chord.b) < kNearMm && goes_on(edge, next) &&
                   side_of(border.chord(border.next(i)).b, line) == to) {
            made.edges.back().t1 = t;
            (i + 1 < border.edges.size() ? moved : first) = BorderEdge{at, edge.curve, t, t, edge.of};
        } else {
            made.edges.back().t1 = t;
            made.edges.push_back({at, edge.curve, t, edge.t1, edge.of});
        }
    }
    if (first) {
        made.edges.front().from = first->from;
        made.edges.front().t0 = first->t0;
    }
    return made;
}

namespace {

int as_int(std::size_t i) { return static_cast<int>(i); }

// A corner of a border that lies on the line.
struct Node {
    double along = 0.0;
    std::size_t leaving = 0;  // the edge that begins there
};

// By place.
std::vector<Node> nodes_on(const Border& border, const DirectedLine& line) {
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        if (side_of(border.edges[i].from, line) == 0)
            nodes.push_back({along_of(border.edges[i].from, line), i});
    }
    std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) {
        return std::pair(a.along, a.leaving) < std::pair(b.along, b.leaving);
    });
    return nodes;
}

std::size_t leaving_at(const std::vector<Node>& nodes, double along) {
    return std::lower_bound(nodes.begin(), nodes.end(), along,
                            [](const Node& node, double at) { return node.along < at; })
        ->leaving;
}

// The edges above the chords that begin and end at a node; -1: none. The edge below is the next one.
struct Meeting {
    int right = -1, left = -1;
};

// At a node what comes in goes on with what leaves next, clockwise.
void link_at(const Border& border, const DirectedLine& line, std::size_t leaving, const Meeting& chords,
             std::vector<int>& next) {
    const std::size_t drawn = border.edges.size();
    const std::size_t entering = (leaving + drawn - 1) % drawn;
    const Vec2 at = border.edges[leaving].from;
    const auto direction = [&](Vec2 to) {
        const double rise = side_of(to, line) == 0 ? 0.0 : cross(line.dir, to - line.at);
        return std::atan2(rise, along_of(to, line) - along_of(at, line));
    };
    struct Way {
        int edge;
        double angle;
    };
    std::vector<Way> out{{as_int(leaving), direction(border.edges[border.next(leaving)].from)}};
    // Where one comes from, seen from here.
    std::vector<Way> in{{as_int(entering), direction(border.edges[entering].from)}};
    if (chords.right >= 0) {
        out.push_back({chords.right, 0.0});
        in.push_back({chords.right + 1, 0.0});
    }
    if (chords.left >= 0) {
        out.push_back({chords.left + 1, std::numbers::pi});
        in.push_back({chords.left, std::numbers::pi});
    }
    for (const Way& from : in) {
        const Way* best = nullptr;
        for (const Way& to : out) {
            if (best == nullptr || clockwise(from.angle, to.angle) < clockwise(from.angle, best->angle))
                best = &to;
        }
        next[static_cast<std::size_t>(from.edge)] = best->edge;
    }
}

// Whether each edge follows another.
bool is_whole(const std::vector<int>& next) {
    std::vector<char> followed(next.size(), 0);
    for (const int one : next) {
        if (one >= 0) followed[static_cast<std::size_t>(one)] = 1;
    }
    return std::find(followed.begin(), followed.end(), 0) == followed.end();
}

}  // namespace

Division divide(const Border& border, const DirectedLine& line, EdgeOf made) {
    Division result;
    const Border marked = with_corners_on(border, line);
    result.cubics_ = marked.cubics;
    result.edges_ = marked.edges;
    const std::size_t drawn = marked.edges.size();
    std::vector<int> undivided;
    for (std::size_t i = 0; i < drawn; ++i) undivided.push_back(as_int(marked.next(i)));
    result.next_ = undivided;
    for (const auto& [from, to] : common(stretches(marked, line, 1), stretches(marked, line, -1)))
        result.chords.push_back({from, to, -1, -1});

    const std::vector<Node> nodes = nodes_on(marked, line);
    std::map<std::size_t, Meeting> meetings;
    for (const Division::Chord& chord : result.chords) {
        const int edge = as_int(result.edges_.size());
        result.chord_edge_.push_back(edge);
        const std::size_t from = leaving_at(nodes, chord.from);
        const std::size_t to = leaving_at(nodes, chord.to);
        result.edges_.push_back({marked.edges[from].from, -1, 0.0, 0.0, made});
        result.edges_.push_back({marked.edges[to].from, -1, 0.0, 0.0, made});
        meetings[from].right = edge;
        meetings[to].left = edge;
    }
    result.next_.resize(result.edges_.size(), -1);
    for (const auto& [leaving, chords] : meetings) link_at(marked, line, leaving, chords, result.next_);
    // Where rounding leaves no telling what follows what, nothing is divided.
    if (!is_whole(result.next_)) {
        result.chords.clear();
        result.chord_edge_.clear();
        result.edges_.resize(drawn);
        result.next_ = std::move(undivided);
    }
    result.number_parts(line);
    return result;
}

void Division::number_parts(const DirectedLine& line) {
    part_.assign(edges_.size(), -1);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        if (part_[i] >= 0) continue;
        const int part = as_int(first_.size());
        first_.push_back(as_int(i));
        double most = 0.0;
        for (std::size_t at = i; part_[at] < 0; at = static_cast<std::size_t>(next_[at])) {
            part_[at] = part;
            const double off = cross(line.dir, edges_[at].from - line.at);
            if (std::abs(off) > std::abs(most)) most = off;
        }
        above_.push_back(most > 0.0);
    }
    for (std::size_t i = 0; i < chords.size(); ++i) {
        const auto edge = static_cast<std::size_t>(chord_edge_[i]);
        chords[i].above = part_[edge];
        chords[i].below = part_[edge + 1];
    }
}

std::vector<Border> Division::joined(const std::vector<bool>& folded, std::vector<int>& group_of) const {
    std::vector<int> next = next_;
    std::vector<int> before(next.size());
    for (std::size_t i = 0; i < next.size(); ++i)
        before[static_cast<std::size_t>(next[i])] = static_cast<int>(i);
    std::vector<char> gone(next.size(), 0);
    for (std::size_t i = 0; i < chords.size(); ++i) {
        if (folded[i]) continue;
        const auto above = static_cast<std::size_t>(chord_edge_[i]);
        const std::size_t below = above + 1;
        const auto link = [&](std::size_t from, std::size_t to) {
            const int a = before[from];
            const int b = next[to];
            next[static_cast<std::size_t>(a)] = b;
            before[static_cast<std::size_t>(b)] = a;
        };
        link(above, below);
        link(below, above);
        gone[above] = gone[below] = 1;
    }
    std::vector<Border> made;
    group_of.assign(parts(), -1);
    std::vector<char> seen(next.size(), 0);
    for (std::size_t i = 0; i < next.size(); ++i) {
        if (seen[i] != 0 || gone[i] != 0) continue;
        Border& loop = made.emplace_back();
        loop.cubics = cubics_;
        for (std::size_t at = i; seen[at] == 0; at = static_cast<std::size_t>(next[at])) {
            seen[at] = 1;
            loop.edges.push_back(edges_[at]);
            group_of[static_cast<std::size_t>(part_[at])] = static_cast<int>(made.size()) - 1;
        }
    }
    return made;
}

std::vector<bool> Division::with(EdgeOf kind) const {
    std::vector<bool> have(parts(), false);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        if (edges_[i].of == kind) have[static_cast<std::size_t>(part_[i])] = true;
    }
    return have;
}

Border Division::part(int number) const {
    Border made;
    made.cubics = cubics_;
    const auto first = static_cast<std::size_t>(first_[static_cast<std::size_t>(number)]);
    std::size_t at = first;
    do {
        made.edges.push_back(edges_[at]);
        at = static_cast<std::size_t>(next_[at]);
    } while (at != first);
    return made;
}

std::optional<double> highest_wide(const Border& border, double least_mm) {
    struct Slope {
        Vec2 top, foot;
        [[nodiscard]] double at(double y) const {
            const double along = (top.y - y) / (top.y - foot.y);
            return top.x + along * (foot.x - top.x);
        }
    };
    std::vector<Slope> slopes;
    std::vector<double> levels;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        const Segment chord = border.chord(i);
        levels.push_back(chord.a.y);
        if (chord.a.y == chord.b.y) continue;
        slopes.push_back(chord.a.y > chord.b.y ? Slope{chord.a, chord.b} : Slope{chord.b, chord.a});
    }
    std::sort(levels.begin(), levels.end(), std::greater<>());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    std::sort(slopes.begin(), slopes.end(), [](const Slope& a, const Slope& b) {
        return std::pair(-a.top.y, a.top.x) < std::pair(-b.top.y, b.top.x);
    });
    std::vector<Slope> open;
    std::size_t used = 0;
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        const double high = levels[i];
        const double low = levels[i + 1];
        std::erase_if(open, [&](const Slope& slope) { return slope.foot.y >= high; });
        for (; used < slopes.size() && slopes[used].top.y >= high; ++used) open.push_back(slopes[used]);
        const double middle = 0.5 * (high + low);
        std::sort(open.begin(), open.end(), [&](const Slope& a, const Slope& b) {
            return std::pair(a.at(middle), a.top.x) < std::pair(b.at(middle), b.top.x);
        });
        std::optional<double> best;
        for (std::size_t k = 0; k + 1 < open.size(); k += 2) {
            const double above = open[k + 1].at(high) - open[k].at(high);
            const double below = open[k + 1].at(low) - open[k].at(low);
            if (above >= least_mm) return high;
            if (below < least_mm) continue;
            best = std::max(best.value_or(low), high - (least_mm - above) / (below - above) * (high - low));
        }
        if (best) return best;
    }
    return std::nullopt;
}

}  // namespace popup
