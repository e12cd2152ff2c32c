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
// Where the newest three lie on a line, the next point that does not tells the plane. Then ways that only go
// there and back count as not gone: a polygon has no such points, and a loop that is nothing else is none;
// its points stay in the run, so that later ones may close there, but no polygon that holds all of it has
// them. A loop that lies on one line leaves the run and is none.
//
// With as_2008 the plane is that of the newest three in any case. On a line these have none, or one that
// rounding chooses, and so loops that lie askew and such that enclose nothing may become polygons.
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
        Vec3 swept;        // twice the area that the run has swept about its beginning, as a normal
        double way = 0;    // length of the run up to here
        int back_at = -1;  // the older point at this place, when the way since then only went there and back
        int older = -1, newer = -1;
        bool listed = false;  // in its cell
    };
    enum class Loop { none, there_and_back, on_a_line, flat };

    [[nodiscard]] const Vec3& run(int i) const { return run_[static_cast<std::size_t>(i)].at; }
    void push(Vec3 point, bool list, int back_at = -1);
    void pop();
    // Of the points in the run that are the same; -1: none.
    [[nodiscard]] int oldest_same(Vec3 point) const;
    // The point before `i` in the loop that begins at `oldest`; below `oldest` there is none.
    [[nodiscard]] int before(int i, int oldest) const;
    // What the loop from run point `newest` back to `oldest` is; when it is flat, polygon_ holds its points.
    [[nodiscard]] Loop loop(int oldest, int newest);
    [[nodiscard]] Loop loop_of_2008(int oldest, int newest);
    void gather(int oldest, int newest);
    [[nodiscard]] bool encloses_something(int oldest, int newest) const;
    // Whether `i` and all older points of the loop lie in the plane.
    [[nodiscard]] bool all_in_plane(int oldest, int i, Vec3 on, Vec3 normal);

    bool as_2008_;
    std::vector<Point> run_;
    std::unordered_map<Cell, CellPoints, CellHash> cells_;
    std::vector<Vec3> polygon_;
    // A point of the run, part of all loops that go back to it, that lay off a plane. It is looked at first:
    // a drawing that comes back to one place again and again fails at the same point, and would else be
    // walked through each time.
    int odd_one_ = -1;
};

}  // namespace popup::flatlang
