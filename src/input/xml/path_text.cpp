#include "input/xml/path_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "input/text.h"
#include "input/xml/number.h"
#include "popup/path.h"

namespace popup::xml {
namespace {

// Smaller areas are drawn by mistake, in mm².
constexpr double kLeastArea = 1e-3;

std::string point_text(Vec2 mm, Unit unit) {
    return format_number(mm.x / unit.mm) + " " + format_number(mm.y / unit.mm);
}

std::string ring_text(const Ring& ring, Unit unit) {
    std::string text;
    for (const Vec2 p : ring) text += (text.empty() ? "M " : " L ") + point_text(p, unit);
    return text + " Z";
}

}  // namespace

std::optional<PathRefusal> read_path(std::string_view text, Unit unit, DrawnPath& path) {
    path = {};
    path.text = text;
    Path drawn;
    if (const auto fault = parse_path(text, drawn)) {
        if (fault->too_long) return PathRefusal{fmt::format("has more than {} steps", kStepsLimit), true};
        const std::string_view rest = text.substr(std::min(fault->at, text.size()));
        return PathRefusal{rest.empty() ? std::string("ends where a number is missing")
                                        : fmt::format("cannot be read at \"{}\"", shown(rest))};
    }
    path.path = drawn.mapped([&unit](Vec2 p) { return unit.mm * p; });
    switch (enclose(path.path, path.inside)) {
        case FlatteningFault::none:
            break;
        case FlatteningFault::too_far:
            return PathRefusal{fmt::format("leads further out than {} mm", format_number(kReachMm))};
        case FlatteningFault::too_many:
            return PathRefusal{fmt::format("has more than {} points", kFlatPointsLimit), true};
    }
    if (area(path.inside.areas) < kLeastArea) {
        path.inside = {};
        return PathRefusal{"encloses nothing"};
    }
    return std::nullopt;
}

std::string path_text(const DrawnPath& path, Unit unit) {
    std::string text;
    const auto append = [&](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
    if (!path.moved && !path.text.empty()) return path.text;
    if (path.path.empty()) {
        for (const Polygon& area : path.inside.areas) {
            append(ring_text(area.outer, unit));
            for (const Ring& hole : area.holes) append(ring_text(hole, unit));
        }
        return text;
    }
    for (const Subpath& subpath : path.path.subpaths()) {
        append("M " + point_text(subpath.start, unit));
        for (const PathStep& step : subpath.steps) {
            std::string where = step.curve ? "C " : "L ";
            if (step.curve) {
                for (const Vec2 control : {step.control_1, step.control_2})
                    where.append(point_text(control, unit)).append(" ");
            }
            append(where.append(point_text(step.to, unit)));
        }
        if (subpath.closed) append("Z");
    }
    return text;
}

}  // namespace popup::xml
