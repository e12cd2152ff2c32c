#include "motion/layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/near_boxes.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "motion/nearness.h"
#include "motion/sweep.h"

namespace popup {
namespace {

constexpr double kAreaMm2 = 1e-6;
constexpr double kCountStepsPerMm = 1e3;  // to which points are rounded where layers are counted
constexpr double kCountStepMm = 1e-3;
constexpr std::size_t kMostWork = 100'000'000;  // triangles seen over one another
constexpr double kRoundMm = 0.05;               // so far round what has changed all is looked at

Box grown(const Box& box, double mm) { return {box.min - Vec2{mm, mm}, box.max + Vec2{mm, mm}}; }

Box common(const Box& a, const Box& b) {
    return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
            {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

std::vector<double> numbers_of(const ClosedPlane& plane) {
    std::vector<double> numbers;
    for (const Vec3& v : {plane.origin, plane.x, plane.y, plane.up})
        numbers.insert(numbers.end(), {v.x, v.y, v.z});
    return numbers;
}

// Grows a box by a point and what is this near to it; in line, for it is done millions of times.
void extend(Box& box, Vec2 p, double mm) {
    box.min = {std::min(box.min.x, p.x - mm), std::min(box.min.y, p.y - mm)};
    box.max = {std::max(box.max.x, p.x + mm), std::max(box.max.y, p.y + mm)};
}

Box box_round(const Triangle2& t, double mm) {
    Box box;
    for (const Vec2 p : t) extend(box, p, mm);
    return box;
}

// What two triangles have in common: the one cut by each edge of the other, which runs counter-clockwise.
class Common {
 public:
    Common(const Triangle2& shape, const Triangle2& by) {
        std::copy(shape.begin(), shape.end(), corners_.begin());
        std::array<Vec2, kMost> cut;
        for (std::size_t i = 0; i < 3 && size_ > 0; ++i) {
            const Vec2 from = by.at(i);
            const Vec2 along = by.at((i + 1) % 3) - from;
            std::size_t kept = 0;
            double hp = cross(along, corners_[0] - from);
            for (std::size_t k = 0; k < size_; ++k) {
                const Vec2 p = corners_[k];
                const Vec2 q = corners_[k + 1 < size_ ? k + 1 : 0];
                const double hq = cross(along, q - from);
                if (hp >= 0.0) cut[kept++] = p;
                if ((hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0))
                    cut[kept++] = lerp(p, q, hp / (hp - hq));
                hp = hq;
            }
            std::copy_n(cut.begin(), kept, corners_.begin());
            size_ = kept;
        }
    }
    [[nodiscard]] std::span<const Vec2> corners() const { return {corners_.data(), size_}; }
    [[nodiscard]] bool has_area() const {
        if (size_ < 3) return false;
        double twice = cross(corners_[size_ - 1], corners_[0]);
        for (std::size_t i = 1; i < size_; ++i) twice += cross(corners_[i - 1], corners_[i]);
        return std::abs(0.5 * twice) >= kAreaMm2;
    }

 private:
    static constexpr std::size_t kMost = 3 * 2 * 2 * 2;  // each edge adds no more corners than there are
    std::array<Vec2, kMost> corners_;
    std::size_t size_ = 3;
};

// Whether the second triangle lies beside an edge of the first, which runs counter-clockwise: then they have
// no area in common, and most that are near each other have none.
bool beside(const Triangle2& first, const Triangle2& second) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 from = first.at(i);
        const Vec2 along = first.at((i + 1) % 3) - from;
        if (cross(along, second[0] - from) <= 0.0 && cross(along, second[1] - from) <= 0.0 &&
            cross(along, second[2] - from) <= 0.0)
            return true;
    }
    return false;
}

// How much is asked of counts: the more squares a grid has the more it tells, but they are all filled.
enum class Questions { few, many };

// How many of some boxes can lie over a point: those that touch its square of a grid.
class BoxCounts {
 public:
    BoxCounts() = default;
    BoxCounts(const EdgeIndex& diagonals, Questions questions) {
        Box all;
        for (int i = 0; i < diagonals.size(); ++i) {
            all.extend(diagonals[i].a);
            all.extend(diagonals[i].b);
        }
        if (all.empty()) return;
        const double boxes = diagonals.size() + 1;
        double squares = kLeastSquares * boxes;
        if (questions == Questions::many)
            squares = std::max(squares, std::min(kMostSquares * boxes, kSquares));
        origin_ = all.min;
        const double side =
            std::max(std::sqrt(all.width() * all.height() / squares), (all.width() + all.height()) / squares);
        if (side > 0.0) per_mm_ = 1.0 / side;
        columns_ = static_cast<std::size_t>(all.width() * per_mm_) + 1;
        rows_ = static_cast<std::size_t>(all.height() * per_mm_) + 1;
        // Each box adds one at its lower left square and takes it away beside it and above it; the sums from
        // the lower left are the counts.
        const std::size_t wide = columns_ + 1;
        std::vector<int> steps(wide * (rows_ + 1), 0);
        for (int i = 0; i < diagonals.size(); ++i) {
            const auto [low, high] = squares_of({diagonals[i].a, diagonals[i].b});
            ++steps[low.row * wide + low.column];
            --steps[low.row * wide + high.column + 1];
            --steps[(high.row + 1) * wide + low.column];
            ++steps[(high.row + 1) * wide + high.column + 1];
        }
        counts_.assign(columns_ * rows_, 0);
        for (std::size_t row = 0; row < rows_; ++row) {
            int sum = 0;
            for (std::size_t column = 0; column < columns_; ++column) {
                sum += steps[row * wide + column];
                counts_[row * columns_ + column] =
                    sum + (row > 0 ? counts_[(row - 1) * columns_ + column] : 0);
            }
        }
        block_columns_ = (columns_ + kBlock - 1) / kBlock;
        blocks_.assign(block_columns_ * ((rows_ + kBlock - 1) / kBlock), 0);
        for (std::size_t row = 0; row < rows_; ++row) {
            for (std::size_t column = 0; column < columns_; ++column) {
                int& most = blocks_[row / kBlock * block_columns_ + column / kBlock];
                most = std::max(most, counts_[row * columns_ + column]);
            }
        }
    }

    // Whether so many boxes, at least one, may lie over a point of the box.
    [[nodiscard]] bool may_reach(const Box& box, int least) const {
        if (counts_.empty()) return false;
        const auto [low, high] = squares_of(box);
        // Blocks that do not have so many anywhere are passed over.
        for (std::size_t row = low.row; row <= high.row;) {
            const std::size_t rows_end = std::min((row / kBlock + 1) * kBlock, high.row + 1);
            for (std::size_t column = low.column; column <= high.column;) {
                const std::size_t end = std::min((column / kBlock + 1) * kBlock, high.column + 1);
                if (blocks_[row / kBlock * block_columns_ + column / kBlock] >= least &&
                    has(least, row, rows_end, column, end))
                    return true;
                column = end;
            }
            row = rows_end;
        }
        return false;
    }

 private:
    // For each box.
    static constexpr double kLeastSquares = 64.0;
    static constexpr double kMostSquares = 1024.0;
    static constexpr double kSquares = 1 << 20;  // in all, unless there are many boxes
    static constexpr std::size_t kBlock = 8;     // squares to either side
    struct Square {
        std::size_t column, row;
    };
    [[nodiscard]] std::size_t strip(double at, std::size_t count) const {
        const double n = at * per_mm_;
        return n > 0.0 ? std::min(static_cast<std::size_t>(n), count - 1) : 0;
    }
    [[nodiscard]] Square square_of(Vec2 p) const {
        return {strip(p.x - origin_.x, columns_), strip(p.y - origin_.y, rows_)};
    }
    [[nodiscard]] std::pair<Square, Square> squares_of(const Box& box) const {
        return {square_of(box.min), square_of(box.max)};
    }

    [[nodiscard]] bool has(int least, std::size_t row, std::size_t rows_end, std::size_t column,
                           std::size_t columns_end) const {
        for (; row < rows_end; ++row) {
            const auto first = counts_.begin() + static_cast<std::ptrdiff_t>(row * columns_);
            if (std::any_of(first + static_cast<std::ptrdiff_t>(column),
                            first + static_cast<std::ptrdiff_t>(columns_end),
                            [least](int count) { return count >= least; }))
                return true;
        }
        return false;
    }

    Vec2 origin_;
    double per_mm_ = 1.0;  // squares
    std::size_t columns_ = 0, rows_ = 0, block_columns_ = 0;
    std::vector<int> counts_;
    std::vector<int> blocks_;  // the most of each block
};

bool before(Vec2 p, Vec2 q) { return std::tie(p.x, p.y) < std::tie(q.x, q.y); }

class LayerSearch {
 public:
    LayerSearch(const Assembly& assembly, std::span<const PlateShape> shapes, const ClosedPlane& plane)
        : shapes_(shapes), plane_(plane), frames_(assembly.plates.size()) {
        if (!place(assembly, Angle::degrees(least_opening(assembly.sweep)), frames_)) return;
        std::vector<Segment> diagonals;  // of the plates' boxes
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            Box box;
            for (const Vec2 p : shapes[i].hull) box.extend(plane_.flat(frames_[i].point(p)));
            if (box.empty()) box.extend({});
            diagonals.push_back({box.min, box.max});
        }
        boxes_ = EdgeIndex({}, diagonals);
        for (const Frame& frame : frames_) {
            const Vec3 n = frame.normal();
            slopes_.push_back({dot(n, frame.origin - plane_.origin), dot(n, plane_.x), dot(n, plane_.y),
                               dot(n, plane_.up)});
        }
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            std::vector<Triangle2>& triangles = seen_.emplace_back(shapes[i].core.all());
            for (Triangle2& t : triangles) t = seen(t, frames_[i]);
        }
    }

    // Looks at all. False: that was too much work, and nothing is known.
    bool look() {
        overlaps_.clear();
        regions_.clear();
        most_ = 0;
        thickest_ = {};
        work_ = 0;
        counts_ = {boxes_, Questions::many};
        if (look_at_all()) return true;
        overlaps_.clear();
        most_ = 0;
        thickest_ = {};
        return false;
    }

    // Looks at what has changed, and round it. False: all must be looked at.
    bool look_again(const Recall& recall, Recall::Counts& counts);

    [[nodiscard]] const std::vector<Overlap>& overlaps() const { return overlaps_; }
    // Ends the search.
    Layers take() && { return {std::move(overlaps_), std::move(frames_), most_, thickest_}; }
    void keep(const Recall& recall, LayersKept& kept) const;

 private:
    // Height of a plate over the middle of the card, from the left cover towards the right one.
    [[nodiscard]] double height(int plate, Vec2 p) const {
        const Slope& s = slopes_[static_cast<std::size_t>(plate)];
        return (s.at_origin - s.along_y * p.y - s.along_x * p.x) / s.up;
    }

    [[nodiscard]] Vec3 over(Vec2 p, double height) const { return plane_.in_world(p) + height * plane_.up; }

    // A triangle of a plate, seen from the side, counter-clockwise.
    [[nodiscard]] Triangle2 seen(const Triangle2& t, const Frame& frame) const {
        Triangle2 result{plane_.flat(frame.point(t[0])), plane_.flat(frame.point(t[1])),
                         plane_.flat(frame.point(t[2]))};
        if (cross(result[1] - result[0], result[2] - result[0]) < 0.0) std::swap(result[1], result[2]);
        return result;
    }

    bool look_at_all() {
        // The sooner many layers are known, the more is passed over.
        for (const std::vector<Triangle2>& triangles : seen_) {
            if (triangles.empty()) continue;
            const Triangle2& first = triangles[0];
            if (!count(1.0 / 3.0 * (first[0] + first[1] + first[2]))) return false;
        }
        std::vector<int> near;
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            const Segment& diagonal = boxes_[static_cast<int>(i)];
            boxes_.query({diagonal.a, diagonal.b}, near);
            for (const int other : near) {
                if (static_cast<std::size_t>(other) > i && !look_at(i, static_cast<std::size_t>(other)))
                    return false;
            }
        }
        return true;
    }

    // What two plates have over one another: the triangles of the one with fewer, looked up among the
    // other's.
    bool look_at(std::size_t a, std::size_t b) {
        const bool a_has_more = shapes_[a].core.all().size() > shapes_[b].core.all().size();
        const std::size_t few = a_has_more ? b : a;
        const std::size_t many = a_has_more ? a : b;
        for (std::size_t n = 0; n < seen_[few].size(); ++n) {
            const Triangle2& t = shapes_[few].core.all()[n];
            const Triangle2& by = seen_[few][n];
            // Nearly all triangles tell nothing new: not of which plate lies over which, nor of how many
            // layers there are at most.
            const Box near = box_round(by, kCountStepMm);
            bool settled = is_settled(static_cast<int>(a), static_cast<int>(b), by);
            if (settled && !may_be_thickest(near)) continue;
            Box box;
            for (const Vec2 p : t) {
                // Seen square to the other plate and from the side differs by less than this.
                const Vec2 there = on_page(frames_[many], frames_[few].point(p));
                extend(box, there, kTouchMm);
            }
            shapes_[many].core.query(box, found_);
            if (too_much(1 + found_.size())) return false;
            for (const int number : found_) {
                const Triangle2& other = seen_[many][static_cast<std::size_t>(number)];
                if (beside(by, other) || beside(other, by)) continue;
                settled = settled || is_settled(static_cast<int>(a), static_cast<int>(b), by);
                if (settled && !may_be_thickest(common(near, box_round(other, kCountStepMm)))) continue;
                const Common both(other, by);
                if (!both.has_area()) continue;
                if (!meet(static_cast<int>(a), static_cast<int>(b), both.corners(),
                          {by[0], by[1], by[2], other[0], other[1], other[2]}))
                    return false;
            }
        }
        return true;
    }

    // Adds to the work done; gives up when it was too much.
    bool too_much(std::size_t done) {
        work_ += done;
        return work_ > kMostWork;
    }

    // What is known already of how b lies over a.
    Overlap& overlap_of(int a, int b) {
        if (overlaps_.empty() || overlaps_.back().a != a || overlaps_.back().b != b)
            overlaps_.push_back({a, b, HUGE_VAL, -HUGE_VAL});
        return overlaps_.back();
    }

    // Whether nothing that both plates have over this triangle changes which lies over which.
    [[nodiscard]] bool is_settled(int a, int b, const Triangle2& seen) const {
        if (overlaps_.empty() || overlaps_.back().a != a || overlaps_.back().b != b) return false;
        const Overlap& known = overlaps_.back();
        return std::none_of(seen.begin(), seen.end(), [&](Vec2 p) {
            const double over = height(b, p) - height(a, p);
            return (over > kHeightMm && known.most <= kHeightMm) ||
                   (over < -kHeightMm && known.least >= -kHeightMm);
        });
    }

    // Adds the corners of what triangles of both plates have in common. False: it was too much work.
    bool meet(int a, int b, std::span<const Vec2> shape, const std::array<Vec2, 6>& corners) {
        Overlap& overlap = overlap_of(a, b);
        Vec2 centre;
        Box box;
        for (const Vec2 p : shape) {
            extend(box, p, kCountStepMm);
            const double over = height(b, p) - height(a, p);
            overlap.least = std::min(overlap.least, over);
            overlap.most = std::max(overlap.most, over);
            centre = centre + (1.0 / static_cast<double>(shape.size())) * p;
        }
        // Where most plates lie over one another is a region with a corner at which the outline of one of two
        // plates has a corner or the outlines of both cross. Edges between triangles count for nothing.
        if (!may_be_thickest(box)) return true;
        for (const Vec2 p : shape) {
            const Vec2 inside = lerp(p, centre, 1e-2);
            if (!may_be_thickest(
                    {inside - Vec2{kCountStepMm, kCountStepMm}, inside + Vec2{kCountStepMm, kCountStepMm}}))
                continue;
            const bool corner = std::any_of(corners.begin(), corners.end(), [p](Vec2 q) {
                return dot(p - q, p - q) < kSameCornerMm * kSameCornerMm;
            });
            if ((corner || (by_outline(a, p) && by_outline(b, p))) && !count(inside)) return false;
        }
        return true;
    }

    [[nodiscard]] bool by_outline(int plate, Vec2 p) const {
        const auto i = static_cast<std::size_t>(plate);
        const Vec2 there = on_page(frames_[i], over(p, height(plate, p)));
        return shapes_[i].edges.is_within(there, 3.0 * kTouchMm);
    }

    // Of points with as many layers the first one counts, from the gutter outwards.
    [[nodiscard]] bool may_be_thickest(const Box& box) const {
        if (!regions_.empty() && !in_regions(box)) return false;
        return counts_.may_reach(box, before(thickest_, box.min) ? most_ + 1 : std::max(most_, 1));
    }

    // What has changed, seen from the side; empty: everything.
    [[nodiscard]] bool in_regions(const Box& box) const {
        return std::any_of(regions_.begin(), regions_.end(),
                           [&](const Box& region) { return touch(region, box); });
    }
    [[nodiscard]] Box box_of(int plate) const { return {boxes_[plate].a, boxes_[plate].b}; }
    void find_regions(const Recall& recall);
    [[nodiscard]] bool is_stale(const Recall& recall, int a, int b) const;

    // Counts the layers over a point, which is rounded to a thousandth of a millimetre. False: it was too
    // much work.
    bool count(Vec2 p) {
        p = kCountStepMm * Vec2{std::round(p.x * kCountStepsPerMm), std::round(p.y * kCountStepsPerMm)};
        const int least = most_ > 0 && before(p, thickest_) ? most_ : most_ + 1;
        boxes_.query({p, p}, here_);
        if (too_much(here_.size())) return false;
        int layers = static_cast<int>(here_.size());
        for (const int plate : here_) {
            if (layers < least) return true;
            const auto i = static_cast<std::size_t>(plate);
            if (!shapes_[i].covers(on_page(frames_[i], over(p, height(plate, p))))) --layers;
        }
        if (layers < least) return true;
        most_ = layers;
        thickest_ = p;
        return true;
    }

    // Of a plate: its height over the middle of the card is (at_origin - along_x x - along_y y) / up.
    struct Slope {
        double at_origin, along_x, along_y, up;
    };

    std::span<const PlateShape> shapes_;
    std::vector<std::vector<Triangle2>> seen_;  // of each shape's core
    ClosedPlane plane_;
    std::vector<Frame> frames_;
    std::vector<Slope> slopes_;  // by plate
    EdgeIndex boxes_;
    BoxCounts counts_;
    std::vector<int> here_, found_;
    std::vector<Overlap> overlaps_;  // of each two plates that have one, in order
    std::vector<Box> regions_;
    std::vector<Box> redrawn_;  // by plate: where it is redrawn
    std::size_t work_ = 0;
    int most_ = 0;
    Vec2 thickest_;
};

void LayerSearch::find_regions(const Recall& recall) {
    const std::span<const Recall::PlateNow> plates = recall.plates();
    const LayersKept& kept = recall.kept().layers;
    std::vector<char> is_there(kept.boxes.size(), 0);
    redrawn_.assign(plates.size(), {});
    for (std::size_t i = 0; i < plates.size(); ++i) {
        const Recall::PlateNow& plate = plates[i];
        if (plate.state != Recall::State::changed) is_there[static_cast<std::size_t>(plate.before)] = 1;
        if (plate.state == Recall::State::same) continue;
        Box box = box_of(static_cast<int>(i));
        if (plate.state == Recall::State::redrawn) {
            box = {};
            if (plate.redrawn.empty()) continue;
            const auto& [min, max] = plate.redrawn;
            for (const Vec2 corner : {min, Vec2{max.x, min.y}, max, Vec2{min.x, max.y}})
                box.extend(plane_.flat(frames_[i].point(corner)));
            redrawn_[i] = grown(box, kRoundMm);
        }
        regions_.push_back(grown(box, kRoundMm));
    }
    for (std::size_t i = 0; i < is_there.size(); ++i) {
        if (is_there[i] == 0) regions_.push_back(grown(kept.boxes[i], kRoundMm));
    }
}

// Whether what is kept of how they lie over one another says nothing any more.
bool LayerSearch::is_stale(const Recall& recall, int a, int b) const {
    const Box both = common(box_of(a), box_of(b));
    const auto stale = [&](int plate) {
        const auto i = static_cast<std::size_t>(plate);
        const Recall::State state = recall.plates()[i].state;
        return state == Recall::State::changed ||
               (state == Recall::State::redrawn && touch(redrawn_[i], both));
    };
    return stale(a) || stale(b);
}

bool LayerSearch::look_again(const Recall& recall, Recall::Counts& counts) {
    const LayersKept& kept = recall.kept().layers;
    if (!kept.known || kept.plane != numbers_of(plane_) || kept.most == 0) return false;
    find_regions(recall);
    counts_ = {boxes_, Questions::few};
    work_ = kept.work;
    const Box thickest{kept.thickest, kept.thickest};
    const bool is_outside = !in_regions(thickest);
    if (is_outside || regions_.empty()) {
        most_ = kept.most;
        thickest_ = kept.thickest;
    }
    std::vector<char> concerned(shapes_.size(), 0);
    std::vector<int> all;
    std::vector<int> near;
    for (const Box& region : regions_) {
        boxes_.query(region, near);
        for (const int plate : near) {
            if (std::exchange(concerned[static_cast<std::size_t>(plate)], 1) == 0) all.push_back(plate);
        }
    }
    std::sort(all.begin(), all.end());
    std::unordered_map<std::uint64_t, LayersKept::Heights> known = kept.overlaps;
    for (const int a : all) {
        const auto i = static_cast<std::size_t>(a);
        if (!seen_[i].empty()) {
            const Triangle2& first = seen_[i][0];
            const Vec2 centre = 1.0 / 3.0 * (first[0] + first[1] + first[2]);
            if (in_regions({centre, centre}) && !count(centre)) return false;
        }
        boxes_.query(box_of(a), near);
        for (const int b : near) {
            if (b <= a || concerned[static_cast<std::size_t>(b)] == 0 ||
                !in_regions(common(box_of(a), box_of(b))))
                continue;
            const auto straight = known.find(recall.key(a, b));
            const auto turned = known.find(recall.key(b, a));
            if (!is_stale(recall, a, b)) {
                if (straight != known.end()) {
                    overlaps_.push_back({a, b, straight->second.least, straight->second.most});
                } else if (turned != known.end()) {
                    overlaps_.push_back({a, b, -turned->second.most, -turned->second.least});
                } else {
                    continue;
                }
            }
            ++counts.examined;
            if (straight != known.end())
                known.erase(straight);
            else if (turned != known.end())
                known.erase(turned);
            if (!look_at(i, static_cast<std::size_t>(b))) return false;
        }
    }
    // Elsewhere there are as many layers as there were.
    if (!regions_.empty() && !is_outside &&
        (most_ < kept.most || (most_ == kept.most && before(kept.thickest, thickest_))))
        return false;
    for (const auto& [key, heights] : known) {
        const int a = recall.plate_of(static_cast<int>(key >> 32U));
        const int b = recall.plate_of(static_cast<int>(key & 0xffffffffU));
        if (a < 0 || b < 0 || is_stale(recall, a, b)) continue;
        if (a < b) {
            overlaps_.push_back({a, b, heights.least, heights.most});
        } else {
            overlaps_.push_back({b, a, -heights.most, -heights.least});
        }
    }
    std::sort(overlaps_.begin(), overlaps_.end(),
              [](const Overlap& p, const Overlap& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
    counts.all = overlaps_.size();
    return true;
}

void LayerSearch::keep(const Recall& recall, LayersKept& kept) const {
    kept = {};
    kept.known = true;
    kept.plane = numbers_of(plane_);
    for (std::size_t i = 0; i < shapes_.size(); ++i) kept.boxes.push_back(box_of(static_cast<int>(i)));
    kept.overlaps.reserve(overlaps_.size());
    for (const Overlap& one : overlaps_) kept.overlaps[recall.key(one.a, one.b)] = {one.least, one.most};
    kept.most = most_;
    kept.thickest = thickest_;
    kept.work = work_;
}

}  // namespace

Layers look_at_layers(const Assembly& assembly, std::span<const PlateShape> shapes, const ClosedPlane& plane,
                      Recall* recall) {
    LayerSearch search(assembly, shapes, plane);
    Recall::Counts counts;
    bool whole = recall != nullptr && recall->helps() && search.look_again(*recall, counts);
    if (!whole) {
        whole = search.look();
        counts.all = counts.examined = search.overlaps().size();
    }
    if (recall != nullptr) {
        recall->share().layers = counts.all;
        recall->share().examined_layers = counts.examined;
        if (whole) {
            search.keep(*recall, recall->kept().layers);
        } else {
            recall->kept().layers = {};
        }
    }
    return std::move(search).take();
}

}  // namespace popup
