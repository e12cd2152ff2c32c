// Closed loops in the run of points that a turtle leaves.
#pragma once

#include <unordered_map>
#include <vector>

#include "popup/geometry.h"

namespace popup::flatlang {

// Points are given in the order in which they are drawn. When the newest is the same (less than 1e-4 inches
// apart on every axis) as one in the run, the points from the oldest such to the one before the newest are a
// loop. If it has at least three and all lie in the plane of the newest three (less than 1e-4 off it), they
// are a polygon and leave the run.
//
// The newest three may lie on a line. They have no plane then, or one that rounding chooses, so that loops
// that lie askew, and such that enclose nothing, may be polygons: so the language has it.
//
// Of a run with more than 200 different points in one cube of a thousandth of an inch, later ones there are
// not gone back to.
//
// Cost: near linear in points; what has left the run is forgotten.
class PolygonFinder {
 public:
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
        int count = 0;
    };
    struct Point {
        Vec3 at;
        int older = -1, newer = -1;
        bool listed = false;  // in its cell
    };

    [[nodiscard]] const Vec3& run(int i) const { return run_[static_cast<std::size_t>(i)].at; }
    void push(Vec3 point, bool list);
    void pop();
    // Of the points in the run that are the same; -1: none.
    [[nodiscard]] int oldest_same(Vec3 point) const;
    [[nodiscard]] bool is_flat_loop(int oldest, int newest);

    std::vector<Point> run_;
    std::unordered_map<Cell, CellPoints, CellHash> cells_;
    std::vector<Vec3> polygon_;
    // A point of the run, part of all loops that go back to it, that lay off a plane. It is looked at first:
    // a drawing that comes back to one place again and again fails at the same point, and would else be
    // walked through each time.
    int odd_one_ = -1;
};

}  // namespace popup::flatlang
