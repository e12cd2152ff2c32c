#include "nest/shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/geometry/regions.h"
#include "base/nth.h"
#include "nest/coarser.h"
#include "nest/inside.h"
#include "nest/partition.h"

namespace popup {
namespace {

// Shapes of more parts than this are made coarser: the cost of a look at two shapes is the product of their
// parts.
constexpr std::size_t kFewParts = 6;
// Where holes add more parts than this to a shape the smallest are filled: of a tracing with hundreds of
// specks in it a look at two would take gigabytes.
constexpr std::size_t kMostParts = 400;
// What coarser shapes may gain: a share of their area, and no corner further out than a share of their size.
constexpr double kMostGain = 1e-3;
constexpr double kFurthest = 2e-3;
// An outline of more corners is enclosed by one of few, for all that follows. What that may gain, of the
// above, and what it may gain while more corners are left than can be proved: spirals and combs have much
// edge for their area.
constexpr std::size_t kManyCorners = 2000;
constexpr double kEnclosingShare = 0.25;
constexpr double kShareOfMany = 4.0;
// Steps by which an outline is widened of which nothing could be proved.
constexpr GridLength kWidening = 4;

GridRegion on_grid(const Polygon& polygon) {
    GridRegion region{turned_ring(polygon.outer, {}), {}};
    for (const Ring& hole : polygon.holes) {
        GridRing ring = turned_ring(hole, {});
        if (ring.size() >= 3) region.holes.push_back(std::move(ring));
    }
    return region;
}

std::vector<Polygon> polygons_of(const std::vector<GridRegion>& regions) {
    std::vector<Polygon> polygons;
    for (const GridRegion& region : regions) {
        Polygon polygon{in_mm(region.outer), {}};
        for (const GridRing& hole : region.holes) polygon.holes.push_back(in_mm(hole));
        polygons.push_back(std::move(polygon));
    }
    return polygons;
}

std::vector<GridRegion> regions_of(const std::vector<Polygon>& polygons) {
    std::vector<GridRegion> regions;
    for (const Polygon& polygon : polygons) {
        GridRegion region = on_grid(polygon);
        if (region.outer.size() >= 3) regions.push_back(std::move(region));
    }
    return regions;
}

std::vector<GridRegion> without_holes(std::vector<GridRegion> regions) {
    for (GridRegion& region : regions) region.holes.clear();
    return regions;
}

double twice_area(const GridRing& ring) {
    Wide sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) sum += cross(ring[i], ring[(i + 1) % ring.size()]);
    return static_cast<double>(sum);
}

// The outline as regions that can be proved to be made up of `parts`; nullopt when none were found.
std::optional<std::vector<GridRegion>> provable(const TurnedShape& shape, bool use_holes,
                                                std::vector<GridRing>& parts) {
    std::vector<GridRegion> regions = use_holes ? shape.outline : without_holes(shape.outline);
    if (regions.size() > 1) regions = regions_of(unite(polygons_of(regions)));
    for (const bool again : {false, true}) {
        if (again) regions = regions_of(unite(polygons_of(regions)));
        if (!use_holes) regions = without_holes(std::move(regions));
        if (auto proved = partition(regions)) {
            parts = std::move(*proved);
            return regions;
        }
    }
    return std::nullopt;
}

// The convex parts of a region, and of one with many holes those of the region without the smallest, which it
// then is.
std::vector<GridRing> parts_with_largest_holes(GridRegion& region) {
    std::vector<GridRing> parts = convex_parts(region);
    if (parts.size() <= kMostParts || region.holes.empty()) return parts;
    // What the outer ring takes no hole can spare.
    const std::size_t most = kMostParts + convex_parts({region.outer, {}}).size();
    // Holes run clockwise.
    std::stable_sort(region.holes.begin(), region.holes.end(),
                     [](const GridRing& a, const GridRing& b) { return twice_area(a) < twice_area(b); });
    while (parts.size() > most && !region.holes.empty()) {
        region.holes.resize(region.holes.size() / 2);
        parts = convex_parts(region);
    }
    return parts;
}

// The regions' parts for the search: few. False when they had to grow for that.
bool rough_parts(std::vector<GridRegion> regions, double size, std::vector<GridRing>& result) {
    bool same = true;
    for (GridRegion& region : regions) {
        const std::size_t holes = region.holes.size();
        std::vector<GridRing> parts = parts_with_largest_holes(region);
        same = same && holes == region.holes.size();
        if (parts.size() > kFewParts) {
            double twice = twice_area(region.outer);
            for (const GridRing& hole : region.holes) twice += twice_area(hole);
            // What grew over itself cannot be taken apart, and is not taken.
            auto fewer = partition({coarser(region, {0.5 * kMostGain * twice, kFurthest * size})});
            if (fewer && fewer->size() < parts.size()) {
                parts = std::move(*fewer);
                same = false;
            }
        }
        result.insert(result.end(), parts.begin(), parts.end());
    }
    return same;
}

std::size_t corners_of(const GridRegion& region) {
    std::size_t corners = region.outer.size();
    for (const GridRing& hole : region.holes) corners += hole.size();
    return corners;
}

// A region with few corners that is proved to hold the outline of very many; nullopt when the outline has
// few, or several regions, or there is no proof. Bays that nothing gets into are filled: between two corners
// that are g apart, another piece comes nearer to the outline by g² / 8 spacing than to the line between
// them.
std::optional<GridRegion> enclosing(const std::vector<GridRegion>& outline, double size, double spacing) {
    if (outline.size() != 1 || corners_of(outline[0]) <= kManyCorners) return std::nullopt;
    const GridRegion& fine = outline[0];
    double twice = twice_area(fine.outer);
    for (const GridRing& hole : fine.holes) twice += twice_area(hole);
    Coarsening how;
    const double gain = 0.5 * kMostGain * twice;
    how.most_added = kEnclosingShare * gain;
    how.furthest = kFurthest * size;
    how.encloses = true;
    how.most_added_of_many = kShareOfMany * gain;
    how.many = kMostUncutCorners;
    how.narrow = std::max(how.furthest, std::min(spacing, std::sqrt(8.0 * spacing * how.furthest)));
    GridRegion coarse = coarser(fine, how);
    if (!is_inside(fine, coarse)) return std::nullopt;
    return coarse;
}

// The direction of (dx, dy) as a number from 0 to 4: exact for the four quarters, and in order between them.
double direction_of(double dx, double dy) {
    const double part = dy / (std::abs(dx) + std::abs(dy));
    if (dx < 0.0) return 2.0 - part;
    return dy < 0.0 ? 4.0 + part : part;
}

int eighth_of(double dx, double dy) {
    if (dy == 0.0) return dx > 0.0 ? 0 : 4;
    if (dx == 0.0) return dy > 0.0 ? 2 : 6;
    return dy > 0.0 ? (dx > 0.0 ? 1 : 3) : (dx < 0.0 ? 5 : 7);
}

RingEdges edges_of(const GridRing& part, double sign) {
    RingEdges ring{{}, {}, HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    ring.edges.reserve(part.size());
    for (std::size_t i = 0; i < part.size(); ++i) {
        const GridPoint p = part[i];
        const GridPoint along = part[(i + 1) % part.size()] - p;
        const double dx = sign * static_cast<double>(along.x);
        const double dy = sign * static_cast<double>(along.y);
        const bool slanted = along.x != 0 && along.y != 0;
        const double length = slanted ? std::sqrt(dx * dx + dy * dy) : std::abs(dx) + std::abs(dy);
        const double x = sign * static_cast<double>(p.x);
        const double y = sign * static_cast<double>(p.y);
        const int eighth = eighth_of(dx, dy);
        ring.edges.push_back({x, y, dy / length, -dx / length, direction_of(dx, dy), slanted, eighth});
        ++nth(ring.counts, eighth);
        ring.x0 = std::min(ring.x0, x);
        ring.y0 = std::min(ring.y0, y);
        ring.x1 = std::max(ring.x1, x);
        ring.y1 = std::max(ring.y1, y);
    }
    std::stable_sort(ring.edges.begin(), ring.edges.end(),
                     [](const PartEdge& a, const PartEdge& b) { return a.direction < b.direction; });
    return ring;
}

}  // namespace

std::vector<GridRegion> turned_outline(const std::vector<Polygon>& outline, Angle angle) {
    std::vector<GridRegion> result;
    for (const Polygon& polygon : outline) {
        GridRegion region{turned_ring(polygon.outer, angle), {}};
        if (region.outer.size() < 3) continue;
        for (const Ring& hole : polygon.holes) {
            GridRing ring = turned_ring(hole, angle);
            if (ring.size() >= 3) region.holes.push_back(std::move(ring));
        }
        result.push_back(std::move(region));
    }
    return result;
}

namespace {

// The outline without the holes into which no piece of the job can go: none has a box that is smaller.
std::vector<GridRegion> without_useless_holes(std::vector<GridRegion> outline,
                                              const std::vector<TurnedShape>& all) {
    for (GridRegion& region : outline) {
        std::erase_if(region.holes, [&](const GridRing& hole) {
            GridBox box;
            for (const GridPoint p : hole) box.extend(p);
            return std::none_of(all.begin(), all.end(), [&](const TurnedShape& shape) {
                return shape.bounds.width() <= box.width() && shape.bounds.height() <= box.height();
            });
        });
    }
    return outline;
}

// What stands for an outline of very many corners in the search.
struct Enclosure {
    std::vector<GridRegion> outline;
    GridRegion region;
    GridRegion useful;            // the region without useless holes
    std::vector<GridRing> parts;  // that make up the region
    std::vector<GridRing> rough;  // that cover `useful`, and are few
};

std::optional<Enclosure> enclosure_of(const std::vector<GridRegion>& outline, double size, double spacing,
                                      const std::vector<TurnedShape>& all) {
    const auto region = enclosing(outline, size, spacing);
    auto parts = region ? partition({*region}) : std::nullopt;
    if (!parts) return std::nullopt;
    const std::vector<GridRegion> useful = without_useless_holes({*region}, all);
    Enclosure made{outline, *region, useful[0], std::move(*parts), {}};
    rough_parts(useful, size, made.rough);
    return made;
}

// Turned a quarter, counter-clockwise.
GridRing quarter(GridRing ring) {
    for (GridPoint& p : ring) p = {-p.y, p.x};
    return ring;
}

std::vector<GridRing> quarter(std::vector<GridRing> rings) {
    for (GridRing& ring : rings) ring = quarter(std::move(ring));
    return rings;
}

GridRegion quarter(GridRegion region) {
    return {quarter(std::move(region.outer)), quarter(std::move(region.holes))};
}

// The enclosure turned by quarters until it is one of the outline; nullopt when none is, or other holes are
// useless to what has been turned. It costs far less than to make one.
std::optional<Enclosure> turned_to(Enclosure made, const std::vector<GridRegion>& outline,
                                   const std::vector<TurnedShape>& all) {
    for (int turns = 0; turns < 4; ++turns) {
        if (made.outline == outline) {
            if (without_useless_holes({made.region}, all) != std::vector{made.useful}) return std::nullopt;
            return made;
        }
        for (GridRegion& region : made.outline) region = quarter(std::move(region));
        made.region = quarter(std::move(made.region));
        made.useful = quarter(std::move(made.useful));
        made.parts = quarter(std::move(made.parts));
        made.rough = quarter(std::move(made.rough));
    }
    return std::nullopt;
}

}  // namespace

ShapeSet make_shapes(const NestJob& job) {
    ShapeSet set;
    const GridLength spacing = to_grid(job.spacing);
    set.exact = spacing == 0;
    for (std::size_t k = 0; k < job.kinds.size(); ++k) {
        const NestKind& kind = job.kinds[k];
        set.areas.push_back(area(kind.outline));
        std::vector<int>& own = set.of_kind.emplace_back();
        for (const Angle angle : kind.turns) {
            TurnedShape shape;
            shape.kind = static_cast<int>(k);
            shape.angle = angle;
            shape.outline = turned_outline(kind.outline, angle);
            for (const GridRegion& region : shape.outline) {
                for (const GridPoint p : region.outer) shape.bounds.extend(p);
            }
            own.push_back(static_cast<int>(set.shapes.size()));
            set.shapes.push_back(std::move(shape));
        }
    }
    std::optional<Enclosure> last;  // of an earlier turn of the kind: most are by quarters
    int last_kind = -1;
    for (TurnedShape& shape : set.shapes) {
        const double size = static_cast<double>(std::max(shape.bounds.width(), shape.bounds.height()));
        const std::vector<GridRegion> solid = job.use_holes ? shape.outline : without_holes(shape.outline);
        if (shape.kind != std::exchange(last_kind, shape.kind)) last.reset();
        auto enclosure = last ? turned_to(*last, solid, set.shapes) : std::nullopt;
        if (!enclosure) enclosure = enclosure_of(solid, size, static_cast<double>(spacing), set.shapes);
        if (enclosure) {
            shape.exact = enclosure->parts;
            shape.parts = enclosure->rough;
            set.exact = false;
            last = std::move(enclosure);
        } else if (const auto proved = provable(shape, job.use_holes, shape.exact)) {
            if (!rough_parts(without_useless_holes(*proved, set.shapes), size, shape.parts))
                set.exact = false;
        } else {
            std::vector<GridRegion> regions = regions_of(unite(polygons_of(shape.outline)));
            if (!job.use_holes) regions = without_holes(std::move(regions));
            for (const GridRegion& region : regions) {
                for (const GridRing& part : convex_parts(region))
                    shape.exact.push_back(widened(part, kWidening));
            }
            std::vector<GridRing> rough;
            rough_parts(without_useless_holes(std::move(regions), set.shapes), size, rough);
            for (const GridRing& part : rough) shape.parts.push_back(widened(part, kWidening));
            set.exact = false;
        }
        for (GridRing& part : shape.parts) part = widened(part, (spacing + 1) / 2);
        for (const GridRing& part : shape.parts) {
            for (const GridPoint p : part) shape.reach.extend(p);
            shape.edges.push_back({edges_of(part, 1.0), edges_of(part, -1.0)});
        }
    }
    return set;
}

}  // namespace popup
