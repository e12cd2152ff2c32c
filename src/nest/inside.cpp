#include "nest/inside.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace popup {
namespace {

int side_of(GridPoint a, GridPoint b, GridPoint c) {
    const Wide value = cross(b - a, c - a);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

bool is_between(GridPoint a, GridPoint p, GridPoint b) {
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
}

// The edges of a region in a tree. Edges that follow each other on a ring lie near each other, so a node is a
// run of them: all it has to know is its box, and where it begins and ends. Coordinates are doubled, so that
// the middle of an edge is a point, too.
class EdgeTree {
 public:
    explicit EdgeTree(const GridRegion& region) {
        std::vector<int> rings{add_ring(region.outer)};
        for (const GridRing& hole : region.holes) rings.push_back(add_ring(hole));
        root_ = join(rings, 0, rings.size());
    }

    // 1: in the region, 0: on an edge of it, -1: outside.
    [[nodiscard]] int where(GridPoint p) const {
        int winding = 0;
        if (is_on_edge(root_, p, winding)) return 0;
        return winding > 0 ? 1 : -1;
    }

    // Whether the edge lies in the region.
    [[nodiscard]] bool holds(GridPoint p, GridPoint q) const {
        return !is_crossed(root_, p, q) && where({(p.x + q.x) / 2, (p.y + q.y) / 2}) >= 0;
    }

 private:
    struct Edge {
        GridPoint a, b;
    };
    struct Node {
        GridBox box;
        GridPoint begin, end;  // of the run; those of whole rings are the same
        int first, last;  // of a leaf: its edges, up to but not with the last; else: its two nodes, and -1
        int other;
    };
    static constexpr std::size_t kLeaf = 8;  // edges

    int add_ring(const GridRing& ring) {
        const std::size_t first = edges_.size();
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const GridPoint a = ring[i];
            const GridPoint b = ring[(i + 1) % ring.size()];
            edges_.push_back({a + a, b + b});
        }
        return add_run(first, edges_.size());
    }

    int add_run(std::size_t first, std::size_t last) {
        if (last - first > kLeaf) {
            const std::size_t middle = first + (last - first) / 2;
            const int one = add_run(first, middle);
            return add_both(one, add_run(middle, last));
        }
        Node node{{}, edges_[first].a, edges_[last - 1].b, static_cast<int>(first), static_cast<int>(last),
                  -1};
        for (std::size_t e = first; e < last; ++e) {
            node.box.extend(edges_[e].a);
            node.box.extend(edges_[e].b);
        }
        nodes_.push_back(node);
        return static_cast<int>(nodes_.size()) - 1;
    }

    int join(const std::vector<int>& rings, std::size_t first, std::size_t last) {
        if (last - first == 1) return rings[first];
        const std::size_t middle = first + (last - first) / 2;
        const int one = join(rings, first, middle);
        const int both = add_both(one, join(rings, middle, last));
        nodes_[index(both)].end = nodes_[index(both)].begin;
        return both;
    }

    int add_both(int one, int other) {
        const Node& a = nodes_[index(one)];
        const Node& b = nodes_[index(other)];
        Node node{a.box, a.begin, b.end, one, -1, other};
        node.box.extend({b.box.x0, b.box.y0});
        node.box.extend({b.box.x1, b.box.y1});
        nodes_.push_back(node);
        return static_cast<int>(nodes_.size()) - 1;
    }

    // How often what runs from a to b goes up past the level of p, less how often it goes down.
    static int ups(GridPoint a, GridPoint b, GridPoint p) {
        return (a.y <= p.y ? 1 : 0) - (b.y <= p.y ? 1 : 0);
    }

    // Whether p lies on an edge of the node. If not, adds how often the node's edges right of p go up.
    [[nodiscard]] bool is_on_edge(int at, GridPoint p, int& winding) const {
        const Node& node = nodes_[index(at)];
        const GridBox& box = node.box;
        if (p.y < box.y0 || p.y > box.y1 || p.x > box.x1) return false;
        if (p.x < box.x0) {
            winding += ups(node.begin, node.end, p);
            return false;
        }
        if (node.last < 0) return is_on_edge(node.first, p, winding) || is_on_edge(node.other, p, winding);
        for (int e = node.first; e < node.last; ++e) {
            const auto& [a, b] = edges_[index(e)];
            const int side = side_of(a, b, p);
            if (side == 0 && is_between(a, p, b)) return true;
            // Right of p: an edge that goes up has p on its left.
            if (side == ups(a, b, p)) winding += side;
        }
        return false;
    }

    // Whether an edge of the node crosses p–q, or a corner of it lies between them.
    [[nodiscard]] bool is_crossed(int at, GridPoint p, GridPoint q) const {
        const Node& node = nodes_[index(at)];
        if (!may_touch(node.box, p, q)) return false;
        if (node.last < 0) return is_crossed(node.first, p, q) || is_crossed(node.other, p, q);
        for (int e = node.first; e < node.last; ++e) {
            const auto& [a, b] = edges_[index(e)];
            const int at_a = side_of(p, q, a);
            if (at_a == 0) {
                if (a != p && a != q && is_between(p, a, q)) return true;
            } else if (at_a * side_of(p, q, b) < 0 && side_of(a, b, p) * side_of(a, b, q) < 0) {
                return true;
            }
        }
        return false;
    }

    static bool may_touch(const GridBox& box, GridPoint p, GridPoint q) {
        if (std::max(p.x, q.x) < box.x0 || std::min(p.x, q.x) > box.x1 || std::max(p.y, q.y) < box.y0 ||
            std::min(p.y, q.y) > box.y1) {
            return false;
        }
        // All corners of the box on one side of the line: the one that is furthest along each of its normals.
        const bool rises = (p.x < q.x) == (p.y < q.y);
        const GridPoint one{box.x0, rises ? box.y1 : box.y0};
        const GridPoint other{box.x1, rises ? box.y0 : box.y1};
        return side_of(p, q, one) * side_of(p, q, other) <= 0;
    }

    std::vector<Edge> edges_;
    std::vector<Node> nodes_;
    int root_ = 0;
};

}  // namespace

bool is_inside(const GridRegion& region, const GridRegion& other) {
    const EdgeTree tree(other);
    const auto is_held = [&](const GridRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const GridPoint p = ring[i];
            const GridPoint q = ring[(i + 1) % ring.size()];
            if (!tree.holds(p + p, q + q)) return false;
        }
        return true;
    };
    if (!is_held(region.outer) || !std::all_of(region.holes.begin(), region.holes.end(), is_held))
        return false;
    // No edge crosses another, so a hole of the other is wholly inside the region or not at all.
    if (other.holes.empty()) return true;
    const EdgeTree own(region);
    return std::none_of(other.holes.begin(), other.holes.end(), [&](const GridRing& hole) {
        const auto off =
            std::find_if(hole.begin(), hole.end(), [&](GridPoint p) { return own.where(p + p) != 0; });
        return off != hole.end() && own.where(*off + *off) > 0;
    });
}

}  // namespace popup
