// One page laid on another.
#pragma once

#include "popup/geometry.h"

namespace popup {

// Where points of a page lie on the page that it is laid on: `from` lies on `to`, and the direction `own_dir`
// along `base_dir` (both unit). `back`: on the back of that page, where it is seen in a mirror.
//
//     const Laid piece_on_base{how.own_at, how.own_dir, how.base_at, how.base_dir, how.back};
//     const Vec2 on_base = piece_on_base(p);
//     const Vec2 again = piece_on_base.inverse()(on_base);  // p
struct Laid {
    Vec2 from, own_dir, to, base_dir;
    bool back = false;

    [[nodiscard]] Laid inverse() const { return {to, base_dir, from, own_dir, back}; }
    [[nodiscard]] Vec2 operator()(Vec2 p) const {
        const Vec2 d = p - from;
        const double aside = cross(own_dir, d);
        return to + dot(own_dir, d) * base_dir + (back ? -aside : aside) * left_of(base_dir);
    }
    // Corners in their order: on a back the rings run the other way round.
    [[nodiscard]] Polygon operator()(Polygon polygon) const {
        for (Vec2& p : polygon.outer) p = (*this)(p);
        for (Ring& hole : polygon.holes) {
            for (Vec2& p : hole) p = (*this)(p);
        }
        return polygon;
    }
};

}  // namespace popup
