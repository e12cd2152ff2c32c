#include "nest/construct.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace popup {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// The place of least reach for one item on one sheet; false when none was found.
bool find_place(const NestTask& task, Board& board, int item, int sheet, Dice& dice, int lines,
                int only_shape, Stand& best) {
    double least = HUGE_VAL;
    for (const int shape : task.set.of_kind[index(task.kinds[index(item)])]) {
        if (only_shape >= 0 && shape != only_shape) continue;
        const Board::Range range = board.range(shape, sheet);
        if (range.empty()) continue;
        const GridBox& box = board.shape(shape).bounds;
        for (int i = 0; i < lines + 2; ++i) {
            const double y = i == 0   ? range.y0
                             : i == 1 ? range.y1
                                      : std::round(dice.between(range.y0, range.y1));
            Stand stand{sheet, shape, range.x0, y};
            if (board.best_on_line(item, stand, Board::Along::x, range.x0, range.x1, Board::Among::first) >
                0.0)
                continue;
            const double reach = stand.x + static_cast<double>(box.x1);
            if (reach < least || (reach == least && stand.y < best.y)) {
                least = reach;
                best = stand;
            }
        }
    }
    if (least == HUGE_VAL) return false;
    // Down, then left again: towards the corner.
    const Board::Range range = board.range(best.shape, sheet);
    for (int k = 0; k < 3; ++k) {
        Stand down = best;
        if (board.best_on_line(item, down, Board::Along::y, range.y0, best.y, Board::Among::first) > 0.0)
            break;
        Stand left = down;
        if (board.best_on_line(item, left, Board::Along::x, range.x0, down.x, Board::Among::first) > 0.0)
            break;
        if (left.x == best.x && left.y == best.y) break;
        best = left;
    }
    return true;
}

}  // namespace

bool place_on(NestTask& task, Board& board, int sheet, const std::vector<int>& items, Dice& dice, int lines,
              std::vector<int>& turn_of_kind) {
    const std::vector<int> before = turn_of_kind;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const int kind = task.kinds[index(items[i])];
        Stand stand;
        if (find_place(task, board, items[i], sheet, dice, lines, turn_of_kind[index(kind)], stand)) {
            board.put(items[i], stand);
            if (task.job.kinds[index(kind)].one_turn) turn_of_kind[index(kind)] = stand.shape;
            continue;
        }
        for (std::size_t k = 0; k < i; ++k) board.take(items[k]);
        turn_of_kind = before;
        return false;
    }
    return true;
}

Construction construct(NestTask& task, Dice& dice, int lines, double shake) {
    Construction result;
    std::vector<int>& rows = result.arrangement.rows;
    std::vector<int> taken(task.rooms.size(), 0);
    std::vector<double> free;  // a sheet: area not covered yet
    Board board(task.set, task.loose, task.kinds, {});
    const auto open = [&](int row) {
        rows.push_back(row);
        ++taken[index(row)];
        const Room& room = task.rooms[index(row)];
        board.add_room(room);
        free.push_back(room.width * room.height / (kGridSteps * kGridSteps));
    };
    const auto available = [&](int row) {
        const int count = task.job.stock[index(row)].count;
        return count < 0 || taken[index(row)] < count;
    };
    const auto area_of = [&](int item) { return task.set.areas[index(task.kinds[index(item)])]; };

    std::vector<int> turn_of_kind(task.set.of_kind.size(), -1);
    for (int item = 0; item < static_cast<int>(task.kinds.size()); ++item) {
        if (!task.is_locked(item)) continue;
        const Stand& stand = task.locks[index(item)];
        while (static_cast<int>(rows.size()) <= stand.sheet) {
            open(task.locked_rows[rows.size()]);
        }
        board.put(item, stand);
        free[index(stand.sheet)] -= area_of(item);
        const int kind = task.kinds[index(item)];
        if (task.job.kinds[index(kind)].one_turn) turn_of_kind[index(kind)] = stand.shape;
    }

    // Groups are placed as one; an item alone is a group of one.
    struct Lot {
        std::vector<int> items;
        double area = 0.0;
        double key = 0.0;
    };
    std::vector<Lot> lots;
    const auto add_lot = [&](std::vector<int> items) {
        Lot lot;
        std::stable_sort(items.begin(), items.end(), [&](int a, int b) { return area_of(a) > area_of(b); });
        for (const int item : items) lot.area += area_of(item);
        lot.key = lot.area * (1.0 + shake * (dice.unit() - 0.5));
        lot.items = std::move(items);
        lots.push_back(std::move(lot));
    };
    for (int item = 0; item < static_cast<int>(task.kinds.size()); ++item) {
        if (!task.is_locked(item) && task.group_of[index(item)] < 0) add_lot({item});
    }
    std::vector<int> bound_to;  // a lot: the sheet on which locked items of its group lie; -1: any
    bound_to.assign(lots.size(), -1);
    for (const std::vector<int>& group : task.groups) {
        std::vector<int> items;
        int sheet = -1;
        for (const int item : group) {
            if (task.is_locked(item)) {
                sheet = task.locks[index(item)].sheet;
            } else {
                items.push_back(item);
            }
        }
        if (items.empty()) continue;
        add_lot(std::move(items));
        bound_to.push_back(sheet);
    }
    std::vector<int> order(lots.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return lots[index(a)].key > lots[index(b)].key; });

    // What found no place lies somewhere, over others, for the search to take apart: on a new sheet if there
    // is one, else on any that is large enough.
    const auto throw_in = [&](const Lot& lot, int bound) {
        const auto fitting = [&](int item, int row) {
            const int kind = task.kinds[index(item)];
            for (const int shape : task.set.of_kind[index(kind)]) {
                const int only = turn_of_kind[index(kind)];
                if ((only < 0 || only == shape) && task.fits(shape, row)) return shape;
            }
            return -1;
        };
        const auto takes = [&](int row) {
            return std::all_of(lot.items.begin(), lot.items.end(),
                               [&](int item) { return fitting(item, row) >= 0; });
        };
        int sheet = bound;
        if (sheet < 0) {
            for (const int row : task.largest_first) {
                if (!available(row) || !takes(row)) continue;
                open(row);
                sheet = static_cast<int>(rows.size()) - 1;
                if (result.left_out.size() == lot.items.size()) result.alone = true;
                break;
            }
        }
        std::vector<int> sheets;
        for (int s = 0; s < static_cast<int>(rows.size()); ++s) {
            if (takes(rows[index(s)])) sheets.push_back(s);
        }
        if (sheet < 0 && !sheets.empty()) sheet = sheets[index(dice.below(static_cast<int>(sheets.size())))];
        if (sheet < 0 || !takes(rows[index(sheet)])) {
            result.hopeless = true;
            return;
        }
        for (const int item : lot.items) {
            const int shape = fitting(item, rows[index(sheet)]);
            const Board::Range range = board.range(shape, sheet);
            board.put(item, {sheet, shape, std::round(dice.between(range.x0, range.x1)),
                             std::round(dice.between(range.y0, range.y1))});
            const int kind = task.kinds[index(item)];
            if (task.job.kinds[index(kind)].one_turn) turn_of_kind[index(kind)] = shape;
        }
    };

    // A kind that found no place on a sheet will not find one when the sheet is fuller.
    std::set<std::pair<int, int>> hopeless;
    for (const int number : order) {
        const Lot& lot = lots[index(number)];
        const bool single = lot.items.size() == 1;
        const int kind = task.kinds[index(lot.items.front())];
        const int bound = bound_to[index(number)];
        bool done = false;
        const auto try_on = [&](int sheet) {
            if (lot.area > free[index(sheet)] * (1.0 + 1e-9)) return false;
            if (single && hopeless.contains({sheet, kind})) return false;
            if (!place_on(task, board, sheet, lot.items, dice, lines, turn_of_kind)) {
                if (single) hopeless.insert({sheet, kind});
                return false;
            }
            free[index(sheet)] -= lot.area;
            return true;
        };
        if (bound >= 0) {
            done = try_on(bound);
        } else {
            for (int sheet = 0; !done && sheet < static_cast<int>(rows.size()); ++sheet) done = try_on(sheet);
            for (const int row : task.largest_first) {
                if (done) break;
                if (!available(row)) continue;
                const bool takes = std::all_of(lot.items.begin(), lot.items.end(), [&](int item) {
                    const auto& shapes = task.set.of_kind[index(task.kinds[index(item)])];
                    return std::any_of(shapes.begin(), shapes.end(),
                                       [&](int shape) { return task.fits(shape, row); });
                });
                if (!takes) continue;
                open(row);
                done = try_on(static_cast<int>(rows.size()) - 1);
                if (!done) {
                    rows.pop_back();
                    --taken[index(row)];
                    free.pop_back();
                    board.drop_last_room();
                    std::erase_if(hopeless, [&](const auto& known) {
                        return known.first == static_cast<int>(rows.size());
                    });
                }
            }
        }
        if (done) continue;
        result.left_out.insert(result.left_out.end(), lot.items.begin(), lot.items.end());
        throw_in(lot, bound);
    }
    result.arrangement.stands = board.stands();
    result.work = board.work;
    return result;
}

}  // namespace popup
