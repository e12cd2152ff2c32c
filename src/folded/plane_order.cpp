#include "folded/plane_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "base/nth.h"

namespace popup::folded {
namespace {

// Parts of so few equations are not parted again.
constexpr std::size_t kFew = 6;
// A cut is so far from the middle at most, as a share of all; and what that costs.
constexpr double kFurthestOff = 0.15;
constexpr double kOffCosts = 2.0;

class Dissection {
 public:
    Dissection(const std::vector<std::vector<int>>& joined, const std::vector<Vec2>& places)
        : joined_(joined),
          places_(places),
          sets_of_(places.size()),
          round_of_(places.size(), -1),
          rank_(places.size()) {
        for (std::size_t i = 0; i < joined.size(); ++i) {
            for (const int one : joined[i]) nth(sets_of_, one).push_back(static_cast<int>(i));
        }
    }

    std::vector<int> run() {
        // From the last place to the first: what parts two halves comes after both.
        int next = static_cast<int>(places_.size());
        std::vector<int> order(places_.size());
        std::vector<std::vector<int>> parts(1, std::vector<int>(places_.size()));
        std::iota(parts.front().begin(), parts.front().end(), 0);
        while (!parts.empty()) {
            std::vector<int> part = std::move(parts.back());
            parts.pop_back();
            if (part.size() <= kFew) {
                for (const int one : part) nth(order, one) = --next;
                continue;
            }
            std::vector<int> rest;
            const std::vector<int> between = part_in_two(part, rest);
            for (const int one : between) nth(order, one) = --next;
            if (!part.empty()) parts.push_back(std::move(part));
            if (!rest.empty()) parts.push_back(std::move(rest));
        }
        return order;
    }

 private:
    // Equations before `at`, in the order along an axis, and the others. What is between are those of one
    // side that have to do with the other.
    struct Cut {
        std::size_t at = 0;
        bool of_first = false;  // what is between is of those before `at`
        double cost = 0.0;      // how many are between, more where the sides are unequal
    };

    // Leaves one half, gives the other in `rest`, and returns what is between.
    std::vector<int> part_in_two(std::vector<int>& part, std::vector<int>& rest) {
        sort_along(part, false);
        const Cut level = best_cut(part);
        sort_along(part, true);
        Cut best = best_cut(part);
        if (level.cost < best.cost) {
            sort_along(part, false);
            best = level;
        }
        std::vector<int> first;
        std::vector<int> between;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const bool of_first = i < best.at;
            const auto [least, most] = reach(part[i]);
            if (of_first == best.of_first && (of_first ? most >= best.at : least < best.at)) {
                between.push_back(part[i]);
            } else {
                (of_first ? first : rest).push_back(part[i]);
            }
        }
        part = std::move(first);
        return between;
    }

    void sort_along(std::vector<int>& part, bool upright) {
        std::sort(part.begin(), part.end(), [&](int a, int b) {
            const Vec2 p = nth(places_, a);
            const Vec2 q = nth(places_, b);
            if (upright ? p.y != q.y : p.x != q.x) return upright ? p.y < q.y : p.x < q.x;
            return a < b;
        });
        ++round_;
        for (std::size_t i = 0; i < part.size(); ++i) {
            nth(round_of_, part[i]) = round_;
            nth(rank_, part[i]) = i;
        }
    }

    // The first and the last place among those of the part that it has to do with.
    std::pair<std::size_t, std::size_t> reach(int one) const {
        std::size_t least = nth(rank_, one);
        std::size_t most = least;
        for (const int set : nth(sets_of_, one)) {
            for (const int each : nth(joined_, set)) {
                if (nth(round_of_, each) != round_) continue;
                least = std::min(least, nth(rank_, each));
                most = std::max(most, nth(rank_, each));
            }
        }
        return {least, most};
    }

    [[nodiscard]] Cut best_cut(const std::vector<int>& part) const {
        const std::size_t count = part.size();
        // By place of the cut: how many more are between than one place before it.
        std::vector<int> of_first(count + 1, 0);
        std::vector<int> of_second(count + 1, 0);
        for (std::size_t i = 0; i < count; ++i) {
            const auto [least, most] = reach(part[i]);
            // It is before the cuts i + 1 … most, and behind the cuts least + 1 … i.
            ++of_first[i + 1];
            if (most + 1 < count) --of_first[most + 1];
            ++of_second[least + 1];
            --of_second[i + 1];
        }
        Cut best;
        int first = 0;
        int second = 0;
        const double all = static_cast<double>(count);
        for (std::size_t at = 1; at < count; ++at) {
            first += of_first[at];
            second += of_second[at];
            const double off = std::abs(static_cast<double>(at) / all - 0.5);
            if (off > kFurthestOff && at != count / 2) continue;
            const double cost = std::min(first, second) * (1.0 + kOffCosts * off);
            if (best.at == 0 || cost < best.cost) best = {at, first <= second, cost};
        }
        return best;
    }

    const std::vector<std::vector<int>>& joined_;
    const std::vector<Vec2>& places_;
    std::vector<std::vector<int>> sets_of_;
    std::vector<int> round_of_;  // by equation: the last round that it was in
    std::vector<std::size_t> rank_;
    int round_ = 0;
};

}  // namespace

std::vector<int> plane_order(const std::vector<std::vector<int>>& joined, const std::vector<Vec2>& places) {
    return Dissection(joined, places).run();
}

}  // namespace popup::folded
