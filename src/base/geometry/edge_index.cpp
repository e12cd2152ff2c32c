#include "base/geometry/edge_index.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace popup {
namespace {

constexpr std::size_t kGroup = 8;  // boxes of a group
// A few segments are looked through faster than a tree is built.
constexpr std::size_t kFew = 32;

Box box_of(const Segment& s) {
    return {{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)},
            {std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)}};
}

bool touch(const Box& a, const Box& b) {
    return a.max.x >= b.min.x && a.min.x <= b.max.x && a.max.y >= b.min.y && a.min.y <= b.max.y;
}

// Which of 2^16 strips of equal width a coordinate lies in.
std::uint32_t strip(double at, double low, double width) {
    const double share = (at - low) / width * 65536.0;
    if (!(share > 0.0)) return 0;
    return share < 65535.0 ? static_cast<std::uint32_t>(share) : 65535U;
}

// Where a cell of a square of 2^16 by 2^16 comes on Hilbert's curve, which passes through neighbours one
// after another.
std::uint32_t on_hilbert_curve(std::uint32_t x, std::uint32_t y) {
    std::uint32_t at = 0;
    for (std::uint32_t side = 1U << 15U; side > 0; side >>= 1U) {
        const bool right = (x & side) != 0;
        const bool upper = (y & side) != 0;
        at = 4U * at + (right ? (upper ? 2U : 3U) : (upper ? 1U : 0U));
        if (upper) continue;
        if (right) {
            x = ~x;
            y = ~y;
        }
        std::swap(x, y);
    }
    return at;
}

}  // namespace

EdgeIndex::EdgeIndex(std::vector<Segment> boundary, std::span<const Segment> lines)
    : segments_(std::move(boundary)), state_(segments_.size(), State::boundary) {
    segments_.insert(segments_.end(), lines.begin(), lines.end());
    state_.resize(segments_.size(), State::line);
    for (const Segment& s : segments_) {
        box_.extend(s.a);
        box_.extend(s.b);
    }
    grow_trees();
}

EdgeIndex::Tree EdgeIndex::tree_of(std::size_t first, std::size_t last) const {
    struct Entry {
        std::uint32_t along;
        int number;
    };
    std::vector<Entry> entries;
    entries.reserve(last - first);
    const double width = std::max(box_.width(), box_.height());
    for (std::size_t i = first; i < last; ++i) {
        if (state_[i] == State::removed) continue;
        const Vec2 middle = 0.5 * (segments_[i].a + segments_[i].b);
        entries.push_back(
            {on_hilbert_curve(strip(middle.x, box_.min.x, width), strip(middle.y, box_.min.y, width)),
             static_cast<int>(i)});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& p, const Entry& q) {
        return p.along != q.along ? p.along < q.along : p.number < q.number;
    });
    Tree tree{first, last, {}, {}, {0}};
    tree.order.reserve(entries.size());
    tree.boxes.reserve(entries.size() + entries.size() / (kGroup - 1) + 16);
    for (const Entry& entry : entries) {
        tree.order.push_back(entry.number);
        tree.boxes.push_back(box_of((*this)[entry.number]));
    }
    tree.levels.push_back(tree.boxes.size());
    for (std::size_t low = 0; tree.boxes.size() - low > kGroup; low = tree.levels[tree.levels.size() - 2]) {
        const std::size_t high = tree.boxes.size();
        for (std::size_t i = low; i < high; i += kGroup) {
            Box group = tree.boxes[i];
            for (std::size_t k = i + 1; k < std::min(i + kGroup, high); ++k) {
                group.extend(tree.boxes[k].min);
                group.extend(tree.boxes[k].max);
            }
            tree.boxes.push_back(group);
        }
        tree.levels.push_back(tree.boxes.size());
    }
    return tree;
}

// Trees of at most half the size of the one before them: their number stays that of the doublings, and each
// segment is put into another tree as seldom.
void EdgeIndex::grow_trees() {
    if (segments_.size() - in_trees_ <= kFew) return;
    std::size_t first = in_trees_;
    while (!trees_.empty() && trees_.back().last - trees_.back().first < 2 * (segments_.size() - first)) {
        first = trees_.back().first;
        trees_.pop_back();
    }
    trees_.push_back(tree_of(first, segments_.size()));
    in_trees_ = segments_.size();
}

void EdgeIndex::insert(const Segment& segment, bool boundary) {
    segments_.push_back(segment);
    state_.push_back(boundary ? State::boundary : State::line);
    box_.extend(segment.a);
    box_.extend(segment.b);
    grow_trees();
}

void EdgeIndex::remove(int number) { state_[static_cast<std::size_t>(number)] = State::removed; }

template <class Use>
void EdgeIndex::visit(const Box& box, const Use& use) const {
    struct Group {
        std::size_t level, from;
    };
    // A group leaves at most kGroup - 1 others waiting on each of the few levels that 2^31 segments have.
    std::array<Group, kGroup * 12> waiting;
    for (const Tree& tree : trees_) {
        std::size_t open = 0;
        const std::size_t top = tree.levels.size() - 2;
        waiting[open++] = {top, tree.levels[top]};
        while (open > 0) {
            const auto [level, from] = waiting[--open];
            const std::size_t to = std::min(from + kGroup, tree.levels[level + 1]);
            for (std::size_t i = from; i < to; ++i) {
                if (!touch(tree.boxes[i], box)) continue;
                if (level > 0) {
                    waiting[open++] = {level - 1, tree.levels[level - 1] + kGroup * (i - tree.levels[level])};
                } else if (state_[static_cast<std::size_t>(tree.order[i])] != State::removed &&
                           !use(tree.order[i])) {
                    return;
                }
            }
        }
    }
    for (std::size_t i = in_trees_; i < segments_.size(); ++i) {
        if (state_[i] != State::removed && touch(box_of(segments_[i]), box) && !use(static_cast<int>(i)))
            return;
    }
}

void EdgeIndex::query(const Box& box, std::vector<int>& found) const {
    found.clear();
    if (box.empty()) return;
    visit(box, [&found](int number) {
        found.push_back(number);
        return true;
    });
    if (!trees_.empty()) std::sort(found.begin(), found.end());
}

double EdgeIndex::clearance(Vec2 p, double limit) const {
    std::vector<int> found;
    // Without a tree every question costs a look at all segments: ask once.
    for (double radius = trees_.empty() ? limit : limit / 16.0;; radius = std::min(2.0 * radius, limit)) {
        query({p - Vec2{radius, radius}, p + Vec2{radius, radius}}, found);
        double best = limit;
        for (const int number : found) best = std::min(best, distance(p, (*this)[number]));
        if (best <= radius || radius >= limit) return best;
    }
}

bool EdgeIndex::is_within(Vec2 p, double limit) const {
    bool within = false;
    visit({p - Vec2{limit, limit}, p + Vec2{limit, limit}}, [&](int number) {
        within = distance(p, (*this)[number]) < limit;
        return !within;
    });
    return within;
}

int EdgeIndex::winding(Vec2 p) const {
    if (box_.empty()) return 0;
    // The ray runs across the drawing's shorter side, so that rows and columns of small parts stay cheap.
    const bool across = box_.width() > box_.height();
    const Box ahead = across ? Box{{p.x, p.y}, {p.x, std::max(p.y, box_.max.y)}}
                             : Box{{p.x, p.y}, {std::max(p.x, box_.max.x), p.y}};
    int turns = 0;
    visit(ahead, [&](int number) {
        if (state_[static_cast<std::size_t>(number)] != State::boundary) return true;
        const Segment& s = (*this)[number];
        const double side = cross(s.b - s.a, p - s.a);
        const bool a_below = across ? s.a.x >= p.x : s.a.y <= p.y;
        const bool b_below = across ? s.b.x >= p.x : s.b.y <= p.y;
        if (a_below && !b_below && side > 0.0) ++turns;
        if (!a_below && b_below && side < 0.0) --turns;
        return true;
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
