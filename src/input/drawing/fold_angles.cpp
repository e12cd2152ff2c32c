#include "input/drawing/fold_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

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

}  // namespace

Angles fold_angles(const Attributes& attributes, std::size_t lines, std::optional<ShapeProblem>& problem) {
    const xml::Attribute* attribute = attributes.find(kFoldAngle);
    if (attribute == nullptr) return {};
    std::string fault;
    std::optional<Angles> angles = angles_in(attribute->value.decoded, fault);
    if (angles && angles->size() == 1) return Angles(lines, angles->front());
    if (angles && angles->size() == lines) return std::move(*angles);
    if (angles)
        fault = fmt::format("'{}' has {} angles, and its element draws {} {}", kFoldAngle, angles->size(),
                            lines, lines == 1 ? "line" : "lines");
    if (!problem) problem = ShapeProblem{attribute, "bad-number", std::move(fault), std::nullopt};
    return {};
}

}  // namespace popup::drawing
