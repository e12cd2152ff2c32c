// Segments found by where they are: what keeps "every edge near this one" from looking at every edge.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// Holds segments; they are known by their number, in the order they were put in. Answers are in ascending
// order and do not depend on how the index is built. Movable, not copyable.
class EdgeIndex {
 public:
    // `boundary` are edges of closed rings, which count for winding(); `lines`, numbered after them, are not.
    explicit EdgeIndex(std::vector<Segment> boundary = {}, std::span<const Segment> lines = {});
    EdgeIndex(EdgeIndex&&) noexcept;
    EdgeIndex& operator=(EdgeIndex&&) noexcept;
    ~EdgeIndex();

    // Adds one segment. `boundary`: it is an edge of a closed ring, all of whose edges are put in.
    void insert(const Segment& segment, bool boundary);
    // Takes one segment out of all later answers. Its number is not used again.
    void remove(int number);

    [[nodiscard]] const Segment& operator[](int number) const {
        return segments_[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] int size() const { return static_cast<int>(segments_.size()); }

    // Numbers of the segments whose boxes touch the box.
    void query(const Box& box, std::vector<int>& found) const;
    // Distance from p to the nearest segment, or `limit` when none is nearer.
    [[nodiscard]] double clearance(Vec2 p, double limit) const;
    // Whether a segment is nearer to p than `limit`: clearance(p, limit) < limit, but ends at the first one.
    [[nodiscard]] bool is_within(Vec2 p, double limit) const;
    // How often the boundary segments run counter-clockwise round p. For p on an edge: either side's answer.
    // Cost: the number of segments level with p (or, in wide drawings, above and below it).
    [[nodiscard]] int winding(Vec2 p) const;

 private:
    enum class State : char { line, boundary, removed };
    struct Tree;
    void grow_tree();

    std::vector<Segment> segments_;
    std::vector<State> state_;
    std::unique_ptr<Tree> tree_;  // none while there are only a few
    Box box_;
};

// All edges of a polygon, the outer ring's counter-clockwise, then each hole's clockwise, however they were
// given. Doubled corners make no edge.
std::vector<Segment> edges_of(const Polygon& polygon);

}  // namespace popup
