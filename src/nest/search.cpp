#include "nest/search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>
#include <thread>

#include "nest/bounds.h"
#include "nest/construct.h"
#include "nest/fill.h"
#include "nest/lane.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

// Searchers side by side. Their number is part of the result, so it does not depend on the machine.
constexpr int kLanes = 2;
// Shares of the effort: to fill sheets with what lies on the emptiest, to do with fewer sheets, to shorten
// the last one from many starts; the rest compresses.
constexpr double kFillShare = 0.45;
constexpr double kFewerShare = 0.6;
constexpr double kShorterShare = 0.8;
// With fewer pieces a sheet than this, on average, taking all sheets apart at once finds more than filling
// does.
constexpr std::size_t kFewOnSheet = 12;
// The share of the effort beyond which no further first layout is made.
constexpr double kBuildShare = 0.1;
// The same of a hasty search, and how many there may be.
constexpr double kHastyBuildShare = 0.3;
constexpr int kHastyOrders = 16;
// How often in a stage the lanes are compared.
constexpr double kMeetings = 24.0;
constexpr double kLeastSlice = 2e4;
// In haste, a stage ends when it has gained nothing for so much work, and for as much as it took to gain what
// it did.
constexpr double kIdle = 3e5;
// With a clock, work between two looks at it.
constexpr double kClockSlice = 1e6;
// Lines looked at for a piece of the first layout, and how the orders of the lanes differ.
constexpr int kLines = 24;
constexpr int kFewLines = 16;  // when there are many pieces
constexpr double kShake = 0.4;

class Nester {
 public:
    Nester(const NestJob& job, const NestEffort& effort, double work)
        : job_(job), effort_(effort), task_(job), start_(std::chrono::steady_clock::now()), total_(work) {}
    Nester(const Nester&) = delete;
    Nester& operator=(const Nester&) = delete;
    ~Nester() {
        for (int i = 1; i < threads_; ++i) {
            if (effort_.thread_ended) effort_.thread_ended();
        }
    }

    NestResult run() {
        if (job_.items.empty()) return {NestPlan{}, {}};
        if (auto refusal = find_refusal()) return {{}, std::move(refusal)};
        for (int i = 0; i < kLanes; ++i) {
            lanes_.push_back(std::make_unique<Lane>(task_, seed_of(i), is_hasty() ? kHasty : Pace{}));
        }
        if (auto refusal = first_layout()) return {{}, std::move(refusal)};
        fill_sheets();
        fewer_sheets();
        smaller_sheets();
        emptiest_last();
        if (is_hasty()) {
            spent_before_ = work_;
            total_ = effort_.shortening;
            shortens_hastily_ = true;
        }
        const std::vector<char> on_last = known_last(task_, best_);
        for (const auto& lane : lanes_) lane->know(best_.rows, on_last);
        stage(Aim::shorter, kShorterShare);
        stage(Aim::compress, 1.0);
        finished_ = true;
        tell();
        POPUP_INVARIANT(best_.holds(task_));
        return {plan(), {}};
    }

 private:
    using Refusal = std::optional<NestRefusal>;

    Refusal find_refusal() const {
        NestRefusal large{NestRefusal::Reason::too_large, {}};
        NestRefusal outside{NestRefusal::Reason::lock_outside, {}};
        std::vector<ExactPlace> locked;
        std::vector<int> numbers;
        for (int item = 0; item < static_cast<int>(job_.items.size()); ++item) {
            const std::vector<int>& shapes = task_.set.of_kind[index(task_.kinds[index(item)])];
            const bool fits = std::any_of(shapes.begin(), shapes.end(), [&](int shape) {
                return std::any_of(task_.largest_first.begin(), task_.largest_first.end(), [&](int row) {
                    return job_.stock[index(row)].count != 0 && task_.fits(shape, row);
                });
            });
            if (!fits) large.items.push_back(item);
            if (!job_.items[index(item)].locked) continue;
            const Stand& lock = task_.locks[index(item)];
            const bool known = lock.shape >= 0 && index(lock.sheet) < task_.locked_rows.size();
            const int row = known ? task_.locked_rows[index(lock.sheet)] : -1;
            if (row < 0 || !task_.lies_in(lock, row)) {
                outside.items.push_back(item);
                continue;
            }
            locked.push_back(exact_place(lock));
            numbers.push_back(item);
        }
        if (!large.items.empty()) return large;
        if (!outside.items.empty()) return outside;
        for (const int a : numbers) {
            for (const int b : numbers) {
                if (b >= a) break;
                const int group = task_.group_of[index(a)];
                const int kind = task_.kinds[index(a)];
                const Stand& one = task_.locks[index(a)];
                const Stand& other = task_.locks[index(b)];
                const bool torn = group >= 0 && group == task_.group_of[index(b)] && one.sheet != other.sheet;
                const bool twisted = kind == task_.kinds[index(b)] && job_.kinds[index(kind)].one_turn &&
                                     one.shape != other.shape;
                if (torn || twisted) return NestRefusal{NestRefusal::Reason::lock_apart, {b, a}};
            }
        }
        // More area than there are sheets for.
        double free = 0.0;
        for (const NestStock& row : job_.stock)
            free += row.count < 0 ? HUGE_VAL : row.count * row.width * row.height;
        double area = 0.0;
        NestRefusal used_up{NestRefusal::Reason::stock_used_up, {}};
        for (int item = 0; item < static_cast<int>(job_.items.size()); ++item) {
            area += task_.set.areas[index(task_.kinds[index(item)])];
            if (area > free * (1.0 + 1e-9)) used_up.items.push_back(item);
        }
        if (!used_up.items.empty()) return used_up;
        if (const auto pair = task_.exact.first_conflict(locked, to_grid(job_.spacing))) {
            return NestRefusal{NestRefusal::Reason::lock_overlap,
                               {numbers[index(pair->first)], numbers[index(pair->second)]}};
        }
        return std::nullopt;
    }

    [[nodiscard]] std::uint64_t seed_of(int searcher) const {
        return effort_.seed * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(searcher) + 1U;
    }

    Refusal first_layout() {
        // Several orders while that is cheap. In haste they gain more than searching does.
        const int tries = job_.items.size() > 200 ? 1 : is_hasty() ? kHastyOrders : kLanes;
        const double most = is_hasty() ? kHastyBuildShare * effort_.shortening : kBuildShare * total_;
        double built = 0.0;
        Construction best;
        for (int i = 0; i < tries; ++i) {
            if (i > 0 && (stopped() || built > most || spent() > kFewerShare)) break;
            const int lines =
                std::max(kFewLines, kLines * 100 / std::max(100, static_cast<int>(job_.items.size())));
            Construction next =
                construct(task_, lanes_[index(i % kLanes)]->dice(), lines, i == 0 ? 0.0 : kShake);
            built += next.work;
            const bool better = i == 0 || next.left_out.size() < best.left_out.size() ||
                                (next.left_out.size() == best.left_out.size() && !next.hopeless &&
                                 (best.hopeless || next.arrangement.better_than(best.arrangement, task_)));
            if (better) best = std::move(next);
            if (better && is_hasty() && best.left_out.empty() && is_good_enough(best.arrangement)) break;
        }
        best_ = std::move(best.arrangement);
        if (best.left_out.empty()) return std::nullopt;
        if (!best.hopeless) {
            const int first = best.left_out.front();
            best.left_out = fill_in(std::move(best.left_out));
            best.alone = best.alone && std::count(best.left_out.begin(), best.left_out.end(), first) > 0;
            if (best.left_out.empty()) return std::nullopt;
            for (const auto& lane : lanes_) lane->begin(best_, Aim::fit);
            if (go_on(Aim::fit, kFewerShare)) return std::nullopt;
        }
        std::sort(best.left_out.begin(), best.left_out.end());
        return NestRefusal{
            best.alone ? NestRefusal::Reason::group_too_large : NestRefusal::Reason::stock_used_up,
            std::move(best.left_out)};
    }

    // Whether a hasty search has nothing to gain from this layout.
    [[nodiscard]] bool is_good_enough(const Arrangement& layout) {
        const double least = least_length(task_, layout.rows, known_last(task_, layout));
        const double length = layout.length(task_, static_cast<int>(layout.rows.size()) - 1);
        return length <= least * (1.0 + kHasty.content) + 1.0 && !could_be_fewer(task_, layout);
    }

    // Whether filling finds more than taking all sheets apart at once.
    [[nodiscard]] bool fills() const { return job_.items.size() >= kFewOnSheet * best_.rows.size(); }

    void begin_filling() {
        for (int i = 0; i < kLanes; ++i) fillers_.push_back(std::make_unique<Filler>(task_, ~seed_of(i)));
    }
    void end_filling() {
        for (const auto& filler : fillers_) filled_work_ += filler->work();
        fillers_.clear();
    }

    // Moves what lies on the emptiest sheet to the others, and then what lies on the next.
    void fill_sheets() {
        if (!fills()) return;
        begin_filling();
        bool gone = true;
        while (gone && could_be_fewer(task_, best_) && spent() < kFillShare && !stopped()) {
            const std::vector<int> victims = emptiest_sheets(task_, best_);
            if (victims.empty()) break;
            const int victim = victims.front();
            const Arrangement before = best_;
            fill_from(victim, true);
            gone = items_on(victim).empty();
            gone ? drop(victim) : lay_out_anew(victim);
            // What came to the victim in exchange may find no place on it. With locks the sheets keep their
            // order, and the last may have become longer.
            const bool longer = !gone && task_.has_locks() && before.better_than(best_, task_);
            if (longer || !best_.holds(task_)) {
                best_ = before;
                gone = false;
            }
        }
        end_filling();
    }

    // Moves what found no place onto the sheets that there are. Returns what is left, which lies over others.
    std::vector<int> fill_in(std::vector<int> left_out) {
        // What must lie beside a locked piece of its group has one sheet to go to.
        const bool bound = std::any_of(left_out.begin(), left_out.end(), [this](int item) {
            const int group = nth(task_.group_of, item);
            if (group < 0) return false;
            const std::vector<int>& items = nth(task_.groups, group);
            return std::any_of(items.begin(), items.end(), [this](int one) { return task_.is_locked(one); });
        });
        if (bound || !fills()) return left_out;
        const Arrangement before = best_;
        std::vector<int> all = left_out;
        const auto spare = static_cast<int>(best_.rows.size());
        best_.rows.push_back(task_.largest_first.front());
        for (const int item : left_out) nth(best_.stands, item).sheet = spare;
        begin_filling();
        fill_from(spare, false);
        end_filling();
        left_out = items_on(spare);
        for (const int item : left_out) nth(best_.stands, item) = nth(before.stands, item);
        best_.rows.pop_back();
        if (left_out.empty() && !best_.holds(task_)) {
            best_ = before;
            return all;
        }
        // A group that found no place had perhaps been given a sheet of its own.
        for (auto empty = emptiest_sheets(task_, best_); !empty.empty() && items_on(empty.front()).empty();
             empty = emptiest_sheets(task_, best_)) {
            drop(empty.front());
        }
        return left_out;
    }

    [[nodiscard]] std::vector<int> items_on(int sheet) const {
        std::vector<int> items;
        for (int item = 0; item < static_cast<int>(best_.stands.size()); ++item) {
            if (nth(best_.stands, item).sheet == sheet) items.push_back(item);
        }
        return items;
    }

    void drop(int sheet) {
        best_.rows.erase(best_.rows.begin() + sheet);
        for (Stand& stand : best_.stands) {
            if (stand.sheet > sheet) --stand.sheet;
        }
    }

    // Fills the other sheets with what lies on the victim. What comes to the victim in exchange has no place
    // on it yet. `tells`: whether to tell of progress, which needs a layout.
    void fill_from(int victim, bool tells) {
        const double slice = slice_until(kFillShare);
        const auto goes_on = [&] { return spent() < kFillShare && !stopped(); };
        bool moved = true;
        while (moved && goes_on()) {
            const auto lots = static_cast<int>(lots_on(task_, best_, victim).size());
            const int parts = std::min({kLanes, lots, static_cast<int>(best_.rows.size()) - 1});
            for (int i = 0; i < parts; ++i) nth(fillers_, i)->begin(best_, victim, i, parts);
            const auto count = [&](const auto& is) {
                return std::count_if(fillers_.begin(), fillers_.begin() + parts,
                                     [&](const auto& filler) { return is(*filler); });
            };
            const auto done = [&] { return count([](const Filler& filler) { return filler.done(); }); };
            const auto some_moved = [&] {
                return count([](const Filler& filler) { return filler.moved(); }) > 0;
            };
            // When one has nothing more to do and something has moved, what is left is shared out again.
            while (done() < parts && !(done() > 0 && some_moved()) && goes_on()) {
                side_by_side(slice, parts, [&](int i) { nth(fillers_, i)->run(slice); });
                if (tells) tell();
            }
            moved = parts > 0 && some_moved();
            for (int i = 0; i < parts; ++i) nth(fillers_, i)->put_into(best_);
        }
    }

    // Lays out a sheet anew if it becomes shorter by that, or is no layout as it is.
    void lay_out_anew(int sheet) {
        Arrangement again = best_;
        if (!lay_out(again, sheet, nth(again.rows, sheet), items_on(sheet))) return;
        if (again.length(task_, sheet) < best_.length(task_, sheet) || !best_.holds(task_))
            best_ = std::move(again);
    }

    void fewer_sheets() {
        while (could_be_fewer(task_, best_) && spent() < kFewerShare && !stopped()) {
            for (const auto& lane : lanes_) lane->begin(best_, Aim::fewer);
            const std::size_t before = best_.rows.size();
            go_on(Aim::fewer, kFewerShare);
            if (best_.rows.size() == before) return;
        }
    }

    // A smaller sheet of the stock, where it takes all pieces of a sheet too.
    void smaller_sheets() {
        if (task_.rooms.size() < 2) return;
        for (int sheet = static_cast<int>(best_.rows.size()) - 1; sheet >= 0; --sheet) {
            const std::vector<int> items = items_on(sheet);
            const bool locked =
                std::any_of(items.begin(), items.end(), [this](int item) { return task_.is_locked(item); });
            if (locked) continue;
            const auto size = [&](int row) {
                return task_.rooms[index(row)].width * task_.rooms[index(row)].height;
            };
            for (auto row = task_.largest_first.rbegin(); row != task_.largest_first.rend(); ++row) {
                if (size(*row) >= size(best_.rows[index(sheet)])) break;
                const auto taken = std::count(best_.rows.begin(), best_.rows.end(), *row);
                const int count = job_.stock[index(*row)].count;
                if (count >= 0 && taken >= count) continue;
                if (lay_out(best_, sheet, *row, items)) break;
            }
        }
    }

    // Lays out these items, which are all that lie on a sheet, anew on one of this row of the stock. False
    // when it finds no place for one; then nothing has changed.
    bool lay_out(Arrangement& layout, int sheet, int row, std::vector<int> items) {
        std::stable_sort(items.begin(), items.end(), [&](int a, int b) {
            return task_.set.areas[index(task_.kinds[index(a)])] >
                   task_.set.areas[index(task_.kinds[index(b)])];
        });
        Board board(task_.set, task_.loose, task_.kinds, {task_.rooms[index(row)]});
        std::vector<int> turns(task_.set.of_kind.size(), -1);
        for (std::size_t i = 0; i < layout.stands.size(); ++i) {
            if (job_.kinds[index(task_.kinds[i])].one_turn)
                turns[index(task_.kinds[i])] = layout.stands[i].shape;
        }
        if (!place_on(task_, board, 0, items, lanes_[0]->dice(), kLines, turns)) return false;
        for (const int item : items) {
            layout.stands[index(item)] = board.at(item);
            layout.stands[index(item)].sheet = sheet;
        }
        layout.rows[index(sheet)] = row;
        return true;
    }

    // The sheet with the least on it becomes the last. Locks name sheets by number: then they stay.
    void emptiest_last() {
        if (task_.has_locks()) return;
        const int least = emptiest_sheets(task_, best_).front();
        const int last = static_cast<int>(best_.rows.size()) - 1;
        std::swap(best_.rows[index(least)], best_.rows.back());
        for (Stand& stand : best_.stands) {
            if (stand.sheet == least) {
                stand.sheet = last;
            } else if (stand.sheet == last) {
                stand.sheet = least;
            }
        }
    }

    void stage(Aim aim, double until) {
        if (stopped()) return;
        for (const auto& lane : lanes_) lane->begin(best_, aim);
        go_on(aim, until);
    }

    // Runs the lanes until one has found what it is after or the share of the effort is spent. True when it
    // was found.
    bool go_on(Aim aim, double until) {
        const double slice = slice_until(until);
        const double begun = work_;
        double gained = work_;
        while (!stopped() && spent() < until) {
            if (shortens_hastily_ && work_ - gained > std::max(kIdle, gained - begun)) break;
            const double before = last_length();
            side_by_side(slice, kLanes, [&](int i) { nth(lanes_, i)->run(slice); });
            const bool found = compare(aim);
            if (last_length() < before) gained = work_;
            tell();
            if (found && (aim == Aim::fit || aim == Aim::fewer)) return true;
            // The shortest there can be.
            const auto shortest = [&](const auto& lane) {
                return lane->done() && !best_.better_than(lane->best(), task_);
            };
            if (found && std::any_of(lanes_.begin(), lanes_.end(), shortest)) {
                finished_ = true;
                return true;
            }
            // Under `shorter` each goes its own way, as long as none does with fewer sheets: two searches
            // find more than one that is twice as long.
            for (const auto& lane : lanes_) {
                const bool behind = lane->best().rows.size() > best_.rows.size();
                if (aim == Aim::compress || (aim == Aim::shorter && behind)) lane->begin(best_, aim);
            }
        }
        return false;
    }

    [[nodiscard]] double last_length() const {
        return best_.length(task_, static_cast<int>(best_.rows.size()) - 1);
    }

    // Takes the best layout of the lanes, if it is proved. True when one of them is done.
    bool compare(Aim aim) {
        bool found = false;
        for (const auto& lane : lanes_) {
            if ((aim == Aim::fit || aim == Aim::fewer) && !lane->done()) continue;
            const Arrangement& theirs = lane->best();
            if (aim == Aim::fit ? !found : theirs.better_than(best_, task_)) {
                if (!theirs.holds(task_)) {
                    lane->forget();
                    lane->begin(best_, aim);
                    continue;
                }
                best_ = theirs;
            }
            found = found || lane->done();
        }
        return found;
    }

    [[nodiscard]] double slice_until(double until) const {
        if (effort_.seconds) return kClockSlice;
        return std::max(kLeastSlice, (until - spent()) * total_ / (kLanes * kMeetings));
    }

    // Runs the work of so many searchers, each of a slice, on the threads that may be used, and counts it.
    template <typename Work>
    void side_by_side(double slice, int searchers, const Work& run) {
        const int threads = slice < kLeastSlice * 2.0 ? 1 : std::min(searchers, allowed_threads());
        const auto work = [&](int first) {
            for (int i = first; i < searchers; i += threads) run(i);
        };
        {
            std::vector<std::jthread> others;
            int begun = 1;
            try {
                for (; begun < threads; ++begun) others.emplace_back(work, begun);
            } catch (const std::system_error&) {
                // The system gives no more threads; this one does their work.
                for (int i = begun; i < threads; ++i) work(i);
            }
            work(0);
        }
        work_ = filled_work_;
        for (const auto& lane : lanes_) work_ += lane->work();
        for (const auto& filler : fillers_) work_ += filler->work();
    }

    // Asks for threads when there is something for them to do, and keeps those it got.
    int allowed_threads() {
        if (threads_ > 0) return threads_;
        threads_ = 1;
        while (threads_ < std::min(kLanes, effort_.threads) &&
               (!effort_.may_start_thread || effort_.may_start_thread())) {
            ++threads_;
        }
        return threads_;
    }

    // Whether little is to be spent on a shorter last sheet.
    [[nodiscard]] bool is_hasty() const {
        return shortens_hastily_ || (!effort_.seconds && effort_.shortening < total_);
    }

    [[nodiscard]] double spent() const {
        if (finished_) return 1.0;
        if (!effort_.seconds) return total_ > 0.0 ? (work_ - spent_before_) / total_ : 1.0;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
        return passed.count() / std::fmax(1e-9, *effort_.seconds);
    }

    [[nodiscard]] bool stopped() const { return effort_.stop != nullptr && effort_.stop->load(); }

    void tell() const {
        if (!effort_.progress) return;
        NestProgress progress;
        progress.sheets = static_cast<int>(best_.rows.size());
        const double length = best_.length(task_, progress.sheets - 1);
        progress.last_length = length / kGridSteps;
        double room = 0.0;
        for (std::size_t s = 0; s < best_.rows.size(); ++s) {
            const Room& size = task_.rooms[index(best_.rows[s])];
            room += (s + 1 == best_.rows.size() ? length : size.width) * size.height;
        }
        double area = 0.0;
        for (const int kind : task_.kinds) area += task_.set.areas[index(kind)];
        progress.utilisation = room > 0.0 ? area * kGridSteps * kGridSteps / room : 0.0;
        const double done = std::min(1.0, spent());
        progress.done = shortens_hastily_ ? kFewerShare + (1.0 - kFewerShare) * done : done;
        effort_.progress(progress);
    }

    [[nodiscard]] NestPlan plan() const {
        NestPlan plan;
        plan.sheets = best_.rows;
        plan.used.resize(best_.rows.size());
        for (const Stand& stand : best_.stands) {
            const TurnedShape& shape = task_.set.shapes[index(stand.shape)];
            const auto x = static_cast<GridLength>(stand.x);
            const auto y = static_cast<GridLength>(stand.y);
            plan.spots.push_back({stand.sheet, {from_grid(x), from_grid(y)}, shape.angle});
            Vec2& used = plan.used[index(stand.sheet)];
            used.x = std::max(used.x, from_grid(x + shape.bounds.x1));
            used.y = std::max(used.y, from_grid(y + shape.bounds.y1));
        }
        return plan;
    }

    const NestJob& job_;
    const NestEffort& effort_;
    NestTask task_;
    std::chrono::steady_clock::time_point start_;
    double total_;
    double work_ = 0.0;
    double filled_work_ = 0.0;       // of work_, what fillers took that are gone
    double spent_before_ = 0.0;      // of work_, what total_ does not count
    bool shortens_hastily_ = false;  // total_ is what a hasty search for a shorter sheet has
    bool finished_ = false;
    int threads_ = 0;  // that may be used, this one among them; 0: nobody has been asked
    std::vector<std::unique_ptr<Lane>> lanes_;
    std::vector<std::unique_ptr<Filler>> fillers_;
    Arrangement best_;
};

}  // namespace

NestResult search(const NestJob& job, const NestEffort& effort, double work) {
    return Nester(job, effort, work).run();
}

}  // namespace popup
