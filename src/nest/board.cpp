#include "nest/board.h"

#include <algorithm>
#include <cmath>

namespace popup {
namespace {

// Of more chords on a line only the ends of those stretches are looked at that they make up.
constexpr std::size_t kFewChords = 47;
// What it costs to put a chord in order, in looks.
constexpr double kSorting = 6.0;
// What it costs to make the box of a no-fit part, and to make the rest of it, in looks.
constexpr double kMakingBox = 1.0;
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

// Depth of (x, y) in all parts of a no-fit polygon.
double Board::total_depth(const NoFit& fit, double x, double y) {
    double sum = 0.0;
    for (const NoFitPart& part : fit.parts) {
        if (x <= part.x0 || x >= part.x1 || y <= part.y0 || y >= part.y1) continue;
        make_ready(part);
        const double depth = depth_in(fit, part, x, y);
        if (depth > kTouch) sum += depth;
    }
    return sum;
}

void Board::make_part(const NoFitPart& part) {
    NoFit& fit = last_->fit;
    table_->make_part(last_->a, last_->b, static_cast<std::size_t>(&part - fit.parts.data()), fit);
    work += kMaking;
}

const NoFit& Board::no_fit_looked_at(int a, int b, double looks) {
    if (table_->keeps()) {
        work += looks;
        return table_->of(a, b);
    }
    // The same pairs are looked at again and again before the next item has its turn.
    if (cache_.empty()) cache_.resize(kCached);
    Cached& entry = cache_[(index(a) * 2654435761U + index(b) * 40503U) % kCached];
    if (entry.table != table_ || entry.a != a || entry.b != b) {
        table_->make_boxes(a, b, entry.fit);
        entry.table = table_;
        entry.a = a;
        entry.b = b;
        looks += kMakingBox * static_cast<double>(entry.fit.parts.size());
    }
    work += looks;
    last_ = &entry;
    return entry.fit;
}

const NoFit& Board::no_fit(int a, int b) {
    const NoFit& fit = no_fit_looked_at(a, b, 0.0);
    work += static_cast<double>(fit.parts.size());
    return fit;
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

// The stretches on which the item overlaps `other`, of its chords from the first on.
void Board::add_spans(int other, std::size_t first) {
    const auto begin = chords_.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, chords_.end(), [](const Chord& a, const Chord& b) { return a.from < b.from; });
    for (std::size_t i = first; i < chords_.size(); ++i) {
        const Chord& chord = chords_[i];
        // Between two chords that meet, rounded to the grid, the item touches the other and no more.
        if (i == first || chord.from >= spans_.back().to - 0.5) {
            spans_.push_back({chord.from, chord.to, other, static_cast<std::uint32_t>(i), 1});
        } else {
            spans_.back().to = std::max(spans_.back().to, chord.to);
            ++spans_.back().count;
        }
    }
}

// Where a level (or upright) line through the box of a part runs inside the part, seen from where the other
// stands: from the last of the planes that it comes in through to the first of those that it leaves by.
// Empty: nowhere.
template <bool level>
std::pair<double, double> chord_of(const NoFit& fit, const NoFitPart& part, double across) {
    const double* at_zero = fit.planes.data() + part.first + part.count;
    const double* slope = at_zero + part.count;
    const Two at = Two::alike(across);
    if constexpr (level) {
        const auto crossing = [&](std::uint32_t i) { return Two::at(at_zero + i) - Two::at(slope + i) * at; };
        Two to = Two::alike(part.x1);
        for (std::uint32_t i = 0; i < part.half; i += 2) to = lesser(to, crossing(i));
        Two from = Two::alike(part.x0);
        for (std::uint32_t i = part.half; i < part.count; i += 2) from = greater(from, crossing(i));
        return {from.most(), to.least()};
    } else {
        const auto each = [&](std::uint32_t i, std::uint32_t end, const auto& see_two, const auto& see) {
            for (; i + 2 <= end; i += 2) see_two((Two::at(at_zero + i) - at) / Two::at(slope + i));
            if (i < end) see((at_zero[i] - across) / slope[i]);
        };
        Two tos = Two::alike(part.y1);
        double to = part.y1;
        each(
            part.third, part.last, [&](Two two) { tos = lesser(tos, two); },
            [&](double one) { to = std::min(to, one); });
        Two froms = Two::alike(part.y0);
        double from = part.y0;
        const auto come_in = [&](std::uint32_t begin, std::uint32_t end) {
            each(
                begin, end, [&](Two two) { froms = greater(froms, two); },
                [&](double one) { from = std::max(from, one); });
        };
        come_in(part.last, part.count);
        come_in(0, part.third);
        return {std::max(from, froms.most()), std::min(to, tos.least())};
    }
}

// Where on the line's stretch from `low` to `high` the item overlaps others, by where that begins.
template <bool level>
void Board::gather_spans(int item, const Stand& stand, double low, double high, bool keep_chords) {
    const Reach& reach = reaches_[index(stand.shape)];
    const double fixed = level ? stand.y : stand.x;
    // What the item sweeps, across the line and along it.
    const double across0 = fixed + (level ? reach.y0 : reach.x0);
    const double across1 = fixed + (level ? reach.y1 : reach.x1);
    const double along0 = low + (level ? reach.x0 : reach.y0);
    const double along1 = high + (level ? reach.x1 : reach.y1);
    chords_.clear();
    spans_.clear();
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
        if (!keep_chords) chords_.clear();
        const std::size_t first = chords_.size();
        const NoFit& fit = no_fit(stand.shape, there.shape);
        const double rest = fixed - there_across;
        for (const NoFitPart& part : fit.parts) {
            if (rest - (level ? part.y0 : part.x0) <= kTouch || (level ? part.y1 : part.x1) - rest <= kTouch)
                continue;
            make_ready(part);
            const auto [begin, end] = chord_of<level>(fit, part, rest);
            const double from = there_along + begin;
            const double to = there_along + end;
            if (from >= to || to <= low || from >= high) continue;
            chords_.push_back({from, to, static_cast<std::uint32_t>(&part - fit.parts.data())});
        }
        work += kSorting * static_cast<double>(chords_.size() - first);
        add_spans(other, first);
    }
    std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) {
        return a.from != b.from ? a.from < b.from : a.other < b.other;
    });
}

// The place that no span covers: the first, or that nearest to `own`.
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
    for (const Span& span : spans_) {
        if (span.from >= covered - 0.5) {
            offer(covered, span.from);
            if (best && among == Among::first) return best;
        }
        covered = std::max(covered, span.to);
    }
    if (covered <= high + 0.5) offer(covered, high);
    return best;
}

// The ends of spans within the range, and those of the range; of few chords also where the item is in fewer
// parts of one other than on either side: in a notch of it, perhaps, that it fits into.
void Board::find_ends(double low, double high) {
    ends_.clear();
    ends_.push_back(low);
    ends_.push_back(high);
    const auto add = [&](double at) {
        if (at > low && at < high) ends_.push_back(std::round(at));
    };
    for (const Span& span : spans_) {
        add(span.from);
        add(span.to);
        if (span.count == 1 || chords_.size() > kFewChords) continue;
        const auto first = chords_.begin() + static_cast<std::ptrdiff_t>(span.first);
        const auto last = first + static_cast<std::ptrdiff_t>(span.count);
        left_.clear();
        for (auto chord = first; chord != last; ++chord) left_.push_back(chord->to);
        std::sort(left_.begin(), left_.end());
        auto next = first;
        for (std::size_t i = 0; i + 1 < left_.size(); ++i) {
            // Rounded to the grid, what begins there begins no earlier.
            while (next != last && next->from < left_[i] - 0.5) ++next;
            if (next == last) break;
            if (next->from > left_[i + 1]) continue;
            add(left_[i]);
            add(next->from);
        }
    }
}

// Weighted overlap of the item where the line is at `at`; any value above `bound` once it is above.
double Board::cost_on(int item, const Stand& stand, Along along, double at, double bound) {
    const float* weights = weights_of(item);
    double sum = 0.0;
    for (const Span& span : spans_) {
        if (span.from >= at) break;
        work += 1.0;
        if (span.to <= at) continue;
        const Stand& there = stands_[index(span.other)];
        const NoFit& fit = no_fit_looked_at(stand.shape, there.shape, static_cast<double>(span.count));
        const double x = (along == Along::x ? at : stand.x) - there.x;
        const double y = (along == Along::y ? at : stand.y) - there.y;
        double depths = 0.0;
        for (std::uint32_t i = span.first; i < span.first + span.count; ++i) {
            const Chord& chord = chords_[i];
            if (chord.from >= at) break;
            if (chord.to <= at) continue;
            make_ready(fit.parts[chord.part]);
            const double depth = depth_in(fit, fit.parts[chord.part], x, y);
            if (depth > kTouch) depths += depth;
        }
        sum += static_cast<double>(weights[span.other]) * depths;
        if (sum > bound) return sum;
    }
    return sum;
}

double Board::best_on_line(int item, Stand& stand, Along along, double low, double high, Among among,
                           double bound) {
    const bool level = along == Along::x;
    const bool nearest = among == Among::nearest;
    level ? gather_spans<true>(item, stand, low, high, nearest)
          : gather_spans<false>(item, stand, low, high, nearest);
    double& moving = level ? stand.x : stand.y;
    const double own = moving;
    if (const auto gap = find_gap(low, high, own, among)) {
        moving = *gap;
        return 0.0;
    }
    if (!nearest) return HUGE_VAL;
    find_ends(low, high);
    double best = bound;
    for (const double end : ends_) {
        const double sum = cost_on(item, stand, along, end, best);
        if (sum > best || (sum == best && std::abs(end - own) >= std::abs(moving - own))) continue;
        best = sum;
        moving = end;
    }
    return best;
}

}  // namespace popup
