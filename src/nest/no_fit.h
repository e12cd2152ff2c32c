// No-fit polygons of pairs of shapes, as convex parts.
//
// A shape A at a and a shape B at b overlap exactly when a - b lies inside one of the parts of their no-fit
// polygon: for each part of A and each of B the Minkowski sum of B's part and A's part mirrored, which is
// convex. The depth of a place inside a part is its distance from the part's nearest edge: how far A must
// move, along that edge's normal, to leave it. Parts are open: touching is not overlapping, and a slot that A
// fits exactly stays a line between parts, which the union of the parts would lose.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "nest/shapes.h"

namespace popup {

// A half plane has the points with nx x + ny y < c, in steps of the grid; the normal has length 1.
struct NoFitPart {
    double x0, y0, x1, y1;  // its box
    std::uint32_t first;
    // Its planes, from `first` on in NoFit::planes: first all their nx, then all ny, then all c, each padded
    // to an even count by a plane that all points are behind. They come by the direction of the edges that
    // they stand for: those of edges of one of the eighths of PartEdge begin where `begins` says, and end
    // where the next begins.
    std::array<std::uint32_t, 9> begins;
    [[nodiscard]] std::uint32_t count() const { return begins[8]; }
    [[nodiscard]] std::uint32_t padded() const { return (count() + 1) & ~1U; }
};

struct NoFit {
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;  // box of all parts
    std::vector<NoFitPart> parts;
    std::vector<double> planes;
};

// The no-fit polygon of a moving about b at rest. Edges that are neither upright nor level are moved out by
// `slack` steps: room for the rounding of places, where touching need not be exact.
void make_no_fit(const TurnedShape& a, const TurnedShape& b, double slack, NoFit& result);

// Whether all places of a box overlap, its edges too. A no may be wrong where many small parts make it up.
// Cost: a few looks at all parts where it is plain, some thousand at the most.
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
