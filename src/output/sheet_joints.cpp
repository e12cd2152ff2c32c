#include "output/sheet_joints.h"

#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/nth.h"
#include "fabrication/joints.h"
#include "output/sheet_carrier.h"

namespace popup {
namespace {

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
        JointedCuts made =
            with_joints(cuts, profile.joint_mm + profile.pen(Operation::outer_cut).kerf_mm, lines);
        drawing_.joints += made.joints;
        if (made.joints < 2) drawing_.loose_pieces.push_back(number);
        for (std::size_t k = 0; k < shapes.size(); ++k) parts_[shapes[k]] = std::move(made.parts[k]);
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
    breaking.done();
}

}  // namespace popup
