#include "trace/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>

#include "base/geometry/edge_index.h"
#include "popup/geometry.h"

namespace popup {
namespace {

struct Step {
    int x = 0;
    int y = 0;
};
// Sides of a cell, counter-clockwise to the eye: upper, left, lower, right. Rows count downwards.
constexpr std::array<Step, 4> kOutwards{{{0, -1}, {-1, 0}, {0, 1}, {1, 0}}};
constexpr std::array<Step, 4> kAlong{{{-1, 0}, {0, 1}, {1, 0}, {0, -1}}};

Path through(const std::vector<Vec2>& points) {
    Path path;
    const std::size_t count = points.size();
    bool begun = false;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 in = points[i] - points[(i + count - 1) % count];
        const Vec2 out = points[(i + 1) % count] - points[i];
        if (cross(in, out) == 0.0) continue;
        begun ? path.line(points[i]) : path.move(points[i]);
        begun = true;
    }
    path.close();
    return path;
}

// Paths that come to a point and go back the way they came.
bool is_spike(const Segment& in, const Segment& out) {
    const Vec2 a = in.b - in.a;
    const Vec2 b = out.b - out.a;
    return dot(a, b) < 0.0 && std::abs(cross(a, b)) <= 1e-9 * length(a) * length(b);
}

}  // namespace

std::size_t border_length(const CellGrid& cells) {
    std::size_t edges = 0;
    const auto width = static_cast<std::size_t>(cells.width);
    for (std::size_t i = width; i < cells.inside.size(); ++i) {
        edges += cells.inside[i] != cells.inside[i - 1] ? 1 : 0;
        edges += cells.inside[i] != cells.inside[i - width] ? 1 : 0;
    }
    return edges;
}

CellBorders::CellBorders(const CellGrid& cells) : cells_(cells), above_(cells.inside.size()) {
    for (int y = 1; y + 1 < cells.height; ++y) {
        for (int x = 1; x + 1 < cells.width; ++x) {
            const std::size_t here = cells.at(x, y);
            if (cells.inside[here] != 0 && cells.inside[cells.at(x, y - 1)] == 0 && above_[here] == 0)
                follow(x, y);
        }
    }
}

void CellBorders::follow(int x, int y) {
    const auto number = static_cast<std::uint32_t>(contours_.size() + 1);
    std::vector<Vec2> middles;
    std::int64_t area = 0;
    std::size_t side = 0;
    // Each turn has one way to go on: no cells touch at a corner alone.
    while (side != 0 || above_[cells_.at(x, y)] != number) {
        const Step out = kOutwards[side];
        const Step along = kAlong[side];
        middles.push_back({x - 0.5 + 0.5 * out.x, cells_.height - 1.5 - y - 0.5 * out.y});
        if (side == 0) above_[cells_.at(x, y)] = number;
        if (side == 1) area -= x;
        if (side == 3) area += x + 1;
        if (cells_.inside[cells_.at(x + along.x, y + along.y)] == 0) {
            side = (side + 1) % 4;
        } else if (cells_.inside[cells_.at(x + along.x + out.x, y + along.y + out.y)] == 0) {
            x += along.x;
            y += along.y;
        } else {
            x += along.x + out.x;
            y += along.y + out.y;
            side = (side + 3) % 4;
        }
    }
    contours_.push_back({through(middles), area});
}

const CellContour* CellBorders::of(const CellContour& curve) const {
    const Subpath& subpath = curve.path.subpaths().front();
    Vec2 top = subpath.start;
    for (const PathStep& step : subpath.steps) {
        if (step.to.y > top.y) top = step.to;
    }
    const int left = static_cast<int>(std::floor(top.x)) + 1;
    const int row = static_cast<int>(std::floor(cells_.height - 1.0 - top.y));
    const CellContour* best = nullptr;
    double least = HUGE_VAL;
    for (int y = std::max(row - 2, 0); y <= std::min(row + 2, cells_.height - 1); ++y) {
        for (int x = std::max(left - 2, 0); x <= std::min(left + 2, cells_.width - 1); ++x) {
            const std::uint32_t number = above_[cells_.at(x, y)];
            if (number == 0 || contours_[number - 1].area != curve.area) continue;
            const double away = distance(top, Vec2{x - 0.5, cells_.height - 1.0 - y});
            if (away >= least) continue;
            least = away;
            best = &contours_[number - 1];
        }
    }
    return best;
}

namespace {

Vec2 middle_of(const CellContour& contour) {
    const Subpath& subpath = contour.path.subpaths().front();
    Box box;
    box.extend(subpath.start);
    for (const PathStep& step : subpath.steps) box.extend(step.to);
    return box.centre();
}

// Whether all corners of a curve lie within a cell of a border.
bool lies_along(const CellContour& border, const CellContour& curve) {
    constexpr double kFurthest = 1.0;
    const Subpath& lines = border.path.subpaths().front();
    const auto is_near = [&lines](Vec2 p) {
        Vec2 from = lines.start;
        for (const PathStep& step : lines.steps) {
            if (distance(p, Segment{from, step.to}) <= kFurthest) return true;
            from = step.to;
        }
        return distance(p, Segment{from, lines.start}) <= kFurthest;
    };
    const Subpath& subpath = curve.path.subpaths().front();
    return is_near(subpath.start) &&
           std::all_of(subpath.steps.begin(), subpath.steps.end(),
                       [&is_near](const PathStep& step) { return is_near(step.to); });
}

}  // namespace

const CellContour* CellBorders::about(const CellContour& curve) const {
    if (middles_.empty()) {
        for (std::size_t i = 0; i < contours_.size(); ++i)
            middles_.push_back({contours_[i].area, middle_of(contours_[i]), i});
        std::sort(middles_.begin(), middles_.end(), [](const Middle& a, const Middle& b) {
            return std::tie(a.area, a.at.x, a.at.y) < std::tie(b.area, b.at.x, b.at.y);
        });
    }
    const Vec2 wanted = middle_of(curve);
    const auto start = std::lower_bound(
        middles_.begin(), middles_.end(), std::tie(curve.area, wanted.x),
        [](const Middle& one, const auto& key) { return std::tie(one.area, one.at.x) < key; });
    const CellContour* best = nullptr;
    double least = HUGE_VAL;
    // A contour is no longer than the cells that it goes round, and the curve is within it.
    const double furthest = std::abs(static_cast<double>(curve.area));
    // False where no further one that way can be nearer.
    const auto look = [&](const Middle& one) {
        if (one.area != curve.area || std::abs(one.at.x - wanted.x) >= std::min(least, furthest))
            return false;
        const double away = distance(wanted, one.at);
        if (away < std::min(least, furthest) && lies_along(contours_[one.contour], curve)) {
            least = away;
            best = &contours_[one.contour];
        }
        return true;
    };
    for (auto right = start; right != middles_.end() && look(*right); ++right) {
    }
    for (auto left = start; left != middles_.begin() && look(*std::prev(left)); --left) {
    }
    return best;
}

double enclosed_area(const CellContour& curve) {
    Flattened flat;
    if (flatten(curve.path, flat) != FlatteningFault::none || flat.lines.empty()) return 0.0;
    return signed_area(flat.lines.front().points);
}

std::optional<std::vector<std::size_t>> crossing(const std::vector<Path>& paths) {
    constexpr double kTouching = 1e-7;
    struct Ring {
        int first = 0;
        int count = 0;
    };
    std::vector<Segment> edges;
    std::vector<std::size_t> owners;
    std::vector<Ring> rings(paths.size());
    std::vector<bool> bad(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        Flattened flat;
        flat.points = edges.size();
        if (flatten(paths[i], flat) != FlatteningFault::none) return std::nullopt;
        if (flat.lines.size() != 1 || flat.lines.front().points.size() < 3) {
            bad[i] = true;
            continue;
        }
        const std::vector<Vec2>& points = flat.lines.front().points;
        rings[i] = {static_cast<int>(edges.size()), static_cast<int>(points.size())};
        for (std::size_t k = 0; k < points.size(); ++k)
            edges.push_back({points[k], points[(k + 1) % points.size()]});
        owners.resize(edges.size(), i);
    }
    const EdgeIndex index(edges);
    std::vector<int> near;
    for (int a = 0; a < index.size(); ++a) {
        const auto owner = owners[static_cast<std::size_t>(a)];
        Box box;
        box.extend(index[a].a);
        box.extend(index[a].b);
        index.query(box, near);
        const Ring& ring = rings[owner];
        const int after = a + 1 == ring.first + ring.count ? ring.first : a + 1;
        for (const int b : near) {
            if (b <= a && b != after) continue;
            const auto other = owners[static_cast<std::size_t>(b)];
            if (owner == other && (b == after || (a == ring.first && b == ring.first + ring.count - 1))) {
                if (b == after && is_spike(index[a], index[b])) bad[owner] = true;
            } else if (b > a && distance(index[a], index[b]) < kTouching) {
                bad[owner] = true;
                bad[other] = true;
            }
        }
    }
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < bad.size(); ++i) {
        if (bad[i]) found.push_back(i);
    }
    return found;
}

}  // namespace popup
