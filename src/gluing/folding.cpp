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

#include "base/nth.h"
#include "popup/gluing.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMovesDeg = 0.02;  // from one opening looked at to the next
constexpr int kLooks = 180;
constexpr double kSameOpeningDeg = 1e-6;

bool is_folded_sheet(const Assembly& assembly) {
    return std::any_of(assembly.joints.begin(), assembly.joints.end(),
                       [](const Joint& joint) { return std::holds_alternative<Still>(joint.how); });
}

// The looks between which each fold moves: from the first that it leaves to the last that it comes to.
struct Moves {
    int hinge = 0;
    int from = -1, to = -1;
    std::vector<char> turns = {};  // by look: whether it has turned since the one before
};

std::vector<Moves> moves_of(const Assembly& assembly) {
    std::vector<Moves> moves;
    for (std::size_t i = 0; i < assembly.hinges.size(); ++i)
        moves.push_back({static_cast<int>(i), -1, -1, std::vector<char>(kLooks + 1, 0)});
    std::vector<double> last(moves.size());
    std::vector<Frame> frames(assembly.plates.size());
    const Sweep& sweep = assembly.sweep;
    for (int look = 0; look <= kLooks; ++look) {
        const double opening = sweep.to_deg + (sweep.from_deg - sweep.to_deg) * look / kLooks;
        if (!place(assembly, Angle::degrees(opening), frames)) return {};
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const Hinge& hinge = assembly.hinges[i];
            const double now = folded_deg(hinge, nth(frames, hinge.a), nth(frames, hinge.b));
            // Folded over, front to front is back to back.
            const double turned = std::remainder(now - last[i], 360.0);
            if (look > 0 && std::abs(turned) > kMovesDeg) {
                if (moves[i].from < 0) moves[i].from = look - 1;
                moves[i].to = look;
                moves[i].turns[static_cast<std::size_t>(look)] = 1;
            }
            last[i] = now;
        }
    }
    moves.erase(std::remove_if(moves.begin(), moves.end(), [](const Moves& one) { return one.from < 0; }),
                moves.end());
    return moves;
}

// Where a fold goes, by openings that ascend: stretches of its law that its order of folds may have given it.
struct Stretch {
    double low = 0.0, high = 0.0;
};

void add_stretches(const std::vector<Vec2>& law, std::vector<Stretch>& stretches) {
    const std::size_t step = law.size() > 2 ? Folded::kLawSteps : 1;
    for (std::size_t i = 0; i + step < law.size(); i += step) {
        const auto begin = law.begin() + static_cast<std::ptrdiff_t>(i);
        const bool goes = std::any_of(begin, begin + static_cast<std::ptrdiff_t>(step) + 1,
                                      [&](Vec2 point) { return std::abs(point.y - begin->y) > kMovesDeg; });
        if (goes) stretches.push_back({begin->x, (begin + static_cast<std::ptrdiff_t>(step))->x});
    }
}

// Openings at which one step of an order ends and the next begins although a fold goes on in both, as a lid
// does that is let down before its flap is tucked in: a fold begins or ends to go there, and none goes
// through.
std::vector<double> step_ends(const Assembly& assembly) {
    std::vector<Stretch> stretches;
    for (const Joint& joint : assembly.joints) {
        if (const auto* const folded = std::get_if<Folded>(&joint.how)) add_stretches(folded->law, stretches);
        if (const auto* const closing = std::get_if<LoopFold>(&joint.how))
            add_stretches(closing->law, stretches);
    }
    std::vector<double> ends;
    for (const Stretch& one : stretches) {
        for (const double at : {one.low, one.high}) {
            const bool parts = std::none_of(stretches.begin(), stretches.end(), [at](const Stretch& other) {
                return other.low < at - kSameOpeningDeg && other.high > at + kSameOpeningDeg;
            });
            if (parts) ends.push_back(at);
        }
    }
    std::sort(ends.begin(), ends.end(), std::greater<>());
    return ends;
}

// Each fold that goes on over the end of a step goes once before it and once after it.
void part_at_step_ends(const Assembly& assembly, std::vector<Moves>& moves) {
    const Sweep& sweep = assembly.sweep;
    for (const double end : step_ends(assembly)) {
        const double share = (sweep.to_deg - end) / (sweep.to_deg - sweep.from_deg);
        const int look = static_cast<int>(std::lround(share * kLooks));
        const std::size_t count = moves.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (look < moves[i].from + 2 || look > moves[i].to - 2) continue;
            Moves later = moves[i];
            later.from = look;
            moves[i].to = look;
            while (later.turns[static_cast<std::size_t>(later.from) + 1] == 0) ++later.from;
            while (moves[i].turns[static_cast<std::size_t>(moves[i].to)] == 0) --moves[i].to;
            moves.push_back(std::move(later));
        }
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
    std::vector<Moves> moves = moves_of(assembly);
    part_at_step_ends(assembly, moves);
    std::sort(moves.begin(), moves.end(), [](const Moves& a, const Moves& b) {
        return std::pair{a.from, a.hinge} < std::pair{b.from, b.hinge};
    });
    // A look may lie in two steps, where one ends and the next begins.
    std::vector<FoldingStep> steps;
    const Sweep& sweep = assembly.sweep;
    const auto opening = [&sweep](int look) {
        return sweep.to_deg + (sweep.from_deg - sweep.to_deg) * look / kLooks;
    };
    int end = -1;
    for (const Moves& one : moves) {
        if (steps.empty() || one.from > end - 2) {
            steps.push_back({opening(one.from), opening(one.to), {}, {}});
            end = one.to;
        }
        end = std::max(end, one.to);
        steps.back().to_deg = opening(end);
        steps.back().hinges.push_back(one.hinge);
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
