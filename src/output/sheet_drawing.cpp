#include "output/sheet_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/diagnostics/render_diagnostics.h"
#include "base/geometry/regions.h"
#include "base/text/numbers.h"
#include "base/text/text_width.h"
#include "fabrication/broken_score.h"
#include "fabrication/glue_marks.h"
#include "fabrication/marks.h"
#include "fabrication/perforate.h"
#include "output/halos.h"
#include "output/machine_order.h"
#include "output/sheet_carrier.h"
#include "output/sheet_curves.h"
#include "output/sheet_folds.h"
#include "output/sheet_joints.h"
#include "output/sheet_legend.h"
#include "output/sheet_sides.h"
#include "output/stroked_text.h"
#include "output/text_outlines.h"
#include "popup/image.h"

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

// The label with the name of its design before it, no higher than before and no wider than there is room;
// where that cannot be read, as it is.
Label of_design(Label label, std::string_view prefix) {
    constexpr double kLeastTextMm = 1.5;
    if (prefix.empty() || label.text.empty()) return label;
    std::string text = fmt::format("{} {}", prefix, label.text);
    const double wider = text_width(text, 1.0) / text_width(label.text, 1.0);
    const double height = label.height_mm * std::min(1.0, label.room / wider);
    if (height < kLeastTextMm) return label;
    label.text = std::move(text);
    label.height_mm = height;
    return label;
}

double turned(const Carrier& carrier, double angle) {
    return upright(carrier.back() ? std::numbers::pi - angle - carrier.angle() : angle + carrier.angle());
}

class Drawer {
 public:
    Drawer(SheetDrawing& drawing, const Layout& layout, const OutputOptions& options, const SheetView& view)
        : drawing_(drawing), layout_(layout), options_(options), view_(view) {}

    void piece(const Placement& placement) {
        const DesignPattern& design = layout_.designs.at(static_cast<std::size_t>(placement.design));
        const PatternPiece& piece = design.pattern.pieces.at(static_cast<std::size_t>(placement.piece));
        number_ = static_cast<int>(drawing_.pieces.size());
        SheetPiece& drawn = drawing_.pieces.emplace_back();
        drawn.name = visible(layout_.piece_name(placement));
        drawn.design = visible(design.stem);
        if (layout_.prefix_names) drawn.prefix = drawn.design + ":";
        prefix_ = drawn.prefix;
        drawn.copy = placement.copy;
        drawn.plate_names = design.pattern.plate_names;
        carrier_ = Carrier(placement, drawing_.width_mm, view_.back);
        const std::size_t first_shape = drawing_.shapes.size();
        const std::size_t first_text = drawing_.texts.size();
        for (const Operation operation : kOperations) {
            if (is_shown(operation, options_, view_)) draw(piece, operation);
        }
        // What a machine follows is not printed.
        put_halos(drawing_, first_shape, first_text, !drawing_.profile.machine_order);
    }

    void legend(std::span<const Placement> placements) {
        if (!is_shown(Operation::legend, options_, view_) || !drawing_.profile.draws(Operation::legend))
            return;
        number_ = -1;
        carrier_ = Carrier(Placement{}, drawing_.width_mm, view_.back);
        const std::optional<LegendBox> legend = legend_of(drawing_, layout_, placements, view_, options_);
        if (!legend) return;
        for (const LegendLine& line : legend->lines) {
            begin(Operation::legend, -1, line.color, line.width_mm);
            drawing_.shapes.back().filled = line.filled;
            for (const std::vector<Vec2>& stroke : line.strokes) run(stroke, line.filled);
        }
        for (const LegendText& line : legend->texts)
            text(line.text, line.at, kLegendTextMm, 0.0, Operation::legend);
    }

    void sheet() {
        if (!is_shown(Operation::registration, options_, view_)) return;
        number_ = -1;
        const auto marks = [this](const std::vector<SheetMark>& all) {
            for (const SheetMark& mark : all) {
                begin(Operation::registration, -1);
                drawing_.shapes.back().filled = mark.filled;
                run(mark.points, mark.closed);
            }
        };
        // A machine looks for its marks in the same places, whichever side is up.
        carrier_ = Carrier(Placement{}, drawing_.width_mm, false);
        marks(registration_marks(drawing_.profile.marks, drawing_.width_mm, drawing_.height_mm));
        carrier_ = Carrier(Placement{}, drawing_.width_mm, view_.back);
        if (options_.reference_mm <= 0.0) return;
        const ReferenceBar bar = reference_bar(options_.reference_mm, drawing_.width_mm, layout_.margin_mm);
        marks(bar.lines);
        text(number_text(options_.reference_mm, 3) + " mm", bar.figure_at, kFigureMm, 0.0,
             Operation::registration);
    }

 private:
    void begin(Operation operation, int plate, Color color, double width_mm) {
        SheetShape& shape = drawing_.shapes.emplace_back();
        shape.operation = operation;
        shape.first_run = drawing_.runs.size();
        shape.piece = number_;
        shape.plate = plate;
        shape.color = color;
        shape.width_mm = width_mm;
    }
    void area(const Area& area, int plate) {
        begin(Operation::fill, plate, area.color, 0.0);
        drawing_.shapes.back().filled = true;
        region(area.shape);
    }
    void image(const Image& image, int plate) {
        begin(Operation::fill, plate, Color{}, 0.0);
        drawing_.shapes.back().filled = true;
        drawing_.shapes.back().image = static_cast<int>(drawing_.images.size());
        const Vec2 origin = carrier_.at(image.place.origin);
        drawing_.images.push_back({&image,
                                   {carrier_.at(image.place.point({1.0, 0.0})) - origin,
                                    carrier_.at(image.place.point({0.0, 1.0})) - origin, origin}});
        for (const Polygon& one : shown_regions(image)) region(one);
    }
    void region(const Polygon& polygon) {
        run(polygon.outer, true);
        for (const Ring& hole : polygon.holes) run(hole, true);
    }

    void begin(Operation operation, int plate) {
        const Pen& pen = drawing_.profile.pen(operation);
        begin(operation, plate, pen.color, pen.width_mm);
    }
    void run(std::span<const Vec2> points, bool closed) {
        drawing_.runs.push_back({drawing_.points.size(), points.size(), closed});
        for (const Vec2 p : points) drawing_.points.push_back(carrier_.at(p));
        ++drawing_.shapes.back().runs;
    }

    void text(const std::string& written, Vec2 at, double cap_mm, double angle, Operation operation) {
        text({visible(written), carrier_.at(at), cap_mm, turned(carrier_, angle), operation, number_,
              drawing_.profile.pen(operation).color},
             drawing_.profile.outlined_text);
    }
    void text(const Text& own, const std::vector<Polygon>& paper) {
        if (own.text.empty() || own.height_mm <= 0.0) return;
        if (!own.color) return text(own.text, own.at, own.height_mm, own.angle, Operation::label);
        // What is to be read is on the front alone, and turned as its author wanted it.
        if (carrier_.back()) return;
        const std::vector<Polygon> letters = filled(
            text_outlines(visible(own.text), own.at, own.height_mm, own.angle, own.font), FillRule::non_zero);
        // Letters that stick out are cut off at the edge of the paper, so they are outlines in every format.
        constexpr double kNothing = 1e-3;  // mm²
        if (popup::area(subtract(letters, paper)) > kNothing) {
            const std::vector<Polygon> left = intersect(letters, paper);
            if (left.empty()) return;
            begin(Operation::draw, -1, *own.color, 0.0);
            drawing_.shapes.back().filled = true;
            for (const Polygon& one : left) region(one);
            return;
        }
        text({visible(own.text), carrier_.at(own.at), own.height_mm, own.angle + carrier_.angle(),
              Operation::draw, number_, *own.color, own.font},
             drawing_.profile.outlined_text || options_.outlined_print);
    }
    void text(SheetText text, bool outlined) {
        if (!outlined) {
            drawing_.texts.push_back(std::move(text));
            return;
        }
        begin(text.operation, -1);
        drawing_.shapes.back().filled = true;
        drawing_.shapes.back().color = text.color;
        for (const Ring& letter : text_outlines(text.text, text.at, text.cap_mm, text.angle, text.font)) {
            drawing_.runs.push_back({drawing_.points.size(), letter.size(), true});
            drawing_.points.insert(drawing_.points.end(), letter.begin(), letter.end());
            ++drawing_.shapes.back().runs;
        }
        if (drawing_.shapes.back().runs == 0) drawing_.shapes.pop_back();
    }
    // Whether the machine draws such labels on this side, so that no pen needs to. `on_back`: of the paper.
    [[nodiscard]] bool is_marked(LabelKind kind, bool on_back) const {
        if (!is_shown(Operation::mark, options_, view_) || (on_back && !view_.back)) return false;
        const MarksOn where = drawing_.profile.marks_on;
        if (kind == LabelKind::piece) return marks_names(where, options_.score_side, view_.back);
        return marks_joints(where, options_.score_side, view_.back) ||
               (on_back && marks_covered_backs(where, options_.score_side, view_.back));
    }
    void mark(const std::string& written, Vec2 at, double cap_mm, double angle) {
        if (written.empty() || cap_mm <= 0.0) return;
        begin(Operation::mark, -1);
        for (const StrokedLine& line :
             stroked_text(visible(written), carrier_.at(at), cap_mm, turned(carrier_, angle))) {
            drawing_.runs.push_back({drawing_.points.size(), line.points.size(), line.closed});
            drawing_.points.insert(drawing_.points.end(), line.points.begin(), line.points.end());
            ++drawing_.shapes.back().runs;
        }
        if (drawing_.shapes.back().runs == 0) drawing_.shapes.pop_back();
    }
    // Names of pieces are told apart where sheets have pieces of several designs.
    [[nodiscard]] Label labelled(const Label& label, bool has_name) const {
        return has_name || label.kind == LabelKind::piece ? of_design(label, prefix_) : label;
    }
    void marks(const PatternPiece& piece) {
        for (const GlueTarget& target : piece.targets) {
            if (!is_marked(LabelKind::target, target.on_back)) continue;
            for (const std::vector<Vec2>& tick : target_ticks(target.outline)) {
                begin(Operation::mark, target.plate);
                run(tick, false);
            }
        }
        // Where names stand by themselves no tab needs one.
        const bool names = is_marked(LabelKind::piece, false);
        const NamedTab* named = piece.named_tab && !names ? &*piece.named_tab : nullptr;
        for (std::size_t i = 0; i < piece.labels.size(); ++i) {
            const bool has_name = named != nullptr && named->label == i;
            const Label label = labelled(has_name ? named->named : piece.labels[i], has_name);
            if (is_marked(label.kind, label.on_back))
                mark(label.text, label.at, label.height_mm, label.angle);
        }
        if (!names) return mark_hidden_number(piece);
        for (const PatternPrint& one : piece.prints) {
            const Text* own = std::get_if<Text>(&one.print);
            if (own != nullptr && !own->color) mark(own->text, own->at, own->height_mm, own->angle);
        }
    }

    void mark_hidden_number(const PatternPiece& piece) {
        if (!piece.hidden_number || drawing_.profile.marks_on != MarksOn::hidden) return;
        const Label label = labelled(*piece.hidden_number, true);
        if (label.on_back == view_.back) mark(label.text, label.at, label.height_mm, label.angle);
    }

    void texts(const PatternPiece& piece, Operation operation) {
        for (const PatternPrint& one : piece.prints) {
            const Text* own = std::get_if<Text>(&one.print);
            if (own != nullptr && operation_of(one.print) == operation) text(*own, piece.silhouette);
        }
    }

    void lines(const PatternPiece& piece, Operation operation) {
        for (const PatternLine& line : piece.lines) {
            if (line.kind != LineKind::mark || operation_of(line, drawing_.profile) != operation) continue;
            begin(operation, line.plate, kMarkColor, kMarkMm);
            run(std::array{line.at.a, line.at.b}, false);
        }
        const bool broken = is_broken(operation, drawing_.profile, options_.score_side);
        const auto& folds = broken ? broken_folds : folds_to_draw;
        for (const FoldToDraw& fold : folds(piece, operation, drawing_.profile)) {
            begin(operation, fold.plate);
            drawing_.shapes.back().fold_angle = fold.fold_angle;
            if (!broken) run(fold.points, false);
            for (const std::vector<Vec2>& part : fold.parts) run(part, false);
        }
    }

    void perforations(const PatternPiece& piece) {
        std::vector<FoldToDraw> all;
        for (const Operation operation : {Operation::valley, Operation::mountain, Operation::seam}) {
            if (!drawing_.profile.perforates(operation)) continue;
            for (FoldToDraw& fold : folds_to_draw(piece, operation, drawing_.profile))
                all.push_back(std::move(fold));
        }
        std::sort(all.begin(), all.end(),
                  [](const FoldToDraw& a, const FoldToDraw& b) { return a.first < b.first; });
        for (const FoldToDraw& fold : all) {
            begin(Operation::perforation, fold.plate);
            for (const std::vector<Vec2>& cut : perforated_along(fold.points, drawing_.profile.perforation))
                run(cut, false);
        }
    }

    void cuts(const PatternPiece& piece, Operation operation) {
        for (const Contour& cut : piece.cuts) {
            if (operation_of(cut, drawing_.profile) != operation) continue;
            begin(operation, -1);
            drawing_.shapes.back().depth = cut.depth;
            drawing_.shapes.back().outline = cut.closed && cut.depth == 0;
            run(cut.points, cut.closed);
        }
        lines(piece, operation);
    }

    void draw(const PatternPiece& piece, Operation operation) {
        switch (operation) {
            case Operation::fill:
                for (const PatternPrint& one : piece.prints) {
                    if (const Area* painted = std::get_if<Area>(&one.print)) area(*painted, one.plate);
                    if (const Image* shown = std::get_if<Image>(&one.print)) image(*shown, one.plate);
                }
                return;
            case Operation::draw:
                for (const PatternPrint& one : piece.prints) {
                    const Stroke* stroke = std::get_if<Stroke>(&one.print);
                    if (stroke == nullptr) continue;
                    begin(operation, one.plate, stroke->color, stroke->width_mm);
                    run(stroke->points, false);
                }
                texts(piece, operation);
                return lines(piece, operation);
            case Operation::glue:
                for (const GlueTarget& target : piece.targets) {
                    if (target.on_back && !view_.back) continue;
                    begin(operation, target.plate);
                    run(target.outline, true);
                }
                return lines(piece, operation);
            case Operation::label:
                texts(piece, operation);
                for (const Label& own : piece.labels) {
                    const Label label = labelled(own, false);
                    if (label.text.empty() || label.height_mm <= 0.0) continue;
                    if (is_marked(label.kind, label.on_back) || (label.on_back && !view_.back)) continue;
                    text(label.text, label.at, label.height_mm, label.angle, operation);
                }
                return;
            case Operation::legend:
            case Operation::registration:
                return;  // the sheet's
            case Operation::mark:
                return marks(piece);
            case Operation::valley:
            case Operation::mountain:
            case Operation::seam:
                return lines(piece, operation);
            case Operation::perforation:
                return perforations(piece);
            case Operation::slit:
            case Operation::inner_cut:
            case Operation::outer_cut:
                return cuts(piece, operation);
        }
        broken_invariant("an operation is one of its enumerators", __FILE__, __LINE__);
    }

    SheetDrawing& drawing_;
    const Layout& layout_;
    const OutputOptions& options_;
    const SheetView& view_;
    Carrier carrier_{Placement{}, 0.0, false};
    int number_ = -1;
    std::string prefix_;  // of the piece's design
};

// Layer by layer; within a layer operations that look alike stay as they stand, piece by piece or in machine
// order, and others stand apart.
void put_in_layers(SheetDrawing& drawing, const OutputOptions& options, const SheetView& view) {
    std::array<std::size_t, kOperations.size()> layer_of{};
    std::array<std::size_t, kOperations.size()> group_of{};
    const Pen* last = nullptr;
    bool dashed = false;
    std::size_t groups = 0;
    for (const Operation operation : kOperations) {
        if (!is_shown(operation, options, view) || !drawing.profile.draws(operation)) continue;
        const Pen& pen = drawing.profile.pen(operation);
        const std::string& name = pen.layer;
        if (last == nullptr || is_printed(operation) || name != last->layer || pen.color != last->color ||
            pen.width_mm != last->width_mm || dashed != drawing.profile.dashes(operation))
            ++groups;
        last = &pen;
        dashed = drawing.profile.dashes(operation);
        group_of.at(static_cast<std::size_t>(operation)) = groups;
        if (drawing.layers.empty() || drawing.layers.back().name != name) {
            SheetLayer& layer = drawing.layers.emplace_back();
            layer.name = name;
            layer.first = operation;
        }
        drawing.layers.back().last = operation;
        layer_of.at(static_cast<std::size_t>(operation)) = drawing.layers.size() - 1;
    }
    const auto layer = [&layer_of](const auto& thing) {
        return layer_of.at(static_cast<std::size_t>(thing.operation));
    };
    const auto before = [&group_of](const auto& a, const auto& b) {
        return group_of.at(static_cast<std::size_t>(a.operation)) <
               group_of.at(static_cast<std::size_t>(b.operation));
    };
    std::stable_sort(drawing.shapes.begin(), drawing.shapes.end(), before);
    std::stable_sort(drawing.texts.begin(), drawing.texts.end(), before);
    for (const SheetShape& shape : drawing.shapes) ++drawing.layers[layer(shape)].shapes;
    for (const SheetText& text : drawing.texts) ++drawing.layers[layer(text)].texts;
    for (std::size_t i = 1; i < drawing.layers.size(); ++i) {
        const SheetLayer& last = drawing.layers[i - 1];
        drawing.layers[i].first_shape = last.first_shape + last.shapes;
        drawing.layers[i].first_text = last.first_text + last.texts;
    }
}

}  // namespace

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

std::span<const SheetShape> SheetDrawing::shapes_of(const SheetLayer& layer) const {
    return std::span(shapes).subspan(layer.first_shape, layer.shapes);
}

std::span<const SheetText> SheetDrawing::texts_of(const SheetLayer& layer) const {
    return std::span(texts).subspan(layer.first_text, layer.texts);
}

std::span<const Run> SheetDrawing::runs_of(const SheetShape& shape) const {
    return std::span(runs).subspan(shape.first_run, shape.runs);
}

std::span<const Vec2> SheetDrawing::points_of(const Run& run) const {
    return std::span(points).subspan(run.first, run.count);
}

Subpath SheetDrawing::path_of(const Run& run) const {
    const std::span<const Vec2> points = points_of(run);
    if (points.empty()) return {};
    Subpath path;
    path.closed = run.closed;
    path.start = points[run.start];
    if (run.steps > 0) {
        const auto own = std::span(steps).subspan(run.first_step, run.steps);
        path.steps.assign(own.begin(), own.end());
        return path;
    }
    path.steps.reserve(points.size() - 1);
    for (const Vec2 p : points.subspan(1)) path.steps.push_back({p, false, {}, {}});
    return path;
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

SheetDrawing draw_sheet(const Layout& layout, const OutputOptions& options, const SheetView& view) {
    SheetDrawing drawing;
    drawing.profile = profile_of(options, view);
    drawing.width_mm = layout.sheets.at(static_cast<std::size_t>(view.sheet)).width_mm;
    drawing.height_mm = layout.sheets[static_cast<std::size_t>(view.sheet)].height_mm;
    drawing.title = layout_title(layout);
    if (layout.sheets.size() > 1)
        drawing.title += fmt::format(", sheet {} of {}", view.sheet + 1, layout.sheets.size());
    if (view.back) drawing.title += ", back";
    const auto first_on = [&layout](int number) {
        return std::partition_point(layout.placements.begin(), layout.placements.end(),
                                    [number](const Placement& p) { return p.sheet < number; });
    };
    const std::span<const Placement> placements(first_on(view.sheet), first_on(view.sheet + 1));
    Drawer drawer(drawing, layout, options, view);
    for (const Placement& placement : placements) drawer.piece(placement);
    drawer.legend(placements);
    drawer.sheet();
    if (drawing.profile.machine_order) put_in_machine_order(drawing);
    put_in_joints(drawing, layout, placements, view.back);
    put_in_layers(drawing, options, view);
    restore_curves(drawing, layout, placements, view.back);
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
