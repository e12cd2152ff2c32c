#include "input/drawing/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/number_scanner.h"
#include "input/drawing/size.h"
#include "input/text.h"

namespace popup::drawing {
namespace {

using Problem = std::optional<ShapeProblem>;

double diagonal(Vec2 view) { return std::sqrt(0.5 * dot(view, view)); }

Problem path_shape(const Attributes& attributes, Vec2 /*view*/, Path& path) {
    const xml::Attribute* d = attributes.find("d");
    if (d == nullptr) return std::nullopt;
    const auto fault = parse_path(d->value.decoded, path);
    if (!fault) return std::nullopt;
    if (fault->too_long) {
        return ShapeProblem{d, "document-too-large",
                            fmt::format("this path has more than {} steps", kStepsLimit), fault->at};
    }
    const std::string_view rest = d->value.decoded.substr(std::min(fault->at, d->value.decoded.size()));
    return ShapeProblem{d, "bad-path",
                        rest.empty() ? std::string("the path data ends where a number is missing")
                                     : fmt::format("the path data cannot be read at \"{}\"", shown(rest)),
                        fault->at};
}

Problem rect_shape(const Attributes& attributes, Vec2 view, Path& path) {
    Problem problem;
    const double x = length_of(attributes, "x", view.x, 0.0, problem);
    const double y = length_of(attributes, "y", view.y, 0.0, problem);
    const double width = length_of(attributes, "width", view.x, 0.0, problem);
    const double height = length_of(attributes, "height", view.y, 0.0, problem);
    double rx = length_of(attributes, "rx", view.x, -1.0, problem);
    double ry = length_of(attributes, "ry", view.y, -1.0, problem);
    if (problem || width <= 0.0 || height <= 0.0) return problem;
    // One radius stands for both.
    if (rx < 0.0) rx = std::max(ry, 0.0);
    if (ry < 0.0) ry = rx;
    rx = std::min(rx, 0.5 * width);
    ry = std::min(ry, 0.5 * height);
    const double right = x + width;
    const double bottom = y + height;
    if (rx == 0.0 || ry == 0.0) {
        path.move({x, y});
        path.line({right, y});
        path.line({right, bottom});
        path.line({x, bottom});
    } else {
        const auto corner = [&](Vec2 from, Vec2 to) {
            path.line(from);
            path.arc(rx, ry, 0.0, false, true, to);
        };
        path.move({x + rx, y});
        corner({right - rx, y}, {right, y + ry});
        corner({right, bottom - ry}, {right - rx, bottom});
        corner({x + rx, bottom}, {x, bottom - ry});
        corner({x, y + ry}, {x + rx, y});
    }
    path.close();
    return problem;
}

void add_ellipse(Vec2 centre, double rx, double ry, Path& path) {
    if (rx <= 0.0 || ry <= 0.0) return;
    path.move({centre.x + rx, centre.y});
    path.arc(rx, ry, 0.0, false, true, {centre.x - rx, centre.y});
    path.arc(rx, ry, 0.0, false, true, {centre.x + rx, centre.y});
    path.close();
}

Problem circle_shape(const Attributes& attributes, Vec2 view, Path& path) {
    Problem problem;
    const Vec2 centre{length_of(attributes, "cx", view.x, 0.0, problem),
                      length_of(attributes, "cy", view.y, 0.0, problem)};
    const double r = length_of(attributes, "r", diagonal(view), 0.0, problem);
    if (!problem) add_ellipse(centre, r, r, path);
    return problem;
}

Problem ellipse_shape(const Attributes& attributes, Vec2 view, Path& path) {
    Problem problem;
    const Vec2 centre{length_of(attributes, "cx", view.x, 0.0, problem),
                      length_of(attributes, "cy", view.y, 0.0, problem)};
    const double rx = length_of(attributes, "rx", view.x, -1.0, problem);
    const double ry = length_of(attributes, "ry", view.y, -1.0, problem);
    if (!problem) add_ellipse(centre, rx < 0.0 ? ry : rx, ry < 0.0 ? rx : ry, path);
    return problem;
}

Problem line_shape(const Attributes& attributes, Vec2 view, Path& path) {
    Problem problem;
    path.move({length_of(attributes, "x1", view.x, 0.0, problem),
               length_of(attributes, "y1", view.y, 0.0, problem)});
    path.line({length_of(attributes, "x2", view.x, 0.0, problem),
               length_of(attributes, "y2", view.y, 0.0, problem)});
    return problem;
}

Problem points_shape(const Attributes& attributes, bool closed, Path& path) {
    const xml::Attribute* points = attributes.find("points");
    if (points == nullptr) return std::nullopt;
    const auto numbers = parse_numbers(points->value.decoded);
    if (!numbers) {
        return ShapeProblem{points, "bad-path", "these points are not pairs of numbers", std::nullopt};
    }
    if (numbers->size() % 2 != 0) {
        return ShapeProblem{points, "bad-path", fmt::format("{} numbers do not make pairs", numbers->size()),
                            std::nullopt};
    }
    for (std::size_t i = 0; i < numbers->size(); i += 2) {
        const Vec2 p{(*numbers)[i], (*numbers)[i + 1]};
        if (i == 0) {
            path.move(p);
        } else {
            path.line(p);
        }
    }
    if (closed) path.close();
    return std::nullopt;
}

Problem polyline_shape(const Attributes& attributes, Vec2 /*view*/, Path& path) {
    return points_shape(attributes, false, path);
}
Problem polygon_shape(const Attributes& attributes, Vec2 /*view*/, Path& path) {
    return points_shape(attributes, true, path);
}

struct ShapeRow {
    std::string_view tag;
    Problem (*make)(const Attributes&, Vec2, Path&);
};
constexpr std::array<ShapeRow, 7> kShapes{{{"path", path_shape},
                                           {"rect", rect_shape},
                                           {"circle", circle_shape},
                                           {"ellipse", ellipse_shape},
                                           {"line", line_shape},
                                           {"polyline", polyline_shape},
                                           {"polygon", polygon_shape}}};

const ShapeRow* find_shape(std::string_view tag) {
    const auto* row =
        std::find_if(kShapes.begin(), kShapes.end(), [&](const auto& r) { return r.tag == tag; });
    return row == kShapes.end() ? nullptr : row;
}

}  // namespace

Attributes::Attributes(std::vector<xml::Attribute> all, Entities& entities, std::string_view text)
    : all_(std::move(all)) {
    for (xml::Attribute& one : all_) {
        if (one.value.decoded.find('&') == std::string_view::npos) continue;
        // "&amp;st1;" is no reference, and stays what it is, whatever stands beside it.
        const std::string_view raw = text.substr(one.value.raw.offset, one.value.raw.length);
        if (raw.find("&amp;") != std::string_view::npos || raw.find("&#") != std::string_view::npos) continue;
        std::optional<std::string> value = entities.expanded(one.value.decoded);
        if (value) one.value.decoded = expanded_.emplace_back(std::move(*value));
    }
}

const xml::Attribute* Attributes::find(std::string_view name) const {
    const auto found =
        std::find_if(all_.begin(), all_.end(), [&](const xml::Attribute& a) { return a.name == name; });
    return found == all_.end() ? nullptr : &*found;
}

std::string_view Attributes::value(std::string_view name) const {
    const xml::Attribute* attribute = find(name);
    return attribute == nullptr ? std::string_view{} : trimmed(attribute->value.decoded);
}

void Attributes::put(std::string_view name, std::string_view value, Place place) {
    std::erase_if(all_, [&](const xml::Attribute& a) { return a.name == name; });
    xml::Attribute one;
    one.name = expanded_.emplace_back(name);
    one.value.decoded = expanded_.emplace_back(value);
    one.value.place = one.place = place;
    all_.push_back(one);
}

double length_of(const Attributes& attributes, std::string_view name, double whole, double otherwise,
                 std::optional<ShapeProblem>& problem) {
    const xml::Attribute* attribute = attributes.find(name);
    if (attribute == nullptr) return otherwise;
    const std::string_view text = trimmed(attribute->value.decoded);
    if (text == "auto") return otherwise;
    if (const auto length = parse_length(text, whole)) return *length;
    if (!problem) {
        problem =
            ShapeProblem{attribute, "bad-number",
                         fmt::format("'{}' is \"{}\", which is no length", name, shown(text)), std::nullopt};
    }
    return otherwise;
}

bool is_shape(std::string_view tag) { return find_shape(tag) != nullptr; }

std::optional<ShapeProblem> make_shape(std::string_view tag, const Attributes& attributes, Vec2 view,
                                       Path& path) {
    const ShapeRow* row = find_shape(tag);
    return row == nullptr ? std::nullopt : row->make(attributes, view, path);
}

}  // namespace popup::drawing
