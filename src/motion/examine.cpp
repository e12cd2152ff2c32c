// Every pair of plates, over the whole opening.
#include "motion/examine.h"

#include <algorithm>
#include <limits>
#include <map>

#include "motion/cells.h"
#include "motion/closed_card.h"
#include "motion/contacts.h"
#include "motion/parallels.h"
#include "motion/sweep.h"

namespace popup {
namespace {

// Plates that touch at all telling angles are joined: they share a fold, a seam, an apex.
constexpr double kJoinedMm = 1e-6;
constexpr double kFlushMm = 1e-3;
// What is near until the card is closed (or lies flat) is so because it folds, below this angle.
constexpr double kFoldingDeg = 45.0;
// How much of the search may be used up, and as much again for each plate: in turns of linkages looked at.
// Every plate of a high tower may be anywhere, as far as bounds can tell.
constexpr std::size_t kMostWork = 20'000'000;
constexpr std::size_t kMostWorkPerPlate = 2'000;
constexpr std::size_t kMostPairsPerPlate = 500;
// Cells with more pairs than this a plate are halved, as long as that leaves this share of them or less.
constexpr double kManyPairsPerPlate = 16.0;
constexpr double kHalvedHelps = 0.75;
constexpr double kLeastCellDeg = 0.1;
constexpr double kLeastDeg = 1e-4;  // to which the angle of the smallest distance is found
constexpr int kLooks = 64;          // where a smallest distance is looked for, before halving

struct PairRange {
    int a, b;
    ContactRange stretch;
};

// The nearest approaches of one pair, from its stretches in all cells.
class Approaches {
 public:
    Approaches(const Assembly& assembly, std::span<const PlateShape> shapes, double distance_mm)
        : sweep_(assembly.sweep), shapes_(shapes), distance_mm_(distance_mm), open_(assembly.plates.size()) {
        for (const double deg : kTellingDegs) {
            frames_.emplace_back(assembly.plates.size());
            reached_ = reached_ && place(assembly, Angle::degrees(opening_at(sweep_, deg)), frames_.back());
        }
        reached_ = reached_ && place(assembly, Angle::degrees(sweep_.to_deg), open_);
    }

    void add(const Cell& cell, int a, int b, PairSearch& search) {
        if (!reached_ || joined(a, b)) return;
        search.approaches(cell, a, b, distance_mm_, stretches_);
        std::vector<Approach>& of_pair = found_[{a, b}];
        for (const ContactRange& one : stretches_) {
            if (!of_pair.empty() && of_pair.back().to_deg == one.from) {
                of_pair.back().to_deg = one.to;
            } else {
                of_pair.push_back({a, b, one.from, one.to, distance_mm_, one.from, {}});
            }
        }
    }

    // All but what flat folding brings about, and those that end in a contact.
    [[nodiscard]] std::vector<Approach> take(const std::vector<Contact>& contacts, PairSearch& search) const {
        std::vector<Approach> result;
        for (const auto& [pair, all] : found_) {
            for (Approach one : all) {
                if (sweep_.closed_flat && one.from_deg <= least_opening(sweep_)) {
                    one.from_deg = sweep_.from_deg + kFoldingDeg;
                }
                if (one.to_deg >= sweep_.to_deg && in_one_plane_when_open(one)) {
                    one.to_deg = sweep_.to_deg - kFoldingDeg;
                }
                if (one.from_deg >= one.to_deg) continue;
                const bool crosses =
                    std::any_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
                        return contact.a == one.a && contact.b == one.b && contact.from_deg <= one.to_deg &&
                               contact.to_deg >= one.from_deg;
                    });
                if (crosses) continue;
                find_least(one, search);
                for (double* deg : {&one.from_deg, &one.to_deg, &one.least_deg}) {
                    *deg = std::round(*deg * 1000.0) / 1000.0;
                }
                result.push_back(one);
            }
        }
        return result;
    }

 private:
    bool joined(int a, int b) {
        const auto known = joined_.find({a, b});
        if (known != joined_.end()) return known->second;
        const auto touch = [&](const std::vector<Frame>& frames) {
            PairPose pose;
            pose.a = &shapes_[static_cast<std::size_t>(a)];
            pose.b = &shapes_[static_cast<std::size_t>(b)];
            pose.b_in_a = relative(frames[static_cast<std::size_t>(a)], frames[static_cast<std::size_t>(b)]);
            // Plates that lie flat on each other touch as well, and not only with their edges.
            return nearness_(pose, kJoinedMm, true).nearness != Nearness::clear &&
                   nearness_(pose, kFlushMm, false).nearness == Nearness::clear;
        };
        return joined_[{a, b}] = std::all_of(frames_.begin(), frames_.end(), touch);
    }

    void find_least(Approach& one, PairSearch& search) const {
        const auto look = [&](double deg) {
            const auto there = search.distance(one.a, one.b, deg, distance_mm_);
            if (there.mm >= one.least_mm) return;
            one.least_mm = there.mm;
            one.least_deg = deg;
            one.point = there.point;
        };
        double step = (one.to_deg - one.from_deg) / kLooks;
        for (int i = 0; i <= kLooks; ++i) look(one.from_deg + i * step);
        while (step > kLeastDeg) {
            step *= 0.5;
            const double centre = one.least_deg;
            look(std::max(centre - step, one.from_deg));
            look(std::min(centre + step, one.to_deg));
        }
    }

    [[nodiscard]] bool in_one_plane_when_open(const Approach& one) const {
        const Frame& a = open_[static_cast<std::size_t>(one.a)];
        const Frame& b = open_[static_cast<std::size_t>(one.b)];
        return length(cross(a.normal(), b.normal())) < 1e-6 &&
               std::abs(dot(b.origin - a.origin, a.normal())) < 1e-3;
    }

    Sweep sweep_;
    std::span<const PlateShape> shapes_;
    double distance_mm_;
    std::vector<std::vector<Frame>> frames_;
    std::vector<Frame> open_;
    bool reached_ = true;  // all those angles
    NearnessTest nearness_;
    std::vector<ContactRange> stretches_;
    std::map<std::pair<int, int>, bool> joined_;
    std::map<std::pair<int, int>, std::vector<Approach>> found_;
};

}  // namespace

std::vector<PlateShape> plate_shapes(const Assembly& assembly) {
    std::vector<PlateShape> shapes;
    shapes.reserve(assembly.plates.size());
    for (const Plate& plate : assembly.plates) shapes.push_back(plate_shape(plate));
    return shapes;
}

Examination examine(const Assembly& assembly, const MotionOptions& options) {
    Linkage linkage(assembly);
    return examine(assembly, linkage, plate_shapes(assembly), options);
}

Examination examine(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes,
                    const MotionOptions& options) {
    Examination result;
    result.undecided_below_deg = least_opening(assembly.sweep);
    result.decided_up_to_deg = assembly.sweep.to_deg;
    PairSearch search(assembly, linkage, shapes);
    Parallels parallels(assembly, shapes);
    std::optional<Approaches> approaches;
    if (options.clearance_mm) approaches.emplace(assembly, shapes, *options.clearance_mm);

    std::vector<PairRange> all;
    std::vector<ContactRange> found;
    Cell cell;
    const std::vector<double> ends = cell_ends(assembly.sweep, linkage.range_ends());
    const std::size_t most_work = kMostWork + kMostWorkPerPlate * shapes.size();
    const std::size_t most_pairs = kMostPairsPerPlate * shapes.size();
    const double distance = options.clearance_mm.value_or(0.0);
    const auto look_at = [&](const Cell& range, std::span<const std::pair<int, int>> pairs) {
        if (pairs.size() > most_pairs) return false;
        for (const auto& [a, b] : pairs) {
            if (search.work() > most_work) return false;
            ++result.pairs;
            if (!parallels.keep_apart(a, b)) {
                search.contacts(range, a, b, found);
                for (const ContactRange& one : found) all.push_back({a, b, one});
            }
            if (approaches) approaches->add(range, a, b, search);
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
            const auto pairs = near_pairs(cell, linkage, shapes, distance, most_pairs);
            const auto count = static_cast<double>(pairs.size());
            if (count > part.most && part.to - part.from > kLeastCellDeg) {
                const double middle = 0.5 * (part.from + part.to);
                const double most = std::max(most_split, kHalvedHelps * count);
                parts.push_back({middle, part.to, most});
                parts.push_back({part.from, middle, most});
            } else if (!look_at(cell, pairs)) {
                return false;
            }
        }
        return true;
    };
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (look_between(ends[i], ends[i + 1])) continue;
        result.decided_up_to_deg = cell.from;
        break;
    }
    std::stable_sort(all.begin(), all.end(), [](const PairRange& p, const PairRange& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    });
    Contacts contacts;
    for (std::size_t i = 0; i < all.size();) {
        found.clear();
        std::size_t end = i;
        for (; end < all.size() && all[end].a == all[i].a && all[end].b == all[i].b; ++end) {
            found.push_back(all[end].stretch);
        }
        find_contacts(all[i].a, all[i].b, found, search, contacts);
        i = end;
    }
    result.contacts = std::move(contacts.contacts);
    result.undecided = std::move(contacts.undecided);
    if (approaches) result.approaches = approaches->take(result.contacts, search);
    if (!assembly.covers.empty() && assembly.sweep.closed_flat) {
        result.closed = closed_card(assembly, shapes, options.paper_mm);
    }
    result.poses = search.poses();
    return result;
}

}  // namespace popup
