#include "mechanism/border.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/near_boxes.h"
#include "base/geometry/regions.h"

namespace popup {
namespace {

// Corners no further apart than this are one.
constexpr double kSameMm = 1e-5;
// Edges that come as near as this touch: the grid cannot tell.
constexpr double kContactMm = 2.0 * kGridMm;
// More loops than this are scribble.
constexpr std::size_t kMostLoops = 256;
// So much work for one outline: edges that are looked at, over all loops.
constexpr std::size_t kMostWork = 400'000;
// Longer borders are worth an index.
constexpr std::size_t kFewEdges = 256;

void drop_doubled(Border& border) {
    std::vector<BorderEdge> kept;
    for (const BorderEdge& edge : border.edges) {
        if (!kept.empty() && distance(kept.back().from, edge.from) < kSameMm) {
            // The short edge before goes; this one begins where that did.
            BorderEdge& last = kept.back();
            const Vec2 from = last.from;
            const bool joined = last.curve == edge.curve && last.curve >= 0 && last.t1 == edge.t0;
            const double t0 = joined ? last.t0 : edge.t0;
            last = edge;
            last.from = from;
            last.t0 = t0;
            continue;
        }
        kept.push_back(edge);
    }
    while (kept.size() > 1 && distance(kept.back().from, kept.front().from) < kSameMm) kept.pop_back();
    border.edges = std::move(kept);
}

// Takes out corners at which the line goes back the way it came; true when there was one.
bool drop_spikes(Border& border) {
    bool any = false;
    for (std::size_t i = 0; i < border.edges.size() && border.edges.size() >= 3;) {
        const std::size_t n = border.edges.size();
        const std::size_t before = (i + n - 1) % n;
        const Vec2 a = border.edges[before].from;
        const Vec2 b = border.edges[i].from;
        const Vec2 c = border.edges[border.next(i)].from;
        const bool back = dot(b - a, c - b) < 0.0 && (distance(c, Segment{a, b}) <= kContactMm ||
                                                      distance(a, Segment{b, c}) <= kContactMm);
        if (!back) {
            ++i;
            continue;
        }
        border.edges[before].curve = -1;
        border.edges.erase(border.edges.begin() + static_cast<std::ptrdiff_t>(i));
        any = true;
        i = i < 2 ? 0 : i - 2;
    }
    if (any) drop_doubled(border);
    return any;
}

Vec2 on_edge(const Border& border, std::size_t i, double along) {
    const BorderEdge& edge = border.edges[i];
    const Segment chord = border.chord(i);
    if (edge.curve < 0) return lerp(chord.a, chord.b, along);
    return border.cubics[static_cast<std::size_t>(edge.curve)].at(edge.t0 + along * (edge.t1 - edge.t0));
}

// Where two edges meet: how far along each, from 0 to 1.
struct Contact {
    std::size_t i = 0, j = 0;
    double along_i = 0.0, along_j = 0.0;
    Vec2 at;
};

double along_of(const Segment& s, Vec2 p) {
    const Vec2 way = s.b - s.a;
    return std::clamp(dot(way, p - s.a) / dot(way, way), 0.0, 1.0);
}

// Moves a crossing of two chords to that of the curves that they stand for, if that is near.
void refine(const Border& border, Contact& contact) {
    if (border.edges[contact.i].curve < 0 && border.edges[contact.j].curve < 0) return;
    constexpr double kStep = 1e-6;
    double u = contact.along_i;
    double v = contact.along_j;
    for (int round = 0; round < 20; ++round) {
        const Vec2 off = on_edge(border, contact.j, v) - on_edge(border, contact.i, u);
        const Vec2 du =
            (0.5 / kStep) * (on_edge(border, contact.i, u + kStep) - on_edge(border, contact.i, u - kStep));
        const Vec2 dv =
            (0.5 / kStep) * (on_edge(border, contact.j, v + kStep) - on_edge(border, contact.j, v - kStep));
        const double below = cross(du, dv);
        if (below == 0.0) return;
        u += cross(off, dv) / below;
        v += cross(off, du) / below;
        if (!(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0)) return;
        const Vec2 at = on_edge(border, contact.i, u);
        if (distance(at, on_edge(border, contact.j, v)) < 1e-10) {
            contact.along_i = u;
            contact.along_j = v;
            contact.at = at;
            return;
        }
    }
}

std::optional<Contact> contact_of(const Border& border, std::size_t i, std::size_t j) {
    const Segment a = border.chord(i);
    const Segment b = border.chord(j);
    if (distance(a, b) > kContactMm) return std::nullopt;
    Contact contact{i, j, 0.0, 0.0, {}};
    // An end of one on the other.
    for (const Vec2 p : {a.a, a.b, b.a, b.b}) {
        if (distance(p, a) > kContactMm || distance(p, b) > kContactMm) continue;
        contact.at = p;
        contact.along_i = along_of(a, p);
        contact.along_j = along_of(b, p);
        return contact;
    }
    const double below = cross(a.b - a.a, b.b - b.a);
    contact.along_i = below == 0.0 ? 0.5 : std::clamp(cross(b.a - a.a, b.b - b.a) / below, 0.0, 1.0);
    contact.at = lerp(a.a, a.b, contact.along_i);
    contact.along_j = along_of(b, contact.at);
    refine(border, contact);
    return contact;
}

// All pairs of edges whose boxes come near each other, the lower number first, each once.
template <typename Visit>
void near_pairs(const Border& border, const Visit& visit) {
    const std::size_t n = border.edges.size();
    std::vector<Box> boxes(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Segment s = border.chord(i);
        for (const Vec2 p : {s.a, s.b}) boxes[i].extend(p);
        boxes[i].min = boxes[i].min - Vec2{kContactMm, kContactMm};
        boxes[i].max = boxes[i].max + Vec2{kContactMm, kContactMm};
    }
    const auto apart = [&](std::size_t i, std::size_t j) { return !touch(boxes[i], boxes[j]); };
    if (n <= kFewEdges) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = i + 2; j < n; ++j) {
                if (!apart(i, j)) visit(i, j);
            }
        }
        return;
    }
    std::vector<Segment> chords;
    for (std::size_t i = 0; i < n; ++i) chords.push_back(border.chord(i));
    const EdgeIndex index({}, chords);
    std::vector<int> found;
    for (std::size_t i = 0; i < n; ++i) {
        found.clear();
        index.query(boxes[i], found);
        for (const int j : found) {
            if (static_cast<std::size_t>(j) > i + 1) visit(i, static_cast<std::size_t>(j));
        }
    }
}

// The first contact along the line, of edges that are no neighbours.
std::optional<Contact> first_contact(const Border& border) {
    const std::size_t n = border.edges.size();
    std::optional<Contact> first;
    near_pairs(border, [&](std::size_t i, std::size_t j) {
        if ((i == 0 && j == n - 1) || (first && first->i < i)) return;
        const auto contact = contact_of(border, i, j);
        if (contact &&
            (!first || std::tuple(i, contact->along_i, j) < std::tuple(first->i, first->along_i, first->j)))
            first = contact;
    });
    return first;
}

double doubled_area(const Border& border) {
    double sum = 0.0;
    const Vec2 origin = border.edges.empty() ? Vec2{} : border.edges.front().from;
    for (std::size_t i = 0; i < border.edges.size(); ++i) {
        const Segment s = border.chord(i);
        sum += cross(s.a - origin, s.b - origin);
    }
    return sum;
}

// From the contact along the line to the contact again: `behind` it, or before.
Border loop_at(const Border& border, const Contact& contact, bool behind) {
    Border loop;
    loop.cubics = border.cubics;
    const std::size_t first = behind ? contact.i : contact.j;
    const std::size_t last = behind ? contact.j : contact.i;
    const auto middle = [&](std::size_t edge, double along) {
        const BorderEdge& e = border.edges[edge];
        return e.t0 + along * (e.t1 - e.t0);
    };
    BorderEdge begin = border.edges[first];
    begin.from = contact.at;
    begin.t0 = middle(first, behind ? contact.along_i : contact.along_j);
    loop.edges.push_back(begin);
    for (std::size_t i = border.next(first);; i = border.next(i)) {
        loop.edges.push_back(border.edges[i]);
        if (i == last) break;
    }
    loop.edges.back().t1 = middle(last, behind ? contact.along_j : contact.along_i);
    drop_doubled(loop);
    return loop;
}

DroppedLoop dropped_loop(const Border& loop, Vec2 at) {
    Box box;
    for (const BorderEdge& edge : loop.edges) box.extend(edge.from);
    // It may cross itself in turn.
    const double enclosed = area(filled({ring_of(loop)}, FillRule::even_odd));
    return {at, enclosed, std::max(box.width(), box.height())};
}

}  // namespace

FlatteningFault border_of(const Subpath& subpath, Border& into) {
    into = {};
    Vec2 at = subpath.start;
    const auto add = [&](const Polyline& line, const FlatCurve* curve) {
        if (curve != nullptr) into.cubics.push_back(curve->cubic);
        const int number = curve != nullptr ? static_cast<int>(into.cubics.size()) - 1 : -1;
        if (curve == nullptr) {
            for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
                into.edges.push_back({line.points[i], -1, 0.0, 0.0});
            return;
        }
        for (std::size_t i = 0; i + 1 < curve->corners.size(); ++i) {
            const FlatCurve::Corner& corner = curve->corners[i];
            into.edges.push_back({corner.at, number, corner.t, curve->corners[i + 1].t});
        }
    };
    std::size_t points = 0;
    for (const PathStep& step : subpath.steps) {
        Path one;
        one.move(at);
        if (step.curve)
            one.cubic(step.control_1, step.control_2, step.to);
        else
            one.line(step.to);
        Flattened flat;
        if (const FlatteningFault fault = flatten(one, flat); fault != FlatteningFault::none) return fault;
        points += flat.points;
        if (points > kFlatPointsLimit) return FlatteningFault::too_many;
        if (!flat.lines.empty()) add(flat.lines.front(), flat.curves.empty() ? nullptr : flat.curves.data());
        at = step.to;
    }
    if (!into.edges.empty()) into.edges.push_back({on_grid(at), -1, 0.0, 0.0});
    drop_doubled(into);
    return FlatteningFault::none;
}

Ring ring_of(const Border& border) {
    Ring ring;
    ring.reserve(border.edges.size());
    for (const BorderEdge& edge : border.edges) ring.push_back(edge.from);
    return ring;
}

void reverse(Border& border) {
    const std::vector<BorderEdge> old = border.edges;
    const std::size_t n = old.size();
    for (std::size_t i = 0; i < n; ++i) {
        // The edge that ended here goes the other way.
        const BorderEdge& back = old[(n - 1 - i + n - 1) % n];
        border.edges[i] = {old[n - 1 - i].from, back.curve, back.t1, back.t0, back.of};
    }
}

std::vector<FlatCurve> curves_of(std::span<const Border> borders) {
    std::vector<FlatCurve> made;
    if (borders.empty()) return made;
    for (const Cubic& cubic : borders.front().cubics) made.push_back({cubic, {}});
    for (const Border& border : borders) {
        for (std::size_t i = 0; i < border.edges.size(); ++i) {
            const BorderEdge& edge = border.edges[i];
            if (edge.curve < 0) continue;
            auto& corners = made[static_cast<std::size_t>(edge.curve)].corners;
            const Segment chord = border.chord(i);
            corners.push_back({chord.a, edge.t0});
            corners.push_back({chord.b, edge.t1});
        }
    }
    for (FlatCurve& curve : made) {
        const auto key = [](const FlatCurve::Corner& c) { return std::tuple(c.t, c.at.x, c.at.y); };
        std::sort(curve.corners.begin(), curve.corners.end(),
                  [&](const auto& a, const auto& b) { return key(a) < key(b); });
        const auto same = [](const FlatCurve::Corner& a, const FlatCurve::Corner& b) {
            return a.t == b.t && a.at == b.at;
        };
        curve.corners.erase(std::unique(curve.corners.begin(), curve.corners.end(), same),
                            curve.corners.end());
    }
    std::erase_if(made, [](const FlatCurve& curve) { return curve.corners.size() < 2; });
    return made;
}

Path path_of(const Border& border) {
    Path path;
    const std::size_t n = border.edges.size();
    if (n == 0) return path;
    const auto goes_on = [&](std::size_t i) {
        const BorderEdge& a = border.edges[i];
        const BorderEdge& b = border.edges[border.next(i)];
        return a.curve >= 0 && a.curve == b.curve && a.t1 == b.t0;
    };
    // It begins where no curve goes on, if there is such a place.
    std::size_t first = 0;
    while (first < n && goes_on((first + n - 1) % n)) ++first;
    if (first == n) first = 0;
    path.move(border.edges[first].from);
    for (std::size_t done = 0; done < n;) {
        const std::size_t begin = (first + done) % n;
        std::size_t end = begin;
        ++done;
        while (done < n && goes_on(end)) {
            end = border.next(end);
            ++done;
        }
        const BorderEdge& edge = border.edges[begin];
        const Vec2 to = border.edges[border.next(end)].from;
        if (edge.curve < 0) {
            path.line(to);
            continue;
        }
        const Cubic part =
            border.cubics[static_cast<std::size_t>(edge.curve)].part(edge.t0, border.edges[end].t1);
        path.cubic(part.control_1 + (edge.from - part.from), part.control_2 + (to - part.to), to);
    }
    path.close();
    return path;
}

std::optional<TightSpot> tightest(const Border& border) {
    std::optional<TightSpot> best;
    for (const BorderEdge& edge : border.edges) {
        if (edge.curve < 0) continue;
        const Cubic& c = border.cubics[static_cast<std::size_t>(edge.curve)];
        for (const double along : {0.0, 0.5, 1.0}) {
            const double t = edge.t0 + along * (edge.t1 - edge.t0);
            const double s = 1.0 - t;
            const Vec2 first =
                3.0 * (s * s * (c.control_1 - c.from) + 2.0 * s * t * (c.control_2 - c.control_1) +
                       t * t * (c.to - c.control_2));
            const Vec2 second = 6.0 * (s * (c.control_2 - 2.0 * c.control_1 + c.from) +
                                       t * (c.to - 2.0 * c.control_2 + c.control_1));
            const double bend = std::abs(cross(first, second));
            const double speed = length(first);
            if (bend == 0.0) continue;
            const double radius = speed * speed * speed / bend;
            if (!best || radius < best->radius_mm) best = TightSpot{radius, c.at(t)};
        }
    }
    return best;
}

LoopRepair without_loops(Border& border) {
    LoopRepair repair;
    drop_doubled(border);
    drop_spikes(border);
    std::size_t work = border.edges.size();
    while (border.edges.size() >= 3) {
        const auto contact = first_contact(border);
        if (!contact) break;
        work += border.edges.size();
        if (repair.dropped.size() >= kMostLoops || work > kMostWork) {
            repair.hopeless = true;
            break;
        }
        Border behind = loop_at(border, *contact, true);
        Border before = loop_at(border, *contact, false);
        const bool keep_behind = std::abs(doubled_area(behind)) > std::abs(doubled_area(before));
        repair.dropped.push_back(dropped_loop(keep_behind ? before : behind, contact->at));
        border = keep_behind ? std::move(behind) : std::move(before);
        drop_spikes(border);
    }
    if (doubled_area(border) < 0.0) reverse(border);
    return repair;
}

}  // namespace popup
