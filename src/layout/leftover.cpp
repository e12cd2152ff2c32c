#include "layout/leftover.h"

#include <algorithm>
#include <cmath>

#include "base/nth.h"

namespace popup {
namespace {

constexpr double kCells = 400.0;

// An edge of a piece, in mm.
struct PieceEdge {
    Vec2 a, b;
};

// The part of an edge within low ≤ y ≤ high, as its range of x (or the same with x and y exchanged); false
// when there is none.
bool range_within(double a_along, double a_across, double b_along, double b_across, double low, double high,
                  double& from, double& to) {
    if (std::max(a_across, b_across) <= low || std::min(a_across, b_across) >= high) return false;
    const auto at = [&](double across) {
        if (a_across == b_across) return a_along;
        const double t = std::clamp((across - a_across) / (b_across - a_across), 0.0, 1.0);
        return a_along + t * (b_along - a_along);
    };
    const double one = at(std::clamp(low, std::min(a_across, b_across), std::max(a_across, b_across)));
    const double other = at(std::clamp(high, std::min(a_across, b_across), std::max(a_across, b_across)));
    from = std::min(one, other);
    to = std::max(one, other);
    if (a_across == b_across) {
        from = std::min(a_along, b_along);
        to = std::max(a_along, b_along);
    }
    return true;
}

// The sheet as cells, each free or not.
class Cells {
 public:
    Cells(const SheetArea& area, double spacing)
        : size_(std::max(area.width, area.height) / kCells),
          columns_(static_cast<int>(std::floor(area.width / size_ + 1e-9))),
          rows_(static_cast<int>(std::floor(area.height / size_ + 1e-9))),
          spacing_(spacing),
          taken_(
              static_cast<std::size_t>(std::max(columns_, 0)) * static_cast<std::size_t>(std::max(rows_, 0)),
              0) {}

    void block(const std::vector<PieceEdge>& edges) {
        for (int row = 0; row < rows_; ++row) {
            const double low = row * size_ - spacing_;
            const double high = (row + 1) * size_ + spacing_;
            crossings_.clear();
            const double middle = (row + 0.5) * size_;
            for (const PieceEdge& edge : edges) {
                double from = 0.0;
                double to = 0.0;
                if (range_within(edge.a.x, edge.a.y, edge.b.x, edge.b.y, low, high, from, to))
                    take(row, from - spacing_, to + spacing_);
                if ((edge.a.y > middle) == (edge.b.y > middle)) continue;
                const double t = (middle - edge.a.y) / (edge.b.y - edge.a.y);
                crossings_.push_back(edge.a.x + t * (edge.b.x - edge.a.x));
            }
            // Between its edges a piece covers what it covers; even and odd, as holes are edges too.
            std::sort(crossings_.begin(), crossings_.end());
            for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2)
                take(row, crossings_[i], crossings_[i + 1]);
        }
    }

    // The largest rectangle of free cells: for each row, the largest under the heights of free columns.
    [[nodiscard]] Box largest() const {
        std::vector<int> heights(static_cast<std::size_t>(std::max(columns_, 0)), 0);
        double best = 0.0;
        Box box;
        struct Step {
            int column, height;
        };
        std::vector<Step> steps;
        for (int row = 0; row < rows_; ++row) {
            steps.clear();
            for (int column = 0; column <= columns_; ++column) {
                int height = 0;
                if (column < columns_) {
                    int& h = nth(heights, column);
                    h = at(row, column) != 0 ? 0 : h + 1;
                    height = h;
                }
                // A rectangle that goes on is looked at where it ends.
                if (!steps.empty() && steps.back().height == height) continue;
                int start = column;
                while (!steps.empty() && steps.back().height >= height) {
                    const Step step = steps.back();
                    steps.pop_back();
                    start = step.column;
                    const double size = static_cast<double>(step.height) * (column - start);
                    if (size <= best) continue;
                    best = size;
                    box = Box{};
                    box.extend({start * size_, (row + 1 - step.height) * size_});
                    box.extend({column * size_, (row + 1) * size_});
                }
                if (height > 0) steps.push_back({start, height});
            }
        }
        return box;
    }

 private:
    // Where the cell stands in taken_.
    [[nodiscard]] std::size_t cell(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] char at(int row, int column) const { return taken_[cell(row, column)]; }
    // Every cell that the open range touches.
    void take(int row, double from, double to) {
        const int first = std::max(0, static_cast<int>(std::floor(from / size_)));
        const int last = std::min(columns_ - 1, static_cast<int>(std::ceil(to / size_)) - 1);
        for (int column = first; column <= last; ++column) {
            taken_[cell(row, column)] = 1;
        }
    }

    double size_;
    int columns_, rows_;
    double spacing_;
    std::vector<char> taken_;
    std::vector<double> crossings_;
};

// How far the box can be made larger along one axis, given the other, until it meets a piece's surroundings
// or the edge of the area.
void grow_along(double Vec2::*along, double Vec2::*across, Box& box, const std::vector<PieceEdge>& edges,
                double length, double spacing) {
    constexpr double kRounding = 1e-9;
    double low = 0.0;
    double high = length;
    for (const PieceEdge& edge : edges) {
        double from = 0.0;
        double to = 0.0;
        if (!range_within(edge.a.*along, edge.a.*across, edge.b.*along, edge.b.*across,
                          box.min.*across - spacing, box.max.*across + spacing, from, to)) {
            continue;
        }
        if (from - spacing >= box.max.*along - kRounding) high = std::min(high, from - spacing);
        if (to + spacing <= box.min.*along + kRounding) low = std::max(low, to + spacing);
    }
    box.min.*along = std::min(box.min.*along, low);
    box.max.*along = std::max(box.max.*along, high);
}

void add_edges(const GridRing& ring, std::vector<PieceEdge>& edges) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const GridPoint a = ring[i];
        const GridPoint b = ring[(i + 1) % ring.size()];
        edges.push_back({{from_grid(a.x), from_grid(a.y)}, {from_grid(b.x), from_grid(b.y)}});
    }
}

}  // namespace

Box largest_free(const std::vector<std::vector<GridRegion>>& pieces, const SheetArea& area, double spacing) {
    Cells cells(area, spacing);
    std::vector<PieceEdge> all;
    for (const std::vector<GridRegion>& piece : pieces) {
        for (const GridRegion& region : piece) {
            std::vector<PieceEdge> edges;
            add_edges(region.outer, edges);
            for (const GridRing& hole : region.holes) add_edges(hole, edges);
            cells.block(edges);
            all.insert(all.end(), edges.begin(), edges.end());
        }
    }
    Box box = cells.largest();
    if (box.empty()) return box;
    grow_along(&Vec2::x, &Vec2::y, box, all, area.width, spacing);
    grow_along(&Vec2::y, &Vec2::x, box, all, area.height, spacing);
    return box;
}

}  // namespace popup
