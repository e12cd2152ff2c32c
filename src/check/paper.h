// The paper as it is while elements are put on it: where plates end, what has been cut out, where seams and
// glued areas lie.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "mechanism/element.h"
#include "popup/geometry.h"

namespace popup {

// Grows with the skeleton; each question looks only at what lies near. Cost a question: logarithmic in the
// page's edges, linear in those near.
class PaperMap {
 public:
    explicit PaperMap(const Tolerances& tolerances) : tolerances_(tolerances) {}

    // Takes in the plates, cut-outs, seams and glued areas that were added to the skeleton since the last
    // call; `owner` is the number of the structure that made them, or -1 for the page.
    void update(const Skeleton& skeleton, int owner);

    // See PaperQuery. `line` is the parent fold on that side's page; edges along it are no obstacle, nor are
    // edges along `open`, if it is given. Seams along the line are none where the fold is a seam itself; else
    // something else is glued there.
    [[nodiscard]] bool may_cut(int plate, int page, const DirectedLine& line, bool is_seam,
                               const Ring& footprint, Fit fit, const Segment* open = nullptr) const;
    [[nodiscard]] std::optional<Segment> edge_along(int plate, int page, const Segment& at) const;
    // See PaperQuery::paper. Canonical, as base/geometry/regions.h has it.
    [[nodiscard]] std::vector<Polygon> paper_near(int plate, int page, double inset, const Box& near) const;
    // The glued areas on the page whose boxes touch the box, by their numbers in the skeleton's draft.
    [[nodiscard]] std::vector<int> glued_near(int page, const Box& box) const;
    // Whether a seam, or the border of a glued area, lies on the page within or on the ring.
    [[nodiscard]] bool seam_near(int page, const Ring& ring) const;
    // Whether nothing ends, is cut or is glued on the page in the box, edges of it included: each plate has
    // paper under all of the box, or under nothing of it.
    [[nodiscard]] bool is_clear(int page, const Box& box) const;
    // Whether the point (page coordinates) lies on the plate, off what has been cut out of it.
    [[nodiscard]] bool has_paper(int plate, int page, Vec2 at) const;
    // The narrowest paper, below `below` mm, between the ring and a hole through the page that it does not
    // meet. Cost: near linear in the ring's edges, as long as few others are near each.
    [[nodiscard]] std::optional<Pierced::Narrow> narrow_beside_hole(int page, const Ring& ring,
                                                                    double below) const;
    // The owners of what ends, is cut or is glued on the page within the ring, or too near to it; each
    // perhaps several times.
    void owners_near(int page, const Ring& ring, std::vector<int>& owners) const;
    // Without `line` no edge is passed over.
    [[nodiscard]] bool may_glue(int plate, int page, const DirectedLine* line, const Segment& seam,
                                Fit fit) const;

 private:
    struct Obstacle {
        int plate;
        bool seam;
        int owner;
        int hole;  // through the page: its number among `cuts`; -1: none
    };
    struct PageEdges {
        std::vector<Segment> edges;
        std::vector<Obstacle> obstacles;  // of each edge
        // Edges follow one another in rings: a few of them have one box in the tree. Diagonals of those, and
        // the first edge of each.
        EdgeIndex runs;
        std::vector<std::size_t> run_begins;
        EdgeIndex cut_boxes;  // diagonals of the cut-outs' boxes
        std::vector<std::pair<int, Ring>> cuts;
        EdgeIndex glued_boxes;  // diagonals of the glued areas' boxes, and their numbers
        std::vector<int> glued;

        // Numbers of the edges whose boxes touch the box, in ascending order.
        void query(const Box& box, std::vector<int>& found) const;
    };
    // Edges that lie together, of a ring for example.
    void add(int page, std::span<const Segment> edges, int plate, bool seam, int hole = -1);
    PageEdges& page(int number);

    Tolerances tolerances_;
    std::vector<PageEdges> pages_;
    std::vector<Polygon> outlines_;       // raw, of each plate
    std::vector<std::size_t> cuts_seen_;  // of each plate
    int owner_ = -1;                      // of what is taken in
    std::size_t folds_seen_ = 0;
    std::size_t areas_seen_ = 0, feet_seen_ = 0, holes_seen_ = 0;
};

}  // namespace popup
