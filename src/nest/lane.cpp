#include "nest/lane.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nest/bounds.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

// Steps by which the last sheet gets shorter, as shares of its length: while exploring, and the first and the
// least of the compression at the end.
constexpr double kExploreStep = 0.001;
constexpr double kCompressStep = 0.0005;
constexpr double kLeastStep = 0.00001;
// Many layouts tried a little find more than few tried hard.
constexpr Persistence kLong{300, 3};
constexpr Persistence kMiddling{100, 1};
constexpr Persistence kShort{60, 2};
constexpr std::size_t kPool = 10;
constexpr int kTries = 8;             // to set out with a shorter sheet, while exploring
constexpr double kLargeShare = 0.75;  // of the items, those that are worth exchanging

}  // namespace

Lane::Lane(NestTask& task, std::uint64_t seed, Pace pace)
    : task_(task), pace_(pace), board_(task.set, task.first_table(), task.kinds, {}), dice_(seed) {
    for (int item = 0; item < static_cast<int>(task.kinds.size()); ++item) {
        if (!task.is_locked(item)) by_size_.push_back(item);
    }
    std::stable_sort(by_size_.begin(), by_size_.end(), [&](int a, int b) {
        return task.set.areas[index(task.kinds[index(a)])] > task.set.areas[index(task.kinds[index(b)])];
    });
}

void Lane::begin(const Arrangement& from, Aim aim) {
    const bool goes_on = aim == aim_ && from.rows == best_.rows;
    if (!goes_on || aim == Aim::fit) pool_.clear();
    aim_ = aim;
    best_ = from;
    done_ = false;
    if (!goes_on) {
        step_ = aim == Aim::compress ? kCompressStep : pace_.first_step;
        exploring_ = false;
    }
    if (separator_ && !(goes_on && useful())) separator_.reset();
    least_ = least();
}

void Lane::know(std::vector<int> rows, std::vector<char> on_last) {
    known_rows_ = std::move(rows);
    on_last_ = std::move(on_last);
}

void Lane::forget() {
    separator_.reset();
    best_ = {};
    pool_.clear();
}

double Lane::least() const {
    return least_length(task_, best_.rows, known_rows_ == best_.rows ? on_last_ : std::vector<char>{});
}

double Lane::length_of(const Arrangement& arrangement) const {
    return arrangement.length(task_, static_cast<int>(arrangement.rows.size()) - 1);
}

// Whether the attempt that goes on may come to something better than the best.
bool Lane::useful() const {
    switch (aim_) {
        case Aim::fit:
            return true;
        case Aim::fewer:
            return rows_.size() + 1 == best_.rows.size();
        case Aim::shorter:
            return rows_ == best_.rows;
        case Aim::compress:
            return rows_ == best_.rows && target_ < length_of(best_);
    }
    broken_invariant("an aim is one of its enumerators", __FILE__, __LINE__);
}

void Lane::run(double work) {
    const double limit = board_.work + work;
    while (!done_ && board_.work < limit) {
        if (!separator_) attempt();
        if (done_) return;
        // Even an attempt that has nothing to do costs what it takes to set out.
        board_.work += static_cast<double>(board_.items());
        if (!separator_) continue;
        const Separator::State state = separator_->run(limit);
        if (state == Separator::State::paused) return;
        finish(state);
    }
}

// Puts the items where `stands` says, inside their rooms, and sets out to take them apart.
void Lane::set_out(const std::vector<Stand>& stands) {
    board_.set_table(task_.first_table());
    loose_ = !task_.tight;
    std::vector<Room> rooms;
    for (const int row : rows_) rooms.push_back(task_.rooms[index(row)]);
    board_.clear(std::move(rooms));
    for (int i = 0; i < board_.items(); ++i) board_.put(i, stands[index(i)]);
}

void Lane::attempt() {
    if (!shortens()) {
        attempt_to_fit();
        return;
    }
    rows_ = best_.rows;
    if (length_of(best_) <= least_ * (1.0 + pace_.content) + 1.0) {
        done_ = true;
    } else if (exploring_ && !pool_.empty()) {
        attempt_again();
    } else {
        attempt_to_shorten();
    }
}

void Lane::set_off(Persistence persistence) {
    if (shortens()) persistence.patience = static_cast<int>(persistence.patience * pace_.patience);
    freedom_ = freedom_of(task_, board_.stands());
    separator_ = std::make_unique<Separator>(board_, freedom_, dice_, persistence);
}

// On the sheets there are, or on one less: at first as it comes, then from what was tried in vain.
void Lane::attempt_to_fit() {
    if (aim_ == Aim::fit) rows_ = best_.rows;
    if (!pool_.empty()) {
        const int one = aim_ == Aim::fit ? 0 : dice_.below(static_cast<int>(pool_.size()));
        set_out(pool_[index(one)].stands);
        disturb();
    } else if (aim_ == Aim::fit) {
        set_out(best_.stands);
    } else if (!dissolve()) {
        done_ = true;
        return;
    }
    target_ = board_.rooms().back().width;
    set_off(kLong);
}

// Sets out with the last sheet as long as the target. What does not fit there may do so in another turn, or
// in another's place: while exploring that is tried. False if it fits nowhere.
bool Lane::set_out_shorter() {
    for (int i = 0; i < (exploring_ ? kTries : 1); ++i) {
        set_out(best_.stands);
        if (i > 0) disturb();
        if (shorten(target_)) return true;
    }
    return false;
}

void Lane::attempt_to_shorten() {
    const double step = exploring_ ? kExploreStep : step_;
    target_ = std::max(std::ceil(least_), std::floor(length_of(best_) * (1.0 - step)));
    if (set_out_shorter()) {
        set_off(aim_ == Aim::compress ? kLong : exploring_ ? kShort : kMiddling);
    } else if (aim_ == Aim::shorter && !exploring_) {
        exploring_ = true;
    } else {
        done_ = true;
    }
}

// At the length that was tried in vain, from one of the layouts that overlapped least, with two pieces in
// each other's place.
void Lane::attempt_again() {
    const double share = dice_.unit();
    const auto one = static_cast<std::size_t>(share * share * static_cast<double>(pool_.size()));
    set_out(pool_[one].stands);
    Room room = board_.rooms().back();
    room.width = target_;
    board_.resize(last(), room);
    disturb();
    set_off(kShort);
}

// Makes the last sheet shorter; what lies right of a random upright line moves left with its edge. False when
// something cannot lie in it any more, nor elsewhere.
bool Lane::shorten(double length) {
    Room room = board_.rooms().back();
    double used = 0.0;
    for (const int item : board_.on_sheet(last())) {
        const Stand& stand = board_.at(item);
        used = std::max(used, stand.x + static_cast<double>(board_.shape(stand.shape).bounds.x1));
    }
    const double by = used - length;
    if (by > 0.0) {
        const double split = dice_.between(0.0, used);
        const std::vector<int> items = board_.on_sheet(last());
        for (const int item : items) {
            Stand stand = board_.at(item);
            const GridBox& box = board_.shape(stand.shape).bounds;
            if (task_.is_locked(item)) continue;
            if (stand.x + 0.5 * static_cast<double>(box.x0 + box.x1) > split) {
                stand.x -= by;
                board_.put(item, stand);
            }
        }
    }
    room.width = length;
    board_.resize(last(), room);
    // What does not fit any more as it lies is turned, or goes to another sheet.
    const std::vector<int> items = board_.on_sheet(last());
    for (const int item : items) {
        const Stand& stand = board_.at(item);
        if (stand.sheet != last() || !board_.range(stand.shape, last()).empty()) continue;
        bool moved = move_lot(item, last());
        for (int sheet = 0; !moved && sheet < last(); ++sheet) moved = move_lot(item, sheet);
        if (!moved) return false;
    }
    return true;
}

void Lane::finish(Separator::State state) {
    if (state == Separator::State::stuck) {
        fail();
        return;
    }
    // What is apart in the loose table is so in truth; it is proved when the lanes are compared.
    if (loose_ || Arrangement{board_.stands(), rows_}.holds(task_)) {
        succeed();
    } else {
        // Touching pieces may overlap by less than a step: then they are taken apart with room for rounding.
        board_.set_table(task_.loose);
        loose_ = true;
        set_off(kLong);
    }
}

void Lane::succeed() {
    separator_.reset();
    Arrangement found{board_.stands(), rows_};
    pool_.clear();
    if (shortens() && !found.better_than(best_, task_)) return;
    best_ = std::move(found);
    // What lay on the last sheet may all have gone to others.
    while (best_.rows.size() > 1 && board_.on_sheet(static_cast<int>(best_.rows.size()) - 1).empty()) {
        best_.rows.pop_back();
    }
    least_ = least();
    if (!shortens()) done_ = true;
}

void Lane::fail() {
    const double loss = separator_->loss();
    std::vector<Stand> stands = separator_->stands();
    separator_.reset();
    if (aim_ == Aim::compress) {
        step_ = std::max(kLeastStep, 0.5 * step_);
        return;
    }
    if (aim_ == Aim::shorter && !exploring_) {
        exploring_ = true;
        return;
    }
    const auto at =
        std::upper_bound(pool_.begin(), pool_.end(), loss,
                         [](double value, const Failure& failure) { return value < failure.loss; });
    pool_.insert(at, {loss, std::move(stands)});
    if (pool_.size() > kPool) pool_.pop_back();
}

// A random place on the sheet for each of the items, in a turn that fits there.
void Lane::throw_in(const std::vector<int>& items, int sheet) {
    for (const int item : items) {
        const Stand old = board_.at(item);
        const bool keep = task_.job.kinds[index(task_.kinds[index(item)])].one_turn;
        const std::vector<int>& shapes = board_.shapes_of(item);
        const int first = dice_.below(static_cast<int>(shapes.size()));
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const int shape = keep ? old.shape : shapes[(index(first) + i) % shapes.size()];
            const Board::Range range = board_.range(shape, sheet);
            if (range.empty()) continue;
            board_.put(item, {sheet, shape, std::round(dice_.between(range.x0, range.x1)),
                              std::round(dice_.between(range.y0, range.y1))});
            break;
        }
    }
}

// Moves an item, with its group, to another sheet if it fits there.
bool Lane::move_lot(int item, int sheet) {
    const int group = task_.group_of[index(item)];
    const std::vector<int> items = group < 0 ? std::vector<int>{item} : task_.groups[index(group)];
    for (const int one : items) {
        if (task_.is_locked(one)) return false;
        const bool keep = task_.job.kinds[index(task_.kinds[index(one)])].one_turn;
        const std::vector<int>& shapes = board_.shapes_of(one);
        const bool fits = std::any_of(shapes.begin(), shapes.end(), [&](int shape) {
            return (!keep || shape == board_.at(one).shape) && !board_.range(shape, sheet).empty();
        });
        if (!fits) return false;
    }
    throw_in(items, sheet);
    return true;
}

// Spreads the pieces of the emptiest sheet that can be done without over the others.
bool Lane::dissolve() {
    const auto sheets = static_cast<int>(best_.rows.size());
    for (const int victim : emptiest_sheets(task_, best_)) {
        rows_ = best_.rows;
        set_out(best_.stands);
        bool moved = true;
        const std::vector<int> items = board_.on_sheet(victim);
        for (const int item : items) {
            if (board_.at(item).sheet != victim) continue;  // went with its group
            const int first = dice_.below(sheets);
            bool done = false;
            for (int k = 0; k < sheets && !done; ++k) {
                const int sheet = (first + k) % sheets;
                done = sheet != victim && move_lot(item, sheet);
            }
            moved = moved && done;
        }
        if (!moved) continue;
        std::vector<Stand> stands = board_.stands();
        for (Stand& stand : stands) {
            if (stand.sheet > victim) --stand.sheet;
        }
        rows_.erase(rows_.begin() + victim);
        set_out(stands);
        return true;
    }
    return false;
}

// Two items change places, each centred where the other was.
void Lane::exchange(int a, int b) {
    Stand one = board_.at(a);
    Stand other = board_.at(b);
    const auto middle = [&](const Stand& stand) {
        const GridBox& box = board_.shape(stand.shape).bounds;
        return Vec2{stand.x + 0.5 * static_cast<double>(box.x0 + box.x1),
                    stand.y + 0.5 * static_cast<double>(box.y0 + box.y1)};
    };
    const Vec2 way = middle(other) - middle(one);
    std::swap(one.sheet, other.sheet);
    one.x += std::round(way.x);
    one.y += std::round(way.y);
    other.x -= std::round(way.x);
    other.y -= std::round(way.y);
    const auto inside = [&](Stand& stand) {
        const Board::Range range = board_.range(stand.shape, stand.sheet);
        stand.x = std::max(range.x0, std::min(stand.x, range.x1));
        stand.y = std::max(range.y0, std::min(stand.y, range.y1));
        return !range.empty();
    };
    if (!inside(one) || !inside(other)) return;
    board_.put(a, one);
    board_.put(b, other);
}

void Lane::disturb() {
    if (by_size_.size() < 2) return;
    const int large =
        std::max(2, static_cast<int>(std::ceil(kLargeShare * static_cast<double>(by_size_.size()))));
    const int a = by_size_[index(dice_.below(large))];
    // Two of a kind would be as before.
    int b = a;
    for (int i = 0; i < 8 && task_.kinds[index(a)] == task_.kinds[index(b)]; ++i)
        b = by_size_[index(dice_.below(large))];
    if (a == b) return;
    const int sheet_a = board_.at(a).sheet;
    const int sheet_b = board_.at(b).sheet;
    const bool grouped = task_.group_of[index(a)] >= 0 || task_.group_of[index(b)] >= 0;
    if (sheet_a == sheet_b || !grouped) {
        exchange(a, b);
    } else if (move_lot(a, sheet_b)) {
        move_lot(b, sheet_a);
    }
    // Kinds of one turn turn together.
    const int kind = task_.kinds[index(a)];
    if (!task_.job.kinds[index(kind)].one_turn || dice_.below(2) == 0) return;
    const std::vector<int>& shapes = task_.set.of_kind[index(kind)];
    const int shape = shapes[index(dice_.below(static_cast<int>(shapes.size())))];
    std::vector<std::pair<int, Stand>> turned;
    for (int item = 0; item < board_.items(); ++item) {
        if (task_.kinds[index(item)] != kind) continue;
        Stand stand = board_.at(item);
        stand.shape = shape;
        const Board::Range range = board_.range(shape, stand.sheet);
        if (range.empty() || task_.is_locked(item)) return;
        stand.x = std::max(range.x0, std::min(stand.x, range.x1));
        stand.y = std::max(range.y0, std::min(stand.y, range.y1));
        turned.emplace_back(item, stand);
    }
    for (const auto& [item, stand] : turned) board_.put(item, stand);
}

}  // namespace popup
