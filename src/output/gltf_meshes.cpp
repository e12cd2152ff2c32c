#include "output/gltf_meshes.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "base/text/numbers.h"
#include "output/plate_edges.h"
#include "popup/image.h"

namespace popup {
namespace {

constexpr Color kCollision{255, 0, 0};  // of plates that cross others
constexpr Color kTraceColor{0, 0, 0};
constexpr Color kEdgeColor{48, 48, 48};
constexpr Color kFoldColor{144, 144, 144};
constexpr std::size_t kSharedIndices = 24;

static_assert(sizeof(float) == 4 && std::numeric_limits<float>::is_iec559);

std::vector<std::array<float, 3>> in_metres(const std::vector<Vec3>& mm) {
    std::vector<std::array<float, 3>> points;
    points.reserve(mm.size());
    for (const Vec3 p : mm) points.push_back({metres(p.x), metres(p.y), metres(p.z)});
    return points;
}

std::vector<std::uint32_t> turned_over(std::vector<std::uint32_t> triangles) {
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) std::swap(triangles[i + 1], triangles[i + 2]);
    return triangles;
}

void append(const std::vector<std::array<std::uint32_t, 2>>& edges, std::uint32_t first,
            std::vector<std::uint32_t>& pairs) {
    for (const auto& ends : edges) pairs.insert(pairs.end(), {first + ends[0], first + ends[1]});
}

}  // namespace

std::string GltfMeshes::name_of(Surface surface, Color color) {
    switch (surface) {
        case kColliding:
            return "collision";
        case kTrail:
            return "trail";
        case kEdge:
            return "edge";
        case kFold:
            return "fold";
        case kPaperBack:
            return to_string(color) + " back";
        case kDrawn:
            return to_string(color) + " line";
        case kPainted:
            return to_string(color) + " area";
        case kWritten:
            return to_string(color) + " text";
        case kPaper:
        case kPaperFront:
            break;
    }
    return to_string(color);
}

// What is printed must not shine through its paper, and the sides of paper may differ.
bool GltfMeshes::is_seen_from_one_side(Surface surface) {
    return surface == kPaperFront || surface == kPaperBack || surface == kDrawn || surface == kPainted ||
           surface == kWritten;
}

int GltfMeshes::add_accessor(View view, std::size_t offset, int component, int type, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(view);
    accessor.byteOffset = offset;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfMeshes::material(Color color, Surface surface) {
    const auto [at, is_new] = materials_.try_emplace({surface, color.r, color.g, color.b},
                                                     static_cast<int>(model_.materials.size()));
    if (!is_new) return at->second;
    tinygltf::Material material;
    material.name = name_of(surface, color);
    material.pbrMetallicRoughness.baseColorFactor = {linear(color.r), linear(color.g), linear(color.b), 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 1.0;
    material.doubleSided = !is_seen_from_one_side(surface);
    model_.materials.push_back(std::move(material));
    return at->second;
}

// The material of a picture: the same for all that shows the same file.
int GltfMeshes::material(const Image& image) {
    const auto [at, is_new] = pictures_.try_emplace(*image.bytes, static_cast<int>(model_.materials.size()));
    if (!is_new) return at->second;
    const int number = static_cast<int>(model_.images.size());
    tinygltf::Image file;
    file.name = fmt::format("picture {}", number + 1);
    file.mimeType = mime_type(image.format);
    file.bufferView = number;  // among those of pictures, until finish() knows better
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

// Of a MeshPart or a SpaceMesh.
template <typename Part>
int GltfMeshes::material_of(const Part& part) {
    if (part.image != nullptr) return material(*part.image);
    return material(part.color, !part.drawn                      ? (part.back ? kPaperFront : kPaper)
                                : part.lift_mm == kDrawnLiftMm   ? kDrawn
                                : part.lift_mm == kWrittenLiftMm ? kWritten
                                                                 : kPainted);
}

// The accessor of places in a picture, as parts of its width and height.
int GltfMeshes::texture_places(const Image& image, const std::vector<Vec2>& pixels) {
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

// The accessor of points, and how far they reach. The corners of a plate are those of its edges.
int GltfMeshes::positions(Points points) {
    if (!points.empty() && points == last_points_) return last_positions_;
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
    last_points_ = std::move(points);
    last_positions_ = accessor;
    return accessor;
}

void GltfMeshes::add_primitives(const MeshPart& part, Vec2 pivot, bool collides, tinygltf::Mesh& mesh) {
    const float z = metres(part.lift_mm);
    std::vector<std::array<float, 3>> points;
    points.reserve(part.points.size());
    for (const Vec2 p : part.points) points.push_back({metres(p.x), metres(p.y), z});
    const std::size_t count = part.points.size();
    tinygltf::Primitive front;
    front.mode = TINYGLTF_MODE_TRIANGLES;
    front.material = collides && !part.drawn ? material(kCollision, kColliding) : material_of(part);
    front.attributes["POSITION"] = positions(points);
    front.attributes["NORMAL"] = normals(kNormals, count);
    if (part.image != nullptr) {
        front.attributes["TEXCOORD_0"] =
            texture_places(*part.image, pixels_at(*part.image, part.points, pivot));
    }
    front.indices = shared_indices(part.indices, count);
    mesh.primitives.push_back(std::move(front));
    if (!part.back || collides) return;
    tinygltf::Primitive back = mesh.primitives.back();
    back.material = material(*part.back, kPaperBack);
    back.attributes["NORMAL"] = normals(kBackNormals, count);
    back.indices = shared_indices(turned_over(part.indices), count);
    mesh.primitives.push_back(std::move(back));
}

// Every normal of a plate's front is (0, 0, 1), of its back (0, 0, -1): parts share one run of them, and
// an accessor with every part of their size.
int GltfMeshes::normals(View view, std::size_t count) {
    Normals& of_view = normals_[view];
    of_view.most = std::max(of_view.most, count);
    const auto [at, is_new] = of_view.accessors.try_emplace(count, 0);
    if (is_new) at->second = add_accessor(view, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, count);
    return at->second;
}

void GltfMeshes::add_normals() {
    for (const auto& [view, of_view] : normals_) {
        const std::vector<std::array<float, 3>> all(of_view.most,
                                                    {0.0F, 0.0F, view == kNormals ? 1.0F : -1.0F});
        views_.at(view).append(std::span<const std::array<float, 3>>(all));
    }
}

int GltfMeshes::face_normals(const std::vector<Vec3>& normals, double sign) {
    std::vector<float> values;
    values.reserve(3 * normals.size());
    for (const Vec3 n : normals) {
        for (const double one : {n.x, n.y, n.z}) values.push_back(static_cast<float>(sign * rounded(one, 9)));
    }
    return add_accessor(kFaceNormals, views_[kFaceNormals].append(std::span<const float>(values)),
                        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, normals.size());
}

void GltfMeshes::add_primitives(const SpaceMesh& part, tinygltf::Mesh& mesh) {
    tinygltf::Primitive front;
    front.mode = TINYGLTF_MODE_TRIANGLES;
    front.material = material_of(part);
    front.attributes["POSITION"] = positions(in_metres(part.points));
    front.attributes["NORMAL"] = face_normals(part.normals, 1.0);
    if (part.image != nullptr) front.attributes["TEXCOORD_0"] = texture_places(*part.image, part.pixels);
    front.indices = add_indices(part.indices, part.points.size());
    mesh.primitives.push_back(std::move(front));
    if (!part.back) return;
    tinygltf::Primitive back = mesh.primitives.back();
    back.material = material(*part.back, kPaperBack);
    back.attributes["NORMAL"] = face_normals(part.normals, -1.0);
    back.indices = add_indices(turned_over(part.indices), part.points.size());
    mesh.primitives.push_back(std::move(back));
}

// Lines between pairs of the points of an accessor; none if there are no pairs.
void GltfMeshes::add_lines(int points, std::size_t count, const std::vector<std::uint32_t>& pairs,
                           int material, tinygltf::Mesh& mesh) {
    if (pairs.empty()) return;
    tinygltf::Primitive lines;
    lines.mode = TINYGLTF_MODE_LINE;
    lines.material = material;
    lines.attributes["POSITION"] = points;
    lines.indices = shared_indices(pairs, count);
    mesh.primitives.push_back(std::move(lines));
}

void GltfMeshes::add_trail(const Trace& trace, tinygltf::Mesh& mesh) {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> pairs;
    for (const std::vector<Vec3>& line : trace.lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            const auto end = static_cast<std::uint32_t>(points.size());
            if (i > 0) pairs.insert(pairs.end(), {end - 1, end});
            points.push_back(line[i]);
        }
    }
    if (pairs.empty()) return;
    add_lines(positions(in_metres(points)), points.size(), pairs, material(kTraceColor, kTrail), mesh);
}

void GltfMeshes::add_plate_edges(const Plate& plate, const std::vector<Segment>& folds_on_it,
                                 tinygltf::Mesh& mesh) {
    const PlateEdges edges = edges_of(plate, folds_on_it);
    std::vector<std::array<float, 3>> points;
    for (const Vec2 p : edges.points)
        points.push_back({metres(p.x - plate.pivot.x), metres(p.y - plate.pivot.y), 0.0F});
    std::vector<std::uint32_t> cuts;
    std::vector<std::uint32_t> folds;
    append(edges.cuts, 0, cuts);
    append(edges.folds, 0, folds);
    add_edges(std::move(points), cuts, folds, mesh);
}

void GltfMeshes::add_standing(const Assembly& assembly, const std::vector<Vec3>& lifts,
                              const std::vector<std::vector<Segment>>& folds_on_plates, const Piece& piece,
                              const std::vector<SpaceMesh>& parts, tinygltf::Mesh& mesh) {
    for (const SpaceMesh& part : parts) add_primitives(part, mesh);
    if (!look_.edge_lines) return;
    std::vector<Vec3> points;
    std::vector<std::uint32_t> cuts;
    std::vector<std::uint32_t> folds;
    for (const int number : piece.plates) {
        const auto i = static_cast<std::size_t>(number);
        const Plate& plate = assembly.plates.at(i);
        if (!plate.stands) continue;
        const PlateEdges edges = edges_of(plate, folds_on_plates[i]);
        const auto first = static_cast<std::uint32_t>(points.size());
        for (const Vec2 p : edges.points) points.push_back(plate.stands->point(p) + lifts[i]);
        append(edges.cuts, first, cuts);
        append(edges.folds, first, folds);
    }
    add_edges(in_metres(points), cuts, folds, mesh);
}

// The edges of plates, which viewers would not draw by themselves.
void GltfMeshes::add_edges(std::vector<std::array<float, 3>> points, const std::vector<std::uint32_t>& cuts,
                           const std::vector<std::uint32_t>& folds, tinygltf::Mesh& mesh) {
    if (points.empty()) return;
    const std::size_t count = points.size();
    const int at = positions(std::move(points));
    add_lines(at, count, cuts, material(kEdgeColor, kEdge), mesh);
    add_lines(at, count, folds, material(kFoldColor, kFold), mesh);
}

// Most plates have four corners: equal short lists of indices share one accessor.
int GltfMeshes::shared_indices(const std::vector<std::uint32_t>& indices, std::size_t points) {
    if (indices.size() > kSharedIndices) return add_indices(indices, points);
    const auto [at, is_new] = indices_.try_emplace(indices, 0);
    if (is_new) at->second = add_indices(indices, points);
    return at->second;
}

int GltfMeshes::add_indices(const std::vector<std::uint32_t>& indices, std::size_t points) {
    const std::size_t count = indices.size();
    // The largest 16-bit number is kept for a restart of primitives.
    if (points < std::numeric_limits<std::uint16_t>::max()) {
        const std::vector<std::uint16_t> small(indices.begin(), indices.end());
        return add_accessor(kShortIndices,
                            views_[kShortIndices].append(std::span<const std::uint16_t>(small)),
                            TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, count);
    }
    return add_accessor(kLongIndices, views_[kLongIndices].append(std::span<const std::uint32_t>(indices)),
                        TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, count);
}

int GltfMeshes::add(const Plate& plate, const Piece& piece, const std::vector<Segment>& folds,
                    const std::string& name, bool collides) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    for (const MeshPart& part : plate_mesh(plate, look_.printed_backs, piece.prints)) {
        add_primitives(part, plate.pivot, collides, mesh);
        if (!part.drawn && look_.edge_lines) add_plate_edges(plate, folds, mesh);
    }
    if (mesh.primitives.empty()) return -1;
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size()) - 1;
}

int GltfMeshes::add_times(const std::vector<float>& seconds) {
    const int accessor = add_accessor(kMotion, views_[kMotion].append(std::span<const float>(seconds)),
                                      TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, seconds.size());
    model_.accessors.back().minValues = {seconds.front()};
    model_.accessors.back().maxValues = {seconds.back()};
    return accessor;
}

int GltfMeshes::add_places(const std::vector<std::array<float, 3>>& places) {
    return add_accessor(kMotion, views_[kMotion].append(std::span<const std::array<float, 3>>(places)),
                        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, places.size());
}

int GltfMeshes::add_turns(const std::vector<std::array<float, 4>>& turns) {
    return add_accessor(kMotion, views_[kMotion].append(std::span<const std::array<float, 4>>(turns)),
                        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, turns.size());
}

// Puts the views one after another; views that nothing uses are left out.
void GltfMeshes::finish() {
    add_normals();
    tinygltf::Buffer buffer;
    std::array<int, kViews> numbers{};
    for (std::size_t i = 0; i < kViews; ++i) {
        if (views_.at(i).bytes().empty()) continue;
        numbers.at(i) = static_cast<int>(model_.bufferViews.size());
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = buffer.data.size();
        view.byteLength = views_.at(i).bytes().size();
        if (i == kPositions || i == kNormals || i == kBackNormals || i == kFaceNormals) {
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

}  // namespace popup
