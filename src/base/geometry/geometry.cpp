#include "popup/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <queue>

#include "base/text/numbers.h"

namespace popup {

Vec2 rotated(Vec2 a, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * a.x - s * a.y, s * a.x + c * a.y};
}

double distance(Vec2 p, const Segment& s) {
    const Vec2 along = s.b - s.a;
    const double squared = dot(along, along);
    if (squared == 0.0) return distance(p, s.a);
    const double t = std::clamp(dot(p - s.a, along) / squared, 0.0, 1.0);
    return distance(p, s.a + t * along);
}

double distance(const Segment& s, const Segment& t) {
    const double s_a = cross(t.b - t.a, s.a - t.a);
    const double s_b = cross(t.b - t.a, s.b - t.a);
    const double t_a = cross(s.b - s.a, t.a - s.a);
    const double t_b = cross(s.b - s.a, t.b - s.a);
    if (((s_a > 0 && s_b < 0) || (s_a < 0 && s_b > 0)) && ((t_a > 0 && t_b < 0) || (t_a < 0 && t_b > 0))) {
        return 0.0;
    }
    return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)});
}

void Box::extend(Vec2 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
}

double signed_area(const Ring& ring) {
    double twice = 0.0;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) twice += cross(ring[j], ring[i]);
    return 0.5 * twice;
}

double area(const Polygon& polygon) {
    double total = std::abs(signed_area(polygon.outer));
    for (const Ring& hole : polygon.holes) total -= std::abs(signed_area(hole));
    return total;
}

double area(const std::vector<Polygon>& polygons) {
    double sum = 0.0;
    for (const Polygon& polygon : polygons) sum += area(polygon);
    return sum;
}

double perimeter(const Ring& ring) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(ring[i], ring[(i + 1) % ring.size()]);
    return sum;
}

Box bounds(const Ring& ring) {
    Box box;
    for (const Vec2 p : ring) box.extend(p);
    return box;
}

namespace {

enum class Where { outside, edge, inside };

Where locate(const Ring& ring, Vec2 p) {
    int winding = 0;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Vec2 a = ring[j];
        const Vec2 b = ring[i];
        const double side = cross(b - a, p - a);
        if (side == 0.0 && dot(p - a, p - b) <= 0.0) return Where::edge;
        if (a.y <= p.y) {
            if (b.y > p.y && side > 0.0) ++winding;
        } else if (b.y <= p.y && side < 0.0) {
            --winding;
        }
    }
    return winding == 0 ? Where::outside : Where::inside;
}

double edge_distance(const Polygon& polygon, Vec2 p) {
    double best = HUGE_VAL;
    const auto look = [&](const Ring& ring) {
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            best = std::min(best, distance(p, Segment{ring[j], ring[i]}));
        }
    };
    look(polygon.outer);
    for (const Ring& hole : polygon.holes) look(hole);
    return contains(polygon, p) ? best : -best;
}

}  // namespace

bool contains(const Polygon& polygon, Vec2 p) {
    const Where outer = locate(polygon.outer, p);
    if (outer != Where::inside) return outer == Where::edge;
    return std::none_of(polygon.holes.begin(), polygon.holes.end(),
                        [p](const Ring& hole) { return locate(hole, p) == Where::inside; });
}

// Quadtree search: a cell is worth splitting only while the best point it could hold beats the best one
// found.
InnerPoint inner_point(const Polygon& polygon, double precision) {
    struct Cell {
        Vec2 centre;
        double half;
        double clearance;
        std::size_t order;  // ties are broken by age, so that the result does not depend on the heap
        [[nodiscard]] double bound() const { return clearance + half * std::sqrt(2.0); }
    };
    const auto worse = [](const Cell& a, const Cell& b) {
        return a.bound() != b.bound() ? a.bound() < b.bound() : a.order > b.order;
    };
    const Box box = bounds(polygon.outer);
    const double size = std::max(std::min(box.width(), box.height()), precision);
    std::priority_queue<Cell, std::vector<Cell>, decltype(worse)> cells(worse);
    std::size_t order = 0;
    const auto make = [&](Vec2 centre, double half) {
        return Cell{centre, half, edge_distance(polygon, centre), order++};
    };
    const double half = 0.5 * size;
    const auto columns = static_cast<int>(std::min(64.0, std::ceil(box.width() / size)));
    const auto rows = static_cast<int>(std::min(64.0, std::ceil(box.height() / size)));
    const double step_x = box.width() / std::max(columns, 1);
    const double step_y = box.height() / std::max(rows, 1);
    const double cell_half = std::max({half, 0.5 * step_x, 0.5 * step_y});
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            cells.push(
                make({box.min.x + (column + 0.5) * step_x, box.min.y + (row + 0.5) * step_y}, cell_half));
        }
    }
    Cell best = make(box.centre(), 0.0);
    // A bound on the work keeps degenerate polygons (slivers) from running away.
    for (int budget = 20000; budget > 0 && !cells.empty(); --budget) {
        const Cell cell = cells.top();
        cells.pop();
        if (cell.clearance > best.clearance) best = cell;
        if (cell.bound() - best.clearance <= precision) break;
        const double quarter = 0.5 * cell.half;
        for (const Vec2 shift : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{1, 1}}) {
            cells.push(make(cell.centre + quarter * shift, quarter));
        }
    }
    return {best.centre, best.clearance};
}

std::array<double, 4> quaternion(const Frame& frame) {
    const Vec3 x = frame.axes[0];
    const Vec3 y = frame.axes[1];
    const Vec3 z = frame.axes[2];
    // Four times the squared components; the largest one is divided by, so nothing is lost to cancellation.
    const double ww = 1.0 + x.x + y.y + z.z;
    const double xx = 1.0 + x.x - y.y - z.z;
    const double yy = 1.0 - x.x + y.y - z.z;
    const double zz = 1.0 - x.x - y.y + z.z;
    std::array<double, 4> q{};
    const double largest = std::max({ww, xx, yy, zz});
    if (largest == ww) {
        q = {y.z - z.y, z.x - x.z, x.y - y.x, ww};
    } else if (largest == xx) {
        q = {xx, x.y + y.x, z.x + x.z, y.z - z.y};
    } else if (largest == yy) {
        q = {x.y + y.x, yy, y.z + z.y, z.x - x.z};
    } else {
        q = {z.x + x.z, y.z + z.y, zz, x.y - y.x};
    }
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double scale = (q[3] < 0.0 ? -1.0 : 1.0) / norm;
    for (double& value : q) value *= scale;
    return q;
}

std::string shown_point(const Ruler& ruler, Vec2 at) {
    const Vec2 off = ruler.per_mm * (at - ruler.origin);
    return fmt::format("({:.2f}, {:.2f}){}{}", rounded(off.x, 2), rounded(ruler.y_down ? -off.y : off.y, 2),
                       ruler.unit.empty() ? "" : " ", ruler.unit);
}

}  // namespace popup
