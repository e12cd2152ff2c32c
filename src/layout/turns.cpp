#include "layout/turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace popup {
namespace {

// Angles are whole multiples of this, in degrees, so that what is written is what was used.
constexpr double kAngleStep = 1e-7;

double normal_degrees(double degrees) {
    double rounded = std::round(degrees / kAngleStep) * kAngleStep;
    rounded = std::fmod(rounded, 360.0);
    if (rounded < 0.0) rounded += 360.0;
    // Quarter turns must be exact.
    const double quarter = 90.0 * std::round(rounded / 90.0);
    if (std::abs(rounded - quarter) < 0.5 * kAngleStep) rounded = quarter;
    return rounded == 360.0 ? 0.0 : rounded;
}

bool allows_quarters(Rotation rotation) { return rotation.count == 0 || rotation.count % 4 == 0; }

// Turns worth a look: the smallest box has a side along an edge of the hull, or, if the turns come in steps,
// is one of the two steps next to such a turn.
std::vector<double> candidates(const Ring& hull, Rotation rotation) {
    std::vector<double> angles{0.0};
    if (rotation.count == 1) return angles;
    if (allows_quarters(rotation)) angles.push_back(90.0);
    if (rotation.count == 2 || rotation.count == 4) return angles;
    constexpr std::size_t kEdges = 64;  // of very round shapes only the longest edges are tried
    std::vector<Segment> edges;
    edges.reserve(hull.size());
    for (std::size_t i = 0; i < hull.size(); ++i) edges.push_back({hull[i], hull[(i + 1) % hull.size()]});
    if (edges.size() > kEdges) {
        std::stable_sort(edges.begin(), edges.end(), [](const Segment& a, const Segment& b) {
            return distance(a.a, a.b) > distance(b.a, b.b);
        });
        edges.resize(kEdges);
    }
    for (const Segment& edge : edges) {
        const Vec2 along = edge.b - edge.a;
        const double level = -std::atan2(along.y, along.x) * 180.0 / std::numbers::pi;
        for (const double quarter : {0.0, 90.0}) {
            const double flush = std::fmod(level + quarter + 720.0, 180.0);
            if (rotation.count == 0) {
                angles.push_back(flush);
            } else {
                const double step = 360.0 / rotation.count;
                angles.push_back(std::floor(flush / step) * step);
                angles.push_back(std::ceil(flush / step) * step);
                // An odd count has no half turns: the other side of the circle gives other turns.
                angles.push_back(std::floor((flush + 180.0) / step) * step);
                angles.push_back(std::ceil((flush + 180.0) / step) * step);
            }
        }
    }
    return angles;
}

// All turns there are, or steps of half a degree: for shapes that fit only in a turn that is not the smallest
// box's.
std::vector<double> all_turns(Rotation rotation) {
    constexpr int kMost = 720;
    const int count = rotation.count == 0 ? kMost : std::min(rotation.count, kMost);
    const double step = rotation.count == 0 ? 360.0 / kMost : 360.0 / rotation.count;
    const int stride = rotation.count > kMost ? rotation.count / kMost : 1;
    std::vector<double> angles;
    angles.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) angles.push_back(step * stride * i);
    return angles;
}

}  // namespace

Vec2 turned(Vec2 p, Angle angle) {
    if (angle.deg == 0.0) return p;
    if (angle.deg == 90.0) return {-p.y, p.x};
    if (angle.deg == 180.0) return {-p.x, -p.y};
    if (angle.deg == 270.0) return {p.y, -p.x};
    return rotated(p, angle.rad());
}

GridLength to_grid(double mm) { return std::llround(mm * 1e6); }
double from_grid(GridLength length) { return static_cast<double>(length) / 1e6; }

Pose pose_of(const Ring& hull, Angle angle) {
    Box box;
    for (const Vec2 p : hull) box.extend(turned(p, angle));
    Pose pose{angle, to_grid(box.min.x), to_grid(box.min.y), 0, 0};
    pose.width = to_grid(box.max.x) - pose.x;
    pose.height = to_grid(box.max.y) - pose.y;
    return pose;
}

std::vector<Pose> poses_in(const Ring& hull, const SheetArea& area, Rotation rotation) {
    const GridLength width = to_grid(area.width);
    const GridLength height = to_grid(area.height);
    const auto lies_in = [&](const Pose& pose) { return pose.width <= width && pose.height <= height; };
    const auto size = [](const Pose& pose) {
        return static_cast<double>(pose.width) * static_cast<double>(pose.height);
    };
    std::vector<Pose> result;
    const auto look = [&](const std::vector<double>& angles) {
        for (const double degrees : angles) {
            const Pose pose = pose_of(hull, Angle::degrees(normal_degrees(degrees)));
            if (!lies_in(pose)) continue;
            if (result.empty()) {
                result.push_back(pose);
            } else if (size(pose) < 0.999 * size(result[0])) {
                result[0] = pose;
            }
        }
    };
    look(candidates(hull, rotation));
    if (result.empty() && rotation.count != 1 && rotation.count != 2 && rotation.count != 4)
        look(all_turns(rotation));
    if (!result.empty() && allows_quarters(rotation)) {
        const Pose quarter = pose_of(hull, Angle::degrees(normal_degrees(result[0].angle.deg + 90.0)));
        if (lies_in(quarter) && quarter.width != result[0].width) result.push_back(quarter);
    }
    return result;
}

}  // namespace popup
