// What a plate is for the search for collisions: its paper without the outermost 0.01 mm, as triangles.
#pragma once

#include <array>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/tolerances.h"
#include "popup/assembly.h"

namespace popup {

// What two plates have in common only touches where it lies nearer than kTouchMm to an edge of either, or
// where they reach less far than this through each other round it (Crossing::firmness_mm).
inline constexpr double kFirmMm = 0.0025;

using Triangle2 = std::array<Vec2, 3>;
using Triangle3 = std::array<Vec3, 3>;

// Triangles in the plane that are found by where they are.
class Patches {
 public:
    explicit Patches(std::vector<Triangle2> triangles = {});

    [[nodiscard]] const std::vector<Triangle2>& all() const { return triangles_; }
    // Numbers of the triangles whose boxes touch the box; ascending.
    void query(const Box& box, std::vector<int>& found) const { boxes_.query(box, found); }

 private:
    std::vector<Triangle2> triangles_;
    EdgeIndex boxes_;  // by their diagonals
};

// All the paper that a plate may be at while the card stands still: its outline, or of one that is turned by
// hand all that it sweeps, and up to 0.005 mm more. Coordinates of its page.
Polygon reach_of(const Plate& plate);

// Coordinates of the plate's page.
struct PlateShape {
    Ring hull;            // convex, of the whole plate
    Box box;              // of the plate
    double radius = 0.0;  // no circle on the plate is larger
    Patches whole;        // the plate, where its least distance to others is asked for; else empty
    Patches core;         // its points at least kTouchMm inside its edges; may be empty
    EdgeIndex edges;
    std::vector<std::vector<Vec2>> rings;  // outer and holes

    [[nodiscard]] bool covers(Vec2 p) const { return edges.winding(p) != 0; }
    // Distance from p to the nearest edge, or `limit` when none is nearer.
    [[nodiscard]] double to_edge(Vec2 p, double limit) const { return edges.clearance(p, limit); }
};

// Cost: near linear in corners. `distances`: least distances will be asked for, for which the whole plate is
// cut into triangles besides its core.
PlateShape plate_shape(const Plate& plate, bool distances = false);

}  // namespace popup
