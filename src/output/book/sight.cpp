#include "output/book/sight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace popup::book {
namespace {

constexpr double kSightMm = 1e5;  // from where a direction is looked along: all of a model is nearer

// Whether a plate crosses the way from a point, but at that point.
bool crosses(const Polygon& outline, const Frame& plate, Vec3 from, Vec3 way) {
    const double slope = dot(way, plate.normal());
    if (std::abs(slope) < 1e-9) return false;
    const double share = dot(plate.origin - from, plate.normal()) / slope;
    if (share < 1e-6 || share > 1.0) return false;
    const Vec3 d = from + share * way - plate.origin;
    return contains(outline, {dot(d, plate.axes[0]), dot(d, plate.axes[1])});
}

}  // namespace

bool is_hidden(const Placed& placed, Vec3 from, Vec3 eye) {
    const std::vector<Plate>& plates = placed.assembly.plates;
    for (std::size_t i = 0; i < plates.size(); ++i) {
        if (placed.fades[i] >= 0.0F && crosses(plates[i].outline, placed.frames[i], from, eye - from))
            return true;
    }
    return false;
}

Vec3 best_eye(const Placed& placed, std::span<const Vec3> points, std::span<const Vec3> eyes) {
    Vec3 best = eyes.front();
    std::ptrdiff_t most = -1;
    for (const Vec3 eye : eyes) {
        const std::ptrdiff_t seen = std::count_if(points.begin(), points.end(), [&](Vec3 from) {
            return !is_hidden(placed, from, from + kSightMm * unit(eye));
        });
        if (seen <= most) continue;
        most = seen;
        best = eye;
    }
    return best;
}

std::vector<int> hiding(const Placed& placed, std::span<const Vec3> points, Vec3 eye) {
    std::vector<int> found;
    const std::vector<Plate>& plates = placed.assembly.plates;
    for (std::size_t i = 0; i < plates.size(); ++i) {
        if (placed.fades[i] < 0.0F) continue;
        const bool hides = std::any_of(points.begin(), points.end(), [&](Vec3 from) {
            return crosses(plates[i].outline, placed.frames[i], from, kSightMm * unit(eye));
        });
        if (hides) found.push_back(static_cast<int>(i));
    }
    return found;
}

}  // namespace popup::book
