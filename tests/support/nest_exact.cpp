#include "support/nest_exact.h"

#include <CGAL/Arr_curve_data_traits_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <unordered_map>
#include <utility>

namespace popup::test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using EdgeList = std::vector<int>;  // edges of rings, by number, that lie on one edge of the arrangement
struct Join {
    EdgeList operator()(const EdgeList& a, const EdgeList& b) const {
        EdgeList both;
        std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        return both;
    }
};
using SegmentTraits = CGAL::Arr_segment_traits_2<Kernel>;
using Traits = CGAL::Arr_curve_data_traits_2<SegmentTraits, EdgeList, Join>;
using Arrangement = CGAL::Arrangement_2<Traits>;
using Face = Arrangement::Face_const_handle;
using Halfedge = Arrangement::Halfedge_const_handle;
using Circulator = Arrangement::Ccb_halfedge_const_circulator;

Kernel::Point_2 exact(GridSpot p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

// An edge of a ring: its piece, and +1 where it runs left to right (up where it is upright), else -1.
struct RingEdge {
    int piece = 0;
    int way = 0;
};

// How often each piece goes round a face, by piece; pieces that do not are left out.
using Windings = std::map<int, int>;

// The windings on the other side of this halfedge: its face lies on its left.
Windings across(const Halfedge& halfedge, Windings windings, const std::vector<RingEdge>& edges) {
    const int way = halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT ? 1 : -1;
    for (const int edge : halfedge->curve().data()) {
        const RingEdge& ring_edge = edges[static_cast<std::size_t>(edge)];
        int& winding = windings[ring_edge.piece];
        winding -= way * ring_edge.way;
        if (winding == 0) windings.erase(ring_edge.piece);
    }
    return windings;
}

template <class Visit>
void each_halfedge(const Face& face, const Visit& visit) {
    const auto round = [&](const Circulator first) {
        Circulator at = first;
        do visit(Halfedge(at));
        while (++at != first);
    };
    for (auto it = face->outer_ccbs_begin(); it != face->outer_ccbs_end(); ++it) round(*it);
    for (auto it = face->inner_ccbs_begin(); it != face->inner_ccbs_end(); ++it) round(*it);
}

// Area and box of a bounded face.
PieceOverlap measured(const Face& face) {
    PieceOverlap result;
    bool first = true;
    Kernel::FT twice = 0;
    each_halfedge(face, [&](const Halfedge& halfedge) {
        const auto& p = halfedge->source()->point();
        const auto& q = halfedge->target()->point();
        twice += p.x() * q.y() - p.y() * q.x();
        const double x = CGAL::to_double(p.x());
        const double y = CGAL::to_double(p.y());
        result.x0 = first ? x : std::min(result.x0, x);
        result.x1 = first ? x : std::max(result.x1, x);
        result.y0 = first ? y : std::min(result.y0, y);
        result.y1 = first ? y : std::max(result.y1, y);
        first = false;
    });
    result.area = 0.5 * CGAL::to_double(CGAL::exact(twice));
    return result;
}

void add(PieceOverlap& sum, const PieceOverlap& part) {
    sum.x0 = sum.area > 0.0 ? std::min(sum.x0, part.x0) : part.x0;
    sum.y0 = sum.area > 0.0 ? std::min(sum.y0, part.y0) : part.y0;
    sum.x1 = sum.area > 0.0 ? std::max(sum.x1, part.x1) : part.x1;
    sum.y1 = sum.area > 0.0 ? std::max(sum.y1, part.y1) : part.y1;
    sum.area += part.area;
}

}  // namespace

std::vector<PieceOverlap> piece_overlaps(const std::vector<PlacedPiece>& pieces) {
    std::vector<RingEdge> edges;
    std::vector<Traits::Curve_2> curves;
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
        for (const auto& ring : pieces[piece]) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const GridSpot from = ring[i];
                const GridSpot to = ring[(i + 1) % ring.size()];
                if (from == to) continue;
                curves.emplace_back(SegmentTraits::Curve_2(exact(from), exact(to)),
                                    EdgeList{static_cast<int>(edges.size())});
                edges.push_back({static_cast<int>(piece), from < to ? 1 : -1});
            }
        }
    }
    Arrangement arrangement;
    CGAL::insert(arrangement, curves.begin(), curves.end());

    // From the outside, where no piece is, face by face.
    const Face outside = std::as_const(arrangement).unbounded_face();
    std::unordered_map<const Arrangement::Face*, Windings> known{{&*outside, {}}};
    std::deque<Face> open{outside};
    std::map<std::pair<int, int>, PieceOverlap> found;
    while (!open.empty()) {
        const Face face = open.front();
        open.pop_front();
        const Windings here = known.at(&*face);
        std::vector<int> covering;
        for (const auto& [piece, winding] : here) {
            if (winding > 0) covering.push_back(piece);
        }
        if (covering.size() > 1) {
            const PieceOverlap part = measured(face);
            for (std::size_t i = 0; i < covering.size(); ++i) {
                for (std::size_t k = i + 1; k < covering.size(); ++k) {
                    add(found[{covering[i], covering[k]}], part);
                }
            }
        }
        each_halfedge(face, [&](const Halfedge& halfedge) {
            const Face other = halfedge->twin()->face();
            if (known.contains(&*other)) return;
            known.emplace(&*other, across(halfedge, here, edges));
            open.push_back(other);
        });
    }
    std::vector<PieceOverlap> result;
    for (auto& [pair, overlap] : found) {
        overlap.a = pair.first;
        overlap.b = pair.second;
        result.push_back(overlap);
    }
    return result;
}

bool closer_than(GridSpot p, GridSpot from, GridSpot to, std::int64_t steps) {
    const Kernel::FT limit(static_cast<double>(steps));
    const auto squared = from == to
                             ? CGAL::squared_distance(exact(p), exact(from))
                             : CGAL::squared_distance(exact(p), Kernel::Segment_2(exact(from), exact(to)));
    return squared < limit * limit;
}

}  // namespace popup::test
