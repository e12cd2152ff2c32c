#include "support/designs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/xml/read.h"
#include "popup/assembly.h"
#include "popup/path.h"

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

Structure& add_tent(Design& design, double at, double half, double out, double wide) {
    return add(design, "tent",
               {{-out, at - half},
                {-out, at + half},
                {out, at - half},
                {out, at + half},
                {-wide, -half},
                {-wide, half},
                {wide, -half},
                {wide, half}});
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

FromXml from_xml(const std::string& structures) {
    FromXml made;
    Diagnostics diagnostics;
    const auto design = xml::read({"card.xml",
                                   "<popup version='3.0' units='mm'><mainpage width='200' height='150'/>"
                                   "<structurelist>" +
                                       structures + "</structurelist></popup>"},
                                  {}, diagnostics);
    const auto checked = design ? check(*design, {}, diagnostics) : std::nullopt;
    if (checked) made.assembly = assemble(*checked, {}, diagnostics);
    made.text = findings(diagnostics);
    return made;
}

std::size_t FromXml::plate(const std::string& name) const {
    for (std::size_t i = 0; i < assembly->plates.size(); ++i) {
        if (assembly->plates[i].name == name) return i;
    }
    ADD_FAILURE() << name;
    return 0;
}

Argument path_argument(const Path& path) {
    DrawnPath drawn;
    drawn.path = path;
    drawn.moved = true;
    Argument made;
    if (enclose(path, drawn.inside) == FlatteningFault::none) made.value = std::move(drawn);
    return made;
}

Argument path_argument(const std::string& text) {
    Path path;
    EXPECT_FALSE(parse_path(text, path)) << text;
    return path_argument(path);
}

Design row(int elements, double scale) {
    const double pitch = 60.0;
    const int groups = std::max(1, elements / 5);
    // The v-fold's V opens by 90°, its piece by 120°.
    const double seam = std::hypot(6, 6);
    const Vec2 e{0, -12};
    const Vec2 g = e + rotated({0, seam}, std::numbers::pi / 3);
    const Vec2 h = e + rotated({0, seam}, -std::numbers::pi / 3);
    const double height = pitch * groups + 20.0;
    Design design = card(300.0, height);
    design.stem = "row";
    for (int group = 0; group < groups; ++group) {
        const double y = -0.5 * height + 10.0 + pitch * group;
        const Vec2 lo{0, -0.5 * height};
        const Vec2 hi{0, 0.5 * height};
        const int page = 1 + 2 * group;
        add(design, "step", {{-40, y}, {-40, y + 25}, {40, y}, {40, y + 25}}, lo, hi);
        add(design, "step", {{-50, y + 5}, {-50, y + 20}, {-30, y + 5}, {-30, y + 20}}, {-40, y},
            {-40, y + 25});
        add(design, "inverted-step", {{-12, y + 5}, {-12, y + 20}, {12, y + 5}, {12, y + 20}}, {0, y},
            {0, y + 25});
        add(design, "tent",
            {{-20, y + 30},
             {-20, y + 55},
             {20, y + 30},
             {20, y + 55},
             {-30, 0},
             {-30, 25},
             {30, 0},
             {30, 25}},
            lo, hi);
        add(design, "v-fold", {{-6, 14}, {0, 8}, {6, 14}, g, e, h, h + Vec2{0, 12}, g + Vec2{0, 12}}, {0, 0},
            {0, 25}, page);
    }
    if (scale == 1.0) return design;
    design.width_mm *= scale;
    design.height_mm *= scale;
    for (Structure& one : design.structures) {
        for (DesignPoint& point : one.points) point.at = scale * point.at;
        one.fold.begin.at = scale * one.fold.begin.at;
        one.fold.end.at = scale * one.fold.end.at;
    }
    return design;
}

}  // namespace popup::test
