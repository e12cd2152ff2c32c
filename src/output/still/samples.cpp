#include "output/still/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "output/still/texture.h"
#include "output/still/triangle_rows.h"

namespace popup::still {
namespace {

constexpr double kHalfLine = 1.95;  // samples: edges are 1.3 pixels wide
// What lies this near behind a line hides it, so that seams do not show through what they are glued to.
constexpr double kHidesMm = 0.02;
// Faces whose distances differ by less than this share lie in one plane, but for rounding: the first stays.
constexpr float kSame = 5e-7F;
constexpr double kEdgeOnMm = 1e-6;  // from the eye to the plane of a face of which nothing is seen

// Pixels of one face, `number`, which is `by` nearer in the middle of each next one. Each pixel sees the
// face, or what it saw before, where one is nearer at all samples. Tells whether that cannot be said of some.
// Without a branch, so that compilers do several at once.
bool keep_nearest(float* middle, float* across_of, float* down_of, What* only, int count,
                  const Nearness& first, float by, What number) {
    const auto [from, across, down] = first;
    int unsaid = 0;
    for (int i = 0; i < count; ++i) {
        const float here = from + static_cast<float>(i) * by;
        const float nearer = here - middle[i] - kSame * here;
        const float most = std::abs(across - across_of[i]) + std::abs(down - down_of[i]);
        const bool is_nearer = nearer > most;
        const bool is_hidden = nearer <= -most;
        unsaid |= is_nearer || is_hidden ? 0 : 1;
        middle[i] = is_nearer ? here : middle[i];
        across_of[i] = is_nearer ? across : across_of[i];
        down_of[i] = is_nearer ? down : down_of[i];
        only[i] = is_nearer ? number : only[i];
    }
    return unsaid != 0;
}

// The samples of a row of pixels that lie in a convex polygon: of each row of samples the first and the last.
struct Strip {
    int y = 0;                                         // of pixels
    std::array<int, kOver> first{}, last{-1, -1, -1};  // columns of samples

    // Those of one pixel.
    [[nodiscard]] SampleSet of(int x) const {
        SampleSet set = 0;
        for (int row = 0; row < kOver; ++row) {
            const int from = std::max(first[static_cast<std::size_t>(row)] - kOver * x, 0);
            const int to = std::min(last[static_cast<std::size_t>(row)] - kOver * x + 1, kOver);
            if (from < to) set |= ((1U << (to - from)) - 1U) << (from + kOver * row);
        }
        return set;
    }
    // Columns of pixels, from `from` up to `to`.
    struct Range {
        int from = 0, to = 0;
    };
    [[nodiscard]] Range touched() const {
        Range range{std::numeric_limits<int>::max(), 0};
        for (std::size_t row = 0; row < kOver; ++row) {
            if (first[row] > last[row]) continue;
            range.from = std::min(range.from, first[row] / kOver);
            range.to = std::max(range.to, last[row] / kOver + 1);
        }
        return range;
    }
    [[nodiscard]] Range covered() const {
        Range range{0, std::numeric_limits<int>::max()};
        for (std::size_t row = 0; row < kOver; ++row) {
            range.from = std::max(range.from, (first[row] + kOver - 1) / kOver);
            range.to = std::min(range.to, (last[row] + 1) / kOver);
        }
        return range;
    }
};

// Calls visit(strip) for each row of pixels from `top` up to `bottom` in which samples lie in the polygon.
template <typename Visit>
void each_strip(std::span<const Seen> corners, int columns, int top, int bottom, const Visit& visit) {
    Strip strip;
    bool any = false;
    each_row(corners, columns, kOver * top, kOver * bottom, [&](int y, int first, int last) {
        if (any && y / kOver != strip.y) {
            visit(strip);
            any = false;
        }
        if (!any) strip = Strip{y / kOver};
        any = true;
        const auto row = static_cast<std::size_t>(y % kOver);
        strip.first[row] = first;
        strip.last[row] = last;
    });
    if (any) visit(strip);
}

// How one plane lies before another at a pixel: by `nearer` in its middle, by up to `most` more or less at
// its samples.
struct Before {
    Before(const Nearness& one, const Nearness& other)
        : nearer(one.middle - other.middle - kSame * one.middle),
          most(std::abs(one.across - other.across) + std::abs(one.down - other.down)) {}
    [[nodiscard]] bool always() const { return nearer > most; }
    [[nodiscard]] bool never() const { return nearer <= -most; }
    float nearer, most;
};

// Those of `samples` at which `one` is nearer than `other`.
SampleSet nearer(const Nearness& one, const Nearness& other, SampleSet samples) {
    const Before before(one, other);
    if (before.always()) return samples;
    if (before.never()) return 0;
    SampleSet result = 0;
    for (int i = 0; i < kSamples; ++i) {
        const SampleSet bit = 1U << i;
        if ((samples & bit) != 0 && one.at(i) * (1.0F - kSame) > other.at(i)) result |= bit;
    }
    return result;
}

constexpr Nearness kNothing{-HUGE_VALF, 0.0F, 0.0F};

}  // namespace

Samples::Samples(const Model& model, const Camera& camera, int width, int height)
    : model_(model),
      camera_(camera),
      columns_(width * kOver),
      rows_(height * kOver),
      box_{width, height, 0, 0} {
    faces_.reserve(model.faces.size());
    for (const Face& face : model.faces) see(face);
    edges_.reserve(model.edges.size());
    for (const Edge& edge : model.edges) see(edge);
    box_.high_x = std::max(box_.low_x, box_.high_x);
    box_.high_y = std::max(box_.low_y, box_.high_y);
}

void Samples::extend(double low_x, double low_y, double high_x, double high_y) {
    // A sample more on each side, whatever rounding makes of the last one.
    const auto pixel = [](double samples, int most) {
        return static_cast<int>(std::clamp(samples / kOver, 0.0, static_cast<double>(most)));
    };
    box_.low_x = std::min(box_.low_x, pixel(low_x - 1.0, columns_ / kOver));
    box_.low_y = std::min(box_.low_y, pixel(low_y - 1.0, rows_ / kOver));
    box_.high_x = std::max(box_.high_x, pixel(high_x + 1.0 + kOver, columns_ / kOver));
    box_.high_y = std::max(box_.high_y, pixel(high_y + 1.0 + kOver, rows_ / kOver));
}

void Samples::see(const Face& face) {
    Seeing& seeing = faces_.emplace_back();
    seeing.first = points_.size();
    const Vec3 normal = face.frame.normal();
    // What is only there from the front is not seen from behind.
    if (face.points.empty() || (!face.paper && dot(normal, camera_.eye() - face.points.front()) <= 0.0))
        return;
    Box seen;
    for (const Vec3 p : face.points) {
        const Seen& at = points_.emplace_back(camera_.see(p));
        seen.extend({at.x, at.y});
    }
    extend(seen.min.x, seen.min.y, seen.max.x, seen.max.y);
    seeing.low_y = static_cast<int>(std::clamp(std::floor(seen.min.y), 0.0, static_cast<double>(rows_)));
    seeing.high_y = static_cast<int>(std::clamp(std::ceil(seen.max.y), -1.0, static_cast<double>(rows_)));
    const double away = dot(normal, face.frame.origin - camera_.eye());
    if (std::abs(away) < kEdgeOnMm) {
        seeing.high_y = -1;
        return;
    }
    const double by = 1.0 / (camera_.scale * camera_.eye_mm);
    seeing.near_x = by * dot(normal, camera_.right) / away;
    seeing.near_y = -by * dot(normal, camera_.up) / away;
    seeing.near_0 =
        -dot(normal, camera_.back) / away - seeing.near_x * camera_.cx - seeing.near_y * camera_.cy;
}

void Samples::see(const Edge& edge) {
    Line& line = edges_.emplace_back(Line{camera_.see(edge.a), camera_.see(edge.b)});
    const auto [low_x, high_x] = std::minmax(line.a.x, line.b.x);
    const auto [low_y, high_y] = std::minmax(line.a.y, line.b.y);
    extend(low_x - kHalfLine, low_y - kHalfLine, high_x + kHalfLine, high_y + kHalfLine);
    const auto row = [this](double y) {
        return static_cast<int>(std::clamp(y, -1.0, static_cast<double>(rows_)));
    };
    line.low_y = row(std::floor(low_y - kHalfLine));
    line.high_y = row(std::ceil(high_y + kHalfLine));
}

void Samples::draw_face(std::size_t number) {
    const Face& face = model_.faces[number];
    const Seen* seen = points_.data() + faces_[number].first;
    const bool is_cut_out = face.texture != nullptr && !face.texture->opaque;
    const auto draw = [&](const Strip& strip) {
        const Strip::Range touched = strip.touched();
        Strip::Range covered = strip.covered();
        if (is_cut_out || covered.from >= covered.to) covered = {touched.to, touched.to};
        for (int x = touched.from; x < covered.from; ++x) draw_samples(number, x, strip.y, strip.of(x));
        if (covered.from < covered.to) draw_whole(number, strip.y, covered.from, covered.to);
        for (int x = covered.to; x < touched.to; ++x) draw_samples(number, x, strip.y, strip.of(x));
    };
    each_convex(face.indices, {seen, face.points.size()},
                [&](std::span<const Seen> polygon) { each_strip(polygon, columns_, top_, bottom_, draw); });
}

void Samples::draw_whole(std::size_t number, int y, int from, int to) {
    const Seeing& plane = faces_[number];
    const std::size_t at = pixel(from, y);
    const Nearness first = plane.at_pixel(from, y);
    const auto by = static_cast<float>(kOver * plane.near_x);
    if (!keep_nearest(&middle_[at], &across_[at], &down_[at], &only_[at], to - from, first, by,
                      static_cast<What>(number) + 1))
        return;
    for (int x = from; x < to; ++x) draw_samples(number, x, y, kAllSamples);
}

void Samples::draw_samples(std::size_t number, int x, int y, SampleSet samples) {
    const std::size_t at = pixel(x, y);
    const What what = static_cast<What>(number) + 1;
    if (samples == 0 || only_[at] == what) return;
    const Nearness near = faces_[number].at_pixel(x, y);
    if (only_[at] >= 0) {
        samples = nearer(near, {middle_[at], across_[at], down_[at]}, samples);
    } else {
        for (std::int32_t i = parts_of(only_[at]); i >= 0 && samples != 0;) {
            const Part& part = parts_[static_cast<std::size_t>(i)];
            const SampleSet both = samples & part.samples;
            if (both != 0 && part.what != what) samples ^= both ^ nearer(near, part.near, both);
            i = part.next;
        }
    }
    const Face& face = model_.faces[number];
    if (face.texture != nullptr && !face.texture->opaque) samples = not_cut_out(number, x, y, samples);
    if (samples != 0) give(at, what, samples, near);
}

SampleSet Samples::not_cut_out(std::size_t number, int x, int y, SampleSet samples) const {
    for (int i = 0; i < kSamples; ++i) {
        if ((samples & (1U << i)) == 0) continue;
        const double sx = kOver * x + column_of(i) + 0.5;
        const double sy = kOver * y + row_of(i) + 0.5;
        const double near = faces_[number].near(sx, sy);
        const TextureSpot at = texture_spot(model_.faces[number], camera_.point(sx, sy, near),
                                            1.0 / (camera_.scale * camera_.eye_mm * near));
        if (texture_pixel(*at.level, at.u, at.v)[3] < 128) samples &= ~(1U << i);
    }
    return samples;
}

void Samples::give(std::size_t pixel, What what, SampleSet samples, const Nearness& near) {
    What& only = only_[pixel];
    if (samples == kAllSamples && what > 0) {
        middle_[pixel] = near.middle;
        across_[pixel] = near.across;
        down_[pixel] = near.down;
        only = what;
        return;
    }
    if (only >= 0) {
        const auto first = static_cast<std::int32_t>(parts_.size());
        parts_.push_back({only, kAllSamples, {middle_[pixel], across_[pixel], down_[pixel]}, -1});
        middle_[pixel] = std::numeric_limits<float>::quiet_NaN();
        only = parts_of(first);
    }
    Part* own = nullptr;
    for (std::int32_t i = parts_of(only); i >= 0;) {
        Part& part = parts_[static_cast<std::size_t>(i)];
        part.samples &= ~samples;
        // One part of each face, and no more of them than of samples.
        if (part.what == what || (part.samples == 0 && own == nullptr)) own = &part;
        i = part.next;
    }
    if (own != nullptr) {
        own->samples = (own->what == what ? own->samples : 0U) | samples;
        own->what = what;
        own->near = near;
        return;
    }
    const std::int32_t head = parts_of(only);
    only = parts_of(static_cast<std::int32_t>(parts_.size()));
    parts_.push_back({what, samples, near, head});
}

// One line, over what was drawn before it.
class Samples::LineDrawer {
 public:
    LineDrawer(Samples& samples, std::size_t number)
        : s_(samples),
          edge_(samples.model_.edges[number]),
          a_(samples.edges_[number].a),
          b_(samples.edges_[number].b),
          along_{b_.x - a_.x, b_.y - a_.y},
          ink_(-static_cast<What>(number) - 1) {}

    void draw() {
        const double square = dot(along_, along_);
        if (square < 1e-18) return;
        share_ = (1.0 / square) * along_;
        const Vec2 out = kHalfLine / std::sqrt(square) * Vec2{-along_.y, along_.x};
        const std::array<Seen, 4> corners{
            Seen{a_.x + out.x, a_.y + out.y, a_.near}, Seen{a_.x - out.x, a_.y - out.y, a_.near},
            Seen{b_.x - out.x, b_.y - out.y, b_.near}, Seen{b_.x + out.x, b_.y + out.y, b_.near}};
        each_strip(corners, s_.columns_, s_.top_, s_.bottom_, [this](const Strip& strip) {
            const Strip::Range touched = strip.touched();
            for (int x = touched.from; x < touched.to; ++x) draw_pixel(x, strip.y, strip.of(x));
        });
    }

 private:
    void draw_pixel(int x, int y, SampleSet samples) {
        const std::size_t pixel = s_.pixel(x, y);
        SampleSet inked = 0;
        if (s_.only_[pixel] >= 0) {
            inked = over(s_.only_[pixel], x, y, samples);
        } else {
            for (std::int32_t i = parts_of(s_.only_[pixel]); i >= 0;) {
                const Part& part = s_.parts_[static_cast<std::size_t>(i)];
                const SampleSet both = samples & part.samples;
                if (both != 0) inked |= over(part.what, x, y, both);
                i = part.next;
            }
        }
        if (inked != 0) s_.give(pixel, ink_, inked, kNothing);
    }

    // Those of `samples` of a pixel at which the line lies over what they see.
    [[nodiscard]] SampleSet over(What what, int x, int y, SampleSet samples) {
        if (what <= 0) return what == 0 ? samples : 0;
        if (what != known_) {
            known_ = what;
            const auto number = static_cast<std::size_t>(what) - 1;
            is_own_ = s_.model_.faces[number].plate == edge_.plate;
            plane_a_ = s_.faces_[number].near(a_.x, a_.y);
            plane_b_ = s_.faces_[number].near(b_.x, b_.y);
        }
        if (is_own_) return samples;
        const double middle = along(kOver * (x + 0.5), kOver * (y + 0.5));
        const double most = std::abs(share_.x) + std::abs(share_.y);
        const bool is_over = hides_not(middle - most);
        if (is_over == hides_not(middle + most)) return is_over ? samples : 0;
        SampleSet result = 0;
        for (int i = 0; i < kSamples; ++i) {
            if (hides_not(along(kOver * x + column_of(i) + 0.5, kOver * y + row_of(i) + 0.5)))
                result |= 1U << i;
        }
        return result & samples;
    }
    [[nodiscard]] double along(double x, double y) const { return dot({x - a_.x, y - a_.y}, share_); }
    // Whether the line is seen at a share of its way. The face may hide the line and yet lie behind it at a
    // sample beside it, so its plane is compared with the line on the line itself.
    [[nodiscard]] bool hides_not(double share) const {
        const double t = std::clamp(share, 0.0, 1.0);
        const double near = a_.near + t * (b_.near - a_.near);
        const double plane = plane_a_ + t * (plane_b_ - plane_a_);
        // As distances: 1 / near + kHidesMm < 1 / plane.
        return plane <= 0.0 || (1.0 + kHidesMm * near) * plane < near;
    }

    Samples& s_;
    const Edge& edge_;
    Seen a_, b_;
    Vec2 along_, share_;
    What ink_;
    // Of the face that was asked for last: whether the line is its own, and how near its plane is at either
    // end.
    What known_ = 0;
    bool is_own_ = false;
    double plane_a_ = 0.0, plane_b_ = 0.0;
};

void Samples::draw(int top, int bottom) {
    top_ = top;
    bottom_ = bottom;
    const auto pixels =
        static_cast<std::size_t>(bottom - top) * static_cast<std::size_t>(box_.high_x - box_.low_x);
    middle_.assign(pixels, kNothing.middle);
    across_.assign(pixels, kNothing.across);
    down_.assign(pixels, kNothing.down);
    only_.assign(pixels, 0);
    parts_.clear();
    const auto meets = [&](const auto& one) {
        return one.low_y < kOver * bottom_ && one.high_y >= kOver * top_;
    };
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        if (meets(faces_[i])) draw_face(i);
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        if (meets(edges_[i])) LineDrawer(*this, i).draw();
    }
}

}  // namespace popup::still
