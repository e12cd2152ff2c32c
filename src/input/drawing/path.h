// Paths of lines and cubic curves in user units, and the text that describes them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "input/drawing/transform.h"
#include "popup/geometry.h"

namespace popup::drawing {

struct PathStep {
    Vec2 to;
    bool curve = false;
    Vec2 control_1, control_2;  // of a curve
};

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
    // gives a line. `turn` is of the ellipse's x axis, in degrees.
    void arc(double rx, double ry, double turn, bool large, bool sweep, Vec2 to);
    // Ends the subpath at its start; what follows begins there.
    void close();

    [[nodiscard]] Vec2 at() const { return at_; }
    [[nodiscard]] std::size_t size() const { return size_; }  // steps of all subpaths
    [[nodiscard]] const std::vector<Subpath>& subpaths() const { return subpaths_; }

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
// Appends what `text`, the `d` of a path element, describes. What stands before a fault has been appended.
std::optional<PathFault> parse_path(std::string_view text, Path& path);

// A subpath as it was drawn, on the grid of base/regions.h; doubled points are left out.
struct Polyline {
    std::vector<Vec2> points;
    bool closed = false;  // the last point joins the first
};

// Curves become chords that stray from them by at most this, in mm.
inline constexpr double kFlatMm = 0.01;
// Points further out than this, in mm, are mistakes.
inline constexpr double kReachMm = 1e5;

enum class FlatteningFault { none, too_far, too_many };
// Appends the subpaths, mapped by `to_mm`; those with fewer than two points are left out. `points` counts
// those of the whole drawing, of which there may be kPointsLimit.
inline constexpr std::size_t kPointsLimit = 1'000'000;
FlatteningFault flatten(const Path& path, const Affine& to_mm, std::size_t& points,
                        std::vector<Polyline>& lines);

}  // namespace popup::drawing
