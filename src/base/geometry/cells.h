// Points of the plane by the square cells they fall in, for tables of points that are the same up to
// rounding.
#pragma once

#include <cstddef>
#include <cstdint>

namespace popup {

struct PlaneCell {
    std::int64_t x, y;
    bool operator==(const PlaneCell&) const = default;
};

// Mixed well enough that cells side by side do not share buckets.
struct PlaneCellHash {
    std::size_t operator()(const PlaneCell& c) const {
        auto h = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(c.y);
        h = (h ^ (h >> 31U)) * 0xBF58476D1CE4E5B9ULL;
        return static_cast<std::size_t>(h ^ (h >> 29U));
    }
};

}  // namespace popup
