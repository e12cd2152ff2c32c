#include "output/space_mesh.h"

#include <algorithm>

#include "output/mesh.h"

namespace popup {

std::vector<Vec2> pixels_at(const Image& image, const std::vector<Vec2>& points, Vec2 pivot) {
    const Affine& place = image.place;
    const double scale = 1.0 / cross(place.x, place.y);
    std::vector<Vec2> pixels;
    pixels.reserve(points.size());
    for (const Vec2 p : points) {
        const Vec2 from = p + pivot - place.origin;
        pixels.push_back({scale * cross(from, place.y), scale * cross(place.x, from)});
    }
    return pixels;
}

std::vector<SpaceMesh> standing_meshes(const Assembly& assembly, const Piece& piece) {
    std::vector<SpaceMesh> meshes;
    for (const int number : piece.plates) {
        const Plate& plate = assembly.plates.at(static_cast<std::size_t>(number));
        if (!plate.stands) continue;
        for (const MeshPart& part : plate_mesh(plate, piece.prints)) {
            auto mesh = std::find_if(meshes.begin(), meshes.end(), [&part](const SpaceMesh& one) {
                return one.color == part.color && one.drawn == part.drawn && one.lift_mm == part.lift_mm &&
                       one.image == part.image;
            });
            if (mesh == meshes.end()) {
                mesh =
                    meshes.insert(mesh, {part.color, part.image, part.drawn, part.lift_mm, {}, {}, {}, {}});
            }
            const auto first = static_cast<std::uint32_t>(mesh->points.size());
            const Vec3 lift = part.drawn ? part.lift_mm * plate.stands->normal() : Vec3{};
            if (part.image != nullptr) {
                const std::vector<Vec2> pixels = pixels_at(*part.image, part.points, plate.pivot);
                mesh->pixels.insert(mesh->pixels.end(), pixels.begin(), pixels.end());
            }
            for (const Vec2 p : part.points) {
                mesh->points.push_back(plate.stands->point(p + plate.pivot) + lift);
                mesh->normals.push_back(plate.stands->normal());
            }
            for (const std::uint32_t index : part.indices) mesh->indices.push_back(first + index);
        }
    }
    return meshes;
}

SpaceMesh mesh_of(const std::vector<std::vector<Vec3>>& lines, Color color) {
    SpaceMesh mesh;
    mesh.color = color;
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

}  // namespace popup
