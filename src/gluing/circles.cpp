#include "gluing/circles.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/nth.h"

namespace popup {
namespace {

using Lists = std::vector<std::vector<int>>;

// The numbers reached from `start` over `next`, each after all that is reached from it; `seen` grows.
void reach(int start, const Lists& next, std::vector<char>& seen, std::vector<int>& out) {
    if (nth(seen, start) != 0) return;
    nth(seen, start) = 1;
    std::vector<std::pair<int, std::size_t>> way{{start, 0}};
    while (!way.empty()) {
        const int at = way.back().first;
        const std::vector<int>& to = nth(next, at);
        if (way.back().second == to.size()) {
            out.push_back(at);
            way.pop_back();
            continue;
        }
        const int one = to[way.back().second++];
        if (nth(seen, one) != 0) continue;
        nth(seen, one) = 1;
        way.emplace_back(one, 0);
    }
}

// Which circle each number is in (S. R. Kosaraju's two passes): numbers of one circle have one mark.
std::vector<int> circles_of(const Lists& before, const Lists& after) {
    std::vector<char> seen(before.size(), 0);
    std::vector<int> finished;
    for (std::size_t i = 0; i < before.size(); ++i) reach(static_cast<int>(i), after, seen, finished);
    std::fill(seen.begin(), seen.end(), 0);
    std::vector<int> circle(before.size(), -1);
    int mark = 0;
    for (auto one = finished.rbegin(); one != finished.rend(); ++one) {
        std::vector<int> members;
        reach(*one, before, seen, members);
        for (const int member : members) nth(circle, member) = mark;
        ++mark;
    }
    return circle;
}

// What may come next. Of each circle the one with the fewest open wants is offered, of those the first.
class Queue {
 public:
    explicit Queue(std::vector<int> circles) : circle_(std::move(circles)), open_(circle_.size(), 0) {}
    // How many wants of a number are not met yet; before it is ready.
    void want(int one) { ++nth(open_, one); }
    void add(int one) {
        change(one, [&](auto& ready) { ready.insert({nth(open_, one), one}); });
    }
    // A want of it is met.
    void meet(int one) {
        change(one, [&](auto& ready) {
            const bool was_ready = ready.erase({nth(open_, one), one}) > 0;
            --nth(open_, one);
            if (was_ready) ready.insert({nth(open_, one), one});
        });
    }
    std::optional<int> take() {
        if (offers_.empty()) return std::nullopt;
        const int one = *offers_.begin();
        change(one, [&](auto& ready) { ready.erase({nth(open_, one), one}); });
        return one;
    }

 private:
    template <typename Change>
    void change(int one, const Change& how) {
        auto& ready = ready_[nth(circle_, one)];
        if (!ready.empty()) offers_.erase(ready.begin()->second);
        how(ready);
        if (!ready.empty()) offers_.insert(ready.begin()->second);
    }

    std::vector<int> circle_, open_;
    std::map<int, std::set<std::pair<int, int>>> ready_;  // by circle: open wants, and the number
    std::set<int> offers_;
};

// Moves those that are in circles, with what must follow (or lead) them, past their neighbours, as long as
// more wants are met by that.
class Mover {
 public:
    Mover(const Lists& blocks, const Lists& meets) : blocks_(sets_of(blocks)), meets_(sets_of(meets)) {}

    void run(std::vector<int>& order, const std::vector<char>& in_circle) const {
        bool moved = true;
        for (int round = 0; round < kRounds && moved; ++round) {
            moved = false;
            for (std::size_t at = 0; at < order.size(); ++at) {
                if (nth(in_circle, order[at]) != 0)
                    moved = move_back(order, at) || move_on(order, at) || moved;
            }
        }
    }

 private:
    static constexpr int kRounds = 8;
    static constexpr std::size_t kFurthest = 64;

    static std::vector<std::set<int>> sets_of(const Lists& lists) {
        std::vector<std::set<int>> sets;
        for (const std::vector<int>& list : lists) sets.emplace_back(list.begin(), list.end());
        return sets;
    }

    [[nodiscard]] bool move_on(std::vector<int>& order, std::size_t at) const {
        return move(order.begin() + static_cast<std::ptrdiff_t>(at), order.end(), [](int first, int then) {
            return std::pair{first, then};
        });
    }
    // The same from the end of the order, where what comes first comes then.
    [[nodiscard]] bool move_back(std::vector<int>& order, std::size_t at) const {
        return move(order.rend() - static_cast<std::ptrdiff_t>(at) - 1, order.rend(),
                    [](int first, int then) {
                        return std::pair{then, first};
                    });
    }

    // Moves the first of a range on, to where most wants are met, of several places to the nearest. False if
    // it stays.
    template <typename Place, typename Turned>
    [[nodiscard]] bool move(Place begin, Place end, const Turned& turned) const {
        std::vector<int> along{*begin};
        std::vector<int> passed;
        std::vector<int> best;
        int gain = 0;
        int most = 0;
        const auto furthest = std::min<std::ptrdiff_t>(end - begin, kFurthest);
        for (Place place = begin + 1; place != begin + furthest; ++place) {
            const int other = *place;
            const bool follows = std::any_of(along.begin(), along.end(), [&](int one) {
                const auto [first, then] = turned(one, other);
                return nth(blocks_, first).contains(then);
            });
            if (follows) {
                along.push_back(other);
                continue;
            }
            passed.push_back(other);
            for (const int one : along) {
                const auto [first, then] = turned(one, other);
                gain +=
                    (nth(meets_, then).contains(first) ? 1 : 0) - (nth(meets_, first).contains(then) ? 1 : 0);
            }
            if (gain <= most) continue;
            most = gain;
            best = passed;
            best.insert(best.end(), along.begin(), along.end());
        }
        std::copy(best.begin(), best.end(), begin);
        return most > 0;
    }

    std::vector<std::set<int>> blocks_;  // of each: those that must come after it
    std::vector<std::set<int>> meets_;   // of each: those that had better
};

}  // namespace

void break_circles(std::vector<std::set<int>>& before) {
    Lists after(before.size());
    std::vector<std::size_t> left(before.size());
    std::set<int> waiting;
    std::set<int> ready;
    for (std::size_t i = 0; i < before.size(); ++i) {
        left[i] = before[i].size();
        for (const int one : before[i]) nth(after, one).push_back(static_cast<int>(i));
        (left[i] == 0 ? ready : waiting).insert(static_cast<int>(i));
    }
    std::vector<char> done(before.size(), 0);
    while (!ready.empty() || !waiting.empty()) {
        if (ready.empty()) {
            const int least = *waiting.begin();
            std::set<int>& of_it = nth(before, least);
            for (auto one = of_it.begin(); one != of_it.end();)
                one = nth(done, *one) == 0 ? of_it.erase(one) : std::next(one);
            waiting.erase(least);
            ready.insert(least);
        }
        const int one = *ready.begin();
        ready.erase(one);
        nth(done, one) = 1;
        for (const int later : nth(after, one)) {
            if (nth(done, later) != 0 || !waiting.contains(later) || --nth(left, later) > 0) continue;
            waiting.erase(later);
            ready.insert(later);
        }
    }
}

std::vector<int> grounds_first(const std::vector<std::set<int>>& before) {
    std::vector<int> numbers;
    Wants musts;
    for (std::size_t i = 0; i < before.size(); ++i) {
        numbers.push_back(static_cast<int>(i));
        if (!before[i].empty()) musts.must[static_cast<int>(i)] = before[i];
    }
    return ordered(numbers, musts);
}

std::vector<int> ordered(const std::vector<int>& by_rank, const Wants& wants) {
    std::map<int, int> place;
    for (std::size_t i = 0; i < by_rank.size(); ++i) place[by_rank[i]] = static_cast<int>(i);
    Lists before(by_rank.size());
    Lists after(by_rank.size());
    const auto each = [&](const std::map<int, std::set<int>>& edges, const auto& use) {
        for (const auto& [one, firsts] : edges) {
            for (const int first : firsts) use(place.at(first), place.at(one));
        }
    };
    for (const auto* const edges : {&wants.must, &wants.wants}) {
        each(*edges, [&](int from, int to) {
            nth(before, to).push_back(from);
            nth(after, from).push_back(to);
        });
    }
    // Wants between circles are musts.
    const std::vector<int> circle = circles_of(before, after);
    Queue queue(circle);
    Lists blocks(by_rank.size());
    Lists meets(by_rank.size());
    std::vector<int> blocked(by_rank.size(), 0);
    std::vector<char> in_circle(by_rank.size(), 0);
    const auto must = [&](int from, int to) {
        nth(blocks, from).push_back(to);
        ++nth(blocked, to);
    };
    each(wants.must, must);
    each(wants.wants, [&](int from, int to) {
        if (nth(circle, from) != nth(circle, to)) return must(from, to);
        nth(meets, from).push_back(to);
        nth(in_circle, from) = nth(in_circle, to) = 1;
        queue.want(to);
    });
    for (std::size_t i = 0; i < by_rank.size(); ++i) {
        if (blocked[i] == 0) queue.add(static_cast<int>(i));
    }
    std::vector<int> order;
    while (const std::optional<int> one = queue.take()) {
        order.push_back(*one);
        for (const int later : nth(meets, *one)) queue.meet(later);
        for (const int later : nth(blocks, *one)) {
            if (--nth(blocked, later) == 0) queue.add(later);
        }
    }
    Mover(blocks, meets).run(order, in_circle);
    for (int& one : order) one = nth(by_rank, one);
    return order;
}

}  // namespace popup
