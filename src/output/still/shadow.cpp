#include "output/still/shadow.h"

#include <algorithm>
#include <cmath>

#include "output/still/triangle_rows.h"

namespace popup::still {
namespace {

constexpr double kBiasTexels = 2.0;
constexpr int kTaps = 5;             // a side of the square that is looked at
constexpr double kFlatSlope = 0.05;  // of light that grazes a surface

Vec3 unit_of(Vec3 v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

}  // namespace

Sun::Sun(Vec3 towards, const Model& model, Vec3 centre, double radius_mm)
    : back_(unit_of(towards)), centre_(centre) {
    right_ = unit_of(cross(std::abs(back_.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, back_));
    up_ = cross(back_, right_);
    scale_ = 0.48 * kSide / radius_mm;
    bias_mm_ = kBiasTexels / scale_;
    nearest_.assign(static_cast<std::size_t>(kSide) * kSide, -HUGE_VALF);
    for (const Face& face : model.faces) {
        if (!face.paper) continue;
        for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
            const std::array<Seen, 3> corners{see(face.points[face.indices[i]]),
                                              see(face.points[face.indices[i + 1]]),
                                              see(face.points[face.indices[i + 2]])};
            each_row(corners, kSide, 0, kSide, [this](int y, int first, int last, double near, double step) {
                float* texel = nearest_.data() + static_cast<std::ptrdiff_t>(y) * kSide;
                for (int x = first; x <= last; ++x, near += step)
                    texel[x] = std::max(texel[x], static_cast<float>(near));
                first_x_ = std::min(first_x_, first);
                last_x_ = std::max(last_x_, last);
                first_y_ = std::min(first_y_, y);
                last_y_ = std::max(last_y_, y);
            });
        }
    }
}

Seen Sun::see(Vec3 p) const {
    const Vec3 d = p - centre_;
    return {0.5 * kSide + scale_ * dot(d, right_), 0.5 * kSide - scale_ * dot(d, up_), dot(d, back_)};
}

double Sun::reaches(Vec3 p, Vec3 normal, int soft) const {
    const double slope = dot(normal, back_);
    if (slope <= 0.0) return 0.0;
    const Seen at = see(p + bias_mm_ * normal);
    // The surface itself comes nearer to one side of the point.
    const double steep = std::max(slope, kFlatSlope);
    const double by_x = -dot(normal, right_) / (steep * scale_);
    const double by_y = dot(normal, up_) / (steep * scale_);
    // Beyond what the model covers there is nothing to ask.
    const int reach = kTaps / 2 * soft;
    const double x = std::floor(at.x);
    const double y = std::floor(at.y);
    if (x + reach < first_x_ || x - reach > last_x_ || y + reach < first_y_ || y - reach > last_y_)
        return slope;
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const auto lit = [&](int i, int k) {
        const int dx = (i - kTaps / 2) * soft;
        const int dy = (k - kTaps / 2) * soft;
        const int tx = column + dx;
        const int ty = row + dy;
        if (tx < 0 || ty < 0 || tx >= kSide || ty >= kSide) return 1;
        const double near = at.near + by_x * dx + by_y * dy + bias_mm_;
        return near >= static_cast<double>(
                           nearest_[static_cast<std::size_t>(ty) * kSide + static_cast<std::size_t>(tx)])
                   ? 1
                   : 0;
    };
    // Where corners and middle agree, so does the rest, but for what is thinner than the softness.
    const int few = lit(0, 0) + lit(kTaps - 1, 0) + lit(0, kTaps - 1) + lit(kTaps - 1, kTaps - 1) + lit(2, 2);
    if (few == 0 || few == 5) return few == 0 ? 0.0 : slope;
    int all = 0;
    for (int i = 0; i < kTaps; ++i) {
        for (int k = 0; k < kTaps; ++k) all += lit(i, k);
    }
    return slope * all / (kTaps * kTaps);
}

}  // namespace popup::still
