#include "popup/nest.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/nth.h"
#include "nest/search.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

// Up to this many items are placed by one search.
constexpr std::size_t kOneSearch = 1500;
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

// A large job, batch by batch. Its cost is linear in items.
class Batches {
 public:
    Batches(const NestJob& job, const NestEffort& effort) : job_(job), effort_(effort), left_(job.stock) {
        plan_.spots.resize(job.items.size());
    }

    NestResult run() {
        std::vector<int> items;
        std::size_t next = 0;
        const std::size_t total = job_.items.size();
        while (next < total || !items.empty()) {
            const std::size_t carried = items.size();
            while (next < total && (items.size() < carried + std::max(kBatch, carried) || shares_group(next)))
                items.push_back(static_cast<int>(next++));
            const bool is_final = next == total;
            NestEffort effort = effort_;
            if (effort.seconds) {
                *effort.seconds *= static_cast<double>(items.size() - carried) / static_cast<double>(total);
            }
            if (effort_.progress) {
                effort.progress = [&](const NestProgress& progress) { tell(progress, next, items.size()); };
            }
            const double share = static_cast<double>(items.size() - carried) / static_cast<double>(total);
            NestResult result =
                search(part(items), effort, effort_.work * counted(total) * std::min(1.0, share));
            if (result.refusal) {
                // Later on a piece may be too large for the sheets that are left only.
                if (!plan_.sheets.empty() && result.refusal->reason == NestRefusal::Reason::too_large)
                    result.refusal->reason = NestRefusal::Reason::stock_used_up;
                for (int& item : result.refusal->items) item = nth(items, item);
                return result;
            }
            items = take(*result.plan, items, is_final);
            if (is_final) break;
        }
        return {std::move(plan_), {}};
    }

 private:
    [[nodiscard]] bool shares_group(std::size_t item) const {
        const int group = job_.items[item].group;
        return group >= 0 && item > 0 && job_.items[item - 1].group == group;
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
            nth(plan_.spots, items[i]) = spot;
            const int kind = nth(job_.items, items[i]).kind;
            if (nth(job_.kinds, kind).one_turn) turns_[kind] = spot.angle;
        }
        for (int s = 0; s < kept; ++s) {
            const int row = nth(plan.sheets, s);
            plan_.sheets.push_back(row);
            plan_.used.push_back(nth(plan.used, s));
            int& count = nth(left_, row).count;
            if (count > 0) --count;
        }
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
    std::map<int, Angle> turns_;  // of kinds that have one turn, once it is known
    NestPlan plan_;
};

// One that is kept on several sheets cannot be split by sheet numbers.
bool in_batches(const NestJob& job) {
    const bool locked = std::any_of(job.items.begin(), job.items.end(),
                                    [](const NestItem& item) { return item.locked.has_value(); });
    return job.items.size() > kOneSearch && !locked;
}

}  // namespace

NestResult nest(const NestJob& job, const NestEffort& effort) {
    POPUP_INVARIANT(!job.kinds.empty() || job.items.empty());
    for (const NestKind& kind : job.kinds) POPUP_INVARIANT(!kind.turns.empty());
    if (in_batches(job)) return Batches(job, effort).run();
    return search(job, effort, effort.work * counted(job.items.size()));
}

}  // namespace popup
