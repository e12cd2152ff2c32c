#include "folded/flat/flat_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <unordered_set>
#include <utility>

#include "assembly/settle.h"
#include "base/geometry/edge_index.h"
#include "base/geometry/sheet_graph.h"
#include "base/geometry/triangulate.h"
#include "base/nth.h"

namespace popup::folded {
namespace {

// Where a sheet lies on itself its lines lie on one another, too.
constexpr std::size_t kMostMeetingsFlat = 40'000'000;

// A rigid motion of the plane, mirrored or not: p goes to x p.x + y p.y + shift.
struct Placing {
    Vec2 x{1.0, 0.0}, y{0.0, 1.0}, shift;
    [[nodiscard]] Vec2 direction(Vec2 d) const { return d.x * x + d.y * y; }
    [[nodiscard]] Vec2 point(Vec2 p) const { return direction(p) + shift; }
    // First over the line, then this.
    [[nodiscard]] Placing after_fold(Segment line) const {
        const Vec2 d = unit(line.b - line.a);
        const auto mirrored = [&](Vec2 v) { return 2.0 * dot(v, d) * d - v; };
        Placing result;
        result.x = direction(mirrored({1.0, 0.0}));
        result.y = direction(mirrored({0.0, 1.0}));
        result.shift = point(line.a) - (line.a.x * result.x + line.a.y * result.y);
        return result;
    }
};

bool is_inside(const Ring& ring, Vec2 p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Vec2 a = ring[i];
        const Vec2 b = ring[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
            inside = !inside;
    }
    return inside;
}

bool is_inside(const Polygon& polygon, Vec2 p) {
    return is_inside(polygon.outer, p) && std::none_of(polygon.holes.begin(), polygon.holes.end(),
                                                       [p](const Ring& hole) { return is_inside(hole, p); });
}

// A point well inside a face of the graph; none if it has no area.
std::optional<Vec2> point_in(const SheetGraph& graph, int face) {
    Polygon polygon;
    std::unordered_set<int> seen;
    for (const int first : graph.halves_of(face)) {
        if (seen.count(first) != 0) continue;
        Ring ring;
        for (int half = first; seen.insert(half).second; half = graph.next(half))
            ring.push_back(graph.at(graph.from(half)));
        if (signed_area(ring) > 0.0) {
            polygon.outer = std::move(ring);
        } else {
            polygon.holes.push_back(std::move(ring));
        }
    }
    if (polygon.outer.size() < 3) return std::nullopt;
    const Triangulation triangles = triangulate(polygon);
    std::optional<Vec2> best;
    double largest = 0.0;
    for (const auto& [a, b, c] : triangles.triangles) {
        const Vec2 p = triangles.points[a];
        const Vec2 q = triangles.points[b];
        const Vec2 r = triangles.points[c];
        const double area = cross(q - p, r - p);
        if (area <= largest) continue;
        largest = area;
        best = (1.0 / 3.0) * (p + q + r);
    }
    return best;
}

// The flat state of one piece, cut along all edges into cells.
class Overlay {
 public:
    Overlay(const Sheet& sheet, const FlatState& state, double near_mm, std::size_t most, Layers& layers)
        : sheet_(sheet), state_(state), near_(near_mm), most_(most), layers_(layers) {}

    // False if there is too much of it.
    bool run(int piece, std::size_t& layers_most) {
        std::vector<SheetLine> lines;
        panels_.clear();
        for (std::size_t i = 0; i < sheet_.panels.size(); ++i) {
            if (sheet_.panels[i].piece != piece) continue;
            panels_.push_back(static_cast<int>(i));
            const Polygon& outline = state_.outlines[i];
            lines.push_back({outline.outer, true, kCut, static_cast<int>(i)});
            for (const Ring& hole : outline.holes) lines.push_back({hole, true, kCut, static_cast<int>(i)});
        }
        const std::optional<SheetGraph> graph = make_graph(lines, near_, kMostMeetingsFlat);
        if (!graph) return false;
        cover(*graph);
        for (const std::vector<int>& on : covers_) {
            layers_most = std::max(layers_most, on.size());
            if (!order(on)) return false;
        }
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) assign(sheet_.folds[i]);
        return meet(*graph, piece);
    }

 private:
    // Which panels lie on each cell, ascending.
    void cover(const SheetGraph& graph) {
        struct Spot {
            double x;
            Vec2 at;
            int face;
        };
        std::vector<Spot> spots;
        for (int face = 1; face < graph.faces(); ++face) {
            if (const auto at = point_in(graph, face)) spots.push_back({at->x, *at, face});
        }
        std::sort(spots.begin(), spots.end(),
                  [](const Spot& a, const Spot& b) { return a.x != b.x ? a.x < b.x : a.face < b.face; });
        covers_.assign(static_cast<std::size_t>(graph.faces()), {});
        for (const int panel : panels_) {
            const Polygon& outline = nth(state_.outlines, panel);
            Box box;
            for (const Vec2 p : outline.outer) box.extend(p);
            auto spot = std::lower_bound(spots.begin(), spots.end(), box.min.x,
                                         [](const Spot& a, double x) { return a.x < x; });
            for (; spot != spots.end() && spot->x <= box.max.x; ++spot) {
                if (is_inside(outline, spot->at)) nth(covers_, spot->face).push_back(panel);
            }
        }
    }

    bool order(const std::vector<int>& on) {
        for (std::size_t i = 0; i < on.size(); ++i) {
            for (std::size_t k = i + 1; k < on.size(); ++k) layers_.pair(on[i], on[k]);
        }
        for (std::size_t i = 0; i < on.size(); ++i) {
            for (std::size_t k = i + 1; k < on.size(); ++k) {
                for (std::size_t m = k + 1; m < on.size(); ++m) {
                    if (!is_new(on[i], on[k], on[m], -1)) continue;
                    layers_.in_order(on[i], on[k], on[m]);
                }
                if (layers_.conditions() > most_) return false;
            }
        }
        return true;
    }

    // What a mountain or a valley says: the front of what lies front up looks at what is above it.
    void assign(const Fold& fold) {
        const bool valley = (fold.ink & kValley) != 0;
        if (valley == ((fold.ink & kMountain) != 0)) return;  // neither, or both
        const bool left_above = valley == (nth(state_.front_up, fold.right) != 0);
        layers_.lies_above(left_above ? fold.left : fold.right, left_above ? fold.right : fold.left);
    }

    // What folds that lie on an edge of the overlay say of each other, and of panels that pass under them.
    bool meet(const SheetGraph& graph, int piece) {
        std::vector<Segment> segments;
        std::vector<int> fold_of;
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            if (nth(sheet_.panels, sheet_.folds[i].left).piece != piece) continue;
            for (const Segment& one : state_.folds[i]) {
                segments.push_back(one);
                fold_of.push_back(static_cast<int>(i));
            }
        }
        const EdgeIndex index({}, segments);
        std::vector<int> found;
        std::vector<int> through;
        std::array<std::vector<int>, 2> beside;  // folds whose panels lie on the left, and on the right
        for (std::size_t e = 0; e < graph.edges.size(); ++e) {
            const int half = static_cast<int>(2 * e);
            const std::vector<int>& left = nth(covers_, graph.face_of(half));
            const std::vector<int>& right = nth(covers_, graph.face_of(half + 1));
            const Segment edge = graph.segment(half);
            const Vec2 middle = 0.5 * (edge.a + edge.b);
            Box box;
            box.extend(middle - Vec2{near_, near_});
            box.extend(middle + Vec2{near_, near_});
            index.query(box, found);
            for (auto& folds : beside) folds.clear();
            for (const int number : found) {
                const Segment& line = index[number];
                const Vec2 way = unit(line.b - line.a);
                const double along = dot(way, middle - line.a);
                if (std::abs(cross(way, middle - line.a)) > 2.0 * near_ || along < 0.0 ||
                    along > distance(line.a, line.b) ||
                    std::abs(cross(way, unit(edge.b - edge.a))) > kParallel)
                    continue;
                const int fold = nth(fold_of, number);
                for (std::size_t side = 0; side < 2; ++side) {
                    if (lies_on(fold, side == 0 ? left : right) &&
                        !lies_on_any(fold, side == 0 ? right : left))
                        beside.at(side).push_back(fold);
                }
            }
            through.clear();
            std::set_intersection(left.begin(), left.end(), right.begin(), right.end(),
                                  std::back_inserter(through));
            for (const auto& folds : beside) {
                for (std::size_t i = 0; i < folds.size(); ++i) {
                    const Fold& one = nth(sheet_.folds, folds[i]);
                    for (const int panel : through) {
                        if (is_new(one.left, one.right, panel, -2))
                            layers_.not_between(one.left, one.right, panel);
                    }
                    for (std::size_t k = i + 1; k < folds.size(); ++k) {
                        const Fold& other = nth(sheet_.folds, folds[k]);
                        if (one.left == other.left || one.left == other.right || one.right == other.left ||
                            one.right == other.right)
                            continue;
                        if (is_new(one.left, one.right, other.left, other.right))
                            layers_.not_interleaved(one.left, one.right, other.left, other.right);
                    }
                }
            }
            if (layers_.conditions() > most_) return false;
        }
        return true;
    }

    [[nodiscard]] static bool has(const std::vector<int>& panels, int panel) {
        return std::binary_search(panels.begin(), panels.end(), panel);
    }
    [[nodiscard]] bool lies_on(int fold, const std::vector<int>& panels) const {
        const Fold& one = nth(sheet_.folds, fold);
        return has(panels, one.left) && has(panels, one.right);
    }
    [[nodiscard]] bool lies_on_any(int fold, const std::vector<int>& panels) const {
        const Fold& one = nth(sheet_.folds, fold);
        return has(panels, one.left) || has(panels, one.right);
    }

    // Whether such a condition has not been made yet. The last says of which kind it is, or is a panel.
    bool is_new(int a, int b, int c, int d) {
        std::uint64_t key = 1469598103934665603U;
        for (const int number : {a, b, c, d})
            key = (key ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(number))) * 1099511628211U +
                  0x9e3779b97f4a7c15U;
        return made_.insert(key).second;
    }

    static constexpr double kParallel = 1e-2;  // sine between a fold and an edge that it lies on

    const Sheet& sheet_;
    const FlatState& state_;
    double near_;
    std::size_t most_;
    Layers& layers_;
    std::vector<int> panels_;
    std::vector<std::vector<int>> covers_;  // by face
    std::unordered_set<std::uint64_t> made_;
};

}  // namespace

FlatState lay_flat(const Sheet& sheet, const Tree& tree) {
    const std::size_t count = sheet.panels.size();
    FlatState state;
    state.front_up.assign(count, 1);
    std::vector<Placing> placings(count);
    for (const int panel : tree.order) {
        const int number = nth(tree.fold_of, panel);
        if (number < 0) continue;
        const Fold& fold = nth(sheet.folds, number);
        const int base = fold.left == panel ? fold.right : fold.left;
        nth(placings, panel) = nth(placings, base).after_fold(sheet.line_of(fold));
        nth(state.front_up, panel) = nth(state.front_up, base) == 0 ? 1 : 0;
    }
    for (std::size_t i = 0; i < sheet.folds.size(); ++i) {
        const Fold& fold = sheet.folds[i];
        const Segment line = sheet.line_of(fold);
        const Placing there = nth(placings, fold.left).after_fold(line);
        const bool turned = nth(state.front_up, fold.left) == nth(state.front_up, fold.right);
        for (const Vec2 end : {line.a, line.b}) {
            const double off = distance(there.point(end), nth(placings, fold.right).point(end));
            const double counts = turned ? std::max(off, distance(line.a, line.b)) : off;
            if (counts <= state.off_mm) continue;
            state.off_mm = counts;
            state.off_fold = static_cast<int>(i);
        }
    }
    state.frames.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Placing& placing = placings[i];
        state.frames[i].axes = {Vec3{placing.x.x, placing.x.y, 0.0}, Vec3{placing.y.x, placing.y.y, 0.0},
                                Vec3{0.0, 0.0, state.front_up[i] != 0 ? 1.0 : -1.0}};
        state.frames[i].origin = {placing.shift.x, placing.shift.y, 0.0};
    }
    // By panel: across a cut, corners of the sheet have places of their own.
    const auto place_of = [&](int corner, int panel) { return nth(placings, panel).point(sheet.at(corner)); };
    state.outlines.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Panel& from = sheet.panels[i];
        const int panel = static_cast<int>(i);
        Polygon& outline = state.outlines[i];
        for (const int corner : from.outer) outline.outer.push_back(place_of(corner, panel));
        for (const std::vector<int>& hole : from.holes) {
            Ring& ring = outline.holes.emplace_back();
            for (const int corner : hole) ring.push_back(place_of(corner, panel));
        }
    }
    state.folds.resize(sheet.folds.size());
    for (std::size_t i = 0; i < sheet.folds.size(); ++i) {
        for (const Stretch one : sheet.folds[i].stretches) {
            const int panel = sheet.folds[i].left;
            state.folds[i].push_back({place_of(one.a, panel), place_of(one.b, panel)});
        }
    }
    return state;
}

std::optional<Layers> order_conditions(const Sheet& sheet, const FlatState& state, double near_mm,
                                       std::size_t most, std::size_t& layers_most) {
    Layers layers;
    layers_most = 0;
    Overlay overlay(sheet, state, near_mm, most, layers);
    for (std::size_t piece = 0; piece < sheet.cuts.size(); ++piece) {
        if (!overlay.run(static_cast<int>(piece), layers_most)) return std::nullopt;
    }
    return layers;
}

Assembly stacked(const CreasePattern& pattern, const Sheet& sheet, const Tree& tree, const FlatState& state,
                 const Layers& layers, const Layers::Solution& found) {
    Assembly out = assembly_of_panels(pattern, sheet, tree);
    for (std::size_t i = 0; i < tree.order.size(); ++i)
        out.plates[i].stands = nth(state.frames, tree.order[i]);
    for (const Fold& fold : sheet.folds) {
        const int left = nth(tree.plate_of, fold.left);
        const int right = nth(tree.plate_of, fold.right);
        bool valley = (fold.ink & kMountain) == 0;
        if (const auto above = layers.is_above(found, fold.left, fold.right))
            valley = *above == (nth(state.front_up, fold.right) != 0);
        for (const Segment& stretch : sheet.stretches_of(fold)) {
            out.hinges.push_back({left, right, stretch, stretch});
            out.lines.push_back({valley ? LineKind::valley : LineKind::mountain, stretch,
                                 nth(sheet.panels, fold.left).piece, left, right, std::numbers::pi});
        }
    }
    for (std::size_t i = 0; i < layers.pairs(); ++i) {
        auto [above, below] = layers.panels_of(static_cast<int>(i));
        if (found.above[i] < 0) std::swap(above, below);
        out.layers.push_back(
            {nth(tree.plate_of, above), nth(tree.plate_of, below), nth(state.front_up, below) != 0});
    }
    settle_numbers(out);
    return out;
}

}  // namespace popup::folded
