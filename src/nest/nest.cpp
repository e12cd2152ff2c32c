#include "popup/nest.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "base/nth.h"
#include "nest/grid.h"
#include "nest/search.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

// Up to this many items are placed by one search.
constexpr std::size_t kOneSearch = 1500;
// Of jobs of which a part is found this often, that part is laid out once, and its sheets are repeated.
constexpr std::size_t kOften = 3;
// So many items are laid out for that: of each kind so many, but no more than so many in all, unless they do
// not fill a sheet.
constexpr std::size_t kSampleOfKind = 16;
constexpr std::size_t kSample = 64;
// More are placed in batches of about so many, each with what lay on the last sheet of the one before.
constexpr std::size_t kBatch = 1000;

// The effort of a job counts items in full only as long as they are few, so that large runs take an effort
// that users will wait for.
double counted(std::size_t items) {
    constexpr double kFew = 64.0;
    constexpr double kMany = 1024.0;
    const auto n = static_cast<double>(items);
    if (n <= kFew) return n;
    if (n <= kMany) return kFew + (n - kFew) / 8.0;
    return kFew + (kMany - kFew) / 8.0 + (n - kMany) / 128.0;
}

// A large job: sheets that are needed again and again are found once, the rest goes batch by batch. Its cost
// is linear in items.
class Batches {
 public:
    Batches(const NestJob& job, const NestEffort& effort) : job_(job), effort_(effort), left_(job.stock) {
        plan_.spots.resize(job.items.size());
        todo_.resize(job.items.size());
        std::iota(todo_.begin(), todo_.end(), 0);
    }

    // Lays out a sample of the items, as many of each kind as its share is, keeps all its sheets but the
    // last, as often as there are items for them, and goes on with what is left. False when there was nothing
    // to repeat.
    bool repeat() {
        if (effort_.seconds || todo_.empty()) return false;
        bool any = false;
        left_work_ = effort_.work * static_cast<double>(kSample);
        std::size_t wanted = std::min(kSample, kSampleOfKind * job_.kinds.size());
        while (const std::size_t times = repeats(wanted)) {
            left_work_ *= 0.5;
            if (repeat_sample(times)) {
                any = true;
            } else {
                wanted *= 2;
            }
        }
        return any;
    }

    // What is left, in one search if it is little.
    NestResult run() {
        std::vector<int> items;
        std::size_t next = 0;
        const std::size_t total = todo_.size();
        if (total <= kOneSearch) {
            const double work = effort_.work * counted(total);
            NestResult result = search(part(todo_), effort_of(total, total), std::min(work, left_work_));
            if (result.refusal) return refused(std::move(result), todo_);
            take(*result.plan, todo_, true);
            return {std::move(plan_), {}};
        }
        while (next < total || !items.empty()) {
            const std::size_t carried = items.size();
            while (next < total && (items.size() < carried + std::max(kBatch, carried) || shares_group(next)))
                items.push_back(nth(todo_, static_cast<int>(next++)));
            const bool is_final = next == total;
            NestEffort effort = effort_of(next, items.size());
            if (effort.seconds) {
                *effort.seconds *= static_cast<double>(items.size() - carried) / static_cast<double>(total);
            }
            const double share = static_cast<double>(items.size() - carried) / static_cast<double>(total);
            NestResult result =
                search(part(items), effort, effort_.work * counted(total) * std::min(1.0, share));
            if (result.refusal) return refused(std::move(result), items);
            items = take(*result.plan, items, is_final);
            if (is_final) break;
        }
        return {std::move(plan_), {}};
    }

 private:
    // Items that share a sheet, or one alone.
    using Lot = std::vector<int>;

    NestResult refused(NestResult result, const std::vector<int>& items) const {
        // Later on a piece may be too large for the sheets that are left only.
        if (!plan_.sheets.empty() && result.refusal->reason == NestRefusal::Reason::too_large)
            result.refusal->reason = NestRefusal::Reason::stock_used_up;
        for (int& item : result.refusal->items) item = nth(items, item);
        return result;
    }

    // Sorts what is to do into lots, those of the same kinds together. Gives how often a sample of about
    // `wanted` items is found in it, or 0.
    std::size_t repeats(std::size_t wanted) {
        std::map<int, Lot> groups;
        lots_.clear();
        for (const int item : todo_) {
            const NestItem& one = nth(job_.items, item);
            if (one.group < 0) {
                lots_[{one.kind}].push_back({item});
            } else {
                groups[one.group].push_back(item);
            }
        }
        for (auto& [group, lot] : groups) {
            std::stable_sort(lot.begin(), lot.end(),
                             [&](int a, int b) { return nth(job_.items, a).kind < nth(job_.items, b).kind; });
            std::vector<int> kinds;
            for (const int item : lot) kinds.push_back(nth(job_.items, item).kind);
            lots_[kinds].push_back(std::move(lot));
        }
        const auto sampled = [&](std::size_t times) {
            std::size_t items = 0;
            for (const auto& [kinds, lots] : lots_) items += lots.size() / times * kinds.size();
            return items;
        };
        std::size_t times = todo_.size() / wanted;
        while (times >= kOften && sampled(times) < wanted * 3 / 4) times = times * 7 / 8;
        return times >= kOften && sampled(times) <= 2 * wanted ? times : 0;
    }

    // False when a sample had one sheet only, or found none.
    bool repeat_sample(std::size_t times) {
        std::vector<int> sample;
        for (const auto& [kinds, lots] : lots_) {
            for (std::size_t i = 0; i < lots.size() / times; ++i)
                sample.insert(sample.end(), lots[i].begin(), lots[i].end());
        }
        NestEffort effort = effort_of(sample.size(), sample.size());
        effort.shortening = 0.0;
        const NestResult result =
            search(part(sample), effort, std::min(left_work_, effort_.work * counted(sample.size())));
        if (!result.plan || result.plan->sheets.size() < 2) return false;
        const NestPlan& plan = *result.plan;
        const int kept = static_cast<int>(plan.sheets.size()) - (last_is_full(plan, sample) ? 0 : 1);
        std::size_t repeated = times;
        for (int row = 0; row < static_cast<int>(left_.size()); ++row) {
            const auto used = std::count(plan.sheets.begin(), plan.sheets.begin() + kept, row);
            const int count = nth(left_, row).count;
            if (count >= 0 && used > 0) repeated = std::min(repeated, static_cast<std::size_t>(count / used));
        }
        if (repeated == 0) return false;
        keep_repeated(plan, kept, repeated, times);
        return true;
    }

    // Whether the last sheet, which has the least on it, has as much as any other.
    [[nodiscard]] bool last_is_full(const NestPlan& plan, const std::vector<int>& sample) const {
        std::vector<double> areas(plan.sheets.size(), 0.0);
        for (std::size_t i = 0; i < sample.size(); ++i)
            nth(areas, plan.spots[i].sheet) += area(nth(job_.kinds, nth(job_.items, sample[i]).kind).outline);
        return areas.back() >= *std::max_element(areas.begin(), areas.end()) * (1.0 - 1e-9);
    }

    // Puts what lies on the first `kept` sheets of the sample's plan where it lies there, and again on sheets
    // of its own for every repetition.
    void keep_repeated(const NestPlan& plan, int kept, std::size_t repeated, std::size_t times) {
        const auto base = static_cast<int>(plan_.sheets.size());
        std::vector<char> placed(job_.items.size(), 0);
        std::size_t first = 0;  // of a kind of lots, in the sample
        for (const auto& [kinds, lots] : lots_) {
            const std::size_t own = lots.size() / times;
            for (std::size_t i = 0; i < own * repeated; ++i) {
                for (std::size_t k = 0; k < kinds.size(); ++k) {
                    NestSpot spot = plan.spots[first + i % own * kinds.size() + k];
                    if (spot.sheet >= kept) continue;
                    spot.sheet += base + static_cast<int>(i / own) * kept;
                    settle(lots[i][k], spot);
                    placed[index(lots[i][k])] = 1;
                }
            }
            first += own * kinds.size();
        }
        for (std::size_t r = 0; r < repeated; ++r) keep_sheets(plan, kept);
        std::erase_if(todo_, [&](int item) { return placed[index(item)] != 0; });
    }

    void settle(int item, const NestSpot& spot) {
        nth(plan_.spots, item) = spot;
        const int kind = nth(job_.items, item).kind;
        if (nth(job_.kinds, kind).one_turn) turns_[kind] = spot.angle;
    }

    void keep_sheets(const NestPlan& plan, int kept) {
        for (int s = 0; s < kept; ++s) {
            const int row = nth(plan.sheets, s);
            plan_.sheets.push_back(row);
            plan_.used.push_back(nth(plan.used, s));
            int& count = nth(left_, row).count;
            if (count > 0) --count;
        }
    }

    // The effort of a search of `batch` items, after which `reached` of todo_ will be placed.
    [[nodiscard]] NestEffort effort_of(std::size_t reached, std::size_t batch) const {
        NestEffort effort = effort_;
        if (effort_.progress) {
            const std::size_t all = job_.items.size() - todo_.size() + reached;
            effort.progress = [this, all, batch](const NestProgress& progress) {
                tell(progress, all, batch);
            };
        }
        return effort;
    }

    [[nodiscard]] bool shares_group(std::size_t item) const {
        if (item == 0) return false;
        const int group = nth(job_.items, todo_[item]).group;
        return group >= 0 && nth(job_.items, todo_[item - 1]).group == group;
    }

    // The job of these items, with the kinds they need and the sheets that are left.
    [[nodiscard]] NestJob part(const std::vector<int>& items) const {
        NestJob job;
        job.stock = left_;
        job.spacing = job_.spacing;
        job.use_holes = job_.use_holes;
        std::map<int, int> kinds;
        for (const int number : items) {
            NestItem item = nth(job_.items, number);
            const auto [known, is_new] = kinds.emplace(item.kind, static_cast<int>(job.kinds.size()));
            if (is_new) {
                job.kinds.push_back(nth(job_.kinds, item.kind));
                const auto turn = turns_.find(item.kind);
                if (turn != turns_.end()) job.kinds.back().turns = {turn->second};
            }
            item.kind = known->second;
            job.items.push_back(item);
        }
        return job;
    }

    // Keeps all sheets but the last, whose items are carried on; of the final batch all.
    std::vector<int> take(const NestPlan& plan, const std::vector<int>& items, bool is_final) {
        const auto kept = static_cast<int>(plan.sheets.size()) - (is_final ? 0 : 1);
        const auto before = static_cast<int>(plan_.sheets.size());
        std::vector<int> carried;
        for (std::size_t i = 0; i < items.size(); ++i) {
            NestSpot spot = plan.spots[i];
            if (spot.sheet >= kept) {
                carried.push_back(items[i]);
                continue;
            }
            spot.sheet += before;
            settle(items[i], spot);
        }
        keep_sheets(plan, kept);
        return carried;
    }

    void tell(NestProgress progress, std::size_t reached, std::size_t batch) const {
        const auto total = static_cast<double>(job_.items.size());
        progress.sheets += static_cast<int>(plan_.sheets.size());
        progress.done = std::min(1.0, (static_cast<double>(reached - std::min(reached, batch)) +
                                       progress.done * static_cast<double>(batch)) /
                                          total);
        effort_.progress(progress);
    }

    const NestJob& job_;
    const NestEffort& effort_;
    std::vector<NestStock> left_;
    std::vector<int> todo_;                              // items that have no place yet
    std::map<std::vector<int>, std::vector<Lot>> lots_;  // of todo_, by the kinds of their items
    double left_work_ = HUGE_VAL;                        // units for the next search
    std::map<int, Angle> turns_;                         // of kinds that have one turn, once it is known
    NestPlan plan_;
};

}  // namespace

NestResult nest(const NestJob& job, const NestEffort& effort) {
    POPUP_INVARIANT(!job.kinds.empty() || job.items.empty());
    for (const NestKind& kind : job.kinds) POPUP_INVARIANT(!kind.turns.empty());
    // Locks name sheets by number, which what is laid out part by part does not know.
    const bool locked = std::any_of(job.items.begin(), job.items.end(),
                                    [](const NestItem& item) { return item.locked.has_value(); });
    if (!locked) {
        Batches repeated(job, effort);
        if (repeated.repeat()) {
            NestResult result = repeated.run();
            if (result.plan) return result;
        }
        if (job.items.size() > kOneSearch) return Batches(job, effort).run();
    }
    return search(job, effort, effort.work * counted(job.items.size()));
}

}  // namespace popup
