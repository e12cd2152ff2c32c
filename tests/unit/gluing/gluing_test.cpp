// The order of gluing, held against a look of its own at what is there and what is in the way.
#include "popup/gluing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/nth.h"
#include "gluing/circles.h"
#include "popup/compile.h"
#include "popup/motion.h"
#include "support/designs.h"
#include "support/sanitized.h"

namespace popup {
namespace {

int piece_of(const Assembly& in, int plate) { return in.plates.at(static_cast<std::size_t>(plate)).piece; }

std::vector<Bond> bonds_of(const GluingStep& step) {
    std::vector<Bond> bonds;
    for (const BondTurn& turn : step.turns) bonds.insert(bonds.end(), turn.bonds.begin(), turn.bonds.end());
    return bonds;
}

// Even-odd, on the plate's page.
bool covers(const Polygon& polygon, Vec2 p) {
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

std::string text_of(const std::vector<std::string>& faults) {
    return fmt::format("{}", fmt::join(faults, "\n"));
}

Assembly sample(const std::string& name) {
    Diagnostics diagnostics("samples");
    std::optional<Source> source =
        read_source(std::string(POPUP_SOURCE_DIR) + "/samples/" + name, diagnostics);
    POPUP_INVARIANT(source.has_value());
    CompileOptions options;
    options.until = Stage::motion;
    options.motion.examine = name.ends_with(".svg");
    options.read.drawing.as = name.ends_with(".svg") ? DrawnAs::folded : DrawnAs::parts;
    Compilation run = compile({std::move(*source)}, options, {});
    return std::move(*run.designs.front().assembly);
}

std::vector<std::string> told(const Assembly& in, const GluingOrder& order) {
    std::vector<std::string> lines;
    for (const GluingStep& step : order.steps) {
        std::string line =
            fmt::format("{} on {}, {}", nth(in.pieces, step.piece).name, nth(in.pieces, step.ground).name,
                        kLieNames.at(static_cast<std::size_t>(step.lie)));
        const auto label = [&](const Bond& bond) {
            return bond.kind == Bond::Kind::tab    ? nth(in.glue, bond.number).label
                   : bond.kind == Bond::Kind::area ? nth(in.glued_areas, bond.number).label
                                                   : std::string("rivet");
        };
        for (const Bond& bond : step.ring) line += " ring " + label(bond);
        for (const BondTurn& turn : step.turns) {
            line += fmt::format(" {}", kTouchNames.at(static_cast<std::size_t>(turn.touch)));
            for (const Bond& bond : turn.bonds) line += " " + label(bond) + (bond.theirs ? " (theirs)" : "");
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

using Lines = std::vector<std::string>;

TEST(Gluing, OrdersOfGeneratedCardsWork) {
    std::size_t steps = 0;
    std::size_t wants = 0;
    std::size_t loose = 0;
    for (std::uint64_t seed = 1; seed <= test::sanitized_count<std::uint64_t>(120); ++seed) {
        const test::Built built =
            test::build(seed % 3 == 0 ? test::generate(seed, 16) : test::generate_any(seed, 18));
        ASSERT_TRUE(built.assembly) << seed;
        const GluingOrder order = gluing_order(*built.assembly);
        Look look(*built.assembly, order);
        EXPECT_EQ(text_of(look.faults()), "") << "seed " << seed;
        steps += order.steps.size();
        wants += look.looked_at_;
        for (const GluingStep& step : order.steps) loose += step.lie == Lie::loose ? 1U : 0U;
    }
    // They are worth looking at.
    EXPECT_GT(steps, test::sanitized_count(500U));
    EXPECT_GT(wants, test::sanitized_count(100U));
    EXPECT_GT(loose, test::sanitized_count(50U));
}

TEST(Gluing, OrdersOfTowersWork) {
    for (std::uint64_t seed = 1; seed <= test::sanitized_count<std::uint64_t>(20); ++seed) {
        const test::Built built = test::build(test::generate_tower(seed, 9));
        ASSERT_TRUE(built.assembly) << seed;
        EXPECT_EQ(text_of(Look(*built.assembly, gluing_order(*built.assembly)).faults()), "")
            << "seed " << seed;
    }
}

TEST(Gluing, OrdersOfSamplesWork) {
    for (const char* name :
         {"mountains.xml", "house.xml", "boat.xml", "butterfly.xml", "flower.xml", "tent-village.xml",
          "cascade.xml", "layers.xml", "tree.xml", "whale.xml", "harbour.xml", "terraces.xml", "cake.xml",
          "swallow.xml", "high-street.xml", "stage.xml", "seasons.xml", "creature.xml", "valley.fl"}) {
        const Assembly in = sample(name);
        const GluingOrder order = gluing_order(in);
        EXPECT_FALSE(order.steps.empty()) << name;
        EXPECT_EQ(text_of(Look(in, order).faults()), "") << name;
    }
}

// The look finds what is wrong.
TEST(Gluing, TheLookSeesWrongOrders) {
    const Assembly in = sample("high-street.xml");
    const GluingOrder right = gluing_order(in);
    const auto faults = [&](const GluingOrder& order) { return text_of(Look(in, order).faults()); };
    GluingOrder wrong = right;
    std::reverse(wrong.steps.begin(), wrong.steps.end());
    EXPECT_NE(faults(wrong).find("which is not there"), std::string::npos);
    wrong = right;
    wrong.steps.pop_back();
    EXPECT_NE(faults(wrong).find("bonds are made"), std::string::npos);
    wrong = right;
    std::rotate(wrong.steps.begin(), wrong.steps.begin() + 1, wrong.steps.end());
    EXPECT_NE(faults(wrong).find("too late"), std::string::npos);

    const Assembly cake = sample("cake.xml");
    GluingOrder outside_in = gluing_order(cake);
    std::swap(outside_in.steps.end()[-1], outside_in.steps.end()[-2]);
    EXPECT_NE(text_of(Look(cake, outside_in).faults()).find("low-top is in the way of low-wall"),
              std::string::npos);
}

// A pillar stands before the top is laid on it; a box is a ring first; what stands on a top is glued to it on
// the table.
TEST(Gluing, ACakeIsMadeFromItsTop) {
    const Assembly in = sample("cake.xml");
    EXPECT_EQ(
        told(in, gluing_order(in)),
        (Lines{"candles on high-top, loose press 7L close 7R",
               "high-top/pillar on middle-top, loose press 6P",
               "high-wall on middle-top, loose ring 5B press 5L close 5R",
               "high-top on middle-top, loose press 6L close 6R bend 6T (theirs)",
               "middle-top/pillar on low-top, loose press 4P",
               "middle-wall on low-top, loose ring 3B press 3L close 3R",
               "middle-top on low-top, loose press 4L close 4R bend 4T (theirs)",
               "low-top/pillar on page, open press 2P", "low-wall on page, open ring 1B press 1L close 1R",
               "low-top on page, open press 2L close 2R bend 2T (theirs)"}));
}

// The chimney stands on the roof's ridge, which does not close on it; trees stand on the roof's seams and
// come when it is there.
TEST(Gluing, AHouseIsMadeFromInsideOut) {
    const Assembly in = sample("house.xml");
    EXPECT_EQ(
        told(in, gluing_order(in)),
        (Lines{"chimney on roof, loose press 3L bend 3R", "tree-behind on page, open press 6L close 6R",
               "front on page, open press 1L close 1R", "roof on page, open press 2L close 2R",
               "tree-left on page, open press 4L close 4R", "tree-right on page, open press 5R close 5L"}));
}

TEST(Gluing, BacksComeFirst) {
    const Assembly in = sample("seasons.xml");
    const GluingOrder order = gluing_order(in);
    bool front = false;
    for (const GluingStep& step : order.steps) {
        if (step.ground == order.card) break;
        front = front || step.lie == Lie::loose;
        EXPECT_FALSE(front && step.lie == Lie::turned) << nth(in.pieces, step.piece).name;
    }
    EXPECT_TRUE(front);
    EXPECT_EQ(told(in, {order.card, {order.steps.end() - 2, order.steps.end()}, order.bearers}),
              (Lines{"season on page, turned press rivet", "tree on page, open press 1L close 1R"}));
}

// A square of 2 half on each side of (x, 0), glued flat on the right page.
std::string flat_piece(const std::string& id, double x, double half) {
    return fmt::format(
        "<structure type='attached-plane' id='{0}'><outerpoints><point x='{1}' y='-10'/><point x='{1}' "
        "y='10'/><point x='0' y='-10'/><point x='0' y='10'/></outerpoints><outline d='M -{2} -{2} H {2} V "
        "{2} "
        "H -{2} Z'/><parentplate x='{1}' y='0'/></structure>",
        id, x, half);
}
// Its seams are `out` beside the gutter.
std::string tent_over(const std::string& id, double out, double wide) {
    return fmt::format(
        "<structure type='tent' id='{0}'><outerpoints><point x='-{1}' y='-15'/><point x='-{1}' "
        "y='15'/><point "
        "x='{1}' y='-15'/><point x='{1}' y='15'/><point x='-{2}' y='-15'/><point x='-{2}' y='15'/><point "
        "x='{2}' y='-15'/><point x='{2}' y='15'/></outerpoints><parentfold on='gutter'/></structure>",
        id, out, wide);
}

Lines pieces_in_order(const GluingOrder& order, const Assembly& in) {
    Lines names;
    for (const GluingStep& step : order.steps) names.push_back(nth(in.pieces, step.piece).name);
    return names;
}

// Nothing can be laid down round the wall of a tent, whichever is named first.
TEST(Gluing, WhatLiesFlatIsThereBeforeWhatRisesOutOfIt) {
    const std::string flat = flat_piece("flat", 40, 25);
    const std::string tent = tent_over("tent", 30, 40);
    for (const std::string& card : {flat + tent, tent + flat}) {
        const test::FromXml built = test::from_xml(card);
        ASSERT_TRUE(built.assembly) << built.text;
        const GluingOrder order = gluing_order(*built.assembly);
        EXPECT_EQ(pieces_in_order(order, *built.assembly), (Lines{"flat", "tent"}));
        const GluingStep& step = order.steps.back();
        EXPECT_TRUE(step.under.empty());
        ASSERT_EQ(step.onto.size(), 1U);
        EXPECT_TRUE(nth(built.assembly->glue, step.onto[0].first.number).label.ends_with("R"));
        EXPECT_EQ(step.onto[0].second, order.steps.front().piece);
    }
}

// The tab of a tent is folded inwards, onto what lies below the tent and ends at its wall.
TEST(Gluing, AFlatPieceBelowATentIsThereBeforeIt) {
    const test::FromXml built = test::from_xml(flat_piece("flat", 17.5, 12.5) + tent_over("tent", 30, 40));
    ASSERT_TRUE(built.assembly) << built.text;
    const GluingOrder order = gluing_order(*built.assembly);
    EXPECT_EQ(pieces_in_order(order, *built.assembly), (Lines{"flat", "tent"}));
    EXPECT_EQ(order.steps.back().onto.size(), 1U);
    EXPECT_TRUE(order.steps.front().under.empty());
}

TEST(Gluing, AFlatPieceBesideATentIsInNobodysWay) {
    const test::FromXml built = test::from_xml(flat_piece("flat", 55, 24) + tent_over("tent", 30, 40));
    ASSERT_TRUE(built.assembly) << built.text;
    for (const GluingStep& step : gluing_order(*built.assembly).steps) {
        EXPECT_TRUE(step.onto.empty());
        EXPECT_TRUE(step.under.empty());
    }
}

// What is named later is seen, as in the model, be it large or small.
TEST(Gluing, OfFlatPiecesTheOneNamedFirstIsBeneath) {
    const auto order_of = [](const std::string& card) {
        const test::FromXml built = test::from_xml(card);
        EXPECT_TRUE(built.assembly) << built.text;
        return pieces_in_order(gluing_order(*built.assembly), *built.assembly);
    };
    const std::string small = flat_piece("small", 50, 10);
    const std::string large = flat_piece("large", 55, 20);
    EXPECT_EQ(order_of(large + small), (Lines{"large", "small"}));
    EXPECT_EQ(order_of(small + large), (Lines{"small", "large"}));
    // Apart from one another the small one is first.
    EXPECT_EQ(order_of(flat_piece("large", 30, 20) + flat_piece("small", 70, 10)), (Lines{"small", "large"}));
}

// The layer rises out of the first, and the second lies over that: before, the first came last.
TEST(Gluing, ALayerIsGluedOnFlatPiecesThatLieOverOneAnother) {
    const std::string layer = tent_over("layer", 45, 45);
    const test::FromXml built = test::from_xml(flat_piece("a", 50, 15) + flat_piece("b", 60, 15) +
                                               "<structure type='layer'" + layer.substr(22));
    ASSERT_TRUE(built.assembly) << built.text;
    EXPECT_EQ(pieces_in_order(gluing_order(*built.assembly), *built.assembly), (Lines{"a", "b", "layer"}));
}

TEST(Gluing, IsTheSameEachTime) {
    const Assembly in = sample("high-street.xml");
    EXPECT_EQ(told(in, gluing_order(in)), told(in, gluing_order(in)));
}

TEST(Gluing, NothingIsGluedOfOneSheet) {
    EXPECT_TRUE(gluing_order(sample("castle.xml")).steps.empty());
    EXPECT_TRUE(gluing_order({}).steps.empty());
}

// Two pieces that each have a tab on the other, as a written assembly may: the first bears the second.
TEST(Gluing, ACircleIsBrokenAtItsFirst) {
    Assembly in;
    for (const char* name : {"page", "a", "b"}) {
        Plate plate;
        plate.name = name;
        plate.piece = static_cast<int>(in.pieces.size());
        plate.outline = {{{0, 0}, {40, 0}, {40, 40}, {0, 40}}, {}};
        in.pieces.push_back({name, {plate.piece}});
        in.plates.push_back(plate);
    }
    const auto glue = [&](int piece, int base, const char* label) {
        Glue one;
        one.piece_plate = piece;
        one.base_plate = base;
        one.on_piece = one.on_base = {{0, 0}, {0, 40}};
        one.label = label;
        in.glue.push_back(one);
    };
    glue(1, 2, "1L");
    glue(2, 1, "2L");
    glue(1, 0, "1R");
    EXPECT_EQ(told(in, gluing_order(in)),
              (Lines{"b on a, loose press 2L bend 1L (theirs)", "a on page, open press 1R"}));
}

TEST(Ordered, KeepsWhatItMustAndTheRestByRank) {
    Wants wants;
    wants.must[3] = {5};
    wants.wants[4] = {2};
    EXPECT_EQ(ordered({4, 3, 2, 5}, wants), (std::vector<int>{2, 4, 5, 3}));
    // 1 and 2 want each other to come first, and 2 must come before 3, which 1 wants to follow.
    Wants round;
    round.wants[1] = {2, 3};
    round.wants[2] = {1};
    round.must[3] = {2};
    EXPECT_EQ(ordered({1, 2, 3, 0}, round), (std::vector<int>{2, 3, 1, 0}));
}

TEST(PushedOut, ByLevels) {
    const Assembly in = sample("castle.xml");
    const std::vector<PushedOut> all = pushed_out(in);
    EXPECT_EQ(all.size(), 30U);
    EXPECT_EQ(all.front().name, "keep");
    EXPECT_EQ(all.back().level, 3);
    EXPECT_EQ(all.front().plates.size(), 2U);
    EXPECT_TRUE(pushed_out(sample("folded/carton.svg")).empty());
}

TEST(FoldingSteps, OfACartonInOrder) {
    const Assembly in = sample("folded/carton.svg");
    const std::vector<FoldingStep> steps = folding_steps(in);
    ASSERT_EQ(steps.size(), 2U);
    EXPECT_EQ(steps[0].hinges.size() + steps[1].hinges.size(), 12U);
    EXPECT_EQ(steps[0].from_deg, 180.0);
    EXPECT_EQ(steps[0].to_deg, steps[1].from_deg);
    EXPECT_EQ(steps[1].to_deg, 0.0);
    EXPECT_EQ(steps[1].plates.size(), 5U);
    EXPECT_TRUE(folding_steps(sample("castle.xml")).empty());
    EXPECT_EQ(folding_steps(sample("folded/bowl.svg")).size(), 1U);
}

// A gutter is a valley, and the middle of a step a mountain.
TEST(FoldedDeg, SaysWhichWay) {
    const Assembly in = sample("castle.xml");
    std::vector<Frame> frames(in.plates.size());
    ASSERT_TRUE(place(in, Angle::degrees(90), frames));
    const auto deg = [&](std::size_t hinge) {
        const Hinge& one = in.hinges.at(hinge);
        return folded_deg(one, nth(frames, one.a), nth(frames, one.b));
    };
    EXPECT_NEAR(deg(0), 90.0, 1e-9);
    EXPECT_NEAR(deg(2), -90.0, 1e-9);
    ASSERT_TRUE(place(in, Angle::degrees(180), frames));
    EXPECT_NEAR(deg(0), 0.0, 1e-9);
}

}  // namespace
}  // namespace popup
