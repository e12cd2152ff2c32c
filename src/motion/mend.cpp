#include "motion/mend.h"

#include <algorithm>
#include <cmath>

#include "motion/cells.h"
#include "motion/closed_card.h"
#include "motion/contacts.h"
#include "motion/joints/joint.h"
#include "motion/lying.h"

namespace popup {
namespace {

constexpr double kFirstMm = 0.5;
constexpr double kFurthestMm = 100.0;
constexpr double kPreciseMm = 0.02;
constexpr std::size_t kMostPoses = 5'000;  // of one try

bool in_contact(const Assembly& assembly, std::span<const PlateShape> shapes,
                std::span<const std::pair<int, int>> pairs, MoveBudget& budget) {
    Linkage linkage(assembly);
    PairSearch search(assembly, linkage, shapes);
    const std::vector<double> ends = cell_ends(assembly.sweep, linkage.range_ends());
    std::vector<std::vector<ContactRange>> stretches(pairs.size());
    std::vector<ContactRange> found;
    Cell cell;
    const std::size_t most = std::min(kMostPoses, budget.poses);
    const auto crosses = [&] {
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            if (!fill_cell(assembly, linkage, ends[i], ends[i + 1], cell)) return true;
            for (std::size_t k = 0; k < pairs.size(); ++k) {
                search.contacts(cell, pairs[k].first, pairs[k].second, found);
                stretches[k].insert(stretches[k].end(), found.begin(), found.end());
                // What grazes takes most poses, and is no mend.
                if (search.poses() >= most) return true;
                if (std::any_of(found.begin(), found.end(), [](const ContactRange& one) { return one.firm; }))
                    return true;
            }
        }
        Contacts contacts;
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            find_contacts(pairs[k].first, pairs[k].second, stretches[k], search, contacts);
        }
        return !contacts.contacts.empty() || !contacts.undecided.empty();
    };
    const bool result = crosses() || any_lies(assembly, shapes, pairs);
    budget.poses -= std::min(budget.poses, search.poses() + assembly.plates.size());
    return result;
}

}  // namespace

std::optional<Move> freeing_move(const Assembly& assembly, const Linkage& linkage,
                                 std::span<const PlateShape> shapes,
                                 std::span<const std::pair<int, int>> pairs, MoveBudget& budget) {
    std::vector<std::pair<int, double>> ways;  // element and sense
    for (const int joint : {linkage.joint_of(pairs[0].first), linkage.joint_of(pairs[0].second)}) {
        if (!slid(assembly.joints[static_cast<std::size_t>(joint)], kFirstMm)) continue;
        ways.emplace_back(joint, 1.0);
        ways.emplace_back(joint, -1.0);
    }
    if (ways.empty()) return std::nullopt;
    Assembly trial = assembly;
    const auto free = [&](int number, double mm) {
        const auto joint = static_cast<std::size_t>(number);
        trial.joints[joint].how = slid(assembly.joints[joint], mm)->how;
        const bool result = !in_contact(trial, shapes, pairs, budget);
        trial.joints[joint] = assembly.joints[joint];
        return result;
    };
    // Further and further in all ways at once; of those that are free first, the shortest.
    std::optional<Move> best;
    double before = 0.0;
    while (!best && before < kFurthestMm && budget.poses > 0) {
        double shortest = std::clamp(2.0 * before, kFirstMm, kFurthestMm);
        for (const auto& [joint, sense] : ways) {
            if (!free(joint, sense * shortest)) continue;
            double low = before;
            while (shortest - low > kPreciseMm && budget.poses > 0) {
                const double middle = 0.5 * (low + shortest);
                (free(joint, sense * middle) ? shortest : low) = middle;
            }
            const Joint& chosen = assembly.joints[static_cast<std::size_t>(joint)];
            const auto there = slid(chosen, sense * shortest);
            best = Move{joint, there->by, there->along};
        }
        before = shortest;
    }
    return best;
}

std::optional<Move> tucking_move(const Assembly& assembly, const Linkage& linkage, int joint,
                                 std::span<const Protrusion> before) {
    const Joint& element = assembly.joints[static_cast<std::size_t>(joint)];
    if (!slid(element, kFirstMm)) return std::nullopt;
    std::vector<int> out;  // plates that may stick out
    for (const Protrusion& one : before) {
        if (linkage.joint_of(one.plate) != joint) out.push_back(one.plate);
    }
    Assembly trial = assembly;
    const auto is_tucked = [&](double mm) {
        trial.joints[static_cast<std::size_t>(joint)].how = slid(element, mm)->how;
        const std::vector<Protrusion> left = find_protrusions(trial);
        return std::all_of(left.begin(), left.end(), [&](const Protrusion& one) {
            return std::find(out.begin(), out.end(), one.plate) != out.end();
        });
    };
    double low = 0.0;
    for (double high = kFirstMm; low < kFurthestMm; low = high, high = std::min(2.0 * high, kFurthestMm)) {
        for (const double sense : {1.0, -1.0}) {
            if (!is_tucked(sense * high)) continue;
            double shortest = high;
            while (shortest - low > kPreciseMm) {
                const double middle = 0.5 * (low + shortest);
                (is_tucked(sense * middle) ? shortest : low) = middle;
            }
            // As it is told, so that whoever obeys to the hundredth has moved far enough.
            const auto there = slid(element, sense * std::ceil(shortest * 100.0) / 100.0);
            return Move{joint, there->by, there->along};
        }
    }
    return std::nullopt;
}

}  // namespace popup
