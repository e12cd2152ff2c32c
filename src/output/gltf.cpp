#include "output/gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <streambuf>
#include <utility>

#include "base/geometry/triangulate.h"
#include "base/text/numbers.h"
#include "output/examination_json.h"
#include "output/keys.h"
#include "output/mesh.h"
#include "output/poses.h"

namespace popup {
namespace {

constexpr double kMetre = 1000.0;
constexpr double kDrawnLiftMm = 0.02;   // of drawn lines before the paper
constexpr Color kCollision{255, 0, 0};  // of plates that cross others
constexpr Color kStillPaper{255, 255, 255};
constexpr Color kStillLine{0, 0, 0};
constexpr int kLengthDecimals = 6;
constexpr std::size_t kSharedIndices = 24;
constexpr double kMostBytes = std::numeric_limits<std::int32_t>::max();  // what the library's numbers hold

static_assert(sizeof(float) == 4 && std::numeric_limits<float>::is_iec559);

float metres(double mm) { return static_cast<float>(rounded(mm, kLengthDecimals) / kMetre); }

std::vector<double> metres(Vec3 mm) {
    return {rounded(mm.x, kLengthDecimals) / kMetre, rounded(mm.y, kLengthDecimals) / kMetre,
            rounded(mm.z, kLengthDecimals) / kMetre};
}

// A colour channel as light; six decimals, because pow() differs between processors in the last bit.
double linear(std::uint8_t channel) {
    const double s = channel / 255.0;
    return rounded(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4), 6);
}

// glTF text is UTF-8, and names hold file names: bytes that are none become U+FFFD.
std::string valid_utf8(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t k) {
            return k < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[k])) : 0U;
        };
        const unsigned lead = byte(i);
        const std::size_t size = lead < 0x80                   ? 1
                                 : lead >= 0xC2 && lead < 0xE0 ? 2
                                 : lead >= 0xE0 && lead < 0xF0 ? 3
                                 : lead >= 0xF0 && lead < 0xF5 ? 4
                                                               : 0;
        bool good = size > 0 && i + size <= text.size();
        for (std::size_t k = 1; good && k < size; ++k) good = (byte(i + k) & 0xC0U) == 0x80U;
        // Neither overlong forms nor surrogates nor what lies beyond U+10FFFF.
        if (good && lead == 0xE0) good = byte(i + 1) >= 0xA0;
        if (good && lead == 0xED) good = byte(i + 1) < 0xA0;
        if (good && lead == 0xF0) good = byte(i + 1) >= 0x90;
        if (good && lead == 0xF4) good = byte(i + 1) < 0x90;
        result += good ? text.substr(i, size) : std::string_view("\xEF\xBF\xBD");
        i += good ? size : 1;
    }
    return result;
}

// Bytes of one buffer view, and what accessors into it need.
class View {
 public:
    template <typename T>
    std::size_t append(std::span<const T> values) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + values.size_bytes());
        if (!values.empty()) std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
        return at;
    }
    [[nodiscard]] const std::vector<unsigned char>& bytes() const { return bytes_; }
    void release() { bytes_ = {}; }

 private:
    std::vector<unsigned char> bytes_;
};

enum Surface { kPaper, kDrawn, kColliding, kTrail };

enum ViewIndex : std::size_t {
    kPositions,
    kNormals,
    kFaceNormals,
    kShortIndices,
    kLongIndices,
    kMotion,
    kViews
};

// What stands still, as points of space.
struct StillMesh {
    std::vector<Vec3> points;   // mm
    std::vector<Vec3> normals;  // of lines none
    std::vector<std::uint32_t> indices;
};

StillMesh mesh_of(const std::vector<StillFace>& faces) {
    StillMesh mesh;
    for (const StillFace& face : faces) {
        const Triangulation flat = triangulate(face.shape);
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        for (const Vec2 p : flat.points) {
            mesh.points.push_back(face.frame.point(p));
            mesh.normals.push_back(face.frame.normal());
        }
        for (const auto& triangle : flat.triangles) {
            for (const std::uint32_t corner : triangle) mesh.indices.push_back(first + corner);
        }
    }
    return mesh;
}

// Lines as pairs of points.
StillMesh mesh_of(const std::vector<std::vector<Vec3>>& lines) {
    StillMesh mesh;
    for (const std::vector<Vec3>& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (i > 0) {
                const auto end = static_cast<std::uint32_t>(mesh.points.size());
                mesh.indices.insert(mesh.indices.end(), {end - 1, end});
            }
            mesh.points.push_back(line[i]);
        }
    }
    return mesh;
}

class SceneBuilder {
 public:
    explicit SceneBuilder(const OutputOptions& options) : options_(options) {}

    tinygltf::Model build(std::span<const SceneCard> cards, Keys keys) {
        model_.asset.version = "2.0";
        model_.asset.generator = "popupc " POPUP_VERSION;
        add_times(keys);
        tinygltf::Scene scene;
        double left = 0.0;       // where the next card may begin
        std::size_t moving = 0;  // how many of them there were
        for (std::size_t i = 0; i < cards.size(); ++i) {
            const bool still = cards[i].still != nullptr;
            double shift = 0.0;
            if (cards.size() > 1) {
                const auto [low, high] =
                    still ? extent(*cards[i].still)
                          : extent(*cards[i].assembly, keys.trees[moving], keys.tracks[moving]);
                if (i > 0) shift = left - low;
                left = shift + high + kCardGapMm;
            }
            if (still) {
                scene.nodes.push_back(add_still(cards[i], shift));
                continue;
            }
            scene.nodes.push_back(add_card(cards[i], keys.trees[moving], keys.tracks[moving], shift));
            keys.tracks[moving++] = {};
        }
        model_.scenes.push_back(std::move(scene));
        model_.defaultScene = 0;
        if (!animation_.channels.empty()) add_animation(keys.angles_deg);
        if (largest_mesh_ > 0) add_normals();
        add_buffer();
        return std::move(model_);
    }

 private:
    int add_accessor(ViewIndex view, std::size_t offset, int component, int type, std::size_t count) {
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(view);
        accessor.byteOffset = offset;
        accessor.componentType = component;
        accessor.type = type;
        accessor.count = count;
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    void add_times(const Keys& keys) {
        const double from = keys.range.from_deg;
        const double width = keys.range.to_deg - from;
        for (const double angle : keys.angles_deg) {
            times_.push_back(static_cast<float>(rounded((angle - from) / width, 9) * options_.duration_s));
        }
    }

    int material(Color color, Surface surface) {
        const auto [at, is_new] = materials_.try_emplace({surface, color.r, color.g, color.b},
                                                         static_cast<int>(model_.materials.size()));
        if (!is_new) return at->second;
        const bool drawn = surface == kDrawn;
        tinygltf::Material material;
        material.name = surface == kColliding ? "collision"
                        : surface == kTrail   ? "trail"
                                              : to_string(color) + (drawn ? " line" : "");
        material.pbrMetallicRoughness.baseColorFactor = {linear(color.r), linear(color.g), linear(color.b),
                                                         1.0};
        material.pbrMetallicRoughness.metallicFactor = 0.0;
        material.pbrMetallicRoughness.roughnessFactor = 1.0;
        // From behind a line must not shine through its paper.
        material.doubleSided = !drawn;
        model_.materials.push_back(std::move(material));
        return at->second;
    }

    tinygltf::Primitive primitive(const MeshPart& part, bool collides) {
        const float z = part.drawn ? metres(kDrawnLiftMm) : 0.0F;
        std::vector<float> positions;
        positions.reserve(3 * part.points.size());
        std::array<float, 3> low{};
        std::array<float, 3> high{};
        for (const Vec2 p : part.points) {
            const std::array<float, 3> at{metres(p.x), metres(p.y), z};
            for (std::size_t k = 0; k < 3; ++k) {
                low.at(k) = positions.empty() ? at.at(k) : std::min(low.at(k), at.at(k));
                high.at(k) = positions.empty() ? at.at(k) : std::max(high.at(k), at.at(k));
            }
            positions.insert(positions.end(), at.begin(), at.end());
        }
        tinygltf::Primitive result;
        result.mode = TINYGLTF_MODE_TRIANGLES;
        result.material = part.drawn ? material(part.color, kDrawn)
                          : collides ? material(kCollision, kColliding)
                                     : material(part.color, kPaper);
        const int position =
            add_accessor(kPositions, views_[kPositions].append(std::span<const float>(positions)),
                         TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, part.points.size());
        model_.accessors.back().minValues.assign(low.begin(), low.end());
        model_.accessors.back().maxValues.assign(high.begin(), high.end());
        result.attributes["POSITION"] = position;
        result.attributes["NORMAL"] = normals(part.points.size());
        result.indices = indices(part);
        return result;
    }

    // Every normal is (0, 0, 1): parts share one run of them, and an accessor with every part of their size.
    int normals(std::size_t count) {
        largest_mesh_ = std::max(largest_mesh_, count);
        const auto [at, is_new] = normals_.try_emplace(count, 0);
        if (is_new)
            at->second = add_accessor(kNormals, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, count);
        return at->second;
    }

    void add_normals() {
        std::vector<std::array<float, 3>> all(largest_mesh_, {0.0F, 0.0F, 1.0F});
        views_[kNormals].append(std::span<const std::array<float, 3>>(all));
    }

    tinygltf::Primitive primitive(const StillMesh& mesh, Color color, Surface surface) {
        std::vector<float> positions;
        positions.reserve(3 * mesh.points.size());
        std::array<float, 3> low{};
        std::array<float, 3> high{};
        for (const Vec3 p : mesh.points) {
            const std::array<float, 3> at{metres(p.x), metres(p.y), metres(p.z)};
            for (std::size_t k = 0; k < 3; ++k) {
                low.at(k) = positions.empty() ? at.at(k) : std::min(low.at(k), at.at(k));
                high.at(k) = positions.empty() ? at.at(k) : std::max(high.at(k), at.at(k));
            }
            positions.insert(positions.end(), at.begin(), at.end());
        }
        tinygltf::Primitive result;
        result.mode = surface == kTrail ? TINYGLTF_MODE_LINE : TINYGLTF_MODE_TRIANGLES;
        result.material = material(color, surface);
        const int position =
            add_accessor(kPositions, views_[kPositions].append(std::span<const float>(positions)),
                         TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh.points.size());
        model_.accessors.back().minValues.assign(low.begin(), low.end());
        model_.accessors.back().maxValues.assign(high.begin(), high.end());
        result.attributes["POSITION"] = position;
        if (!mesh.normals.empty()) {
            std::vector<float> normals;
            normals.reserve(3 * mesh.normals.size());
            for (const Vec3 n : mesh.normals) {
                for (const double one : {n.x, n.y, n.z})
                    normals.push_back(static_cast<float>(rounded(one, 9)));
            }
            result.attributes["NORMAL"] =
                add_accessor(kFaceNormals, views_[kFaceNormals].append(std::span<const float>(normals)),
                             TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh.normals.size());
        }
        result.indices = add_indices(mesh.indices, mesh.points.size());
        return result;
    }

    // Most plates have four corners: equal short lists of triangles share one accessor.
    int indices(const MeshPart& part) {
        if (part.indices.size() > kSharedIndices) return add_indices(part.indices, part.points.size());
        const auto [at, is_new] = indices_.try_emplace(part.indices, 0);
        if (is_new) at->second = add_indices(part.indices, part.points.size());
        return at->second;
    }

    int add_indices(const std::vector<std::uint32_t>& indices, std::size_t points) {
        const std::size_t count = indices.size();
        // The largest 16-bit number is kept for a restart of primitives.
        if (points < std::numeric_limits<std::uint16_t>::max()) {
            const std::vector<std::uint16_t> small(indices.begin(), indices.end());
            return add_accessor(kShortIndices,
                                views_[kShortIndices].append(std::span<const std::uint16_t>(small)),
                                TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, count);
        }
        return add_accessor(kLongIndices,
                            views_[kLongIndices].append(std::span<const std::uint32_t>(indices)),
                            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, count);
    }

    int add_mesh(const Plate& plate, const std::string& name, bool collides) {
        tinygltf::Mesh mesh;
        mesh.name = name;
        for (const MeshPart& part : plate_mesh(plate)) mesh.primitives.push_back(primitive(part, collides));
        if (mesh.primitives.empty()) return -1;
        model_.meshes.push_back(std::move(mesh));
        return static_cast<int>(model_.meshes.size()) - 1;
    }

    // The smallest and largest x of any corner at any key, in mm.
    static std::pair<double, double> extent(const Assembly& assembly, const HingeTree& tree,
                                            const Track& track) {
        const std::size_t count = assembly.plates.size();
        std::vector<Quaternion> turns(count);
        std::vector<Frame> frames(count);
        std::pair<double, double> result{0.0, 0.0};
        for (std::size_t k = 0; k < track.angles_deg.size(); ++k) {
            for (std::size_t i = 0; i < count; ++i) {
                const auto& turn = track.turns[k * count + i];
                turns[i] = {turn[0], turn[1], turn[2], turn[3]};
            }
            compose(assembly, tree, turns, frames);
            for (std::size_t i = 0; i < count; ++i) {
                for (const Vec2 p : assembly.plates[i].outline.outer) {
                    const double x = frames[i].point(p).x;
                    result = {std::min(result.first, x), std::max(result.second, x)};
                }
            }
        }
        return {rounded(result.first, kLengthDecimals), rounded(result.second, kLengthDecimals)};
    }

    static std::pair<double, double> extent(const StillModel& still) {
        std::pair<double, double> result{HUGE_VAL, -HUGE_VAL};
        const auto take = [&](Vec3 p) {
            result = {std::min(result.first, p.x), std::max(result.second, p.x)};
        };
        for (const StillNode& node : still.nodes) {
            for (const StillFace& face : node.faces) {
                for (const Vec2 p : face.shape.outer) take(face.frame.point(p));
            }
            for (const std::vector<Vec3>& line : node.lines) {
                for (const Vec3 p : line) take(p);
            }
        }
        if (result.first > result.second) return {0.0, 0.0};
        return {rounded(result.first, kLengthDecimals), rounded(result.second, kLengthDecimals)};
    }

    // What each plate's node says of the plates it crosses.
    static std::vector<tinygltf::Value::Array> collisions_of(const SceneCard& card) {
        const std::vector<Plate>& plates = card.assembly->plates;
        std::vector<tinygltf::Value::Array> all(plates.size());
        if (!card.motion->examination) return all;
        for (const Contact& contact : card.motion->examination->contacts) {
            const auto tell = [&](int own, int other) {
                const std::string& name = plates.at(static_cast<std::size_t>(other)).name;
                tinygltf::Value::Object row{{"with", tinygltf::Value(valid_utf8(card.prefix + name))},
                                            {"from_deg", tinygltf::Value(told_deg(contact.from_deg))},
                                            {"to_deg", tinygltf::Value(told_deg(contact.to_deg))},
                                            {"depth_mm", tinygltf::Value(told_mm(contact.depth_mm))}};
                all.at(static_cast<std::size_t>(own)).emplace_back(std::move(row));
            };
            tell(contact.a, contact.b);
            tell(contact.b, contact.a);
        }
        return all;
    }

    // The number of the node that all of a card's are below.
    int add_root(const SceneCard& card, std::string_view stem, std::string_view nameless, double shift) {
        tinygltf::Node node;
        const std::string_view prefix = card.prefix;
        node.name = valid_utf8(prefix.ends_with(':') ? prefix.substr(0, prefix.size() - 1) : stem);
        if (node.name.empty()) node.name = nameless;
        if (shift != 0.0) node.translation = metres(Vec3{shift, 0.0, 0.0});
        model_.nodes.push_back(std::move(node));
        return static_cast<int>(model_.nodes.size()) - 1;
    }

    // The number of the node of all parts; theirs follow it in their order.
    int add_still(const SceneCard& card, double shift) {
        const int root = add_root(card, card.stem, "parts", shift);
        for (const StillNode& node : card.still->nodes) {
            tinygltf::Node one;
            one.name = valid_utf8(card.prefix + node.name);
            tinygltf::Mesh mesh;
            mesh.name = one.name;
            const StillMesh paper = mesh_of(node.faces);
            if (!paper.indices.empty()) mesh.primitives.push_back(primitive(paper, kStillPaper, kPaper));
            const StillMesh lines = mesh_of(node.lines);
            if (!lines.indices.empty()) mesh.primitives.push_back(primitive(lines, kStillLine, kTrail));
            if (!mesh.primitives.empty()) {
                one.mesh = static_cast<int>(model_.meshes.size());
                model_.meshes.push_back(std::move(mesh));
            }
            if (!node.faces.empty()) one.extras = tinygltf::Value({{"part", tinygltf::Value(one.name)}});
            const int number = static_cast<int>(model_.nodes.size());
            model_.nodes.push_back(std::move(one));
            model_.nodes[static_cast<std::size_t>(root)].children.push_back(number);
        }
        return root;
    }

    // The number of the card's node; its plates' nodes follow it in the assembly's order.
    int add_card(const SceneCard& card, const HingeTree& tree, const Track& track, double shift) {
        const Assembly& assembly = *card.assembly;
        const int root = add_root(card, assembly.stem, "card", shift);

        const auto rest = static_cast<std::size_t>(
            std::lower_bound(track.angles_deg.begin(), track.angles_deg.end(), middle_of(assembly.sweep)) -
            track.angles_deg.begin());
        const std::size_t count = assembly.plates.size();
        std::vector<std::string> pieces;
        for (const Piece& piece : assembly.pieces) pieces.push_back(valid_utf8(card.prefix + piece.name));
        const std::vector<tinygltf::Value::Array> collisions = collisions_of(card);
        for (std::size_t i = 0; i < count; ++i) {
            const Plate& plate = assembly.plates[i];
            tinygltf::Node one;
            one.name = valid_utf8(card.prefix + plate.name);
            one.mesh = add_mesh(plate, one.name, !collisions[i].empty());
            if (!(tree.offset[i] == Vec3{})) one.translation = metres(tree.offset[i]);
            const auto& turn = track.turns[rest * count + i];
            one.rotation.assign(turn.begin(), turn.end());
            tinygltf::Value::Object extras{
                {"plate", tinygltf::Value(one.name)},
                {"piece", tinygltf::Value(pieces.at(static_cast<std::size_t>(plate.piece)))}};
            if (!collisions[i].empty()) extras.emplace("collisions", tinygltf::Value(collisions[i]));
            one.extras = tinygltf::Value(std::move(extras));
            model_.nodes.push_back(std::move(one));
            add_channel(track, count, i, root + 1 + static_cast<int>(i));
        }
        for (const int i : tree.order) {
            const int parent = root + 1 + assembly.plates[static_cast<std::size_t>(i)].parent;
            model_.nodes[static_cast<std::size_t>(parent)].children.push_back(root + 1 + i);
        }
        return root;
    }

    void add_channel(const Track& track, std::size_t plates, std::size_t plate, int node) {
        turns_.clear();
        bool moves = false;
        for (std::size_t k = plate; k < track.turns.size(); k += plates) {
            turns_.push_back(track.turns[k]);
            moves = moves || turns_.back() != turns_.front();
        }
        if (!moves) return;
        tinygltf::AnimationSampler sampler;
        sampler.input = time_accessor();
        sampler.interpolation = "LINEAR";
        sampler.output =
            add_accessor(kMotion, views_[kMotion].append(std::span<const std::array<float, 4>>(turns_)),
                         TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, turns_.size());
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation_.samplers.size());
        channel.target_node = node;
        channel.target_path = "rotation";
        animation_.samplers.push_back(std::move(sampler));
        animation_.channels.push_back(std::move(channel));
    }

    int time_accessor() {
        if (time_accessor_ < 0) {
            time_accessor_ = add_accessor(kMotion, views_[kMotion].append(std::span<const float>(times_)),
                                          TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, times_.size());
            model_.accessors.back().minValues = {times_.front()};
            model_.accessors.back().maxValues = {times_.back()};
        }
        return time_accessor_;
    }

    void add_animation(const std::vector<double>& angles_deg) {
        tinygltf::Value::Array angles;
        for (const double angle : angles_deg) angles.emplace_back(angle);
        animation_.name = "open";
        animation_.extras = tinygltf::Value({{"angles_deg", tinygltf::Value(std::move(angles))}});
        model_.animations.push_back(std::move(animation_));
    }

    // Puts the views one after another; views that nothing uses are left out.
    void add_buffer() {
        tinygltf::Buffer buffer;
        std::array<int, kViews> numbers{};
        for (std::size_t i = 0; i < kViews; ++i) {
            if (views_.at(i).bytes().empty()) continue;
            numbers.at(i) = static_cast<int>(model_.bufferViews.size());
            tinygltf::BufferView view;
            view.buffer = 0;
            view.byteOffset = buffer.data.size();
            view.byteLength = views_.at(i).bytes().size();
            if (i == kPositions || i == kNormals || i == kFaceNormals) {
                view.target = TINYGLTF_TARGET_ARRAY_BUFFER;
                view.byteStride = 3 * sizeof(float);
            } else if (i != kMotion) {
                view.target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
            }
            buffer.data.insert(buffer.data.end(), views_.at(i).bytes().begin(), views_.at(i).bytes().end());
            buffer.data.resize((buffer.data.size() + 3) / 4 * 4);
            views_.at(i).release();
            model_.bufferViews.push_back(std::move(view));
        }
        for (tinygltf::Accessor& accessor : model_.accessors) {
            accessor.bufferView = numbers.at(static_cast<std::size_t>(accessor.bufferView));
        }
        if (!buffer.data.empty()) model_.buffers.push_back(std::move(buffer));
    }

    const OutputOptions& options_;
    tinygltf::Model model_;
    tinygltf::Animation animation_;
    std::array<View, kViews> views_;
    std::vector<float> times_;
    std::vector<std::array<float, 4>> turns_;  // of one plate; kept for its memory
    std::map<std::array<int, 4>, int> materials_;
    std::map<std::size_t, int> normals_;
    std::map<std::vector<std::uint32_t>, int> indices_;
    std::size_t largest_mesh_ = 0;
    int time_accessor_ = -1;
};

// Collects what is written without the copies of a string stream.
class StringBuffer : public std::streambuf {
 public:
    std::string text;

 protected:
    std::streamsize xsputn(const char* data, std::streamsize count) override {
        text.append(data, static_cast<std::size_t>(count));
        return count;
    }
    int_type overflow(int_type c) override {
        if (c != traits_type::eof()) text += static_cast<char>(c);
        return c;
    }
};

std::optional<std::string> write(std::span<const SceneCard> cards, const OutputOptions& options,
                                 Diagnostics& diagnostics, bool binary) {
    POPUP_INVARIANT(!cards.empty() && options.duration_s > 0.0);
    std::vector<SceneCard> moving;
    std::copy_if(cards.begin(), cards.end(), std::back_inserter(moving),
                 [](const SceneCard& card) { return card.still == nullptr; });
    auto keys = moving.empty() ? std::optional<Keys>(Keys{}) : choose_keys(moving, options, diagnostics);
    if (!keys) return std::nullopt;
    const tinygltf::Model model = SceneBuilder(options).build(cards, std::move(*keys));
    const double bytes = model.buffers.empty() ? 0.0 : static_cast<double>(model.buffers[0].data.size());
    // The JSON of a large model is about half as long as its numbers; the text form needs a third more for
    // them.
    if (1.5 * bytes > kMostBytes) {
        diagnostics
            .error("model-too-large", {},
                   fmt::format("the model would be {:.0f} MB, {:.0f} MB are the most", 1.5e-6 * bytes,
                               1e-6 * kMostBytes))
            .hint("ask for fewer angles or fewer keys a second, or write fewer designs into one model");
        return std::nullopt;
    }
    StringBuffer buffer;
    std::ostream stream(&buffer);
    tinygltf::TinyGLTF writer;
    const bool written = writer.WriteGltfSceneToStream(&model, stream, true, binary);
    POPUP_INVARIANT(written && stream.good());
    return std::move(buffer.text);
}

}  // namespace

std::optional<std::string> write_glb(std::span<const SceneCard> cards, const OutputOptions& options,
                                     Diagnostics& diagnostics) {
    return write(cards, options, diagnostics, true);
}

std::optional<std::string> write_gltf(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics) {
    return write(cards, options, diagnostics, false);
}

}  // namespace popup
