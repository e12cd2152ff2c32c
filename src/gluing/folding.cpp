// What is folded: elements that are pushed out of a piece, and the folds of a sheet in their order.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "popup/gluing.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMovesDeg = 0.02;  // from one opening looked at to the next
constexpr int kLooks = 180;         // over all of the sweep
constexpr int kFewestLooks = 12;    // over a part of it
constexpr double kSameDeg = 1e-6;   // of openings, and of angles on a straight way

// How fast the angle changes over a range of a law that begins at this point, if it goes straight there.
std::optional<double> slope_over(const Law& law, std::size_t first) {
    const Vec2 from = law[first];
    const Vec2 to = law[std::min(first + Folded::kLawSteps, law.size() - 1)];
    if (to.x - from.x < kSameDeg) return std::nullopt;
    const double slope = (to.y - from.y) / (to.x - from.x);
    for (std::size_t i = first; i < law.size() && law[i].x < to.x; ++i) {
        if (std::abs(law[i].y - (from.y + slope * (law[i].x - from.x))) > kSameDeg) return std::nullopt;
    }
    return slope;
}

// The openings at which a step ends or begins, from the sweep's end to its begin: where a fold's law does,
// and where a fold that goes straight turns, or waits. A law that is bent has its ranges for its accuracy.
std::vector<double> ends_of_steps(const Assembly& assembly) {
    const Sweep& sweep = assembly.sweep;
    std::vector<double> ends{sweep.to_deg, sweep.from_deg};
    const auto add = [&](double opening) {
        if (opening > sweep.from_deg + kSameDeg && opening < sweep.to_deg - kSameDeg) ends.push_back(opening);
    };
    for (const Joint& joint : assembly.joints) {
        const Law* const law = law_of(joint);
        if (law == nullptr || law->size() < 2) continue;
        const double still = law->front().y;
        if (std::all_of(law->begin(), law->end(), [still](Vec2 point) { return point.y == still; })) continue;
        add(law->front().x);
        add(law->back().x);
        for (std::size_t i = Folded::kLawSteps; i + 1 < law->size(); i += Folded::kLawSteps) {
            const std::optional<double> before = slope_over(*law, i - Folded::kLawSteps);
            const std::optional<double> after = slope_over(*law, i);
            if (before && after && std::abs(*before - *after) > kSameDeg) add((*law)[i].x);
        }
    }
    std::sort(ends.begin(), ends.end(), std::greater<>());
    ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return a - b < kSameDeg; }),
               ends.end());
    return ends;
}

// Openings that are looked at, from one to a lower one, both of them too.
struct Looks {
    double from_deg = 0.0, to_deg = 0.0;
    int count = 0;
    [[nodiscard]] double at(int look) const {
        return look == count ? to_deg : from_deg + (to_deg - from_deg) * look / count;
    }
};

// The looks between which each fold moves: from the first that it leaves to the last that it comes to.
struct Moves {
    int hinge = 0;
    int from = -1, to = -1;
};

std::vector<Moves> moves_of(const Assembly& assembly, const Looks& looks) {
    std::vector<Moves> moves;
    for (std::size_t i = 0; i < assembly.hinges.size(); ++i) moves.push_back({static_cast<int>(i)});
    std::vector<double> last(moves.size());
    std::vector<Frame> frames(assembly.plates.size());
    for (int look = 0; look <= looks.count; ++look) {
        if (!place(assembly, Angle::degrees(looks.at(look)), frames)) return {};
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const Hinge& hinge = assembly.hinges[i];
            const double now = folded_deg(hinge, nth(frames, hinge.a), nth(frames, hinge.b));
            // Folded over, front to front is back to back.
            const double turned = std::remainder(now - last[i], 360.0);
            if (look > 0 && std::abs(turned) > kMovesDeg) {
                if (moves[i].from < 0) moves[i].from = look - 1;
                moves[i].to = look;
            }
            last[i] = now;
        }
    }
    moves.erase(std::remove_if(moves.begin(), moves.end(), [](const Moves& one) { return one.from < 0; }),
                moves.end());
    return moves;
}

// Folds that move at a time with others are in one step with them.
void add_steps(const Assembly& assembly, const Looks& looks, std::vector<FoldingStep>& steps) {
    std::vector<Moves> moves = moves_of(assembly, looks);
    std::sort(moves.begin(), moves.end(), [](const Moves& a, const Moves& b) {
        return std::pair{a.from, a.hinge} < std::pair{b.from, b.hinge};
    });
    // A look may lie in two steps, where one ends and the next begins.
    const std::size_t first = steps.size();
    int end = -1;
    for (const Moves& one : moves) {
        if (steps.size() == first || one.from > end - 2) {
            steps.push_back({looks.at(one.from), looks.at(one.to), {}, {}});
            end = one.to;
        }
        end = std::max(end, one.to);
        steps.back().to_deg = looks.at(end);
        steps.back().hinges.push_back(one.hinge);
    }
}

}  // namespace

double folded_deg(const Hinge& hinge, const Frame& a, const Frame& b) {
    // b lies to the right of a_line: about its direction, a positive turn of b's normal lifts its far side.
    const Vec3 along = unit(a.direction(hinge.a_line.b - hinge.a_line.a));
    const double sine = dot(cross(b.normal(), a.normal()), along);
    return kDegrees * std::atan2(sine, dot(a.normal(), b.normal()));
}

std::vector<PushedOut> pushed_out(const Assembly& assembly) {
    if (is_folded_sheet(assembly)) return {};
    std::vector<int> level(assembly.plates.size(), 0);
    std::vector<PushedOut> all;
    std::map<std::pair<int, std::string>, std::size_t> known;  // by piece and element
    for (const Joint& joint : assembly.joints) {
        const JointPlates plates = plates_of(joint);
        if (plates.places.empty() || plates.needs.empty()) continue;
        const int piece = nth(assembly.plates, plates.places.front().plate).piece;
        const auto is_own = [&](int plate) { return nth(assembly.plates, plate).piece == piece; };
        const bool cut = std::all_of(plates.needs.begin(), plates.needs.end(), is_own) &&
                         std::all_of(plates.places.begin(), plates.places.end(),
                                     [&](const PlacedPlate& one) { return is_own(one.plate); });
        if (!cut) continue;
        const auto [at, fresh] = known.try_emplace({piece, joint.name}, all.size());
        if (fresh) {
            int below = 0;
            for (const int need : plates.needs) below = std::max(below, nth(level, need));
            all.push_back({joint.name, piece, {}, below + 1});
        }
        PushedOut& one = all[at->second];
        for (const PlacedPlate& placed : plates.places) {
            one.plates.push_back(placed.plate);
            nth(level, placed.plate) = one.level;
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const PushedOut& a, const PushedOut& b) {
        return std::pair{a.piece, a.level} < std::pair{b.piece, b.level};
    });
    return all;
}

std::vector<FoldingStep> folding_steps(const Assembly& assembly) {
    if (!is_folded_sheet(assembly)) return {};
    const std::vector<double> ends = ends_of_steps(assembly);
    const double wide = assembly.sweep.to_deg - assembly.sweep.from_deg;
    std::vector<FoldingStep> steps;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double share = (ends[i] - ends[i + 1]) / wide;
        const int count = std::max(kFewestLooks, static_cast<int>(std::lround(share * kLooks)));
        add_steps(assembly, {ends[i], ends[i + 1], count}, steps);
    }
    for (FoldingStep& step : steps) {
        std::sort(step.hinges.begin(), step.hinges.end());
        std::set<int> plates;
        for (const int number : step.hinges) {
            const Hinge& hinge = nth(assembly.hinges, number);
            if (nth(assembly.plates, hinge.a).parent == hinge.b) plates.insert(hinge.a);
            if (nth(assembly.plates, hinge.b).parent == hinge.a) plates.insert(hinge.b);
        }
        step.plates.assign(plates.begin(), plates.end());
    }
    return steps;
}

}  // namespace popup
