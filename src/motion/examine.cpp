// Every pair of plates, over the whole opening.
#include "motion/examine.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "motion/approaches.h"
#include "motion/cells.h"
#include "motion/closed_card.h"
#include "motion/contacts.h"
#include "motion/examine_again.h"
#include "motion/parallels.h"
#include "motion/sweep.h"
#include "motion/through_folds.h"

namespace popup {
namespace {

// How much of the search may be used up, and as much again for each plate: in turns of linkages looked at.
// Every plate of a high tower may be anywhere, as far as bounds can tell.
constexpr std::size_t kMostWork = 20'000'000;
constexpr std::size_t kMostWorkPerPlate = 2'000;
constexpr std::size_t kMostPairsPerPlate = 500;
// Cells with more pairs than this a plate are halved, as long as that leaves this share of them or less.
constexpr double kManyPairsPerPlate = 16.0;
constexpr double kHalvedHelps = 0.75;
constexpr double kLeastCellDeg = 0.1;

struct PairRange {
    int a, b;
    ContactRange stretch;
};

// The first certain contact ends the examination, and nothing is decided from there on. Pairs that are set
// aside are not looked at, nor is what has been seen before.
struct FirstContact {
    const PlatePairs* aside = nullptr;
    SeenPairs* seen = nullptr;
    bool found = false;

    [[nodiscard]] bool passes_over(int a, int b) const { return aside != nullptr && aside->contains({a, b}); }

    void contacts(PairSearch& search, const Cell& cell, int a, int b, std::vector<ContactRange>& ranges) {
        SeenPairs::Way* const way = seen != nullptr ? &seen->of(a, b) : nullptr;
        if (way == nullptr || !way->knows(cell.from, cell.to, ranges)) {
            search.contacts(cell, a, b, ranges);
            if (way != nullptr) way->keep(cell.from, cell.to, ranges);
        }
        found = found || std::any_of(ranges.begin(), ranges.end(), is_certain);
    }
};

// As find_contacts() for all pairs of which there are stretches. `first`: null, or what has seen some before.
Contacts all_contacts(std::vector<PairRange>& all, PairSearch& search, FirstContact* first) {
    std::stable_sort(all.begin(), all.end(), [](const PairRange& p, const PairRange& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    });
    Contacts contacts;
    std::vector<ContactRange> found;
    for (std::size_t i = 0; i < all.size();) {
        found.clear();
        std::size_t end = i;
        for (; end < all.size() && all[end].a == all[i].a && all[end].b == all[i].b; ++end) {
            found.push_back(all[end].stretch);
        }
        SeenPairs::Way* const way =
            first != nullptr && first->seen != nullptr ? &first->seen->of(all[i].a, all[i].b) : nullptr;
        if (way == nullptr) {
            find_contacts(all[i].a, all[i].b, found, search, contacts);
        } else {
            if (!way->contacts || way->stretches != found) {
                way->contacts.emplace();
                way->stretches = found;
                find_contacts(all[i].a, all[i].b, found, search, *way->contacts);
            }
            const Contacts& more = *way->contacts;
            contacts.contacts.insert(contacts.contacts.end(), more.contacts.begin(), more.contacts.end());
            contacts.undecided.insert(contacts.undecided.end(), more.undecided.begin(), more.undecided.end());
        }
        i = end;
    }
    return contacts;
}

// As examine() of the header. `first`: ends with a first contact; null: all contacts are found.
Examination look_through(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes,
                         const MotionOptions& options, Recall* recall, FirstContact* first) {
    const std::size_t most_work = kMostWork + kMostWorkPerPlate * shapes.size();
    const std::size_t most_pairs = kMostPairsPerPlate * shapes.size();
    const std::vector<double> ends = cell_ends(assembly.sweep, linkage.range_ends());
    Examination result;
    result.undecided_below_deg = least_opening(assembly.sweep);
    result.decided_up_to_deg = assembly.sweep.to_deg;
    if (recall != nullptr && (!recall->can_keep() || ends.size() > kMostKeptCells)) recall->drop();
    const bool keeps = recall != nullptr && recall->keeps();
    const auto close = [&] {
        if (!assembly.covers.empty() && assembly.sweep.closed_flat)
            result.closed = closed_card(assembly, shapes, options.paper_mm, keeps ? recall : nullptr);
    };
    PairSearch search(assembly, linkage, shapes);
    if (keeps && recall->helps() &&
        examine_again({assembly, linkage, shapes, options, ends, {most_work, most_pairs}}, search, *recall,
                      result)) {
        close();
        return result;
    }
    Parallels parallels(assembly, shapes);
    std::optional<Approaches> approaches;
    if (options.clearance_mm) approaches.emplace(assembly, shapes, *options.clearance_mm);

    std::vector<PairRange> all;
    std::vector<ContactRange> found;
    Cell cell;
    Recorder recorder(keeps ? recall : nullptr);
    const double distance = options.clearance_mm.value_or(0.0);
    const auto look_at = [&](const Cell& range, std::span<const std::pair<int, int>> pairs) {
        if (pairs.size() > most_pairs) return false;
        for (const auto& [a, b] : pairs) {
            if (search.work() > most_work) return false;
            if (first != nullptr && first->passes_over(a, b)) continue;
            ++result.pairs;
            recorder.begin(search);
            if (!parallels.keep_apart(a, b)) {
                if (first != nullptr) {
                    first->contacts(search, range, a, b, found);
                    if (first->found) return false;
                } else {
                    search.contacts(range, a, b, found);
                }
                for (const ContactRange& one : found) all.push_back({a, b, one});
            }
            if (approaches) approaches->add(range, a, b, search);
            recorder.end(a, b, search);
        }
        return true;
    };
    // Where plates move by laws, half a cell has far fewer pairs as long as bounds are what makes them many.
    const double most_split = linkage.is_lawful() ? kManyPairsPerPlate * static_cast<double>(shapes.size())
                                                  : std::numeric_limits<double>::infinity();
    const auto look_between = [&](double from, double to) {
        struct Part {
            double from, to, most;  // pairs up to which it is not halved
        };
        std::vector<Part> parts{{from, to, most_split}};
        while (!parts.empty()) {
            const Part part = parts.back();
            parts.pop_back();
            if (!fill_cell(assembly, linkage, part.from, part.to, cell)) return false;
            std::vector<SpaceBox> boxes = reach_boxes(cell, linkage, shapes, distance);
            const auto pairs = near_pairs(boxes, most_pairs);
            const auto count = static_cast<double>(pairs.size());
            if (count > part.most && part.to - part.from > kLeastCellDeg) {
                const double middle = 0.5 * (part.from + part.to);
                const double most = std::max(most_split, kHalvedHelps * count);
                parts.push_back({middle, part.to, most});
                parts.push_back({part.from, middle, most});
                continue;
            }
            if (!look_at(cell, pairs)) return false;
            recorder.next_cell(std::move(boxes));
        }
        return true;
    };
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (look_between(ends[i], ends[i + 1])) continue;
        result.decided_up_to_deg = cell.from;
        if (recall != nullptr) recall->drop();
        break;
    }
    result.poses = search.poses();
    if (first != nullptr && first->found) return result;
    Contacts contacts = all_contacts(all, search, first);
    result.contacts = std::move(contacts.contacts);
    result.undecided = std::move(contacts.undecided);
    if (approaches) result.approaches = approaches->take(result.contacts, search);
    recorder.take(result);
    close();
    result.poses = search.poses();
    return result;
}

// Pairs that cross anyhow are told of as such.
void add_at_folds(const std::vector<Contact>& more, std::vector<Contact>& contacts) {
    const auto pair = [](const Contact& one) { return std::pair(one.a, one.b); };
    std::vector<Contact> all = contacts;
    for (const Contact& one : more) {
        const auto known =
            std::lower_bound(contacts.begin(), contacts.end(), one,
                             [&](const Contact& p, const Contact& q) { return pair(p) < pair(q); });
        if (known == contacts.end() || pair(*known) != pair(one)) all.push_back(one);
    }
    std::sort(all.begin(), all.end(), [](const Contact& p, const Contact& q) {
        return std::tuple(p.a, p.b, p.from_deg) < std::tuple(q.a, q.b, q.from_deg);
    });
    contacts = std::move(all);
}

}  // namespace

std::vector<PlateShape> plate_shapes(const Assembly& assembly, const MotionOptions& options) {
    std::vector<PlateShape> shapes;
    shapes.reserve(assembly.plates.size());
    for (const Plate& plate : assembly.plates)
        shapes.push_back(plate_shape(plate, options.clearance_mm.has_value()));
    return shapes;
}

Examination examine(const Assembly& assembly, const MotionOptions& options) {
    Linkage linkage(assembly);
    return examine(assembly, linkage, plate_shapes(assembly, options), options);
}

Examination examine(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes,
                    const MotionOptions& options, Recall* recall) {
    Examination found = look_through(assembly, linkage, shapes, options, recall, nullptr);
    add_at_folds(find_through_folds(assembly, shapes), found.contacts);
    return found;
}

Examination examine_until_crossed(const Assembly& assembly, Linkage& linkage,
                                  std::span<const PlateShape> shapes, const MotionOptions& options,
                                  bool* crossed) {
    FirstContact first;
    Examination found = look_through(assembly, linkage, shapes, options, nullptr, &first);
    *crossed = first.found;
    if (!first.found) add_at_folds(find_through_folds(assembly, shapes), found.contacts);
    return found;
}

bool is_clear(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes,
              const MotionOptions& options, const PlatePairs& aside, SeenPairs& seen, std::size_t& poses) {
    if (seen.any_crosses(aside)) return false;
    FirstContact first{&aside, &seen};
    const Examination found = look_through(assembly, linkage, shapes, options, nullptr, &first);
    poses += found.poses;
    if (!found.undecided.empty() || found.decided_up_to_deg < assembly.sweep.to_deg ||
        !found.contacts.empty())
        return false;
    const std::vector<Contact> at_folds = find_through_folds(assembly, shapes);
    return std::all_of(at_folds.begin(), at_folds.end(), [&aside](const Contact& one) {
        return aside.contains({one.a, one.b});
    });
}

}  // namespace popup
