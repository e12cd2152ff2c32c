#include "layout/scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
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
    Scaler(CurveTable curves, double by) : by_(by) {
        if (by > 1.0) {
            for (FlatCurve& one : curves.curves()) add(std::move(one));
        }
        curves_ = std::move(curves);
        curves_.scale(by);
    }

    void scale(std::vector<Vec2>& points, bool closed) {
        for (Vec2& p : points) p = by_ * p;
        if (auto finer = finer_than(points, closed)) points = std::move(*finer);
    }
    void scale(Polygon& polygon) {
        scale(polygon.outer, true);
        for (Ring& hole : polygon.holes) scale(hole, true);
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

    // The curves of all that was scaled, and of lines that keep their chords.
    [[nodiscard]] CurveTable curves() && {
        if (!is_finer()) return std::move(curves_);
        CurveTable made(known_);
        made.scale(by_);
        return made;
    }

 private:
    using Key = std::array<std::int64_t, 8>;
    static constexpr double kSameCurvePerMm = 1e5;
    static constexpr double kSameT = 1e-9;

    [[nodiscard]] bool is_finer() const { return !known_.empty(); }

    // Points that are scaled, with new chords of their curves. nullopt: there is none.
    std::optional<std::vector<Vec2>> finer_than(const std::vector<Vec2>& points, bool closed) {
        if (!is_finer()) return std::nullopt;
        const Restored restored = curves_.restored(points, closed, !closed);
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
        for (FlatCurve& one : flat.curves) {
            Cubic& c = one.cubic;
            for (Vec2* p : {&c.from, &c.control_1, &c.control_2, &c.to}) *p = (1.0 / by_) * *p;
            for (FlatCurve::Corner& corner : one.corners) corner.at = (1.0 / by_) * corner.at;
            add(std::move(one));
        }
        return std::move(flat.lines.front().points);
    }

    // A curve before it is scaled. Of one that is known the corners are added.
    void add(FlatCurve curve) {
        Key key{};
        const Cubic& c = curve.cubic;
        std::size_t n = 0;
        for (const Vec2 p : {c.from, c.control_1, c.control_2, c.to}) {
            key.at(n++) = std::llround(p.x * kSameCurvePerMm);
            key.at(n++) = std::llround(p.y * kSameCurvePerMm);
        }
        const auto [place, fresh] = number_.try_emplace(key, known_.size());
        if (fresh) {
            known_.push_back(std::move(curve));
            return;
        }
        std::vector<FlatCurve::Corner>& corners = known_[place->second].corners;
        corners.insert(corners.end(), curve.corners.begin(), curve.corners.end());
        std::stable_sort(corners.begin(), corners.end(),
                         [](const auto& a, const auto& b) { return a.t < b.t; });
        corners.erase(std::unique(corners.begin(), corners.end(),
                                  [](const auto& a, const auto& b) { return b.t - a.t < kSameT; }),
                      corners.end());
    }

    CurveTable curves_;
    double by_;
    std::vector<FlatCurve> known_;       // each once, before it is scaled; none where nothing becomes larger
    std::map<Key, std::size_t> number_;  // in known_
};

}  // namespace

void scale_pattern(Pattern& pattern, double by) {
    Scaler scaler(std::move(pattern.curves), by);
    for (PatternPiece& piece : pattern.pieces) {
        for (Contour& cut : piece.cuts) scaler.scale(cut.points, cut.closed);
        for (PatternLine& line : piece.lines) line.at = {by * line.at.a, by * line.at.b};
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
