#include "nest/bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace popup {
namespace {

// Of more pieces no two are looked at that cannot share a sheet.
constexpr std::size_t kFewToPart = 200;

// Whether one shape overlaps the other wherever both lie in a sheet of this row.
bool always_overlap(NestTask& task, int a, int b, int row) {
    const GridBox& one = task.set.shapes[index(a)].bounds;
    const GridBox& other = task.set.shapes[index(b)].bounds;
    const Room& room = task.rooms[index(row)];
    // Where a may be, seen from b, and a little more: touching is allowed, and tables round.
    constexpr double kMore = 2.0 * kSlack;
    const auto x0 = static_cast<double>(other.x1 - one.x0) - room.width - kMore;
    const auto y0 = static_cast<double>(other.y1 - one.y0) - room.height - kMore;
    const auto x1 = static_cast<double>(other.x0 - one.x1) + room.width + kMore;
    const auto y1 = static_cast<double>(other.y0 - one.y1) + room.height + kMore;
    NoFitTable& table = task.first_table();
    NoFit made;
    if (!table.keeps()) table.make(a, b, made);
    const NoFit& fit = table.keeps() ? table.of(a, b) : made;
    return covers(fit, {x0, y0, x1, y1}, 0);
}

// What a piece takes at the least, in mm²: what lies within half the spacing of it is no other piece's.
// Brunn and Minkowski say how much that is, whatever its outline.
double area_with_spacing(const NestTask& task, int item) {
    const double area = task.set.areas[index(task.kinds[index(item)])];
    const double side = std::sqrt(area) + 0.5 * std::sqrt(std::numbers::pi) * task.job.spacing;
    return side * side;
}

bool parts_from(NestTask& task, int item, const std::vector<int>& others) {
    return std::all_of(others.begin(), others.end(), [&](int other) {
        return must_part(task, task.kinds[index(item)], task.kinds[index(other)]);
    });
}

std::vector<int> largest_first(const NestTask& task) {
    std::vector<int> items(task.kinds.size());
    std::iota(items.begin(), items.end(), 0);
    std::stable_sort(items.begin(), items.end(), [&](int a, int b) {
        return task.set.areas[index(task.kinds[index(a)])] > task.set.areas[index(task.kinds[index(b)])];
    });
    return items;
}

// Pieces, the largest first, of which no two share a sheet: as many as there are sheets.
bool too_many_part(NestTask& task, std::size_t sheets) {
    if (task.kinds.size() > kFewToPart) return false;
    std::vector<int> parted;
    for (const int item : largest_first(task)) {
        if (parts_from(task, item, parted)) parted.push_back(item);
        if (parted.size() >= sheets) return true;
    }
    return false;
}

// The least width of the kind's shapes that fit on a sheet of the row, in steps; HUGE_VAL: none does.
double narrowest(const NestTask& task, int kind, int row) {
    double least = HUGE_VAL;
    for (const int shape : task.set.of_kind[index(kind)]) {
        if (task.fits(shape, row))
            least = std::min(least, static_cast<double>(task.set.shapes[index(shape)].bounds.width()));
    }
    return least;
}

}  // namespace

bool must_part(NestTask& task, int a, int b) {
    for (const int row : task.largest_first) {
        for (const int one : task.set.of_kind[index(a)]) {
            for (const int other : task.set.of_kind[index(b)]) {
                if (task.fits(one, row) && task.fits(other, row) && !always_overlap(task, one, other, row))
                    return false;
            }
        }
    }
    return true;
}

bool could_be_fewer(NestTask& task, const Arrangement& layout) {
    if (layout.rows.size() < 2) return false;
    const double spacing = task.job.spacing;
    std::vector<double> sizes;
    for (const int row : layout.rows) {
        const NestStock& stock = task.job.stock[index(row)];
        sizes.push_back((stock.width + spacing) * (stock.height + spacing) * (1.0 + 1e-9));
    }
    double area = 0.0;
    for (int item = 0; item < static_cast<int>(task.kinds.size()); ++item)
        area += area_with_spacing(task, item);
    const double all = std::accumulate(sizes.begin(), sizes.end(), 0.0);
    const double least = *std::min_element(sizes.begin(), sizes.end());
    return area <= all - least && !too_many_part(task, layout.rows.size());
}

std::vector<char> known_last(NestTask& task, const Arrangement& layout) {
    std::vector<char> on_last(task.kinds.size(), 0);
    const std::size_t others = layout.rows.size() - 1;
    if (others == 0 || task.has_locks() || task.kinds.size() > kFewToPart) return on_last;
    const double length = layout.length(task, static_cast<int>(others));
    const std::vector<int> order = largest_first(task);
    std::vector<int> wide;
    for (const int item : order) {
        if (narrowest(task, task.kinds[index(item)], layout.rows.back()) < length) continue;
        if (parts_from(task, item, wide)) wide.push_back(item);
        if (wide.size() == others) break;
    }
    if (wide.size() < others) return on_last;
    for (const int item : order) {
        if (std::find(wide.begin(), wide.end(), item) == wide.end() && parts_from(task, item, wide))
            on_last[index(item)] = 1;
    }
    return on_last;
}

double least_length(const NestTask& task, const std::vector<int>& rows, const std::vector<char>& on_last) {
    double area = 0.0;
    double area_on_last = 0.0;
    double widest = 0.0;
    for (std::size_t i = 0; i < task.kinds.size(); ++i) {
        const bool is_known = !on_last.empty() && on_last[i] != 0;
        const double own = task.set.areas[index(task.kinds[i])] * kGridSteps * kGridSteps;
        area += own;
        if (is_known) area_on_last += own;
        if (task.is_locked(static_cast<int>(i))) {
            const Stand& lock = task.locks[i];
            if (lock.sheet + 1 != static_cast<int>(rows.size())) continue;
            const GridBox& box = task.set.shapes[index(lock.shape)].bounds;
            widest = std::max(widest, lock.x + static_cast<double>(box.x1));
            continue;
        }
        const std::vector<int>& shapes = task.set.of_kind[index(task.kinds[i])];
        const bool elsewhere = !is_known && std::any_of(rows.begin(), rows.end() - 1, [&](int row) {
            return std::any_of(shapes.begin(), shapes.end(),
                               [&](int shape) { return task.fits(shape, row); });
        });
        if (!elsewhere) widest = std::max(widest, narrowest(task, task.kinds[i], rows.back()));
    }
    for (std::size_t s = 0; s + 1 < rows.size(); ++s) {
        const Room& room = task.rooms[index(rows[s])];
        area -= room.width * room.height;
    }
    return std::max(widest, std::max(area, area_on_last) / task.rooms[index(rows.back())].height);
}

}  // namespace popup
