#include "trace/cells.h"

#include <algorithm>

#include "trace/cell_sets.h"

namespace popup {
namespace {

// Scanned from the top left, a cell that is added makes no new corner in what has been scanned: it lies in
// the lower row, below or beside a cell of the figure.
void join_corners(CellGrid& cells) {
    for (int y = 0; y + 1 < cells.height; ++y) {
        for (int x = 0; x + 1 < cells.width; ++x) {
            const std::size_t upper = cells.at(x, y);
            const std::size_t lower = cells.at(x, y + 1);
            std::uint8_t* const all = cells.inside.data();
            if (all[upper] != all[lower + 1] || all[upper + 1] != all[lower] ||
                all[upper] == all[upper + 1]) {
                continue;
            }
            all[all[upper] != 0 ? lower : lower + 1] = 1;
        }
    }
}

// What hangs together by its edges, figure or ground alike.
CellSets parts_of(const CellGrid& cells) {
    CellSets sets(cells.inside.size());
    for (int y = 0; y < cells.height; ++y) {
        for (int x = 0; x < cells.width; ++x) {
            const std::size_t here = cells.at(x, y);
            const auto width = static_cast<std::size_t>(cells.width);
            if (x > 0 && cells.inside[here - 1] == cells.inside[here]) sets.join(here - 1, here);
            if (y > 0 && cells.inside[here - width] == cells.inside[here]) sets.join(here - width, here);
        }
    }
    return sets;
}

// Turns over the parts of this kind that `goes` says, by their first cells and by how many cells they have.
// What is around everything stays.
template <typename Goes>
Cleaned::Dropped turn_over(CellGrid& cells, CellSets& sets, const std::vector<std::uint32_t>& sizes,
                           std::uint8_t kind, const Goes& goes) {
    Cleaned::Dropped dropped;
    const std::size_t around = sets.first(0);
    std::vector<std::uint8_t> gone(cells.inside.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] == 0 || cells.inside[i] != kind || i == around || !goes(i, sizes[i])) continue;
        gone[i] = 1;
        ++dropped.count;
        dropped.largest = std::max<std::size_t>(dropped.largest, sizes[i]);
    }
    if (dropped.count == 0) return dropped;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (gone[sets.first(i)] != 0) cells.inside[i] = 1 - kind;
    }
    return dropped;
}

std::vector<std::uint32_t> sizes_of(CellSets& sets, std::size_t count) {
    std::vector<std::uint32_t> sizes(count);
    for (std::size_t i = 0; i < count; ++i) ++sizes[sets.first(i)];
    return sizes;
}

}  // namespace

CellGrid cells_of(const PixelMask& mask, int pixels) {
    CellGrid cells;
    cells.width = (mask.width + pixels - 1) / pixels + 2;
    cells.height = (mask.height + pixels - 1) / pixels + 2;
    cells.inside.resize(cells.at(0, cells.height));
    std::vector<int> counts(static_cast<std::size_t>(cells.width));
    for (int y = 1; y + 1 < cells.height; ++y) {
        std::fill(counts.begin(), counts.end(), 0);
        const int below = std::min(mask.height, y * pixels);
        for (int row = (y - 1) * pixels; row < below; ++row) {
            const std::uint8_t* const line =
                &mask.inside[static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width)];
            for (int x = 0; x < mask.width; ++x) counts[static_cast<std::size_t>(x / pixels) + 1] += line[x];
        }
        for (int x = 1; x + 1 < cells.width; ++x) {
            cells.inside[cells.at(x, y)] = 2 * counts[static_cast<std::size_t>(x)] >= pixels * pixels ? 1 : 0;
        }
    }
    join_corners(cells);
    return cells;
}

Cleaned clean(CellGrid& cells, const Cleaning& how) {
    Cleaned cleaned;
    const auto is_small = [&how](std::size_t /*first*/, std::uint32_t size) { return size < how.least_area; };
    for (const std::uint8_t kind : {std::uint8_t{1}, std::uint8_t{0}}) {
        CellSets sets = parts_of(cells);
        const std::vector<std::uint32_t> sizes = sizes_of(sets, cells.inside.size());
        (kind == 1 ? cleaned.specks : cleaned.holes) = turn_over(cells, sets, sizes, kind, is_small);
    }
    if (!how.largest) return cleaned;
    CellSets sets = parts_of(cells);
    const std::vector<std::uint32_t> sizes = sizes_of(sets, cells.inside.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (cells.inside[i] == 1 && sizes[i] > (kept == 0 ? 0 : sizes[kept])) kept = i;
    }
    cleaned.others = turn_over(cells, sets, sizes, 1,
                               [kept](std::size_t first, std::uint32_t /*size*/) { return first != kept; });
    return cleaned;
}

}  // namespace popup
