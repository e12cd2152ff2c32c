// What stands still, as meshes of points of space.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// How far apart models show plates that lie on one another: a sheet of paper.
inline constexpr double kLayerMm = 0.1;

// Triangles of one material, as points of space.
struct SpaceMesh {
    Color color;
    std::optional<Color> back;  // as of MeshPart
    const Image* image = nullptr;
    bool drawn = false;
    double lift_mm = 0.0;
    std::vector<Vec3> points;   // mm
    std::vector<Vec3> normals;  // of the points
    std::vector<Vec2> pixels;   // of a picture, at the points
    std::vector<std::uint32_t> indices;
};

// Where points of a plate, given from its pivot, lie in a picture: in pixels, from its upper left corner.
std::vector<Vec2> pixels_at(const Image& image, const std::vector<Vec2>& points, Vec2 pivot);

// By plate: how far models move it, so that plates that lie on one another can be told apart. Each layer is
// kLayerMm above the one below it. Where layers lie on one another in a circle, as the flaps of a box can,
// one of them counts as the lowest. Cost: linear in plates and layers.
std::vector<Vec3> layer_lifts(const Assembly& assembly);

// What of a piece stands, one mesh a material. `lifts` by plate; `printed_backs` as of plate_mesh().
std::vector<SpaceMesh> standing_meshes(const Assembly& assembly, const std::vector<Vec3>& lifts,
                                       const Piece& piece, bool printed_backs);

}  // namespace popup
