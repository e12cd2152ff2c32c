#include "input/xml/path_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "input/text.h"
#include "input/xml/number.h"
#include "parts/joining.h"
#include "parts/spurs.h"
#include "popup/path.h"

namespace popup::xml {
namespace {

// Smaller areas are drawn by mistake, in mm².
constexpr double kLeastArea = 1e-3;
// Shorter slits are slips of a drawing program, in mm.
constexpr double kLeastSlit = 0.5;

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

std::vector<std::vector<Vec2>> slits_of(const DrawnPath& path, bool is_hole) {
    std::vector<std::vector<Vec2>> slits;
    Flattened flat;
    if (flatten(path.path, flat) != FlatteningFault::none) return slits;
    for (Polyline& line : flat.lines) {
        std::vector<Vec2>& points = line.points;
        while (points.size() > 2 && points.back() == points.front()) points.pop_back();
        if (points.size() == 2) slits.push_back(points);
        for (std::vector<Vec2>& spur : spurs_of(points)) slits.push_back(std::move(spur));
    }
    std::erase_if(slits, [&](const std::vector<Vec2>& slit) {
        if (drawing::length_of(slit) < kLeastSlit) return true;
        const Vec2 middle = lerp(slit[0], slit[1], 0.5);
        const bool within = std::any_of(path.inside.areas.begin(), path.inside.areas.end(),
                                        [middle](const Polygon& area) { return contains(area, middle); });
        return within == is_hole;
    });
    return slits;
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
