#include "base/geometry/edge_index.h"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <iterator>
#include <utility>

namespace popup {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::d2::point_xy<double>;
using TreeBox = bg::model::box<TreePoint>;
using Entry = std::pair<TreeBox, int>;

TreeBox box_of(const Segment& s) {
    return {{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)},
            {std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)}};
}

// Gives `use` the numbers of all segments whose boxes touch the box: of those in the tree, in any order, or,
// where there is none, of all that there are, in theirs. No list is made of them.
template <typename Tree, typename Use>
void visit(const Tree* tree, const std::vector<Segment>& segments, const Box& box, const Use& use) {
    if (tree != nullptr) {
        const TreeBox window{{box.min.x, box.min.y}, {box.max.x, box.max.y}};
        tree->entries.query(
            bg::index::intersects(window),
            boost::make_function_output_iterator([&use](const Entry& entry) { use(entry.second); }));
        return;
    }
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment& s = segments[i];
        if (std::max(s.a.x, s.b.x) >= box.min.x && std::min(s.a.x, s.b.x) <= box.max.x &&
            std::max(s.a.y, s.b.y) >= box.min.y && std::min(s.a.y, s.b.y) <= box.max.y)
            use(static_cast<int>(i));
    }
}

}  // namespace

struct EdgeIndex::Tree {
    bg::index::rtree<Entry, bg::index::linear<8>> entries;
};

EdgeIndex::EdgeIndex(std::vector<Segment> boundary, std::span<const Segment> lines)
    : segments_(std::move(boundary)), state_(segments_.size(), State::boundary) {
    segments_.insert(segments_.end(), lines.begin(), lines.end());
    state_.resize(segments_.size(), State::line);
    for (const Segment& s : segments_) {
        box_.extend(s.a);
        box_.extend(s.b);
    }
    grow_tree();
}

EdgeIndex::EdgeIndex(EdgeIndex&&) noexcept = default;
EdgeIndex& EdgeIndex::operator=(EdgeIndex&&) noexcept = default;
EdgeIndex::~EdgeIndex() = default;

void EdgeIndex::grow_tree() {
    // A few segments are looked through faster than a tree is built.
    constexpr std::size_t kFew = 48;
    if (tree_ || segments_.size() <= kFew) return;
    std::vector<Entry> entries;
    entries.reserve(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        if (state_[i] != State::removed) entries.emplace_back(box_of(segments_[i]), static_cast<int>(i));
    }
    tree_ = std::make_unique<Tree>();
    tree_->entries = decltype(tree_->entries)(entries);  // bulk loading packs the tree
}

void EdgeIndex::insert(const Segment& segment, bool boundary) {
    if (tree_) tree_->entries.insert({box_of(segment), size()});
    segments_.push_back(segment);
    state_.push_back(boundary ? State::boundary : State::line);
    box_.extend(segment.a);
    box_.extend(segment.b);
    grow_tree();
}

void EdgeIndex::remove(int number) {
    state_[static_cast<std::size_t>(number)] = State::removed;
    if (tree_) tree_->entries.remove(Entry{box_of((*this)[number]), number});
}

void EdgeIndex::query(const Box& box, std::vector<int>& found) const {
    found.clear();
    if (box.empty()) return;
    visit(tree_.get(), segments_, box, [&](int number) {
        if (state_[static_cast<std::size_t>(number)] != State::removed) found.push_back(number);
    });
    if (tree_) std::sort(found.begin(), found.end());
}

double EdgeIndex::clearance(Vec2 p, double limit) const {
    // Without a tree every question costs a look at all segments: ask once.
    for (double radius = tree_ ? limit / 16.0 : limit;; radius = std::min(2.0 * radius, limit)) {
        double best = limit;
        visit(tree_.get(), segments_, {p - Vec2{radius, radius}, p + Vec2{radius, radius}}, [&](int number) {
            if (state_[static_cast<std::size_t>(number)] != State::removed)
                best = std::min(best, distance(p, (*this)[number]));
        });
        if (best <= radius || radius >= limit) return best;
    }
}

bool EdgeIndex::is_within(Vec2 p, double limit) const {
    // There are few in the box: to look at all costs less than to stop at one.
    bool is_near = false;
    visit(tree_.get(), segments_, {p - Vec2{limit, limit}, p + Vec2{limit, limit}}, [&](int number) {
        is_near = is_near || (state_[static_cast<std::size_t>(number)] != State::removed &&
                              distance(p, (*this)[number]) < limit);
    });
    return is_near;
}

int EdgeIndex::winding(Vec2 p) const {
    if (box_.empty()) return 0;
    // The ray runs across the drawing's shorter side, so that rows and columns of small parts stay cheap.
    const bool across = box_.width() > box_.height();
    const Box ray = across ? Box{{p.x, p.y}, {p.x, std::max(p.y, box_.max.y)}}
                           : Box{{p.x, p.y}, {std::max(p.x, box_.max.x), p.y}};
    int turns = 0;
    visit(tree_.get(), segments_, ray, [&](int number) {
        if (state_[static_cast<std::size_t>(number)] != State::boundary) return;
        const Segment& s = (*this)[number];
        const double side = cross(s.b - s.a, p - s.a);
        const bool a_below = across ? s.a.x >= p.x : s.a.y <= p.y;
        const bool b_below = across ? s.b.x >= p.x : s.b.y <= p.y;
        if (a_below && !b_below && side > 0.0) ++turns;
        if (!a_below && b_below && side < 0.0) --turns;
    });
    return turns;
}

std::vector<Segment> edges_of(const Polygon& polygon) {
    std::vector<Segment> edges;
    const auto take = [&edges](const Ring& ring, bool counter_clockwise) {
        const bool turn = (signed_area(ring) < 0.0) == counter_clockwise;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::size_t next = i + 1 == ring.size() ? 0 : i + 1;
            if (ring[i] == ring[next]) continue;
            edges.push_back(turn ? Segment{ring[next], ring[i]} : Segment{ring[i], ring[next]});
        }
    };
    if (!polygon.outer.empty()) take(polygon.outer, true);
    for (const Ring& hole : polygon.holes) {
        if (!hole.empty()) take(hole, false);
    }
    return edges;
}

}  // namespace popup
