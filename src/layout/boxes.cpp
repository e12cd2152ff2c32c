#include "layout/boxes.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>

namespace popup {
namespace {

struct Rect {
    GridLength x, y, width, height;
    [[nodiscard]] GridLength right() const { return x + width; }
    [[nodiscard]] GridLength top() const { return y + height; }
    [[nodiscard]] bool holds(const Rect& r) const {
        return r.x >= x && r.y >= y && r.right() <= right() && r.top() <= top();
    }
    [[nodiscard]] bool meets(const Rect& r) const {
        return r.x < right() && r.right() > x && r.y < top() && r.top() > y;
    }
};

// Smaller is better. Grid lengths multiply beyond 64 bits, so areas are doubles.
using Score = std::tuple<double, double, double>;

enum class Choice { short_side, area, leftmost, long_side };

struct Place {
    Score score;
    GridLength x = 0, y = 0;
    int way = 0;
};

// A sheet as the set of all largest free rectangles (they overlap), after Jylänki, "A Thousand Ways to Pack
// the Bin".
class FreeRects {
 public:
    explicit FreeRects(BoxSize size) : free_{{0, 0, size.width, size.height}} {}

    [[nodiscard]] std::optional<Place> find(const BoxItem& item, Choice choice) const {
        std::optional<Place> best;
        for (int way = 0; way < item.count; ++way) {
            const BoxSize size = item.ways[static_cast<std::size_t>(way)];
            for (const Rect& r : free_) {
                if (size.width > r.width || size.height > r.height) continue;
                const Score score = rate(r, size, choice);
                if (!best || score < best->score) best = Place{score, r.x, r.y, way};
            }
        }
        return best;
    }

    void take(const Rect& used) {
        fresh_.clear();
        std::size_t kept = 0;
        for (const Rect& r : free_) {
            if (!r.meets(used)) {
                free_[kept++] = r;
                continue;
            }
            if (used.x > r.x) fresh_.push_back({r.x, r.y, used.x - r.x, r.height});
            if (used.right() < r.right())
                fresh_.push_back({used.right(), r.y, r.right() - used.right(), r.height});
            if (used.y > r.y) fresh_.push_back({r.x, r.y, r.width, used.y - r.y});
            if (used.top() < r.top()) fresh_.push_back({r.x, used.top(), r.width, r.top() - used.top()});
        }
        free_.resize(kept);
        // Old rectangles never lie in new ones; only the new ones can be superfluous.
        for (std::size_t i = 0; i < fresh_.size(); ++i) {
            const auto around = [&](const Rect& r) { return r.holds(fresh_[i]); };
            bool superfluous =
                std::any_of(free_.begin(), free_.begin() + static_cast<std::ptrdiff_t>(kept), around);
            for (std::size_t j = 0; j < fresh_.size() && !superfluous; ++j) {
                superfluous = j != i && around(fresh_[j]) && (j < i || !fresh_[i].holds(fresh_[j]));
            }
            if (!superfluous) free_.push_back(fresh_[i]);
        }
    }

 private:
    static Score rate(const Rect& r, BoxSize size, Choice choice) {
        const auto dx = static_cast<double>(r.width - size.width);
        const auto dy = static_cast<double>(r.height - size.height);
        const auto right = static_cast<double>(r.x + size.width);
        const auto y = static_cast<double>(r.y);
        switch (choice) {
            case Choice::short_side:
                return {std::min(dx, dy), std::max(dx, dy), right};
            case Choice::long_side:
                return {std::max(dx, dy), std::min(dx, dy), right};
            case Choice::area:
                return {static_cast<double>(r.width) * static_cast<double>(r.height) -
                            static_cast<double>(size.width) * static_cast<double>(size.height),
                        std::min(dx, dy), right};
            case Choice::leftmost:
                return {right, y, static_cast<double>(r.x)};
        }
        return {};
    }

    std::vector<Rect> free_;
    std::vector<Rect> fresh_;
};

// A sheet as its contour: how far each stretch of its height is filled from the left. Little memory, fast,
// for runs of very many pieces.
class Contoured {
 public:
    explicit Contoured(BoxSize size) : size_(size), steps_{{0, 0}} {}

    [[nodiscard]] std::optional<Place> find(const BoxItem& item, Choice /*choice*/) const {
        std::optional<Place> best;
        for (int way = 0; way < item.count; ++way) {
            const BoxSize box = item.ways[static_cast<std::size_t>(way)];
            for (std::size_t i = 0; i < steps_.size(); ++i) {
                const GridLength y = steps_[i].y;
                if (y + box.height > size_.height) break;
                GridLength x = 0;
                for (std::size_t j = i; j < steps_.size() && steps_[j].y < y + box.height; ++j) {
                    x = std::max(x, steps_[j].x);
                }
                if (x + box.width > size_.width) continue;
                const Score score{static_cast<double>(x + box.width), static_cast<double>(y),
                                  static_cast<double>(x)};
                if (!best || score < best->score) best = Place{score, x, y, way};
            }
        }
        return best;
    }

    void take(const Rect& used) {
        GridLength after = 0;  // how far the stretch that goes on above the box is filled
        for (const Step& s : steps_) {
            if (s.y <= used.top()) after = s.x;
        }
        const auto first =
            std::find_if(steps_.begin(), steps_.end(), [&](const Step& s) { return s.y >= used.y; });
        const auto last = std::find_if(first, steps_.end(), [&](const Step& s) { return s.y > used.top(); });
        const auto at = steps_.erase(first, last);
        const std::array<Step, 2> fresh{Step{used.y, used.right()}, Step{used.top(), after}};
        steps_.insert(at, fresh.begin(), fresh.begin() + (used.top() < size_.height ? 2 : 1));
        const auto same = [](const Step& a, const Step& b) { return a.x == b.x; };
        steps_.erase(std::unique(steps_.begin(), steps_.end(), same), steps_.end());
    }

 private:
    struct Step {
        GridLength y, x;
    };
    BoxSize size_;
    std::vector<Step> steps_;
};

struct Packing {
    std::vector<BoxSpot> spots;
    int sheets = 0;
    GridLength last_length = 0;
    GridLength last_height = 0;
};

Rect rect_of(const BoxItem& item, const BoxSpot& spot) {
    const BoxSize size = item.ways[static_cast<std::size_t>(spot.way)];
    return {spot.x, spot.y, size.width, size.height};
}

// Numbers sheets so that the one with the shortest used part is the last.
void measure(std::span<const BoxItem> items, Packing& packing) {
    std::vector<Rect> used(static_cast<std::size_t>(packing.sheets), Rect{0, 0, 0, 0});
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Rect r = rect_of(items[i], packing.spots[i]);
        Rect& all = used[static_cast<std::size_t>(packing.spots[i].sheet)];
        all.width = std::max(all.width, r.right());
        all.height = std::max(all.height, r.top());
    }
    if (used.empty()) return;
    const auto shortest = std::min_element(used.rbegin(), used.rend(), [](const Rect& a, const Rect& b) {
        return std::tuple(a.width, a.height) < std::tuple(b.width, b.height);
    });
    const int moved = static_cast<int>(used.rend() - shortest) - 1;
    for (BoxSpot& spot : packing.spots) {
        if (spot.sheet == moved) {
            spot.sheet = packing.sheets - 1;
        } else if (spot.sheet > moved) {
            --spot.sheet;
        }
    }
    packing.last_length = shortest->width;
    packing.last_height = shortest->height;
}

// How boxes that may be turned are put: as fits best, all lying, or all standing. The first is greedy, and
// boxes that would tile the sheet one way are then sometimes better off without the choice.
enum class Lean { free, lying, standing };
constexpr std::array kLeans{Lean::free, Lean::lying, Lean::standing};

// The way a box must be put, or -1 when it may choose.
int forced_way(const BoxItem& item, Lean lean) {
    if (item.count == 1 || lean == Lean::free) return -1;
    const bool second_lies = item.ways[1].width > item.ways[0].width;
    return second_lies == (lean == Lean::lying) ? 1 : 0;
}

struct Attempt {
    Choice choice = Choice::leftmost;
    Lean lean = Lean::free;
    std::size_t most_open = 1;  // sheets; of more the oldest is closed
    int most_sheets = std::numeric_limits<int>::max();
};

// Puts the boxes, in this order, each on the first open sheet that takes it. nullopt when more than
// `most_sheets` are needed, or a box does not fit as it must be put.
template <class Sheet>
std::optional<Packing> first_fit(std::span<const BoxItem> items, const std::vector<int>& order, BoxSize size,
                                 const Attempt& attempt) {
    Packing packing;
    packing.spots.resize(items.size());
    std::vector<std::pair<int, Sheet>> open;
    for (const int number : order) {
        const BoxItem& item = items[static_cast<std::size_t>(number)];
        const int forced = forced_way(item, attempt.lean);
        const BoxItem tried =
            forced < 0 ? item : BoxItem{{item.ways[static_cast<std::size_t>(forced)], {}}, 1};
        std::optional<Place> place;
        std::size_t on = 0;
        for (; on < open.size() && !place; ++on) place = open[on].second.find(tried, attempt.choice);
        if (!place) {
            if (packing.sheets == attempt.most_sheets) return std::nullopt;
            if (open.size() == attempt.most_open) open.erase(open.begin());
            open.emplace_back(packing.sheets++, Sheet(size));
            on = open.size();
            place = open.back().second.find(tried, attempt.choice);
            if (!place) return std::nullopt;
        }
        auto& [sheet, state] = open[on - 1];
        const BoxSpot spot{sheet, place->x, place->y, forced < 0 ? place->way : forced};
        packing.spots[static_cast<std::size_t>(number)] = spot;
        state.take(rect_of(item, spot));
    }
    measure(items, packing);
    return packing;
}

using Order = std::function<double(BoxSize)>;

// Largest first, by several ideas of large.
std::vector<std::vector<int>> orders_of(std::span<const BoxItem> items, std::size_t count) {
    const auto w = [](BoxSize s) { return static_cast<double>(s.width); };
    const auto h = [](BoxSize s) { return static_cast<double>(s.height); };
    const std::array<Order, 5> keys{
        [=](BoxSize s) { return w(s) * h(s); },
        [=](BoxSize s) { return std::max(w(s), h(s)); },
        [=](BoxSize s) { return std::min(w(s), h(s)); },
        [=](BoxSize s) { return w(s); },
        [=](BoxSize s) { return h(s); },
    };
    std::vector<std::vector<int>> orders;
    for (std::size_t k = 0; k < std::min(count, keys.size()); ++k) {
        std::vector<double> key;
        for (const BoxItem& item : items) key.push_back(keys[k](item.ways[0]));
        std::vector<int> order(items.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
            return key[static_cast<std::size_t>(a)] > key[static_cast<std::size_t>(b)];
        });
        orders.push_back(std::move(order));
    }
    return orders;
}

bool better(const Packing& a, const Packing& b) {
    return std::tuple(a.sheets, a.last_length, a.last_height) <
           std::tuple(b.sheets, b.last_length, b.last_height);
}

constexpr std::array kChoices{Choice::leftmost, Choice::short_side, Choice::area, Choice::long_side};

// Tries every order with every choice and every lean.
std::optional<Packing> best_of(std::span<const BoxItem> items, const std::vector<std::vector<int>>& orders,
                               BoxSize size, std::size_t choices, int most_sheets) {
    std::optional<Packing> best;
    const bool turns =
        std::any_of(items.begin(), items.end(), [](const BoxItem& item) { return item.count > 1; });
    for (const std::vector<int>& order : orders) {
        for (std::size_t c = 0; c < choices; ++c) {
            for (const Lean lean : kLeans) {
                if (lean != Lean::free && !turns) continue;
                auto packing =
                    first_fit<FreeRects>(items, order, size, {kChoices[c], lean, items.size(), most_sheets});
                if (packing && (!best || better(*packing, *best))) best = std::move(packing);
            }
        }
    }
    return best;
}

// Packs what is on the last sheet again, into ever narrower sheets.
void shorten_last_sheet(std::span<const BoxItem> items, BoxSize sheet, Packing& packing) {
    constexpr int kRounds = 12;
    constexpr GridLength kWorthwhile = 500'000;  // half a millimetre
    std::vector<BoxItem> last;
    std::vector<std::size_t> numbers;
    double area = 0.0;
    GridLength low = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (packing.spots[i].sheet != packing.sheets - 1) continue;
        last.push_back(items[i]);
        numbers.push_back(i);
        GridLength narrowest = items[i].ways[0].width;
        if (items[i].count > 1) narrowest = std::min(narrowest, items[i].ways[1].width);
        low = std::max(low, narrowest);
        area += static_cast<double>(items[i].ways[0].width) * static_cast<double>(items[i].ways[0].height);
    }
    low = std::max(low, static_cast<GridLength>(area / static_cast<double>(sheet.height)));
    const auto orders = orders_of(last, 5);
    GridLength high = packing.last_length;
    for (int round = 0; round < kRounds && high - low > kWorthwhile; ++round) {
        const GridLength width = low + (high - low) / 2;
        const auto found = best_of(last, orders, {width, sheet.height}, kChoices.size(), 1);
        if (!found) {
            low = width;
            continue;
        }
        for (std::size_t i = 0; i < last.size(); ++i) {
            BoxSpot& spot = packing.spots[numbers[i]];
            spot.x = found->spots[i].x;
            spot.y = found->spots[i].y;
            spot.way = found->spots[i].way;
        }
        packing.last_length = high = found->last_length;
        packing.last_height = found->last_height;
    }
}

// How many boxes a full sheet holds, about.
double boxes_a_sheet(std::span<const BoxItem> items, BoxSize sheet) {
    double area = 0.0;
    for (const BoxItem& item : items) {
        area += static_cast<double>(item.ways[0].width) * static_cast<double>(item.ways[0].height);
    }
    return static_cast<double>(items.size()) * static_cast<double>(sheet.width) *
           static_cast<double>(sheet.height) / area;
}

// A long order as a row of short ones, each with boxes of all sizes: small boxes then fill the sheets of
// large ones while these are still open.
std::vector<int> in_batches(const std::vector<int>& order, std::size_t batch) {
    const std::size_t batches = (order.size() + batch - 1) / batch;
    std::vector<int> result;
    result.reserve(order.size());
    for (std::size_t first = 0; first < batches; ++first) {
        for (std::size_t i = first; i < order.size(); i += batches) result.push_back(order[i]);
    }
    return result;
}

}  // namespace

std::vector<BoxSpot> place_boxes(std::span<const BoxItem> items, BoxSize sheet) {
    // How much is tried depends on the boxes only, so that results are the same on any machine.
    constexpr std::size_t kFew = 150;
    constexpr std::size_t kSome = 600;
    constexpr double kCrowd = 150.0;  // on one sheet: too many free rectangles to look through
    constexpr std::size_t kBatch = 1000;
    constexpr std::size_t kOpenSheets = 64;
    constexpr std::size_t kOpenCrowds = 4;
    const int any_number = std::numeric_limits<int>::max();
    if (items.empty()) return {};
    if (items.size() <= kFew) {
        auto best = best_of(items, orders_of(items, 5), sheet, kChoices.size(), any_number);
        shorten_last_sheet(items, sheet, *best);
        return best->spots;
    }
    if (items.size() <= kSome) return best_of(items, orders_of(items, 1), sheet, 2, any_number)->spots;
    if (boxes_a_sheet(items, sheet) <= kCrowd) {
        const auto order = in_batches(orders_of(items, 1).back(), kBatch);
        return first_fit<FreeRects>(items, order, sheet,
                                    {Choice::short_side, Lean::free, kOpenSheets, any_number})
            ->spots;
    }
    const auto order = orders_of(items, 4).back();  // widest first: the contour grows evenly
    return first_fit<Contoured>(items, order, sheet, {Choice::leftmost, Lean::free, kOpenCrowds, any_number})
        ->spots;
}

}  // namespace popup
