// No-fit polygons of pairs of shapes, as convex parts.
//
// A shape A at a and a shape B at b overlap exactly when a - b lies inside one of the parts of their no-fit
// polygon: for each part of A and each of B the Minkowski sum of B's part and A's part mirrored, which is
// convex. The depth of a place inside a part is its distance from the part's nearest edge: how far A must
// move, along that edge's normal, to leave it. Parts are open: touching is not overlapping, and a slot that A
// fits exactly stays a line between parts, which the union of the parts would lose.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "nest/shapes.h"
#include "nest/two.h"

namespace popup {

// A part is its box, as far as that is inside the half planes of its slanted edges. A side of the box is an
// edge that is upright or level, or where the part has none there, `slack` outside of its outermost corner.
//
// The half plane of a slanted edge with the normal (nx, ny), of length 1, has the points with
// nx x + ny y < c. It is kept as nx, c / nx and ny / nx: then a level line through y crosses its edge at
// c / nx - (ny / nx) y, without a division.
struct NoFitPart {
    double x0, y0, x1, y1;  // its box
    // Its planes, from `first` on in NoFit::planes: all their nx, then all c / nx, then all ny / nx. They
    // come by the direction of their edges, of the eighths 1, 3, 5, 7 of PartEdge. After those of 3 and of 7
    // there is one more where else their count were odd, that all points are behind.
    std::uint32_t first;  // kNotMade: only the box is known
    std::uint32_t third;  // where those of 3 begin
    std::uint32_t half;   // where those of 5 begin; nx > 0 before
    std::uint32_t last;   // where those of 7 begin
    std::uint32_t count;

    static constexpr std::uint32_t kNotMade = 0xFFFFFFFFU;
    [[nodiscard]] bool is_made() const { return first != kNotMade; }
};

struct NoFit {
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;  // box of all parts
    std::vector<NoFitPart> parts;
    std::vector<double> planes;
};

// The no-fit polygon of a moving about b at rest. Edges that are neither upright nor level are moved out by
// `slack` steps: room for the rounding of places, where touching need not be exact.
void make_no_fit(const TurnedShape& a, const TurnedShape& b, double slack, NoFit& result);
// The same in two steps, since most lines and places meet few of the boxes: first the boxes of all parts,
// then what else there is of one part, by its number, where that is not made yet.
void make_boxes(const TurnedShape& a, const TurnedShape& b, double slack, NoFit& result);
void make_part(const TurnedShape& a, const TurnedShape& b, double slack, std::size_t part, NoFit& result);

// How deep (x, y) is in a part that is made: the least distance from an edge, and negative outside.
inline double depth_in(const NoFit& fit, const NoFitPart& part, double x, double y) {
    const double* nx = fit.planes.data() + part.first;
    const double* at_zero = nx + part.count;
    const double* slope = at_zero + part.count;
    const Two place = Two::of(x, y);
    Two depth = lesser(place - Two::of(part.x0, part.y0), Two::of(part.x1, part.y1) - place);
    const Two at_x = Two::alike(x);
    const Two at_y = Two::alike(y);
    for (std::uint32_t i = 0; i < part.count; i += 2) {
        const Two edge = Two::at(at_zero + i) - Two::at(slope + i) * at_y;
        depth = lesser(depth, Two::at(nx + i) * (edge - at_x));
    }
    return depth.least();
}

// Whether all places of a box overlap, its edges too. All parts are made. A no may be wrong where many small
// parts make it up. Cost: a few looks at all parts where it is plain, some thousand at the most.
struct NoFitBox {
    double x0, y0, x1, y1;
};
bool covers(const NoFit& fit, const NoFitBox& box, int cuts = 0);

// The no-fit polygons of all pairs of shapes, each made when first asked for. They are kept if all would take
// no more than `kMostBytes`; else they are made each time. May be used by several threads at once.
class NoFitTable {
 public:
    static constexpr double kMostBytes = 180e6;

    // Precondition: the shapes outlive the table.
    NoFitTable(const std::vector<TurnedShape>& shapes, double slack);
    ~NoFitTable();
    NoFitTable(const NoFitTable&) = delete;
    NoFitTable& operator=(const NoFitTable&) = delete;

    [[nodiscard]] bool keeps() const { return !table_.empty(); }
    // Precondition: keeps().
    [[nodiscard]] const NoFit& of(int a, int b) {
        const NoFit* made = table_[index(a, b)].load(std::memory_order_acquire);
        return made != nullptr ? *made : keep(a, b);
    }
    void make(int a, int b, NoFit& result) const;
    void make_boxes(int a, int b, NoFit& result) const;
    void make_part(int a, int b, std::size_t part, NoFit& result) const;

 private:
    [[nodiscard]] std::size_t index(int a, int b) const {
        return static_cast<std::size_t>(a) * shapes_.size() + static_cast<std::size_t>(b);
    }
    const NoFit& keep(int a, int b);

    const std::vector<TurnedShape>& shapes_;
    double slack_;
    std::vector<std::atomic<const NoFit*>> table_;
};

}  // namespace popup
