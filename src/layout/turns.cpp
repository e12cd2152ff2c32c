#include "layout/turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace popup {
namespace {

// Angles are whole multiples of this, in degrees, so that what is written is what was used.
constexpr double kAngleStep = 1e-7;
// Counts up to this are all looked at.
constexpr int kFewTurns = 12;
// Of more turns, how many are looked at besides the drawn one, quarter turns not counted; and how far apart
// they are at the least, in degrees.
constexpr std::size_t kFamilies = 3;
constexpr double kAlike = 0.05;
// Of very round shapes only the longest edges are tried.
constexpr std::size_t kEdges = 64;
// Steps of a circle that are tried for a shape that fits in none of the likely turns.
constexpr int kAllTurns = 720;

double normal_degrees(double degrees) {
    double rounded = std::round(degrees / kAngleStep) * kAngleStep;
    rounded = std::fmod(rounded, 360.0);
    if (rounded < 0.0) rounded += 360.0;
    // Quarter turns must be exact.
    const double quarter = 90.0 * std::round(rounded / 90.0);
    if (std::abs(rounded - quarter) < 0.5 * kAngleStep) rounded = quarter;
    return rounded == 360.0 ? 0.0 : rounded;
}

// The step next to an angle, or the angle itself where any will do.
double nearest_step(double degrees, Rotation rotation) {
    if (rotation.count == 0) return degrees;
    const double step = 360.0 / rotation.count;
    return step * std::round(degrees / step);
}

// How many of the four quarter turns lead from one allowed turn to another.
int quarters(Rotation rotation) {
    if (rotation.count == 0 || rotation.count % 4 == 0) return 4;
    return rotation.count % 2 == 0 ? 2 : 1;
}

double box_area(const Ring& hull, double degrees) {
    const GridBox box = turned_box(hull, Angle::degrees(normal_degrees(degrees)));
    return static_cast<double>(box.width()) * static_cast<double>(box.height());
}

// Turns by less than a quarter in which an edge lies level or upright, the smallest box first.
std::vector<double> flush_turns(const Ring& hull, Rotation rotation) {
    std::vector<Segment> edges;
    edges.reserve(hull.size());
    for (std::size_t i = 0; i < hull.size(); ++i) edges.push_back({hull[i], hull[(i + 1) % hull.size()]});
    if (edges.size() > kEdges) {
        std::stable_sort(edges.begin(), edges.end(), [](const Segment& a, const Segment& b) {
            return distance(a.a, a.b) > distance(b.a, b.b);
        });
        edges.resize(kEdges);
    }
    struct Turn {
        double degrees, area;
    };
    std::vector<Turn> turns;
    for (const Segment& edge : edges) {
        const Vec2 along = edge.b - edge.a;
        const double level = -std::atan2(along.y, along.x) * 180.0 / std::numbers::pi;
        // An odd count has no half turns: the other side of the circle gives other turns.
        for (const double more : {0.0, 90.0, 180.0, 270.0}) {
            const double degrees = normal_degrees(nearest_step(level + more, rotation));
            turns.push_back({quarters(rotation) == 4 ? std::fmod(degrees, 90.0) : degrees, 0.0});
        }
    }
    for (Turn& turn : turns) turn.area = std::round(box_area(hull, turn.degrees) * 1e-6);
    std::stable_sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) {
        return a.area != b.area ? a.area < b.area : a.degrees < b.degrees;
    });
    std::vector<double> result;
    result.reserve(turns.size());
    for (const Turn& turn : turns) result.push_back(turn.degrees);
    return result;
}

}  // namespace

GridBox turned_box(const Ring& ring, Angle angle) {
    GridBox box;
    for (const GridPoint p : turned_ring(ring, angle)) box.extend(p);
    return box;
}

bool fits(const Ring& hull, Angle angle, const SheetArea& area) {
    const GridBox box = turned_box(hull, angle);
    return box.width() <= to_grid(area.width) && box.height() <= to_grid(area.height);
}

std::vector<Angle> turns_of(const Ring& hull, Rotation rotation, const std::vector<SheetArea>& areas) {
    std::vector<Angle> turns;
    const auto add = [&](double degrees) {
        const double normal = normal_degrees(degrees);
        const bool known = std::any_of(turns.begin(), turns.end(), [&](Angle turn) {
            const double apart = std::abs(turn.deg - normal);
            return std::min(apart, 360.0 - apart) < kAlike;
        });
        if (!known) turns.push_back(Angle::degrees(normal));
        return !known;
    };
    if (rotation.count >= 1 && rotation.count <= kFewTurns) {
        for (int i = 0; i < rotation.count; ++i) add(360.0 * i / rotation.count);
        return turns;
    }
    const int count = quarters(rotation);
    const auto add_family = [&](double degrees) {
        bool any = false;
        for (int i = 0; i < count; ++i) any = add(degrees + i * 360.0 / count) || any;
        return any;
    };
    add_family(0.0);
    std::size_t families = 0;
    for (const double degrees : flush_turns(hull, rotation)) {
        if (families == kFamilies) break;
        if (add_family(degrees)) ++families;
    }
    const auto fits_somewhere = [&](Angle angle) {
        return std::any_of(areas.begin(), areas.end(),
                           [&](const SheetArea& area) { return fits(hull, angle, area); });
    };
    if (std::any_of(turns.begin(), turns.end(), fits_somewhere)) return turns;
    const int steps = rotation.count == 0 ? kAllTurns : std::min(rotation.count, kAllTurns);
    const int stride = rotation.count > kAllTurns ? rotation.count / kAllTurns : 1;
    const double step = rotation.count == 0 ? 360.0 / kAllTurns : 360.0 / rotation.count * stride;
    for (int i = 0; i < steps; ++i) {
        const Angle angle = Angle::degrees(normal_degrees(i * step));
        if (!fits_somewhere(angle)) continue;
        turns.push_back(angle);
        break;
    }
    return turns;
}

}  // namespace popup
