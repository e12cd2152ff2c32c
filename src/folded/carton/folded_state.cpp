#include "folded/carton/folded_state.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/nth.h"
#include "popup/refinement.h"

namespace popup::folded {
namespace {

constexpr double kPi = std::numbers::pi;
// So near to half a turn the sign is that of the angle that it came from.
constexpr double kNearHalfTurn = 1e-3;

Vec3 in_page(Vec2 p) { return {p.x, p.y, 0.0}; }

// Corners of some panels as vertices in space. What two panels share at a fold is one vertex.
class ShapeMaker {
 public:
    ShapeMaker(const FoldedState& state, std::vector<int> panels)
        : state_(state), panels_(std::move(panels)) {
        number_.assign(state.sheet().panels.size(), -1);
        for (std::size_t i = 0; i < panels_.size(); ++i) nth(number_, panels_[i]) = static_cast<int>(i);
    }

    void add_folds() {
        for (const Fold& fold : state_.sheet().folds) {
            if (nth(number_, fold.left) < 0 || nth(number_, fold.right) < 0) continue;
            for (const int corner : {fold.stretches.front().a, fold.stretches.back().b})
                unite(key({fold.left, corner}), key({fold.right, corner}));
        }
    }

    int key(CornerOf one) {
        const auto [at, is_new] = keys_.try_emplace(one, static_cast<int>(root_.size()));
        if (is_new) root_.push_back(at->second);
        return at->second;
    }

    // Fills panels with their vertices; keys may not be added any more.
    Shape run() {
        for (const int panel : panels_) add_frame(panel);
        Shape shape;
        shape.panels.resize(panels_.size());
        std::map<int, int> vertex_of;
        for (const auto& [corner, number] : keys_) {
            const auto [at, is_new] = vertex_of.try_emplace(find(number), static_cast<int>(shape.at.size()));
            if (is_new) shape.at.push_back(state_.place(corner));
            nth(vertices_, number) = at->second;
            Shape::Panel& panel = nth(shape.panels, nth(number_, corner.panel));
            panel.vertices.push_back(at->second);
            panel.flat.push_back(state_.sheet().at(corner.corner));
        }
        for (Shape::Panel& panel : shape.panels) put_frame_first(panel);
        return shape;
    }

    [[nodiscard]] int vertex(CornerOf one) const { return nth(vertices_, keys_.at(one)); }
    [[nodiscard]] int number(int panel) const { return nth(number_, panel); }
    [[nodiscard]] const std::vector<int>& panels() const { return panels_; }

 private:
    int find(int number) {
        while (nth(root_, number) != number) number = nth(root_, number) = nth(root_, nth(root_, number));
        return number;
    }
    void unite(int a, int b) { nth(root_, find(b)) = find(a); }

    // Three corners that enclose a large triangle.
    void add_frame(int panel) {
        const Sheet& sheet = state_.sheet();
        const std::vector<int>& outer = nth(sheet.panels, panel).outer;
        const int first = outer.front();
        const int second = *std::max_element(outer.begin(), outer.end(), [&](int a, int b) {
            return distance(sheet.at(first), sheet.at(a)) < distance(sheet.at(first), sheet.at(b));
        });
        const Vec2 way = sheet.at(second) - sheet.at(first);
        const int third = *std::max_element(outer.begin(), outer.end(), [&](int a, int b) {
            return std::abs(cross(way, sheet.at(a) - sheet.at(first))) <
                   std::abs(cross(way, sheet.at(b) - sheet.at(first)));
        });
        for (const int corner : {first, second, third}) key({panel, corner});
        vertices_.resize(root_.size(), -1);
    }

    static void put_frame_first(Shape::Panel& panel) {
        const auto bring = [&panel](std::size_t to, std::size_t from) {
            std::swap(panel.vertices[to], panel.vertices[from]);
            std::swap(panel.flat[to], panel.flat[from]);
        };
        const auto furthest = [&panel](std::size_t begin, const auto& how_far) {
            std::size_t best = begin;
            for (std::size_t i = begin; i < panel.flat.size(); ++i) {
                if (how_far(panel.flat[i]) > how_far(panel.flat[best]) + 1e-9) best = i;
            }
            return best;
        };
        bring(1, furthest(1, [&](Vec2 p) { return distance(panel.flat[0], p); }));
        const Vec2 way = panel.flat[1] - panel.flat[0];
        bring(2, furthest(2, [&](Vec2 p) { return std::abs(cross(way, p - panel.flat[0])); }));
    }

    const FoldedState& state_;
    std::vector<int> panels_;
    std::vector<int> number_;       // by panel of the sheet
    std::map<CornerOf, int> keys_;  // sorted, so that the order of vertices is that of panels and corners
    std::vector<int> root_;         // by key
    std::vector<int> vertices_;     // by key
};

// Panels on the way between those that are joined, sorted.
std::vector<int> panels_between(const FoldedState& state, std::span<const PanelJoin> joins) {
    const Sheet& sheet = state.sheet();
    const auto way_up = [&](int panel) {
        std::vector<int> way{panel};
        while (true) {
            const int by = nth(state.tree().fold_of, way.back());
            if (by < 0) break;
            const Fold& fold = nth(sheet.folds, by);
            way.push_back(fold.left == way.back() ? fold.right : fold.left);
        }
        std::reverse(way.begin(), way.end());
        return way;
    };
    std::vector<int> found;
    for (const PanelJoin& join : joins) {
        if (join.stays) continue;
        std::vector<int> ends;
        ends.reserve(join.merged.size());
        for (const CornerOf& one : join.merged) ends.push_back(one.panel);
        if (join.merged.empty()) ends = {join.a, join.b};
        std::vector<std::vector<int>> ways;
        ways.reserve(ends.size());
        for (const int end : ends) ways.push_back(way_up(end));
        std::size_t common = ways.front().size();
        for (const std::vector<int>& way : ways) {
            const auto at =
                std::mismatch(way.begin(), way.end(), ways.front().begin(), ways.front().end()).first;
            common = std::min(common, static_cast<std::size_t>(at - way.begin()));
        }
        for (const std::vector<int>& way : ways)
            found.insert(found.end(),
                         way.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(common, 1) - 1),
                         way.end());
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

// The rotations that put the flat panels best where their vertices are.
std::vector<Eigen::Matrix3d> turns_of(const Shape& shape, const std::vector<Vec3>& at) {
    std::vector<Eigen::Matrix3d> turns;
    for (const Shape::Panel& panel : shape.panels) {
        const auto count = static_cast<Eigen::Index>(panel.vertices.size());
        Eigen::Matrix3Xd flat(3, count);
        Eigen::Matrix3Xd now(3, count);
        for (Eigen::Index i = 0; i < count; ++i) {
            const Vec2 p = nth(panel.flat, i);
            const Vec3 q = nth(at, nth(panel.vertices, i));
            flat.col(i) << p.x, p.y, 0.0;
            now.col(i) << q.x, q.y, q.z;
        }
        turns.emplace_back(Eigen::umeyama(flat, now, false).topLeftCorner<3, 3>());
    }
    return turns;
}

// How far a fold is folded between its panels' turns, near `was` where that is half a turn.
double angle_between(const Sheet& sheet, const Fold& fold, const Eigen::Matrix3d& left,
                     const Eigen::Matrix3d& right, double was) {
    const Segment line = sheet.line_of(fold);
    const Vec2 dir = unit(line.b - line.a);
    const Eigen::Vector3d axis = right * Eigen::Vector3d(dir.x, dir.y, 0.0);
    const Eigen::Vector3d from = right.col(2);
    const Eigen::Vector3d to = left.col(2);
    const double angle = std::atan2(from.cross(to).dot(axis), from.dot(to));
    return std::abs(angle) > kPi - kNearHalfTurn && angle * was < 0.0 ? -angle : angle;
}

}  // namespace

FoldedState::FoldedState(const Sheet& sheet, const Tree& tree, std::vector<double> angles)
    : sheet_(&sheet), tree_(&tree), angles_(std::move(angles)), frames_(sheet.panels.size()) {
    for (const int panel : tree.order) {
        const int number = nth(tree.fold_of, panel);
        if (number < 0) continue;
        const Fold& fold = nth(sheet.folds, number);
        const bool onwards = fold.left == panel;
        const Segment line = sheet.line_of(fold);
        const Vec2 dir = unit(onwards ? line.b - line.a : line.a - line.b);
        nth(frames_, panel) = nth(frames_, onwards ? fold.right : fold.left)
                                  .after_turn(in_page(line.a), in_page(dir), nth(angles_, number));
    }
}

Vec3 FoldedState::place(CornerOf one) const {
    return nth(frames_, one.panel).point(in_page(sheet_->at(one.corner)));
}

Vec3 FoldedState::normal(int panel) const { return nth(frames_, panel).axes[2]; }

double FoldedState::apart(const PanelJoin& join) const {
    double most = 0.0;
    if (!join.merged.empty()) {
        for (std::size_t i = 0; i < join.merged.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j)
                most = std::max(most, distance(place(join.merged[i]), place(join.merged[j])));
        }
        return most;
    }
    for (const auto& [one, other] : {std::pair{join.a, join.b}, std::pair{join.b, join.a}}) {
        const Vec3 at = place({other, nth(sheet_->panels, other).outer.front()});
        for (const int corner : nth(sheet_->panels, one).outer)
            most = std::max(most, std::abs(dot(normal(other), place({one, corner}) - at)));
    }
    return join.stays && most <= kMostGlueGapMm ? 0.0 : most;
}

double FoldedState::gape() const {
    double most = 0.0;
    for (std::size_t i = 0; i < sheet_->folds.size(); ++i) {
        const Fold& fold = sheet_->folds[i];
        const int number = static_cast<int>(i);
        if (nth(tree_->fold_of, fold.left) == number || nth(tree_->fold_of, fold.right) == number) continue;
        for (const int corner : {fold.stretches.front().a, fold.stretches.back().b})
            most = std::max(most, distance(place({fold.left, corner}), place({fold.right, corner})));
    }
    return most;
}

namespace {

// What the joins are left open by at the angles that were found.
void measure(const FoldedState& state, std::span<const PanelJoin> joins, Closed& closed) {
    const FoldedState after(state.sheet(), state.tree(), closed.angles);
    closed.residual_mm = after.gape();
    double most = -1.0;
    for (std::size_t i = 0; i < joins.size(); ++i) {
        closed.apart_mm.push_back(after.apart(joins[i]));
        if (closed.apart_mm.back() > most) {
            most = closed.apart_mm.back();
            closed.worst = static_cast<int>(i);
        }
    }
    closed.residual_mm = std::max(closed.residual_mm, most);
}

}  // namespace

Closed close_joins(const FoldedState& state, std::span<const PanelJoin> joins, bool all) {
    const Sheet& sheet = state.sheet();
    if (std::all_of(joins.begin(), joins.end(), [](const PanelJoin& join) { return join.stays; })) {
        Closed closed;
        closed.angles = state.angles();
        measure(state, joins, closed);
        return closed;
    }
    std::vector<int> panels;
    if (all || !sheet.loops.empty()) {
        panels.resize(sheet.panels.size());
        std::iota(panels.begin(), panels.end(), 0);
    } else {
        panels = panels_between(state, joins);
    }
    ShapeMaker maker(state, std::move(panels));
    maker.add_folds();
    for (const PanelJoin& join : joins) {
        for (const CornerOf& one : join.merged) maker.key(one);
    }
    const Shape shape = maker.run();
    ShapeJoins wanted;
    for (const PanelJoin& join : joins) {
        if (join.stays) continue;
        if (join.merged.empty()) {
            wanted.in_a_plane.emplace_back(maker.number(join.a), maker.number(join.b));
            continue;
        }
        std::vector<int>& group = wanted.merged.emplace_back();
        for (const CornerOf& one : join.merged) group.push_back(maker.vertex(one));
    }
    SolveOptions options;
    options.size_mm = sheet.size();
    const Solved solved = solve_shape(shape, wanted, options);
    const std::vector<Eigen::Matrix3d> turns = turns_of(shape, solved.at);
    Closed closed;
    closed.angles = state.angles();
    closed.steps = solved.steps;
    closed.panels = shape.panels.size();
    closed.settled = solved.settled;
    for (std::size_t i = 0; i < sheet.folds.size(); ++i) {
        const Fold& fold = sheet.folds[i];
        const int left = maker.number(fold.left);
        const int right = maker.number(fold.right);
        if (left < 0 || right < 0) continue;
        closed.angles[i] = angle_between(sheet, fold, nth(turns, left), nth(turns, right), closed.angles[i]);
    }
    for (std::size_t i = 0; i < sheet.folds.size(); ++i) {
        const double turn = std::abs(closed.angles[i] - state.angles()[i]);
        if (turn <= closed.turn) continue;
        closed.turn = turn;
        closed.turned = static_cast<int>(i);
    }
    double moved = 0.0;
    for (std::size_t i = 0; i < shape.at.size(); ++i)
        moved = std::max(moved, distance(shape.at[i], solved.at[i]));
    for (const PanelJoin& join : joins)
        closed.were_apart_mm = std::max(closed.were_apart_mm, state.apart(join));
    // Through half a turn a panel goes through the one that it hangs on.
    closed.swings =
        closed.turn > kPi || (closed.turn > kMostTurnRad && moved > kMostWay * closed.were_apart_mm);
    measure(state, joins, closed);
    return closed;
}

}  // namespace popup::folded
