#include "output/still/samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "output/still/texture.h"
#include "output/still/triangle_rows.h"

namespace popup::still {
namespace {

constexpr double kHalfLine = 1.95;  // samples: edges are 1.3 pixels wide
// What lies this near behind a line hides it, so that seams do not show through what they are glued to.
constexpr double kHidesMm = 0.02;

// A row of samples of one face. Without a branch, so that compilers do several at once.
void keep_nearest(float* near, What* what, int count, float from, float by, What number) {
    for (int i = 0; i < count; ++i) {
        const float depth = from + static_cast<float>(i) * by;
        const bool is_nearer = depth > near[i];
        near[i] = is_nearer ? depth : near[i];
        what[i] = is_nearer ? number : what[i];
    }
}

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

void Samples::draw(int top, int bottom) {
    top_ = kOver * top;
    bottom_ = kOver * bottom;
    const auto count = static_cast<std::size_t>((bottom_ - top_) * stride());
    near_.assign(count, 0.0F);
    what_.assign(count, 0);
    const auto meets = [&](const auto& one) { return one.low_y < bottom_ && one.high_y >= top_; };
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        if (meets(faces_[i])) draw_face(i);
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        if (meets(edges_[i])) draw_edge(i);
    }
}

void Samples::draw_face(std::size_t number) {
    const Face& face = model_.faces[number];
    const Seen* seen = points_.data() + faces_[number].first;
    const What what = static_cast<What>(number) + 1;
    const bool is_cut_out = face.texture != nullptr && !face.texture->opaque;
    const auto fill = [&](int y, int first, int last, double near, double step) {
        float* nearest = near_.data() + index(first, y);
        What* known = what_.data() + index(first, y);
        if (!is_cut_out) {
            keep_nearest(nearest, known, last - first + 1, static_cast<float>(near), static_cast<float>(step),
                         what);
            return;
        }
        for (int x = first; x <= last; ++x, ++nearest, ++known) {
            const double here = near + (x - first) * step;
            const auto depth = static_cast<float>(here);
            if (depth <= *nearest) continue;
            const TextureSpot at = texture_spot(face, camera_.point(x + 0.5, y + 0.5, here),
                                                1.0 / (camera_.scale * camera_.eye_mm * here));
            if (texture_pixel(*at.level, at.u, at.v)[3] < 128) continue;
            *nearest = depth;
            *known = what;
        }
    };
    for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
        each_row({seen[face.indices[i]], seen[face.indices[i + 1]], seen[face.indices[i + 2]]}, columns_,
                 top_, bottom_, fill);
    }
}

void Samples::draw_edge(std::size_t number) {
    const Edge& edge = model_.edges[number];
    const Seen& a = edges_[number].a;
    const Seen& b = edges_[number].b;
    const Vec2 along{b.x - a.x, b.y - a.y};
    const double square = dot(along, along);
    if (square < 1e-18) return;
    const Vec2 out = kHalfLine / std::sqrt(square) * Vec2{-along.y, along.x};
    const What ink = -static_cast<What>(number) - 1;
    const auto fill = [&](int y, int first, int last, double, double) {
        What* known = what_.data() + index(first, y);
        for (int x = first; x <= last; ++x) {
            What& what = *known++;
            if (what < 0) continue;
            if (what == 0 || model_.faces[static_cast<std::size_t>(what) - 1].plate == edge.plate) {
                what = ink;
                continue;
            }
            // The face may hide the line and yet lie behind it at this sample, so its plane is compared with
            // the line on the line itself.
            const Seeing& face = faces_[static_cast<std::size_t>(what) - 1];
            const double t = std::clamp(dot({x + 0.5 - a.x, y + 0.5 - a.y}, along) / square, 0.0, 1.0);
            const double near = a.near + t * (b.near - a.near);
            const double plane =
                face.near_0 + face.near_x * (a.x + t * along.x) + face.near_y * (a.y + t * along.y);
            // As distances: 1 / near + kHidesMm < 1 / plane.
            if (plane <= 0.0 || (1.0 + kHidesMm * near) * plane < near) what = ink;
        }
    };
    const Seen a1{a.x + out.x, a.y + out.y, a.near};
    const Seen a2{a.x - out.x, a.y - out.y, a.near};
    const Seen b1{b.x + out.x, b.y + out.y, b.near};
    const Seen b2{b.x - out.x, b.y - out.y, b.near};
    each_row({a1, a2, b1}, columns_, top_, bottom_, fill);
    each_row({a2, b2, b1}, columns_, top_, bottom_, fill);
}

}  // namespace popup::still
