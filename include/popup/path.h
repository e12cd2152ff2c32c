// Paths of lines and cubic curves, the text that describes them, and the polygons that they become.
//
//   Path path;
//   if (parse_path("M0 0 H40 C52 0 52 20 40 20 H0 Z", path)) return;  // it cannot be read
//   Flattened flat;
//   if (flatten(path, flat) != FlatteningFault::none) return;
//   flat.lines[0].points;             // a closed polygon, within 0.01 mm of the path
//   const CurveTable table(flat.curves);  // knows which of its chords were a curve (popup/curves.h)
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// A cubic Bézier curve.
struct Cubic {
    Vec2 from, control_1, control_2, to;

    // The point of parameter t: `from` at 0, `to` at 1.
    [[nodiscard]] Vec2 at(double t) const;
    // The curve from at(t0) to at(t1) as a curve of its own; backwards where t1 < t0.
    [[nodiscard]] Cubic part(double t0, double t1) const;
};

struct PathStep {
    Vec2 to;
    bool curve = false;
    Vec2 control_1, control_2;  // of a curve
};

// A stretch drawn without lifting the pen. Closed: it ends at its start, by a line where its last step ends
// elsewhere.
struct Subpath {
    Vec2 start;
    std::vector<PathStep> steps;
    bool closed = false;
};

// What is drawn in one go.
class Path {
 public:
    void move(Vec2 to);
    void line(Vec2 to);
    void cubic(Vec2 control_1, Vec2 control_2, Vec2 to);
    void quadratic(Vec2 control, Vec2 to);
    // An elliptic arc as SVG defines it (appendix B.2 of SVG 2): radii that are too small grow, a radius of 0
    // gives a line. `turn` is of the ellipse's x axis, in degrees. It becomes cubics of 30° at most, which
    // stray from it by less than a two-millionth of the radius.
    void arc(double rx, double ry, double turn, bool large, bool sweep, Vec2 to);
    // Ends the subpath at its start; what follows begins there.
    void close();
    // Moves each end of a step that is within `within` of one of these points to the nearest of them, and the
    // controls beside it by as much. Returns where each was and is.
    std::vector<Segment> snap(std::span<const Vec2> to, double within);

    [[nodiscard]] Vec2 at() const { return at_; }
    [[nodiscard]] std::size_t size() const { return size_; }  // steps of all subpaths
    [[nodiscard]] const std::vector<Subpath>& subpaths() const { return subpaths_; }
    [[nodiscard]] bool empty() const { return subpaths_.empty(); }
    // The path with each of its points replaced by what `map` makes of it. Precondition: the map is affine.
    template <typename Map>
    [[nodiscard]] Path mapped(const Map& map) const {
        Path made = *this;
        made.at_ = map(at_);
        for (Subpath& subpath : made.subpaths_) {
            subpath.start = map(subpath.start);
            for (PathStep& step : subpath.steps) {
                step.to = map(step.to);
                if (!step.curve) continue;
                step.control_1 = map(step.control_1);
                step.control_2 = map(step.control_2);
            }
        }
        return made;
    }

 private:
    PathStep& step(Vec2 to);
    std::vector<Subpath> subpaths_;
    Vec2 at_;
    bool moved_ = true;  // the next step begins a subpath
    std::size_t size_ = 0;
};

// Paths with more steps than this are not read.
inline constexpr std::size_t kStepsLimit = 1'000'000;

struct PathFault {
    std::size_t at = 0;  // where in the text it cannot be read further
    bool too_long = false;
};
// Appends what `text`, the `d` of an SVG path, describes. What stands before a fault has been appended.
std::optional<PathFault> parse_path(std::string_view text, Path& path);

// A subpath as a polygon, on the grid of 1e-6 mm; doubled points are left out.
struct Polyline {
    std::vector<Vec2> points;
    bool closed = false;  // the last point joins the first
};

// A curve that has become chords, and where these end, on the grid.
struct FlatCurve {
    Cubic cubic;
    struct Corner {
        Vec2 at;
        double t = 0.0;
    };
    std::vector<Corner> corners;  // by t, from 0 to 1; at least two
};

struct Flattened {
    std::vector<Polyline> lines;
    std::vector<FlatCurve> curves;  // those that are not straight
    std::size_t points = 0;         // of all lines so far, taken away or not
};

// Curves become chords that stray from them by at most this, in mm.
inline constexpr double kFlatMm = 0.01;
// Curves that stray from one straight line by less than this, in mm, are straight.
inline constexpr double kStraightMm = 1e-3;
// Points further out than this, in mm, are mistakes.
inline constexpr double kReachMm = 1e5;
// More points than this are not made.
inline constexpr std::size_t kFlatPointsLimit = 1'000'000;

enum class FlatteningFault { none, too_far, too_many };
// Appends the subpaths of a path in mm; those with fewer than two points are left out. Cost: linear in
// chords.
FlatteningFault flatten(const Path& path, Flattened& into);

// What a path in mm encloses by the even-odd rule; subpaths that do not end at their start are closed.
struct Enclosed {
    std::vector<Polygon> areas;     // that do not overlap
    std::vector<FlatCurve> curves;  // what some of their chords stand for
};
// Sets `into`, to nothing where there is a fault. Cost: near linear in chords and crossings.
FlatteningFault enclose(const Path& path, Enclosed& into);

}  // namespace popup
