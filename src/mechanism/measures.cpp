#include "mechanism/measures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/site_lines.h"

namespace popup::measure {
namespace {

constexpr double kUnmovedMm = 1e-9;

// Of the point on a ray `away` from the fold: where it is along the fold.
SitePoint on_ray(double apex, int dir, double angle_deg, double away) {
    const double angle = angle_deg * kDegree;
    return {apex + dir * away * std::cos(angle) / std::sin(angle), away};
}

Vec2 image_of(const Placed& m, Vec2 p) {
    return {m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

bool is_identity(const Placed& m) {
    constexpr double kProbeMm = 1e3;
    const auto stays = [&](Vec2 p) { return distance(image_of(m, p), p) <= kUnmovedMm; };
    return stays({0, 0}) && stays({kProbeMm, 0}) && stays({0, kProbeMm});
}

}  // namespace

TwoSides two_sides(const Element& e) {
    const auto& p = e.on;
    const double way = p[1].s >= p[0].s ? 1.0 : -1.0;
    const double left = 0.5 * (p[0].w + p[1].w);
    const double right = 0.5 * (p[2].w + p[3].w);
    TwoSides made;
    made.at = from_middle(e, 0.25 * (p[0].s + p[1].s + p[2].s + p[3].s));
    made.length = 0.5 * way * (p[1].s - p[0].s + p[3].s - p[2].s);
    made.width = left + right;
    made.offset = 0.5 * (right - left);
    made.shift = 0.5 * (p[2].s + p[3].s - p[0].s - p[1].s);
    made.taper = way * (p[3].s - p[2].s - p[1].s + p[0].s);
    return made;
}

void set_two_sides(Element& e, const TwoSides& sides) {
    const double way = e.on[1].s >= e.on[0].s ? 1.0 : -1.0;
    const double middle = along(e, sides.at);
    const auto set = [&](std::size_t first, double at, double long_, double away) {
        e.on[first] = {at - 0.5 * way * long_, away};
        e.on[first + 1] = {at + 0.5 * way * long_, away};
    };
    set(0, middle - 0.5 * sides.shift, sides.length - 0.5 * sides.taper, sides.left());
    set(2, middle + 0.5 * sides.shift, sides.length + 0.5 * sides.taper, sides.right());
}

SitePoint TwoRays::left(double apex) const {
    return on_ray(apex, dir, 0.5 * (angle - skew), 0.5 * width - offset);
}

SitePoint TwoRays::right(double apex) const {
    return on_ray(apex, dir, 0.5 * (angle + skew), 0.5 * width + offset);
}

TwoRays two_rays(double length, double apex, int dir, SitePoint left, SitePoint right) {
    const double a = angle_at(apex, dir, left) / kDegree;
    const double b = angle_at(apex, dir, right) / kDegree;
    return {apex - 0.5 * length, left.w + right.w, 0.5 * (right.w - left.w), a + b, b - a, dir};
}

Vec2 Spot::up() const { return rotated({0.0, 1.0}, turn * kDegree); }

double turn_of(Vec2 direction) { return std::atan2(-direction.x, direction.y) / kDegree; }

Spot spot_of(Vec2 from, Vec2 to) { return {lerp(from, to, 0.5), turn_of(to - from)}; }

Placed moved_to(const Spot& from, const Spot& to, double aside, double along) {
    const Vec2 r = from.right();
    const Vec2 u = from.up();
    const Vec2 x = aside * to.right();
    const Vec2 y = along * to.up();
    Placed m{
        x.x * r.x + y.x * u.x, x.y * r.x + y.y * u.x, x.x * r.y + y.x * u.y, x.y * r.y + y.y * u.y, 0, 0};
    const Vec2 off = to.at - image_of(m, from.at);
    m[4] = off.x;
    m[5] = off.y;
    return m;
}

std::optional<Placed> mapped_to(const std::array<Vec2, 3>& from, const std::array<Vec2, 3>& to) {
    const Vec2 a = from[1] - from[0];
    const Vec2 b = from[2] - from[0];
    const double d = cross(a, b);
    if (std::abs(d) <= 1e-9 * std::max(1.0, length(a) * length(b))) return std::nullopt;
    const Vec2 c = to[1] - to[0];
    const Vec2 f = to[2] - to[0];
    Placed m{(c.x * b.y - f.x * a.y) / d,
             (c.y * b.y - f.y * a.y) / d,
             (f.x * a.x - c.x * b.x) / d,
             (f.y * a.x - c.y * b.x) / d,
             0,
             0};
    const Vec2 off = to[0] - image_of(m, from[0]);
    m[4] = off.x;
    m[5] = off.y;
    return m;
}

void move_drawn(Element& e, PointPage page, const Placed& by) {
    if (is_identity(by)) return;
    for (std::size_t i = 0; i < e.arguments.size(); ++i) {
        if (e.info->parameters[i].page != page || !is_drawn(e.arguments[i])) continue;
        move_argument(e.arguments[i], by);
        e.arguments[i].changed = true;
    }
}

Box drawn_box(const Element& e, std::string_view name, const Spot& from) {
    Box box;
    const auto number = find_parameter(*e.info, name);
    if (!number) return box;
    const auto add = [&](Vec2 p) {
        box.extend({dot(from.right(), p - from.at), dot(from.up(), p - from.at)});
    };
    const Argument& argument = e.arguments[*number];
    if (const auto* path = std::get_if<DrawnPath>(&argument.value)) {
        for (const Polygon& area : path->inside.areas) {
            for (const Vec2 p : area.outer) add(p);
        }
    } else if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
        for (const DesignPoint& point : *points) add(point.at);
    }
    return box;
}

namespace {

// The middle of the corners of all that is drawn on the page of the fold.
Vec2 middle_of_corners(const Element& e) {
    Vec2 sum;
    double count = 0.0;
    const auto add = [&](Vec2 p) {
        sum = sum + p;
        count += 1.0;
    };
    for (std::size_t i = 0; i < e.arguments.size(); ++i) {
        if (e.info->parameters[i].page != PointPage::fold) continue;
        if (const auto* path = std::get_if<DrawnPath>(&e.arguments[i].value)) {
            for (const Subpath& line : path->path.subpaths()) {
                add(line.start);
                for (const PathStep& step : line.steps) add(step.to);
            }
        } else if (const auto* points = std::get_if<std::vector<DesignPoint>>(&e.arguments[i].value)) {
            for (const DesignPoint& point : *points) add(point.at);
        }
    }
    return count > 0.0 ? (1.0 / count) * sum : sum;
}

}  // namespace

void place_drawn(Element& e, const Spot& from, const Box& box, const Spot& to, const Scale& scale,
                 double turn_deg) {
    const Spot middle{from.place(box.centre().x, box.centre().y), from.turn};
    move_drawn(e, PointPage::fold, moved_to(middle, to, scale.aside, scale.along));
    const Vec2 about = middle_of_corners(e);
    move_drawn(e, PointPage::fold, moved_to({about, 0.0}, {about, turn_deg}));
}

namespace {

Argument argument_of(Path path) {
    DrawnPath drawn;
    drawn.path = std::move(path);
    drawn.moved = true;
    Argument made;
    if (enclose(drawn.path, drawn.inside) == FlatteningFault::none) made.value = std::move(drawn);
    made.changed = true;
    return made;
}

}  // namespace

Argument ellipse(const Spot& about, double width, double height) {
    Path path;
    const Vec2 from = about.place(-0.5 * width, 0.0);
    const Vec2 to = about.place(0.5 * width, 0.0);
    path.move(from);
    path.arc(0.5 * width, 0.5 * height, about.turn, false, true, to);
    path.arc(0.5 * width, 0.5 * height, about.turn, false, true, from);
    path.close();
    return argument_of(std::move(path));
}

Argument corners(const Spot& about, std::span<const Vec2> at) {
    Path path;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const Vec2 p = about.place(at[i].x, at[i].y);
        i == 0 ? path.move(p) : path.line(p);
    }
    path.close();
    return argument_of(std::move(path));
}

Scale scale_of(double width, double height, double new_width, double new_height) {
    const auto share = [](double is, double was) { return was > kUnmovedMm ? is / was : 1.0; };
    const double aside = share(new_width, width);
    const double along = share(new_height, height);
    const bool wide = std::abs(new_width - width) > kUnmovedMm;
    const bool high = std::abs(new_height - height) > kUnmovedMm;
    if (wide && high) return {aside, along};
    if (wide) return {aside, aside};
    if (high) return {along, along};
    return {};
}

void ask_for(const std::vector<bool>& given, std::span<const double> was, std::span<double> wanted) {
    POPUP_INVARIANT(given.size() == was.size() && was.size() == wanted.size());
    const auto changes = [&](std::size_t i) { return given[i] && std::abs(wanted[i] - was[i]) > kUnmovedMm; };
    bool any = false;
    for (std::size_t i = 0; i < given.size(); ++i) any = any || changes(i);
    for (std::size_t i = 0; any && i < given.size(); ++i) {
        if (given[i] && !changes(i)) wanted[i] = was[i] + 2.0 * kUnmovedMm;
    }
}

}  // namespace popup::measure
