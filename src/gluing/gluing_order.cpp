// An order of gluing. What must be there, and what would be in the way, are the edges of a graph; where they
// run in a circle only what must be there counts.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/nth.h"
#include "gluing/bonds.h"
#include "gluing/circles.h"
#include "gluing/flat_pieces.h"
#include "gluing/in_the_way.h"
#include "popup/gluing.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kAlike = 1e-6;     // of two unit normals
constexpr double kOnePlane = 1e-3;  // mm, between what lies in one plane

class Finder {
 public:
    explicit Finder(const Assembly& assembly)
        : in_(assembly), bonds_(bonds_of(assembly)), poses_(poses_of(assembly)) {}

    GluingOrder run() {
        find_card();
        find_grounds();
        find_bearers();
        std::vector<std::vector<int>> borne(in_.pieces.size());
        std::vector<int> bears_all;  // pieces that are glued to nothing
        for (std::size_t i = 0; i < in_.pieces.size(); ++i) {
            const int bearer = order_.bearers[i];
            if (bearer < 0) {
                bears_all.push_back(static_cast<int>(i));
            } else {
                nth(borne, bearer).push_back(static_cast<int>(i));
            }
        }
        const InTheWay in_the_way(in_, bonds_, order_, poses_);
        in_the_way_ = &in_the_way;
        wants_ = in_the_way.wants();
        flat_before_ = flat_before(in_, bonds_, order_, poses_);
        put_flat_first();
        // The card last; of others each is a sub-assembly of its own.
        std::stable_partition(bears_all.begin(), bears_all.end(),
                              [this](int piece) { return piece != order_.card; });
        for (const int root : bears_all) put_in_order(root, borne);
        return std::move(order_);
    }

 private:
    // Where a flat piece and what stands above it want each other to come first, the flat one does: it could
    // hardly be slipped in below, and a tab holds on it as well.
    void put_flat_first() {
        for (const Bond& bond : bonds_) {
            if (bond.kind != Bond::Kind::area) continue;
            const int flat = piece(bond.plate);
            const auto wanted = wants_.find(flat);
            if (wanted == wants_.end()) continue;
            for (const int other : wanted->second) {
                const auto back = wants_.find(other);
                if (!is_flat(other) && back != wants_.end() && back->second.contains(flat))
                    flat_before_[other].insert(flat);
            }
        }
        for (const auto& [one, flat] : flat_before_) {
            for (const int first : flat) {
                if (const auto other = wants_.find(first); other != wants_.end()) other->second.erase(one);
            }
        }
    }
    [[nodiscard]] bool is_flat(int one) const {
        const std::vector<Bond>& bonds = nth(of_piece_, one);
        return std::any_of(bonds.begin(), bonds.end(),
                           [](const Bond& bond) { return bond.kind == Bond::Kind::area; });
    }

    void find_card() {
        order_.card = in_.covers.empty() ? 0 : nth(in_.plates, in_.covers.front()).piece;
        for (const Hinge& hinge : in_.hinges) {
            if (!hinge.glued) folds_.insert(std::minmax(hinge.a, hinge.b));
        }
    }

    // What each piece must find there: those it is bonded to, by the bonds' directions. A tab under another
    // piece carries that one, if its own piece stands on something else.
    void find_grounds() {
        grounds_.resize(in_.pieces.size());
        for (Bond& bond : bonds_) {
            if (piece(bond.plate) == order_.card && piece(bond.mate) != order_.card) turn_round(bond);
        }
        std::vector<std::set<int>> plain(in_.pieces.size());
        for (const Bond& bond : bonds_) {
            if (piece(bond.plate) != piece(bond.mate) && !is_below(bond))
                nth(plain, piece(bond.plate)).insert(piece(bond.mate));
        }
        for (Bond& bond : bonds_) {
            const int own = piece(bond.plate);
            const int other = piece(bond.mate);
            if (own == other) continue;
            const bool stands = !nth(plain, own).empty() && !nth(plain, own).contains(other);
            if (is_below(bond) && stands && !nth(plain, other).empty() && other != order_.card) {
                turn_round(bond);
            }
            nth(grounds_, piece(bond.plate)).insert(piece(bond.mate));
        }
        break_circles(grounds_);
        // A bond whose direction had to go is made by the piece that comes later.
        for (Bond& bond : bonds_) {
            const int own = piece(bond.plate);
            const int other = piece(bond.mate);
            if (own == other || nth(grounds_, own).contains(other)) continue;
            turn_round(bond);
            nth(grounds_, other).insert(own);
        }
        of_piece_.resize(in_.pieces.size());
        for (const Bond& bond : bonds_) nth(of_piece_, piece(bond.plate)).push_back(bond);
    }
    // What was there comes, and what came was there.
    static void turn_round(Bond& bond) {
        std::swap(bond.plate, bond.mate);
        bond.theirs = !bond.theirs;
        bond.on_back = false;
    }
    static bool is_below(const Bond& bond) { return bond.kind == Bond::Kind::tab && bond.on_back; }

    void find_bearers() {
        order_.bearers.assign(in_.pieces.size(), -1);
        depth_.assign(in_.pieces.size(), 0);
        for (const int one : grounds_first(grounds_)) {
            const std::set<int>& grounds = nth(grounds_, one);
            if (grounds.empty()) continue;
            int bearer = *grounds.begin();
            if (grounds.size() == 1) {
                // On its own it can only bear what is glued to planes that lie together on the table.
                const int above = nth(order_.bearers, bearer);
                if (above >= 0 && !lies_together(one)) bearer = above;
            } else {
                for (const int other : grounds) bearer = common(bearer, other);
            }
            nth(order_.bearers, one) = bearer;
            nth(depth_, one) = nth(depth_, bearer) + 1;
        }
    }

    // The nearest piece that bears both, or is one and bears the other.
    [[nodiscard]] int common(int a, int b) const {
        while (a != b) {
            int& deeper = nth(depth_, a) >= nth(depth_, b) ? a : b;
            if (nth(order_.bearers, deeper) < 0) return deeper == a ? b : a;
            deeper = nth(order_.bearers, deeper);
        }
        return a;
    }

    // Whether its mates are one plate, or two that share a fold.
    [[nodiscard]] bool lies_together(int one) const {
        std::set<int> mates;
        for (const Bond& bond : nth(of_piece_, one)) {
            if (piece(bond.mate) != one) mates.insert(bond.mate);
        }
        if (mates.size() < 2) return true;
        if (mates.size() > 2) return false;
        const int a = *mates.begin();
        const int b = *mates.rbegin();
        return folds_.contains({a, b});
    }

    // All steps of what a piece bears, sub-assemblies before what they are glued to.
    void put_in_order(int root, const std::vector<std::vector<int>>& borne) {
        // Without recursion: a sub-assembly's steps stand before those of what bears it.
        std::vector<int> waiting{root};
        std::vector<std::vector<int>> groups;
        while (!waiting.empty()) {
            const int bearer = waiting.back();
            waiting.pop_back();
            groups.push_back(sorted(bearer, nth(borne, bearer)));
            for (const int one : groups.back()) {
                if (!nth(borne, one).empty()) waiting.push_back(one);
            }
        }
        for (auto group = groups.rbegin(); group != groups.rend(); ++group) {
            std::set<int> done;
            for (const int one : *group) {
                order_.steps.push_back(step_of(one, done));
                done.insert(one);
            }
        }
    }

    // Backs, then flat ones, then the small.
    using Rank = std::tuple<int, double, int>;
    [[nodiscard]] Rank rank(int one) const {
        double paper = 0.0;
        for (const int plate : nth(in_.pieces, one).plates) paper += area(nth(in_.plates, plate).outline);
        const Lie lie = lie_of(turns_of(one), nth(order_.bearers, one));
        const int turn = lie == Lie::turned ? 0 : lie == Lie::half_open ? 2 : 1;
        return {turn, std::round(paper), one};
    }

    // The piece glued on the bearer that is the piece, or bears it; -1: none.
    [[nodiscard]] int member(int piece, int bearer) const {
        while (piece >= 0 && nth(order_.bearers, piece) != bearer) piece = nth(order_.bearers, piece);
        return piece;
    }

    [[nodiscard]] std::vector<int> sorted(int bearer, const std::vector<int>& group) const {
        if (group.empty()) return {};
        Wants among;  // edges between members of the group
        for (const int one : group) {
            for (const int ground : nth(grounds_, one)) {
                const int other = member(ground, bearer);
                if (other >= 0 && other != one) among.must[one].insert(other);
            }
            const auto soft = wants_.find(one);
            if (soft == wants_.end()) continue;
            for (const int other : soft->second) among.wants[one].insert(other);
        }
        std::vector<std::pair<Rank, int>> ranked;
        ranked.reserve(group.size());
        for (const int one : group) ranked.emplace_back(rank(one), one);
        std::sort(ranked.begin(), ranked.end());
        std::vector<int> by_rank;
        by_rank.reserve(group.size());
        for (const auto& [of, one] : ranked) by_rank.push_back(one);
        // What lies beneath must be there, unless that runs in a circle with what else must.
        Wants with_flat = among;
        for (const int one : group) {
            const auto flat = flat_before_.find(one);
            if (flat == flat_before_.end()) continue;
            with_flat.must[one].insert(flat->second.begin(), flat->second.end());
            among.wants[one].insert(flat->second.begin(), flat->second.end());
        }
        std::vector<int> order = ordered(by_rank, with_flat);
        return order.size() == by_rank.size() ? order : ordered(by_rank, among);
    }

    [[nodiscard]] GluingStep step_of(int one, const std::set<int>& done) const {
        GluingStep step;
        step.piece = one;
        step.ground = nth(order_.bearers, one);
        step.turns = turns_of(one);
        step.lie = lie_of(step.turns, step.ground);
        for (const Bond& bond : nth(of_piece_, one)) {
            if (piece(bond.mate) == one) step.ring.push_back(bond);
        }
        for (const BondTurn& turn : step.turns) {
            for (const Bond& bond : turn.bonds) {
                std::set<int> above = in_the_way_->above(bond, step.ground);
                std::erase_if(above,
                              [&](int other) { return !done.contains(other) || stands_on(one, other); });
                if (const int flat = beneath(one, bond, above); flat >= 0) {
                    step.onto.emplace_back(bond, flat);
                } else if (!above.empty()) {
                    step.under.push_back(bond);
                }
            }
        }
        return step;
    }

    // Of what hides the target of its tab the last that is glued flat beneath it; -1: none.
    [[nodiscard]] int beneath(int one, const Bond& bond, const std::set<int>& above) const {
        const auto flat = flat_before_.find(one);
        if (bond.kind != Bond::Kind::tab || flat == flat_before_.end()) return -1;
        int last = -1;
        for (const int other : above) {
            if (flat->second.contains(other)) last = other;
        }
        return last;
    }

    // Whether one of its grounds is the other, or borne by it.
    [[nodiscard]] bool stands_on(int one, int other) const {
        const std::set<int>& grounds = nth(grounds_, one);
        return std::any_of(grounds.begin(), grounds.end(),
                           [&](int ground) { return member(ground, nth(order_.bearers, one)) == other; });
    }

    // Bonds by the planes of their mates: first the plane that lies on the table, then as they stand.
    [[nodiscard]] std::vector<BondTurn> turns_of(int one) const {
        std::vector<BondTurn> turns;
        for (const bool theirs : {false, true}) {
            for (const Bond& bond : nth(of_piece_, one)) {
                if (piece(bond.mate) == one || bond.theirs != theirs) continue;
                const auto same = std::find_if(turns.begin(), turns.end(), [&](const BondTurn& turn) {
                    const Bond& other = turn.bonds.front();
                    return other.theirs == theirs && other.on_back == bond.on_back &&
                           lie_in_one_plane(other.mate, bond.mate);
                });
                if (same != turns.end()) {
                    same->bonds.push_back(bond);
                } else {
                    turns.push_back({Touch::press, {bond}});
                }
            }
        }
        const int ground = nth(order_.bearers, one);
        std::stable_partition(turns.begin(), turns.end(), [&](const BondTurn& turn) {
            return !turn.bonds.front().theirs && lies(turn.bonds.front().mate, ground);
        });
        for (std::size_t i = 1; i < turns.size(); ++i) {
            turns[i].touch =
                closes(turns.front().bonds.front(), turns[i].bonds.front()) ? Touch::close : Touch::bend;
        }
        return turns;
    }

    [[nodiscard]] Lie lie_of(const std::vector<BondTurn>& turns, int ground) const {
        const auto on_back = [](const BondTurn& turn) { return turn.bonds.front().on_back; };
        if (std::any_of(turns.begin(), turns.end(), on_back)) return Lie::turned;
        if (ground != order_.card) return Lie::loose;
        for (const BondTurn& turn : turns) {
            if (turn.touch == Touch::close) continue;
            for (const Bond& bond : turn.bonds) {
                if (!bond.theirs && !lies(bond.mate, ground)) return Lie::half_open;
            }
        }
        return Lie::open;
    }

    // Whether the plate is parallel to one of the ground's own when the card is open.
    [[nodiscard]] bool lies(int plate, int ground) const {
        if (poses_.empty() || piece(plate) == ground) return true;
        const Vec3 normal = nth(poses_.open, plate).normal();
        const std::vector<int>& own = nth(in_.pieces, ground).plates;
        const std::vector<int>& table = ground == order_.card && !in_.covers.empty() ? in_.covers : own;
        return std::any_of(table.begin(), table.end(), [&](int other) {
            return std::abs(dot(normal, nth(poses_.open, other).normal())) > 1.0 - kAlike;
        });
    }

    // In one plane however far the card is open.
    [[nodiscard]] bool lie_in_one_plane(int a, int b) const {
        if (a == b) return true;
        if (poses_.empty()) return false;
        for (const std::vector<Frame>* const pose : {&poses_.open, &poses_.half, &poses_.ajar}) {
            const Frame& fa = nth(*pose, a);
            const Frame& fb = nth(*pose, b);
            if (dot(fa.normal(), fb.normal()) < 1.0 - kAlike) return false;
            const Vec2 at = nth(in_.plates, b).outline.outer.front();
            if (std::abs(dot(fb.point(at) - fa.origin, fa.normal())) > kOnePlane) return false;
        }
        return true;
    }

    // Whether the mates of two bonds come together, front to front, as the card closes.
    [[nodiscard]] bool closes(const Bond& first, const Bond& then) const {
        if (poses_.empty() || first.on_back || then.on_back || then.theirs) return false;
        const Frame& a = nth(poses_.ajar, first.mate);
        const Frame& b = nth(poses_.ajar, then.mate);
        if (dot(a.normal(), b.normal()) > -0.5) return false;
        const Vec3 way = middle(then, b) - middle(first, a);
        return dot(way, a.normal()) > 0.0 && dot(way, b.normal()) < 0.0;
    }
    [[nodiscard]] Vec3 middle(const Bond& bond, const Frame& frame) const {
        return bond.kind == Bond::Kind::rivet ? frame.origin : frame.point(target_places(in_, bond).front());
    }

    [[nodiscard]] int piece(int plate) const { return nth(in_.plates, plate).piece; }

    const Assembly& in_;
    std::vector<Bond> bonds_;
    GluePoses poses_;
    std::vector<std::set<int>> grounds_;  // of each piece: those that must be there
    std::vector<std::vector<Bond>> of_piece_;
    std::vector<int> depth_;
    std::map<int, std::set<int>> wants_;        // of each piece: those that had better be glued before it
    std::map<int, std::set<int>> flat_before_;  // of each: flat ones without which it cannot be glued
    std::set<std::pair<int, int>> folds_;       // plates that share one
    const InTheWay* in_the_way_ = nullptr;
    GluingOrder order_;
};

}  // namespace

GluingOrder gluing_order(const Assembly& assembly) {
    if (assembly.pieces.empty()) return {};
    return Finder(assembly).run();
}

}  // namespace popup
