#include "layout/scale.h"

namespace popup {
namespace {

void scale(std::vector<Vec2>& points, double by) {
    for (Vec2& p : points) p = by * p;
}

void scale(Polygon& polygon, double by) {
    scale(polygon.outer, by);
    for (Ring& hole : polygon.holes) scale(hole, by);
}

}  // namespace

void scale_pattern(Pattern& pattern, double by) {
    pattern.curves.scale(by);
    for (PatternPiece& piece : pattern.pieces) {
        for (Contour& cut : piece.cuts) scale(cut.points, by);
        for (PatternLine& line : piece.lines) line.at = {by * line.at.a, by * line.at.b};
        for (Fill& fill : piece.fills) scale(fill.area, by);
        for (PatternStroke& one : piece.strokes) {
            scale(one.stroke.points, by);
            one.stroke.width_mm *= by;
        }
        for (GlueTarget& target : piece.targets) scale(target.outline, by);
        for (Label& label : piece.labels) {
            label.at = by * label.at;
            label.height_mm *= by;
        }
        for (Polygon& part : piece.silhouette) scale(part, by);
        piece.bounds = {by * piece.bounds.min, by * piece.bounds.max};
    }
}

}  // namespace popup
