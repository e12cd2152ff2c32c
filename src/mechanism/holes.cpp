#include "mechanism/holes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/geometry/regions.h"
#include "mechanism/drawn_lines.h"
#include "mechanism/site_lines.h"
#include "mechanism/thin_places.h"

namespace popup {
namespace {

// Corners this near to the centre fold lie on it.
constexpr double kOnFoldMm = 1e-3;
// What is left of the centre fold, before, between and behind holes.
constexpr double kLeastFoldMm = 1.0;

struct HoleFault {
    std::string what, hint;
};

// All holes, as areas that do not overlap.
std::vector<Polygon> drawn_holes(const Element& e) {
    std::vector<Polygon> inside;
    for (const Polygon& area : areas_of(e, "outline")) {
        for (const Ring& hole : area.holes) inside.push_back({{hole.rbegin(), hole.rend()}, {}});
    }
    const std::span<const Polygon> given = areas_of(e, "hole");
    if (inside.empty()) return {given.begin(), given.end()};
    if (given.empty()) return inside;
    inside.insert(inside.end(), given.begin(), given.end());
    return unite(inside);
}

std::string hole_at(const Polygon& hole) { return "its hole at " + at_mm(hole.outer.front()); }

std::optional<HoleFault> divide_hole(const Polygon& hole, const Segment& centre, PieceHoles& made) {
    if (!hole.holes.empty()) {
        return HoleFault{hole_at(hole) + " has an island, which would fall out",
                         "draw holes beside one another, or join the island to the piece"};
    }
    const DirectedLine fold{centre.a, unit(centre.b - centre.a)};
    Ring ring = hole.outer;
    const std::vector<FoldCrossing> crossings = put_crossings(ring, fold);
    for (std::size_t i = 0; i < ring.size(); ++i)
        made.edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    const auto on_fold = [&](Vec2 p) { return std::abs(cross(fold.dir, p - fold.at)) < kOnFoldMm; };
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (!on_fold(ring[i]) || !on_fold(ring[(i + 1) % ring.size()])) continue;
        return HoleFault{hole_at(hole) + " runs along its centre fold",
                         "draw it across the fold, or wholly on one side of it"};
    }
    if (crossings.empty()) {
        double aside = 0.0;
        for (const Vec2 p : ring) {
            const double off = cross(fold.dir, p - fold.at);
            if (std::abs(off) > std::abs(aside)) aside = off;
        }
        (aside > 0.0 ? made.left : made.right).emplace_back(ring.rbegin(), ring.rend());
        return std::nullopt;
    }
    const double size = distance(centre.a, centre.b);
    if (crossings.size() != 2) {
        return HoleFault{fmt::format("{} crosses its centre fold {} times", hole_at(hole), crossings.size()),
                         "draw holes that cross the fold twice, or not at all"};
    }
    const auto [from, to] = std::pair(crossings[0].along, crossings[1].along);
    if (from < kLeastFoldMm || to > size - kLeastFoldMm) {
        return HoleFault{
            fmt::format("{} leaves {} of its centre fold at one end; the least is {}", hole_at(hole),
                        mm(std::max(0.0, std::min(from, size - to))), mm(kLeastFoldMm)),
            "move it along the fold, or make it smaller"};
    }
    // Counter-clockwise, it goes along the fold's direction on the right of it.
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(crossings[0].corner), ring.end());
    const auto turn =
        static_cast<std::ptrdiff_t>((crossings[1].corner + ring.size() - crossings[0].corner) % ring.size());
    HoleAcross across;
    across.right.assign(ring.begin(), ring.begin() + turn + 1);
    across.left.assign(ring.begin() + turn, ring.end());
    across.left.push_back(ring.front());
    across.from = from;
    across.to = to;
    made.across.push_back(std::move(across));
    return std::nullopt;
}

std::optional<HoleFault> divide_holes(const Element& e, const Halves& halves, const Segment& centre,
                                      PieceHoles& made) {
    const std::vector<Polygon> holes = drawn_holes(e);
    if (holes.empty()) return std::nullopt;
    const std::vector<Polygon> piece = unite({halves.left, halves.right});
    const std::vector<Polygon> room = offset(piece, -kOnFoldMm, Corners::sharp);
    for (const Polygon& hole : holes) {
        // A corner that comes out of the piece need not have an area to speak of.
        if (const std::vector<Polygon> beside = subtract({hole}, room); !beside.empty()) {
            const double size = area(beside);
            return HoleFault{
                fmt::format("{} {} the edge of its piece at {}", hole_at(hole),
                            size < 0.01 ? "touches" : fmt::format("is for {:.2f} mm² on or beyond", size),
                            at_mm(beside.front().outer.front())),
                "draw holes inside the piece, and what opens to its edge as part of the outline"};
        }
        if (auto fault = divide_hole(hole, centre, made)) return fault;
    }
    std::sort(made.across.begin(), made.across.end(),
              [](const HoleAcross& a, const HoleAcross& b) { return a.from < b.from; });
    for (std::size_t i = 1; i < made.across.size(); ++i) {
        const double between = made.across[i].from - made.across[i - 1].to;
        if (between >= kLeastFoldMm) continue;
        return HoleFault{
            fmt::format("two of its holes leave {} of its centre fold between them; the least is {}",
                        mm(std::max(0.0, between)), mm(kLeastFoldMm)),
            "move them apart, or draw them as one"};
    }
    return std::nullopt;
}

}  // namespace

std::vector<FoldCrossing> put_crossings(Ring& ring, const DirectedLine& fold) {
    const auto off = [&](Vec2 p) {
        const double d = cross(fold.dir, p - fold.at);
        return std::abs(d) < kOnFoldMm ? 0.0 : d;
    };
    Ring made;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 p = ring[i];
        const Vec2 q = ring[(i + 1) % ring.size()];
        made.push_back(p);
        const double from = off(p);
        const double to = off(q);
        if (from * to < 0.0) made.push_back(lerp(p, q, from / (from - to)));
    }
    std::vector<FoldCrossing> found;
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (off(made[i]) != 0.0) continue;
        const double before = off(made[i == 0 ? made.size() - 1 : i - 1]);
        const double after = off(made[(i + 1) % made.size()]);
        // Where it only touches, or runs along it, nothing is divided.
        if (before * after >= 0.0) continue;
        const Vec2 away = made[i] - fold.at;
        const double along = dot(fold.dir, away);
        // Off by more than rounding it is no end of a seam, which stays where it is.
        if (std::abs(cross(fold.dir, away)) > 1e-9) made[i] = fold.at + along * fold.dir;
        found.push_back({along, i});
    }
    ring = std::move(made);
    std::sort(found.begin(), found.end(),
              [](const FoldCrossing& a, const FoldCrossing& b) { return a.along < b.along; });
    return found;
}

bool has_holes(const Element& e) {
    const std::span<const Polygon> outline = areas_of(e, "outline");
    return !areas_of(e, "hole").empty() ||
           std::any_of(outline.begin(), outline.end(),
                       [](const Polygon& area) { return !area.holes.empty(); });
}

std::optional<PieceHoles> holes_of(const Element& e, const Halves& halves, const Segment& centre) {
    PieceHoles made;
    if (divide_holes(e, halves, centre, made)) return std::nullopt;
    return made;
}

bool constrain_holes(Element& e, const Halves& halves, const Segment& centre) {
    if (!mend_holes(e, "hole", "its hole")) return false;
    PieceHoles made;
    if (const auto fault = divide_holes(e, halves, centre, made)) {
        e.failed("hole-off-piece", fault->what, fault->hint);
        return false;
    }
    if (!has_holes(e) && areas_of(e, "outline").empty()) return true;
    const std::vector<Polygon> paper = subtract(unite({halves.left, halves.right}), drawn_holes(e));
    if (paper.size() == 1) tell_thin(e, paper.front());
    return true;
}

}  // namespace popup
