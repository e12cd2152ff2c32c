#include "input/drawing/card/boundary.h"

#include <algorithm>
#include <set>

#include "popup/geometry.h"

namespace popup::drawing::card {

std::vector<int> outer_boundary(const SheetGraph& graph, const std::vector<int>& faces) {
    const std::set<int> inside(faces.begin(), faces.end());
    const auto is_border = [&](int half) {
        return inside.count(graph.face_of(half)) > 0 && inside.count(graph.face_of(half ^ 1)) == 0;
    };
    std::set<int> seen;
    std::vector<int> best;
    double most = 0.0;
    for (const int face : faces) {
        for (const int first : graph.halves_of(face)) {
            if (!is_border(first) || seen.count(first) > 0) continue;
            std::vector<int> loop;
            Ring ring;
            for (int half = first; seen.insert(half).second;) {
                loop.push_back(half);
                ring.push_back(graph.at(graph.from(half)));
                half = graph.next(half);
                while (!is_border(half)) half = graph.next(half ^ 1);
            }
            const double area = signed_area(ring);
            if (area <= most) continue;
            most = area;
            best = std::move(loop);
        }
    }
    return best;
}

}  // namespace popup::drawing::card
