#include "folded/flat/layers.h"

#include <algorithm>
#include <utility>

#include "base/nth.h"
#include "base/sets.h"

namespace popup::folded {
namespace {

// A conflict among more panels is told as it is.
constexpr std::size_t kShrinkAtMost = 64;

unsigned long long key_of(int a, int b) {
    return (static_cast<unsigned long long>(static_cast<unsigned>(a)) << 32U) | static_cast<unsigned>(b);
}

}  // namespace

int Layers::pair(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [at, is_new] = number_.try_emplace(key_of(a, b), static_cast<int>(pairs_.size()));
    if (is_new) pairs_.push_back({a, b});
    return at->second;
}

int Layers::count(Kind kind) {
    switch (kind) {
        case Kind::fixed:
            return 1;
        case Kind::equal:
            return 2;
        case Kind::cycle:
            return 3;
        case Kind::even:
            return 4;
    }
    return 0;
}

std::optional<Layers::Literal> Layers::literal(int a, int b) const {
    const auto found = number_.find(a < b ? key_of(a, b) : key_of(b, a));
    if (found == number_.end()) return std::nullopt;
    return Literal{found->second, static_cast<signed char>(a < b ? 1 : -1)};
}

void Layers::add(Kind kind, const std::array<std::optional<Literal>, 4>& of) {
    Condition condition{kind, {}};
    for (int i = 0; i < count(kind); ++i) {
        if (!nth(of, i)) return;
        nth(condition.of, i) = *nth(of, i);
    }
    conditions_.push_back(condition);
}

std::optional<bool> Layers::is_above(const Solution& found, int a, int b) const {
    const std::optional<Literal> one = literal(a, b);
    if (!one) return std::nullopt;
    return found.above[static_cast<std::size_t>(one->pair)] == one->sign;
}

void Layers::lies_above(int a, int b) { add(Kind::fixed, {literal(a, b)}); }
void Layers::not_between(int a, int b, int c) { add(Kind::equal, {literal(a, c), literal(b, c)}); }
void Layers::not_interleaved(int a, int b, int c, int d) {
    add(Kind::even, {literal(a, c), literal(b, c), literal(a, d), literal(b, d)});
}
void Layers::in_order(int a, int b, int c) {
    add(Kind::cycle, {literal(a, b), literal(b, c), literal(c, a)});
}

// Takes what follows from what is known, then tries what does not, one set of pairs that hang together after
// the other.
class LayerSearch {
 public:
    // `kept`: by panel, whether conditions that name it count; empty: all do.
    LayerSearch(const Layers& layers, const std::vector<char>& kept, std::size_t work)
        : layers_(layers), work_(work), value_(layers.pairs(), 0), names_(layers.pairs()) {
        for (std::size_t i = 0; i < layers.conditions_.size(); ++i) {
            const Layers::Condition& one = layers.conditions_[i];
            bool counts = true;
            for (int k = 0; k < Layers::count(one.kind); ++k) {
                for (const int panel : layers.panels_of(nth(one.of, k).pair))
                    counts = counts && (kept.empty() || nth(kept, panel) != 0);
            }
            if (!counts) continue;
            active_.push_back(static_cast<int>(i));
            for (int k = 0; k < Layers::count(one.kind); ++k)
                nth(names_, nth(one.of, k).pair).push_back(static_cast<int>(i));
        }
    }

    Layers::Solution run() {
        Layers::Solution result;
        result.kind = search(result.panels);
        if (result.kind == Layers::Solution::found) result.above = value_;
        return result;
    }
    [[nodiscard]] std::size_t work() const { return work_; }

 private:
    using Literal = Layers::Literal;
    using Kind = Layers::Kind;

    Layers::Solution::Kind search(std::vector<int>& panels) {
        for (const int number : active_) {
            const Layers::Condition& one = nth(layers_.conditions_, number);
            if (one.kind == Kind::fixed && !set(one.of[0].pair, one.of[0].sign))
                return fail({number}, panels);
        }
        if (!follow()) return fail({conflict_}, panels);
        // Sets of pairs that conditions join.
        Sets sets(value_.size());
        for (const int number : active_) {
            const Layers::Condition& one = nth(layers_.conditions_, number);
            int first = -1;
            for (int k = 0; k < Layers::count(one.kind); ++k) {
                const int pair = nth(one.of, k).pair;
                if (nth(value_, pair) != 0) continue;
                if (first >= 0) sets.unite(first, pair);
                first = pair;
            }
        }
        std::vector<std::vector<int>> parts(value_.size());
        for (std::size_t i = 0; i < value_.size(); ++i) {
            if (value_[i] == 0) nth(parts, sets.find(static_cast<int>(i))).push_back(static_cast<int>(i));
        }
        for (const std::vector<int>& part : parts) {
            if (part.empty()) continue;
            const auto kind = try_all(part);
            if (kind == Layers::Solution::none) {
                for (const int pair : part) {
                    for (const int panel : layers_.panels_of(pair)) panels.push_back(panel);
                }
                // What they hang on counts as well.
                std::vector<int> conditions;
                for (const int pair : part)
                    conditions.insert(conditions.end(), nth(names_, pair).begin(), nth(names_, pair).end());
                return fail(conditions, panels);
            }
            if (kind != Layers::Solution::found) return kind;
        }
        return Layers::Solution::found;
    }

    // The panels of conditions, and of what forced the values in them before anything was tried.
    Layers::Solution::Kind fail(std::vector<int> open, std::vector<int>& panels) {
        std::vector<char> seen(layers_.conditions_.size(), 0);
        while (!open.empty()) {
            const int number = open.back();
            open.pop_back();
            if (number < 0 || std::exchange(nth(seen, number), 1) != 0) continue;
            const Layers::Condition& one = nth(layers_.conditions_, number);
            for (int k = 0; k < Layers::count(one.kind); ++k) {
                const int pair = nth(one.of, k).pair;
                for (const int panel : layers_.panels_of(pair)) panels.push_back(panel);
                const auto reason = reasons_.find(pair);
                if (reason != reasons_.end()) open.push_back(reason->second);
            }
        }
        std::sort(panels.begin(), panels.end());
        panels.erase(std::unique(panels.begin(), panels.end()), panels.end());
        return Layers::Solution::none;
    }

    // Tries values for pairs, going back to the last that has another one left.
    Layers::Solution::Kind try_all(const std::vector<int>& part) {
        struct Choice {
            std::size_t trail;
            std::size_t at;
            bool last;
        };
        std::vector<Choice> choices;
        keeps_reasons_ = false;
        std::size_t at = 0;
        while (true) {
            while (at < part.size() && nth(value_, part[at]) != 0) ++at;
            if (at == part.size()) return Layers::Solution::found;
            choices.push_back({trail_.size(), at, false});
            signed char sign = 1;
            while (!(set(part[at], sign) && follow())) {
                if (work_ == 0) return Layers::Solution::undecided;
                while (!choices.empty() && choices.back().last) choices.pop_back();
                if (choices.empty()) return Layers::Solution::none;
                take_back(choices.back().trail);
                choices.back().last = true;
                at = choices.back().at;
                sign = -1;
            }
            if (work_ == 0) return Layers::Solution::undecided;
        }
    }

    void take_back(std::size_t length) {
        while (trail_.size() > length) {
            nth(value_, trail_.back()) = 0;
            trail_.pop_back();
        }
        followed_ = length;
    }

    bool set(int pair, signed char sign) {
        signed char& value = nth(value_, pair);
        if (value != 0) return value == sign;
        value = sign;
        trail_.push_back(pair);
        return true;
    }

    // Sets what follows; false if that contradicts itself, or the work is used up.
    bool follow() {
        for (; followed_ < trail_.size(); ++followed_) {
            for (const int number : nth(names_, trail_[followed_])) {
                if (work_ == 0) return false;
                --work_;
                const std::size_t before = trail_.size();
                if (!holds(nth(layers_.conditions_, number))) {
                    conflict_ = number;
                    return false;
                }
                if (keeps_reasons_ && trail_.size() > before) reasons_[trail_.back()] = number;
            }
        }
        return true;
    }

    [[nodiscard]] int value(Literal literal) const { return nth(value_, literal.pair) * literal.sign; }

    // False if a condition is broken. Sets the last pair that it leaves no choice.
    bool holds(const Layers::Condition& one) {
        const int size = Layers::count(one.kind);
        int open = -1;
        int product = 1;
        int sum = 0;
        for (int k = 0; k < size; ++k) {
            const int here = value(nth(one.of, k));
            if (here == 0) {
                if (open >= 0) return true;
                open = k;
                continue;
            }
            product *= here;
            sum += here;
        }
        if (one.kind == Kind::cycle) {
            if (open < 0) return sum != 3 && sum != -3;
            if (sum == 0) return true;
            product = sum > 0 ? -1 : 1;
        } else if (one.kind == Kind::fixed) {
            return open >= 0 || product == 1;
        } else if (open < 0) {
            return product == 1;
        }
        const Literal last = nth(one.of, open);
        return set(last.pair, static_cast<signed char>(product * last.sign));
    }

    const Layers& layers_;
    std::size_t work_;
    std::vector<signed char> value_;
    std::vector<std::vector<int>> names_;  // by pair: conditions that name it
    std::vector<int> active_;
    std::vector<int> trail_;
    std::size_t followed_ = 0;
    int conflict_ = -1;
    bool keeps_reasons_ = true;
    std::unordered_map<int, int> reasons_;  // by pair: the condition that set it
};

Layers::Solution Layers::solve(std::size_t most_work) const {
    LayerSearch search(*this, {}, most_work);
    Solution result = search.run();
    if (result.kind != Solution::none || result.panels.size() > kShrinkAtMost) return result;
    // Without one panel after the other: what still has no order does not need it.
    std::size_t work = search.work();
    int most = 0;
    for (const auto& pair : pairs_) most = std::max(most, pair[1]);
    std::vector<char> kept(static_cast<std::size_t>(most) + 1, 0);
    for (const int panel : result.panels) nth(kept, panel) = 1;
    for (const int panel : result.panels) {
        nth(kept, panel) = 0;
        LayerSearch without(*this, kept, work);
        if (work == 0 || without.run().kind != Solution::none) nth(kept, panel) = 1;
        work = without.work();
    }
    std::erase_if(result.panels, [&](int panel) { return nth(kept, panel) == 0; });
    return result;
}

}  // namespace popup::folded
