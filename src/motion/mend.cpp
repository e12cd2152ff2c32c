#include "motion/mend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/closed_card.h"
#include "motion/joints/joint.h"
#include "motion/trials.h"

namespace popup {
namespace {

constexpr double kFirstMm = 0.5;
constexpr double kFurthestMm = 100.0;
constexpr double kPreciseMm = 0.02;
constexpr double kPastGrazeMm = 0.04;
constexpr int kMostLessons = 12;

// To the hundredth, as it is told: who obeys has moved far enough.
double rounded_up(double mm) { return std::ceil(mm * 100.0 - 1e-9) / 100.0; }

// A card of which one element is moved along its line.
class Slide {
 public:
    explicit Slide(const Assembly& assembly) : assembly_(assembly), trial_(assembly) {}

    const Assembly& moved(int joint, double mm) {
        back();
        const auto number = static_cast<std::size_t>(joint);
        trial_.joints[number].how = slid(assembly_.joints[number], mm)->how;
        moved_ = joint;
        return trial_;
    }
    [[nodiscard]] ElementMove as_move(int joint, double mm) const {
        const auto there = slid(assembly_.joints[static_cast<std::size_t>(joint)], mm);
        return {joint, there->by, there->along};
    }

 private:
    void back() {
        const auto number = static_cast<std::size_t>(moved_);
        if (moved_ >= 0) trial_.joints[number] = assembly_.joints[number];
    }

    const Assembly& assembly_;
    Assembly trial_;
    int moved_ = -1;
};

// The shortest move beyond `low` mm, and up to `high`, of a joint in one sense that frees the pairs.
std::optional<double> shortest_that_frees(Slide& slide, Trials& trials, int joint, double sense, double low,
                                          double high) {
    const auto glance = [&](double mm) {
        return !trials.crosses_at_a_glance(slide.moved(joint, sense * mm));
    };
    bool lesson = false;
    const auto examined = [&](double mm) {
        return !trials.in_contact(slide.moved(joint, sense * mm), lesson);
    };
    double tried = low;
    for (int i = 0; i < kMostLessons && trials.any_left(); ++i) {
        if (!glance(high)) return std::nullopt;
        tried = high;
        for (double not_free = low; tried - not_free > kPreciseMm;) {
            const double middle = 0.5 * (not_free + tried);
            (glance(middle) ? tried : not_free) = middle;
        }
        tried = rounded_up(tried);
        if (examined(tried)) return tried;
        if (!lesson) break;
    }
    // What only grazes is seen by no glance, and takes most poses; a little further it is clear at once.
    for (double more = kPastGrazeMm; !lesson && trials.any_left(); more *= 2.0) {
        const double further = std::min(rounded_up(tried + more), high);
        if (examined(further)) return further;
        if (further >= high) break;
    }
    return std::nullopt;
}

}  // namespace

std::optional<ElementMove> freeing_move(const Assembly& assembly, const Linkage& linkage,
                                        std::span<const PlateShape> shapes,
                                        std::span<const std::pair<int, int>> pairs,
                                        std::span<const Contact> contacts, MoveBudget& budget) {
    std::vector<std::pair<int, double>> ways;  // element and sense
    for (const int joint : {linkage.joint_of(pairs[0].first), linkage.joint_of(pairs[0].second)}) {
        if (!slid(assembly.joints[static_cast<std::size_t>(joint)], kFirstMm)) continue;
        ways.emplace_back(joint, 1.0);
        ways.emplace_back(joint, -1.0);
    }
    if (ways.empty()) return std::nullopt;
    Trials trials(assembly, linkage, shapes, pairs, contacts, budget);
    Surroundings surroundings(assembly, linkage, shapes, contacts, budget);
    Slide slide(assembly);
    // Further and further in all ways at once; of those that are free first, the shortest.
    std::optional<ElementMove> best;
    double before = 0.0;
    while (!best && before < kFurthestMm && trials.any_left()) {
        double shortest = std::clamp(2.0 * before, kFirstMm, kFurthestMm);
        for (const auto& [joint, sense] : ways) {
            const auto found = shortest_that_frees(slide, trials, joint, sense, before, shortest);
            if (!found) continue;
            const ElementMove move = slide.as_move(joint, sense * *found);
            if (!surroundings.allow(slide.moved(joint, sense * *found), joint, move.by)) continue;
            shortest = *found;
            best = move;
        }
        before = shortest;
    }
    return best;
}

std::optional<ElementMove> tucking_move(const Assembly& assembly, const Linkage& linkage,
                                        std::span<const PlateShape> shapes, int joint,
                                        std::span<const Protrusion> before, std::span<const Contact> contacts,
                                        MoveBudget& budget) {
    if (!slid(assembly.joints[static_cast<std::size_t>(joint)], kFirstMm)) return std::nullopt;
    std::vector<int> out;  // plates that may stick out
    for (const Protrusion& one : before) {
        if (linkage.joint_of(one.plate) != joint) out.push_back(one.plate);
    }
    Slide slide(assembly);
    Surroundings surroundings(assembly, linkage, shapes, contacts, budget);
    const auto is_tucked = [&](double mm) {
        const std::vector<Protrusion> left = find_protrusions(slide.moved(joint, mm));
        return std::all_of(left.begin(), left.end(), [&](const Protrusion& one) {
            return std::find(out.begin(), out.end(), one.plate) != out.end();
        });
    };
    double low = 0.0;
    for (double high = kFirstMm; low < kFurthestMm; low = high, high = std::min(2.0 * high, kFurthestMm)) {
        for (const double sense : {1.0, -1.0}) {
            if (!is_tucked(sense * high)) continue;
            double shortest = high;
            for (double not_tucked = low; shortest - not_tucked > kPreciseMm;) {
                const double middle = 0.5 * (not_tucked + shortest);
                (is_tucked(sense * middle) ? shortest : not_tucked) = middle;
            }
            shortest = rounded_up(shortest);
            const ElementMove move = slide.as_move(joint, sense * shortest);
            if (surroundings.allow(slide.moved(joint, sense * shortest), joint, move.by)) return move;
        }
    }
    return std::nullopt;
}

}  // namespace popup
