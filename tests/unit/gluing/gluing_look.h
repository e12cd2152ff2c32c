// An order of gluing held against what is there and what is in the way, found by looking at everything.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/nth.h"
#include "popup/gluing.h"
#include "popup/motion.h"

namespace popup::test {

inline int piece_of(const Assembly& in, int plate) {
    return in.plates.at(static_cast<std::size_t>(plate)).piece;
}

inline std::vector<Bond> bonds_of(const GluingStep& step) {
    std::vector<Bond> bonds;
    for (const BondTurn& turn : step.turns) bonds.insert(bonds.end(), turn.bonds.begin(), turn.bonds.end());
    return bonds;
}

// Even-odd, on the plate's page.
inline bool covers(const Polygon& polygon, Vec2 p) {
    bool inside = false;
    const auto cross_ring = [&](const Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i];
            const Vec2 b = ring[(i + 1) % ring.size()];
            if ((a.y > p.y) == (b.y > p.y)) continue;
            if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
        }
    };
    cross_ring(polygon.outer);
    for (const Ring& hole : polygon.holes) cross_ring(hole);
    return inside;
}

// What comes before what, found by looking at everything.
class Look {
 public:
    Look(const Assembly& in, const GluingOrder& order) : in_(in), order_(order), at_(in.pieces.size(), -1) {
        for (std::size_t i = 0; i < order.steps.size(); ++i)
            at_[static_cast<std::size_t>(order.steps[i].piece)] = static_cast<int>(i);
    }

    std::vector<std::string> faults() {
        once();
        there();
        sub_assemblies();
        directions();
        in_the_way();
        return faults_;
    }

 private:
    template <typename... Values>
    void fault(fmt::format_string<Values...> text, Values&&... values) {
        faults_.push_back(fmt::format(text, std::forward<Values>(values)...));
    }
    [[nodiscard]] const std::string& name(int piece) const { return nth(in_.pieces, piece).name; }

    // Every tab, area and rivet is in one step.
    void once() {
        std::map<std::pair<Bond::Kind, int>, int> seen;
        std::set<int> pieces;
        for (const GluingStep& step : order_.steps) {
            if (!pieces.insert(step.piece).second) fault("{} has two steps", name(step.piece));
            if (step.turns.empty()) fault("{} is glued to nothing", name(step.piece));
            for (const Bond& bond : bonds_of(step)) ++seen[{bond.kind, bond.number}];
            for (const Bond& bond : step.ring) ++seen[{bond.kind, bond.number}];
        }
        std::size_t rivets = 0;
        for (const Plate& plate : in_.plates) rivets += plate.rivet && plate.parent >= 0 ? 1U : 0U;
        if (seen.size() != in_.glue.size() + in_.glued_areas.size() + rivets)
            fault("{} of {} bonds are made", seen.size(), in_.glue.size() + in_.glued_areas.size() + rivets);
        for (const auto& [bond, times] : seen) {
            if (times != 1) fault("bond {} is made {} times", bond.second, times);
        }
    }

    // What a piece is glued to hangs together with the ground, and the piece does not yet.
    void there() {
        std::vector<int> group(in_.pieces.size());
        for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<int>(i);
        for (const GluingStep& step : order_.steps) {
            for (const Bond& bond : step.ring) {
                if (piece_of(in_, bond.plate) != step.piece || piece_of(in_, bond.mate) != step.piece)
                    fault("{} has a ring of others", name(step.piece));
            }
            const int ground = nth(group, step.ground);
            if (nth(group, step.piece) == ground) fault("{} is there before its step", name(step.piece));
            for (const Bond& bond : bonds_of(step)) {
                if (piece_of(in_, bond.plate) != step.piece)
                    fault("{} is glued by what is not its own", name(step.piece));
                if (nth(group, piece_of(in_, bond.mate)) != ground)
                    fault("{} stands on {}, which is not there", name(step.piece),
                          name(piece_of(in_, bond.mate)));
            }
            const int moved = nth(group, step.piece);
            std::replace(group.begin(), group.end(), moved, ground);
        }
        std::set<int> loose;
        for (const Glue& glue : in_.glue) loose.insert(nth(group, piece_of(in_, glue.piece_plate)));
        if (loose.size() > 1) fault("{} parts are left apart", loose.size());
    }

    void sub_assemblies() {
        bool on_card = false;
        for (const GluingStep& step : order_.steps) {
            on_card = on_card || step.ground == order_.card;
            if (on_card && step.ground != order_.card) fault("{} is made too late", name(step.ground));
            if ((step.lie == Lie::loose) && step.ground == order_.card) fault("the card is loose");
        }
    }

    // Tabs are glued by the piece that has them, but for those under a plate that is laid over them. What is
    // closed onto a tab comes to it, front to front.
    void directions() {
        std::vector<Frame> frames(in_.plates.size());
        const Sweep& sweep = in_.sweep;
        const bool placed =
            place(in_, Angle::degrees(sweep.from_deg + 0.04 * (sweep.to_deg - sweep.from_deg)), frames);
        for (const GluingStep& step : order_.steps) {
            for (const Bond& bond : bonds_of(step)) {
                if (bond.kind != Bond::Kind::tab) continue;
                const Glue& glue = nth(in_.glue, bond.number);
                if (bond.theirs && !glue.on_back) fault("tab {} is glued from the wrong side", glue.label);
                if ((bond.theirs ? glue.base_plate : glue.piece_plate) != bond.plate)
                    fault("tab {} is on another plate", glue.label);
            }
            if (step.turns.front().touch != Touch::press) fault("{} is not pressed first", name(step.piece));
            for (std::size_t i = 1; i < step.turns.size() && placed; ++i) {
                if (step.turns[i].touch != Touch::close) continue;
                const Frame& a = nth(frames, step.turns.front().bonds.front().mate);
                const Frame& b = nth(frames, step.turns[i].bonds.front().mate);
                if (dot(a.normal(), b.normal()) > -0.9)
                    fault("{} is closed on what does not come to it", name(step.piece));
            }
        }
    }

    // The piece on the card that a piece comes with.
    [[nodiscard]] int on_card(int piece) const {
        while (piece != order_.card && nth(at_, piece) >= 0 &&
               nth(order_.steps, nth(at_, piece)).ground != order_.card)
            piece = nth(order_.steps, nth(at_, piece)).ground;
        return piece;
    }

    [[nodiscard]] std::vector<Vec2> places(const Glue& glue) const {
        const Vec2 along = unit(glue.on_base.b - glue.on_base.a);
        const Vec2 in = 3.0 * (glue.on_back ? left_of(along) : right_of(along));
        std::vector<Vec2> all;
        for (const double t : {0.15, 0.5, 0.85}) all.push_back(lerp(glue.on_base.a, glue.on_base.b, t) + in);
        return all;
    }

    // Whether most places of the tab's target are before plates that come with `other`.
    [[nodiscard]] bool hides(int other, const Glue& glue, const std::vector<Frame>& frames) const {
        const Frame& base = nth(frames, glue.base_plate);
        const Vec3 up = (glue.on_back ? -1.0 : 1.0) * base.normal();
        std::size_t hidden = 0;
        for (const Vec2 at : places(glue)) {
            const Vec3 p = base.point(at);
            bool here = false;
            for (std::size_t i = 0; i < in_.plates.size() && !here; ++i) {
                if (on_card(in_.plates[i].piece) != other) continue;
                const Frame& frame = frames[i];
                const double slope = dot(up, frame.normal());
                if (std::abs(slope) < 1e-9) continue;
                const double away = dot(frame.origin - p, frame.normal()) / slope;
                if (away < 0.06 || away > 149.0) continue;
                const Vec3 d = p + away * up - frame.origin;
                here = covers(in_.plates[i].outline, {dot(d, frame.axes[0]), dot(d, frame.axes[1])});
            }
            hidden += here ? 1U : 0U;
        }
        return 2 * hidden >= 3;
    }

    // Whether the feet of `other` on a piece go all round the points: no line through two of their ends, with
    // all ends on one side of it, has a point on its other side.
    [[nodiscard]] bool encloses(int other, int base, bool on_back, const std::vector<Vec2>& points) const {
        std::vector<Vec2> ends;
        for (const Glue& glue : in_.glue) {
            if (piece_of(in_, glue.piece_plate) != other || piece_of(in_, glue.base_plate) != base ||
                glue.on_back != on_back)
                continue;
            ends.push_back(glue.on_base.a);
            ends.push_back(glue.on_base.b);
        }
        bool has_sides = false;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            for (std::size_t k = 0; k < ends.size(); ++k) {
                const Vec2 side = ends[k] - ends[i];
                if (length(side) < 1e-6) continue;
                const bool is_edge = std::all_of(ends.begin(), ends.end(),
                                                 [&](Vec2 p) { return cross(side, p - ends[i]) >= -1e-9; });
                if (!is_edge) continue;
                has_sides = true;
                for (const Vec2 p : points) {
                    if (cross(side, p - ends[i]) < 1e-9) return false;
                }
            }
        }
        return has_sides;
    }

    // Where something stands above a target before its tab is glued, no order would have been better: what is
    // above had to come first, by what must be there and by what is above or round what.
    void in_the_way() {
        std::vector<Frame> frames(in_.plates.size());
        const Sweep& sweep = in_.sweep;
        if (!place(in_, Angle::degrees(sweep.from_deg + 0.97 * (sweep.to_deg - sweep.from_deg)), frames))
            return;
        std::map<int, std::set<int>> later;  // what had better, or must, come after
        std::vector<std::pair<int, int>> wants;
        for (const GluingStep& step : order_.steps) {
            if (step.ground != order_.card) continue;
            for (const Bond& bond : bonds_of(step)) {
                const int mate = on_card(piece_of(in_, bond.mate));
                if (mate != order_.card) later[mate].insert(step.piece);
                if (bond.kind != Bond::Kind::tab || bond.theirs) continue;
                const Glue& glue = nth(in_.glue, bond.number);
                for (const GluingStep& other : order_.steps) {
                    if (other.ground != order_.card || other.piece == step.piece || other.piece == mate)
                        continue;
                    if (!hides(other.piece, glue, frames)) continue;
                    later[step.piece].insert(other.piece);
                    wants.emplace_back(step.piece, other.piece);
                }
            }
            std::map<std::pair<int, bool>, std::vector<Vec2>> feet;
            for (const Bond& bond : bonds_of(step)) {
                if (bond.kind != Bond::Kind::tab || bond.theirs) continue;
                const Glue& glue = nth(in_.glue, bond.number);
                std::vector<Vec2>& of_side = feet[{piece_of(in_, glue.base_plate), glue.on_back}];
                for (const Vec2 p : places(glue)) of_side.push_back(p);
            }
            for (const auto& [side, points] : feet) {
                for (const GluingStep& other : order_.steps) {
                    if (other.ground != order_.card || other.piece == step.piece) continue;
                    if (!encloses(other.piece, side.first, side.second, points)) continue;
                    later[step.piece].insert(other.piece);
                    wants.emplace_back(step.piece, other.piece);
                }
            }
        }
        looked_at_ = wants.size();
        add_flat(frames, later);
        for (const auto& [first, then] : wants) {
            if (nth(at_, first) < nth(at_, then) || leads(later, then, first)) continue;
            fault("{} is in the way of {}, and need not have been there", name(then), name(first));
        }
    }

    // Whether a point of one plate's page lies on the paper of another plate in the same plane.
    [[nodiscard]] bool is_on(std::size_t flat, int page, Vec2 p, const std::vector<Frame>& frames) const {
        const Frame& frame = frames[flat];
        const Vec3 d = nth(frames, page).point(p) - frame.origin;
        return covers(in_.plates[flat].outline, {dot(d, frame.axes[0]), dot(d, frame.axes[1])});
    }

    // Flat pieces must be there before what has a tab on them, and over the flat ones named before.
    void add_flat(const std::vector<Frame>& frames, std::map<int, std::set<int>>& later) const {
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            const Plate& flat = in_.plates[i];
            if ((flat.lying != Lying::on_front && flat.lying != Lying::on_back) || flat.rivet) continue;
            const bool on_back = flat.lying == Lying::on_back;
            for (const Glue& glue : in_.glue) {
                if (glue.base_plate != flat.parent || glue.on_back != on_back) continue;
                const Vec2 aside = left_of(unit(glue.on_base.b - glue.on_base.a));
                bool touched = false;
                for (int k = 0; k <= 40; ++k) {
                    for (const double off : {-3.0, -0.6, 0.6, 3.0}) {
                        const Vec2 p = lerp(glue.on_base.a, glue.on_base.b, k / 40.0) + off * aside;
                        touched = touched || is_on(i, flat.parent, p, frames);
                    }
                }
                const int then = on_card(piece_of(in_, glue.piece_plate));
                if (touched && then != on_card(flat.piece)) later[on_card(flat.piece)].insert(then);
            }
            for (std::size_t k = i + 1; k < in_.plates.size(); ++k) {
                const Plate& other = in_.plates[k];
                if (other.parent != flat.parent || other.lying != flat.lying || other.piece <= flat.piece)
                    continue;
                const Box box = bounds(other.outline.outer);
                bool shared = false;
                for (int x = 0; x < 24; ++x) {
                    for (int y = 0; y < 24; ++y) {
                        const Vec2 p{box.min.x + (x + 0.5) / 24 * box.width(),
                                     box.min.y + (y + 0.5) / 24 * box.height()};
                        shared =
                            shared || (covers(other.outline, p) && is_on(i, static_cast<int>(k), p, frames));
                    }
                }
                if (shared && on_card(other.piece) != on_card(flat.piece))
                    later[on_card(flat.piece)].insert(on_card(other.piece));
            }
        }
    }

    static bool leads(const std::map<int, std::set<int>>& later, int from, int to) {
        std::set<int> seen{from};
        std::vector<int> waiting{from};
        while (!waiting.empty()) {
            const int one = waiting.back();
            waiting.pop_back();
            const auto next = later.find(one);
            if (next == later.end()) continue;
            for (const int other : next->second) {
                if (other == to) return true;
                if (seen.insert(other).second) waiting.push_back(other);
            }
        }
        return false;
    }

    const Assembly& in_;
    const GluingOrder& order_;
    std::vector<int> at_;  // of each piece its step; -1: none
    std::vector<std::string> faults_;

 public:
    std::size_t looked_at_ = 0;
};

inline std::string text_of(const std::vector<std::string>& faults) {
    return fmt::format("{}", fmt::join(faults, "\n"));
}

}  // namespace popup::test
