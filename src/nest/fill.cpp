#include "nest/fill.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace popup {
namespace {

// Random places that are looked at for a lot, to begin with the best.
constexpr int kThrows = 100;
// Passes without a gain after which an attempt ends, and one more for each refusal of the sheet. Many short
// attempts find more than few long ones.
constexpr int kPatience = 5;
// By how much less often a sheet is tried for each refusal, after how many a sheet may give a piece in
// exchange, and after how many of each, on average, there is nothing more to find.
constexpr double kFading = 0.85;
constexpr int kBeforeExchange = 3;
constexpr int kMostRefusals = 40;
// Pieces that are looked at for an exchange, and how large the one that goes may be beside the one that
// comes.
constexpr int kLooks = 4;
constexpr double kSmaller = 0.98;
// What it costs to set out, in units.
constexpr double kSettingOut = 100.0;

}  // namespace

std::vector<std::vector<int>> lots_on(const NestTask& task, const Arrangement& layout, int sheet) {
    std::vector<std::vector<int>> lots;
    std::vector<char> seen(task.groups.size(), 0);
    for (int item = 0; item < static_cast<int>(layout.stands.size()); ++item) {
        if (nth(layout.stands, item).sheet != sheet) continue;
        const int group = nth(task.group_of, item);
        if (group >= 0 && std::exchange(nth(seen, group), 1) != 0) continue;
        lots.push_back(group < 0 ? std::vector<int>{item} : nth(task.groups, group));
    }
    return lots;
}

Filler::Filler(NestTask& task, std::uint64_t seed)
    : task_(task), board_(task.set, task.first_table(), task.kinds, {}), dice_(seed) {}

double Filler::area_of(const std::vector<int>& items) const {
    double sum = 0.0;
    for (const int item : items) sum += area_of(item);
    return sum;
}

void Filler::begin(const Arrangement& from, int victim, int part, int parts) {
    separator_.reset();
    layout_ = from;
    victim_ = victim;
    moved_ = false;
    refusals_ = 0;
    choose_receivers(part, parts);
    lots_.clear();
    const std::vector<std::vector<int>> all = lots_on(task_, from, victim);
    for (int i = part; i < static_cast<int>(all.size()); i += parts) lots_.push_back(nth(all, i));
    done_ = receivers_.empty() || lots_.empty();
    // The board has one sheet, the first.
    std::vector<Stand> stands = from.stands;
    for (Stand& stand : stands) stand.sheet = 0;
    freedom_ = freedom_of(task_, stands);
}

void Filler::choose_receivers(int part, int parts) {
    receivers_.clear();
    std::vector<int> number(layout_.rows.size(), -1);
    int count = 0;
    for (int sheet = 0; sheet < static_cast<int>(layout_.rows.size()); ++sheet) {
        if (sheet == victim_ || count++ % parts != part) continue;
        const Room& room = nth(task_.rooms, nth(layout_.rows, sheet));
        nth(number, sheet) = static_cast<int>(receivers_.size());
        // Areas are sums that round: what fills a sheet to the last step fits.
        receivers_.push_back({sheet, room.width * room.height / (kGridSteps * kGridSteps) * (1.0 + 1e-9)});
    }
    for (int item = 0; item < static_cast<int>(layout_.stands.size()); ++item) {
        const int own = nth(number, nth(layout_.stands, item).sheet);
        if (own < 0) continue;
        nth(receivers_, own).items.push_back(item);
        nth(receivers_, own).free -= area_of(item);
    }
}

void Filler::run(double work) {
    const double limit = board_.work + work;
    while (!done_ && board_.work < limit) {
        if (!separator_ && !attempt()) continue;
        const Separator::State state = separator_->run(limit);
        if (state == Separator::State::paused) return;
        finish(state);
    }
}

// The number of a receiver: the more likely the more room it has, and the less often it has refused.
int Filler::any_receiver() {
    const auto chance = [](const Receiver& receiver) {
        return std::max(0.0, receiver.free) * std::pow(kFading, receiver.refusals);
    };
    double sum = 0.0;
    for (const Receiver& receiver : receivers_) sum += chance(receiver);
    double at = dice_.unit() * sum;
    for (int i = 0; i < static_cast<int>(receivers_.size()); ++i) {
        at -= chance(nth(receivers_, i));
        if (at < 0.0) return i;
    }
    return static_cast<int>(receivers_.size()) - 1;
}

bool Filler::fits_on_victim(int item) const {
    const std::vector<int>& shapes = nth(freedom_.shapes, item);
    return std::any_of(shapes.begin(), shapes.end(),
                       [&](int shape) { return task_.fits(shape, nth(layout_.rows, victim_)); });
}

// A smaller item of the receiver that may go to the victim for this lot.
std::optional<int> Filler::for_exchange(const Receiver& receiver, const std::vector<int>& lot) {
    const bool may = receiver.refusals >= kBeforeExchange && lot.size() == 1 &&
                     nth(task_.group_of, lot.front()) < 0 && !receiver.items.empty();
    if (!may || dice_.below(2) == 0) return std::nullopt;
    for (int i = 0; i < kLooks; ++i) {
        const int item = nth(receiver.items, dice_.below(static_cast<int>(receiver.items.size())));
        const bool goes = !task_.is_locked(item) && nth(task_.group_of, item) < 0;
        if (goes && area_of(item) < kSmaller * area_of(lot) && fits_on_victim(item)) return item;
    }
    return std::nullopt;
}

// Puts the item where it overlaps least of some random places; false if it fits nowhere on the sheet.
bool Filler::throw_on(int item) {
    const std::vector<int>& shapes = nth(freedom_.shapes, item);
    std::optional<Stand> best;
    double least = HUGE_VAL;
    for (int i = 0; i < kThrows && least > 0.0; ++i) {
        const int shape = nth(shapes, dice_.below(static_cast<int>(shapes.size())));
        const Board::Range range = board_.range(shape, 0);
        if (range.empty()) continue;
        const Stand stand{0, shape, std::round(dice_.between(range.x0, range.x1)),
                          std::round(dice_.between(range.y0, range.y1))};
        const double cost = board_.cost(item, stand, least);
        if (best && cost >= least) continue;
        best = stand;
        least = cost;
    }
    if (best) board_.put(item, *best);
    return best.has_value();
}

// Sets out with another lot and another sheet; false if that came to nothing at once.
bool Filler::attempt() {
    board_.work += kSettingOut;
    receiver_ = any_receiver();
    Receiver& receiver = nth(receivers_, receiver_);
    lot_ = dice_.below(static_cast<int>(lots_.size()));
    const std::vector<int>& lot = nth(lots_, lot_);
    given_ = for_exchange(receiver, lot);
    bool may = area_of(lot) - (given_ ? area_of(*given_) : 0.0) <= receiver.free;
    if (may) {
        board_.clear({nth(task_.rooms, nth(layout_.rows, receiver.sheet))});
        board_.set_table(task_.first_table());
        board_.reset_weights();
        loose_ = !task_.tight;
        for (const int item : receiver.items) {
            if (item == given_) continue;
            Stand stand = nth(layout_.stands, item);
            stand.sheet = 0;
            board_.put(item, stand);
        }
        may = std::all_of(lot.begin(), lot.end(), [&](int item) { return throw_on(item); });
    }
    if (may) {
        set_off();
    } else {
        finish(Separator::State::stuck);
    }
    return may;
}

void Filler::set_off() {
    const int patience = kPatience + nth(receivers_, receiver_).refusals;
    separator_ = std::make_unique<Separator>(board_, freedom_, dice_, Persistence{patience, 1});
}

void Filler::finish(Separator::State state) {
    separator_.reset();
    if (state == Separator::State::stuck) {
        ++nth(receivers_, receiver_).refusals;
        done_ = ++refusals_ > kMostRefusals * static_cast<int>(receivers_.size());
    } else if (loose_ || holds()) {
        succeed();
    } else {
        // Touching pieces may overlap by less than a step: then they are taken apart with room for rounding.
        board_.set_table(task_.loose);
        loose_ = true;
        set_off();
    }
}

// Whether nothing overlaps on the sheet of the attempt, in integers.
bool Filler::holds() const {
    std::vector<ExactPlace> places;
    for (const int item : board_.on_sheet(0)) places.push_back(exact_place(board_.at(item)));
    return !task_.exact.first_conflict(places, to_grid(task_.job.spacing));
}

void Filler::succeed() {
    Receiver& receiver = nth(receivers_, receiver_);
    const std::vector<int> lot = nth(lots_, lot_);
    lots_.erase(lots_.begin() + lot_);
    receiver.refusals = 0;
    refusals_ = 0;
    moved_ = true;
    receiver.items = board_.on_sheet(0);
    // In an order that says nothing of the search.
    std::sort(receiver.items.begin(), receiver.items.end());
    for (const int item : receiver.items) {
        nth(layout_.stands, item) = board_.at(item);
        nth(layout_.stands, item).sheet = receiver.sheet;
    }
    receiver.free -= area_of(lot);
    if (given_) {
        receiver.free += area_of(*given_);
        nth(layout_.stands, *given_).sheet = victim_;
        lots_.push_back({*given_});
    }
    done_ = lots_.empty();
}

void Filler::put_into(Arrangement& layout) const {
    for (const Receiver& receiver : receivers_) {
        for (const int item : receiver.items) nth(layout.stands, item) = nth(layout_.stands, item);
    }
    // What came in exchange, and what has been on the victim from the beginning.
    for (const std::vector<int>& lot : lots_) {
        for (const int item : lot) nth(layout.stands, item) = nth(layout_.stands, item);
    }
}

}  // namespace popup
