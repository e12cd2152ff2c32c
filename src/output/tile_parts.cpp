#include "output/tile_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "output/text_outlines.h"

namespace popup {
namespace {

// How far curves may leave the chords that stand for them, with room to spare.
constexpr double kChordRoomMm = 0.05;

double reach_of(const SheetShape& shape) {
    return (shape.filled ? 0.0 : 0.5 * shape.width_mm) + kChordRoomMm;
}

Box grown(Box box, double by) { return {{box.min.x - by, box.min.y - by}, {box.max.x + by, box.max.y + by}}; }

Box box_of(const SheetText& text) {
    Box box;
    for (const Ring& letter : text_outlines(text.text, text.at, text.cap_mm, text.angle, text.font)) {
        for (const Vec2 p : letter) box.extend(p);
    }
    if (box.empty()) {
        // Without the font: no letter is wider than two of its sizes.
        const double most = static_cast<double>(text.text.size()) * text.cap_mm / kCapHeight;
        box.extend(text.at);
        return grown(box, most);
    }
    return grown(box, kChordRoomMm);
}

template <typename Use>
void each_segment(const SheetDrawing& drawing, const SheetShape& shape, Use use) {
    for (const Run& run : drawing.runs_of(shape)) {
        const std::span<const Vec2> points = drawing.points_of(run);
        if (points.size() == 1) use(points.front(), points.front());
        for (std::size_t i = 1; i < points.size(); ++i) use(points[i - 1], points[i]);
        if ((run.closed || shape.filled) && points.size() > 1) use(points.back(), points.front());
    }
}

// The tiles [first, last] of a row or column of them that an interval meets.
struct Range {
    int first = 0, last = -1;
};

Range meeting(double from, double to, double length, double step, int count) {
    // Tile i is [i step, i step + length]. One alone may be shorter than what tiles overlap by.
    if (count == 1) return {0, to >= 0.0 && from <= length ? 0 : -1};
    const double first = std::ceil((from - length) / step);
    const double last = std::floor(to / step);
    return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(count))),
            static_cast<int>(std::clamp(last, -1.0, static_cast<double>(count - 1)))};
}

class Sorter {
 public:
    Sorter(const TileGrid& grid, const SheetDrawing& drawing)
        : grid_(grid),
          drawing_(drawing),
          parts_(static_cast<std::size_t>(grid.tiles())),
          marked_(parts_.size(), std::numeric_limits<std::size_t>::max()),
          crossings_(static_cast<std::size_t>(grid.rows)) {}

    std::vector<SheetPart> sort() {
        for (std::size_t i = 0; i < drawing_.shapes.size(); ++i) {
            const SheetShape& shape = drawing_.shapes[i];
            const double reach = reach_of(shape);
            each_segment(drawing_, shape, [&](Vec2 a, Vec2 b) { line(i, a, b, reach); });
            if (shape.filled) inside(i, shape);
        }
        for (std::size_t i = 0; i < drawing_.texts.size(); ++i) {
            const Box box = box_of(drawing_.texts[i]);
            const Range rows = rows_of(box.min.y, box.max.y);
            const Range columns = columns_of(box.min.x, box.max.x);
            for (int row = rows.first; row <= rows.last; ++row) {
                for (int column = columns.first; column <= columns.last; ++column)
                    parts_[grid_.index(row, column)].texts.push_back(i);
            }
        }
        return std::move(parts_);
    }

 private:
    [[nodiscard]] Range columns_of(double from, double to) const {
        return meeting(from - grid_.area.min.x, to - grid_.area.min.x, grid_.width_mm,
                       grid_.width_mm - kTileOverlapMm, grid_.columns);
    }
    [[nodiscard]] Range rows_of(double from, double to) const {
        return meeting(grid_.area.max.y - to, grid_.area.max.y - from, grid_.height_mm,
                       grid_.height_mm - kTileOverlapMm, grid_.rows);
    }

    void mark(std::size_t shape, int row, int column) {
        const std::size_t index = grid_.index(row, column);
        if (std::exchange(marked_[index], shape) != shape) parts_[index].shapes.push_back(shape);
    }

    // Row by row, so that a slanting line meets only tiles that it passes.
    void line(std::size_t shape, Vec2 a, Vec2 b, double reach) {
        const Range rows = rows_of(std::min(a.y, b.y) - reach, std::max(a.y, b.y) + reach);
        for (int row = rows.first; row <= rows.last; ++row) {
            const Box tile = grown(grid_.tile(row, 0), reach);
            double from = 0.0;
            double to = 1.0;
            if (a.y != b.y) {
                const auto [enter, leave] =
                    std::minmax({(tile.min.y - a.y) / (b.y - a.y), (tile.max.y - a.y) / (b.y - a.y)});
                from = std::clamp(enter, 0.0, 1.0);
                to = std::clamp(leave, 0.0, 1.0);
            }
            const auto [left, right] = std::minmax({lerp(a, b, from).x, lerp(a, b, to).x});
            const Range columns = columns_of(left - reach, right + reach);
            for (int column = columns.first; column <= columns.last; ++column) mark(shape, row, column);
        }
    }

    // Tiles that no line of the area passes lie in it or out of it as their middles do.
    void inside(std::size_t index, const SheetShape& shape) {
        Box box;
        each_segment(drawing_, shape, [&](Vec2 a, Vec2 b) {
            box.extend(a);
            box.extend(b);
        });
        const Range rows = rows_of(box.min.y, box.max.y);
        if (box.empty() || rows.last < rows.first) return;
        each_segment(drawing_, shape, [&](Vec2 a, Vec2 b) {
            const Range own = rows_of(std::min(a.y, b.y), std::max(a.y, b.y));
            for (int row = own.first; row <= own.last; ++row) {
                const double y = grid_.tile(row, 0).centre().y;
                if ((a.y > y) == (b.y > y)) continue;
                crossings_[static_cast<std::size_t>(row)].emplace_back(
                    a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), b.y > a.y ? 1 : -1);
            }
        });
        const Range columns = columns_of(box.min.x, box.max.x);
        for (int row = rows.first; row <= rows.last; ++row) {
            auto& crossings = crossings_[static_cast<std::size_t>(row)];
            std::sort(crossings.begin(), crossings.end());
            std::size_t passed = 0;
            int winding = 0;
            for (int column = columns.first; column <= columns.last; ++column) {
                const double x = grid_.tile(row, column).centre().x;
                for (; passed < crossings.size() && crossings[passed].first <= x; ++passed)
                    winding += crossings[passed].second;
                const bool is_in = shape.operation == Operation::fill ? passed % 2 == 1 : winding != 0;
                if (is_in) mark(index, row, column);
            }
            crossings.clear();
        }
    }

    const TileGrid& grid_;
    const SheetDrawing& drawing_;
    std::vector<SheetPart> parts_;
    std::vector<std::size_t> marked_;                             // of each tile the last shape that is on it
    std::vector<std::vector<std::pair<double, int>>> crossings_;  // of a row's middle line; direction
};

}  // namespace

Box drawn_box(const SheetDrawing& drawing) {
    Box box;
    for (const SheetShape& shape : drawing.shapes) {
        const double reach = shape.filled ? 0.0 : 0.5 * shape.width_mm;
        for (const Run& run : drawing.runs_of(shape)) {
            for (const Vec2 p : drawing.points_of(run)) {
                box.extend({p.x - reach, p.y - reach});
                box.extend({p.x + reach, p.y + reach});
            }
        }
    }
    for (const SheetText& text : drawing.texts) {
        const Box own = box_of(text);
        box.extend(own.min);
        box.extend(own.max);
    }
    const Box on_sheet{{std::max(box.min.x, 0.0), std::max(box.min.y, 0.0)},
                       {std::min(box.max.x, drawing.width_mm), std::min(box.max.y, drawing.height_mm)}};
    return on_sheet.min.x > on_sheet.max.x || on_sheet.min.y > on_sheet.max.y ? Box{} : on_sheet;
}

std::vector<SheetPart> tile_parts(const TileGrid& grid, const SheetDrawing& drawing) {
    return Sorter(grid, drawing).sort();
}

}  // namespace popup
