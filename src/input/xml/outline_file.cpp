#include "input/xml/outline_file.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "input/drawing/read.h"
#include "input/text.h"

namespace popup::xml {
namespace {

void append(const drawing::TracedLine& line, const CurveTable& curves, Path& path) {
    const Restored restored = curves.restored(line.points, true, false);
    if (restored.steps.empty()) {
        path.move(line.points.front());
        for (std::size_t i = 1; i < line.points.size(); ++i) path.line(line.points[i]);
    } else {
        path.move(line.points[restored.start]);
        for (const CurveStep& step : restored.steps) {
            if (step.curve) {
                path.cubic(step.control_1, step.control_2, line.points[step.to]);
            } else {
                path.line(line.points[step.to]);
            }
        }
    }
    path.close();
}

// Right angles are exact.
Vec2 direction_at(double degrees) {
    const double quarters = degrees / 90.0;
    if (quarters != std::floor(quarters)) return rotated({1.0, 0.0}, degrees * std::numbers::pi / 180.0);
    switch ((static_cast<int>(quarters) % 4 + 4) % 4) {
        case 0:
            return {1.0, 0.0};
        case 1:
            return {0.0, 1.0};
        case 2:
            return {-1.0, 0.0};
        default:
            return {0.0, -1.0};
    }
}

}  // namespace

std::string read_outline_drawing(const std::string& name, const std::string& text, OutlineDrawing& drawing) {
    Diagnostics inner(name);
    const std::optional<drawing::Tracing> tracing = drawing::read_tracing({name, text}, {}, inner);
    if (!tracing || inner.has_errors()) {
        const std::vector<Diagnostic> all = inner.sorted();
        const Diagnostic* first = all.empty() ? nullptr : &all.front();
        if (first == nullptr) return "it cannot be read";
        return first->place.line == 0
                   ? first->message
                   : fmt::format("{}:{}: {}", first->place.line, first->place.column, first->message);
    }
    Box box;
    for (const drawing::TracedLine& line : tracing->lines) {
        if (!line.closed || line.points.size() < 3 || line.use == drawing::Use::print) continue;
        append(line, tracing->curves, drawing.path);
        for (const Vec2 p : line.points) box.extend(p);
    }
    if (box.empty()) return "there is no closed line in it";
    drawing.page = tracing->page;
    if (drawing.page.x > 0.0 && drawing.page.y > 0.0) return {};
    drawing.page = {box.width(), box.height()};
    drawing.path = drawing.path.mapped([&box](Vec2 p) { return p - box.min; });
    return {};
}

std::optional<PathRefusal> place_outline(const OutlineDrawing& drawing, const OutlinePlace& place,
                                         DrawnPath& made) {
    Vec2 scale{1.0, 1.0};
    if (place.width_mm) scale.x = scale.y = *place.width_mm / drawing.page.x;
    if (place.height_mm) scale.y = *place.height_mm / drawing.page.y;
    if (place.height_mm && !place.width_mm) scale.x = scale.y;
    const Vec2 right = direction_at(place.rotate_deg);
    const Vec2 up = left_of(right);
    const double width = scale.x * drawing.page.x;
    made = {};
    made.path = drawing.path.mapped([&](Vec2 p) {
        const double x = place.mirror ? width - scale.x * p.x : scale.x * p.x;
        return place.at + x * right + scale.y * p.y * up;
    });
    switch (enclose(made.path, made.inside)) {
        case FlatteningFault::none:
            break;
        case FlatteningFault::too_far:
            return PathRefusal{"leads too far out"};
        case FlatteningFault::too_many:
            return PathRefusal{"has too many points", true};
    }
    if (made.inside.areas.empty()) return PathRefusal{"encloses nothing"};
    return std::nullopt;
}

}  // namespace popup::xml
