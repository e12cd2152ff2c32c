// The board: shapes on sheets, overlapping while the search goes on, and what their overlaps weigh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nest/no_fit.h"

namespace popup {

// Where an item stands, in whole steps of the grid, held as doubles (exact up to 9e15).
struct Stand {
    int sheet = 0;
    int shape = 0;
    double x = 0.0, y = 0.0;
};

// Depths up to this many steps are touching: what rounding a place to the grid can do. The slack of no-fit
// polygons is larger by more than a step, so that what touches here does not overlap in truth.
inline constexpr double kTouch = 0.9;
inline constexpr double kSlack = 3.0;

struct Room {
    double width = 0.0, height = 0.0;  // steps
};

// One state of a search. Overlap of two items: the sum of the depths of their no-fit parts at their places.
class Board {
 public:
    // Preconditions: set and table outlive the board; kinds[i] is the kind of item i.
    Board(const ShapeSet& set, NoFitTable& table, const std::vector<int>& kinds, std::vector<Room> rooms);

    [[nodiscard]] int items() const { return static_cast<int>(stands_.size()); }
    [[nodiscard]] const std::vector<Room>& rooms() const { return rooms_; }
    [[nodiscard]] const Stand& at(int item) const { return stands_[index(item)]; }
    [[nodiscard]] bool placed(int item) const { return slots_[index(item)] >= 0; }
    [[nodiscard]] const std::vector<Stand>& stands() const { return stands_; }
    [[nodiscard]] const TurnedShape& shape(int number) const { return set_.shapes[index(number)]; }
    [[nodiscard]] const std::vector<int>& shapes_of(int item) const {
        return set_.of_kind[index(kinds_[index(item)])];
    }
    [[nodiscard]] const std::vector<int>& kinds() const { return kinds_; }

    void put(int item, const Stand& stand);
    void take(int item);
    void set_table(NoFitTable& table) { table_ = &table; }
    // Items that no longer lie in the room are moved into it as little as can be.
    void resize(int sheet, const Room& room);
    // Takes all items off, and begins with these rooms.
    void clear(std::vector<Room> rooms);
    void add_room(const Room& room);
    // Precondition: nothing stands in it.
    void drop_last_room();

    // The range of places of a shape on a sheet: x0 ≤ x ≤ x1; empty when it does not fit.
    struct Range {
        double x0, y0, x1, y1;
        [[nodiscard]] bool empty() const { return x1 < x0 || y1 < y0; }
    };
    [[nodiscard]] Range range(int shape, int sheet) const;

    // Weighted overlap of the item if it stood there; any value above `bound` once it is known to be above.
    double cost(int item, const Stand& stand, double bound);
    // Overlap of two items as they stand, not weighted.
    double overlap(int a, int b);

    // The best place on the level (or upright) line through `stand`, between `low` and `high`: the one of
    // least weighted overlap, and among those without any, the nearest to the stand, or the first. Who wants
    // the first wants none with overlap: then HUGE_VAL, and the stand as it was.
    // Moves the stand there and returns the cost; where none is less than `bound`, gives that and leaves the
    // stand as it was. A place without overlap is always found. Along a line the sum is concave between the
    // ends of the chords, so that its least value is at such an end. Of those the two ends of the line are
    // looked at, those where the item begins or ceases to overlap another, and, where there are few, those
    // between which it overlaps less of one.
    enum class Along { x, y };
    enum class Among { nearest, first };
    double best_on_line(int item, Stand& stand, Along along, double low, double high, Among among,
                        double bound = HUGE_VAL);

    // Weights of pairs, from 1. Of more than some thousand items all pairs weigh the same.
    [[nodiscard]] float weight(int a, int b) const { return weights_of(a)[b]; }
    void set_weight(int a, int b, float weight);
    void reset_weights();

    [[nodiscard]] const std::vector<int>& on_sheet(int sheet) const { return on_sheet_[index(sheet)]; }

    double work = 0.0;  // looks at parts of pairs so far

 private:
    [[nodiscard]] bool weighs() const { return weights_.size() > stands_.size(); }
    [[nodiscard]] const float* weights_of(int item) const {
        return weights_.data() + (weighs() ? index(item) * stands_.size() : 0);
    }

    // A stretch of a line inside one no-fit part.
    struct Chord {
        double from, to;
        std::uint32_t part;
    };
    // A stretch of a line on which the item overlaps one other all the way: chords that overlap.
    struct Span {
        double from, to;
        int other;
        std::uint32_t first, count;  // into chords_, by where they begin
    };
    // The no-fit polygon of two shapes. Where the table does not keep them, of most of its parts only the
    // boxes are made, and it is good until the next is asked for.
    const NoFit& no_fit(int a, int b);
    const NoFit& no_fit_looked_at(int a, int b, double looks);
    // Makes the rest of a part, if need be, of the no-fit polygon that was asked for last.
    void make_ready(const NoFitPart& part) {
        if (!part.is_made()) make_part(part);
    }
    void make_part(const NoFitPart& part);
    double total_depth(const NoFit& fit, double x, double y);
    struct Cached {
        const NoFitTable* table = nullptr;
        int a = -1, b = -1;
        NoFit fit;
    };
    // The box of a shape's parts, as doubles.
    struct Reach {
        double x0, y0, x1, y1;
    };
    template <bool level>
    void gather_spans(int item, const Stand& stand, double low, double high, bool keep_chords);
    void add_spans(int other, std::size_t first);
    [[nodiscard]] std::optional<double> find_gap(double low, double high, double own, Among among) const;
    void find_ends(double low, double high);
    double cost_on(int item, const Stand& stand, Along along, double at, double bound);

    const ShapeSet& set_;
    NoFitTable* table_;
    std::vector<int> kinds_;
    std::vector<Reach> reaches_;  // of each shape
    std::vector<Room> rooms_;
    std::vector<Stand> stands_;
    std::vector<int> slots_;  // where the item is in its sheet's list; -1: not placed
    std::vector<std::vector<int>> on_sheet_;
    std::vector<float> weights_;
    // Kept between calls so that no call allocates.
    std::vector<Chord> chords_;
    std::vector<Span> spans_;
    std::vector<double> ends_, left_;
    std::vector<Cached> cache_;
    Cached* last_ = nullptr;  // of cache_, what was asked for last
};

}  // namespace popup
