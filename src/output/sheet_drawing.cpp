#include "output/sheet_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/render_diagnostics.h"

namespace popup {
namespace {

SheetLayer layer_of(LineKind kind) {
    switch (kind) {
        case LineKind::cut:
            return SheetLayer::cut;
        case LineKind::mountain:
            return SheetLayer::mountain;
        case LineKind::valley:
            return SheetLayer::valley;
        case LineKind::seam:
            return SheetLayer::seam;
        case LineKind::mark:
            return SheetLayer::draw;
    }
    broken_invariant("a line kind is one of its enumerators", __FILE__, __LINE__);
}

// A mark is drawn, never cut or folded: a thin grey line.
constexpr LayerStyle kMark{Color{0x80, 0x80, 0x80}, 0.2, false};

// The turn that makes a line of text read from below or from the right.
double upright(double angle) {
    constexpr double kHalf = std::numbers::pi;
    double turned = std::remainder(angle, 2.0 * kHalf);  // [-180°, 180°]
    // A hair of room, so that the rounding of a quarter turn does not decide.
    constexpr double kHair = 1e-9;
    if (turned > 0.5 * kHalf + kHair) turned -= kHalf;
    if (turned <= -0.5 * kHalf + kHair) turned += kHalf;
    return turned;
}

// Carries points of one piece to the sheet.
class Pen {
 public:
    Pen(SheetDrawing& drawing, const Placement& placement)
        : drawing_(drawing),
          offset_(placement.offset),
          angle_(placement.angle.rad()),
          x_(placement.apply({1, 0}) - placement.offset),
          y_(placement.apply({0, 1}) - placement.offset) {}

    [[nodiscard]] Vec2 at(Vec2 p) const { return offset_ + p.x * x_ + p.y * y_; }
    [[nodiscard]] double turned(double angle) const { return upright(angle + angle_); }

    void begin(SheetLayer layer, int plate, Color color, double width_mm) {
        drawing_.shapes.push_back({layer, drawing_.runs.size(), 0, plate, color, width_mm});
    }
    void begin(SheetLayer layer, int plate) {
        const LayerStyle style = layer_style(layer);
        begin(layer, plate, style.color, style.width_mm);
    }
    void run(std::span<const Vec2> points, bool closed) {
        drawing_.runs.push_back({drawing_.points.size(), points.size(), closed});
        for (const Vec2 p : points) drawing_.points.push_back(at(p));
        ++drawing_.shapes.back().runs;
    }

 private:
    SheetDrawing& drawing_;
    Vec2 offset_;
    double angle_;
    Vec2 x_, y_;
};

void draw_line(Pen& pen, const PatternLine& line) {
    if (line.kind == LineKind::mark) {
        pen.begin(SheetLayer::draw, line.plate, kMark.color, kMark.width_mm);
    } else {
        pen.begin(layer_of(line.kind), line.plate);
    }
    pen.run(std::array{line.at.a, line.at.b}, false);
}

void draw_lines(Pen& pen, const PatternPiece& piece, SheetLayer layer) {
    for (const PatternLine& line : piece.lines) {
        if (layer_of(line.kind) == layer) draw_line(pen, line);
    }
}

void draw_layer(Pen& pen, const PatternPiece& piece, SheetLayer layer) {
    switch (layer) {
        case SheetLayer::fill:
            for (const Fill& fill : piece.fills) {
                pen.begin(layer, fill.plate, fill.color, 0.0);
                pen.run(fill.area.outer, true);
                for (const Ring& hole : fill.area.holes) pen.run(hole, true);
            }
            return;
        case SheetLayer::draw:
            for (const PatternStroke& drawn : piece.strokes) {
                pen.begin(layer, drawn.plate, drawn.stroke.color, drawn.stroke.width_mm);
                pen.run(drawn.stroke.points, false);
            }
            return draw_lines(pen, piece, layer);
        case SheetLayer::glue:
            for (const GlueTarget& target : piece.targets) {
                pen.begin(layer, target.plate);
                pen.run(target.outline, true);
            }
            return;
        case SheetLayer::label:
            return;  // text, not shapes
        case SheetLayer::valley:
        case SheetLayer::mountain:
        case SheetLayer::seam:
            return draw_lines(pen, piece, layer);
        case SheetLayer::cut:
            for (const Contour& cut : piece.cuts) {
                pen.begin(layer, -1);
                pen.run(cut.points, cut.closed);
            }
            return draw_lines(pen, piece, layer);
    }
    broken_invariant("a layer is one of its enumerators", __FILE__, __LINE__);
}

void draw_piece(SheetDrawing& drawing, const Layout& layout, const Placement& placement) {
    const DesignPattern& design = layout.designs.at(static_cast<std::size_t>(placement.design));
    const PatternPiece& piece = design.pattern.pieces.at(static_cast<std::size_t>(placement.piece));
    SheetPiece& drawn = drawing.pieces.emplace_back();
    drawn.name = visible(layout.piece_name(placement));
    drawn.design = visible(design.stem);
    if (layout.prefix_names) drawn.prefix = drawn.design + ":";
    drawn.copy = placement.copy;
    drawn.plate_names = design.pattern.plate_names;

    Pen pen(drawing, placement);
    for (const SheetLayer layer : kSheetLayers) {
        drawn.first_shape.at(static_cast<std::size_t>(layer)) = drawing.shapes.size();
        draw_layer(pen, piece, layer);
    }
    drawn.first_shape.back() = drawing.shapes.size();

    drawn.first_text = drawing.texts.size();
    for (const Label& label : piece.labels) {
        if (label.text.empty() || label.height_mm <= 0.0) continue;
        drawing.texts.push_back(
            {visible(label.text), pen.at(label.at), label.height_mm, pen.turned(label.angle)});
    }
    drawn.texts = drawing.texts.size() - drawn.first_text;
}

}  // namespace

std::string_view to_string(SheetLayer layer) {
    switch (layer) {
        case SheetLayer::fill:
            return "fill";
        case SheetLayer::draw:
            return "draw";
        case SheetLayer::glue:
            return "glue";
        case SheetLayer::label:
            return "label";
        case SheetLayer::valley:
            return "valley";
        case SheetLayer::mountain:
            return "mountain";
        case SheetLayer::seam:
            return "seam";
        case SheetLayer::cut:
            return "cut";
    }
    broken_invariant("a layer is one of its enumerators", __FILE__, __LINE__);
}

LayerStyle layer_style(SheetLayer layer) {
    switch (layer) {
        case SheetLayer::fill:
        case SheetLayer::draw:
            return {Color{0, 0, 0}, 0.0, false};
        case SheetLayer::glue:
            return {Color{0xa6, 0xa6, 0xa6}, 0.2, false};
        case SheetLayer::label:
            return {Color{0x73, 0x73, 0x73}, 0.0, false};
        case SheetLayer::valley:
            return {Color{0xff, 0x00, 0xff}, 0.3, true};
        case SheetLayer::mountain:
            return {Color{0x00, 0x00, 0xff}, 0.3, true};
        case SheetLayer::seam:
            return {Color{0x00, 0x00, 0x00}, 0.3, true};
        case SheetLayer::cut:
            return {Color{0xff, 0x00, 0x00}, 0.35, false};
    }
    broken_invariant("a layer is one of its enumerators", __FILE__, __LINE__);
}

Dashes fitted_dashes(SheetLayer layer, double length_mm) {
    Dashes dashes;
    double tail = 0.0;  // what of the last period is left out, so that the line ends with its first dash
    switch (layer) {
        case SheetLayer::valley:
            dashes = {{3.0, 1.5}, 2};
            tail = 1.5;
            break;
        case SheetLayer::mountain:
            dashes = {{5.0, 1.2, 1.0, 1.2}, 4};
            tail = 3.4;
            break;
        case SheetLayer::seam:
            dashes = {{1.2, 1.0}, 2};
            tail = 1.0;
            break;
        case SheetLayer::fill:
        case SheetLayer::draw:
        case SheetLayer::glue:
        case SheetLayer::label:
        case SheetLayer::cut:
            return dashes;
    }
    double period = 0.0;
    for (const double mm : dashes.pattern()) period += mm;
    // Two periods at least: the shortest fold still shows that it is one.
    const double periods = std::max(2.0, std::round((length_mm + tail) / period));
    const double scale = length_mm / (periods * period - tail);
    for (double& mm : dashes.mm) mm *= scale;
    return dashes;
}

std::span<const SheetShape> SheetDrawing::shapes_of(const SheetPiece& piece, SheetLayer layer) const {
    const auto i = static_cast<std::size_t>(layer);
    const std::size_t first = piece.first_shape.at(i);
    return std::span(shapes).subspan(first, piece.first_shape.at(i + 1) - first);
}

std::span<const Run> SheetDrawing::runs_of(const SheetShape& shape) const {
    return std::span(runs).subspan(shape.first_run, shape.runs);
}

std::span<const Vec2> SheetDrawing::points_of(const Run& run) const {
    return std::span(points).subspan(run.first, run.count);
}

std::span<const SheetText> SheetDrawing::texts_of(const SheetPiece& piece) const {
    return std::span(texts).subspan(piece.first_text, piece.texts);
}

double SheetDrawing::length_of(const SheetShape& shape) const {
    double sum = 0.0;
    for (const Run& run : runs_of(shape)) {
        const std::span<const Vec2> path = points_of(run);
        for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
        if (run.closed && !path.empty()) sum += distance(path.back(), path.front());
    }
    return sum;
}

SheetDrawing draw_sheet(const Layout& layout, int sheet) {
    SheetDrawing drawing;
    drawing.width_mm = layout.sheets.at(static_cast<std::size_t>(sheet)).width_mm;
    drawing.height_mm = layout.sheets[static_cast<std::size_t>(sheet)].height_mm;
    drawing.title = layout_title(layout);
    if (layout.sheets.size() > 1)
        drawing.title += fmt::format(", sheet {} of {}", sheet + 1, layout.sheets.size());
    const auto first_on = [&layout](int number) {
        return std::partition_point(layout.placements.begin(), layout.placements.end(),
                                    [number](const Placement& p) { return p.sheet < number; });
    };
    const auto last = first_on(sheet + 1);
    for (auto it = first_on(sheet); it != last; ++it) draw_piece(drawing, layout, *it);
    return drawing;
}

std::string layout_title(const Layout& layout) {
    if (layout.designs.empty()) return "popupc";
    std::string title = visible(layout.designs.front().stem);
    if (layout.designs.size() > 1) title += fmt::format(" and {} more", layout.designs.size() - 1);
    return title;
}

std::string_view generator() { return "popupc " POPUP_VERSION; }

}  // namespace popup
