// Glue tabs: their shape along a seam, and what obstacles leave of it.
//
// A tab is worked out in its seam's own coordinates, the same on both sides of the joint: x runs along the
// seam from its start, y away from it, out of the piece or into the plate it is glued to. One shape then is
// the tab on the piece and, mirrored, the target on the base.
#pragma once

#include <span>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// Between a seam's own coordinates and a page.
class SeamFrame {
 public:
    // The y axis points to the left of the seam, or to its right. Precondition: the seam has a length.
    SeamFrame(const Segment& seam, bool left);
    [[nodiscard]] double length() const { return length_; }
    // The seam's ends map to themselves exactly.
    [[nodiscard]] Vec2 to_page(Vec2 p) const;
    [[nodiscard]] Ring to_page(const Ring& ring) const;
    [[nodiscard]] Vec2 to_seam(Vec2 p) const;
    [[nodiscard]] Segment to_seam(const Segment& s) const { return {to_seam(s.a), to_seam(s.b)}; }
    // Direction of the seam for text that must not stand on its head: in (-90°, 90°], in radians.
    [[nodiscard]] double text_angle() const;

 private:
    Segment seam_;
    Vec2 along_, out_;
    double length_;
};

struct TabRules {
    double depth = 10.0;  // mm, > 0
    double taper = 0.0;   // of the ends, off the perpendicular, in radians; [0, 80°]
    double gap = 1.0;     // to obstacles, mm
};

// The untrimmed tab: a trapezoid whose far side is at least a quarter of its seam; on short seams it is less
// deep.
Ring full_tab(double seam_length, const TabRules& rules);

// What obstacles leave of a tab, all in seam coordinates. At each place along the seam the tab reaches out to
// the first obstacle and no further: parts are simple rings, counter-clockwise, each standing on at least 2
// mm of the seam (y = 0) and at least 1 mm deep (half a tiny tab's own size, if that is less), none thinner
// than half a millimetre. What lies at y ≤ 0 is no obstacle.
//   on_base: the tab stays `gap` off these (folds, cuts, edges, targets on the plate it is glued to).
//   on_piece: the same for edges of the piece and its other tabs, but those that start at an end of the seam:
//   beside them it leaves a wedge of 10°, so that the seam keeps its whole length.
std::vector<Ring> trimmed_tab(double seam_length, const TabRules& rules, std::span<const Segment> on_base,
                              std::span<const Segment> on_piece);

// The stretches of the seam that the parts stand on, in order; from < to.
struct Stretch {
    double from, to;
};
std::vector<Stretch> seam_stretches(std::span<const Ring> parts);

// How much of the seam has at least this depth of tab, in mm.
double length_with_depth(std::span<const Ring> parts, double depth);

// Depth of the shallowest place between two places along the seam; 0 where there is no tab.
double least_depth(const Ring& part, double from, double to);

}  // namespace popup
