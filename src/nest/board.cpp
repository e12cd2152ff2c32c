#include "nest/board.h"

#include <algorithm>
#include <cmath>

namespace popup {
namespace {

// Of the ends of chords on a line so many are looked at: those that the least weight covers.
constexpr std::size_t kMostEnds = 96;
// What it costs to put a chord in order, in looks.
constexpr double kSorting = 6.0;
// What it costs to make a no-fit part and look at it, in looks.
constexpr double kMaking = 8.0;
// What it costs to set a weight anew, in looks.
constexpr double kFilling = 1.0 / 32.0;
// Of more items the weights of all pairs would not be worth their memory.
constexpr std::size_t kMostWeighed = 2048;
// How many no-fit polygons are kept when the table does not keep them.
constexpr std::size_t kCached = 2039;

}  // namespace

Board::Board(const ShapeSet& set, NoFitTable& table, const std::vector<int>& kinds, std::vector<Room> rooms)
    : set_(set),
      table_(&table),
      kinds_(kinds),
      rooms_(std::move(rooms)),
      stands_(kinds.size()),
      slots_(kinds.size(), -1),
      on_sheet_(rooms_.size()),
      weights_(kinds.size() <= kMostWeighed ? kinds.size() * kinds.size() : kinds.size(), 1.0F) {
    for (const TurnedShape& shape : set.shapes) {
        reaches_.push_back({static_cast<double>(shape.reach.x0), static_cast<double>(shape.reach.y0),
                            static_cast<double>(shape.reach.x1), static_cast<double>(shape.reach.y1)});
    }
}

void Board::put(int item, const Stand& stand) {
    take(item);
    stands_[index(item)] = stand;
    std::vector<int>& list = on_sheet_[index(stand.sheet)];
    slots_[index(item)] = static_cast<int>(list.size());
    list.push_back(item);
}

void Board::take(int item) {
    int& slot = slots_[index(item)];
    if (slot < 0) return;
    std::vector<int>& list = on_sheet_[index(stands_[index(item)].sheet)];
    list[index(slot)] = list.back();
    slots_[index(list.back())] = slot;
    list.pop_back();
    slot = -1;
}

Board::Range Board::range(int shape, int sheet) const {
    const GridBox& box = set_.shapes[index(shape)].bounds;
    const Room& room = rooms_[index(sheet)];
    return {-static_cast<double>(box.x0), -static_cast<double>(box.y0),
            room.width - static_cast<double>(box.x1), room.height - static_cast<double>(box.y1)};
}

void Board::resize(int sheet, const Room& room) {
    rooms_[index(sheet)] = room;
    for (const int item : on_sheet_[index(sheet)]) {
        Stand& stand = stands_[index(item)];
        const Range inside = range(stand.shape, sheet);
        stand.x = std::max(inside.x0, std::min(stand.x, inside.x1));
        stand.y = std::max(inside.y0, std::min(stand.y, inside.y1));
    }
}

void Board::clear(std::vector<Room> rooms) {
    rooms_ = std::move(rooms);
    on_sheet_.resize(rooms_.size());
    for (std::vector<int>& list : on_sheet_) list.clear();
    std::fill(slots_.begin(), slots_.end(), -1);
}

void Board::drop_last_room() {
    rooms_.pop_back();
    on_sheet_.pop_back();
}

void Board::add_room(const Room& room) {
    rooms_.push_back(room);
    on_sheet_.emplace_back();
}

void Board::set_weight(int a, int b, float weight) {
    if (!weighs()) return;
    weights_[index(a) * stands_.size() + index(b)] = weight;
    weights_[index(b) * stands_.size() + index(a)] = weight;
}

void Board::reset_weights() {
    std::fill(weights_.begin(), weights_.end(), 1.0F);
    work += kFilling * static_cast<double>(weights_.size());
}

namespace {

// Depth of (x, y) in all parts of a no-fit polygon.
double total_depth(const NoFit& fit, double x, double y) {
    double sum = 0.0;
    for (const NoFitPart& part : fit.parts) {
        if (x <= part.x0 || x >= part.x1 || y <= part.y0 || y >= part.y1) continue;
        double depth = HUGE_VAL;
        const HalfPlane* plane = fit.planes.data() + part.first;
        for (const HalfPlane* end = plane + part.count; plane != end; ++plane) {
            depth = std::min(depth, plane->c - plane->nx * x - plane->ny * y);
            if (depth <= kTouch) break;
        }
        if (depth > kTouch) sum += depth;
    }
    return sum;
}

}  // namespace

const NoFit& Board::no_fit(int a, int b) {
    if (table_->keeps()) {
        const NoFit& fit = table_->of(a, b);
        work += static_cast<double>(fit.parts.size());
        return fit;
    }
    // The same pairs are looked at again and again before the next item has its turn.
    if (cache_.empty()) cache_.resize(kCached);
    Cached& entry = cache_[(index(a) * 2654435761U + index(b) * 40503U) % kCached];
    const bool known = entry.table == table_ && entry.a == a && entry.b == b;
    if (!known) {
        table_->make(a, b, entry.fit);
        entry.table = table_;
        entry.a = a;
        entry.b = b;
    }
    work += static_cast<double>(entry.fit.parts.size()) * (known ? 1.0 : kMaking);
    return entry.fit;
}

double Board::cost(int item, const Stand& stand, double bound) {
    double sum = 0.0;
    const Reach& reach = reaches_[index(stand.shape)];
    const double x0 = stand.x + reach.x0;
    const double x1 = stand.x + reach.x1;
    const double y0 = stand.y + reach.y0;
    const double y1 = stand.y + reach.y1;
    const float* weights = weights_of(item);
    for (const int other : on_sheet_[index(stand.sheet)]) {
        if (other == item) continue;
        const Stand& there = stands_[index(other)];
        const Reach& box = reaches_[index(there.shape)];
        if (x0 >= there.x + box.x1 || x1 <= there.x + box.x0 || y0 >= there.y + box.y1 ||
            y1 <= there.y + box.y0) {
            continue;
        }
        const NoFit& fit = no_fit(stand.shape, there.shape);
        sum += static_cast<double>(weights[other]) * total_depth(fit, stand.x - there.x, stand.y - there.y);
        if (sum > bound) return sum;
    }
    return sum;
}

double Board::overlap(int a, int b) {
    const Stand& one = stands_[index(a)];
    const Stand& other = stands_[index(b)];
    if (one.sheet != other.sheet) return 0.0;
    const NoFit& fit = no_fit(one.shape, other.shape);
    const double x = one.x - other.x;
    const double y = one.y - other.y;
    if (x <= fit.x0 || x >= fit.x1 || y <= fit.y0 || y >= fit.y1) return 0.0;
    return total_depth(fit, x, y);
}

double Board::depth_on(const Chord& chord, double t) const {
    double depth = HUGE_VAL;
    const Slope* slope = slopes_.data() + chord.first;
    for (const Slope* end = slope + chord.count; slope != end; ++slope) {
        depth = std::min(depth, slope->level - slope->rate * t);
    }
    return depth;
}

// The ends of chords within the range, and those of the range: of many the ones that are covered least.
void Board::find_ends(double low, double high) {
    if (2 * chords_.size() + 2 <= kMostEnds) {
        ends_.clear();
        ends_.push_back({low, 0.0});
        ends_.push_back({high, 0.0});
        for (const Chord& chord : chords_) {
            if (chord.from > low) ends_.push_back({std::round(chord.from), 0.0});
            if (chord.to < high) ends_.push_back({std::round(chord.to), 0.0});
        }
        return;
    }
    events_.clear();
    for (const Chord& chord : chords_) {
        events_.push_back({chord.from, chord.weight});
        events_.push_back({chord.to, -chord.weight});
    }
    // What ends at a point no longer covers it, and what begins there does not yet.
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
        return a.at != b.at ? a.at < b.at : a.change < b.change;
    });
    ends_.clear();
    double covered = 0.0;
    bool low_done = false;
    for (std::size_t i = 0; i < events_.size(); ++i) {
        const Event& event = events_[i];
        if (!low_done && event.at > low) {
            ends_.push_back({low, covered});
            low_done = true;
        }
        if (event.at >= high) break;
        if (event.change < 0.0) covered += event.change;
        if (event.at > low) ends_.push_back({std::round(event.at), covered});
        if (event.change > 0.0) covered += event.change;
    }
    if (!low_done) ends_.push_back({low, covered});
    ends_.push_back({high, covered});
    if (ends_.size() > kMostEnds) {
        std::nth_element(ends_.begin(), ends_.begin() + kMostEnds, ends_.end(),
                         [](const End& a, const End& b) {
                             return a.covered != b.covered ? a.covered < b.covered : a.at < b.at;
                         });
        ends_.resize(kMostEnds);
    }
}

// The chords of the line's stretch from `low` to `high` in the no-fit parts of all others on the sheet.
// Slopes say how deep they are: who looks for a gap does not ask.
template <bool level, bool with_slopes>
void Board::gather_chords(int item, const Stand& stand, double low, double high) {
    const Reach& reach = reaches_[index(stand.shape)];
    const double fixed = level ? stand.y : stand.x;
    // What the item sweeps, across the line and along it.
    const double across0 = fixed + (level ? reach.y0 : reach.x0);
    const double across1 = fixed + (level ? reach.y1 : reach.x1);
    const double along0 = low + (level ? reach.x0 : reach.y0);
    const double along1 = high + (level ? reach.x1 : reach.y1);
    const float* weights = weights_of(item);
    chords_.clear();
    slopes_.clear();
    for (const int other : on_sheet_[index(stand.sheet)]) {
        if (other == item) continue;
        const Stand& there = stands_[index(other)];
        const Reach& box = reaches_[index(there.shape)];
        const double there_across = level ? there.y : there.x;
        const double there_along = level ? there.x : there.y;
        if (across0 >= there_across + (level ? box.y1 : box.x1) ||
            across1 <= there_across + (level ? box.y0 : box.x0) ||
            along0 >= there_along + (level ? box.x1 : box.y1) ||
            along1 <= there_along + (level ? box.x0 : box.y0)) {
            continue;
        }
        const NoFit& fit = no_fit(stand.shape, there.shape);
        const double rest = fixed - there_across;
        for (const NoFitPart& part : fit.parts) {
            if (rest <= (level ? part.y0 : part.x0) || rest >= (level ? part.y1 : part.x1)) continue;
            double from = -HUGE_VAL;
            double to = HUGE_VAL;
            const auto first = static_cast<std::uint32_t>(slopes_.size());
            const HalfPlane* plane = fit.planes.data() + part.first;
            for (const HalfPlane* end = plane + part.count; plane != end && from < to; ++plane) {
                const double rate = level ? plane->nx : plane->ny;
                const double value = plane->c - (level ? plane->ny : plane->nx) * rest + rate * there_along;
                if (rate > 0.0) {
                    to = std::min(to, value / rate);
                } else if (rate < 0.0) {
                    from = std::max(from, value / rate);
                } else if (value <= kTouch) {
                    to = from;
                }
                if constexpr (with_slopes) slopes_.push_back({value, rate});
            }
            if (from >= to || to <= low || from >= high) {
                if constexpr (with_slopes) slopes_.resize(first);
                continue;
            }
            chords_.push_back({from, to, static_cast<double>(weights[other]), first,
                               static_cast<std::uint32_t>(slopes_.size()) - first});
        }
    }
    work += kSorting * static_cast<double>(chords_.size());
    std::sort(chords_.begin(), chords_.end(), [](const Chord& a, const Chord& b) { return a.from < b.from; });
}

// The place that no chord covers: the first, or that nearest to `own`.
std::optional<double> Board::find_gap(double low, double high, double own, Among among) const {
    std::optional<double> best;
    // Rounded to the grid, an end may be inside by half a step, which is touching.
    const auto offer = [&](double from, double to) {
        const double start = std::max(low, std::round(from));
        if (start > high) return;
        const double end = std::min(high, std::max(start, std::round(to)));
        const double at = among == Among::first ? start : std::max(start, std::min(end, own));
        if (!best || std::abs(at - own) < std::abs(*best - own)) best = at;
    };
    double covered = low;
    for (const Chord& chord : chords_) {
        if (chord.from >= covered - 0.5) {
            offer(covered, chord.from);
            if (best && among == Among::first) return best;
        }
        covered = std::max(covered, chord.to);
    }
    if (covered <= high + 0.5) offer(covered, high);
    return best;
}

double Board::best_on_line(int item, Stand& stand, Along along, double low, double high, Among among) {
    const bool level = along == Along::x;
    if (among == Among::first) {
        level ? gather_chords<true, false>(item, stand, low, high)
              : gather_chords<false, false>(item, stand, low, high);
    } else {
        level ? gather_chords<true, true>(item, stand, low, high)
              : gather_chords<false, true>(item, stand, low, high);
    }
    double& moving = level ? stand.x : stand.y;
    const double own = moving;
    if (const auto gap = find_gap(low, high, own, among)) {
        moving = *gap;
        return 0.0;
    }
    if (among == Among::first) return HUGE_VAL;
    find_ends(low, high);
    double best = HUGE_VAL;
    double looked = 0.0;
    for (const End& end : ends_) {
        double sum = 0.0;
        for (const Chord& chord : chords_) {
            if (chord.from >= end.at || sum > best) break;
            looked += 1.0;
            if (chord.to <= end.at) continue;
            const double depth = depth_on(chord, end.at);
            if (depth > kTouch) sum += chord.weight * depth;
        }
        if (sum > best || (sum == best && std::abs(end.at - own) >= std::abs(moving - own))) continue;
        best = sum;
        moving = end.at;
    }
    work += looked;
    return best;
}

}  // namespace popup
