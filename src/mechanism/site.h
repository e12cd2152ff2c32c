// Where an element stands: a fold, seen along its direction, with a plate on each side.
//
// Elements reason in site coordinates: `s` along the fold from its begin, `w` away from it, positive on the
// side that is meant. A seam has its two sides on two pages; in site coordinates that makes no difference.
#pragma once

#include "popup/geometry.h"

namespace popup {

// A straight line on a page, with a direction.
struct DirectedLine {
    Vec2 at;   // its begin
    Vec2 dir;  // unit
};

struct SitePoint {
    double s = 0.0;
    double w = 0.0;
};

enum class Side { left, right };

struct Site {
    DirectedLine left, right;  // the same line of paper on the left plate's page and on the right plate's
    int left_page = 0, right_page = 0;
    int left_plate = -1, right_plate = -1;
    int fold = -1;          // index into Skeleton::folds
    double length = 0.0;    // of the fold, mm
    bool mountain = false;  // closed dihedral 360° (else 0°)
    bool seam = false;
    bool reversed = false;  // looked along against the fold's own direction
    // On a plate: both lines run from the element's first point to its second (upwards where it has one),
    // both sides are the plate, and there is no fold.
    bool on_plate = false;

    [[nodiscard]] const DirectedLine& line(Side side) const { return side == Side::left ? left : right; }
    [[nodiscard]] int plate(Side side) const { return side == Side::left ? left_plate : right_plate; }
    // From the fold into the plate of that side; unit, on its page.
    [[nodiscard]] Vec2 out(Side side) const {
        return side == Side::left ? left_of(left.dir) : right_of(right.dir);
    }
    // Page coordinates of a point given in site coordinates, on the page of that side.
    [[nodiscard]] Vec2 on_page(Side side, SitePoint p) const {
        return line(side).at + p.s * line(side).dir + p.w * out(side);
    }
    // The inverse: w is positive on that side of the line.
    [[nodiscard]] SitePoint from_page(Side side, Vec2 p) const {
        const Vec2 from = p - line(side).at;
        const double off = cross(line(side).dir, from);
        return {dot(line(side).dir, from), side == Side::left ? off : -off};
    }
    [[nodiscard]] Segment segment(Side side, SitePoint a, SitePoint b) const {
        return {on_page(side, a), on_page(side, b)};
    }
};

}  // namespace popup
