#include "mechanism/arguments.h"

#include <algorithm>

#include "mechanism/element.h"

namespace popup {
namespace {

Vec2 mapped(const Placed& m, Vec2 p) {
    return {m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

}  // namespace

void move_argument(Argument& argument, const Placed& by) {
    if (auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
        for (DesignPoint& point : *points) point.at = mapped(by, point.at);
    }
    auto* path = std::get_if<DrawnPath>(&argument.value);
    if (path == nullptr) return;
    path->moved = true;
    path->path = path->path.mapped([&by](Vec2 p) { return mapped(by, p); });
    const bool turned_over = by[0] * by[3] - by[1] * by[2] < 0.0;
    const auto move_ring = [&](Ring& ring) {
        for (Vec2& p : ring) p = mapped(by, p);
        if (turned_over) std::reverse(ring.begin(), ring.end());
    };
    for (Polygon& area : path->inside.areas) {
        move_ring(area.outer);
        for (Ring& hole : area.holes) move_ring(hole);
    }
    for (FlatCurve& curve : path->inside.curves) {
        Cubic& c = curve.cubic;
        c = {mapped(by, c.from), mapped(by, c.control_1), mapped(by, c.control_2), mapped(by, c.to)};
        for (FlatCurve::Corner& corner : curve.corners) corner.at = mapped(by, corner.at);
    }
}

void mirror_piece(Element& element) {
    for (Vec2& p : element.extra) p.x = -p.x;
    for (std::size_t i = 0; i < element.arguments.size(); ++i) {
        if (element.info->parameters[i].page != PointPage::extra) continue;
        Argument& argument = element.arguments[i];
        move_argument(argument, kMirrored);
        argument.changed = argument.changed || is_drawn(argument);
    }
    element.piece_mirrored = true;
}

}  // namespace popup
