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

void scale(Area& area, double by) { scale(area.shape, by); }

void scale(Stroke& stroke, double by) {
    scale(stroke.points, by);
    stroke.width_mm *= by;
}

void scale(Text& text, double by) {
    text.at = by * text.at;
    text.height_mm *= by;
}

void scale(Image& image, double by) {
    Affine& place = image.place;
    place = {by * place.x, by * place.y, by * place.origin};
    for (Polygon& region : image.clip) scale(region, by);
}

}  // namespace

void scale_pattern(Pattern& pattern, double by) {
    pattern.curves.scale(by);
    for (PatternPiece& piece : pattern.pieces) {
        for (Contour& cut : piece.cuts) scale(cut.points, by);
        for (PatternLine& line : piece.lines) line.at = {by * line.at.a, by * line.at.b};
        for (PatternPrint& one : piece.prints) std::visit([by](auto& print) { scale(print, by); }, one.print);
        for (GlueTarget& target : piece.targets) scale(target.outline, by);
        const auto scale_label = [by](Label& label) {
            label.at = by * label.at;
            label.height_mm *= by;
        };
        for (Label& label : piece.labels) scale_label(label);
        if (piece.named_tab) scale_label(piece.named_tab->named);
        if (piece.hidden_number) scale_label(*piece.hidden_number);
        for (Polygon& part : piece.silhouette) scale(part, by);
        piece.bounds = {by * piece.bounds.min, by * piece.bounds.max};
    }
}

}  // namespace popup
