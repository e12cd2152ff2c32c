#include "output/machine_order.h"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <map>
#include <utility>

#include "base/geometry/tolerances.h"
#include "fabrication/kerf.h"
#include "fabrication/shared_lines.h"
#include "fabrication/tour.h"
#include "popup/diagnostics.h"
#include "popup/pattern.h"

namespace popup {
namespace {

namespace bgi = boost::geometry::index;
using BoostPoint = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
using BoostBox = boost::geometry::model::box<BoostPoint>;

// Operations of one rank may follow each other in any order: folds that one pen draws.
Operation rank_of(const Profile& profile, Operation operation) {
    if (!is_fold(operation)) return operation;
    const Pen& pen = profile.pen(operation);
    for (const Operation earlier : {Operation::valley, Operation::mountain}) {
        const Pen& other = profile.pen(earlier);
        if (earlier < operation && other.layer == pen.layer && other.color == pen.color &&
            other.width_mm == pen.width_mm)
            return earlier;
    }
    return operation;
}

bool is_closed_cut(const SheetDrawing& drawing, const SheetShape& shape) {
    return is_cut(shape.operation) && drawing.runs_of(shape).front().closed;
}

BoostBox box_of(std::span<const Vec2> points) {
    Box box;
    for (const Vec2 p : points) box.extend(p);
    return {{box.min.x, box.min.y}, {box.max.x, box.max.y}};
}

// A piece in another's hole is cut with the tool for inner cuts, but its outline has the kerf of outer cuts.
// Moves the outline by half the difference, so that the piece keeps its size. An outline that cannot move so
// far, because narrow places would close, stays.
void move_to_inner_kerf(SheetDrawing& drawing, SheetShape& shape) {
    const KerfWidths kerf = KerfWidths::of(drawing.profile);
    const Run& run = drawing.runs_of(shape).front();
    if (kerf.inner_mm == kerf.outer_mm || !run.closed) return;
    const std::span<const Vec2> points = drawing.points_of(run);
    PatternPiece piece;
    // Edges of pieces move outwards, those of holes inwards.
    const double more = kerf.inner_mm - kerf.outer_mm;
    piece.cuts.push_back({{points.begin(), points.end()}, true});
    piece.cuts.front().depth = more > 0.0 ? 0 : 1;
    Diagnostics unheard;
    const auto moved = compensated(piece, {}, {std::max(0.0, -more), std::max(0.0, more)}, unheard);
    if (!moved) return;
    const std::vector<Vec2>& path = moved->front().points;
    shape.first_run = drawing.runs.size();
    drawing.runs.push_back({drawing.points.size(), path.size(), true});
    drawing.points.insert(drawing.points.end(), path.begin(), path.end());
}

// How deep pieces lie in the holes of others. Outer cuts of such pieces become inner ones.
void find_depths(SheetDrawing& drawing) {
    const auto points_of = [&drawing](const SheetShape& shape) {
        return drawing.points_of(drawing.runs_of(shape).front());
    };
    std::vector<std::pair<BoostBox, std::size_t>> boxes;
    for (std::size_t i = 0; i < drawing.shapes.size(); ++i) {
        const SheetShape& shape = drawing.shapes[i];
        if (is_closed_cut(drawing, shape) && shape.depth % 2 == 1)
            boxes.emplace_back(box_of(points_of(shape)), i);
    }
    if (boxes.empty()) return;
    const bgi::rtree<std::pair<BoostBox, std::size_t>, bgi::quadratic<16>> holes(boxes);
    std::vector<int> sunk(drawing.pieces.size(), 0);
    std::vector<std::pair<BoostBox, std::size_t>> round;
    for (const SheetShape& shape : drawing.shapes) {
        if (shape.operation != Operation::outer_cut || shape.piece < 0) continue;
        const std::span<const Vec2> outline = points_of(shape);
        round.clear();
        holes.query(bgi::contains(box_of(outline)), std::back_inserter(round));
        std::map<int, int> deepest;  // of the holes of each other piece that it lies in
        for (const auto& [box, number] : round) {
            const SheetShape& hole = drawing.shapes[number];
            if (hole.piece == shape.piece) continue;
            const std::span<const Vec2> ring = points_of(hole);
            if (!contains(Polygon{{ring.begin(), ring.end()}, {}}, outline.front())) continue;
            int& depth = deepest[hole.piece];
            depth = std::max(depth, hole.depth + 1);
        }
        int sum = 0;
        for (const auto& [piece, deep] : deepest) sum += deep;
        int& depth = sunk[static_cast<std::size_t>(shape.piece)];
        depth = std::max(depth, sum);
    }
    for (SheetShape& shape : drawing.shapes) {
        if (!is_cut(shape.operation) || shape.piece < 0) continue;
        shape.depth += sunk[static_cast<std::size_t>(shape.piece)];
        if (shape.depth == 0 || shape.operation != Operation::outer_cut) continue;
        if (!drawing.profile.draws(Operation::inner_cut)) continue;
        move_to_inner_kerf(drawing, shape);
        shape.operation = Operation::inner_cut;
        const Pen& pen = drawing.profile.pen(Operation::inner_cut);
        shape.color = pen.color;
        shape.width_mm = pen.width_mm;
    }
}

// Without points closer than kTinyMm to the one kept before them; ends stay.
std::vector<Vec2> without_tiny(std::span<const Vec2> points, bool closed) {
    std::vector<Vec2> kept{points.front()};
    for (const Vec2 p : points.subspan(1)) {
        if (distance(kept.back(), p) >= kTinyMm) kept.push_back(p);
    }
    if (closed) {
        while (kept.size() > 3 && distance(kept.back(), kept.front()) < kTinyMm) kept.pop_back();
        // So small a hole is drawn as it is.
        if (kept.size() < 3) return {points.begin(), points.end()};
    } else if (kept.back() != points.back()) {
        if (kept.size() > 1 && distance(kept.back(), points.back()) < kTinyMm) kept.pop_back();
        kept.push_back(points.back());
    }
    return kept;
}

// The drawing's lines anew: runs and points are written as they are put in.
class Redrawing {
 public:
    explicit Redrawing(SheetDrawing& drawing) : drawing_(drawing) {
        std::swap(shapes_, drawing.shapes);
        std::swap(runs_, drawing.runs);
        std::swap(points_, drawing.points);
        drawing.points.reserve(points_.size());
        drawing.runs.reserve(runs_.size());
    }

    // Shapes that are printed, as they are; the others cleaned, each in its order of being done.
    void draw() {
        std::vector<SheetShape> done;
        for (const SheetShape& shape : shapes_) {
            if (is_printed(shape.operation)) {
                copy(shape);
            } else {
                done.push_back(shape);
            }
        }
        const Profile& profile = drawing_.profile;
        std::stable_sort(done.begin(), done.end(), [&profile](const SheetShape& a, const SheetShape& b) {
            return std::pair(rank_of(profile, a.operation), -a.depth) <
                   std::pair(rank_of(profile, b.operation), -b.depth);
        });
        SharedLines cuts;
        for (const SheetShape& shape : done) clean(shape, cuts);
    }

 private:
    [[nodiscard]] std::span<const Run> runs_of(const SheetShape& shape) const {
        return std::span(runs_).subspan(shape.first_run, shape.runs);
    }
    [[nodiscard]] std::span<const Vec2> points_of(const Run& run) const {
        return std::span(points_).subspan(run.first, run.count);
    }
    void begin(const SheetShape& shape) {
        drawing_.shapes.push_back(shape);
        drawing_.shapes.back().first_run = drawing_.runs.size();
        drawing_.shapes.back().runs = 0;
    }
    void run(std::span<const Vec2> points, bool closed) {
        drawing_.runs.push_back({drawing_.points.size(), points.size(), closed});
        drawing_.points.insert(drawing_.points.end(), points.begin(), points.end());
        ++drawing_.shapes.back().runs;
    }
    void copy(const SheetShape& shape) {
        begin(shape);
        for (const Run& one : runs_of(shape)) run(points_of(one), one.closed);
    }
    void clean(const SheetShape& shape, SharedLines& cuts) {
        if (!is_cut(shape.operation)) return copy(shape);
        for (const Run& one : runs_of(shape)) {
            const std::vector<Vec2> points = without_tiny(points_of(one), one.closed);
            for (const PathPart& part : cuts.left_of(points, one.closed)) {
                begin(shape);
                run(part.points, part.closed);
            }
        }
    }

    SheetDrawing& drawing_;
    std::vector<SheetShape> shapes_;
    std::vector<Run> runs_;
    std::vector<Vec2> points_;
};

// The whole line of a shape, from the beginning of its first run to the end of its last.
Stop stop_of(const SheetDrawing& drawing, const SheetShape& shape) {
    const std::span<const Run> runs = drawing.runs_of(shape);
    const Run& first = runs.front();
    const Run& last = runs.back();
    return {std::span(drawing.points).subspan(first.first, last.first + last.count - first.first),
            runs.size() == 1 && first.closed};
}

void turn(SheetDrawing& drawing, const SheetShape& shape, const Visit& visit) {
    const auto at = [&drawing](std::size_t i) {
        return drawing.points.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto first = static_cast<std::ptrdiff_t>(shape.first_run);
    const auto runs = std::span(drawing.runs).subspan(shape.first_run, shape.runs);
    const std::size_t begin = runs.front().first;
    if (runs.front().closed && runs.size() == 1) {
        std::rotate(at(begin), at(begin + visit.corner), at(begin + runs.front().count));
        return;
    }
    if (!visit.reversed) return;
    std::reverse(at(begin), at(runs.back().first + runs.back().count));
    const auto run_at = drawing.runs.begin() + first;
    std::reverse(run_at, run_at + static_cast<std::ptrdiff_t>(shape.runs));
    std::size_t next = begin;
    for (Run& run : runs) {
        run.first = next;
        next += run.count;
    }
}

// Each stretch of shapes that may follow each other in any order is put in one in which the way is short.
void shorten_ways(SheetDrawing& drawing) {
    Vec2 at;
    std::vector<SheetShape>& shapes = drawing.shapes;
    for (std::size_t first = 0; first < shapes.size();) {
        const Operation rank = rank_of(drawing.profile, shapes[first].operation);
        std::size_t last = first;
        while (last < shapes.size() && rank_of(drawing.profile, shapes[last].operation) == rank &&
               shapes[last].depth == shapes[first].depth)
            ++last;
        if (!is_printed(shapes[first].operation)) {
            std::vector<Stop> stops;
            for (std::size_t i = first; i < last; ++i) stops.push_back(stop_of(drawing, shapes[i]));
            std::vector<SheetShape> in_order;
            for (const Visit& visit : tour(stops, at)) {
                in_order.push_back(shapes[first + visit.stop]);
                turn(drawing, in_order.back(), visit);
            }
            std::copy(in_order.begin(), in_order.end(), shapes.begin() + static_cast<std::ptrdiff_t>(first));
            const Stop end = stop_of(drawing, shapes[last - 1]);
            at = end.closed ? end.corners.front() : end.corners.back();
        }
        first = last;
    }
}

}  // namespace

void put_in_machine_order(SheetDrawing& drawing) {
    find_depths(drawing);
    Redrawing(drawing).draw();
    shorten_ways(drawing);
}

}  // namespace popup
