#include "parts/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "parts/spurs.h"

namespace popup {
namespace {

// Areas below this are the rounding of a drawing, in mm².
constexpr double kNoArea = 1e-3;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

double around(const Ring& ring) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        sum += distance(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
    return sum;
}

// More pairs that overlap partly are found by no one's eye, and each takes long.
constexpr std::size_t kMostOverlaps = 10'000;

// Where a ring crosses itself first; its first point when that cannot be told.
Vec2 crossing_of(const Ring& ring) {
    const EdgeIndex index(edges_of({ring, {}}));
    std::vector<int> found;
    std::size_t looks = 0;
    constexpr std::size_t kMostLooks = 1'000'000;
    for (int i = 0; i < index.size() && looks < kMostLooks; ++i) {
        const Segment s = index[i];
        Box box;
        box.extend(s.a);
        box.extend(s.b);
        index.query(box, found);
        looks += found.size();
        for (const int j : found) {
            if (j <= i) continue;
            const Segment t = index[j];
            const double t_a = cross(s.b - s.a, t.a - s.a);
            const double t_b = cross(s.b - s.a, t.b - s.a);
            const double s_a = cross(t.b - t.a, s.a - t.a);
            const double s_b = cross(t.b - t.a, s.b - t.a);
            if (t_a * t_b < 0.0 && s_a * s_b < 0.0) return lerp(s.a, s.b, s_a / (s_a - s_b));
        }
    }
    return ring.front();
}

class Sorter {
 public:
    Sorter(std::vector<ClosedLine> lines, Work& work) : lines_(std::move(lines)), work_(work) {}

    std::optional<Contours> run() {
        for (ClosedLine& line : lines_) {
            if (!add(line)) return std::nullopt;
        }
        drop_doubles();
        find_boxes();
        if (!relate_near() || !find_parents()) return std::nullopt;
        find_depths();
        return std::move(out_);
    }

 private:
    enum class Relation : char { apart, a_in_b, b_in_a, same, overlap };
    struct Near {
        Relation relation = Relation::apart;
        bool grazes = false;  // the one pokes over the other's edge, by no more than kDeepMm
    };

    // --- one at a time

    bool add(ClosedLine& line) {
        if (!affordable(line.points)) return false;
        const double length = around(line.points);
        std::vector<Polygon> inside = filled({line.points}, FillRule::non_zero);
        // There and back on one line is a slit.
        if (area(inside) <= 0.5 * kDeepMm * length && !is_deep(inside)) {
            out_.hairs.emplace_back(std::move(line.points), std::move(line.elements));
            return true;
        }
        // What of the outline encloses nothing is a slit likewise.
        for (std::vector<Vec2>& spur : spurs_of(line.points))
            out_.hairs.emplace_back(std::move(spur), line.elements);
        const double lost = std::abs(area(inside) - std::abs(signed_area(line.points)));
        // Points stand on the grid, which moves edges by up to its step.
        const bool crosses = lost > kNoArea + 2.0 * kGridMm * length;
        if (crosses) out_.crossed.push_back({line.elements, crossing_of(line.points)});
        if (!crosses && inside.size() > 1) {
            // Lobes that meet in a point, or that rounding has left.
            std::erase_if(inside, [](const Polygon& p) { return area(p) <= kNoArea; });
        }
        for (Polygon& region : inside) {
            emit(std::move(region.outer), line.elements);
            for (Ring& hole : region.holes) {
                if (std::abs(signed_area(hole)) > kNoArea) emit(std::move(hole), line.elements);
            }
        }
        return true;
    }

    [[nodiscard]] bool affordable(const std::vector<Vec2>& points) {
        if (!work_.sweep(points)) return false;
        constexpr std::size_t kFew = 50;
        if (points.size() <= kFew) return true;
        const std::vector<Segment> edges = edges_of({points, {}});
        return work_.crossings(EdgeIndex(edges), edges);
    }

    void emit(Ring ring, const std::vector<int>& elements) {
        if (signed_area(ring) < 0.0) std::reverse(ring.begin() + 1, ring.end());
        ClosedContour made;
        made.ring = std::move(ring);
        made.elements = elements;
        out_.all.push_back(std::move(made));
    }

    // Those that are the same corner by corner; rings begin at their lowest leftmost one.
    void drop_doubles() {
        std::vector<int> order;
        for (std::size_t i = 0; i < out_.all.size(); ++i) order.push_back(static_cast<int>(i));
        const auto before = [&](int a, int b) {
            const Ring& p = out_.all[at(a)].ring;
            const Ring& q = out_.all[at(b)].ring;
            return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end(), [](Vec2 u, Vec2 v) {
                return u.x != v.x ? u.x < v.x : u.y < v.y;
            });
        };
        std::stable_sort(order.begin(), order.end(), before);
        gone_.assign(out_.all.size(), 0);
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (out_.all[at(order[i])].ring == out_.all[at(order[i - 1])].ring) gone_[at(order[i])] = 1;
        }
        drop_gone();
    }

    void drop_gone() {
        std::vector<ClosedContour> kept;
        for (std::size_t i = 0; i < out_.all.size(); ++i) {
            if (gone_[i] != 0) {
                out_.doubled.push_back(std::move(out_.all[i].elements));
            } else {
                kept.push_back(std::move(out_.all[i]));
            }
        }
        out_.all = std::move(kept);
        gone_.assign(out_.all.size(), 0);
    }

    // --- two at a time

    void find_boxes() {
        boxes_.clear();
        areas_.clear();
        for (const ClosedContour& one : out_.all) {
            boxes_.push_back(bounds(one.ring));
            areas_.push_back(signed_area(one.ring));
        }
    }

    // The pairs whose edges come near each other.
    bool near_pairs(std::vector<std::pair<int, int>>& pairs) {
        std::vector<Segment> edges;
        std::vector<int> owner;
        for (std::size_t i = 0; i < out_.all.size(); ++i) {
            const Ring& ring = out_.all[i].ring;
            for (std::size_t j = 0; j < ring.size(); ++j) {
                edges.push_back({ring[j], ring[j + 1 == ring.size() ? 0 : j + 1]});
                owner.push_back(static_cast<int>(i));
            }
        }
        const EdgeIndex index({}, edges);
        if (!work_.crossings(index, edges)) return false;
        std::vector<int> found;
        std::pair<int, int> last{-1, -1};
        for (std::size_t i = 0; i < edges.size(); ++i) {
            Box box;
            box.extend(edges[i].a);
            box.extend(edges[i].b);
            const Vec2 margin{kDeepMm, kDeepMm};
            index.query({box.min - margin, box.max + margin}, found);
            for (const int j : found) {
                const std::pair<int, int> pair{owner[i], owner[at(j)]};
                if (pair.second <= pair.first || pair == last) continue;
                if (distance(edges[i], edges[at(j)]) > kDeepMm) continue;
                pairs.push_back(last = pair);
            }
        }
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return true;
    }

    Near relation(int a, int b, std::vector<Polygon>& common) const {
        const std::vector<Polygon> p{{out_.all[at(a)].ring, {}}};
        const std::vector<Polygon> q{{out_.all[at(b)].ring, {}}};
        // More than the grid makes of edges that lie on each other.
        const auto pokes = [&](const std::vector<Polygon>& beyond) {
            return area(beyond) > kGridMm * std::min(around(p[0].outer), around(q[0].outer));
        };
        common = intersect(p, q);
        if (!is_deep(common)) return {Relation::apart, pokes(common)};
        const std::vector<Polygon> a_beyond = subtract(p, q);
        const std::vector<Polygon> b_beyond = subtract(q, p);
        const bool a_out = is_deep(a_beyond);
        const bool b_out = is_deep(b_beyond);
        if (a_out && b_out) return {Relation::overlap};
        if (!a_out && !b_out) return {Relation::same};
        // What is as large as the other and no more than a hair off is the other.
        if (a_out ? areas_[at(b)] >= areas_[at(a)] : areas_[at(a)] >= areas_[at(b)]) return {Relation::same};
        return a_out ? Near{Relation::b_in_a, pokes(b_beyond)} : Near{Relation::a_in_b, pokes(a_beyond)};
    }

    bool relate_near() {
        std::vector<std::pair<int, int>> pairs;
        if (!near_pairs(pairs)) return false;
        std::vector<Polygon> common;
        for (const auto& [a, b] : pairs) {
            if (gone_[at(a)] != 0 || gone_[at(b)] != 0) continue;
            // A boolean costs far more a corner than a look, even where nothing crosses.
            constexpr std::size_t kCornerLooks = 20;
            const std::array<const Ring*, 2> rings{&out_.all[at(a)].ring, &out_.all[at(b)].ring};
            if (!work_.looks(kCornerLooks * (rings[0]->size() + rings[1]->size())) || !work_.sweep(rings)) {
                return false;
            }
            const Near found = relation(a, b, common);
            near_[{a, b}] = found;
            if (found.relation == Relation::same) gone_[at(b)] = 1;
            if (found.relation == Relation::overlap) {
                if (out_.overlaps.size() == kMostOverlaps) return false;
                out_.overlaps.push_back({a, b, area(common), common[0].outer[0]});
            }
        }
        renumber();
        return true;
    }

    // Takes the doubled ones out of everything that names contours by number.
    void renumber() {
        std::vector<int> number(out_.all.size(), -1);
        int next = 0;
        for (std::size_t i = 0; i < out_.all.size(); ++i) {
            if (gone_[i] == 0) number[i] = next++;
        }
        std::map<std::pair<int, int>, Near> near;
        for (const auto& [pair, found] : near_) {
            const std::pair<int, int> now{number[at(pair.first)], number[at(pair.second)]};
            if (now.first >= 0 && now.second >= 0) near[now] = found;
        }
        near_ = std::move(near);
        std::erase_if(out_.overlaps, [&](const ContourOverlap& one) {
            return number[at(one.a)] < 0 || number[at(one.b)] < 0;
        });
        for (ContourOverlap& one : out_.overlaps)
            one = {number[at(one.a)], number[at(one.b)], one.area_mm2, one.at};
        drop_gone();
        find_boxes();
        for (const auto& [pair, found] : near_) {
            if (!found.grazes) continue;
            out_.all[at(pair.first)].grazed.push_back(pair.second);
            out_.all[at(pair.second)].grazed.push_back(pair.first);
        }
    }

    [[nodiscard]] bool lies_in(int inner, int outer) const {
        const bool swapped = inner > outer;
        const auto known = near_.find({std::min(inner, outer), std::max(inner, outer)});
        if (known != near_.end())
            return known->second.relation == (swapped ? Relation::b_in_a : Relation::a_in_b);
        return contains({out_.all[at(outer)].ring, {}}, out_.all[at(inner)].ring.front());
    }

    bool find_parents() {
        std::vector<Segment> diagonals;
        for (const Box& box : boxes_) diagonals.push_back({box.min, box.max});
        const EdgeIndex index({}, diagonals);
        std::vector<int> found;
        for (std::size_t i = 0; i < out_.all.size(); ++i) {
            const Vec2 middle = boxes_[i].centre();
            index.query({middle, middle}, found);
            constexpr std::size_t kSortLooks = 10;
            if (!work_.looks(kSortLooks * found.size())) return false;
            std::erase_if(found, [&](int j) { return at(j) == i || areas_[at(j)] < areas_[i]; });
            // The smallest first: the first that holds it is the parent.
            std::sort(found.begin(), found.end(), [&](int a, int b) {
                return std::pair(areas_[at(a)], a) < std::pair(areas_[at(b)], b);
            });
            for (const int j : found) {
                if (!work_.looks(out_.all[at(j)].ring.size())) return false;
                if (!lies_in(static_cast<int>(i), j)) continue;
                out_.all[i].parent = j;
                break;
            }
        }
        return true;
    }

    // Parents are larger, so those of the larger ones are known first.
    void find_depths() {
        std::vector<int> order;
        for (std::size_t i = 0; i < out_.all.size(); ++i) order.push_back(static_cast<int>(i));
        std::stable_sort(order.begin(), order.end(),
                         [&](int a, int b) { return areas_[at(a)] > areas_[at(b)]; });
        for (const int i : order) {
            ClosedContour& one = out_.all[at(i)];
            one.root = one.parent < 0 ? i : out_.all[at(one.parent)].root;
            one.depth = one.parent < 0 ? 0 : out_.all[at(one.parent)].depth + 1;
        }
    }

    std::vector<ClosedLine> lines_;
    Work& work_;
    std::vector<char> gone_;
    std::vector<Box> boxes_;
    std::vector<double> areas_;
    std::map<std::pair<int, int>, Near> near_;
    Contours out_;
};

}  // namespace

bool is_deep(const std::vector<Polygon>& regions) {
    if (area(regions) <= kDeepMm * kDeepMm) return false;
    return !offset(regions, -kDeepMm, Corners::sharp).empty();
}

std::optional<Contours> sort_contours(std::vector<ClosedLine> lines, Work& work) {
    return Sorter(std::move(lines), work).run();
}

}  // namespace popup
