// Meshes, materials and pictures of a glTF model, and the numbers that they and its motions are made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/gltf_values.h"
#include "output/mesh.h"
#include "output/space_mesh.h"
#include "popup/assembly.h"

namespace tinygltf {
class Model;
struct Mesh;
}  // namespace tinygltf

namespace popup {

// How models are shown, as OutputOptions have it.
struct GltfLook {
    bool printed_backs = false;
    bool edge_lines = true;
};

// Fills a model. finish() ends it: until then its accessors name views that are not there yet.
//
//     GltfMeshes meshes(model, look);
//     node.mesh = meshes.add(plate, piece, folds, "roof", false);
//     sampler.input = meshes.add_times(times);
//     meshes.finish();
//
// Paper whose back has another colour is two primitives, each seen from its side. Prints are seen from the
// front alone. Cut edges and folds are lines of the materials `edge` and `fold`, from corner to corner.
class GltfMeshes {
 public:
    GltfMeshes(tinygltf::Model& model, const GltfLook& look) : model_(model), look_(look) {}

    // The number of the plate's mesh, with its pivot for origin; -1: it has no triangles. `folds` are the
    // lines of folds_of_plates(). The paper of one that collides is of the material `collision`.
    int add(const Plate& plate, const Piece& piece, const std::vector<Segment>& folds,
            const std::string& name, bool collides);
    // The same of the plates of a piece that stand, in space; `parts` of standing_meshes(), `lifts` and
    // `folds` by plate.
    void add_standing(const Assembly& assembly, const std::vector<Vec3>& lifts,
                      const std::vector<std::vector<Segment>>& folds, const Piece& piece,
                      const std::vector<SpaceMesh>& parts, tinygltf::Mesh& mesh);
    // The lines of a trace, as primitives of the mesh: black, of the material `trail`.
    void add_trail(const Trace& trace, tinygltf::Mesh& mesh);

    // The number of an accessor with the numbers of a motion: times, places, and turns as x, y, z, w.
    int add_times(const std::vector<float>& seconds);
    int add_places(const std::vector<std::array<float, 3>>& places);
    int add_turns(const std::vector<std::array<float, 4>>& turns);

    // Puts all numbers into the model's buffer, after which nothing may be added.
    void finish();

 private:
    enum Surface {
        kPaper,
        kPaperFront,
        kPaperBack,
        kDrawn,
        kColliding,
        kTrail,
        kEdge,
        kFold,
        kPainted,
        kWritten
    };
    enum View : std::size_t {
        kPositions,
        kNormals,
        kBackNormals,
        kFaceNormals,
        kTexturePlaces,
        kShortIndices,
        kLongIndices,
        kMotion,
        kViews
    };
    struct Normals {
        std::map<std::size_t, int> accessors;  // by how many
        std::size_t most = 0;
    };
    using Indices = std::vector<std::uint32_t>;
    using Points = std::vector<std::array<float, 3>>;

    static std::string name_of(Surface surface, Color color);
    static bool is_seen_from_one_side(Surface surface);
    int add_accessor(View view, std::size_t offset, int component, int type, std::size_t count);
    int material(Color color, Surface surface);
    int material(const Image& image);
    template <typename Part>
    int material_of(const Part& part);
    int texture_places(const Image& image, const std::vector<Vec2>& pixels);
    int positions(Points points);
    int normals(View view, std::size_t count);
    void add_normals();
    int face_normals(const std::vector<Vec3>& normals, double sign);
    int shared_indices(const Indices& indices, std::size_t points);
    int add_indices(const Indices& indices, std::size_t points);
    void add_primitives(const MeshPart& part, Vec2 pivot, bool collides, tinygltf::Mesh& mesh);
    void add_primitives(const SpaceMesh& part, tinygltf::Mesh& mesh);
    void add_lines(int points, std::size_t count, const Indices& pairs, int material, tinygltf::Mesh& mesh);
    void add_edges(Points points, const Indices& cuts, const Indices& folds, tinygltf::Mesh& mesh);
    void add_plate_edges(const Plate& plate, const std::vector<Segment>& folds_on_it, tinygltf::Mesh& mesh);

    tinygltf::Model& model_;
    GltfLook look_;
    std::array<BufferBytes, kViews> views_;
    std::map<std::array<int, 4>, int> materials_;
    std::map<std::string_view, int> pictures_;  // the materials of files, whose bytes picture_files_ keeps
    std::vector<std::shared_ptr<const std::string>> picture_files_;
    std::map<View, Normals> normals_;
    Points last_points_;
    int last_positions_ = -1;
    std::map<Indices, int> indices_;
};

}  // namespace popup
