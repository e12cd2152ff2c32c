#include "nest/construct.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace popup {
namespace {

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

namespace {

class Constructor {
 public:
    Constructor(NestTask& task, Dice& dice, int lines)
        : task_(task),
          dice_(dice),
          lines_(lines),
          board_(task.set, task.loose, task.kinds, {}),
          taken_(task.rooms.size(), 0),
          turn_of_kind_(task.set.of_kind.size(), -1) {}

    Construction run(double shake) {
        place_locks();
        for (const Lot& lot : lots(shake)) {
            if (place(lot)) continue;
            result_.left_out.insert(result_.left_out.end(), lot.items.begin(), lot.items.end());
            throw_in(lot);
        }
        result_.arrangement.stands = board_.stands();
        result_.work = board_.work;
        return std::move(result_);
    }

 private:
    // What is placed as one: the items of a group, largest first, or an item alone.
    struct Lot {
        std::vector<int> items;
        double area = 0.0;  // mm²
        double key = 0.0;   // what lots are ordered by
        int bound = -1;     // the sheet on which locked items of the group lie; -1: any
    };

    std::vector<int>& rows() { return result_.arrangement.rows; }
    [[nodiscard]] int sheets() const { return static_cast<int>(result_.arrangement.rows.size()); }
    [[nodiscard]] double area_of(int item) const { return task_.set.areas[index(task_.kinds[index(item)])]; }
    [[nodiscard]] bool available(int row) const {
        const int count = task_.job.stock[index(row)].count;
        return count < 0 || taken_[index(row)] < count;
    }

    int open(int row) {
        rows().push_back(row);
        ++taken_[index(row)];
        const Room& room = task_.rooms[index(row)];
        board_.add_room(room);
        free_.push_back(room.width * room.height / (kGridSteps * kGridSteps));
        return sheets() - 1;
    }

    void close_last() {
        --taken_[index(rows().back())];
        rows().pop_back();
        free_.pop_back();
        board_.drop_last_room();
        std::erase_if(hopeless_, [&](const auto& known) { return known.first == sheets(); });
    }

    void settle_turn(int item, int shape) {
        const int kind = task_.kinds[index(item)];
        if (task_.job.kinds[index(kind)].one_turn) turn_of_kind_[index(kind)] = shape;
    }

    void place_locks() {
        for (int item = 0; item < board_.items(); ++item) {
            if (!task_.is_locked(item)) continue;
            const Stand& stand = task_.locks[index(item)];
            while (sheets() <= stand.sheet) open(task_.locked_rows[rows().size()]);
            board_.put(item, stand);
            free_[index(stand.sheet)] -= area_of(item);
            settle_turn(item, stand.shape);
        }
    }

    std::vector<Lot> lots(double shake) {
        std::vector<Lot> all;
        for (int item = 0; item < board_.items(); ++item) {
            if (!task_.is_locked(item) && task_.group_of[index(item)] < 0) all.push_back({{item}});
        }
        for (const std::vector<int>& group : task_.groups) {
            Lot lot;
            for (const int item : group) {
                if (task_.is_locked(item)) {
                    lot.bound = task_.locks[index(item)].sheet;
                } else {
                    lot.items.push_back(item);
                }
            }
            if (!lot.items.empty()) all.push_back(std::move(lot));
        }
        for (Lot& lot : all) {
            std::stable_sort(lot.items.begin(), lot.items.end(),
                             [&](int a, int b) { return area_of(a) > area_of(b); });
            for (const int item : lot.items) lot.area += area_of(item);
            lot.key = lot.area * (1.0 + shake * (dice_.unit() - 0.5));
        }
        std::stable_sort(all.begin(), all.end(), [](const Lot& a, const Lot& b) { return a.key > b.key; });
        return all;
    }

    // A shape in which the item fits on a sheet of the row; -1: none.
    [[nodiscard]] int fitting(int item, int row) const {
        const int kind = task_.kinds[index(item)];
        const int only = turn_of_kind_[index(kind)];
        for (const int shape : task_.set.of_kind[index(kind)]) {
            if ((only < 0 || only == shape) && task_.fits(shape, row)) return shape;
        }
        return -1;
    }
    [[nodiscard]] bool takes(int row, const Lot& lot) const {
        return std::all_of(lot.items.begin(), lot.items.end(),
                           [&](int item) { return fitting(item, row) >= 0; });
    }

    bool try_on(int sheet, const Lot& lot) {
        if (lot.area > free_[index(sheet)] * (1.0 + 1e-9)) return false;
        // A kind that found no place on a sheet will not find one when the sheet is fuller.
        const bool single = lot.items.size() == 1;
        const std::pair known{sheet, task_.kinds[index(lot.items.front())]};
        if (single && hopeless_.contains(known)) return false;
        if (!place_on(task_, board_, sheet, lot.items, dice_, lines_, turn_of_kind_)) {
            if (single) hopeless_.insert(known);
            return false;
        }
        free_[index(sheet)] -= lot.area;
        return true;
    }

    // On the first sheet that has a place for it, else on a new one.
    bool place(const Lot& lot) {
        if (lot.bound >= 0) return try_on(lot.bound, lot);
        for (int sheet = 0; sheet < sheets(); ++sheet) {
            if (try_on(sheet, lot)) return true;
        }
        for (const int row : task_.largest_first) {
            if (!available(row) || !takes(row, lot)) continue;
            if (try_on(open(row), lot)) return true;
            close_last();
        }
        return false;
    }

    // What found no place lies somewhere, over others, for the search to take apart: on a new sheet if there
    // is one, else on any that is large enough.
    void throw_in(const Lot& lot) {
        int sheet = lot.bound;
        for (const int row : task_.largest_first) {
            if (sheet >= 0 || !available(row) || !takes(row, lot)) continue;
            sheet = open(row);
            if (result_.left_out.size() == lot.items.size()) result_.alone = true;
        }
        if (sheet < 0) {
            std::vector<int> large;
            for (int s = 0; s < sheets(); ++s) {
                if (takes(rows()[index(s)], lot)) large.push_back(s);
            }
            if (!large.empty()) sheet = large[index(dice_.below(static_cast<int>(large.size())))];
        }
        if (sheet < 0 || !takes(rows()[index(sheet)], lot)) {
            result_.hopeless = true;
            return;
        }
        for (const int item : lot.items) {
            const int shape = fitting(item, rows()[index(sheet)]);
            const Board::Range range = board_.range(shape, sheet);
            board_.put(item, {sheet, shape, std::round(dice_.between(range.x0, range.x1)),
                              std::round(dice_.between(range.y0, range.y1))});
            settle_turn(item, shape);
        }
    }

    NestTask& task_;
    Dice& dice_;
    int lines_;
    Board board_;
    Construction result_;
    std::vector<int> taken_;                  // a row of the stock: how many sheets of it are open
    std::vector<double> free_;                // a sheet: mm² not covered yet
    std::vector<int> turn_of_kind_;           // of kinds that have one turn, once it is known; else -1
    std::set<std::pair<int, int>> hopeless_;  // sheet and kind
};

}  // namespace

Construction construct(NestTask& task, Dice& dice, int lines, double shake) {
    return Constructor(task, dice, lines).run(shake);
}

}  // namespace popup
