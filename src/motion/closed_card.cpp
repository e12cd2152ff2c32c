#include "motion/closed_card.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "base/geometry/hull.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "motion/layers.h"

namespace popup {
namespace {

constexpr double kOutMm = 0.02;  // as far as a drawing may be rounded

// The plane of the first cover at the beginning of the sweep.
ClosedPlane closed_plane(const Assembly& assembly) {
    std::vector<Frame> frames(assembly.plates.size());
    if (!place(assembly, Angle::degrees(assembly.sweep.from_deg), frames)) return {};
    const auto first = static_cast<std::size_t>(assembly.covers.at(0));
    const Vec3 up = frames[first].normal();
    const Vec3 y = frames[first].axes[1];
    return {frames[first].origin, cross(up, y), y, up};
}

Vec2 nearest_on(const std::vector<Segment>& edges, Vec2 p) {
    Vec2 best = p;
    double least = HUGE_VAL;
    for (const Segment& edge : edges) {
        const Vec2 d = edge.b - edge.a;
        const double t = std::clamp(dot(p - edge.a, d) / dot(d, d), 0.0, 1.0);
        const Vec2 at = lerp(edge.a, edge.b, t);
        if (distance(at, p) < least) {
            least = distance(at, p);
            best = at;
        }
    }
    return best;
}

std::vector<Protrusion> protrusions(const Assembly& assembly, const ClosedPlane& plane) {
    std::vector<Frame> frames(assembly.plates.size());
    if (!place(assembly, Angle::degrees(assembly.sweep.from_deg), frames)) return {};
    const auto flattened = [&](std::size_t plate, const Ring& ring) {
        Ring result;
        for (const Vec2 p : ring) result.push_back(plane.flat(frames[plate].point(p)));
        return result;
    };
    std::vector<Polygon> covers;
    for (const int number : assembly.covers) {
        const auto plate = static_cast<std::size_t>(number);
        const Plate& cover = assembly.plates[plate];
        covers.push_back({flattened(plate, cover.uncut.empty() ? cover.outline.outer : cover.uncut), {}});
    }
    const std::vector<Polygon> card = unite(covers);
    if (card.empty()) return {};
    std::vector<Segment> edges;
    for (const Polygon& part : card) {
        for (const Segment& edge : edges_of(part)) edges.push_back(edge);
    }
    // A plate's furthest point from a convex card is a corner. Over a bay of the card it need not be.
    const bool convex = card.size() == 1 && card[0].holes.empty() &&
                        convex_hull(card[0].outer).size() == card[0].outer.size();
    const auto on_card = [&](Vec2 p) {
        return std::any_of(card.begin(), card.end(), [p](const Polygon& part) { return contains(part, p); });
    };
    std::vector<Protrusion> result;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Frame& frame = frames[i];
        std::vector<Ring> outside{flattened(i, reach_of(assembly.plates[i]).outer)};
        if (!convex) {
            std::vector<Ring> rings;
            for (const Polygon& part : subtract({{outside[0], {}}}, card)) rings.push_back(part.outer);
            outside = std::move(rings);
        }
        Protrusion most;
        most.plate = static_cast<int>(i);
        for (const Ring& ring : outside) {
            for (const Vec2 p : ring) {
                if (on_card(p)) continue;
                const Vec2 edge = nearest_on(edges, p);
                const double by = distance(p, edge);
                if (by <= most.by_mm) continue;
                most.by_mm = by;
                most.direction = plane.direction((1.0 / by) * (p - edge));
                most.point = plane.in_world(p);
                const Vec3 from_origin = most.point - frame.origin;
                most.corner = {dot(frame.axes[0], from_origin), dot(frame.axes[1], from_origin)};
            }
        }
        if (most.by_mm > kOutMm) result.push_back(most);
    }
    return result;
}

// Plates that are glued flat on one another have one height. How they were glued says which lies over which:
// those on a front further up the later they were glued, those on a back further down.
class GluedFlat {
 public:
    GluedFlat(const Assembly& assembly, std::span<const Frame> frames, const ClosedPlane& plane) {
        const std::size_t plates = assembly.plates.size();
        body_.resize(plates);
        for (std::size_t i = 0; i < plates; ++i) body_[i] = static_cast<int>(i);
        lift_.assign(plates, 0.0);
        for (const Frame& frame : frames) front_.push_back(dot(frame.normal(), plane.up) < 0.0 ? -1.0 : 1.0);
        double glued = 0.0;
        for (const Joint& joint : assembly.joints) {
            for (const PlacedPlate& one : plates_of(joint).places) {
                if (one.lying == Lying::free || one.lying == Lying::beside) continue;
                const auto plate = static_cast<std::size_t>(one.plate);
                const auto parent = static_cast<std::size_t>(one.parent);
                body_[plate] = body_[parent];
                const double way = one.lying == Lying::on_front ? front_[parent] : -front_[parent];
                // On the glued side of a plate there is only the room up to what that is glued to.
                const bool outwards = way * lift_[parent] >= 0.0;
                lift_[plate] = outwards ? way * ++glued : lift_[parent] + 0.5 * way;
            }
        }
    }
    // Of b over a, in no unit; 0: they are not of one body.
    [[nodiscard]] double height(int a, int b) const {
        const auto i = static_cast<std::size_t>(a);
        const auto k = static_cast<std::size_t>(b);
        return body_[i] == body_[k] ? lift_[k] - lift_[i] : 0.0;
    }

 private:
    std::vector<int> body_;      // of each plate: the one that all of them lie on
    std::vector<double> lift_;   // over that one
    std::vector<double> front_;  // +1: the plate's front is its upper side
};

// Orders the plates, those below first and else by number; when that is impossible, names a cycle.
void put_in_order(std::size_t plates, const std::vector<Overlap>& overlaps, const GluedFlat& glued,
                  ClosedCard& card) {
    std::vector<std::vector<int>> above(plates);
    std::vector<std::vector<int>> below(plates);
    for (const Overlap& one : overlaps) {
        const double flat = glued.height(one.a, one.b);
        const bool b_over_a = one.most > kHeightMm || flat > 0.0;
        const bool a_over_b = one.least < -kHeightMm || flat < 0.0;
        if (b_over_a && a_over_b) {
            card.cycle = {one.a, one.b};
            return;
        }
        if (!b_over_a && !a_over_b) continue;
        const int low = b_over_a ? one.a : one.b;
        const int high = b_over_a ? one.b : one.a;
        above[static_cast<std::size_t>(low)].push_back(high);
        below[static_cast<std::size_t>(high)].push_back(low);
    }
    std::vector<std::size_t> waiting(plates);
    std::priority_queue<int, std::vector<int>, std::greater<>> free;
    for (std::size_t i = 0; i < plates; ++i) {
        waiting[i] = below[i].size();
        if (waiting[i] == 0) free.push(static_cast<int>(i));
    }
    std::vector<int> order;
    while (!free.empty()) {
        const int plate = free.top();
        free.pop();
        order.push_back(plate);
        for (const int next : above[static_cast<std::size_t>(plate)]) {
            if (--waiting[static_cast<std::size_t>(next)] == 0) free.push(next);
        }
    }
    if (order.size() == plates) {
        card.order = std::move(order);
        return;
    }
    // Going down from a plate that still waits for one that does, one comes by the same plate twice.
    std::size_t at = 0;
    while (waiting[at] == 0) ++at;
    std::vector<int> seen(plates, -1);
    std::vector<int> path;
    while (seen[at] < 0) {
        seen[at] = static_cast<int>(path.size());
        path.push_back(static_cast<int>(at));
        for (const int next : below[at]) {
            if (waiting[static_cast<std::size_t>(next)] == 0) continue;
            at = static_cast<std::size_t>(next);
            break;
        }
    }
    card.cycle.assign(path.begin() + seen[at], path.end());
    std::reverse(card.cycle.begin(), card.cycle.end());
    std::rotate(card.cycle.begin(), std::min_element(card.cycle.begin(), card.cycle.end()), card.cycle.end());
}

}  // namespace

std::vector<Protrusion> find_protrusions(const Assembly& assembly) {
    return protrusions(assembly, closed_plane(assembly));
}

ClosedCard closed_card(const Assembly& assembly, std::span<const PlateShape> shapes,
                       std::optional<double> paper_mm, Recall* recall) {
    ClosedCard card;
    const ClosedPlane plane = closed_plane(assembly);
    card.protrusions = protrusions(assembly, plane);
    const Layers layers = look_at_layers(assembly, shapes, plane, recall);
    card.max_layers = layers.most;
    card.thickest = plane.in_world(layers.thickest);
    if (card.max_layers == 0) return card;
    put_in_order(assembly.plates.size(), layers.overlaps, GluedFlat(assembly, layers.frames, plane), card);
    if (paper_mm) card.thickness_mm = card.max_layers * *paper_mm;
    return card;
}

}  // namespace popup
