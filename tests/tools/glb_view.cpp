// Looks at a model: renders it at an opening angle, or measures how well it closes. It reads the GLB file as
// any viewer does and knows nothing of the library that wrote it.
//
//   glb_view render MODEL.glb -o PICTURE.png [--angle 90] [--size 1200x900] [--from x,y,z] [--up x,y,z]
//   [--zoom 1] [--distance 1] glb_view measure MODEL.glb [--joints N]
//
// --from is the direction in which the eye lies, --up what is upwards. A card drawn to stand on its right
// half, with its left half for a back wall, is best seen with --from 0.3,-0.4,0.94 --up -1,0,1. --distance is
// how far the eye is, as a multiple of where it sees well: with 1000, rays are as good as parallel. `measure`
// prints the joints found and the largest opening in mm, at the keys and between them, and how far nodes are
// moved beside their places to be told from what they lie on. Its exit status is 1 when the openings by turns
// alone are more than 0.001 or 0.05 mm, when a node is more than 3 mm beside its place, or when fewer than N
// joints were found.
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/glb_scene.h"

namespace {

using popup::test::GlbPart;
using popup::test::GlbPose;
using popup::test::GlbScene;
using popup::test::Point3;

constexpr double kMostAtKeysMm = 0.001;
constexpr double kMostBetweenMm = 0.05;
constexpr double kMostBesideMm = 3.0;

Point3 operator+(const Point3& a, const Point3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point3 operator-(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point3 operator*(double s, const Point3& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point3 cross(const Point3& a, const Point3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point3 unit(const Point3& a) { return (1.0 / std::sqrt(dot(a, a))) * a; }

struct Options {
    std::string verb, model, output;
    double angle_deg = 90.0;
    int width = 1200, height = 900;
    Point3 from{0.35, 0.5, 1.2}, up{0, 1, 0};
    double zoom = 1.0, distance = 1.0;
    std::size_t joints = 0;
};

// What is drawn: triangles and outline edges in the world.
struct Face {
    std::array<Point3, 3> at;
    Point3 normal;
    Point3 color;
    bool double_sided;
    const popup::test::GlbTexture* texture = nullptr;
    std::array<std::array<double, 2>, 3> places{};  // of its corners in the texture
};
struct Edge {
    Point3 a, b;
    Point3 color;
};
struct Shapes {
    std::vector<Face> faces;
    std::vector<Edge> edges;
};

template <typename Visit>
void for_each_point(const Shapes& shapes, const Visit& visit) {
    for (const Face& face : shapes.faces) {
        for (const Point3& p : face.at) visit(p);
    }
    for (const Edge& edge : shapes.edges) {
        visit(edge.a);
        visit(edge.b);
    }
}

// Edges that bound only one triangle: the outline and its holes.
void add_outline(const GlbPart& part, const GlbPose& pose, Shapes& shapes) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& t : part.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(t.at(k), t.at((k + 1) % 3))];
    }
    for (const auto& [edge, count] : uses) {
        if (count != 1) continue;
        shapes.edges.push_back(
            {pose.point(part.points[edge.first]), pose.point(part.points[edge.second]), part.color});
    }
}

Shapes shapes_at(const GlbScene& scene, double angle_deg) {
    const auto poses = popup::test::pose_at_angle(scene, angle_deg);
    Shapes shapes;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        for (const GlbPart& part : scene.nodes[i].parts) {
            for (const auto& t : part.triangles) {
                Face face;
                for (std::size_t k = 0; k < 3; ++k) face.at.at(k) = poses[i].point(part.points[t.at(k)]);
                face.normal =
                    part.normals.empty() ? poses[i].axes[2] : poses[i].direction(part.normals[t[0]]);
                face.color = part.color;
                face.double_sided = part.double_sided;
                if (part.texture >= 0) {
                    face.texture = &scene.textures.at(static_cast<std::size_t>(part.texture));
                    for (std::size_t k = 0; k < 3; ++k) face.places.at(k) = part.places.at(t.at(k));
                }
                shapes.faces.push_back(face);
            }
            if (part.double_sided) add_outline(part, poses[i], shapes);
            for (const auto& line : part.lines) {
                shapes.edges.push_back(
                    {poses[i].point(part.points[line[0]]), poses[i].point(part.points[line[1]]), part.color});
            }
        }
    }
    return shapes;
}

// A view: where a point of the world falls on the picture, and how deep it lies (larger is further).
struct View {
    Point3 right, up, back;  // unit; back points from the target to the eye
    Point3 target;
    double eye = 0.0;    // distance of the eye from the target; 0: parallel rays
    double scale = 1.0;  // pixels a metre at the target
    double cx = 0.0, cy = 0.0;

    View(const Point3& from, const Point3& upwards) {
        back = unit(from);
        right = unit(cross(upwards, back));
        up = cross(back, right);
        target = {0, 0, 0};
    }
    [[nodiscard]] Point3 project(const Point3& p) const {
        const Point3 d = p - target;
        const double depth = -dot(d, back);
        const double s = eye > 0.0 ? scale * eye / (eye + depth) : scale;
        // In a perspective depth must run evenly over the picture: what does is depth over distance.
        return {cx + s * dot(d, right), cy - s * dot(d, up), eye > 0.0 ? depth * eye / (eye + depth) : depth};
    }
};

// Depth of the nearest face at each pixel.
struct DepthMap {
    int width, height;
    std::vector<float> depth;
    DepthMap(int w, int h)
        : width(w), height(h), depth(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), HUGE_VALF) {}
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

// Calls visit(x, y, depth, weights) for every pixel whose centre the projected triangle covers.
template <typename Visit>
void for_each_pixel(const std::array<Point3, 3>& t, int width, int height, const Visit& visit) {
    const double area = (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
    if (std::abs(area) < 1e-12) return;
    const auto [x0, x1] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const auto [y0, y1] = std::minmax({t[0][1], t[1][1], t[2][1]});
    const int bottom = std::max(0, static_cast<int>(std::floor(y0)));
    const int top = std::min(height - 1, static_cast<int>(std::ceil(y1)));
    const int left = std::max(0, static_cast<int>(std::floor(x0)));
    const int right = std::min(width - 1, static_cast<int>(std::ceil(x1)));
    for (int y = bottom; y <= top; ++y) {
        for (int x = left; x <= right; ++x) {
            const double px = x + 0.5;
            const double py = y + 0.5;
            std::array<double, 3> w{};
            bool inside = true;
            for (std::size_t k = 0; k < 3 && inside; ++k) {
                const Point3& a = t.at((k + 1) % 3);
                const Point3& b = t.at((k + 2) % 3);
                w.at(k) = ((b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])) / area;
                inside = w.at(k) >= 0.0;
            }
            if (inside) visit(x, y, w[0] * t[0][2] + w[1] * t[1][2] + w[2] * t[2][2], w);
        }
    }
}

// Light from one direction, with soft shadows from a depth map of its own.
class Light {
 public:
    Light(const Point3& from, const Shapes& shapes, const Point3& centre, double radius)
        : view_(from, {0.1, 1, 0.05}), map_(kSize, kSize) {
        view_.target = centre;
        view_.scale = 0.49 * kSize / radius;
        view_.cx = view_.cy = 0.5 * kSize;
        bias_ = 3.0 * radius / kSize;
        for (const Face& face : shapes.faces) {
            if (!face.double_sided) continue;
            for_each_pixel({view_.project(face.at[0]), view_.project(face.at[1]), view_.project(face.at[2])},
                           kSize, kSize, [this](int x, int y, double depth, const std::array<double, 3>&) {
                               float& nearest = map_.depth[map_.index(x, y)];
                               nearest = std::min(nearest, static_cast<float>(depth));
                           });
        }
    }

    // How much of it falls on a surface: 0 to 1.
    [[nodiscard]] double on(const Point3& p, const Point3& normal) const {
        const double slope = dot(normal, view_.back);
        if (slope <= 0.0) return 0.0;
        const Point3 at = view_.project(p + bias_ * normal);
        // The surface itself lies deeper on one side of the place that is looked at.
        const double per_x = dot(normal, view_.right) / (slope * view_.scale);
        const double per_y = -dot(normal, view_.up) / (slope * view_.scale);
        int lit = 0;
        int all = 0;
        for (int dy = -kSoft; dy <= kSoft; dy += 2) {
            for (int dx = -kSoft; dx <= kSoft; dx += 2) {
                const int x = static_cast<int>(at[0]) + dx;
                const int y = static_cast<int>(at[1]) + dy;
                const double depth = at[2] + per_x * dx + per_y * dy - bias_;
                ++all;
                if (x < 0 || y < 0 || x >= kSize || y >= kSize || depth < map_.depth[map_.index(x, y)]) ++lit;
            }
        }
        return slope * lit / all;
    }

 private:
    static constexpr int kSize = 2048;
    static constexpr int kSoft = 8;
    View view_;
    DepthMap map_;
    double bias_;
};

double to_srgb(double light) {
    const double c = std::clamp(light, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

double to_light(unsigned char channel) {
    const double c = channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// The pixel at a place of a texture, in linear light, and how opaque it is.
std::pair<Point3, double> texture_at(const popup::test::GlbTexture& texture, double u, double v) {
    const auto pixel = [](double place, int size) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(std::floor(place * size)), 0, size - 1));
    };
    const unsigned char* at =
        texture.rgba.data() +
        4 * (pixel(v, texture.height) * static_cast<std::size_t>(texture.width) + pixel(u, texture.width));
    return {{to_light(at[0]), to_light(at[1]), to_light(at[2])}, at[3] / 255.0};
}

// The picture at kOver times its size, in linear light.
constexpr int kOver = 3;

class Picture {
 public:
    Picture(const Options& options, const Shapes& shapes)
        : width_(options.width * kOver),
          height_(options.height * kOver),
          depth_(width_, height_),
          view_(options.from, options.up) {
        Point3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        Point3 high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for_each_point(shapes, [&](const Point3& p) {
            for (std::size_t k = 0; k < 3; ++k) {
                low.at(k) = std::min(low.at(k), p.at(k));
                high.at(k) = std::max(high.at(k), p.at(k));
            }
        });
        centre_ = 0.5 * (low + high);
        radius_ = 0.5 * std::sqrt(dot(high - low, high - low));
        aim(shapes, options);
        colors_.resize(depth_.depth.size());
        for (int y = 0; y < height_; ++y) {
            const double t = static_cast<double>(y) / height_;
            for (int x = 0; x < width_; ++x) {
                colors_[depth_.index(x, y)] = {0.80 - 0.12 * t, 0.84 - 0.12 * t, 0.88 - 0.11 * t};
            }
        }
        draw(shapes);
    }

    [[nodiscard]] bool save(const std::string& path) const {
        const int w = width_ / kOver;
        const int h = height_ / kOver;
        cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, w, h);
        unsigned char* data = cairo_image_surface_get_data(surface);
        const int stride = cairo_image_surface_get_stride(surface);
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                Point3 sum{};
                for (int i = 0; i < kOver * kOver; ++i) {
                    sum = sum + colors_[depth_.index(x * kOver + i % kOver, y * kOver + i / kOver)];
                }
                std::uint32_t pixel = 0;
                for (const double light : sum) {
                    pixel = pixel << 8U |
                            static_cast<std::uint32_t>(std::lround(255.0 * to_srgb(light / (kOver * kOver))));
                }
                std::copy_n(reinterpret_cast<const unsigned char*>(&pixel), 4, data + y * stride + 4 * x);
            }
        }
        cairo_surface_mark_dirty(surface);
        const bool done = cairo_surface_write_to_png(surface, path.c_str()) == CAIRO_STATUS_SUCCESS;
        cairo_surface_destroy(surface);
        return done;
    }

 private:
    // So that everything is in the picture, with a margin.
    void aim(const Shapes& shapes, const Options& options) {
        view_.target = centre_;
        view_.eye = 5.0 * options.distance * radius_;
        Point3 low{HUGE_VAL, HUGE_VAL, 0};
        Point3 high{-HUGE_VAL, -HUGE_VAL, 0};
        for_each_point(shapes, [&](const Point3& p) {
            const Point3 at = view_.project(p);
            for (std::size_t k = 0; k < 2; ++k) {
                low.at(k) = std::min(low.at(k), at.at(k));
                high.at(k) = std::max(high.at(k), at.at(k));
            }
        });
        view_.scale =
            options.zoom * 0.88 * std::min(width_ / (high[0] - low[0]), height_ / (high[1] - low[1]));
        view_.cx = 0.5 * width_ - view_.scale * 0.5 * (low[0] + high[0]);
        view_.cy = 0.5 * height_ - view_.scale * 0.5 * (low[1] + high[1]);
    }

    void draw(const Shapes& shapes) {
        // The sun from over the viewer's left shoulder.
        const Light sun(view_.back + 0.65 * view_.up - 0.1 * view_.right, shapes, centre_, radius_);
        const Point3 sky = unit(view_.up + 0.3 * view_.back);
        const double bias = 1.2 / view_.scale;
        for (const Face& face : shapes.faces) {
            const Point3 eye = view_.target + view_.eye * view_.back;
            const bool front = dot(face.normal, eye - face.at[0]) > 0.0;
            if (!front && !face.double_sided) continue;
            const Point3 normal = front ? face.normal : -1.0 * face.normal;
            const double soft = 0.46 + 0.13 * dot(normal, sky);
            const std::array<Point3, 3> projected{view_.project(face.at[0]), view_.project(face.at[1]),
                                                  view_.project(face.at[2])};
            // Drawn lines lie so close to their paper that depths are no longer told apart.
            const double lift = face.double_sided ? 0.0 : bias;
            for_each_pixel(
                projected, width_, height_, [&](int x, int y, double depth, const std::array<double, 3>& w) {
                    const std::size_t i = depth_.index(x, y);
                    const auto nearer = static_cast<float>(depth - lift);
                    if (nearer > depth_.depth[i]) return;
                    depth_.depth[i] = nearer;
                    // Weights on the picture are not those in space.
                    std::array<double, 3> v{};
                    double sum = 0.0;
                    for (std::size_t k = 0; k < 3; ++k) {
                        const double away = view_.eye - dot(face.at.at(k) - view_.target, view_.back);
                        v.at(k) = w.at(k) / away;
                        sum += v.at(k);
                    }
                    const Point3 p =
                        (1.0 / sum) * (v[0] * face.at[0] + v[1] * face.at[1] + v[2] * face.at[2]);
                    const double light = soft + 0.53 * sun.on(p, normal);
                    if (face.texture != nullptr) {
                        std::array<double, 2> place{};
                        for (std::size_t k = 0; k < 3; ++k) {
                            for (std::size_t c = 0; c < 2; ++c)
                                place.at(c) += v.at(k) / sum * face.places.at(k).at(c);
                        }
                        const auto [pixel, opaque] = texture_at(*face.texture, place[0], place[1]);
                        colors_[i] = (1.0 - opaque) * colors_[i] + (opaque * light) * pixel;
                        return;
                    }
                    colors_[i] = light * face.color;
                });
        }
        for (const Edge& edge : shapes.edges) draw_edge(edge, bias);
    }

    void draw_edge(const Edge& edge, double bias) {
        const Point3 a = view_.project(edge.a);
        const Point3 b = view_.project(edge.b);
        const double run = std::max(std::abs(b[0] - a[0]), std::abs(b[1] - a[1]));
        const int steps = std::max(1, static_cast<int>(std::ceil(run)));
        const bool level = std::abs(b[0] - a[0]) >= std::abs(b[1] - a[1]);
        const Point3 ink = 0.22 * edge.color + Point3{0.02, 0.02, 0.025};
        for (int i = 0; i <= steps; ++i) {
            const Point3 p = a + (static_cast<double>(i) / steps) * (b - a);
            for (int off = -1; off <= 1; ++off) {
                const int x = static_cast<int>(std::floor(p[0])) + (level ? 0 : off);
                const int y = static_cast<int>(std::floor(p[1])) + (level ? off : 0);
                if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
                const std::size_t at = depth_.index(x, y);
                if (p[2] - 3.0 * bias > depth_.depth[at]) continue;
                colors_[at] = ink;
            }
        }
    }

    int width_, height_;
    DepthMap depth_;
    View view_;
    Point3 centre_{};
    double radius_ = 1.0;
    std::vector<Point3> colors_;
};

// How far any node is beside its place, mm, to be told from what it lies on; its places are taken out, so
// that the turns alone are left.
double take_out_places(GlbScene& scene) {
    double most = 0.0;
    for (auto& node : scene.nodes) {
        for (const auto& [seconds, place] : node.places) {
            const Point3 off = place - node.translation;
            most = std::max(most, 1000.0 * std::hypot(off[0], off[1], off[2]));
        }
        node.places.clear();
    }
    return most;
}

int measure(GlbScene scene, std::size_t least_joints) {
    const double beside = take_out_places(scene);
    const auto joints = popup::test::find_joints(scene);
    const auto open = popup::test::measure_openings(scene, joints);
    fmt::print("nodes {}, moving {}, keys {}, joints {}\n", scene.nodes.size(), scene.channels,
               scene.times.size(), joints.size());
    fmt::print("largest opening at keys {:.6f} mm, between keys {:.6f} mm", open.at_keys_mm,
               open.between_keys_mm);
    if (open.joint >= 0) {
        const auto& joint = joints[static_cast<std::size_t>(open.joint)];
        fmt::print(" at {:.3f}° ({} and {})", open.at_deg,
                   scene.nodes[static_cast<std::size_t>(joint.a)].name,
                   scene.nodes[static_cast<std::size_t>(joint.b)].name);
    }
    fmt::print(", at most {:.3f} mm beside their places\n", beside);
    const bool good = open.at_keys_mm <= kMostAtKeysMm && open.between_keys_mm <= kMostBetweenMm &&
                      beside <= kMostBesideMm && joints.size() >= least_joints;
    return good ? 0 : 1;
}

bool read_numbers(const std::string& text, char between, Point3& result) {
    std::vector<double> numbers;
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    double value = 0.0;
    char mark = between;
    while (mark == between && in >> value) {
        numbers.push_back(value);
        mark = 0;
        in >> mark;
    }
    for (std::size_t i = 0; i < numbers.size() && i < 3; ++i) result.at(i) = numbers[i];
    return numbers.size() >= 2 && numbers.size() <= 3;
}

bool read_options(const std::vector<std::string>& words, Options& options) {
    if (words.size() < 2) return false;
    options.verb = words[0];
    options.model = words[1];
    for (std::size_t i = 2; i + 1 < words.size(); i += 2) {
        const std::string& name = words[i];
        const std::string& value = words[i + 1];
        Point3 size{};
        if (name == "-o")
            options.output = value;
        else if (name == "--angle")
            options.angle_deg = std::stod(value);
        else if (name == "--zoom")
            options.zoom = std::stod(value);
        else if (name == "--distance")
            options.distance = std::stod(value);
        else if (name == "--joints")
            options.joints = std::stoul(value);
        else if (name == "--from" || name == "--up") {
            if (!read_numbers(value, ',', name == "--up" ? options.up : options.from)) return false;
        } else if (name == "--size" && read_numbers(value, 'x', size)) {
            options.width = static_cast<int>(size[0]);
            options.height = static_cast<int>(size[1]);
        } else
            return false;
    }
    return words.size() % 2 == 0 &&
           (options.verb == "measure" || (options.verb == "render" && !options.output.empty()));
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!read_options({argv + 1, argv + argc}, options)) {
        fmt::print(
            stderr,
            "usage: glb_view render MODEL.glb -o PICTURE.png [--angle DEG] [--size WxH] [--from X,Y,Z] "
            "[--up X,Y,Z] [--zoom N] [--distance N]\n       glb_view measure MODEL.glb [--joints N]\n");
        return 2;
    }
    std::ifstream file(options.model, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::string error;
    const auto scene = popup::test::read_glb(bytes, &error);
    if (!scene) {
        fmt::print(stderr, "glb_view: {}: {}\n", options.model, error);
        return 2;
    }
    if (options.verb == "measure") return measure(*scene, options.joints);
    const Picture picture(options, shapes_at(*scene, options.angle_deg));
    if (picture.save(options.output)) return 0;
    fmt::print(stderr, "glb_view: {}: cannot be written\n", options.output);
    return 2;
}
