#include "output/later_covers.h"

#include <utility>

#include "base/geometry/edge_index.h"

namespace popup {

std::vector<std::vector<int>> later_covers(std::span<const PaintedBox> boxes) {
    // A box is found through its diagonal, whose box is the same.
    std::vector<Segment> diagonals;
    diagonals.reserve(boxes.size());
    for (const PaintedBox& painted : boxes) diagonals.push_back({painted.box.min, painted.box.max});
    const EdgeIndex index(std::move(diagonals));
    std::vector<std::vector<int>> result(boxes.size());
    std::vector<int> found;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        index.query(boxes[i].box, found);
        for (const int other : found) {
            const auto j = static_cast<std::size_t>(other);
            if (j > i && boxes[j].covers) result[i].push_back(other);
        }
    }
    return result;
}

}  // namespace popup
