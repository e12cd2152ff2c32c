#include "base/geometry/near_boxes.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace popup {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;

// The number of a box is a fourth direction of its tree, so that in a heap, too, the tree knows where the
// earlier ones are. Space counts more: what is apart in it is apart in the tree.
using NumberedPoint = bg::model::point<double, 4, bg::cs::cartesian>;
using NumberedBox = bg::model::box<NumberedPoint>;
constexpr double kApartByNumber = 1e-3;

NumberedBox numbered(const SpaceBox& box, double first, double last) {
    NumberedBox made;
    bg::set<bg::min_corner, 0>(made, box.low.x);
    bg::set<bg::min_corner, 1>(made, box.low.y);
    bg::set<bg::min_corner, 2>(made, box.low.z);
    bg::set<bg::min_corner, 3>(made, kApartByNumber * first);
    bg::set<bg::max_corner, 0>(made, box.high.x);
    bg::set<bg::max_corner, 1>(made, box.high.y);
    bg::set<bg::max_corner, 2>(made, box.high.z);
    bg::set<bg::max_corner, 3>(made, kApartByNumber * last);
    return made;
}

}  // namespace

std::vector<std::pair<int, int>> near_earlier(std::span<const SpaceBox> reached, std::size_t most_each) {
    std::vector<std::pair<NumberedBox, int>> boxes;
    boxes.reserve(reached.size());
    for (const SpaceBox& box : reached) {
        const int number = static_cast<int>(boxes.size());
        boxes.emplace_back(numbered(box, number, number), number);
    }
    const bg::index::rtree<std::pair<NumberedBox, int>, bg::index::rstar<16>> tree(boxes.begin(),
                                                                                   boxes.end());
    std::vector<std::pair<int, int>> pairs;
    for (int number = 1; number < static_cast<int>(boxes.size()); ++number) {
        const NumberedBox earlier = numbered(reached[static_cast<std::size_t>(number)], 0.0, number - 0.5);
        std::size_t left = most_each;
        for (auto it = tree.qbegin(bg::index::intersects(earlier)); left > 0 && it != tree.qend(); ++it) {
            pairs.emplace_back(it->second, number);
            --left;
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

std::vector<std::pair<int, int>> near_pairs(std::span<const SpaceBox> reached, std::size_t most) {
    std::vector<std::pair<TreeBox, int>> boxes;
    boxes.reserve(reached.size());
    for (const auto& [low, high] : reached) {
        boxes.emplace_back(TreeBox{{low.x, low.y, low.z}, {high.x, high.y, high.z}},
                           static_cast<int>(boxes.size()));
    }
    const bg::index::rtree<std::pair<TreeBox, int>, bg::index::rstar<16>> tree(boxes.begin(), boxes.end());
    std::vector<std::pair<int, int>> pairs;
    for (const auto& [box, number] : boxes) {
        for (auto it = tree.qbegin(bg::index::intersects(box)); it != tree.qend(); ++it) {
            if (it->second > number) pairs.emplace_back(number, it->second);
        }
        if (pairs.size() > most) break;
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace popup
