#include "motion/mend.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/cells.h"
#include "motion/closed_card.h"
#include "motion/contacts.h"
#include "motion/crossing.h"
#include "motion/joints/joint.h"
#include "motion/lying.h"

namespace popup {
namespace {

constexpr double kFirstMm = 0.5;
constexpr double kFurthestMm = 100.0;
constexpr double kPreciseMm = 0.02;
constexpr double kPastGrazeMm = 0.04;
constexpr std::size_t kMostPoses = 2'000;  // of one examination
constexpr double kGlancesAboveDeg =
    0.5;  // nearer to the closed card examinations are cheap, and glances are not
constexpr int kMostLessons = 12;

SpaceBox box_of(const PlateShape& shape, const Frame& frame) {
    SpaceBox box;
    for (const Vec2 corner : shape.hull) {
        const Vec3 p = frame.point(corner);
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    return box;
}

// A move as it is told, so that whoever obeys to the hundredth has moved far enough.
Move told(int number, const Joint& joint, double sense, double mm) {
    const auto there = slid(joint, sense * std::ceil(mm * 100.0) / 100.0);
    return {number, there->by, there->along};
}

// Whether some pairs of plates are in contact, for one trial after the other. A glance at some openings is a
// hundredth of the work of an examination, and rejects most trials; only what passes is examined, and where
// that finds a crossing, glances look there too from then on.
class Trials {
 public:
    Trials(const Assembly& assembly, const Linkage& linkage, std::span<const PlateShape> shapes,
           std::span<const std::pair<int, int>> pairs, std::span<const double> crossing_deg,
           MoveBudget& budget)
        : shapes_(shapes), pairs_(pairs), budget_(budget), frames_(assembly.plates.size()) {
        std::vector<int> plates;
        for (const auto& [a, b] : pairs) plates.insert(plates.end(), {a, b});
        Linkage(linkage).joints_under(plates, joints_);
        openings_.assign(crossing_deg.begin(), crossing_deg.end());
        const std::vector<double> ends = cell_ends(assembly.sweep, linkage.range_ends());
        for (std::size_t i = ends.size() - 1; i > 0; --i) {
            const double middle = 0.5 * (ends[i - 1] + ends[i]);
            if (middle > assembly.sweep.from_deg + kGlancesAboveDeg) openings_.push_back(middle);
        }
    }

    [[nodiscard]] bool any_left() const { return budget_.poses > 0; }

    // Whether a pair crosses at one of the openings, or lies on one another.
    bool crosses_at_a_glance(const Assembly& trial) {
        for (std::size_t i = 0; i < openings_.size(); ++i) {
            if (!crosses_at(trial, openings_[i])) continue;
            // Moves that are like it cross there as well.
            std::rotate(openings_.begin(), openings_.begin() + static_cast<std::ptrdiff_t>(i),
                        openings_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            return true;
        }
        return any_lies(trial, shapes_, pairs_);
    }

    // Whether a pair is in contact at any opening. `lesson`: whether glances have learnt to see it.
    bool in_contact(const Assembly& trial, bool& lesson) {
        lesson = false;
        Linkage linkage(trial);
        PairSearch search(trial, linkage, shapes_);
        std::optional<double> crossing;
        const bool result = examine(trial, linkage, search, crossing);
        spend(search.poses() + trial.plates.size());
        if (crossing) {
            openings_.insert(openings_.begin(), *crossing);
            lesson = crosses_at(trial, *crossing);
            if (!lesson) openings_.erase(openings_.begin());
        }
        return result;
    }

 private:
    bool crosses_at(const Assembly& trial, double deg) {
        for (const std::size_t joint : joints_) {
            if (!place_plates(trial.joints[joint], Angle::degrees(deg), frames_)) return true;
        }
        int boxed = -1;  // pairs of one plate stand together
        SpaceBox box;
        for (const auto& [a, b] : pairs_) {
            const Frame& frame = frames_[static_cast<std::size_t>(a)];
            const PlateShape& shape = shapes_[static_cast<std::size_t>(a)];
            if (boxed != a) box = box_of(shape, frame);
            boxed = a;
            const Frame& other = frames_[static_cast<std::size_t>(b)];
            const PlateShape& other_shape = shapes_[static_cast<std::size_t>(b)];
            if (!box.meets(box_of(other_shape, other))) continue;
            spend(1);
            const auto found = popup::crossing(shape, other_shape, relative(frame, other));
            if (found && found->firm()) return true;
        }
        return false;
    }

    bool examine(const Assembly& trial, Linkage& linkage, PairSearch& search,
                 std::optional<double>& crossing) const {
        const std::vector<double> ends = cell_ends(trial.sweep, linkage.range_ends());
        std::vector<std::vector<ContactRange>> stretches(pairs_.size());
        std::vector<ContactRange> found;
        Cell cell;
        const std::size_t most = std::min(kMostPoses, budget_.poses);
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            if (!fill_cell(trial, linkage, ends[i], ends[i + 1], cell)) return true;
            for (std::size_t k = 0; k < pairs_.size(); ++k) {
                search.contacts(cell, pairs_[k].first, pairs_[k].second, found);
                stretches[k].insert(stretches[k].end(), found.begin(), found.end());
                for (const ContactRange& one : found) {
                    if (one.firm) crossing = 0.5 * (one.from + one.to);
                }
                // What grazes takes most poses, and is no mend.
                if (crossing || search.poses() >= most) return true;
            }
        }
        Contacts contacts;
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            find_contacts(pairs_[k].first, pairs_[k].second, stretches[k], search, contacts);
        }
        return !contacts.contacts.empty() || !contacts.undecided.empty() || any_lies(trial, shapes_, pairs_);
    }

    void spend(std::size_t poses) { budget_.poses -= std::min(budget_.poses, poses); }

    std::span<const PlateShape> shapes_;
    std::span<const std::pair<int, int>> pairs_;
    MoveBudget& budget_;
    std::vector<std::size_t> joints_;  // under the plates of the pairs
    std::vector<double> openings_;     // for glances: first where the last trial crossed
    std::vector<Frame> frames_;
};

// An element that is moved along its line, one way.
class Slide {
 public:
    Slide(const Assembly& assembly, Trials& trials)
        : assembly_(assembly), trial_(assembly), trials_(trials) {}

    // The shortest move beyond `low` mm, and up to `high`, that frees the pairs; of -joint- in the given
    // sense.
    std::optional<double> shortest(int joint, double sense, double low, double high) {
        const auto glance = [&](double mm) {
            moved(joint, sense * mm);
            return !trials_.crosses_at_a_glance(trial_);
        };
        bool lesson = false;
        const auto examined = [&](double mm) {
            moved(joint, sense * mm);
            return !trials_.in_contact(trial_, lesson);
        };
        std::optional<double> result;
        double tried = low;
        for (int i = 0; i < kMostLessons && trials_.any_left(); ++i) {
            if (!glance(high)) break;
            tried = high;
            for (double not_free = low; tried - not_free > kPreciseMm;) {
                const double middle = 0.5 * (not_free + tried);
                (glance(middle) ? tried : not_free) = middle;
            }
            if (examined(tried)) result = tried;
            if (result || !lesson) break;
        }
        // What only grazes is seen by no glance, and takes most poses; a little further it is clear at once.
        for (double more = kPastGrazeMm; !result && !lesson && tried > low && trials_.any_left();
             more *= 2.0) {
            const double further = std::min(tried + more, high);
            if (examined(further)) result = further;
            if (further >= high) break;
        }
        trial_.joints[static_cast<std::size_t>(joint)] = assembly_.joints[static_cast<std::size_t>(joint)];
        return result;
    }

 private:
    void moved(int joint, double mm) {
        const auto number = static_cast<std::size_t>(joint);
        trial_.joints[number].how = slid(assembly_.joints[number], mm)->how;
    }

    const Assembly& assembly_;
    Assembly trial_;
    Trials& trials_;
};

}  // namespace

std::optional<Move> freeing_move(const Assembly& assembly, const Linkage& linkage,
                                 std::span<const PlateShape> shapes,
                                 std::span<const std::pair<int, int>> pairs,
                                 std::span<const double> crossing_deg, MoveBudget& budget) {
    std::vector<std::pair<int, double>> ways;  // element and sense
    for (const int joint : {linkage.joint_of(pairs[0].first), linkage.joint_of(pairs[0].second)}) {
        if (!slid(assembly.joints[static_cast<std::size_t>(joint)], kFirstMm)) continue;
        ways.emplace_back(joint, 1.0);
        ways.emplace_back(joint, -1.0);
    }
    if (ways.empty()) return std::nullopt;
    Trials trials(assembly, linkage, shapes, pairs, crossing_deg, budget);
    Slide slide(assembly, trials);
    // Further and further in all ways at once; of those that are free first, the shortest.
    std::optional<Move> best;
    double before = 0.0;
    while (!best && before < kFurthestMm && trials.any_left()) {
        double shortest = std::clamp(2.0 * before, kFirstMm, kFurthestMm);
        for (const auto& [joint, sense] : ways) {
            const auto found = slide.shortest(joint, sense, before, shortest);
            if (!found) continue;
            shortest = *found;
            best = told(joint, assembly.joints[static_cast<std::size_t>(joint)], sense, shortest);
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
            return told(joint, element, sense, shortest);
        }
    }
    return std::nullopt;
}

}  // namespace popup
