#include "output/sheet_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/render_diagnostics.h"

namespace popup {
namespace {

// A mark is drawn, never cut or folded: a thin grey line.
constexpr Color kMarkColor{0x80, 0x80, 0x80};
constexpr double kMarkMm = 0.2;

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
class Plotter {
 public:
    Plotter(SheetDrawing& drawing, const Profile& the_profile, const Placement& placement)
        : profile(the_profile),
          drawing_(drawing),
          offset_(placement.offset),
          angle_(placement.angle.rad()),
          x_(placement.apply({1, 0}) - placement.offset),
          y_(placement.apply({0, 1}) - placement.offset) {}

    [[nodiscard]] Vec2 at(Vec2 p) const { return offset_ + p.x * x_ + p.y * y_; }
    [[nodiscard]] double turned(double angle) const { return upright(angle + angle_); }

    void begin(Operation operation, int plate, Color color, double width_mm) {
        drawing_.shapes.push_back({operation, drawing_.runs.size(), 0, plate, color, width_mm});
    }
    void begin(Operation operation, int plate) {
        const Pen& pen = profile.pen(operation);
        begin(operation, plate, pen.color, pen.width_mm);
    }
    void run(std::span<const Vec2> points, bool closed) {
        drawing_.runs.push_back({drawing_.points.size(), points.size(), closed});
        for (const Vec2 p : points) drawing_.points.push_back(at(p));
        ++drawing_.shapes.back().runs;
    }

    const Profile& profile;

 private:
    SheetDrawing& drawing_;
    Vec2 offset_;
    double angle_;
    Vec2 x_, y_;
};

void draw_lines(Plotter& plotter, const PatternPiece& piece, Operation operation) {
    for (const PatternLine& line : piece.lines) {
        if (operation_of(line, plotter.profile) != operation) continue;
        if (line.kind == LineKind::mark) {
            plotter.begin(operation, line.plate, kMarkColor, kMarkMm);
        } else {
            plotter.begin(operation, line.plate);
        }
        plotter.run(std::array{line.at.a, line.at.b}, false);
    }
}

void draw_perforations(Plotter& plotter, const PatternPiece& piece) {
    for (const PatternLine& line : piece.lines) {
        if (!plotter.profile.perforates(operation_of(line, plotter.profile)) || line.at.a == line.at.b)
            continue;
        plotter.begin(Operation::perforation, line.plate);
        for (const Segment& cut : perforated(line.at, plotter.profile.perforation))
            plotter.run(std::array{cut.a, cut.b}, false);
    }
}

void draw_cuts(Plotter& plotter, const PatternPiece& piece, Operation operation) {
    for (const Contour& cut : piece.cuts) {
        if (operation_of(cut) != operation) continue;
        plotter.begin(operation, -1);
        plotter.run(cut.points, cut.closed);
    }
    draw_lines(plotter, piece, operation);
}

void draw_operation(Plotter& plotter, const PatternPiece& piece, Operation operation) {
    if (!plotter.profile.draws(operation)) return;
    switch (operation) {
        case Operation::fill:
            for (const Fill& fill : piece.fills) {
                plotter.begin(operation, fill.plate, fill.color, 0.0);
                plotter.run(fill.area.outer, true);
                for (const Ring& hole : fill.area.holes) plotter.run(hole, true);
            }
            return;
        case Operation::draw:
            for (const PatternStroke& drawn : piece.strokes) {
                plotter.begin(operation, drawn.plate, drawn.stroke.color, drawn.stroke.width_mm);
                plotter.run(drawn.stroke.points, false);
            }
            return draw_lines(plotter, piece, operation);
        case Operation::glue:
            for (const GlueTarget& target : piece.targets) {
                plotter.begin(operation, target.plate);
                plotter.run(target.outline, true);
            }
            return draw_lines(plotter, piece, operation);
        case Operation::label:
            return;  // text, not shapes
        case Operation::valley:
        case Operation::mountain:
        case Operation::seam:
            return draw_lines(plotter, piece, operation);
        case Operation::perforation:
            return draw_perforations(plotter, piece);
        case Operation::inner_cut:
        case Operation::outer_cut:
            return draw_cuts(plotter, piece, operation);
    }
    broken_invariant("an operation is one of its enumerators", __FILE__, __LINE__);
}

void draw_piece(SheetDrawing& drawing, const Layout& layout, const Profile& profile,
                const Placement& placement) {
    const DesignPattern& design = layout.designs.at(static_cast<std::size_t>(placement.design));
    const PatternPiece& piece = design.pattern.pieces.at(static_cast<std::size_t>(placement.piece));
    SheetPiece& drawn = drawing.pieces.emplace_back();
    drawn.name = visible(layout.piece_name(placement));
    drawn.design = visible(design.stem);
    if (layout.prefix_names) drawn.prefix = drawn.design + ":";
    drawn.copy = placement.copy;
    drawn.plate_names = design.pattern.plate_names;

    Plotter plotter(drawing, profile, placement);
    for (const Operation operation : kOperations) {
        drawn.first_shape.at(static_cast<std::size_t>(operation)) = drawing.shapes.size();
        draw_operation(plotter, piece, operation);
    }
    drawn.first_shape.back() = drawing.shapes.size();

    drawn.first_text = drawing.texts.size();
    for (const Label& label : piece.labels) {
        if (label.text.empty() || label.height_mm <= 0.0 || !profile.draws(Operation::label)) continue;
        drawing.texts.push_back(
            {visible(label.text), plotter.at(label.at), label.height_mm, plotter.turned(label.angle)});
    }
    drawn.texts = drawing.texts.size() - drawn.first_text;
}

}  // namespace

std::vector<SheetLayer> layers_of(const Profile& profile) {
    std::vector<SheetLayer> layers;
    std::string_view before;
    for (const Operation operation : kOperations) {
        if (!profile.draws(operation)) continue;
        const std::string_view name = profile.pen(operation).layer;
        if (name == before) {
            layers.back().last = operation;
        } else {
            layers.push_back({name, operation, operation});
        }
        before = name;
    }
    return layers;
}

Dashes fitted_dashes(Operation fold, double length_mm) {
    Dashes dashes;
    double tail = 0.0;  // what of the last period is left out, so that the line ends with its first dash
    if (fold == Operation::valley) {
        dashes = {{3.0, 1.5}, 2};
        tail = 1.5;
    } else if (fold == Operation::mountain) {
        dashes = {{5.0, 1.2, 1.0, 1.2}, 4};
        tail = 3.4;
    } else if (fold == Operation::seam) {
        dashes = {{1.2, 1.0}, 2};
        tail = 1.0;
    } else {
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

std::span<const SheetShape> SheetDrawing::shapes_of(const SheetPiece& piece, Operation first,
                                                    Operation last) const {
    const std::size_t begin = piece.first_shape.at(static_cast<std::size_t>(first));
    const std::size_t end = piece.first_shape.at(static_cast<std::size_t>(last) + 1);
    return std::span(shapes).subspan(begin, end - begin);
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

SheetDrawing draw_sheet(const Layout& layout, const Profile& profile, int sheet) {
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
    for (auto it = first_on(sheet); it != last; ++it) draw_piece(drawing, layout, profile, *it);
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
