// Nesting: irregular pieces on as few sheets as can be found. It knows outlines and sheets, nothing of cards.
//
// A place maps an outline's point p to turned(p, angle) + offset, in mm from the lower left corner of the
// sheet's usable area, x right, y up. Lengths are worked out on a grid of 1e-6 mm (kGridMm): outlines, once
// turned, are rounded to it, and offsets stand on it.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "popup/geometry.h"
#include "popup/units.h"

namespace popup {

// A kind of piece: all items of a kind are alike.
struct NestKind {
    std::vector<Polygon> outline;  // polygons that do not overlap; has an area; within ±1e5 mm
    std::vector<Angle> turns{{}};  // those allowed, at least one, no doubles
    bool one_turn = false;         // all items of the kind get the same turn: grain
};

struct NestSpot {
    int sheet = 0;
    Vec2 offset;
    Angle angle;
    friend bool operator==(const NestSpot&, const NestSpot&) = default;
};

// A piece to place.
struct NestItem {
    int kind = 0;
    int group = -1;                  // items of one group ≥ 0 share a sheet
    std::optional<NestSpot> locked;  // its place, which the search leaves alone
};

// Sheets of one size, as their usable part: margins are taken off.
struct NestStock {
    double width = 0.0;   // mm, > 0; the direction in which the last sheet is kept short
    double height = 0.0;  // mm, > 0
    int count = -1;       // how many there are; -1: as many as wanted
};

struct NestJob {
    std::vector<NestKind> kinds;
    std::vector<NestItem> items;
    std::vector<NestStock> stock;
    double spacing = 0.0;   // mm between pieces, inside holes too; 0 lets them touch
    bool use_holes = true;  // whether pieces may lie in the holes of others
};

// What is known while a search goes on.
struct NestProgress {
    int sheets = 0;            // of the best layout so far
    double last_length = 0.0;  // mm used of its last sheet
    double utilisation = 0.0;  // area of all pieces / area of its sheets, the last one only as far as used
    double done = 0.0;         // share of the effort that is spent, 0 to 1
};

// How long to look. Work is counted, not timed: a unit is one look at two convex parts of pieces, some 10 ns.
// So the same job, effort and seed give the same layout on every machine and with any number of threads.
inline constexpr double kFastNesting = 3e6;
inline constexpr double kNormalNesting = 3e7;
inline constexpr double kBestNesting = 3e8;
// The default of a run for NestEffort::shortening: some 12 ms.
inline constexpr double kQuickShortening = 1.2e6;
struct NestEffort {
    double work = kFastNesting;  // units an item, ≥ 0; beyond 64 each adds an 8th, beyond 1024 a 128th
    // Units in all, beyond which no shorter last sheet is looked for. Fewer sheets are looked for as ever.
    double shortening = HUGE_VAL;
    std::uint64_t seed = 0;
    int threads = 1;  // ≥ 1; the search uses two at most
    // Asked, once for each thread beside the caller's that the search can use, whether it may be started; it
    // answers at once. May be empty: yes. Each yes is answered with one call of `thread_ended` when the
    // search is over.
    std::function<bool()> may_start_thread = {};
    std::function<void()> thread_ended = {};
    // Looks for this long instead, whatever `shortening` says: the layout then depends on the clock.
    std::optional<double> seconds = {};
    // Ends the search as soon as it is set: the best layout so far is the result. May be null.
    const std::atomic<bool>* stop = nullptr;
    // Called now and then, from the calling thread; may be empty.
    std::function<void(const NestProgress&)> progress = {};
};
struct NestPlan {
    std::vector<NestSpot> spots;  // of each item
    std::vector<int> sheets;      // of each sheet, the row of the stock it is from
    std::vector<Vec2> used;       // of each sheet, mm: how far its pieces reach from its corner
};

// What stands in the way of a plan.
struct NestRefusal {
    enum class Reason {
        too_large,        // these items fit on no sheet of the stock in any allowed turn
        lock_outside,     // these locked items do not lie on their sheet
        lock_overlap,     // these two locked items are closer to each other than the spacing
        lock_apart,       // these two are locked on two sheets, or in two turns, and must share one
        stock_used_up,    // these items found no place on the sheets there are
        group_too_large,  // the items of this group found no place on one sheet together
    };
    Reason reason = Reason::too_large;
    std::vector<int> items;
};

// Places all items, on as few sheets as it can find, then in as short a part of the last sheet as it can.
// Every item lies on its sheet, in an allowed turn, and no two are closer than the spacing: proved with exact
// integer arithmetic on the grid before the plan is given. One of the two results is set.
struct NestResult {
    std::optional<NestPlan> plan;
    std::optional<NestRefusal> refusal;
};
NestResult nest(const NestJob& job, const NestEffort& effort);

}  // namespace popup
