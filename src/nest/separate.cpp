#include "nest/separate.h"

#include <algorithm>
#include <cmath>

namespace popup {
namespace {

constexpr float kDecay = 0.95F;
constexpr float kLeastGrowth = 1.2F;
constexpr float kMostGrowth = 2.0F;

constexpr double kGain = 0.98;

// Random places that are looked at to move an item, those of them that are near, and how far these are, as
// shares of the item's box.
constexpr int kSamples = 24;
constexpr int kNearSamples = 8;
constexpr double kNear = 0.3;

}  // namespace

Separator::Separator(Board& board, const Freedom& freedom, Dice& dice, Persistence persistence)
    : board_(board), freedom_(freedom), dice_(dice), persistence_(persistence) {
    board_.reset_weights();
    find_overlaps();
    best_ = total_;
    at_start_ = best_;
    incumbent_ = board_.stands();
}

Separator::State Separator::run(double limit) {
    while (best_ > 0.0) {
        if (waited_ >= persistence_.patience) {
            strikes_ = best_ < kGain * at_start_ ? 0 : strikes_ + 1;
            restore();
            if (strikes_ >= persistence_.strikes) return State::stuck;
            at_start_ = best_;
            waited_ = 0;
        }
        if (board_.work > limit) return State::paused;
        pass(limit);
        find_overlaps();
        if (total_ < best_) {
            if (total_ < kGain * best_) waited_ = 0;
            best_ = total_;
            incumbent_ = board_.stands();
        } else {
            ++waited_;
        }
        reweigh();
    }
    return State::apart;
}

void Separator::restore() {
    for (int i = 0; i < board_.items(); ++i) {
        if (board_.placed(i)) board_.put(i, incumbent_[index(i)]);
    }
    find_overlaps();
}

// All overlapping pairs: a sweep from left to right over each sheet.
void Separator::find_overlaps() {
    pairs_.clear();
    total_ = 0.0;
    for (std::size_t s = 0; s < board_.rooms().size(); ++s) {
        order_.clear();
        for (const int item : board_.on_sheet(static_cast<int>(s))) {
            const Stand& stand = board_.at(item);
            const GridBox& reach = board_.shape(stand.shape).reach;
            order_.push_back(
                {stand.x + static_cast<double>(reach.x0), stand.x + static_cast<double>(reach.x1),
                 stand.y + static_cast<double>(reach.y0), stand.y + static_cast<double>(reach.y1), item});
        }
        std::sort(order_.begin(), order_.end(), [](const Extent& a, const Extent& b) {
            return a.x0 != b.x0 ? a.x0 < b.x0 : a.item < b.item;
        });
        for (std::size_t i = 0; i < order_.size(); ++i) {
            for (std::size_t k = i + 1; k < order_.size() && order_[k].x0 < order_[i].x1; ++k) {
                if (order_[k].y0 >= order_[i].y1 || order_[k].y1 <= order_[i].y0) continue;
                // Locked items are apart in truth; in a table with room for rounding they need not be.
                if (freedom_.movable[index(order_[i].item)] == 0 &&
                    freedom_.movable[index(order_[k].item)] == 0) {
                    continue;
                }
                const double overlap = board_.overlap(order_[i].item, order_[k].item);
                if (overlap <= 0.0) continue;
                pairs_.push_back({order_[i].item, order_[k].item, overlap});
                total_ += overlap;
            }
        }
    }
}

void Separator::reweigh() {
    double most = 0.0;
    for (const Pair& pair : pairs_) most = std::max(most, pair.overlap);
    next_heavy_.clear();
    for (const Pair& pair : pairs_) {
        const auto growth =
            kLeastGrowth + (kMostGrowth - kLeastGrowth) * static_cast<float>(pair.overlap / most);
        const float weight = board_.weight(pair.a, pair.b);
        if (weight == 1.0F) heavy_.push_back({pair.a, pair.b, 0.0});
        // The decay below takes this back for pairs that do not overlap only.
        board_.set_weight(pair.a, pair.b, std::min(weight * growth / kDecay, 1e12F));
    }
    for (const Pair& pair : heavy_) {
        const float weight = board_.weight(pair.a, pair.b) * kDecay;
        if (weight > 1.0F) {
            board_.set_weight(pair.a, pair.b, weight);
            next_heavy_.push_back(pair);
        } else {
            board_.set_weight(pair.a, pair.b, 1.0F);
        }
    }
    heavy_.swap(next_heavy_);
}

void Separator::pass(double limit) {
    colliding_.clear();
    for (const Pair& pair : pairs_) {
        for (const int item : {pair.a, pair.b}) {
            if (freedom_.movable[index(item)] != 0) colliding_.push_back(item);
        }
    }
    std::sort(colliding_.begin(), colliding_.end());
    colliding_.erase(std::unique(colliding_.begin(), colliding_.end()), colliding_.end());
    dice_.shuffle(colliding_);
    for (const int item : colliding_) {
        move(item);
        if (board_.work > limit) return;
    }
}

// Level and upright lines in turn until neither gains.
double Separator::settle(int item, Stand& stand, double cost) {
    const Board::Range range = board_.range(stand.shape, stand.sheet);
    bool level = dice_.below(2) == 0;
    // How many of the two lines through the stand can gain nothing. After a move it is one: the line of that
    // move, which went to its best place.
    int idle = 0;
    for (int i = 0; i < 12 && idle < 2; ++i, level = !level) {
        Stand next = stand;
        const double found = level ? board_.best_on_line(item, next, Board::Along::x, range.x0, range.x1,
                                                         Board::Among::nearest, cost)
                                   : board_.best_on_line(item, next, Board::Along::y, range.y0, range.y1,
                                                         Board::Among::nearest, cost);
        if (found < cost) {
            cost = found;
            stand = next;
            idle = 1;
        } else {
            ++idle;
        }
        if (cost == 0.0) break;
    }
    return cost;
}

int Separator::any_of(const std::vector<int>& numbers) {
    return numbers[index(dice_.below(static_cast<int>(numbers.size())))];
}

// A random place in a random turn; nullopt if the item does not fit there in it.
std::optional<Stand> Separator::anywhere(int item) {
    const std::vector<int>& sheets = freedom_.sheets[index(item)];
    Stand stand;
    stand.sheet = sheets.empty() ? dice_.below(static_cast<int>(board_.rooms().size())) : any_of(sheets);
    stand.shape = any_of(freedom_.shapes[index(item)]);
    const Board::Range range = board_.range(stand.shape, stand.sheet);
    if (range.empty()) return std::nullopt;
    stand.x = std::round(dice_.between(range.x0, range.x1));
    stand.y = std::round(dice_.between(range.y0, range.y1));
    return stand;
}

// The same where the middle of its box moves by no more than a share of the box.
std::optional<Stand> Separator::nearby(int item) {
    const Stand& old = board_.at(item);
    Stand stand{old.sheet, any_of(freedom_.shapes[index(item)]), 0.0, 0.0};
    const Board::Range range = board_.range(stand.shape, stand.sheet);
    if (range.empty()) return std::nullopt;
    const GridBox& from = board_.shape(old.shape).bounds;
    const GridBox& to = board_.shape(stand.shape).bounds;
    const auto shaken = [&](double at, GridLength was, GridLength is, GridLength size, double low,
                            double high) {
        const double middle = at + 0.5 * static_cast<double>(was - is);
        const double reach = kNear * static_cast<double>(size);
        return std::round(std::clamp(dice_.between(middle - reach, middle + reach), low, high));
    };
    stand.x = shaken(old.x, from.x0 + from.x1, to.x0 + to.x1, from.width(), range.x0, range.x1);
    stand.y = shaken(old.y, from.y0 + from.y1, to.y0 + to.y1, from.height(), range.y0, range.y1);
    return stand;
}

void Separator::move(int item) {
    const Stand old = board_.at(item);
    const double now = board_.cost(item, old, HUGE_VAL);
    if (now == 0.0) return;
    Stand best = old;
    double best_cost = now;
    const auto offer = [&](const Stand& stand, double cost) {
        if (cost < best_cost || (cost == best_cost && cost < now)) {
            best = stand;
            best_cost = cost;
        }
    };
    // Near: from where it stands, both ways.
    {
        Stand stand = old;
        const double cost = settle(item, stand, now);
        offer(stand, cost);
    }
    // From the best of some random places, a few of them near.
    Stand start;
    double least = HUGE_VAL;
    for (int i = 0; i < kSamples && best_cost > 0.0; ++i) {
        const auto stand = i < kNearSamples ? nearby(item) : anywhere(item);
        if (!stand) continue;
        const double cost = board_.cost(item, *stand, least);
        if (cost >= least) continue;
        start = *stand;
        least = cost;
    }
    if (least < HUGE_VAL && best_cost > 0.0) {
        const double cost = settle(item, start, least);
        offer(start, cost);
    }
    if (best_cost < now) board_.put(item, best);
}

}  // namespace popup
