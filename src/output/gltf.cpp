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
#include <utility>

#include "base/text/numbers.h"
#include "output/examination_json.h"
#include "output/gltf_values.h"
#include "output/keys.h"
#include "output/mesh.h"
#include "output/poses.h"
#include "output/space_mesh.h"
#include "popup/image.h"

namespace popup {
namespace {

constexpr double kMetre = 1000.0;
constexpr double kHalfRoot = 0.7071067811865476;  // sin and cos of 45°: half of a quarter turn
constexpr Color kCollision{255, 0, 0};            // of plates that cross others
constexpr Color kTraceColor{0, 0, 0};
constexpr int kLengthDecimals = 6;
constexpr std::size_t kSharedIndices = 24;
constexpr double kMostBytes = std::numeric_limits<std::int32_t>::max();  // what the library's numbers hold

static_assert(sizeof(float) == 4 && std::numeric_limits<float>::is_iec559);

float metres(double mm) { return static_cast<float>(rounded(mm, kLengthDecimals) / kMetre); }

std::vector<double> metres(Vec3 mm) {
    return {rounded(mm.x, kLengthDecimals) / kMetre, rounded(mm.y, kLengthDecimals) / kMetre,
            rounded(mm.z, kLengthDecimals) / kMetre};
}

enum Surface { kPaper, kDrawn, kColliding, kTrail, kPainted, kWritten };

enum ViewIndex : std::size_t {
    kPositions,
    kNormals,
    kFaceNormals,
    kTexturePlaces,
    kShortIndices,
    kLongIndices,
    kMotion,
    kViews
};

class SceneBuilder {
 public:
    explicit SceneBuilder(const OutputOptions& options) : options_(options) {}

    tinygltf::Model build(std::span<const SceneCard> cards, Keys keys) {
        model_.asset.version = "2.0";
        model_.asset.generator = "popupc " POPUP_VERSION;
        add_times(keys);
        tinygltf::Scene scene;
        double left = 0.0;  // where the next card may begin
        for (std::size_t i = 0; i < cards.size(); ++i) {
            double shift = 0.0;
            if (cards.size() > 1) {
                const auto [low, high] = extent(*cards[i].assembly, keys.trees[i], keys.tracks[i]);
                if (i > 0) shift = left - low;
                left = shift + high + kCardGapMm;
            }
            scene.nodes.push_back(add_card(cards[i], keys.trees[i], keys.tracks[i], shift));
            keys.tracks[i] = {};
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
        const bool drawn = surface == kDrawn || surface == kPainted || surface == kWritten;
        tinygltf::Material material;
        material.name = surface == kColliding ? "collision"
                        : surface == kTrail   ? "trail"
                                              : to_string(color) + (surface == kDrawn     ? " line"
                                                                    : surface == kPainted ? " area"
                                                                    : surface == kWritten ? " text"
                                                                                          : "");
        material.pbrMetallicRoughness.baseColorFactor = {linear(color.r), linear(color.g), linear(color.b),
                                                         1.0};
        material.pbrMetallicRoughness.metallicFactor = 0.0;
        material.pbrMetallicRoughness.roughnessFactor = 1.0;
        // From behind a line must not shine through its paper.
        material.doubleSided = !drawn;
        model_.materials.push_back(std::move(material));
        return at->second;
    }

    // The material of a picture: the same for all that shows the same file.
    int material(const Image& image) {
        const auto [at, is_new] =
            pictures_.try_emplace(*image.bytes, static_cast<int>(model_.materials.size()));
        if (!is_new) return at->second;
        const int number = static_cast<int>(model_.images.size());
        tinygltf::Image file;
        file.name = fmt::format("picture {}", number + 1);
        file.mimeType = mime_type(image.format);
        file.bufferView = number;  // among those of pictures, until add_buffer() knows better
        model_.images.push_back(std::move(file));
        picture_files_.push_back(image.bytes);
        if (model_.samplers.empty()) {
            tinygltf::Sampler sampler;
            sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
            sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
            sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
            model_.samplers.push_back(std::move(sampler));
        }
        tinygltf::Texture texture;
        texture.sampler = 0;
        texture.source = number;
        model_.textures.push_back(std::move(texture));
        tinygltf::Material material;
        material.name = model_.images.back().name;
        material.pbrMetallicRoughness.baseColorTexture.index = number;
        material.pbrMetallicRoughness.metallicFactor = 0.0;
        material.pbrMetallicRoughness.roughnessFactor = 1.0;
        material.doubleSided = false;  // as of drawn lines
        if (may_be_transparent(image)) material.alphaMode = "BLEND";
        model_.materials.push_back(std::move(material));
        return at->second;
    }

    int material_of(const Image* image, Color color, bool drawn, double lift_mm) {
        if (image != nullptr) return material(*image);
        return material(color, !drawn                      ? kPaper
                               : lift_mm == kDrawnLiftMm   ? kDrawn
                               : lift_mm == kWrittenLiftMm ? kWritten
                                                           : kPainted);
    }

    // The accessor of places in a picture, as parts of its width and height.
    int texture_places(const Image& image, const std::vector<Vec2>& pixels) {
        std::vector<std::array<float, 2>> places;
        places.reserve(pixels.size());
        for (const Vec2 p : pixels) {
            places.push_back({static_cast<float>(rounded(p.x / image.width, 9)),
                              static_cast<float>(rounded(p.y / image.height, 9))});
        }
        return add_accessor(kTexturePlaces,
                            views_[kTexturePlaces].append(std::span<const std::array<float, 2>>(places)),
                            TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, places.size());
    }

    // The accessor of points, and how far they reach.
    int positions(const std::vector<std::array<float, 3>>& points) {
        std::array<float, 3> low{};
        std::array<float, 3> high{};
        if (!points.empty()) low = high = points.front();
        for (const std::array<float, 3>& at : points) {
            for (std::size_t k = 0; k < 3; ++k) {
                low.at(k) = std::min(low.at(k), at.at(k));
                high.at(k) = std::max(high.at(k), at.at(k));
            }
        }
        const int accessor =
            add_accessor(kPositions, views_[kPositions].append(std::span<const std::array<float, 3>>(points)),
                         TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, points.size());
        model_.accessors.back().minValues.assign(low.begin(), low.end());
        model_.accessors.back().maxValues.assign(high.begin(), high.end());
        return accessor;
    }

    tinygltf::Primitive primitive(const MeshPart& part, Vec2 pivot, bool collides) {
        const float z = metres(part.lift_mm);
        std::vector<std::array<float, 3>> points;
        points.reserve(part.points.size());
        for (const Vec2 p : part.points) points.push_back({metres(p.x), metres(p.y), z});
        tinygltf::Primitive result;
        result.mode = TINYGLTF_MODE_TRIANGLES;
        result.material = collides && !part.drawn
                              ? material(kCollision, kColliding)
                              : material_of(part.image, part.color, part.drawn, part.lift_mm);
        result.attributes["POSITION"] = positions(points);
        result.attributes["NORMAL"] = normals(part.points.size());
        if (part.image != nullptr) {
            result.attributes["TEXCOORD_0"] =
                texture_places(*part.image, pixels_at(*part.image, part.points, pivot));
        }
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

    tinygltf::Primitive primitive(const SpaceMesh& mesh) {
        const bool lines = mesh.normals.empty();
        std::vector<std::array<float, 3>> points;
        points.reserve(mesh.points.size());
        for (const Vec3 p : mesh.points) points.push_back({metres(p.x), metres(p.y), metres(p.z)});
        tinygltf::Primitive result;
        result.mode = lines ? TINYGLTF_MODE_LINE : TINYGLTF_MODE_TRIANGLES;
        result.material = lines ? material(mesh.color, kTrail)
                                : material_of(mesh.image, mesh.color, mesh.drawn, mesh.lift_mm);
        result.attributes["POSITION"] = positions(points);
        if (!lines) {
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
        if (mesh.image != nullptr) result.attributes["TEXCOORD_0"] = texture_places(*mesh.image, mesh.pixels);
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

    int add_mesh(const Plate& plate, const Piece& piece, const std::string& name, bool collides) {
        tinygltf::Mesh mesh;
        mesh.name = name;
        for (const MeshPart& part : plate_mesh(plate, piece.prints))
            mesh.primitives.push_back(primitive(part, plate.pivot, collides));
        if (mesh.primitives.empty()) return -1;
        model_.meshes.push_back(std::move(mesh));
        return static_cast<int>(model_.meshes.size()) - 1;
    }

    // The smallest and largest x of any corner at any key, in mm; the spine of what moves stands at 0.
    static std::pair<double, double> extent(const Assembly& assembly, const HingeTree& tree,
                                            const Track& track) {
        const std::size_t count = assembly.plates.size();
        std::vector<Quaternion> turns(count);
        std::vector<Frame> frames(count);
        std::pair<double, double> result{0.0, 0.0};
        if (!moves(assembly)) result = {HUGE_VAL, -HUGE_VAL};
        const auto take = [&result](Vec3 p) {
            result = {std::min(result.first, p.x), std::max(result.second, p.x)};
        };
        for (std::size_t k = 0; k < track.angles_deg.size(); ++k) {
            for (std::size_t i = 0; i < count; ++i) {
                const auto& turn = track.turns[k * count + i];
                turns[i] = {turn[0], turn[1], turn[2], turn[3]};
            }
            compose(assembly, tree, turns, frames);
            for (std::size_t i = 0; i < count; ++i) {
                for (const Vec2 p : assembly.plates[i].outline.outer) take(frames[i].point(p));
            }
        }
        for (const Plate& plate : assembly.plates) {
            if (!plate.stands) continue;
            for (const Vec2 p : plate.outline.outer) take(plate.stands->point(p));
        }
        for (const Trace& trace : assembly.traces) {
            for (const std::vector<Vec3>& line : trace.lines) std::for_each(line.begin(), line.end(), take);
        }
        if (result.first > result.second) return {0.0, 0.0};
        return {rounded(result.first, kLengthDecimals), rounded(result.second, kLengthDecimals)};
    }

    // What each plate's node says of the plates it crosses.
    static std::vector<tinygltf::Value::Array> collisions_of(const SceneCard& card) {
        const std::vector<Plate>& plates = card.assembly->plates;
        std::vector<tinygltf::Value::Array> all(plates.size());
        if (card.motion == nullptr || !card.motion->examination) return all;
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
    int add_root(const SceneCard& card, double shift) {
        tinygltf::Node node;
        std::string_view name = card.prefix;
        if (name.ends_with(':')) {
            name.remove_suffix(1);
        } else {
            name = card.assembly->stem;
        }
        node.name = valid_utf8(name);
        if (node.name.empty()) node.name = moves(*card.assembly) ? "card" : "parts";
        if (shift != 0.0) node.translation = metres(Vec3{shift, 0.0, 0.0});
        // In glTF y points up. So it does on the pages of a card that stands; of one that lies, their front
        // does.
        const bool flat = card.assembly->orientation == Orientation::flat;
        if (flat) node.rotation = {-kHalfRoot, 0.0, 0.0, kHalfRoot};
        node.extras =
            tinygltf::Value({{"orientation", tinygltf::Value(std::string(flat ? "flat" : "upright"))}});
        model_.nodes.push_back(std::move(node));
        return static_cast<int>(model_.nodes.size()) - 1;
    }

    // The number of the card's node; below it stands what moves and what stands still, each in its order.
    int add_card(const SceneCard& card, const HingeTree& tree, const Track& track, double shift) {
        const int root = add_root(card, shift);
        if (moves(*card.assembly)) add_moving(card, tree, track, root);
        add_standing(card, root);
        return root;
    }

    // The number of a new node below `root`, with these meshes of space.
    int add_space_node(const std::string& name, const std::vector<SpaceMesh>& meshes, int root) {
        tinygltf::Node node;
        node.name = name;
        tinygltf::Mesh mesh;
        mesh.name = name;
        for (const SpaceMesh& one : meshes) {
            if (!one.indices.empty()) mesh.primitives.push_back(primitive(one));
        }
        if (!mesh.primitives.empty()) {
            node.mesh = static_cast<int>(model_.meshes.size());
            model_.meshes.push_back(std::move(mesh));
        }
        const int number = static_cast<int>(model_.nodes.size());
        model_.nodes.push_back(std::move(node));
        model_.nodes[static_cast<std::size_t>(root)].children.push_back(number);
        return number;
    }

    // A node a piece of what stands still, with the lines it was drawn with; then one for each other trace.
    void add_standing(const SceneCard& card, int root) {
        const Assembly& assembly = *card.assembly;
        auto trace = assembly.traces.begin();
        const std::vector<Vec3> lifts = layer_lifts(assembly);
        for (std::size_t i = 0; i < assembly.pieces.size(); ++i) {
            std::vector<SpaceMesh> meshes = standing_meshes(assembly, lifts, assembly.pieces[i]);
            const bool is_part = !meshes.empty();
            if (trace != assembly.traces.end() && trace->piece == static_cast<int>(i)) {
                meshes.push_back(mesh_of((trace++)->lines, kTraceColor));
            }
            if (meshes.empty()) continue;
            const std::string name = valid_utf8(card.prefix + assembly.pieces[i].name);
            const int node = add_space_node(name, meshes, root);
            if (is_part) {
                model_.nodes[static_cast<std::size_t>(node)].extras =
                    tinygltf::Value({{"part", tinygltf::Value(name)}});
            }
        }
        for (; trace != assembly.traces.end(); ++trace) {
            add_space_node(valid_utf8(card.prefix + trace->name), {mesh_of(trace->lines, kTraceColor)}, root);
        }
    }

    // The nodes of plates that move follow `root` in the assembly's order.
    void add_moving(const SceneCard& card, const HingeTree& tree, const Track& track, int root) {
        const Assembly& assembly = *card.assembly;

        const auto rest = static_cast<std::size_t>(
            std::lower_bound(track.angles_deg.begin(), track.angles_deg.end(), rest_of(assembly.sweep)) -
            track.angles_deg.begin());
        const std::size_t count = assembly.plates.size();
        std::vector<std::string> pieces;
        for (const Piece& piece : assembly.pieces) pieces.push_back(valid_utf8(card.prefix + piece.name));
        const std::vector<tinygltf::Value::Array> collisions = collisions_of(card);
        for (std::size_t i = 0; i < count; ++i) {
            const Plate& plate = assembly.plates[i];
            tinygltf::Node one;
            one.name = valid_utf8(card.prefix + plate.name);
            one.mesh = add_mesh(plate, assembly.pieces.at(static_cast<std::size_t>(plate.piece)), one.name,
                                !collisions[i].empty());
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
            } else if (i == kTexturePlaces) {
                view.target = TINYGLTF_TARGET_ARRAY_BUFFER;
                view.byteStride = 2 * sizeof(float);
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
        for (tinygltf::Image& image : model_.images) {
            const std::string& file = *picture_files_.at(static_cast<std::size_t>(image.bufferView));
            image.bufferView = static_cast<int>(model_.bufferViews.size());
            tinygltf::BufferView view;
            view.buffer = 0;
            view.byteOffset = buffer.data.size();
            view.byteLength = file.size();
            buffer.data.insert(buffer.data.end(), file.begin(), file.end());
            buffer.data.resize((buffer.data.size() + 3) / 4 * 4);
            model_.bufferViews.push_back(std::move(view));
        }
        if (!buffer.data.empty()) model_.buffers.push_back(std::move(buffer));
    }

    const OutputOptions& options_;
    tinygltf::Model model_;
    tinygltf::Animation animation_;
    std::array<BufferBytes, kViews> views_;
    std::vector<float> times_;
    std::vector<std::array<float, 4>> turns_;  // of one plate; kept for its memory
    std::map<std::array<int, 4>, int> materials_;
    std::map<std::string_view, int> pictures_;  // the materials of files, whose bytes picture_files_ keeps
    std::vector<std::shared_ptr<const std::string>> picture_files_;
    std::map<std::size_t, int> normals_;
    std::map<std::vector<std::uint32_t>, int> indices_;
    std::size_t largest_mesh_ = 0;
    int time_accessor_ = -1;
};

std::optional<std::string> write(std::span<const SceneCard> cards, const OutputOptions& options,
                                 Diagnostics& diagnostics, bool binary) {
    POPUP_INVARIANT(!cards.empty() && options.duration_s > 0.0);
    auto keys = choose_keys(cards, options, diagnostics);
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
