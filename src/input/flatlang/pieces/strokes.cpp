#include "input/flatlang/pieces/strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "input/flatlang/pieces/same_points.h"

namespace popup::flatlang {
namespace {

constexpr double kSameInch = 1e-4;
constexpr double kFlatInch = 1e-4;

struct Line {
    std::array<int, 2> ends;
    bool used = false;
};

// Are all points in one plane? False of those on a line.
bool is_flat(const std::vector<Vec3>& points) {
    Vec3 swept{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        swept = swept + cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
    }
    if (length(swept) < 1e-9) return false;
    const Vec3 normal = unit(swept);
    return std::all_of(points.begin(), points.end(),
                       [&](Vec3 p) { return std::fabs(dot(p - points[0], normal)) <= kFlatInch; });
}

// The lines of one part, by the points where they meet.
class Strokes {
 public:
    void add(const TrailSegment& segment) {
        const int a = points_.of(segment.from);
        const int b = points_.of(segment.to);
        if (a == b || !seen_.insert(std::minmax(a, b)).second) return;
        at_.resize(points_.size());
        for (const int end : {a, b}) at_[static_cast<std::size_t>(end)].push_back(lines_.size());
        lines_.push_back({{a, b}});
    }

    void find_loops(int part, std::vector<TrailPolygon>& loops) {
        for (std::size_t first = 0; first < lines_.size(); ++first) {
            if (lines_[first].used) continue;
            std::vector<Vec3> points;
            if (walk(first, points) && points.size() >= 3 && is_flat(points)) loops.push_back({points, part});
        }
    }

 private:
    // Goes from line to line as long as exactly two meet. True: it came back to where it began.
    bool walk(std::size_t first, std::vector<Vec3>& points) {
        std::size_t line = first;
        int from = lines_[first].ends[0];
        const int begin = from;
        while (!lines_[line].used) {
            lines_[line].used = true;
            points.push_back(points_.point(from));
            const int to = lines_[line].ends[0] == from ? lines_[line].ends[1] : lines_[line].ends[0];
            const std::vector<std::size_t>& meeting = at_[static_cast<std::size_t>(to)];
            if (meeting.size() != 2) return false;
            if (to == begin) return true;
            line = meeting[0] == line ? meeting[1] : meeting[0];
            from = to;
        }
        return false;
    }

    SamePoints points_{kSameInch};
    std::vector<Line> lines_;
    std::vector<std::vector<std::size_t>> at_;  // of each point its lines
    std::set<std::pair<int, int>> seen_;
};

}  // namespace

std::vector<TrailPolygon> loops_of_strokes(const Trail& trail, const std::vector<std::size_t>& numbers) {
    std::vector<TrailPolygon> loops;
    for (std::size_t begin = 0; begin < numbers.size();) {
        const int part = trail.segments[numbers[begin]].part;
        Strokes strokes;
        std::size_t end = begin;
        for (; end < numbers.size() && trail.segments[numbers[end]].part == part; ++end) {
            strokes.add(trail.segments[numbers[end]]);
        }
        strokes.find_loops(part, loops);
        begin = end;
    }
    return loops;
}

}  // namespace popup::flatlang
