#include "output/sheet_joints.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/near_boxes.h"
#include "base/nth.h"
#include "fabrication/joints.h"
#include "output/sheet_carrier.h"

namespace popup {
namespace {

constexpr double kBeyondJointsMm = 10.0;  // further than joints look round

// Where the piece is folded and cut inside, on the sheet: a joint would tear folds where they run out, and
// the narrow strip between a hole and the edge.
EdgeIndex torn_lines(const PatternPiece& piece, const Carrier& carrier, const Profile& profile) {
    std::vector<Segment> lines;
    const auto add = [&](Vec2 a, Vec2 b) { lines.push_back({carrier.at(a), carrier.at(b)}); };
    for (const PatternLine& line : piece.lines) {
        if (is_fold(operation_of(line, profile))) add(line.at.a, line.at.b);
    }
    for (const Contour& cut : piece.cuts) {
        if (cut.closed && cut.depth == 0) continue;
        for (std::size_t i = 0; i + 1 < cut.points.size(); ++i) add(cut.points[i], cut.points[i + 1]);
        if (cut.closed) add(cut.points.back(), cut.points.front());
    }
    return EdgeIndex({}, lines);
}

// Where the piece is folded and cut through, its own hole left out.
EdgeIndex torn_round_hole(const PatternPiece& piece, const Carrier& carrier, const Profile& profile,
                          std::span<const Vec2> hole) {
    Box around;
    for (const Vec2 p : hole) around.extend(p);
    const Vec2 far{kBeyondJointsMm, kBeyondJointsMm};
    const Box near{around.min - far, around.max + far};
    std::vector<Segment> lines;
    const auto add = [&](Vec2 a, Vec2 b) {
        Box box;
        box.extend(a);
        box.extend(b);
        if (touch(box, near)) lines.push_back({a, b});
    };
    for (const PatternLine& line : piece.lines) {
        if (is_fold(operation_of(line, profile))) add(carrier.at(line.at.a), carrier.at(line.at.b));
    }
    for (const Contour& cut : piece.cuts) {
        std::vector<Vec2> points;
        for (const Vec2 p : cut.points) points.push_back(carrier.at(p));
        Box box;
        for (const Vec2 p : points) box.extend(p);
        constexpr double kAboutSameMm = 0.5;  // more than a kerf moves it
        if (cut.closed && distance(box.min, around.min) < kAboutSameMm &&
            distance(box.max, around.max) < kAboutSameMm)
            continue;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) add(points[i], points[i + 1]);
        if (cut.closed) add(points.back(), points.front());
    }
    return EdgeIndex({}, lines);
}

// Closed inner cuts with another piece inside, and one such piece each.
std::map<std::size_t, int> filled_holes(const SheetDrawing& drawing) {
    const auto points_of = [&drawing](const SheetShape& shape) {
        return drawing.points_of(drawing.runs_of(shape).front());
    };
    const auto box_of = [](std::span<const Vec2> points) {
        Box box;
        for (const Vec2 p : points) box.extend(p);
        return box;
    };
    EdgeIndex boxes;  // diagonals of holes
    std::vector<std::size_t> holes;
    for (std::size_t i = 0; i < drawing.shapes.size(); ++i) {
        const SheetShape& shape = drawing.shapes[i];
        if (!is_cut(shape.operation) || shape.outline || shape.depth % 2 == 0 || shape.piece < 0) continue;
        if (!drawing.runs_of(shape).front().closed) continue;
        const Box box = box_of(points_of(shape));
        boxes.insert({box.min, box.max}, false);
        holes.push_back(i);
    }
    std::map<std::size_t, int> filled;
    if (holes.empty()) return filled;
    std::vector<int> found;
    for (const SheetShape& shape : drawing.shapes) {
        if (!shape.outline) continue;
        const std::span<const Vec2> outline = points_of(shape);
        boxes.query(box_of(outline), found);
        for (const int number : found) {
            const std::size_t hole = nth(holes, number);
            if (drawing.shapes[hole].piece == shape.piece || filled.contains(hole)) continue;
            const std::span<const Vec2> ring = points_of(drawing.shapes[hole]);
            if (contains(Polygon{{ring.begin(), ring.end()}, {}}, outline.front()))
                filled.emplace(hole, shape.piece);
        }
    }
    return filled;
}

class Breaking {
 public:
    explicit Breaking(SheetDrawing& drawing) : drawing_(drawing), parts_(drawing.shapes.size()) {}

    // Breaks the outline of one piece, which these shapes draw.
    void piece(int number, const std::vector<std::size_t>& shapes, const EdgeIndex& lines) {
        std::vector<OuterCut> cuts;
        for (const std::size_t i : shapes) {
            const Run& run = drawing_.runs_of(drawing_.shapes[i]).front();
            cuts.push_back({drawing_.points_of(run), run.closed});
        }
        const Profile& profile = drawing_.profile;
        // Of a piece in another's hole the tool is the one for inner cuts.
        const Operation operation = drawing_.shapes[shapes.front()].operation;
        JointedCuts made = with_joints(cuts, profile.joint_mm + profile.pen(operation).kerf_mm, lines);
        drawing_.joints += made.joints;
        if (made.joints < 2) drawing_.loose_pieces.push_back(number);
        for (std::size_t k = 0; k < shapes.size(); ++k) parts_[shapes[k]] = std::move(made.parts[k]);
    }

    // Breaks the outline of a hole in which another piece lies: else both fall out together.
    void hole(std::size_t shape, int inside, const EdgeIndex& lines) {
        const Run& run = drawing_.runs_of(drawing_.shapes[shape]).front();
        const std::array<OuterCut, 1> cut{{{drawing_.points_of(run), true}}};
        const Profile& profile = drawing_.profile;
        JointedCuts made =
            with_joints(cut, profile.joint_mm + profile.pen(drawing_.shapes[shape].operation).kerf_mm, lines);
        drawing_.joints += made.joints;
        std::vector<int>& loose = drawing_.loose_pieces;
        if (made.joints < 2 && std::find(loose.begin(), loose.end(), inside) == loose.end())
            loose.push_back(inside);
        parts_[shape] = std::move(made.parts.front());
    }

    // Draws the shapes anew.
    void done() {
        std::vector<SheetShape> shapes;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (parts_[i].empty()) shapes.push_back(drawing_.shapes[i]);
            for (const PathPart& part : parts_[i]) {
                SheetShape& shape = shapes.emplace_back(drawing_.shapes[i]);
                shape.first_run = drawing_.runs.size();
                shape.runs = 1;
                drawing_.runs.push_back({drawing_.points.size(), part.points.size(), part.closed});
                drawing_.points.insert(drawing_.points.end(), part.points.begin(), part.points.end());
            }
        }
        drawing_.shapes = std::move(shapes);
    }

 private:
    SheetDrawing& drawing_;
    std::vector<std::vector<PathPart>> parts_;  // of each shape that is broken
};

}  // namespace

void put_in_joints(SheetDrawing& drawing, const Layout& layout, std::span<const Placement> placements,
                   bool back) {
    if (drawing.profile.joint_mm <= 0.0) return;
    std::vector<std::vector<std::size_t>> outlines(placements.size());
    for (std::size_t i = 0; i < drawing.shapes.size(); ++i) {
        if (drawing.shapes[i].outline) nth(outlines, drawing.shapes[i].piece).push_back(i);
    }
    Breaking breaking(drawing);
    for (std::size_t i = 0; i < placements.size(); ++i) {
        if (outlines[i].empty()) continue;
        const Pattern& pattern = nth(layout.designs, placements[i].design).pattern;
        breaking.piece(static_cast<int>(i), outlines[i],
                       torn_lines(nth(pattern.pieces, placements[i].piece),
                                  Carrier(placements[i], drawing.width_mm, back), drawing.profile));
    }
    for (const auto& [shape, inside] : filled_holes(drawing)) {
        const SheetShape& hole = drawing.shapes[shape];
        const Placement& placement = nth(placements, hole.piece);
        const Pattern& pattern = nth(layout.designs, placement.design).pattern;
        breaking.hole(
            shape, inside,
            torn_round_hole(nth(pattern.pieces, placement.piece), Carrier(placement, drawing.width_mm, back),
                            drawing.profile, drawing.points_of(drawing.runs_of(hole).front())));
    }
    breaking.done();
}

}  // namespace popup
