// Every inner corner, and every hole, is a node that folds end at. Around a node the folds follow one another
// as the panels between them do: from a fold along the border of the panel on its left to the next fold. That
// walk comes back to its first fold, and the panels on the way are a loop. A node that is the outer border of
// a piece gives the loop that all others of the piece make together; it is left out.
#include "folded/loops.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/nth.h"

namespace popup::folded {
namespace {

class Walks {
 public:
    Walks(const SheetGraph& graph, const HalfFolds& halves, const std::vector<Fold>& folds,
          const std::vector<Panel>& panels)
        : graph_(graph), halves_(halves), folds_(folds), panels_(panels) {}

    std::vector<Loop> run() {
        find_outermost();
        find_places();
        const std::size_t count = 2 * graph_.edges.size();
        std::vector<char> seen(count, 0);
        for (std::size_t first = 0; first < count; ++first) {
            if (seen[first] != 0 || fold_of(static_cast<int>(first)) < 0) continue;
            walk(static_cast<int>(first), seen);
        }
        return std::move(loops_);
    }

 private:
    [[nodiscard]] int fold_of(int half) const { return nth(halves_.fold, half / 2); }

    // The corner of each piece that is least, by x and then by y: it lies on the outer border.
    void find_outermost() {
        for (const Panel& panel : panels_)
            outermost_.resize(std::max(outermost_.size(), static_cast<std::size_t>(panel.piece) + 1), -1);
        for (int face = 0; face < graph_.faces(); ++face) {
            const int panel = nth(halves_.panel_of, face);
            if (panel < 0) continue;
            int& least = nth(outermost_, nth(panels_, panel).piece);
            for (const int half : graph_.halves_of(face)) {
                const int corner = graph_.from(half);
                if (least < 0 || before(graph_.at(corner), graph_.at(least))) least = corner;
            }
        }
    }
    // Of each half that leads away from a corner: its number around it.
    void find_places() {
        place_.resize(2 * graph_.edges.size());
        for (std::size_t corner = 0; corner < graph_.corners.size(); ++corner) {
            const std::vector<int>& around = graph_.around(static_cast<int>(corner));
            for (std::size_t i = 0; i < around.size(); ++i) nth(place_, around[i]) = i;
        }
    }
    static bool before(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

    // Halves go out from the node. Crossing one goes from the panel on its right to that on its left.
    void walk(int first, std::vector<char>& seen) {
        const int outermost =
            nth(outermost_, nth(panels_, nth(halves_.panel_of, graph_.face_of(first))).piece);
        steps_.clear();
        nodes_.clear();
        bool outer = false;
        int half = first;
        do {
            nth(seen, half) = 1;
            const int fold = fold_of(half);
            const Segment way = graph_.segment(half);
            const Stretch stretch = nth(folds_, fold).stretches.front();
            const double along = dot(way.b - way.a, graph_.at(stretch.b) - graph_.at(stretch.a));
            add_step({fold, along > 0.0 ? 1.0 : -1.0});
            // Back along the border of the panel on the left, to the fold that ends there next.
            int at = half;
            while (true) {
                nodes_.push_back(graph_.from(at));
                outer = outer || nodes_.back() == outermost;
                at = before_on_border(at);
                if (fold_of(at) >= 0) break;
            }
            half = at ^ 1;
        } while (half != first);
        if (!outer) finish();
    }

    // The half that runs before this one on the border of the same face.
    [[nodiscard]] int before_on_border(int half) const {
        const std::vector<int>& around = graph_.around(graph_.from(half));
        return around[(nth(place_, half) + 1) % around.size()] ^ 1;
    }

    // There and back again is no way.
    void add_step(Step step) {
        if (!steps_.empty() && steps_.back().fold == step.fold && steps_.back().sign != step.sign) {
            steps_.pop_back();
        } else {
            steps_.push_back(step);
        }
    }

    void finish() {
        std::size_t begin = 0;
        std::size_t end = steps_.size();
        while (end - begin >= 2 && steps_[begin].fold == steps_[end - 1].fold &&
               steps_[begin].sign != steps_[end - 1].sign) {
            ++begin;
            --end;
        }
        if (begin == end) return;
        Loop loop;
        loop.steps.assign(steps_.begin() + static_cast<std::ptrdiff_t>(begin),
                          steps_.begin() + static_cast<std::ptrdiff_t>(end));
        Box box;
        for (const int node : nodes_) box.extend(graph_.at(node));
        loop.corner =
            std::all_of(nodes_.begin(), nodes_.end(), [this](int node) { return node == nodes_.front(); });
        if (loop.corner) loop.corner_number = nodes_.front();
        loop.at = loop.corner ? graph_.at(nodes_.front()) : box.centre();
        for (const Step& step : loop.steps) {
            for (const Stretch stretch : nth(folds_, step.fold).stretches) {
                for (const int end : {stretch.a, stretch.b})
                    loop.size = std::max(loop.size, distance(loop.at, graph_.at(end)));
            }
        }
        loop.line = nth(folds_, loop.steps.front().fold).line;
        loops_.push_back(std::move(loop));
    }

    const SheetGraph& graph_;
    const HalfFolds& halves_;
    const std::vector<Fold>& folds_;
    const std::vector<Panel>& panels_;
    std::vector<int> outermost_;      // corner, by piece
    std::vector<std::size_t> place_;  // by half
    std::vector<Step> steps_;
    std::vector<int> nodes_;  // corners on the way
    std::vector<Loop> loops_;
};

}  // namespace

std::vector<Loop> find_loops(const SheetGraph& graph, const HalfFolds& halves, const std::vector<Fold>& folds,
                             const std::vector<Panel>& panels) {
    return Walks(graph, halves, folds, panels).run();
}

}  // namespace popup::folded
