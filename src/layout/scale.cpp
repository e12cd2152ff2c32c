#include "layout/scale.h"

#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "popup/path.h"

namespace popup {
namespace {

void scale(Text& text, double by) {
    text.at = by * text.at;
    text.height_mm *= by;
}

class Scaler {
 public:
    Scaler(CurveTable curves, double by) : curves_(std::move(curves)), by_(by) { curves_.scale(by); }

    void scale(std::vector<Vec2>& points, bool closed) {
        for (Vec2& p : points) p = by_ * p;
        if (auto finer = finer_than(points, closed)) points = std::move(*finer);
    }
    void scale(Polygon& polygon) {
        scale(polygon.outer, true);
        for (Ring& hole : polygon.holes) scale(hole, true);
    }
    void scale(std::vector<PatternLine>& lines) {
        std::vector<PatternLine> made;
        made.reserve(lines.size());
        for (PatternLine& line : lines) {
            line.at = {by_ * line.at.a, by_ * line.at.b};
            const auto finer = finer_than({line.at.a, line.at.b}, false);
            for (std::size_t i = 1; finer && i < finer->size(); ++i) {
                made.push_back(line);
                made.back().at = {(*finer)[i - 1], (*finer)[i]};
            }
            if (!finer) made.push_back(line);
        }
        lines = std::move(made);
    }
    void scale(Print& print) {
        if (auto* area = std::get_if<Area>(&print)) return scale(area->shape);
        if (auto* text = std::get_if<Text>(&print)) return popup::scale(*text, by_);
        if (auto* stroke = std::get_if<Stroke>(&print)) {
            scale(stroke->points, false);
            stroke->width_mm *= by_;
            return;
        }
        auto& image = std::get<Image>(print);
        Affine& place = image.place;
        place = {by_ * place.x, by_ * place.y, by_ * place.origin};
        for (Polygon& region : image.clip) scale(region);
    }

    // Of all that was scaled.
    [[nodiscard]] CurveTable curves() && { return is_finer() ? CurveTable(made_) : std::move(curves_); }

 private:
    [[nodiscard]] bool is_finer() const { return by_ > 1.0 && !curves_.empty(); }

    // Points that are scaled, with new chords of their curves. nullopt: there is none.
    std::optional<std::vector<Vec2>> finer_than(const std::vector<Vec2>& points, bool closed) {
        if (!is_finer()) return std::nullopt;
        const Restored restored = curves_.restored(points, closed, true);
        if (restored.steps.empty()) return std::nullopt;
        Path path;
        path.move(points[restored.start]);
        for (const CurveStep& step : restored.steps) {
            if (step.curve)
                path.cubic(step.control_1, step.control_2, points[step.to]);
            else
                path.line(points[step.to]);
        }
        if (closed) path.close();
        Flattened flat;
        if (flatten(path, flat) != FlatteningFault::none || flat.lines.size() != 1) return std::nullopt;
        made_.insert(made_.end(), flat.curves.begin(), flat.curves.end());
        return std::move(flat.lines.front().points);
    }

    CurveTable curves_;
    double by_;
    std::vector<FlatCurve> made_;
};

}  // namespace

void scale_pattern(Pattern& pattern, double by) {
    Scaler scaler(std::move(pattern.curves), by);
    for (PatternPiece& piece : pattern.pieces) {
        for (Contour& cut : piece.cuts) scaler.scale(cut.points, cut.closed);
        scaler.scale(piece.lines);
        for (PatternPrint& one : piece.prints) scaler.scale(one.print);
        for (GlueTarget& target : piece.targets) scaler.scale(target.outline, true);
        const auto scale_label = [by](Label& label) {
            label.at = by * label.at;
            label.height_mm *= by;
        };
        for (Label& label : piece.labels) scale_label(label);
        if (piece.named_tab) scale_label(piece.named_tab->named);
        if (piece.hidden_number) scale_label(*piece.hidden_number);
        piece.bounds = {by * piece.bounds.min, by * piece.bounds.max};
        for (Polygon& part : piece.silhouette) {
            scaler.scale(part);
            for (const Vec2 p : part.outer) piece.bounds.extend(p);
        }
    }
    pattern.curves = std::move(scaler).curves();
}

}  // namespace popup
