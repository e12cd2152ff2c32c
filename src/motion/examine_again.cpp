#include "motion/examine_again.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <numeric>
#include <optional>

#include "motion/approaches.h"
#include "motion/contacts.h"

namespace popup {
namespace {

using Pair = std::pair<int, int>;
using State = Recall::State;

// What crosses beyond the outermost 0.01 mm of a plate, and as much again.
constexpr double kRoundRedrawnMm = 0.02;

std::size_t index(int number) { return static_cast<std::size_t>(number); }

class Again {
 public:
    Again(const ExamineJob& job, PairSearch& search, Recall& recall)
        : job_(job),
          search_(search),
          recall_(recall),
          distance_(job.options.clearance_mm.value_or(0.0)),
          cells_(job.ends.size() - 1),
          boxes_(cells_.size()) {}

    bool run(Examination& result) {
        if (!fill(recall_.touched(), {})) return false;
        for (std::size_t i = 0; i < cells_.size(); ++i) find_boxes(i);
        for (const int plate : recall_.touched()) {
            if (recall_.plates()[index(plate)].state == State::redrawn) {
                beside_what_is_redrawn(plate);
            } else {
                near_to(plate);
            }
        }
        keep_others();
        std::sort(pairs_.begin(), pairs_.end());
        pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
        return look() && take(result);
    }

 private:
    // Fills all cells for these plates.
    bool fill(std::span<const int> plates, std::span<const Pair> pairs) {
        std::vector<int> all(plates.begin(), plates.end());
        for (const auto& [a, b] : pairs) all.insert(all.end(), {a, b});
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        const std::size_t count = all.size();
        for (std::size_t i = 0; i < count; ++i) all.push_back(job_.linkage.twin(all[i]));
        std::vector<std::size_t> joints;
        job_.linkage.joints_under(all, joints);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            if (!fill_cell(job_.assembly, job_.linkage, joints, job_.ends[i], job_.ends[i + 1], cells_[i]))
                return false;
        }
        return true;
    }

    void find_boxes(std::size_t cell) {
        const std::vector<SpaceBox>& before = recall_.kept().boxes[cell];
        std::vector<SpaceBox>& now = boxes_[cell];
        now.resize(job_.shapes.size());
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Recall::PlateNow& plate = recall_.plates()[i];
            if (plate.state == State::same) {
                now[i] = before[index(plate.before)];
            } else {
                now[i] = reach_box(cells_[cell], job_.linkage, static_cast<int>(i), job_.shapes[i].hull,
                                   distance_);
            }
        }
    }

    void want(int a, int b) { pairs_.emplace_back(std::minmax(a, b)); }

    // A plate that moves in another way is looked at with all that it comes near to.
    void near_to(int plate) {
        std::vector<char> near(job_.shapes.size(), 0);
        for (const std::vector<SpaceBox>& boxes : boxes_) {
            const SpaceBox box = boxes[index(plate)];
            for (std::size_t i = 0; i < boxes.size(); ++i) near[i] |= box.meets(boxes[i]) ? 1 : 0;
        }
        for (std::size_t i = 0; i < near.size(); ++i) {
            if (near[i] != 0 && i != index(plate)) want(plate, static_cast<int>(i));
        }
    }

    // One that has another outline, with all that comes near the part of it that is new or gone. What is
    // round a point where plates cross is looked at as far as the smaller of them reaches.
    void beside_what_is_redrawn(int plate) {
        const Box& redrawn = recall_.plates()[index(plate)].redrawn;
        if (redrawn.empty()) return;
        const std::array corners{redrawn.min, Vec2{redrawn.max.x, redrawn.min.y}, redrawn.max,
                                 Vec2{redrawn.min.x, redrawn.max.y}};
        std::vector<char> near(job_.shapes.size(), 0);
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            const SpaceBox box =
                reach_box(cells_[cell], job_.linkage, plate, corners, distance_).grown(kRoundRedrawnMm);
            for (std::size_t i = 0; i < near.size(); ++i)
                near[i] |= box.meets(boxes_[cell][i].grown(job_.shapes[i].radius)) ? 1 : 0;
        }
        for (std::size_t i = 0; i < near.size(); ++i) {
            if (near[i] != 0 && i != index(plate)) want(plate, static_cast<int>(i));
        }
    }

    // Of what is kept: pairs that are as they were keep their findings. Where the outline of a plate has
    // changed elsewhere, being clear is kept; of all that is found the numbers may be others.
    void keep_others() {
        std::sort(pairs_.begin(), pairs_.end());
        for (auto& [key, findings] : recall_.kept().pairs) {
            const int a = recall_.plate_of(static_cast<int>(key >> 32U));
            const int b = recall_.plate_of(static_cast<int>(key & 0xffffffffU));
            if (a < 0 || b < 0) continue;
            const auto redrawn = [this](int plate) {
                return recall_.plates()[index(plate)].state == State::redrawn;
            };
            // Findings name the first plate of the two first.
            if (a > b || (!findings.is_clear() && (redrawn(a) || redrawn(b)))) {
                again_.emplace_back(std::minmax(a, b));
            } else if (!std::binary_search(pairs_.begin(), pairs_.end(), Pair{a, b})) {
                others_.push_back({{a, b}, &findings});
            }
        }
        pairs_.insert(pairs_.end(), again_.begin(), again_.end());
    }

    bool look() {
        if (!fill(recall_.touched(), pairs_)) return false;
        if (job_.options.clearance_mm)
            approaches_.emplace(job_.assembly, job_.shapes, *job_.options.clearance_mm);
        found_.resize(pairs_.size());
        std::vector<std::vector<ContactRange>> stretches(pairs_.size());
        std::vector<ContactRange> found;
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            for (std::size_t i = 0; i < pairs_.size(); ++i) {
                const auto& [a, b] = pairs_[i];
                if (!boxes_[cell][index(a)].meets(boxes_[cell][index(b)])) continue;
                const std::size_t work = search_.work();
                const std::size_t looks = search_.poses();
                search_.contacts(cells_[cell], a, b, found);
                stretches[i].insert(stretches[i].end(), found.begin(), found.end());
                if (approaches_) approaches_->add(cells_[cell], a, b, search_);
                found_[i].cells |= std::uint64_t{1} << cell;
                found_[i].work += search_.work() - work;
                found_[i].looks += search_.poses() - looks;
            }
        }
        Contacts contacts;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            contacts = {};
            find_contacts(pairs_[i].first, pairs_[i].second, stretches[i], search_, contacts);
            found_[i].contacts = std::move(contacts.contacts);
            found_[i].undecided = std::move(contacts.undecided);
            all_contacts_.insert(all_contacts_.end(), found_[i].contacts.begin(), found_[i].contacts.end());
        }
        if (!approaches_) return true;
        for (const Approach& one : approaches_->take(all_contacts_, search_)) {
            const auto pair = std::lower_bound(pairs_.begin(), pairs_.end(), Pair{one.a, one.b});
            found_[static_cast<std::size_t>(pair - pairs_.begin())].approaches.push_back(one);
        }
        return true;
    }

    // Whether one that looks at everything would have come to its end.
    [[nodiscard]] bool ends_in_time() const {
        std::size_t work = 0;
        std::array<std::size_t, kMostKeptCells> pairs{};
        const auto add = [&](const PairFindings& one) {
            work += one.work;
            for (std::size_t cell = 0; cell < cells_.size(); ++cell) pairs.at(cell) += one.cells >> cell & 1U;
        };
        for (const PairFindings& one : found_) add(one);
        for (const Other& one : others_) add(*one.findings);
        return work <= job_.most.work &&
               std::all_of(pairs.begin(), pairs.end(), [&](std::size_t n) { return n <= job_.most.pairs; });
    }

    bool take(Examination& result) {
        if (!ends_in_time()) return false;
        std::unordered_map<std::uint64_t, PairFindings> all;
        all.reserve(others_.size() + pairs_.size());
        const auto add = [&](const Pair& pair, PairFindings&& one) {
            if (one.cells == 0) return;
            const auto [a, b] = pair;
            for (Contact& contact : one.contacts) {
                contact.longer = contact.longer == contact.a ? a : b;
                contact.a = a;
                contact.b = b;
            }
            for (Undecided& undecided : one.undecided) {
                undecided.a = a;
                undecided.b = b;
            }
            for (Approach& approach : one.approaches) {
                approach.a = a;
                approach.b = b;
            }
            result.pairs += std::bitset<kMostKeptCells>(one.cells).count();
            result.poses += one.looks;
            append(result, one);
            all.emplace(recall_.key(a, b), std::move(one));
        };
        if (job_.options.clearance_mm) result.approaches.emplace();
        for (const Other& one : others_) add(one.pair, std::move(*one.findings));
        recall_.share().pairs = all.size();
        for (std::size_t i = 0; i < pairs_.size(); ++i) add(pairs_[i], std::move(found_[i]));
        recall_.share().examined_pairs = all.size() - recall_.share().pairs;
        recall_.share().pairs = all.size();
        sort(result);
        recall_.kept().pairs = std::move(all);
        recall_.kept().boxes = std::move(boxes_);
        return true;
    }

    static void append(Examination& result, const PairFindings& one) {
        result.contacts.insert(result.contacts.end(), one.contacts.begin(), one.contacts.end());
        result.undecided.insert(result.undecided.end(), one.undecided.begin(), one.undecided.end());
        if (result.approaches)
            result.approaches->insert(result.approaches->end(), one.approaches.begin(), one.approaches.end());
    }

    static void sort(Examination& result) {
        const auto by_pair = [](const auto& p, const auto& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; };
        std::stable_sort(result.contacts.begin(), result.contacts.end(), by_pair);
        std::stable_sort(result.undecided.begin(), result.undecided.end(), by_pair);
        if (result.approaches)
            std::stable_sort(result.approaches->begin(), result.approaches->end(), by_pair);
    }

    struct Other {
        Pair pair;
        PairFindings* findings;
    };

    const ExamineJob& job_;
    PairSearch& search_;
    Recall& recall_;
    double distance_;
    std::vector<Cell> cells_;
    std::vector<std::vector<SpaceBox>> boxes_;  // of each cell
    std::vector<Pair> pairs_;                   // to be looked at
    std::vector<Pair> again_;
    std::vector<PairFindings> found_;  // of these
    std::vector<Other> others_;        // as they were
    std::vector<Contact> all_contacts_;
    std::optional<Approaches> approaches_;
};

}  // namespace

bool examine_again(const ExamineJob& job, PairSearch& search, Recall& recall, Examination& result) {
    return Again(job, search, recall).run(result);
}

Recorder::Recorder(Recall* recall) : recall_(recall) {
    if (recall_ == nullptr) return;
    recall_->kept().pairs.clear();
    recall_->kept().boxes.clear();
}

void Recorder::begin(const PairSearch& search) {
    work_ = search.work();
    looks_ = search.poses();
}

void Recorder::end(int a, int b, const PairSearch& search) {
    if (recall_ == nullptr) return;
    PairFindings& one = recall_->kept().pairs[recall_->key(a, b)];
    one.cells |= std::uint64_t{1} << cell_;
    one.work += search.work() - work_;
    one.looks += search.poses() - looks_;
}

void Recorder::next_cell(std::vector<SpaceBox>&& boxes) {
    if (recall_ == nullptr) return;
    recall_->kept().boxes.push_back(std::move(boxes));
    ++cell_;
}

void Recorder::take(const Examination& result) {
    if (recall_ == nullptr) return;
    auto& pairs = recall_->kept().pairs;
    const auto of = [&](const auto& one) -> PairFindings& { return pairs[recall_->key(one.a, one.b)]; };
    for (const Contact& one : result.contacts) of(one).contacts.push_back(one);
    for (const Undecided& one : result.undecided) of(one).undecided.push_back(one);
    if (result.approaches) {
        for (const Approach& one : *result.approaches) of(one).approaches.push_back(one);
    }
    recall_->share().pairs = recall_->share().examined_pairs = pairs.size();
}

}  // namespace popup
