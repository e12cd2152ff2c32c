// What the picture on a face shows at a point of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "output/still/model.h"

namespace popup::still {

// Where a point lies in a face's picture, in pixels of one of its levels.
struct TextureSpot {
    const Texture::Level* level;
    double u, v;
};

// On the level whose pixels are about as large as `seen_mm` on the face. Precondition: the face has a
// texture.
inline TextureSpot texture_spot(const Face& face, Vec3 p, double seen_mm) {
    const Vec3 d = p - face.frame.origin;
    const Affine& place = face.place;
    const double area = cross(place.x, place.y);
    const Vec2 from = Vec2{dot(d, face.frame.axes[0]), dot(d, face.frame.axes[1])} - place.origin;
    double pixels = seen_mm / std::sqrt(std::abs(area));
    const std::vector<Texture::Level>& levels = face.texture->levels;
    std::size_t level = 0;
    for (; pixels >= 1.5 && level + 1 < levels.size(); ++level) pixels *= 0.5;
    return {&levels[level], cross(from, place.y) / area * levels[level].width / levels.front().width,
            cross(place.x, from) / area * levels[level].height / levels.front().height};
}

// The four bytes of the pixel there; beyond the picture those of its edge.
inline const std::uint8_t* texture_pixel(const Texture::Level& level, double u, double v) {
    const auto x = static_cast<std::size_t>(std::clamp(u, 0.0, level.width - 1.0));
    const auto y = static_cast<std::size_t>(std::clamp(v, 0.0, level.height - 1.0));
    return level.rgba.data() + 4 * (y * static_cast<std::size_t>(level.width) + x);
}

// The mean of the four pixels around a point, weighted by how near they are. `light` is that of each byte.
inline Light texture_light(const TextureSpot& at, const std::array<float, 256>& light) {
    const double u = std::floor(at.u - 0.5);
    const double v = std::floor(at.v - 0.5);
    const double across = at.u - 0.5 - u;
    const double down = at.v - 0.5 - v;
    Light sum{};
    for (const int k : {0, 1, 2, 3}) {
        const int below = k / 2;
        const std::uint8_t* rgba = texture_pixel(*at.level, u + k % 2, v + below);
        const auto weight =
            static_cast<float>((k % 2 == 0 ? 1.0 - across : across) * (below == 0 ? 1.0 - down : down));
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * light[rgba[c]];
    }
    return sum;
}

}  // namespace popup::still
