#include "support/glb_scene.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <stdexcept>

namespace popup::test {
namespace {

constexpr double kJoinedMetres = 0.02e-3;

Point3 operator+(const Point3& a, const Point3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point3 operator-(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point3 operator*(double s, const Point3& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double distance(const Point3& a, const Point3& b) { return std::sqrt(dot(a - b, a - b)); }

void expect(bool condition, const char* what) {
    if (!condition) throw std::runtime_error(what);
}

// Element i of an accessor, component k, as a number.
class Values {
 public:
    Values(const tinygltf::Model& model, int index)
        : accessor_(model.accessors.at(static_cast<std::size_t>(index))) {
        const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor_.bufferView));
        const auto& buffer = model.buffers.at(static_cast<std::size_t>(view.buffer));
        stride_ = static_cast<std::size_t>(accessor_.ByteStride(view));
        size_ = static_cast<std::size_t>(
            tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(accessor_.componentType)));
        const std::size_t at = view.byteOffset + accessor_.byteOffset;
        expect(at + accessor_.count * stride_ <= buffer.data.size() + stride_,
               "an accessor leaves its buffer");
        data_ = buffer.data.data() + at;
    }
    [[nodiscard]] std::size_t count() const { return accessor_.count; }
    [[nodiscard]] double number(std::size_t i, std::size_t k) const {
        const unsigned char* at = data_ + i * stride_ + k * size_;
        if (accessor_.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return read<float>(at);
        if (accessor_.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return read<std::uint16_t>(at);
        if (accessor_.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return read<std::uint32_t>(at);
        throw std::runtime_error("a component type that is not looked at here");
    }

 private:
    template <typename T>
    static double read(const unsigned char* at) {
        T value{};
        std::memcpy(&value, at, sizeof value);
        return static_cast<double>(value);
    }
    const tinygltf::Accessor& accessor_;
    const unsigned char* data_ = nullptr;
    std::size_t stride_ = 0, size_ = 0;
};

GlbPart read_part(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    GlbPart part;
    const auto& material = model.materials.at(static_cast<std::size_t>(primitive.material));
    for (std::size_t k = 0; k < 3; ++k)
        part.color.at(k) = material.pbrMetallicRoughness.baseColorFactor.at(k);
    part.double_sided = material.doubleSided;
    part.texture = material.pbrMetallicRoughness.baseColorTexture.index;
    const Values points(model, primitive.attributes.at("POSITION"));
    for (std::size_t i = 0; i < points.count(); ++i) {
        part.points.push_back({points.number(i, 0), points.number(i, 1), points.number(i, 2)});
    }
    if (const auto normals = primitive.attributes.find("NORMAL"); normals != primitive.attributes.end()) {
        const Values all(model, normals->second);
        expect(all.count() == points.count(), "there are not as many normals as points");
        for (std::size_t i = 0; i < all.count(); ++i) {
            part.normals.push_back({all.number(i, 0), all.number(i, 1), all.number(i, 2)});
        }
    }
    if (part.texture >= 0) {
        const Values all(model, primitive.attributes.at("TEXCOORD_0"));
        expect(all.count() == points.count(), "there are not as many places in the texture as points");
        for (std::size_t i = 0; i < all.count(); ++i)
            part.places.push_back({all.number(i, 0), all.number(i, 1)});
    }
    const Values indices(model, primitive.indices);
    if (primitive.mode == TINYGLTF_MODE_LINE) {
        for (std::size_t i = 0; i + 1 < indices.count(); i += 2) {
            part.lines.push_back({static_cast<std::uint32_t>(indices.number(i, 0)),
                                  static_cast<std::uint32_t>(indices.number(i + 1, 0))});
        }
        return part;
    }
    for (std::size_t i = 0; i + 2 < indices.count(); i += 3) {
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k)
            triangle.at(k) = static_cast<std::uint32_t>(indices.number(i + k, 0));
        part.triangles.push_back(triangle);
    }
    return part;
}

GlbNode read_node(const tinygltf::Model& model, const tinygltf::Node& from) {
    expect(from.matrix.empty() && from.scale.empty(), "a node has a matrix or a scale");
    GlbNode node;
    node.name = from.name;
    if (from.extras.Has("plate")) node.plate = from.extras.Get("plate").Get<std::string>();
    if (from.extras.Has("part")) node.part = from.extras.Get("part").Get<std::string>();
    if (from.extras.Has("piece")) node.piece = from.extras.Get("piece").Get<std::string>();
    std::copy(from.translation.begin(), from.translation.end(), node.translation.begin());
    std::copy(from.rotation.begin(), from.rotation.end(), node.rotation.begin());
    if (from.mesh >= 0) {
        for (const auto& primitive : model.meshes.at(static_cast<std::size_t>(from.mesh)).primitives) {
            node.parts.push_back(read_part(model, primitive));
        }
    }
    return node;
}

void read_animation(const tinygltf::Model& model, GlbScene& scene) {
    if (model.animations.empty()) return;
    const tinygltf::Animation& animation = model.animations.front();
    expect(model.animations.size() == 1 && animation.name == "open", "there is not one animation, open");
    int input = -1;  // of turns
    for (const auto& channel : animation.channels) {
        const auto& sampler = animation.samplers.at(static_cast<std::size_t>(channel.sampler));
        expect(sampler.interpolation == "LINEAR", "a channel is not interpolated evenly");
        auto& node = scene.nodes.at(static_cast<std::size_t>(channel.target_node));
        if (channel.target_path == "translation") {
            const Values times(model, sampler.input);
            const Values places(model, sampler.output);
            expect(times.count() == places.count(), "there are not as many places as times");
            for (std::size_t i = 0; i < places.count(); ++i)
                node.places.push_back(
                    {times.number(i, 0), {places.number(i, 0), places.number(i, 1), places.number(i, 2)}});
            continue;
        }
        expect(channel.target_path == "rotation", "a channel moves something but a place or a rotation");
        if (input < 0) input = sampler.input;
        expect(sampler.input == input, "turns have different times");
        const Values turns(model, sampler.output);
        for (std::size_t i = 0; i < turns.count(); ++i) {
            node.turns.push_back(
                {turns.number(i, 0), turns.number(i, 1), turns.number(i, 2), turns.number(i, 3)});
        }
    }
    scene.channels = static_cast<int>(animation.channels.size());
    expect(input >= 0, "nothing turns");
    const Values times(model, input);
    for (std::size_t i = 0; i < times.count(); ++i) scene.times.push_back(times.number(i, 0));
    const tinygltf::Value& angles = animation.extras.Get("angles_deg");
    for (std::size_t i = 0; i < angles.ArrayLen(); ++i) {
        scene.angles_deg.push_back(angles.Get(static_cast<int>(i)).GetNumberAsDouble());
    }
    expect(scene.angles_deg.size() == scene.times.size(), "there are not as many angles as times");
}

GlbScene read_scene(const tinygltf::Model& model) {
    GlbScene scene;
    scene.generator = model.asset.generator;
    scene.materials = static_cast<int>(model.materials.size());
    for (const auto& texture : model.textures) {
        const tinygltf::Image& image = model.images.at(static_cast<std::size_t>(texture.source));
        expect(image.component == 4 && image.bits == 8, "a texture is not read as four bytes a pixel");
        scene.textures.push_back({image.width, image.height, image.image});
    }
    for (const auto& node : model.nodes) scene.nodes.push_back(read_node(model, node));
    scene.order = model.scenes.at(0).nodes;
    for (std::size_t i = 0; i < scene.order.size(); ++i) {
        const int parent = scene.order[i];
        for (const int child : model.nodes.at(static_cast<std::size_t>(parent)).children) {
            scene.nodes.at(static_cast<std::size_t>(child)).parent = parent;
            scene.order.push_back(child);
        }
    }
    expect(scene.order.size() == scene.nodes.size(), "nodes are not one tree each");
    read_animation(model, scene);
    return scene;
}

using Turn = std::array<double, 4>;

// glTF 2.0, appendix C.4: spherical linear interpolation, the short way.
Turn slerp(const Turn& a, Turn b, double t) {
    double d = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    if (d < 0.0) {
        d = -d;
        for (double& value : b) value = -value;
    }
    const double angle = std::acos(std::min(d, 1.0));
    const double wa = angle < 1e-9 ? 1.0 - t : std::sin((1.0 - t) * angle) / std::sin(angle);
    const double wb = angle < 1e-9 ? t : std::sin(t * angle) / std::sin(angle);
    Turn result{};
    for (std::size_t i = 0; i < 4; ++i) result.at(i) = wa * a.at(i) + wb * b.at(i);
    return result;
}

std::array<Point3, 3> axes_of(Turn q) {
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& value : q) value /= size;
    const auto [x, y, z, w] = q;
    return {Point3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            Point3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            Point3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

Point3 place_at(const GlbNode& node, double seconds) {
    const auto& places = node.places;
    const auto next = std::find_if(places.begin(), places.end(),
                                   [seconds](const auto& place) { return place.first > seconds; });
    if (next == places.begin()) return next->second;
    const auto last = std::prev(next);
    if (next == places.end()) return last->second;
    const double t = (seconds - last->first) / (next->first - last->first);
    return last->second + t * (next->second - last->second);
}

// All nodes, `turn_of` giving each its rotation, and `place_of` its translation.
template <typename TurnOf, typename PlaceOf>
std::vector<GlbPose> poses(const GlbScene& scene, const TurnOf& turn_of, const PlaceOf& place_of) {
    std::vector<GlbPose> result(scene.nodes.size());
    for (const int i : scene.order) {
        const GlbNode& node = scene.nodes[static_cast<std::size_t>(i)];
        GlbPose& pose = result[static_cast<std::size_t>(i)];
        pose.axes = axes_of(turn_of(node));
        pose.origin = place_of(node);
        if (node.parent < 0) continue;
        const GlbPose& parent = result[static_cast<std::size_t>(node.parent)];
        for (Point3& axis : pose.axes) axis = parent.direction(axis);
        pose.origin = parent.point(pose.origin);
    }
    return result;
}

std::vector<GlbPose> poses_between(const GlbScene& scene, std::size_t key, double t) {
    const double from = scene.times[key];
    const double seconds = t == 0.0 ? from : from + t * (scene.times[key + 1] - from);
    return poses(
        scene,
        [key, t](const GlbNode& node) {
            if (node.turns.empty()) return node.rotation;
            return t == 0.0 ? node.turns[key] : slerp(node.turns[key], node.turns[key + 1], t);
        },
        [seconds](const GlbNode& node) {
            return node.places.empty() ? node.translation : place_at(node, seconds);
        });
}

std::vector<GlbPose> poses_where(const GlbScene& scene, const std::vector<double>& keys, double value) {
    if (keys.empty()) return rest_pose(scene);
    const auto above =
        static_cast<std::size_t>(std::upper_bound(keys.begin(), keys.end(), value) - keys.begin());
    if (above == 0) return poses_between(scene, 0, 0.0);
    if (above == keys.size()) return poses_between(scene, keys.size() - 1, 0.0);
    return poses_between(scene, above - 1, (value - keys[above - 1]) / (keys[above] - keys[above - 1]));
}

Point3 nearest_on_segment(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 ab = b - a;
    const double t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
    return a + t * ab;
}

// The point of a triangle in the plane z = 0 that is nearest to p.
Point3 nearest_on_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    const std::array<const Point3*, 3> corners{&a, &b, &c};
    bool inside = true;
    Point3 nearest = a;
    double best = HUGE_VAL;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3& from = *corners.at(i);
        const Point3& to = *corners.at((i + 1) % 3);
        if ((to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]) < 0.0) inside = false;
        const Point3 on = nearest_on_segment(p, from, to);
        if (distance(on, p) < best) {
            best = distance(on, p);
            nearest = on;
        }
    }
    return inside ? Point3{p[0], p[1], 0.0} : nearest;
}

Point3 to_local(const GlbPose& pose, const Point3& world) {
    const Point3 d = world - pose.origin;
    return {dot(pose.axes[0], d), dot(pose.axes[1], d), dot(pose.axes[2], d)};
}

double apart(const std::vector<GlbPose>& at, const GlbJoint& joint) {
    return distance(at[static_cast<std::size_t>(joint.a)].point(joint.in_a),
                    at[static_cast<std::size_t>(joint.b)].point(joint.in_b));
}

struct Bounds {
    Point3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    [[nodiscard]] bool near(const Point3& p, double by) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (p.at(k) < low.at(k) - by || p.at(k) > high.at(k) + by) return false;
        }
        return true;
    }
};

}  // namespace

std::optional<GlbScene> read_glb(const std::string& bytes, std::string* error) {
    tinygltf::Model model;
    tinygltf::TinyGLTF loader;
    std::string warning;
    try {
        if (!loader.LoadBinaryFromMemory(&model, error, &warning,
                                         reinterpret_cast<const unsigned char*>(bytes.data()),
                                         static_cast<unsigned>(bytes.size()))) {
            return std::nullopt;
        }
        return read_scene(model);
    } catch (const std::exception& problem) {
        *error = problem.what();
        return std::nullopt;
    }
}

Point3 GlbPose::direction(const Point3& local) const {
    return local[0] * axes[0] + local[1] * axes[1] + local[2] * axes[2];
}
Point3 GlbPose::point(const Point3& local) const { return origin + direction(local); }

std::vector<GlbPose> rest_pose(const GlbScene& scene) {
    return poses(
        scene, [](const GlbNode& node) { return node.rotation; },
        [](const GlbNode& node) { return node.translation; });
}
std::vector<GlbPose> pose_at_time(const GlbScene& scene, double seconds) {
    return poses_where(scene, scene.times, seconds);
}
std::vector<GlbPose> pose_at_angle(const GlbScene& scene, double angle_deg) {
    return poses_where(scene, scene.angles_deg, angle_deg);
}

std::vector<GlbJoint> find_joints(const GlbScene& scene) {
    const std::vector<GlbPose> rest = rest_pose(scene);
    std::vector<Bounds> bounds(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parts.empty()) continue;
        for (const Point3& p : scene.nodes[i].parts[0].points) {
            const Point3 world = rest[i].point(p);
            for (std::size_t k = 0; k < 3; ++k) {
                bounds[i].low.at(k) = std::min(bounds[i].low.at(k), world.at(k));
                bounds[i].high.at(k) = std::max(bounds[i].high.at(k), world.at(k));
            }
        }
    }
    std::vector<GlbJoint> joints;
    for (std::size_t a = 0; a < scene.nodes.size(); ++a) {
        if (scene.nodes[a].parts.empty()) continue;
        for (const Point3& corner : scene.nodes[a].parts[0].points) {
            const Point3 world = rest[a].point(corner);
            for (std::size_t b = 0; b < scene.nodes.size(); ++b) {
                if (a == b || !bounds[b].near(world, kJoinedMetres)) continue;
                const Point3 local = to_local(rest[b], world);
                const GlbPart& part = scene.nodes[b].parts[0];
                Point3 best{};
                double nearest = kJoinedMetres;
                for (const auto& t : part.triangles) {
                    const Point3 on =
                        nearest_on_triangle(local, part.points[t[0]], part.points[t[1]], part.points[t[2]]);
                    if (distance(on, local) < nearest) {
                        nearest = distance(on, local);
                        best = on;
                    }
                }
                if (nearest < kJoinedMetres)
                    joints.push_back({static_cast<int>(a), static_cast<int>(b), corner, best});
            }
        }
    }
    // What only happens to touch at rest parts on the way.
    std::vector<std::size_t> close(joints.size(), 0);
    std::size_t looked_at = 0;
    for (std::size_t key = 1; key + 1 < scene.times.size(); ++key) {
        const auto at = poses_between(scene, key, 0.0);
        ++looked_at;
        for (std::size_t i = 0; i < joints.size(); ++i)
            close[i] += apart(at, joints[i]) < kJoinedMetres ? 1 : 0;
    }
    std::vector<GlbJoint> lasting;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (4 * close[i] >= 3 * looked_at) lasting.push_back(joints[i]);
    }
    return lasting;
}

GlbOpenings measure_openings(const GlbScene& scene, const std::vector<GlbJoint>& joints) {
    GlbOpenings result;
    for (std::size_t key = 0; key < scene.times.size(); ++key) {
        for (int step = 0; step < 8; ++step) {
            if (step > 0 && key + 1 == scene.times.size()) break;
            const auto at = poses_between(scene, key, step / 8.0);
            for (std::size_t i = 0; i < joints.size(); ++i) {
                const double open = 1000.0 * apart(at, joints[i]);
                if (step == 0) {
                    result.at_keys_mm = std::max(result.at_keys_mm, open);
                } else if (open > result.between_keys_mm) {
                    result.between_keys_mm = open;
                    result.joint = static_cast<int>(i);
                    result.at_deg = scene.angles_deg[key] +
                                    step / 8.0 * (scene.angles_deg[key + 1] - scene.angles_deg[key]);
                }
            }
        }
    }
    return result;
}

}  // namespace popup::test
