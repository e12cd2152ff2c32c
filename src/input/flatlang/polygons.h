// Closed loops in the run of points that a turtle leaves.
#pragma once

#include <unordered_map>
#include <vector>

#include "popup/geometry.h"

namespace popup::flatlang {

// Points are given in the order in which they are drawn. When the newest is the same (less than 1e-4 inches
// apart on every axis) as one in the run, the points from the oldest such to the one before the newest are a
// loop; if it has at least three that lie in one plane (less than 1e-4 off it), they are a polygon, and leave
// the run. Loops whose points all lie on one line leave it as well, and are none.
//
// With as_2008 the plane is that of the loop's newest three points, also where they lie on a line: then it is
// any, and so every such loop is a polygon.
//
// Cost: near linear in points; what has left the run is forgotten.
class PolygonFinder {
 public:
    explicit PolygonFinder(bool as_2008) : as_2008_(as_2008) {}

    // The pen was lifted: what comes next does not close what came before.
    void lift();
    // True: the point closed a polygon. Points that are the same as the one before, or not finite, do
    // nothing.
    bool add(Vec3 point);
    // The points of the polygon that was closed last, newest first.
    [[nodiscard]] const std::vector<Vec3>& polygon() const { return polygon_; }

 private:
    struct Cell {
        double x, y, z;
        bool operator==(const Cell&) const = default;
    };
    struct CellHash {
        std::size_t operator()(const Cell& cell) const;
    };
    // Indices into the run, oldest first, as a list: `older` and `newer` of its points.
    struct CellPoints {
        int oldest = -1, newest = -1;
    };
    struct Point {
        Vec3 at;
        int older = -1, newer = -1;
        bool listed = false;  // in its cell
    };
    enum class Loop { askew, on_a_line, flat };

    [[nodiscard]] const Vec3& run(int i) const { return run_[static_cast<std::size_t>(i)].at; }
    void push(Vec3 point, bool list);
    void pop();
    // Of the points in the run that are the same; -1: none.
    [[nodiscard]] int oldest_same(Vec3 point) const;
    // What run points oldest … newest are, of which there are at least three.
    [[nodiscard]] Loop loop(int oldest, int newest);
    [[nodiscard]] Loop loop_of_2008(int oldest, int newest);
    // Whether all lie in the plane.
    [[nodiscard]] bool all_in_plane(int oldest, int newest, Vec3 on, Vec3 normal);

    bool as_2008_;
    std::vector<Point> run_;
    std::unordered_map<Cell, CellPoints, CellHash> cells_;
    std::vector<Vec3> polygon_;
    // The run's point that last lay off a plane. It is looked at first: a drawing that comes back to one
    // place again and again fails at the same point, and would else be walked through each time.
    int odd_one_ = -1;
};

}  // namespace popup::flatlang
