#include "layout/pack.h"

#include "base/hull.h"
#include "layout/boxes.h"
#include "layout/turns.h"

namespace popup {

Shape make_shape(const std::vector<Polygon>& outline) {
    std::vector<Vec2> points;
    for (const Polygon& part : outline) points.insert(points.end(), part.outer.begin(), part.outer.end());
    return {&outline, convex_hull(std::move(points))};
}

bool fits(const Shape& shape, const SheetArea& area, Rotation rotation) {
    return !poses_in(shape.hull, area, rotation).empty();
}

// Boxes only, for now: each shape takes the box of its best turn, widened by the spacing, on a sheet widened
// alike.
std::optional<std::vector<Spot>> pack(std::span<const Shape> shapes, std::span<const int> items,
                                      const SheetArea& area, const PackRules& rules) {
    const GridLength spacing = to_grid(rules.spacing);
    std::vector<std::vector<Pose>> poses;
    poses.reserve(shapes.size());
    for (const Shape& shape : shapes) {
        poses.push_back(poses_in(shape.hull, area, rules.rotation));
        if (poses.back().empty()) return std::nullopt;
    }
    std::vector<BoxItem> boxes;
    boxes.reserve(items.size());
    for (const int item : items) {
        const std::vector<Pose>& ways = poses[static_cast<std::size_t>(item)];
        BoxItem box;
        box.count = static_cast<int>(ways.size());
        for (std::size_t i = 0; i < ways.size(); ++i) {
            box.ways[i] = {ways[i].width + spacing, ways[i].height + spacing};
        }
        boxes.push_back(box);
    }
    const auto places = place_boxes(boxes, {to_grid(area.width) + spacing, to_grid(area.height) + spacing});
    std::vector<Spot> spots;
    spots.reserve(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const BoxSpot& place = places[i];
        const Pose& pose = poses[static_cast<std::size_t>(items[i])][static_cast<std::size_t>(place.way)];
        spots.push_back(
            {place.sheet, {from_grid(place.x - pose.x), from_grid(place.y - pose.y)}, pose.angle});
    }
    return spots;
}

}  // namespace popup
