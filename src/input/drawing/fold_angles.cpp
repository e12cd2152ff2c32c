#include "input/drawing/fold_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "base/geometry/regions.h"
#include "base/text/shown.h"
#include "input/xml/number.h"

namespace popup::drawing {
namespace {

constexpr std::string_view kBetween = " \t\r\n,";
constexpr double kMostDeg = 180.0;

using Angles = std::vector<std::optional<double>>;

// The words of the attribute; nullopt after a fault.
std::optional<Angles> angles_in(std::string_view text, std::string& fault) {
    Angles angles;
    for (std::size_t at = text.find_first_not_of(kBetween); at < text.size();
         at = text.find_first_not_of(kBetween, at)) {
        const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
        const std::string_view word = text.substr(at, end - at);
        at = end;
        if (word == "auto") {
            angles.emplace_back();
            continue;
        }
        const xml::ParsedNumber number = xml::parse_number(word);
        if (number.fault != xml::NumberFault::none || std::abs(number.value) > kMostDeg) {
            fault = fmt::format("'{}' has \"{}\", which is no angle from -180 to 180 degrees, nor auto",
                                kFoldAngle, shown(std::string(word)));
            return std::nullopt;
        }
        angles.emplace_back(number.value);
    }
    return angles;
}

std::vector<Polyline> as_lines(const std::vector<Segment>& sides) {
    std::vector<Polyline> lines;
    lines.reserve(sides.size());
    for (const Segment& side : sides) lines.push_back({{side.a, side.b}, false});
    return lines;
}

}  // namespace

std::vector<Segment> straight_sides(const Path& path) {
    const auto is_near = [](Vec2 p) { return std::abs(p.x) <= kReachMm && std::abs(p.y) <= kReachMm; };
    std::vector<Segment> sides;
    const auto add = [&](Vec2 from, Vec2 to) {
        if (from != to) sides.push_back({from, to});
    };
    for (const Subpath& subpath : path.subpaths()) {
        if (!is_near(subpath.start)) return {};
        const Vec2 start = on_grid(subpath.start);
        Vec2 at = start;
        for (const PathStep& step : subpath.steps) {
            if (step.curve || !is_near(step.to)) return {};
            const Vec2 to = on_grid(step.to);
            add(at, to);
            at = to;
        }
        if (subpath.closed) add(at, start);
    }
    return sides;
}

FoldAngles fold_angles(const Attributes& attributes, std::size_t lines, const Path& path,
                       std::optional<double> around, std::optional<ShapeProblem>& problem) {
    const xml::Attribute* attribute = attributes.find(kFoldAngle);
    if (attribute == nullptr) return around ? FoldAngles{Angles(lines, around), {}} : FoldAngles{};
    std::string fault;
    std::optional<Angles> angles = angles_in(attribute->value.decoded, fault);
    if (angles && angles->size() == 1) return {Angles(lines, angles->front()), {}};
    if (angles && angles->size() == lines) return {std::move(*angles), {}};
    if (angles) {
        const std::vector<Segment> sides = straight_sides(path);
        if (angles->size() == sides.size()) return {std::move(*angles), as_lines(sides)};
        fault = fmt::format("'{}' has {} angles, and its element draws {} {}", kFoldAngle, angles->size(),
                            lines, lines == 1 ? "line" : "lines");
        if (sides.size() > lines) fault += fmt::format(" with {} sides", sides.size());
    }
    if (!problem) problem = ShapeProblem{attribute, "bad-number", std::move(fault), std::nullopt};
    return {};
}

std::optional<double> inherited_angle(const Attributes& attributes, std::optional<double> around,
                                      std::optional<ShapeProblem>& problem) {
    const xml::Attribute* attribute = attributes.find(kFoldAngle);
    if (attribute == nullptr) return around;
    std::string fault;
    const std::optional<Angles> angles = angles_in(attribute->value.decoded, fault);
    if (angles && angles->size() == 1) return angles->front();
    if (angles)
        fault = fmt::format("'{}' of a group has {} angles, and not one for all folds in it", kFoldAngle,
                            angles->size());
    problem = ShapeProblem{attribute, "bad-number", std::move(fault), std::nullopt};
    return std::nullopt;
}

}  // namespace popup::drawing
