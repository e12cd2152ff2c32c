#include "output/still/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "output/gltf_values.h"
#include "output/still/shadow.h"
#include "output/still/triangle_rows.h"

namespace popup::still {
namespace {

constexpr int kOver = 3;               // samples along a side of a pixel
constexpr int kBandSamples = 500'000;  // drawn at once
constexpr double kFilled = 0.88;       // of the picture, by the model
constexpr double kLinePx = 1.3;        // width of edges, pixels
// What lies this near behind a line hides it, so that seams do not show through what they are glued to.
constexpr double kHidesMm = 0.02;
constexpr int kSoftPaper = 2;  // texels
constexpr int kSoftGround = 5;
constexpr double kGroundShade = 0.30;
constexpr int kTones = 4096;
// Linear light of the background, at the top and at the bottom.
constexpr Light kSky{0.82F, 0.85F, 0.89F};
constexpr Light kTable{0.69F, 0.72F, 0.77F};

std::size_t index(int number) { return static_cast<std::size_t>(number); }

Light mixed(const Light& a, const Light& b, float share) {
    Light result{};
    for (std::size_t i = 0; i < result.size(); ++i) result.at(i) = a.at(i) + share * (b.at(i) - a.at(i));
    return result;
}
Light scaled(const Light& a, double by) {
    return {static_cast<float>(a[0] * by), static_cast<float>(a[1] * by), static_cast<float>(a[2] * by)};
}

// From linear light to bytes of sRGB.
class Tones {
 public:
    Tones() {
        for (int i = 0; i <= kTones; ++i) {
            const double c = static_cast<double>(i) / kTones;
            const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
            bytes_.at(index(i)) = static_cast<unsigned char>(std::lround(255.0 * s));
        }
        for (int i = 0; i < 256; ++i)
            light_.at(index(i)) = static_cast<float>(linear(static_cast<std::uint8_t>(i)));
    }
    [[nodiscard]] unsigned char byte(float light) const {
        return bytes_[static_cast<std::size_t>(std::clamp(light, 0.0F, 1.0F) * kTones + 0.5F)];
    }
    [[nodiscard]] float light(std::uint8_t byte) const { return light_[byte]; }

 private:
    std::array<unsigned char, kTones + 1> bytes_{};
    std::array<float, 256> light_{};
};

// What a sample sees: nothing (0), a face (its number and one), or an edge (a negative number).
using What = std::int32_t;

template <typename Visit>
void each_point(const Model& model, const Visit& visit) {
    for (const Face& face : model.faces) {
        for (const Vec3 p : face.points) visit(p);
    }
    for (const Edge& edge : model.edges) {
        visit(edge.a);
        visit(edge.b);
    }
}

class Picture {
 public:
    Picture(const Model& model, const Framing& framing, int width, int height)
        : model_(model),
          width_(width),
          height_(height),
          wide_(width * kOver),
          framing_(framing),
          camera_(framing.camera),
          sun_(camera_.back + 0.65 * camera_.up - 0.2 * camera_.right, model, camera_.target,
               framing.radius_mm) {
        camera_.scale *= kOver;
        camera_.cx *= kOver;
        camera_.cy *= kOver;
        sky_ = camera_.up + 0.3 * camera_.back;
        sky_ = (1.0 / std::sqrt(dot(sky_, sky_))) * sky_;
        out_ = {width, height, std::vector<unsigned char>(3 * index(width) * index(height))};
    }

    Pixels run() {
        seen_.reserve(model_.faces.size());
        for (const Face& face : model_.faces) {
            std::vector<Seen>& seen = seen_.emplace_back();
            // What is only there from the front is not seen from behind.
            if (face.points.empty() ||
                (!face.paper && dot(face.frame.normal(), camera_.eye() - face.points.front()) <= 0.0))
                continue;
            seen.reserve(face.points.size());
            for (const Vec3 p : face.points) seen.push_back(camera_.see(p));
        }
        const int rows = std::max(1, kBandSamples / (wide_ * kOver));
        for (int top = 0; top < height_; top += rows) band(top, std::min(height_, top + rows));
        return std::move(out_);
    }

 private:
    // Rows of pixels from `top` up to `bottom`.
    void band(int top, int bottom) {
        top_ = top * kOver;
        const std::size_t samples = index(wide_) * index((bottom - top) * kOver);
        near_.assign(samples, 0.0F);
        what_.assign(samples, 0);
        for (std::size_t i = 0; i < model_.faces.size(); ++i)
            draw(model_.faces[i], seen_[i], static_cast<What>(i + 1), bottom);
        for (std::size_t i = 0; i < model_.edges.size(); ++i)
            draw(model_.edges[i], -static_cast<What>(i + 1), bottom);
        for (int y = top; y < bottom; ++y) {
            for (int x = 0; x < width_; ++x) shade(x, y);
        }
    }

    [[nodiscard]] std::size_t sample(int x, int y) const { return index(y - top_) * index(wide_) + index(x); }

    void draw(const Face& face, const std::vector<Seen>& seen, What number, int bottom) {
        if (seen.empty()) return;
        for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
            const std::array<Seen, 3> corners{seen[face.indices[i]], seen[face.indices[i + 1]],
                                              seen[face.indices[i + 2]]};
            each_row(corners, wide_, top_, bottom * kOver,
                     [&](int y, int first, int last, double near, double step) {
                         const std::size_t row = sample(0, y);
                         for (int x = first; x <= last; ++x, near += step) {
                             const auto depth = static_cast<float>(near);
                             float& nearest = near_[row + index(x)];
                             if (depth <= nearest) continue;
                             if (is_clear(face, x, y, near)) continue;
                             nearest = depth;
                             what_[row + index(x)] = number;
                         }
                     });
        }
    }

    void draw(const Edge& edge, What number, int bottom) {
        const Seen a = camera_.see(edge.a);
        const Seen b = camera_.see(edge.b);
        const double long_px = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
        if (long_px < 1e-9) return;
        const double half = 0.5 * kLinePx * kOver;
        const double nx = -(b.y - a.y) / long_px * half;
        const double ny = (b.x - a.x) / long_px * half;
        const Seen a1{a.x + nx, a.y + ny, a.near};
        const Seen a2{a.x - nx, a.y - ny, a.near};
        const Seen b1{b.x + nx, b.y + ny, b.near};
        const Seen b2{b.x - nx, b.y - ny, b.near};
        const auto fill = [&](int y, int first, int last, double, double) {
            const std::size_t row = sample(0, y);
            for (int x = first; x <= last; ++x) {
                What& what = what_[row + index(x)];
                if (what < 0) continue;
                if (what == 0 || model_.faces[index(what - 1)].plate == edge.plate) {
                    what = number;
                    continue;
                }
                // The face may hide the line and yet lie behind it at this sample, so its plane is compared
                // with the line on the line itself.
                const double px = x + 0.5 - a.x;
                const double py = y + 0.5 - a.y;
                const double t =
                    std::clamp((px * (b.x - a.x) + py * (b.y - a.y)) / (long_px * long_px), 0.0, 1.0);
                const double near = a.near + t * (b.near - a.near);
                const double plane =
                    near_on(model_.faces[index(what - 1)], a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
                if (plane <= 0.0 || 1.0 / near + kHidesMm < 1.0 / plane) what = number;
            }
        };
        each_row({a1, a2, b1}, wide_, top_, bottom * kOver, fill);
        each_row({a2, b2, b1}, wide_, top_, bottom * kOver, fill);
    }

    // How near the plane of a face is at a place of the picture; not above 0: it is not before the eye there.
    [[nodiscard]] double near_on(const Face& face, double x, double y) const {
        const Vec3 way = (1.0 / (camera_.scale * camera_.eye_mm)) *
                             ((x - camera_.cx) * camera_.right + (camera_.cy - y) * camera_.up) -
                         camera_.back;
        return dot(face.frame.normal(), way) / dot(face.frame.normal(), face.frame.origin - camera_.eye());
    }

    [[nodiscard]] Vec3 point(int x, int y, double near) const {
        return camera_.point(x + 0.5, y + 0.5, near);
    }

    // Where a point of a face lies in its picture, in pixels of the level whose pixels are about as large as
    // squares of `samples` samples a side are there.
    struct Spot {
        const Texture::Level* level;
        double u, v;
    };
    [[nodiscard]] Spot spot(const Face& face, Vec3 p, double near, double samples) const {
        const Vec3 d = p - face.frame.origin;
        const Affine& place = face.place;
        const double area = cross(place.x, place.y);
        const Vec2 from = Vec2{dot(d, face.frame.axes[0]), dot(d, face.frame.axes[1])} - place.origin;
        const double samples_per_mm = camera_.scale * camera_.eye_mm * near;
        double pixels = samples / (samples_per_mm * std::sqrt(std::abs(area)));
        const std::vector<Texture::Level>& levels = face.texture->levels;
        std::size_t level = 0;
        for (; pixels >= 1.5 && level + 1 < levels.size(); ++level) pixels *= 0.5;
        return {&levels[level], cross(from, place.y) / area * levels[level].width / levels.front().width,
                cross(place.x, from) / area * levels[level].height / levels.front().height};
    }
    static const std::uint8_t* pixel(const Texture::Level& level, double u, double v) {
        const auto x = index(static_cast<int>(std::clamp(u, 0.0, level.width - 1.0)));
        const auto y = index(static_cast<int>(std::clamp(v, 0.0, level.height - 1.0)));
        return level.rgba.data() + 4 * (y * index(level.width) + x);
    }
    [[nodiscard]] bool is_clear(const Face& face, int x, int y, double near) const {
        if (face.texture == nullptr || face.texture->opaque) return false;
        const Spot at = spot(face, point(x, y, near), near, 1.0);
        return pixel(*at.level, at.u, at.v)[3] < 128;
    }
    // The mean of the four pixels around a point, weighted by how near they are.
    [[nodiscard]] Light picture(const Spot& at) const {
        const double u = std::floor(at.u - 0.5);
        const double v = std::floor(at.v - 0.5);
        const double across = at.u - 0.5 - u;
        const double down = at.v - 0.5 - v;
        Light sum{};
        for (const int k : {0, 1, 2, 3}) {
            const std::uint8_t* rgba = pixel(*at.level, u + k % 2, v + k / 2);
            const double weight = (k % 2 == 0 ? 1.0 - across : across) * (k / 2 == 0 ? 1.0 - down : down);
            add(sum, {tones_.light(rgba[0]), tones_.light(rgba[1]), tones_.light(rgba[2])},
                static_cast<float>(weight));
        }
        return sum;
    }
    // What a face shows at a point to which samples of so many a side belong.
    [[nodiscard]] Light color(const Face& face, Vec3 p, double near, double samples) const {
        const Light light = face.texture == nullptr ? face.color : picture(spot(face, p, near, samples));
        return face.fade > 0.0F ? mixed(light, {kWashedOut, kWashedOut, kWashedOut}, face.fade) : light;
    }

    [[nodiscard]] double light_on(const Face& face, Vec3 p) const {
        const Vec3 front = face.frame.normal();
        const Vec3 normal = dot(front, camera_.eye() - p) > 0.0 ? front : -front;
        return 0.46 + 0.13 * dot(normal, sky_) + 0.53 * sun_.reaches(p, normal, kSoftPaper);
    }

    [[nodiscard]] Light background(int y) const {
        return mixed(kSky, kTable,
                     framing_.plain ? 0.5F : static_cast<float>(y) / static_cast<float>(height_));
    }
    // The background with the model's shadow on the ground.
    [[nodiscard]] Light table(int x, int y) const {
        const Light plain = background(y);
        const Vec3 eye = camera_.eye();
        const Vec3 way = camera_.point((x + 0.5) * kOver, (y + 0.5) * kOver, 1.0 / camera_.eye_mm) - eye;
        constexpr Vec3 up{0, 0, 1};
        const double falls = dot(way, up);
        if (falls >= -1e-6 * camera_.eye_mm) return plain;
        const double share = (framing_.ground_mm - dot(eye, up)) / falls;
        if (share <= 0.0) return plain;
        const Vec3 p = eye + share * way;
        const double full = dot(up, sun_.towards());
        if (full <= 0.0) return plain;
        const double shade = 1.0 - sun_.reaches(p, up, kSoftGround) / full;
        return shade <= 0.0 ? plain : scaled(plain, 1.0 - kGroundShade * shade);
    }

    void shade(int x, int y) {
        const What first = what_[sample(x * kOver, y * kOver)];
        bool alike = first >= 0;
        for (int row = 0; row < kOver && alike; ++row) {
            const What* what = what_.data() + sample(x * kOver, y * kOver + row);
            alike = std::all_of(what, what + kOver, [first](What one) { return one == first; });
        }
        if (alike && first == 0) return put(x, y, table(x, y));
        if (alike) {
            const Face& face = model_.faces[index(first - 1)];
            const int sx = x * kOver + kOver / 2;
            const int sy = y * kOver + kOver / 2;
            const double near = near_[sample(sx, sy)];
            const Vec3 p = point(sx, sy, near);
            return put(x, y, scaled(color(face, p, near, kOver), light_on(face, p)));
        }
        put(x, y, mean(x, y));
    }

    // Sample by sample.
    [[nodiscard]] Light mean(int x, int y) const {
        Light sum{};
        What known = 0;
        double light = 0.0;
        int clear = 0;
        for (int k = 0; k < kOver * kOver; ++k) {
            const int sx = x * kOver + k % kOver;
            const int sy = y * kOver + k / kOver;
            const What what = what_[sample(sx, sy)];
            if (what == 0) {
                ++clear;
                continue;
            }
            if (what < 0) {
                add(sum, model_.edges[index(-what - 1)].ink, 1.0F);
                continue;
            }
            const Face& face = model_.faces[index(what - 1)];
            const double near = near_[sample(sx, sy)];
            const Vec3 p = point(sx, sy, near);
            if (what != known) {
                known = what;
                light = light_on(face, p);
            }
            add(sum, color(face, p, near, 1.0), static_cast<float>(light));
        }
        if (clear > 0) add(sum, table(x, y), static_cast<float>(clear));
        return scaled(sum, 1.0 / (kOver * kOver));
    }

    void put(int x, int y, const Light& light) {
        unsigned char* out = out_.rgb.data() + 3 * (index(y) * index(width_) + index(x));
        for (std::size_t i = 0; i < 3; ++i) out[i] = tones_.byte(light.at(i));
    }

    static void add(Light& sum, const Light& more, float times) {
        for (std::size_t i = 0; i < sum.size(); ++i) sum.at(i) += times * more.at(i);
    }

    const Model& model_;
    int width_, height_, wide_;  // wide_: samples a row
    Framing framing_;
    Camera camera_;  // of samples
    Sun sun_;
    Vec3 sky_;
    Tones tones_;
    std::vector<std::vector<Seen>> seen_;  // of each face: where its points fall; empty: it is not seen
    int top_ = 0;                          // of the band, in samples
    std::vector<float> near_;
    std::vector<What> what_;
    Pixels out_;
};

}  // namespace

void Framer::measure(const Model& model) {
    each_point(model, [this](Vec3 p) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    });
}

Framing Framer::unaimed() const {
    const bool empty = low_.x > high_.x;
    const Vec3 low = empty ? Vec3{} : low_;
    const Vec3 size = (empty ? Vec3{} : high_) - low;
    const double radius = std::max(0.5 * std::sqrt(dot(size, size)), 1e-3);
    return {camera_at(eye_, low + 0.5 * size, radius), radius, low.z, false};
}

void Framer::aim(const Model& model) {
    const Camera camera = unaimed().camera;
    each_point(model, [&](Vec3 p) {
        const Seen seen = camera.see(p);
        seen_.extend({seen.x, seen.y});
    });
}

Framing Framer::framing() const {
    Framing framing = unaimed();
    if (seen_.empty()) return framing;
    Camera& camera = framing.camera;
    camera.scale =
        kFilled * std::min(width_ / std::max(seen_.width(), 1e-6), height_ / std::max(seen_.height(), 1e-6));
    camera.cx = 0.5 * width_ - camera.scale * seen_.centre().x;
    camera.cy = 0.5 * height_ - camera.scale * seen_.centre().y;
    return framing;
}

Framing framing_of(const Model& model, View view, int width, int height) {
    Framer framer(view, width, height);
    framer.measure(model);
    framer.aim(model);
    return framer.framing();
}

Pixels render(const Model& model, const Framing& framing, int width, int height) {
    return Picture(model, framing, width, height).run();
}

}  // namespace popup::still
