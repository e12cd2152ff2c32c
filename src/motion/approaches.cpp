#include "motion/approaches.h"

#include <algorithm>
#include <cmath>

#include "base/nth.h"
#include "motion/bodies.h"
#include "motion/sweep.h"

namespace popup {
namespace {

// Plates that touch at all telling angles are joined: they share an apex, say. Corners of documents are
// rounded.
constexpr double kJoinedMm = kTouchMm;
constexpr double kFlushMm = 1e-3;
// What is near until the card is closed (or lies flat) is so because it folds, below this angle.
constexpr double kFoldingDeg = 45.0;
constexpr double kLeastDeg = 1e-4;  // to which the angle of the smallest distance is found
constexpr int kLooks = 64;          // where a smallest distance is looked for, before halving

}  // namespace

Approaches::Approaches(const Assembly& assembly, std::span<const PlateShape> shapes, double distance_mm)
    : sweep_(assembly.sweep),
      shapes_(shapes),
      distance_mm_(distance_mm),
      open_(assembly.plates.size()),
      bodies_(bodies_of(assembly)) {
    for (const double deg : kTellingDegs) {
        frames_.emplace_back(assembly.plates.size());
        reached_ = reached_ && place(assembly, Angle::degrees(opening_at(sweep_, deg)), frames_.back());
    }
    reached_ = reached_ && place(assembly, Angle::degrees(sweep_.to_deg), open_);
    for (const Hinge& hinge : assembly.hinges) joined_[std::minmax(hinge.a, hinge.b)] = true;
}

void Approaches::add(const Cell& cell, int a, int b, PairSearch& search) {
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

std::vector<Approach> Approaches::take(const std::vector<Contact>& contacts, PairSearch& search) const {
    std::vector<Approach> result;
    for (const auto& [pair, all] : found_) {
        for (Approach one : all) {
            if (sweep_.closed_flat && one.from_deg <= least_opening(sweep_)) {
                one.from_deg = sweep_.from_deg + kFoldingDeg;
            }
            if (one.to_deg >= sweep_.to_deg && meet_when_open(one, search)) {
                one.to_deg = sweep_.to_deg - kFoldingDeg;
            }
            if (one.from_deg >= one.to_deg) continue;
            const bool crosses = std::any_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
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

bool Approaches::joined(int a, int b) {
    if (nth(bodies_, a) == nth(bodies_, b)) return true;
    const auto known = joined_.find(std::minmax(a, b));
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
    return joined_[std::minmax(a, b)] = std::all_of(frames_.begin(), frames_.end(), touch);
}

void Approaches::find_least(Approach& one, PairSearch& search) const {
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

bool Approaches::meet_when_open(const Approach& one, PairSearch& search) const {
    const Frame& a = nth(open_, one.a);
    const Frame& b = nth(open_, one.b);
    const bool in_one_plane =
        length(cross(a.normal(), b.normal())) < 1e-6 && std::abs(dot(b.origin - a.origin, a.normal())) < 1e-3;
    return in_one_plane || search.distance(one.a, one.b, sweep_.to_deg, distance_mm_).mm <= kTouchMm;
}

}  // namespace popup
