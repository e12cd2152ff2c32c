#include "nest/task.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace popup {
NestTask::NestTask(const NestJob& the_job)
    : job(the_job), set(make_shapes(the_job)), exact(set.shapes), loose(set.shapes, kSlack) {
    if (set.exact) tight = std::make_unique<NoFitTable>(set.shapes, 0.0);
    for (const NestStock& row : job.stock) {
        rooms.push_back({static_cast<double>(to_grid(row.width)), static_cast<double>(to_grid(row.height))});
    }
    largest_first.resize(rooms.size());
    std::iota(largest_first.begin(), largest_first.end(), 0);
    std::stable_sort(largest_first.begin(), largest_first.end(), [&](int a, int b) {
        return rooms[index(a)].width * rooms[index(a)].height >
               rooms[index(b)].width * rooms[index(b)].height;
    });
    std::map<int, std::vector<int>> by_name;
    for (std::size_t i = 0; i < job.items.size(); ++i) {
        const NestItem& item = job.items[i];
        kinds.push_back(item.kind);
        if (item.group >= 0) by_name[item.group].push_back(static_cast<int>(i));
        Stand stand{0, -1, 0.0, 0.0};
        if (item.locked) {
            const auto& shapes = set.of_kind[index(item.kind)];
            for (const int shape : shapes) {
                if (set.shapes[index(shape)].angle != item.locked->angle) continue;
                stand = {item.locked->sheet, shape, static_cast<double>(to_grid(item.locked->offset.x)),
                         static_cast<double>(to_grid(item.locked->offset.y))};
            }
        }
        locks.push_back(stand);
    }
    choose_locked_rows();
    group_of.assign(job.items.size(), -1);
    for (auto& [name, items] : by_name) {
        if (items.size() < 2) continue;
        for (const int item : items) group_of[index(item)] = static_cast<int>(groups.size());
        groups.push_back(std::move(items));
    }
}

void NestTask::choose_locked_rows() {
    // Sheets further on than there are pieces are refused anyway.
    int sheets = 0;
    for (const Stand& lock : locks) {
        if (lock.shape >= 0 && index(lock.sheet) < locks.size()) sheets = std::max(sheets, lock.sheet + 1);
    }
    std::vector<int> taken(rooms.size(), 0);
    const auto available = [&](int row) {
        const int count = job.stock[index(row)].count;
        return count < 0 || taken[index(row)] < count;
    };
    locked_rows.assign(index(sheets), -1);
    for (const bool with_locks : {true, false}) {
        for (int sheet = 0; sheet < sheets; ++sheet) {
            bool locked = false;
            int& best = locked_rows[index(sheet)];
            if (best >= 0) continue;
            for (const int row : largest_first) {
                bool takes = available(row);
                for (const Stand& lock : locks) {
                    if (lock.shape < 0 || lock.sheet != sheet) continue;
                    locked = true;
                    takes = takes && lies_in(lock, row);
                }
                // With locks the last that takes them is the smallest.
                if (takes && (locked || best < 0)) best = row;
            }
            if (locked != with_locks) best = -1;
            if (best >= 0) ++taken[index(best)];
        }
    }
}

bool NestTask::lies_in(const Stand& stand, int row) const {
    const GridBox& box = set.shapes[index(stand.shape)].bounds;
    const Room& room = rooms[index(row)];
    return stand.x + static_cast<double>(box.x0) >= 0.0 && stand.y + static_cast<double>(box.y0) >= 0.0 &&
           stand.x + static_cast<double>(box.x1) <= room.width &&
           stand.y + static_cast<double>(box.y1) <= room.height;
}

bool NestTask::has_locks() const {
    return std::any_of(locks.begin(), locks.end(), [](const Stand& lock) { return lock.shape >= 0; });
}

bool NestTask::fits(int shape, int row) const {
    const GridBox& box = set.shapes[index(shape)].bounds;
    const Room& room = rooms[index(row)];
    return static_cast<double>(box.width()) <= room.width && static_cast<double>(box.height()) <= room.height;
}

double Arrangement::length(const NestTask& task, int sheet) const {
    double length = 0.0;
    for (const Stand& stand : stands) {
        if (stand.sheet != sheet) continue;
        length =
            std::max(length, stand.x + static_cast<double>(task.set.shapes[index(stand.shape)].bounds.x1));
    }
    return length;
}

bool Arrangement::better_than(const Arrangement& other, const NestTask& task) const {
    if (rows.size() != other.rows.size()) return rows.size() < other.rows.size();
    const int last = static_cast<int>(rows.size()) - 1;
    return length(task, last) < other.length(task, last);
}

ExactPlace exact_place(const Stand& stand) {
    return {stand.sheet, stand.shape, {static_cast<GridLength>(stand.x), static_cast<GridLength>(stand.y)}};
}

std::vector<int> emptiest_sheets(const NestTask& task, const Arrangement& layout) {
    std::vector<double> areas(layout.rows.size(), 0.0);
    int first = 0;
    for (int item = 0; item < static_cast<int>(layout.stands.size()); ++item) {
        const int sheet = nth(layout.stands, item).sheet;
        nth(areas, sheet) += nth(task.set.areas, nth(task.kinds, item));
        if (task.is_locked(item)) first = std::max(first, sheet + 1);
    }
    std::vector<int> order(layout.rows.size());
    std::iota(order.begin(), order.end(), 0);
    order.erase(order.begin(), order.begin() + first);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return nth(areas, a) < nth(areas, b); });
    return order;
}

bool Arrangement::holds(const NestTask& task) const {
    std::vector<ExactPlace> places;
    places.reserve(stands.size());
    for (const Stand& stand : stands) {
        const ExactPlace place = exact_place(stand);
        const GridPoint at = place.at;
        const GridBox& box = task.set.shapes[index(stand.shape)].bounds;
        const NestStock& stock = task.job.stock[index(rows[index(stand.sheet)])];
        if (box.x0 + at.x < 0 || box.y0 + at.y < 0 || box.x1 + at.x > to_grid(stock.width) ||
            box.y1 + at.y > to_grid(stock.height)) {
            return false;
        }
        places.push_back(place);
    }
    return !task.exact.first_conflict(places, to_grid(task.job.spacing));
}

Freedom freedom_of(const NestTask& task, const std::vector<Stand>& stands) {
    Freedom freedom;
    for (std::size_t i = 0; i < stands.size(); ++i) {
        const int item = static_cast<int>(i);
        const int kind = task.kinds[i];
        freedom.movable.push_back(task.is_locked(item) ? 0 : 1);
        if (task.job.kinds[index(kind)].one_turn) {
            freedom.shapes.push_back({stands[i].shape});
        } else {
            freedom.shapes.push_back(task.set.of_kind[index(kind)]);
        }
        freedom.sheets.emplace_back();
        if (task.group_of[i] >= 0) freedom.sheets.back().push_back(stands[i].sheet);
    }
    return freedom;
}

}  // namespace popup
