#include "output/still/shadow.h"

#include <algorithm>
#include <cmath>

#include "output/still/triangle_rows.h"

namespace popup::still {
namespace {

constexpr int kSide = 512;         // texels across the model, of the coarsest map
constexpr int kSmallPixels = 400;  // pictures of more have a map that is twice as fine
constexpr int kMaxFiner = 2;
constexpr double kFilled = 0.96;
constexpr double kBiasTexels = 2.0;
constexpr double kFlatSlope = 0.05;  // of light that grazes a surface
// Texels of the coarsest map from tap to tap.
constexpr double kSoftPaper = 1.0;
constexpr double kSoftGround = 2.5;
constexpr int kReach = Sun::kTaps / 2;
// Taps around a place that is as far from what is covered as any tap reaches, and half a texel of rounding.
constexpr int kBorder = 2 * kReach * static_cast<int>(kMaxFiner * kSoftGround) + 1;
}  // namespace

Sun::Sun(Vec3 towards, const Model& model, Vec3 centre, double radius_mm, int pixels)
    : back_(unit(towards)), centre_(centre), finer_(pixels > kSmallPixels ? kMaxFiner : 1) {
    right_ = unit(cross(std::abs(back_.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, back_));
    up_ = cross(back_, right_);
    scale_ = 0.5 * kFilled * kSide * finer_ / radius_mm;
    bias_mm_ = kBiasTexels / scale_;
    Box covered;
    for (const Face& face : model.faces) {
        if (!face.paper) continue;
        for (const Vec3 p : face.points) {
            const Vec3 at = turned(p - centre_);
            covered.extend({at.x, at.y});
        }
    }
    if (covered.empty()) return;
    first_x_ = std::floor(covered.min.x) - kBorder;
    first_y_ = std::floor(covered.min.y) - kBorder;
    columns_ = static_cast<int>(covered.max.x - first_x_) + kBorder + 1;
    rows_ = static_cast<int>(covered.max.y - first_y_) + kBorder + 1;
    nearest_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -HUGE_VALF);
    std::vector<Seen> seen;
    for (const Face& face : model.faces) {
        if (!face.paper) continue;
        seen.clear();
        for (const Vec3 p : face.points) {
            const Vec3 at = place(p);
            seen.push_back({at.x, at.y, at.z});
        }
        each_convex(face.indices, seen, [this](std::span<const Seen> polygon) { throw_shadow(polygon); });
    }
}

void Sun::throw_shadow(std::span<const Seen> corners) {
    // The plane of the first triangle of the fan that is no sliver.
    constexpr double kSliver = 1e-3;  // of the largest
    const Seen& a = corners[0];
    const auto area_of = [&](std::size_t i) {
        const Seen& p = corners[i];
        const Seen& q = corners[i + 1];
        return (p.x - a.x) * (q.y - a.y) - (p.y - a.y) * (q.x - a.x);
    };
    double largest = 0.0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) largest = std::max(largest, std::abs(area_of(i)));
    std::size_t first_sound = 1;
    while (first_sound + 2 < corners.size() && std::abs(area_of(first_sound)) < kSliver * largest)
        ++first_sound;
    const Seen& b = corners[first_sound];
    const Seen& c = corners[first_sound + 1];
    const double area = area_of(first_sound);
    const double by_x = ((b.near - a.near) * (c.y - a.y) - (c.near - a.near) * (b.y - a.y)) / area;
    const double by_y = ((c.near - a.near) * (b.x - a.x) - (b.near - a.near) * (c.x - a.x)) / area;
    each_row(corners, columns_, 0, rows_, [&](int y, int first, int last) {
        float* texel = nearest_.data() + static_cast<std::ptrdiff_t>(y) * columns_ + first;
        const auto from = static_cast<float>(a.near + by_x * (first + 0.5 - a.x) + by_y * (y + 0.5 - a.y));
        const auto by = static_cast<float>(by_x);
        for (int i = 0; i <= last - first; ++i) {
            const float one = from + static_cast<float>(i) * by;
            texel[i] = one > texel[i] ? one : texel[i];
        }
    });
}

Sun::Surface Sun::surface(Vec3 normal, Softness softness) const {
    Surface surface;
    surface.slope = std::max(0.0, dot(normal, back_));
    surface.soft =
        std::max(1, static_cast<int>(finer_ * (softness == Softness::paper ? kSoftPaper : kSoftGround)));
    surface.shift = turned(bias_mm_ * normal);
    surface.shift.z += bias_mm_;
    // The surface itself comes nearer to one side of the point.
    const double steep = std::max(surface.slope, kFlatSlope);
    for (int i = 0; i < kTaps; ++i) {
        const double away = (i - kReach) * surface.soft / (steep * scale_);
        surface.by_column.at(static_cast<std::size_t>(i)) = static_cast<float>(-dot(normal, right_) * away);
        surface.by_row.at(static_cast<std::size_t>(i)) = static_cast<float>(dot(normal, up_) * away);
    }
    return surface;
}

std::array<Vec3, 2> Sun::shaded(const Surface& surface) const {
    const int edge = kBorder - kReach * surface.soft;
    return {Vec3{static_cast<double>(edge), static_cast<double>(edge), 0},
            Vec3{static_cast<double>(columns_ - edge), static_cast<double>(rows_ - edge), 0}};
}

Vec3 Sun::meets(Vec3 place, Vec3 on, Vec3 normal) const {
    const Vec3 p = centre_ + ((place.x + first_x_) / scale_) * right_ - ((place.y + first_y_) / scale_) * up_;
    return p + (dot(normal, on - p) / dot(normal, back_)) * back_;
}

int Sun::lit(const Surface& surface, Vec3 place) const {
    const double x = place.x + surface.shift.x;
    const double y = place.y + surface.shift.y;
    // Beyond what the model covers there is nothing to ask.
    const int edge = kBorder - kReach * surface.soft;
    if (!(x >= edge && y >= edge && x < columns_ - edge && y < rows_ - edge)) return kRays;
    const auto near = static_cast<float>(place.z + surface.shift.z);
    const float* middle = nearest_.data() + static_cast<std::ptrdiff_t>(y) * columns_ + static_cast<int>(x);
    const auto reaches = [&](int i, int k) {
        const std::ptrdiff_t down = static_cast<std::ptrdiff_t>(k - kReach) * surface.soft * columns_;
        const float surface_near = near + (surface.by_column[static_cast<std::size_t>(i)] +
                                           surface.by_row[static_cast<std::size_t>(k)]);
        return surface_near >= middle[down + static_cast<std::ptrdiff_t>(i - kReach) * surface.soft] ? 1 : 0;
    };
    // Where corners and middle agree, so does the rest, but for what is thinner than the softness.
    constexpr int last = kTaps - 1;
    const int few =
        reaches(0, 0) + reaches(last, 0) + reaches(0, last) + reaches(last, last) + reaches(kReach, kReach);
    if (few == 0 || few == 5) return few == 0 ? 0 : kRays;
    int all = 0;
    for (int k = 0; k < kTaps; ++k) {
        for (int i = 0; i < kTaps; ++i) all += reaches(i, k);
    }
    return all;
}

}  // namespace popup::still
