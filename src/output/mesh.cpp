#include "output/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <polyclipping/clipper.hpp>
#include <utility>

#include "base/diagnostics/render_diagnostics.h"
#include "base/geometry/ears.h"
#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "output/later_covers.h"
#include "output/text_outlines.h"
#include "popup/image.h"

namespace popup {
namespace {

constexpr Color kBarePaper{};               // white
constexpr std::size_t kMostCrossings = 50;  // a line, on average

using Region = std::vector<Polygon>;

// All within `radius` of a straight line, but for the chords of its ends.
Polygon widened(Vec2 a, Vec2 b, double radius) {
    const double reach = std::max(kCurveMm / radius, 1e-9);
    const double step = reach < 1.0 ? std::acos(1.0 - reach) : 0.5 * std::numbers::pi;
    const int count = std::max(2, static_cast<int>(std::ceil(0.5 * std::numbers::pi / step)));
    const Vec2 along = (radius / distance(a, b)) * (b - a);
    const Vec2 left{-along.y, along.x};
    Polygon polygon;
    for (const bool at_end : {true, false}) {
        const double way = at_end ? 1.0 : -1.0;
        for (int i = 0; i <= count; ++i) {
            const double turn = std::numbers::pi * i / count;
            polygon.outer.push_back((at_end ? b : a) +
                                    way * (std::sin(turn) * along - std::cos(turn) * left));
        }
    }
    return polygon;
}

// All within half the width of the line.
Region widened(const Stroke& stroke) {
    if (stroke.points.size() == 2 && distance(stroke.points[0], stroke.points[1]) > kGridMm)
        return {widened(stroke.points[0], stroke.points[1], 0.5 * stroke.width_mm)};
    ClipperLib::Path path;
    for (const Vec2 p : stroke.points)
        path.emplace_back(std::llround(p.x * kPerMm), std::llround(p.y * kPerMm));
    ClipperLib::ClipperOffset offset(2.0, kCurveMm * kPerMm);
    offset.AddPath(path, ClipperLib::jtRound, ClipperLib::etOpenRound);
    ClipperLib::Paths rings;
    offset.Execute(rings, 0.5 * stroke.width_mm * kPerMm);
    // A line that closes gives an outer ring and holes; which is whose, a union of both kinds sorts out.
    Region outers;
    Region holes;
    for (const ClipperLib::Path& ring : rings) {
        Polygon polygon;
        for (const auto& p : ring) {
            polygon.outer.push_back({static_cast<double>(p.X) / kPerMm, static_cast<double>(p.Y) / kPerMm});
        }
        (ClipperLib::Orientation(ring) ? outers : holes).push_back(std::move(polygon));
    }
    return holes.empty() ? outers : subtract(outers, holes);
}

Box box_of(const Region& region) {
    Box box;
    for (const Polygon& polygon : region) {
        for (const Vec2 p : polygon.outer) box.extend(p);
    }
    return box;
}

struct DrawnShape {
    Color color;
    Region region;
    Box box;
};

// The later lines of other colours that come near each line; empty lists when there are too many to look at.
std::vector<std::vector<int>> later_neighbours(const std::vector<DrawnShape>& shapes) {
    std::vector<Segment> diagonals;
    diagonals.reserve(shapes.size());
    for (const DrawnShape& shape : shapes) diagonals.push_back({shape.box.min, shape.box.max});
    const EdgeIndex index(std::move(diagonals));
    std::vector<std::vector<int>> result(shapes.size());
    std::vector<int> found;
    std::size_t total = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        index.query(shapes[i].box, found);
        total += found.size();
        if (total > kMostCrossings * shapes.size() + kMostCrossings)
            return std::vector<std::vector<int>>(shapes.size());
        for (const int other : found) {
            const auto j = static_cast<std::size_t>(other);
            if (j > i && !(shapes[j].color == shapes[i].color)) result[i].push_back(other);
        }
    }
    return result;
}

// All of the region, where parts of it may overlap.
Region united(Region region) {
    std::vector<Segment> diagonals;
    diagonals.reserve(region.size());
    for (const Polygon& polygon : region) {
        const Box box = bounds(polygon.outer);
        diagonals.push_back({box.min, box.max});
    }
    const EdgeIndex index(std::move(diagonals));
    Region alone;
    Region near;
    std::vector<int> found;
    for (std::size_t i = 0; i < region.size(); ++i) {
        const Segment& diagonal = index[static_cast<int>(i)];
        index.query({diagonal.a, diagonal.b}, found);
        (found.size() > 1 ? near : alone).push_back(std::move(region[i]));
    }
    if (near.empty()) return alone;
    for (Polygon& polygon : unite(near)) alone.push_back(std::move(polygon));
    return alone;
}

struct ColorGroup {
    Color color;
    Region inside, at_edge;
};

std::vector<ColorGroup> drawn_groups(const Plate& plate) {
    std::vector<DrawnShape> shapes;
    for (const Print& print : plate.prints) {
        const Stroke* stroke = std::get_if<Stroke>(&print);
        if (stroke == nullptr || !(stroke->width_mm > 0.0)) continue;
        Region region = widened(*stroke);
        if (region.empty()) continue;
        const Box box = box_of(region);
        shapes.push_back({stroke->color, std::move(region), box});
    }
    if (shapes.empty()) return {};
    const EdgeIndex outline(edges_of(plate.outline));
    const auto over = later_neighbours(shapes);
    std::vector<ColorGroup> groups;
    std::vector<int> found;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const DrawnShape& shape = shapes[i];
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const ColorGroup& g) { return g.color == shape.color; });
        if (group == groups.end()) group = groups.insert(groups.end(), {shape.color, {}, {}});
        Region covering;
        for (const int j : over[i]) {
            const Region& other = shapes[static_cast<std::size_t>(j)].region;
            covering.insert(covering.end(), other.begin(), other.end());
        }
        outline.query(shape.box, found);
        Region& target = found.empty() ? group->inside : group->at_edge;
        for (Polygon& polygon : covering.empty() ? Region(shape.region) : subtract(shape.region, covering)) {
            target.push_back(std::move(polygon));
        }
    }
    return groups;
}

void append(const Polygon& polygon, Vec2 pivot, MeshPart& part) {
    const Triangulation triangles = quick_triangles(polygon);
    const auto first = static_cast<std::uint32_t>(part.points.size());
    for (const Vec2 p : triangles.points) part.points.push_back(p - pivot);
    for (const auto& triangle : triangles.triangles) {
        for (const std::uint32_t corner : triangle) part.indices.push_back(first + corner);
    }
}

// Areas and pictures that lie on the plate, whole, and where.
struct Painted {
    std::vector<MeshPart> parts;
    std::vector<Region> regions;
    std::vector<PaintedBox> boxes;
};

Painted painted_on(const Plate& plate) {
    Painted painted;
    for (const Print& print : plate.prints) {
        MeshPart part;
        part.drawn = true;
        part.lift_mm = kPaintedLiftMm;
        Region region;
        if (const Area* area = std::get_if<Area>(&print)) {
            part.color = area->color;
            region = intersect({area->shape}, {plate.outline});
        } else if (const Image* image = std::get_if<Image>(&print)) {
            part.image = image;
            if (may_be_transparent(*image)) part.lift_mm = kClearLiftMm;
            region = intersect(shown_regions(*image), {plate.outline});
        }
        if (region.empty()) continue;
        painted.boxes.push_back({box_of(region), part.lift_mm == kPaintedLiftMm});
        painted.parts.push_back(std::move(part));
        painted.regions.push_back(std::move(region));
    }
    return painted;
}

// Areas and pictures, each without what later ones cover.
std::vector<MeshPart> painted_parts(const Plate& plate) {
    Painted painted = painted_on(plate);
    const std::vector<std::vector<int>> over = later_covers(painted.boxes);
    for (std::size_t i = 0; i < painted.parts.size(); ++i) {
        Region covering;
        for (const int j : over[i]) {
            const Region& other = painted.regions[static_cast<std::size_t>(j)];
            covering.insert(covering.end(), other.begin(), other.end());
        }
        const Region seen =
            covering.empty() ? std::move(painted.regions[i]) : subtract(painted.regions[i], covering);
        for (const Polygon& polygon : seen) append(polygon, plate.pivot, painted.parts[i]);
    }
    std::erase_if(painted.parts, [](const MeshPart& part) { return part.indices.empty(); });
    return std::move(painted.parts);
}

// The letters of a text that lie on the plate.
std::optional<MeshPart> written_part(const Text& text, const Plate& plate) {
    // No letter is wider than two capitals are high.
    const double reach = text.height_mm * (2.0 + 2.0 * static_cast<double>(text.text.size()));
    const Box box = bounds(plate.outline.outer);
    if (text.at.x + reach < box.min.x || text.at.x - reach > box.max.x || text.at.y + reach < box.min.y ||
        text.at.y - reach > box.max.y)
        return std::nullopt;
    MeshPart part;
    part.color = *text.color;
    part.drawn = true;
    part.lift_mm = kWrittenLiftMm;
    const std::string written = visible(text.text);
    const Region letters =
        filled(text_outlines(written, text.at, text.height_mm, text.angle, text.font), FillRule::non_zero);
    for (const Polygon& polygon : intersect(letters, {plate.outline})) append(polygon, plate.pivot, part);
    if (part.indices.empty()) return std::nullopt;
    return part;
}

}  // namespace

std::vector<MeshPart> plate_mesh(const Plate& plate, bool printed_backs, std::span<const Print> of_piece) {
    std::vector<MeshPart> parts;
    MeshPart paper;
    if (plate.fill) paper.color = *plate.fill;
    if (!printed_backs && !(paper.color == kBarePaper)) paper.back = kBarePaper;
    append(plate.outline, plate.pivot, paper);
    if (!paper.indices.empty()) parts.push_back(std::move(paper));

    for (MeshPart& part : painted_parts(plate)) parts.push_back(std::move(part));

    for (ColorGroup& group : drawn_groups(plate)) {
        MeshPart part;
        part.color = group.color;
        part.drawn = true;
        part.lift_mm = kDrawnLiftMm;
        Region region = std::move(group.inside);
        if (!group.at_edge.empty()) {
            for (Polygon& polygon : intersect(group.at_edge, {plate.outline})) {
                region.push_back(std::move(polygon));
            }
        }
        for (const Polygon& polygon : united(std::move(region))) append(polygon, plate.pivot, part);
        if (!part.indices.empty()) parts.push_back(std::move(part));
    }
    for (const std::span<const Print> prints : {std::span<const Print>(plate.prints), of_piece}) {
        for (const Print& print : prints) {
            const Text* text = std::get_if<Text>(&print);
            if (text == nullptr || !text->color) continue;
            if (auto part = written_part(*text, plate)) parts.push_back(std::move(*part));
        }
    }
    return parts;
}

}  // namespace popup
