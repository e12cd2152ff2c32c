// What all emitted documents have in common: how numbers, points and areas stand in them, as emit.h says.
#pragma once

#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/text/numbers.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/print.h"

namespace popup::emitted {

using Json = nlohmann::ordered_json;

inline constexpr int kLength = 6;     // decimals of a millimetre
inline constexpr int kAngle = 7;      // of a degree
inline constexpr int kDirection = 9;  // of a unit vector
inline constexpr int kClosure = 9;    // of a millimetre

inline Json mm(double value) { return rounded(value, kLength); }
inline Json degrees(double radians) { return rounded(radians * 180.0 / std::numbers::pi, kAngle); }
inline Json json(Vec2 p) { return Json::array({mm(p.x), mm(p.y)}); }
inline Json json(const Segment& s) { return Json::array({json(s.a), json(s.b)}); }
inline Json json(Place place) { return Json::array({place.line, place.column}); }
inline Json json(Color color) { return to_string(color); }

template <typename T>
Json json(const std::optional<T>& value) {
    return value ? json(*value) : Json();
}

inline Json json(const std::vector<Vec2>& points) {
    Json list = Json::array();
    for (const Vec2 p : points) list.push_back(json(p));
    return list;
}

inline Json json(const Polygon& polygon) {
    Json holes = Json::array();
    for (const Ring& hole : polygon.holes) holes.push_back(json(hole));
    return {{"outer", json(polygon.outer)}, {"holes", std::move(holes)}};
}

// A JSON list of `make` of each.
template <typename T, typename Make>
Json list(const std::vector<T>& values, Make make) {
    Json result = Json::array();
    for (const T& value : values) result.push_back(make(value));
    return result;
}

}  // namespace popup::emitted
