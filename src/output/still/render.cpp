#include "output/still/render.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "output/gltf_values.h"
#include "output/still/samples.h"
#include "output/still/shadow.h"
#include "output/still/texture.h"

namespace popup::still {
namespace {

constexpr int kBandPixels = 8'000;  // drawn at once: few enough for a processor's cache
constexpr double kFilled = 0.88;    // of the picture, by the model
constexpr double kGroundShade = 0.30;
// Pixels; shadows on paper, and on the ground, have softer edges.
constexpr int kPaperStep = 4;
constexpr int kGroundStep = 8;
constexpr int kTones = 4096;
// Linear light of the background, at the top and at the bottom.
constexpr Light kSky{0.82F, 0.85F, 0.89F};
constexpr Light kTable{0.69F, 0.72F, 0.77F};
constexpr Vec3 kUp{0, 0, 1};

using Bytes = std::array<unsigned char, 3>;

constexpr std::size_t index(int number) { return static_cast<std::size_t>(number); }

Light mixed(const Light& a, const Light& b, float share) {
    Light result{};
    for (std::size_t i = 0; i < result.size(); ++i) result.at(i) = a.at(i) + share * (b.at(i) - a.at(i));
    return result;
}
Light scaled(const Light& a, double by) {
    return {static_cast<float>(a[0] * by), static_cast<float>(a[1] * by), static_cast<float>(a[2] * by)};
}

// From linear light to bytes of sRGB, and back.
struct Tones {
    Tones() {
        for (int i = 0; i <= kTones; ++i) {
            const double c = static_cast<double>(i) / kTones;
            const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
            bytes.at(index(i)) = static_cast<unsigned char>(std::lround(255.0 * s));
        }
        for (int i = 0; i < 256; ++i)
            light.at(index(i)) = static_cast<float>(linear(static_cast<std::uint8_t>(i)));
    }
    [[nodiscard]] Bytes of(const Light& light) const {
        return {byte(light[0]), byte(light[1]), byte(light[2])};
    }
    [[nodiscard]] unsigned char byte(float light) const {
        const float tone = std::clamp(light, 0.0F, 1.0F) * kTones + 0.5F;
        return bytes[static_cast<std::size_t>(tone)];
    }

    std::array<unsigned char, kTones + 1> bytes{};
    std::array<float, 256> light{};
};
const Tones& tones() {
    static const Tones kAll;
    return kAll;
}

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

Camera of_samples(Camera camera) {
    camera.scale *= kOver;
    camera.cx *= kOver;
    camera.cy *= kOver;
    return camera;
}

class Picture {
 public:
    Picture(const Model& model, const Framing& framing, int width, int height)
        : model_(model),
          width_(width),
          height_(height),
          framing_(framing),
          camera_(of_samples(framing.camera)),
          sun_(camera_.back + 0.65 * camera_.up - 0.2 * camera_.right, model, camera_.target,
               framing.radius_mm, std::min(width, height)),
          samples_(model, camera_, width, height),
          ground_(sun_.surface(kUp, Sun::Softness::ground)) {
        const double by = 1.0 / (camera_.scale * camera_.eye_mm);
        eye_ = sun_.place(camera_.eye());
        across_ = sun_.turned(by * camera_.right);
        down_ = sun_.turned(-by * camera_.up);
        corner_ = sun_.turned(-camera_.back) - camera_.cx * across_ - camera_.cy * down_;
        falls_across_ = by * camera_.right.z;
        falls_down_ = -by * camera_.up.z;
        falls_ = -camera_.back.z - camera_.cx * falls_across_ - camera_.cy * falls_down_;
        under_eye_mm_ = framing.ground_mm - camera_.eye().z;
        const Vec3 sky = unit(camera_.up + 0.3 * camera_.back);
        looks_.reserve(model.faces.size());
        for (const Face& face : model.faces) looks_.push_back(look_of(face, sky));
        find_shade();
        out_ = {width, height, std::vector<unsigned char>(3 * index(width) * index(height))};
    }

    Pixels run() {
        const PixelBox& box = samples_.box();
        for (int y = 0; y < height_; ++y) {
            row_light_ = background(y);
            row_bytes_ = tones_.of(row_light_);
            fill_row(y);
            const bool is_seen = y >= box.low_y && y < box.high_y;
            shade_table(y, 0, is_seen ? box.low_x : width_);
            if (!is_seen) continue;
            if (y >= drawn_) {
                const int rows = std::max(1, kBandPixels / (box.high_x - box.low_x));
                drawn_ = std::min(box.high_y, y + rows);
                samples_.draw(y, drawn_);
            }
            shade_model(y);
            shade_table(y, box.high_x, width_);
        }
        return std::move(out_);
    }

 private:
    // What is the same all over a face.
    struct Look {
        double shade = 0.0;  // light that reaches it where the sun does not
        double sun = 0.0;    // and what the sun adds
        Sun::Surface surface;
        Light color{};        // of its own, without a picture
        Bytes lit{}, dark{};  // of its colour, where the sun reaches it and where not
    };

    [[nodiscard]] Look look_of(const Face& face, Vec3 sky) const {
        Look look;
        const Vec3 front = face.frame.normal();
        const bool is_front = dot(front, camera_.eye() - face.frame.origin) > 0.0;
        const Vec3 normal = is_front ? front : -front;
        look.surface = sun_.surface(normal, Sun::Softness::paper);
        look.shade = 0.46 + 0.13 * dot(normal, sky);
        look.sun = 0.53 * look.surface.slope;
        look.color = faded(face, is_front || !face.back ? face.color : *face.back);
        look.lit = tones_.of(scaled(look.color, look.shade + look.sun));
        look.dark = tones_.of(scaled(look.color, look.shade));
        return look;
    }
    static Light faded(const Face& face, const Light& light) {
        return face.fade > 0.0F ? mixed(light, {kWashedOut, kWashedOut, kWashedOut}, face.fade) : light;
    }

    // Where shadows may fall on the ground.
    void find_shade() {
        shade_ = {0, 0, ground_.slope > 0.0 ? width_ : 0, height_};
        const Vec3 eye = camera_.eye();
        Box box;
        const auto [low, high] = sun_.shaded(ground_);
        for (const Vec3 corner : {low, Vec3{low.x, high.y, 0}, high, Vec3{high.x, low.y, 0}}) {
            const Vec3 p = sun_.meets(corner - ground_.shift, framing_.ground_mm * kUp, kUp);
            // Nothing is said of what lies behind the eye.
            if (dot(eye - p, camera_.back) < 0.01 * camera_.eye_mm) return;
            const Seen at = camera_.see(p);
            box.extend({at.x / kOver, at.y / kOver});
        }
        const auto within = [](double value, int most) {
            return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
        };
        shade_.low_x = within(box.min.x - 1.0, width_);
        shade_.low_y = within(box.min.y - 1.0, height_);
        shade_.high_x = within(box.max.x + 2.0, shade_.high_x);
        shade_.high_y = within(box.max.y + 2.0, height_);
    }

    [[nodiscard]] Light background(int y) const {
        return mixed(kSky, kTable,
                     framing_.plain ? 0.5F : static_cast<float>(y) / static_cast<float>(height_));
    }

    // What lies at a sample, as the sun sees it.
    [[nodiscard]] Vec3 place(double x, double y, double away_mm) const {
        return eye_ + away_mm * (corner_ + x * across_ + y * down_);
    }

    // How many of the sun's rays reach the ground that is seen at a pixel.
    [[nodiscard]] int ground_rays(int x, int y) const {
        if (x < shade_.low_x || x >= shade_.high_x || y < shade_.low_y || y >= shade_.high_y)
            return Sun::kRays;
        const double sx = (x + 0.5) * kOver;
        const double sy = (y + 0.5) * kOver;
        const double falls = falls_ + sx * falls_across_ + sy * falls_down_;
        if (falls >= -1e-6) return Sun::kRays;
        const double away = under_eye_mm_ / falls;
        return away <= 0.0 ? Sun::kRays : sun_.lit(ground_, place(sx, sy, away));
    }
    // How much of the background is left where the model's shadow falls on the ground.
    static double ground_light(int rays) { return 1.0 - kGroundShade * (1.0 - rays / double{Sun::kRays}); }

    // Of the ground in a row of pixels, from `from` up to `to`.
    void shade_ground(int y, int from, int to) {
        each_rays(
            from, to, ground_above_, [&](int x) { return ground_rays(x, y); },
            [&](int first, int end, int rays) {
                if (rays < Sun::kRays) put(first, end, y, tones_.of(scaled(row_light_, ground_light(rays))));
            });
    }
    void shade_table(int y, int from, int to) {
        if (y < shade_.low_y || y >= shade_.high_y) return;
        shade_ground(y, std::max(from, shade_.low_x), std::min(to, shade_.high_x));
    }

    // By `step` columns: whether the sun reached some of them in the row above, and others not or less.
    struct Above {
        int step;
        std::vector<char> uneven;
    };
    // Calls visit(first, end, rays) for the pixels of a row from `from` up to `to`, some at a time. Where all
    // or none of the sun reaches two pixels that are a step apart, it does between them: shadows have wider
    // edges. What is smaller is looked for in the same columns of all rows, wherever they begin, and followed
    // down from where it is seen.
    template <typename Rays, typename Visit>
    static void each_rays(int from, int to, Above& above, const Rays& rays, const Visit& visit) {
        if (from >= to) return;
        int known = rays(from);
        visit(from, from + 1, known);
        for (int x = from; x + 1 < to;) {
            char& uneven = above.uneven[index(x / above.step)];
            const int next = std::min(x - x % above.step + above.step, to - 1);
            const int there = rays(next);
            const bool is_even = there == known && (there == 0 || there == Sun::kRays);
            known = there;
            if (is_even && uneven == 0) {
                visit(x + 1, next + 1, there);
                x = next;
                continue;
            }
            bool is_same = is_even;
            for (++x; x < next; ++x) {
                const int here = rays(x);
                is_same = is_same && here == there;
                visit(x, x + 1, here);
            }
            uneven = is_same ? 0 : 1;
            visit(next, next + 1, there);
        }
    }

    // How much of the sun reaches a surface that is seen at a sample, or at the middle of a pixel.
    [[nodiscard]] int sun_at(const Look& look, double x, double y, float near) const {
        if (look.surface.slope <= 0.0) return 0;
        return sun_.lit(look.surface, place(x, y, 1.0 / static_cast<double>(near)));
    }
    // What a face shows there, seen by as much as so many samples a side.
    [[nodiscard]] Light color(const Face& face, const Look& look, double x, double y, float near,
                              double samples) const {
        if (face.texture == nullptr) return look.color;
        const double seen_mm = samples / (camera_.scale * camera_.eye_mm * static_cast<double>(near));
        const TextureSpot at = texture_spot(face, camera_.point(x, y, static_cast<double>(near)), seen_mm);
        return faded(face, texture_light(at, tones_.light));
    }

    void shade_model(int y) {
        const PixelBox& box = samples_.box();
        for (int x = box.low_x; x < box.high_x;) {
            const What* only = &samples_.only(x, y);
            if (*only < 0) {
                put(x, y, tones_.of(mean(x, y)));
                ++x;
                continue;
            }
            int to = x + 1;
            while (to < box.high_x && only[to - x] == *only) ++to;
            if (*only == 0) {
                shade_ground(y, x, to);
            } else {
                shade_face(y, x, to, index(*only - 1));
            }
            x = to;
        }
    }

    // Pixels of a row all of whose samples see one face.
    void shade_face(int y, int from, int to, std::size_t number) {
        const Look& look = looks_[number];
        const Face& face = model_.faces[number];
        const double sy = (y + 0.5) * kOver;
        each_rays(
            from, to, paper_above_,
            [&](int x) { return sun_at(look, (x + 0.5) * kOver, sy, samples_.middle(x, y)); },
            [&](int first, int end, int rays) {
                if (face.texture == nullptr && (rays == 0 || rays == Sun::kRays))
                    return put(first, end, y, rays == 0 ? look.dark : look.lit);
                for (int x = first; x < end; ++x) {
                    const Light own = color(face, look, (x + 0.5) * kOver, sy, samples_.middle(x, y), kOver);
                    put(x, y, tones_.of(scaled(own, light_of(look, rays))));
                }
            });
    }
    static double light_of(const Look& look, int lit) { return look.shade + look.sun * lit / Sun::kRays; }

    // Of a pixel that several are seen in: what each of them shows, times its samples.
    [[nodiscard]] Light mean(int x, int y) const {
        Light sum{};
        samples_.each_part(x, y, [&](const Part& part) {
            const auto samples = static_cast<float>(count_of(part.samples));
            if (part.what == 0) {
                add(sum, row_light_, samples * static_cast<float>(ground_light(ground_rays(x, y))));
            } else if (part.what < 0) {
                add(sum, model_.edges[index(-part.what - 1)].ink, samples);
            } else {
                add_face(sum, x, y, part);
            }
        });
        return scaled(sum, 1.0 / kSamples);
    }
    // What a face shows at its samples of a pixel.
    void add_face(Light& sum, int x, int y, const Part& part) const {
        const Look& look = looks_[index(part.what - 1)];
        const Face& face = model_.faces[index(part.what - 1)];
        const auto sx = [x](int sample) { return x * kOver + column_of(sample) + 0.5; };
        const auto sy = [y](int sample) { return y * kOver + row_of(sample) + 0.5; };
        const int first = std::countr_zero(part.samples);
        const int rays = sun_at(look, sx(first), sy(first), part.near.at(first));
        const auto light = static_cast<float>(light_of(look, rays));
        if (face.texture == nullptr)
            return add(sum, look.color, light * static_cast<float>(count_of(part.samples)));
        for (int i = first; i < kSamples; ++i) {
            if ((part.samples & (1U << i)) != 0)
                add(sum, color(face, look, sx(i), sy(i), part.near.at(i), 1.0), light);
        }
    }

    void fill_row(int y) {
        unsigned char* row = out_.rgb.data() + 3 * index(y) * index(width_);
        std::copy(row_bytes_.begin(), row_bytes_.end(), row);
        // What is filled so far, once more behind it.
        const std::size_t count = 3 * index(width_);
        for (std::size_t done = 3; done < count; done *= 2)
            std::copy_n(row, std::min(done, count - done), row + done);
    }
    void put(int x, int y, const Bytes& bytes) { put(x, x + 1, y, bytes); }
    void put(int first, int end, int y, const Bytes& bytes) {
        unsigned char* out = out_.rgb.data() + 3 * (index(y) * index(width_) + index(first));
        for (int x = first; x < end; ++x, out += 3) {
            for (std::size_t i = 0; i < 3; ++i) out[i] = bytes[i];
        }
    }

    static void add(Light& sum, const Light& more, float times) {
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += times * more[i];
    }

    const Model& model_;
    const Tones& tones_ = tones();
    int width_, height_;
    Framing framing_;
    Camera camera_;  // of samples
    Sun sun_;
    Samples samples_;
    Sun::Surface ground_;
    Above paper_above_{kPaperStep, std::vector<char>(index(width_ / kPaperStep + 1))};
    Above ground_above_{kGroundStep, std::vector<char>(index(width_ / kGroundStep + 1))};
    // As the sun sees them: the eye, and the ways from it to what is seen in the picture's corner, a sample
    // further across and a sample further down.
    Vec3 eye_, corner_, across_, down_;
    // By how much a way from the eye rises, a mm of it towards what is seen: in the picture's corner, a
    // sample further across and a sample further down; and how high the ground lies above the eye.
    double falls_ = 0.0, falls_across_ = 0.0, falls_down_ = 0.0, under_eye_mm_ = 0.0;
    std::vector<Look> looks_;  // of each face
    PixelBox shade_;           // where the model's shadow may fall on the ground
    int drawn_ = 0;            // rows of pixels
    Light row_light_{};        // the background of the row that is shaded
    Bytes row_bytes_{};
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
