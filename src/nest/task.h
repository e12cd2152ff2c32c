// A nesting job made ready: what every part of the search looks at and none changes.
#pragma once

#include <memory>
#include <vector>

#include "base/nth.h"
#include "nest/board.h"
#include "nest/exact.h"
#include "nest/separate.h"
#include "popup/nest.h"

namespace popup {

struct NestTask {
    explicit NestTask(const NestJob& job);

    const NestJob& job;
    ShapeSet set;
    ExactShapes exact;
    NoFitTable loose;                      // with room for rounding: what is apart in it is apart in truth
    std::unique_ptr<NoFitTable> tight;     // without, where pieces may have to touch exactly; else null
    std::vector<int> kinds;                // an item: its kind
    std::vector<Room> rooms;               // a row of the stock: its size
    std::vector<int> largest_first;        // rows of the stock by area
    std::vector<std::vector<int>> groups;  // items that share a sheet; an item alone is in none
    std::vector<int> group_of;             // an item: its group or -1
    std::vector<Stand> locks;              // an item: where it is locked; shape -1: free
    // The rows of the sheets up to the last that has a lock: the smallest in which its locks lie, of sheets
    // without locks the largest there is; -1 where there is none.
    std::vector<int> locked_rows;

    void choose_locked_rows();
    [[nodiscard]] NoFitTable& first_table() { return tight ? *tight : loose; }
    // Whether the shape fits on a sheet of this row.
    [[nodiscard]] bool fits(int shape, int row) const;
    [[nodiscard]] bool lies_in(const Stand& stand, int row) const;
    [[nodiscard]] bool is_locked(int item) const { return nth(locks, item).shape >= 0; }
    [[nodiscard]] bool has_locks() const;
};

// A layout as the search passes it on. The last sheet is the one that is kept short.
struct Arrangement {
    std::vector<Stand> stands;  // of each item
    std::vector<int> rows;      // of each sheet, its row of the stock

    // How far the pieces of a sheet reach, in steps.
    [[nodiscard]] double length(const NestTask& task, int sheet) const;
    // Fewer sheets are better, then a shorter last one.
    [[nodiscard]] bool better_than(const Arrangement& other, const NestTask& task) const;
    // Whether nothing overlaps and everything is in place, in integers.
    [[nodiscard]] bool holds(const NestTask& task) const;
};

// Where a stand is, for the exact check. Precondition: its coordinates are whole steps.
ExactPlace exact_place(const Stand& stand);

// The sheets that can be done without, the emptiest first: those with no lock on them nor on one after them,
// since locks name their sheets by number.
std::vector<int> emptiest_sheets(const NestTask& task, const Arrangement& layout);

// The freedom of a search: locked items stay, items of a group stay on the sheets they are on, and items of a
// kind that has one turn keep the shape they have.
Freedom freedom_of(const NestTask& task, const std::vector<Stand>& stands);

}  // namespace popup
