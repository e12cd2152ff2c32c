#include "output/sheet_curves.h"

#include "output/sheet_carrier.h"

namespace popup {
namespace {

// Letters come from a font, and perforations lie along chords.
bool may_have_curves(Operation operation) {
    return is_cut(operation) || is_fold(operation) || operation == Operation::fill ||
           operation == Operation::draw || operation == Operation::glue;
}

void restore(SheetDrawing& drawing, Run& run, const CurveTable& curves, const Carrier& carrier) {
    if (run.count < 3) return;
    const std::span<const Vec2> points = drawing.points_of(run);
    std::vector<Vec2> on_page;
    on_page.reserve(points.size());
    for (const Vec2 p : points) on_page.push_back(carrier.page(p));
    const Restored restored = curves.restored(on_page, run.closed, drawing.profile.machine_order);
    if (restored.steps.empty()) return;
    run.start = restored.start;
    run.first_step = drawing.steps.size();
    for (const CurveStep& step : restored.steps) {
        PathStep& made = drawing.steps.emplace_back();
        made.to = points[step.to];
        if (!step.curve) continue;
        made.curve = true;
        made.control_1 = carrier.at(step.control_1);
        made.control_2 = carrier.at(step.control_2);
    }
    // The line that closes a run is not drawn.
    if (run.closed && !drawing.steps.back().curve) drawing.steps.pop_back();
    run.steps = drawing.steps.size() - run.first_step;
}

}  // namespace

void restore_curves(SheetDrawing& drawing, const Layout& layout, std::span<const Placement> placements,
                    bool back) {
    for (const SheetShape& shape : drawing.shapes) {
        if (shape.piece < 0 || !may_have_curves(shape.operation)) continue;
        const Placement& placement = placements[static_cast<std::size_t>(shape.piece)];
        const CurveTable& curves = layout.designs[static_cast<std::size_t>(placement.design)].pattern.curves;
        if (curves.empty()) continue;
        const Carrier carrier(placement, drawing.width_mm, back);
        for (std::size_t i = 0; i < shape.runs; ++i) {
            restore(drawing, drawing.runs[shape.first_run + i], curves, carrier);
        }
    }
}

}  // namespace popup
