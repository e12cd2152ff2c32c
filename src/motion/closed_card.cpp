#include "motion/closed_card.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "base/geometry/hull.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "motion/cells.h"
#include "motion/nearness.h"

namespace popup {
namespace {

constexpr double kOutMm = 0.02;     // as far as a drawing may be rounded
constexpr double kHeightMm = 1e-9;  // plates closer than this at the smallest angle are not told apart
constexpr double kAreaMm2 = 1e-6;
constexpr double kCountStepsPerMm = 1e3;  // to which points are rounded where layers are counted
constexpr double kCountStepMm = 1e-3;
constexpr std::size_t kMostWork = 100'000'000;  // triangles seen over one another

// The closed card seen from the side: x away from the gutter, y along it; `up` from the left cover to the
// right one.
struct ClosedPlane {
    Vec3 origin, x, y, up;

    [[nodiscard]] Vec2 flat(Vec3 p) const { return {dot(p - origin, x), dot(p - origin, y)}; }
    [[nodiscard]] Vec3 direction(Vec2 d) const { return d.x * x + d.y * y; }
    [[nodiscard]] Vec3 in_world(Vec2 p) const { return origin + direction(p); }
};

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

// What two convex shapes have in common: the one cut by each edge of the other, which runs counter-clockwise.
void clip(const Triangle2& by, std::vector<Vec2>& shape, std::vector<Vec2>& spare) {
    for (std::size_t i = 0; i < 3 && !shape.empty(); ++i) {
        const Vec2 from = by.at(i);
        const Vec2 along = by.at((i + 1) % 3) - from;
        spare.clear();
        for (std::size_t k = 0; k < shape.size(); ++k) {
            const Vec2 p = shape[k];
            const Vec2 q = shape[(k + 1) % shape.size()];
            const double hp = cross(along, p - from);
            const double hq = cross(along, q - from);
            if (hp >= 0.0) spare.push_back(p);
            if ((hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0)) spare.push_back(lerp(p, q, hp / (hp - hq)));
        }
        std::swap(shape, spare);
    }
}

// Whether the second triangle lies beside an edge of the first, which runs counter-clockwise: then they have
// no area in common, and most that are near each other have none.
bool beside(const Triangle2& first, const Triangle2& second) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 from = first.at(i);
        const Vec2 along = first.at((i + 1) % 3) - from;
        if (cross(along, second[0] - from) <= 0.0 && cross(along, second[1] - from) <= 0.0 &&
            cross(along, second[2] - from) <= 0.0)
            return true;
    }
    return false;
}

// How many of some boxes can lie over a point: those that touch its square of a grid.
class BoxCounts {
 public:
    explicit BoxCounts(const EdgeIndex& diagonals) {
        Box all;
        for (int i = 0; i < diagonals.size(); ++i) {
            all.extend(diagonals[i].a);
            all.extend(diagonals[i].b);
        }
        if (all.empty()) return;
        const double squares = kSquares * (diagonals.size() + 1);
        origin_ = all.min;
        side_ =
            std::max(std::sqrt(all.width() * all.height() / squares), (all.width() + all.height()) / squares);
        if (!(side_ > 0.0)) side_ = 1.0;
        columns_ = static_cast<std::size_t>(all.width() / side_) + 1;
        rows_ = static_cast<std::size_t>(all.height() / side_) + 1;
        // Each box adds one at its lower left square and takes it away beside it and above it; the sums from
        // the lower left are the counts.
        const std::size_t wide = columns_ + 1;
        std::vector<int> steps(wide * (rows_ + 1), 0);
        for (int i = 0; i < diagonals.size(); ++i) {
            const auto [low, high] = squares_of({diagonals[i].a, diagonals[i].b});
            ++steps[low.row * wide + low.column];
            --steps[low.row * wide + high.column + 1];
            --steps[(high.row + 1) * wide + low.column];
            ++steps[(high.row + 1) * wide + high.column + 1];
        }
        counts_.assign(columns_ * rows_, 0);
        for (std::size_t row = 0; row < rows_; ++row) {
            int sum = 0;
            for (std::size_t column = 0; column < columns_; ++column) {
                sum += steps[row * wide + column];
                counts_[row * columns_ + column] =
                    sum + (row > 0 ? counts_[(row - 1) * columns_ + column] : 0);
            }
        }
    }

    // No point of the box has more boxes over it.
    [[nodiscard]] int most(const Box& box) const {
        if (counts_.empty()) return 0;
        const auto [low, high] = squares_of(box);
        int most = 0;
        for (std::size_t row = low.row; row <= high.row; ++row) {
            for (std::size_t column = low.column; column <= high.column; ++column)
                most = std::max(most, counts_[row * columns_ + column]);
        }
        return most;
    }

 private:
    static constexpr double kSquares = 64.0;  // for each box
    struct Square {
        std::size_t column, row;
    };
    [[nodiscard]] static std::size_t strip(double at, double side, std::size_t count) {
        const double n = at / side;
        return n > 0.0 ? std::min(static_cast<std::size_t>(n), count - 1) : 0;
    }
    [[nodiscard]] Square square_of(Vec2 p) const {
        return {strip(p.x - origin_.x, side_, columns_), strip(p.y - origin_.y, side_, rows_)};
    }
    [[nodiscard]] std::pair<Square, Square> squares_of(const Box& box) const {
        return {square_of(box.min), square_of(box.max)};
    }

    Vec2 origin_;
    double side_ = 1.0;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<int> counts_;
};

bool before(Vec2 p, Vec2 q) { return std::tie(p.x, p.y) < std::tie(q.x, q.y); }

// Plates over one another, and how.
struct Overlap {
    int a, b;            // a < b
    double least, most;  // of b's height over a, as far as they say whether it is above or below
};

class Layers {
 public:
    Layers(const Assembly& assembly, std::span<const PlateShape> shapes, const ClosedPlane& plane)
        : shapes_(shapes), plane_(plane), frames_(assembly.plates.size()) {
        if (!place(assembly, Angle::degrees(least_opening(assembly.sweep)), frames_)) return;
        std::vector<Segment> diagonals;  // of the plates' boxes
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            Box box;
            for (const Vec2 p : shapes[i].hull) box.extend(plane_.flat(frames_[i].point(p)));
            if (box.empty()) box.extend({});
            diagonals.push_back({box.min, box.max});
        }
        boxes_ = EdgeIndex({}, diagonals);
        counts_ = BoxCounts(boxes_);
        for (const Frame& frame : frames_) {
            const Vec3 n = frame.normal();
            slopes_.push_back({dot(n, frame.origin - plane_.origin), dot(n, plane_.x), dot(n, plane_.y),
                               dot(n, plane_.up)});
        }
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            std::vector<Triangle2>& triangles = seen_.emplace_back(shapes[i].core.all());
            for (Triangle2& t : triangles) t = seen(t, frames_[i]);
        }
        look();
    }

    [[nodiscard]] const std::vector<Overlap>& overlaps() const { return overlaps_; }
    [[nodiscard]] std::span<const Frame> frames() const { return frames_; }
    [[nodiscard]] int most() const { return most_; }
    [[nodiscard]] Vec2 thickest() const { return thickest_; }

 private:
    // Height of a plate over the middle of the card, from the left cover towards the right one.
    [[nodiscard]] double height(int plate, Vec2 p) const {
        const Slope& s = slopes_[static_cast<std::size_t>(plate)];
        return (s.at_origin - s.along_y * p.y - s.along_x * p.x) / s.up;
    }

    [[nodiscard]] Vec3 over(Vec2 p, double height) const { return plane_.in_world(p) + height * plane_.up; }

    // A triangle of a plate, seen from the side, counter-clockwise.
    [[nodiscard]] Triangle2 seen(const Triangle2& t, const Frame& frame) const {
        Triangle2 result{plane_.flat(frame.point(t[0])), plane_.flat(frame.point(t[1])),
                         plane_.flat(frame.point(t[2]))};
        if (cross(result[1] - result[0], result[2] - result[0]) < 0.0) std::swap(result[1], result[2]);
        return result;
    }

    void look() {
        std::vector<int> near;
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            if (!seen_[i].empty()) {
                const Triangle2& first = seen_[i][0];
                if (!count(1.0 / 3.0 * (first[0] + first[1] + first[2]))) return;
            }
            const Segment& diagonal = boxes_[static_cast<int>(i)];
            boxes_.query({diagonal.a, diagonal.b}, near);
            for (const int other : near) {
                if (static_cast<std::size_t>(other) > i && !look_at(i, static_cast<std::size_t>(other)))
                    return;
            }
        }
    }

    // What two plates have over one another: the triangles of the one with fewer, looked up among the
    // other's.
    bool look_at(std::size_t a, std::size_t b) {
        const bool a_has_more = shapes_[a].core.all().size() > shapes_[b].core.all().size();
        const std::size_t few = a_has_more ? b : a;
        const std::size_t many = a_has_more ? a : b;
        for (std::size_t n = 0; n < seen_[few].size(); ++n) {
            const Triangle2& t = shapes_[few].core.all()[n];
            const Triangle2& by = seen_[few][n];
            if (tells_nothing_new(static_cast<int>(a), static_cast<int>(b), by)) continue;
            Box box;
            for (const Vec2 p : t) {
                // Seen square to the other plate and from the side differs by less than this.
                const Vec2 there = on_page(frames_[many], frames_[few].point(p));
                box.extend(there - Vec2{kTouchMm, kTouchMm});
                box.extend(there + Vec2{kTouchMm, kTouchMm});
            }
            shapes_[many].core.query(box, found_);
            if (too_much(1 + found_.size())) return false;
            for (const int number : found_) {
                const Triangle2& other = seen_[many][static_cast<std::size_t>(number)];
                if (beside(by, other) || beside(other, by)) continue;
                shape_.assign(other.begin(), other.end());
                clip(by, shape_, spare_);
                if (shape_.size() < 3 || std::abs(signed_area(shape_)) < kAreaMm2) continue;
                if (!meet(static_cast<int>(a), static_cast<int>(b), shape_,
                          {by[0], by[1], by[2], other[0], other[1], other[2]}))
                    return false;
            }
        }
        return true;
    }

    // Adds to the work done; gives up when it was too much.
    bool too_much(std::size_t done) {
        work_ += done;
        if (work_ <= kMostWork) return false;
        overlaps_.clear();
        most_ = 0;
        thickest_ = {};
        return true;
    }

    // What is known already of how b lies over a.
    Overlap& overlap_of(int a, int b) {
        if (overlaps_.empty() || overlaps_.back().a != a || overlaps_.back().b != b)
            overlaps_.push_back({a, b, HUGE_VAL, -HUGE_VAL});
        return overlaps_.back();
    }

    // Whether nothing that both plates have over this triangle changes which lies over which, or how many
    // layers there are at most. So it is with nearly all triangles.
    [[nodiscard]] bool tells_nothing_new(int a, int b, const Triangle2& seen) const {
        if (overlaps_.empty() || overlaps_.back().a != a || overlaps_.back().b != b) return false;
        const Overlap& known = overlaps_.back();
        Box box;
        for (const Vec2 p : seen) {
            const double over = height(b, p) - height(a, p);
            if (over > kHeightMm && known.most <= kHeightMm) return false;
            if (over < -kHeightMm && known.least >= -kHeightMm) return false;
            box.extend(p - Vec2{kCountStepMm, kCountStepMm});
            box.extend(p + Vec2{kCountStepMm, kCountStepMm});
        }
        return !may_be_thickest(box);
    }

    // Adds the corners of what triangles of both plates have in common. False: it was too much work.
    bool meet(int a, int b, const std::vector<Vec2>& shape, const std::array<Vec2, 6>& corners) {
        Overlap& overlap = overlap_of(a, b);
        Vec2 centre;
        for (const Vec2 p : shape) {
            const double over = height(b, p) - height(a, p);
            overlap.least = std::min(overlap.least, over);
            overlap.most = std::max(overlap.most, over);
            centre = centre + (1.0 / static_cast<double>(shape.size())) * p;
        }
        // Where most plates lie over one another is a region with a corner at which the outline of one of two
        // plates has a corner or the outlines of both cross. Edges between triangles count for nothing.
        for (const Vec2 p : shape) {
            const Vec2 inside = lerp(p, centre, 1e-2);
            if (!may_be_thickest(
                    {inside - Vec2{kCountStepMm, kCountStepMm}, inside + Vec2{kCountStepMm, kCountStepMm}}))
                continue;
            const bool corner = std::any_of(corners.begin(), corners.end(), [p](Vec2 q) {
                return dot(p - q, p - q) < kSameCornerMm * kSameCornerMm;
            });
            if ((corner || (by_outline(a, p) && by_outline(b, p))) && !count(inside)) return false;
        }
        return true;
    }

    [[nodiscard]] bool by_outline(int plate, Vec2 p) const {
        const auto i = static_cast<std::size_t>(plate);
        const Vec2 there = on_page(frames_[i], over(p, height(plate, p)));
        return shapes_[i].edges.is_within(there, 3.0 * kTouchMm);
    }

    // Of points with as many layers the first one counts, from the gutter outwards.
    [[nodiscard]] bool may_be_thickest(const Box& box) const {
        const int most = counts_.most(box);
        return most > most_ || (most == most_ && !before(thickest_, box.min));
    }

    // Counts the layers over a point, which is rounded to a thousandth of a millimetre. False: it was too
    // much work.
    bool count(Vec2 p) {
        p = kCountStepMm * Vec2{std::round(p.x * kCountStepsPerMm), std::round(p.y * kCountStepsPerMm)};
        const int least = most_ > 0 && before(p, thickest_) ? most_ : most_ + 1;
        boxes_.query({p, p}, here_);
        if (too_much(here_.size())) return false;
        int layers = static_cast<int>(here_.size());
        for (const int plate : here_) {
            if (layers < least) return true;
            const auto i = static_cast<std::size_t>(plate);
            if (!shapes_[i].covers(on_page(frames_[i], over(p, height(plate, p))))) --layers;
        }
        if (layers < least) return true;
        most_ = layers;
        thickest_ = p;
        return true;
    }

    // Of a plate: its height over the middle of the card is (at_origin - along_x x - along_y y) / up.
    struct Slope {
        double at_origin, along_x, along_y, up;
    };

    std::span<const PlateShape> shapes_;
    std::vector<std::vector<Triangle2>> seen_;  // of each shape's core
    ClosedPlane plane_;
    std::vector<Frame> frames_;
    std::vector<Slope> slopes_;  // by plate
    EdgeIndex boxes_;
    BoxCounts counts_{boxes_};
    std::vector<int> here_, found_;
    std::vector<Vec2> shape_, spare_;
    std::vector<Overlap> overlaps_;  // of each two plates that have one, in order
    std::size_t work_ = 0;
    int most_ = 0;
    Vec2 thickest_;
};

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

ClosedCard closed_card(const Assembly& assembly, std::span<const PlateShape> shapes,
                       std::optional<double> paper_mm) {
    ClosedCard card;
    const ClosedPlane plane = closed_plane(assembly);
    card.protrusions = protrusions(assembly, plane);
    const Layers layers(assembly, shapes, plane);
    card.max_layers = layers.most();
    card.thickest = plane.in_world(layers.thickest());
    if (card.max_layers == 0) return card;
    put_in_order(assembly.plates.size(), layers.overlaps(), GluedFlat(assembly, layers.frames(), plane),
                 card);
    if (paper_mm) card.thickness_mm = card.max_layers * *paper_mm;
    return card;
}

}  // namespace popup
