#include "support/designs.h"

#include <gtest/gtest.h>

#include "popup/assembly.h"

namespace popup::test {

Design card(double width_mm, double height_mm) {
    Design design;
    design.file = "card.xml";
    design.stem = "card";
    design.unit = {"mm", 1.0};
    design.width_mm = width_mm;
    design.height_mm = height_mm;
    return design;
}

Structure& add(Design& design, const std::string& type, const std::vector<Vec2>& points, Vec2 begin, Vec2 end,
               int page) {
    Structure structure;
    structure.type = type;
    structure.id = "e" + std::to_string(design.structures.size() + 1);
    structure.place = {static_cast<int>(design.structures.size()) + 1, 1};
    for (const Vec2 p : points) {
        DesignPoint point;
        point.at = p;
        structure.points.push_back(point);
    }
    structure.fold.page = page;
    structure.fold.begin.at = begin;
    structure.fold.end.at = end;
    return design.structures.emplace_back(std::move(structure));
}

Structure& add(Design& design, const std::string& type, const std::vector<Vec2>& points) {
    return add(design, type, points, {0, -0.5 * design.height_mm}, {0, 0.5 * design.height_mm});
}

std::string findings(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& d : diagnostics.sorted()) {
        text += std::string(to_string(d.severity)) + " " + d.code + ": " + d.message;
        if (d.change) text += " [" + d.change->before + " -> " + d.change->after + "]";
        text += "\n";
    }
    return text;
}

Built build(const Design& design, const CheckOptions& options) {
    Built built;
    built.checked = check(design, options, built.diagnostics);
    if (built.checked) built.assembly = assemble(*built.checked, {}, built.diagnostics);
    if (!built.assembly) ADD_FAILURE() << findings(built.diagnostics);
    return built;
}

}  // namespace popup::test
