#include "base/geometry/regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <polyclipping/clipper.hpp>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/tolerances.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

// The cosecant of half the sharpest angle that keeps its corner.
constexpr double kMitreLimit = 4.0;

IntPoint to_int(Vec2 p) {
    POPUP_INVARIANT(std::abs(p.x) <= kRangeMm && std::abs(p.y) <= kRangeMm);
    return {std::llround(p.x * kPerMm), std::llround(p.y * kPerMm)};
}

Vec2 to_mm(const IntPoint& p) {
    return {static_cast<double>(p.X) / kPerMm, static_cast<double>(p.Y) / kPerMm};
}

// The corners of a ring of which nothing but the box is asked: without those whose neighbours lie beside the
// box on the same side as they do. What runs there goes straight on there, so that it goes round every point
// of the box as often as before.
Path straight_outside(const Box& box, const Ring& ring) {
    const auto sides = [&box](Vec2 p) {
        return (p.x < box.min.x ? 1U : 0U) | (p.x > box.max.x ? 2U : 0U) | (p.y < box.min.y ? 4U : 0U) |
               (p.y > box.max.y ? 8U : 0U);
    };
    Path path;
    path.push_back(to_int(ring[0]));
    unsigned last = sides(ring[0]);
    unsigned here = sides(ring[1]);
    for (std::size_t i = 1; i < ring.size(); ++i) {
        const unsigned next = sides(ring[i + 1 == ring.size() ? 0 : i + 1]);
        if ((last & here & next) == 0) {
            path.push_back(to_int(ring[i]));
            last = here;
        }
        here = next;
    }
    return path;
}

// `seen`: nothing but this box is asked of the ring.
void add_ring(const Ring& ring, bool counter_clockwise, const Box* seen, Paths& paths) {
    if (ring.size() < 3) return;
    Path path;
    bool turns = false;
    if (seen != nullptr) {
        path = straight_outside(*seen, ring);
        if (path.size() < 3) return;
        turns = signed_area(ring) >= 0.0;
    } else {
        path.reserve(ring.size());
        for (const Vec2 p : ring) path.push_back(to_int(p));
        turns = ClipperLib::Orientation(path);
    }
    if (turns != counter_clockwise) std::reverse(path.begin(), path.end());
    paths.push_back(std::move(path));
}

Paths to_paths(const std::vector<Polygon>& regions, const Box* seen = nullptr) {
    Paths paths;
    for (const Polygon& region : regions) {
        add_ring(region.outer, true, seen, paths);
        for (const Ring& hole : region.holes) add_ring(hole, false, seen, paths);
    }
    return paths;
}

// Reaches a little beyond the regions, for rounding to the grid.
Box box_round(const std::vector<Polygon>& regions) {
    Box box;
    for (const Polygon& region : regions) {
        for (const Vec2 p : region.outer) box.extend(p);
    }
    const Vec2 rounding{2.0 * kGridMm, 2.0 * kGridMm};
    return {box.min - rounding, box.max + rounding};
}

bool before(const IntPoint& a, const IntPoint& b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; }
bool ring_before(const Path& a, const Path& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
}

Ring to_ring(const Path& path) {
    Ring ring;
    ring.reserve(path.size());
    for (const IntPoint& p : path) ring.push_back(to_mm(p));
    return ring;
}

// How far rounding to the grid may move what the clipper makes across another ring's edge, in steps.
constexpr int kRounding = 2;

// Whether an edge of the ring comes so near the point that rounding may have put the point on its wrong side.
bool comes_near(const IntPoint& p, const Path& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const IntPoint& a = ring[i];
        const IntPoint& b = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (p.X < std::min(a.X, b.X) - kRounding || p.X > std::max(a.X, b.X) + kRounding ||
            p.Y < std::min(a.Y, b.Y) - kRounding || p.Y > std::max(a.Y, b.Y) + kRounding) {
            continue;
        }
        const auto dx = static_cast<double>(b.X - a.X);
        const auto dy = static_cast<double>(b.Y - a.Y);
        const double off = dx * static_cast<double>(p.Y - a.Y) - dy * static_cast<double>(p.X - a.X);
        if (std::abs(off) <= kRounding * std::sqrt(dx * dx + dy * dy)) return true;
    }
    return false;
}

// Whether the hole lies in the outer ring, which has more area, given that the two cross by no more than
// rounding does. Its first corner that is not near the ring tells; where all are, the first that is not on it
// does.
bool lies_in(const Path& hole, const Path& outer) {
    std::optional<bool> likely;
    for (const IntPoint& p : hole) {
        const int where = ClipperLib::PointInPolygon(p, outer);
        if (where < 0) continue;
        if (!comes_near(p, outer)) return where > 0;
        if (!likely) likely = where > 0;
    }
    // Every corner is on the outer ring; it is the larger of the two, so the hole is inside.
    return likely.value_or(true);
}

struct GridBox {
    std::int64_t x0, y0, x1, y1;
};

GridBox box_of(const Path& path) {
    GridBox box{path[0].X, path[0].Y, path[0].X, path[0].Y};
    for (const IntPoint& p : path) {
        box = {std::min<std::int64_t>(box.x0, p.X), std::min<std::int64_t>(box.y0, p.Y),
               std::max<std::int64_t>(box.x1, p.X), std::max<std::int64_t>(box.y1, p.Y)};
    }
    return box;
}

// Gives every hole to the smallest outer ring around it. The library can do this itself, at a cost that grows
// with the square of the rings when edges are joined; here it is one search a hole.
std::vector<Polygon> to_polygons(Paths paths) {
    paths.erase(std::remove_if(paths.begin(), paths.end(), [](const Path& p) { return p.size() < 3; }),
                paths.end());
    for (Path& path : paths)
        std::rotate(path.begin(), std::min_element(path.begin(), path.end(), before), path.end());
    std::vector<Path> outers;
    std::vector<Path> holes;
    for (Path& path : paths) {
        const double area = ClipperLib::Area(path);
        if (area != 0.0) (area > 0.0 ? outers : holes).push_back(std::move(path));
    }
    std::sort(outers.begin(), outers.end(), ring_before);
    std::sort(holes.begin(), holes.end(), ring_before);

    std::vector<Polygon> polygons(outers.size());
    for (std::size_t i = 0; i < outers.size(); ++i) polygons[i].outer = to_ring(outers[i]);
    if (holes.empty()) return polygons;
    if (outers.size() == 1) {
        for (const Path& hole : holes) polygons[0].holes.push_back(to_ring(hole));
        return polygons;
    }
    // An outer ring is found through its box's diagonal, whose box is the same.
    std::vector<GridBox> boxes;
    std::vector<double> areas;
    std::vector<Segment> diagonals;
    for (const Path& outer : outers) {
        areas.push_back(ClipperLib::Area(outer));
        boxes.push_back(box_of(outer));
        const GridBox& b = boxes.back();
        diagonals.push_back({to_mm(IntPoint(b.x0, b.y0)), to_mm(IntPoint(b.x1, b.y1))});
    }
    const EdgeIndex index(std::move(diagonals));
    std::vector<int> found;
    const Vec2 rounding{kRounding * kGridMm, kRounding * kGridMm};
    for (const Path& hole : holes) {
        const GridBox h = box_of(hole);
        const double area = -ClipperLib::Area(hole);
        const Vec2 corner = to_mm(hole.front());
        index.query({corner - rounding, corner + rounding}, found);
        std::vector<std::pair<double, std::size_t>> around;
        for (const int number : found) {
            const auto i = static_cast<std::size_t>(number);
            const GridBox& b = boxes[i];
            if (b.x0 - kRounding <= h.x0 && b.y0 - kRounding <= h.y0 && b.x1 + kRounding >= h.x1 &&
                b.y1 + kRounding >= h.y1 && areas[i] > area) {
                around.emplace_back(static_cast<double>(b.x1 - b.x0) * static_cast<double>(b.y1 - b.y0), i);
            }
        }
        std::sort(around.begin(), around.end());
        // The last candidate needs no test: a hole lies in some ring. That spares the test against the
        // largest.
        for (std::size_t i = 0; i < around.size(); ++i) {
            if (i + 1 == around.size() || lies_in(hole, outers[around[i].second])) {
                polygons[around[i].second].holes.push_back(to_ring(hole));
                break;
            }
        }
    }
    return polygons;
}

// What rings enclose by the even-odd rule where no two edges meet: what the clipper makes of them, but that
// it drops what is thinner than the grid.
std::optional<Paths> enclosed_by_simple(const Paths& paths) {
    std::vector<CornerRing> rings;
    for (const Path& path : paths) {
        CornerRing ring;
        ring.reserve(path.size());
        for (const IntPoint& p : path) ring.push_back({p.X, p.Y});
        ring = without_straight_corners(ring);
        if (!ring.empty()) rings.push_back(std::move(ring));
    }
    const auto holes = holes_of_simple_rings(rings);
    if (!holes) return std::nullopt;
    Paths made;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        Path& path = made.emplace_back();
        path.reserve(rings[i].size());
        for (const RingCorner& p : rings[i]) path.emplace_back(p.x, p.y);
        if (ClipperLib::Orientation(path) == (*holes)[i]) std::reverse(path.begin(), path.end());
    }
    return made;
}

// The first ring less the others, where these are holes in it that touch neither it nor one another; nullopt
// where they are not. The clipper makes the same of them, but that it drops what is thinner than the grid.
// Its cost grows with the square of the lowest points of a ring.
std::optional<Paths> with_holes_apart(const Paths& ring, const Paths& holes) {
    Paths all = ring;
    all.insert(all.end(), holes.begin(), holes.end());
    auto made = enclosed_by_simple(all);
    if (!made || made->size() != all.size() || !ClipperLib::Orientation(made->front())) return std::nullopt;
    if (std::any_of(made->begin() + 1, made->end(), ClipperLib::Orientation)) return std::nullopt;
    return made;
}

// The paths of a boolean. The library calls nothing-to-do a failure; that is sorted out first.
Paths run(ClipperLib::ClipType type, const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
    // Nothing is common to both outside the box of either: a small region in a large one costs little.
    const bool common = type == ClipperLib::ctIntersection;
    const Box box_of_a = common ? box_round(a) : Box();
    const Box box_of_b = common ? box_round(b) : Box();
    const Paths of_a = to_paths(a, common ? &box_of_b : nullptr);
    const Paths of_b = to_paths(b, common ? &box_of_a : nullptr);
    if (type == ClipperLib::ctDifference || (type == ClipperLib::ctUnion && b.empty())) {
        if (a.size() == 1 && a[0].outer.size() >= 3) {
            if (auto apart = with_holes_apart(of_a, of_b)) return std::move(*apart);
        }
    }
    ClipperLib::Clipper clipper;
    const bool any_a = clipper.AddPaths(of_a, ClipperLib::ptSubject, true);
    const bool any_b = clipper.AddPaths(of_b, ClipperLib::ptClip, true);
    Paths result;
    if (!any_a && !any_b) return result;
    const bool done = clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    POPUP_INVARIANT(done);
    return result;
}

}  // namespace

Vec2 on_grid(Vec2 p) { return to_mm(to_int(p)); }

std::vector<Polygon> unite(const std::vector<Polygon>& regions) {
    return to_polygons(run(ClipperLib::ctUnion, regions, {}));
}

std::vector<Polygon> subtract(const std::vector<Polygon>& from, const std::vector<Polygon>& what) {
    return to_polygons(run(ClipperLib::ctDifference, from, what));
}

std::vector<Polygon> intersect(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
    return to_polygons(run(ClipperLib::ctIntersection, a, b));
}

std::vector<Polygon> filled(const std::vector<Ring>& rings, FillRule rule) {
    Paths paths;
    for (const Ring& ring : rings) {
        Path& path = paths.emplace_back();
        path.reserve(ring.size());
        for (const Vec2 p : ring) path.push_back(to_int(p));
    }
    // Of one ring that does not cross itself both rules make the same.
    if (rule == FillRule::even_odd || rings.size() == 1) {
        if (auto simple = enclosed_by_simple(paths)) return to_polygons(std::move(*simple));
    }
    ClipperLib::Clipper clipper;
    if (!clipper.AddPaths(paths, ClipperLib::ptSubject, true)) return {};
    const ClipperLib::PolyFillType type =
        rule == FillRule::even_odd ? ClipperLib::pftEvenOdd : ClipperLib::pftNonZero;
    Paths result;
    const bool done = clipper.Execute(ClipperLib::ctUnion, result, type, type);
    POPUP_INVARIANT(done);
    return to_polygons(std::move(result));
}

std::vector<Polygon> offset(const std::vector<Polygon>& regions, double delta, Corners corners) {
    // One outline first: overlapping rings would each be offset on their own.
    const Paths united = run(ClipperLib::ctUnion, regions, {});
    if (united.empty()) return {};
    ClipperLib::ClipperOffset offsetter(kMitreLimit, kCurveMm * kPerMm);
    offsetter.AddPaths(united, corners == Corners::sharp ? ClipperLib::jtMiter : ClipperLib::jtRound,
                       ClipperLib::etClosedPolygon);
    Paths result;
    offsetter.Execute(result, delta * kPerMm);
    return to_polygons(std::move(result));
}

namespace {

// Polygon edges made ready for cutting many lines to them.
class LineCutter {
 public:
    explicit LineCutter(const Polygon& area) : edges_(edges_of(area)) {}

    std::vector<std::vector<Vec2>> cut(const std::vector<Vec2>& line) {
        std::vector<std::vector<Vec2>> parts;
        bool open = false;  // the last part ends where the next segment starts
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            if (line[i] == line[i + 1]) continue;
            open = cut_segment(line[i], line[i + 1], open, parts);
        }
        std::erase_if(parts, [](const std::vector<Vec2>& part) {
            double total = 0.0;
            for (std::size_t i = 0; i + 1 < part.size(); ++i) total += distance(part[i], part[i + 1]);
            return total < kGridMm;
        });
        return parts;
    }

 private:
    // A line may leave an edge at so flat an angle that halfway it still counts as on it. The edge then ends
    // within twice that distance of the line, and a part of the line must end there, too.
    static constexpr double kEndNearMm = 3.0 * kOnGridLineMm;

    // Where along a–b the line may enter or leave the area, as parts of its length, from 0 to 1.
    void find_crossings(Vec2 a, Vec2 b) {
        at_.assign({0.0, 1.0});
        Box box;
        box.extend(a);
        box.extend(b);
        box.min = box.min - Vec2{kEndNearMm, kEndNearMm};
        box.max = box.max + Vec2{kEndNearMm, kEndNearMm};
        edges_.query(box, found_);
        const Vec2 along = b - a;
        const double squared = dot(along, along);
        for (const int number : found_) {
            const Segment& edge = edges_[number];
            const double side_a = cross(along, edge.a - a);
            const double side_b = cross(along, edge.b - a);
            if ((side_a > 0.0) != (side_b > 0.0)) {
                const Vec2 meet = lerp(edge.a, edge.b, side_a / (side_a - side_b));
                const double t = dot(meet - a, along) / squared;
                if (t > 0.0 && t < 1.0) at_.push_back(t);
            }
            for (const Vec2 end : {edge.a, edge.b}) {
                const double t = dot(end - a, along) / squared;
                if (t > 0.0 && t < 1.0 && distance(end, Segment{a, b}) <= kEndNearMm) at_.push_back(t);
            }
        }
        std::sort(at_.begin(), at_.end());
        at_.erase(std::unique(at_.begin(), at_.end()), at_.end());
    }

    bool cut_segment(Vec2 a, Vec2 b, bool open, std::vector<std::vector<Vec2>>& parts) {
        find_crossings(a, b);
        const auto point = [&](double t) { return t == 0.0 ? a : t == 1.0 ? b : lerp(a, b, t); };
        for (std::size_t i = 0; i + 1 < at_.size(); ++i) {
            const Vec2 middle = lerp(a, b, 0.5 * (at_[i] + at_[i + 1]));
            if (edges_.winding(middle) <= 0 && edges_.clearance(middle, kOnGridLineMm) >= kOnGridLineMm) {
                open = false;
                continue;
            }
            if (!open) {
                parts.push_back({point(at_[i]), point(at_[i + 1])});
            } else if (at_[i] == 0.0) {
                parts.back().push_back(point(at_[i + 1]));
            } else {
                parts.back().back() = point(at_[i + 1]);
            }
            open = true;
        }
        return open;
    }

    EdgeIndex edges_;
    std::vector<double> at_;
    std::vector<int> found_;
};

}  // namespace

std::vector<std::vector<std::vector<Vec2>>> clip_lines(std::span<const std::vector<Vec2>> lines,
                                                       const Polygon& area) {
    LineCutter cutter(area);
    std::vector<std::vector<std::vector<Vec2>>> parts;
    parts.reserve(lines.size());
    for (const std::vector<Vec2>& line : lines) parts.push_back(cutter.cut(line));
    return parts;
}

std::vector<std::vector<Vec2>> clip_line(const std::vector<Vec2>& line, const Polygon& area) {
    return LineCutter(area).cut(line);
}

Ring tidied(const Ring& ring, double tolerance) {
    Ring kept = ring;
    for (bool changed = true; changed && kept.size() >= 3;) {
        changed = false;
        Ring next;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const Vec2 before = next.empty() ? kept.back() : next.back();
            // The last one's neighbour is the first that stays: of two corners in one place one does.
            const bool last = i + 1 == kept.size();
            const Vec2 after = !last ? kept[i + 1] : next.empty() ? kept.front() : next.front();
            const Vec2 along = after - before;
            const double span = length(along);
            const bool straight = distance(before, kept[i]) <= tolerance || span <= tolerance ||
                                  std::abs(cross(along, kept[i] - before)) <= tolerance * span;
            if (straight) {
                changed = true;
            } else {
                next.push_back(kept[i]);
            }
        }
        kept = std::move(next);
    }
    if (kept.size() < 3 || std::abs(signed_area(kept)) <= tolerance * tolerance) return {};
    return kept;
}

}  // namespace popup
