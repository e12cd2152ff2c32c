#include "mechanism/walls.h"

#include "mechanism/two_seams.h"

namespace popup::walls {

bool feet_fit(const Element& e) {
    using namespace two_seams;
    return e.paper->may_glue(Side::left, e.site.segment(Side::left, e.on[A], e.on[B]), Fit::as_drawn) &&
           e.paper->may_glue(Side::right, e.site.segment(Side::right, e.on[E], e.on[F]), Fit::as_drawn);
}

Upright upright(const Site& site, Side side, SitePoint foot, Vec2 own_at, Vec2 own_along, Vec2 own_across) {
    Upright wall;
    wall.drive = site.plate(side);
    wall.fold_at = site.on_page(side, {foot.s, 0.0});
    wall.fold_dir = site.line(side).dir;
    wall.fold_out = site.out(side);
    wall.foot_at = site.on_page(side, foot);
    wall.own_at = own_at;
    wall.own_along = own_along;
    wall.own_across = own_across;
    wall.near = foot.w;
    return wall;
}

Segment foot_line(const Element& e, Side side, double from, double to) {
    const double w = side == Side::left ? e.on[two_seams::A].w : e.on[two_seams::E].w;
    return e.site.segment(side, {from, w}, {to, w});
}

}  // namespace popup::walls
