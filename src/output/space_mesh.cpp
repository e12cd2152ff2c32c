#include "output/space_mesh.h"

#include <algorithm>
#include <utility>

#include "output/layer_levels.h"
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

std::vector<Vec3> layer_lifts(const Assembly& assembly) {
    const std::size_t count = assembly.plates.size();
    std::vector<Vec3> lifts(count);
    if (assembly.layers.empty()) return lifts;
    const auto normal_of = [&](int plate) {
        return assembly.plates[static_cast<std::size_t>(plate)].stands->normal();
    };
    const Vec3 up = normal_of(assembly.layers.front().base);
    std::vector<std::pair<int, int>> over;
    over.reserve(assembly.layers.size());
    for (const PlateOrder& order : assembly.layers) {
        over.emplace_back(order.base, order.plate);
        if (order.on_front != (dot(normal_of(order.base), up) > 0.0))
            std::swap(over.back().first, over.back().second);
    }
    const std::vector<int> levels = layer_levels(count, over);
    for (std::size_t i = 0; i < count; ++i) lifts[i] = static_cast<double>(levels[i]) * kLayerMm * up;
    return lifts;
}

std::vector<SpaceMesh> standing_meshes(const Assembly& assembly, const std::vector<Vec3>& lifts,
                                       const Piece& piece, bool printed_backs) {
    std::vector<SpaceMesh> meshes;
    for (const int number : piece.plates) {
        const Plate& plate = assembly.plates.at(static_cast<std::size_t>(number));
        if (!plate.stands) continue;
        for (const MeshPart& part : plate_mesh(plate, printed_backs, piece.prints)) {
            auto mesh = std::find_if(meshes.begin(), meshes.end(), [&part](const SpaceMesh& one) {
                return one.color == part.color && one.back == part.back && one.drawn == part.drawn &&
                       one.lift_mm == part.lift_mm && one.image == part.image;
            });
            if (mesh == meshes.end()) {
                mesh = meshes.insert(
                    mesh, {part.color, part.back, part.image, part.drawn, part.lift_mm, {}, {}, {}, {}});
            }
            const auto first = static_cast<std::uint32_t>(mesh->points.size());
            Vec3 lift = lifts[static_cast<std::size_t>(number)];
            if (part.drawn) lift = lift + part.lift_mm * plate.stands->normal();
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

}  // namespace popup
