#include "output/book/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/nth.h"
#include "base/text/numbers.h"
#include "popup/motion.h"

namespace popup::book {
namespace {

constexpr double kFlatDeg = 0.5;       // what is folded by less is flat
constexpr std::size_t kMostFolds = 8;  // that are told one by one
constexpr std::size_t kMostWays = 4;
constexpr double kAsLongMm = 1e-6;  // the first of lines as long is measured from

// "left and right, right and back": pairs, of which the last is not set off by a further "and".
std::string joined_pairs(const std::vector<std::string>& pairs) {
    return fmt::format("{}", fmt::join(pairs, ", "));
}

// How far a fold is folded: "folded flat" would be read as either of the ends.
std::string bent_text(double deg) {
    if (deg < kFlatDeg) return "not folded";
    if (deg > 180.0 - kFlatDeg) return "folded right over";
    return fmt::format("folded by {}°", number_text(std::round(deg), 0));
}

}  // namespace

std::string counted(std::size_t count, std::string_view one, std::string_view more) {
    return fmt::format("{} {}", count, count == 1 ? one : more);
}

std::string listed(const std::vector<std::string>& items, std::size_t most) {
    std::string text;
    const std::size_t shown = items.size() > most + 1 ? most : items.size();
    for (std::size_t i = 0; i < shown; ++i) {
        if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
        text += items[i];
    }
    if (shown < items.size()) text += fmt::format(" and {} more", items.size() - shown);
    return text;
}

std::vector<bool> tabs_on_sheets(const SceneCard& card) {
    const Assembly& in = *card.assembly;
    std::vector<bool> there(in.glue.size(), card.pattern == nullptr);
    if (card.pattern == nullptr) return there;
    std::set<std::pair<int, std::string_view>> targets;
    for (const PatternPiece& piece : card.pattern->pieces) {
        for (const GlueTarget& target : piece.targets) targets.emplace(target.plate, target.label);
    }
    for (std::size_t i = 0; i < in.glue.size(); ++i)
        there[i] = targets.contains({in.glue[i].base_plate, in.glue[i].label});
    return there;
}

Words::Words(const SceneCard& card, bool backs_are_marked)
    : in_(*card.assembly), backs_are_marked_(backs_are_marked), numbers_(in_.pieces.size()) {
    const auto number = [&](int plate, const std::string& label) {
        nth(numbers_, nth(in_.plates, plate).piece) = label.substr(0, label.find_first_not_of("0123456789"));
    };
    for (const Glue& glue : in_.glue) number(glue.piece_plate, glue.label);
    for (const GluedArea& glued : in_.glued_areas) number(glued.plate, glued.label);
    if (!moves(in_)) return;
    const auto at = [&](double share, std::vector<Frame>& frames) {
        frames.resize(in_.plates.size());
        const Sweep& sweep = in_.sweep;
        if (!place(in_, Angle::degrees(sweep.from_deg + share * (sweep.to_deg - sweep.from_deg)), frames))
            frames.clear();
    };
    at(1.0, open_);
    at(0.5, half_);
    at(0.0, closed_);
}

std::string Words::number(int piece) const { return nth(numbers_, piece); }

std::string Words::piece(int piece) const {
    const std::string& name = nth(in_.pieces, piece).name;
    const std::string& number = nth(numbers_, piece);
    return number.empty() ? name : fmt::format("{}. {}", number, name);
}

std::string Words::plate(int plate) const {
    const Plate& one = nth(in_.plates, plate);
    const Piece& piece = nth(in_.pieces, one.piece);
    if (piece.plates.size() == 1) return piece.name;
    const std::string start = piece.name + "/";
    if (one.name.starts_with(start))
        return fmt::format("the {} part of {}", one.name.substr(start.size()), piece.name);
    return one.name;
}

std::string Words::label(const Bond& bond) const {
    switch (bond.kind) {
        case Bond::Kind::tab:
            return nth(in_.glue, bond.number).label;
        case Bond::Kind::area:
            return nth(in_.glued_areas, bond.number).label;
        case Bond::Kind::rivet:
            break;
    }
    return {};
}

std::vector<Words::FoldWay> Words::fold_ways(int piece) const {
    std::vector<FoldWay> ways;
    if (open_.empty() || half_.empty() || closed_.empty()) return ways;
    for (std::size_t i = 0; i < in_.hinges.size(); ++i) {
        const Hinge& hinge = in_.hinges[i];
        if (hinge.glued || nth(in_.plates, hinge.a).piece != piece || nth(in_.plates, hinge.b).piece != piece)
            continue;
        const auto folded = [&](const std::vector<Frame>& frames) {
            return folded_deg(hinge, nth(frames, hinge.a), nth(frames, hinge.b));
        };
        const FoldWay way{static_cast<int>(i), folded(half_) < 0.0, std::abs(folded(open_)),
                          std::abs(folded(closed_))};
        if (std::max({way.open_deg, way.closed_deg, std::abs(folded(half_))}) > kFlatDeg) ways.push_back(way);
    }
    return ways;
}

std::vector<std::string> Words::folds(int piece) const {
    const std::vector<FoldWay> ways = fold_ways(piece);
    if (ways.empty()) return {};
    const std::string start = nth(in_.pieces, piece).name + "/";
    const auto part = [&](int plate) {
        const std::string& name = nth(in_.plates, plate).name;
        return name.starts_with(start) ? name.substr(start.size()) : name;
    };
    // What is said of folds alike is said once, in the order of the first.
    std::vector<std::pair<std::string, std::vector<std::string>>> alike;
    for (const FoldWay& way : ways) {
        const Hinge& hinge = nth(in_.hinges, way.hinge);
        const std::string open = bent_text(way.open_deg) + " on the open card";
        const std::string closed = bent_text(way.closed_deg) + " on the closed card";
        const std::string how = fmt::format("{} {}, {}", way.mountain ? "mountain" : "valley", closed, open);
        const std::string between = fmt::format("{} and {}", part(hinge.a), part(hinge.b));
        const auto same =
            std::find_if(alike.begin(), alike.end(), [&how](const auto& one) { return one.first == how; });
        if (same != alike.end()) {
            same->second.push_back(between);
        } else {
            alike.push_back({how, {between}});
        }
    }
    if (alike.size() > kMostWays || ways.size() > kMostFolds)
        return {
            fmt::format("Crease all folds sharply, {}: mountains (in the drawing blue, long and short "
                        "dashes) away from you, "
                        "valleys (magenta, even dashes) towards you.",
                        fold_count(piece))};
    std::vector<std::string> said;
    for (const auto& [how, where] : alike) {
        const std::size_t space = how.find(' ');
        said.push_back(
            fmt::format("{} {} between {}:{}.", how.substr(0, space) == "valley" ? "Valley" : "Mountain",
                        where.size() == 1 ? "fold" : "folds", joined_pairs(where), how.substr(space)));
    }
    return said;
}

std::string Words::fold_count(int piece) const {
    std::size_t mountains = 0;
    std::size_t valleys = 0;
    for (const Line& line : in_.lines) {
        if (line.piece != piece) continue;
        if (line.kind == LineKind::mountain) ++mountains;
        if (line.kind == LineKind::valley) ++valleys;
    }
    std::vector<std::string> all;
    if (mountains > 0) all.push_back(fmt::format("{} mountain", mountains));
    if (valleys > 0) all.push_back(fmt::format("{} valley", valleys));
    return listed(all);
}

std::string Words::labels(const std::vector<Bond>& bonds) const {
    std::vector<std::string> all;
    all.reserve(bonds.size());
    for (const Bond& bond : bonds) all.push_back(label(bond));
    return listed(all, bonds.size());
}

std::string Words::measured(int plate, const std::vector<Vec2>& points) const {
    const Plate& on = nth(in_.plates, plate);
    const std::string start = nth(in_.pieces, on.piece).name + "/";
    const auto part = [&](int one) {
        const std::string& name = nth(in_.plates, one).name;
        return name.starts_with(start) ? name.substr(start.size()) : name;
    };
    Segment line{};
    std::string fold;
    const auto take = [&](const Segment& one, std::string name) {
        if (distance(one.a, one.b) <= distance(line.a, line.b) + kAsLongMm) return;
        line = one;
        fold = std::move(name);
    };
    for (const Hinge& hinge : in_.hinges) {
        if (hinge.glued || (hinge.a != plate && hinge.b != plate)) continue;
        if (nth(in_.plates, hinge.a).piece != nth(in_.plates, hinge.b).piece) continue;
        take(hinge.a == plate ? hinge.a_line : hinge.b_line,
             fmt::format("fold between {} and {}", part(hinge.a), part(hinge.b)));
    }
    if (fold.empty()) {
        const Ring& outer = on.outline.outer;
        for (std::size_t i = 0; i < outer.size(); ++i)
            take({outer[i], outer[(i + 1) % outer.size()]}, "longest edge");
    }
    // From its upper end, or from its left one where it lies.
    const bool upright = std::abs(line.a.y - line.b.y) >= std::abs(line.a.x - line.b.x);
    if (upright ? line.a.y < line.b.y : line.a.x > line.b.x) std::swap(line.a, line.b);
    const Vec2 along = unit(line.b - line.a);
    double near = HUGE_VAL, far = 0.0, from = HUGE_VAL, to = -HUGE_VAL;
    for (const Vec2 p : points) {
        const double away = std::abs(cross(along, p - line.a));
        const double down = dot(along, p - line.a);
        near = std::min(near, away);
        far = std::max(far, away);
        from = std::min(from, down);
        to = std::max(to, down);
    }
    const auto range = [](double lo, double hi) {
        const std::string low = number_text(lo, 1);
        const std::string high = number_text(hi, 1);
        return low == high ? low + " mm" : fmt::format("{} to {} mm", low, high);
    };
    return fmt::format("{} away from the {}, and {} {} of it, as it is printed", range(near, far), fold,
                       range(from, to), upright ? "below the upper end" : "from the left end");
}

// "target 2L, on the left part of page, and target 2P, on the right part of page".
std::string Words::places(const std::vector<Bond>& bonds) const {
    std::vector<std::string> all;
    for (const Bond& bond : bonds) {
        const bool unseen = bond.on_back || bond.theirs;
        all.push_back(unseen ? fmt::format("the back of {}", plate(bond.mate))
                             : fmt::format("target {} on {}", label(bond), plate(bond.mate)));
    }
    return listed(all, bonds.size());
}

void Words::press(const BondTurn& turn, std::vector<std::string>& said) const {
    const std::vector<Bond>& bonds = turn.bonds;
    const Bond& bond = bonds.front();
    switch (bond.kind) {
        case Bond::Kind::rivet:
            said.push_back(
                fmt::format("Lay the piece {} {}, its printed side {}, the round holes over each other. Push "
                            "a brad through both "
                            "and bend its legs. The piece must turn freely: glue nothing here.",
                            bond.on_back ? "behind" : "on", plate(bond.mate),
                            bond.on_back ? "towards the window" : "up"));
            return;
        case Bond::Kind::area:
            if (!bond.on_back) {
                said.push_back(
                    fmt::format("Put glue on area {} on {}, lay the piece on it and press it flat.",
                                label(bond), plate(bond.mate)));
            } else if (backs_are_marked_) {
                said.push_back(
                    fmt::format("Glue the piece on the back of {}, on area {}, which is marked "
                                "there.",
                                plate(bond.mate), label(bond)));
            } else {
                std::vector<Vec2> corners;
                for (const Polygon& part : nth(in_.glued_areas, bond.number).on_base)
                    corners.insert(corners.end(), part.outer.begin(), part.outer.end());
                said.push_back(
                    fmt::format("Glue the piece on the back of {}. These sheets do not mark area {} "
                                "there; it lies {}.",
                                plate(bond.mate), label(bond), measured(bond.mate, corners)));
            }
            return;
        case Bond::Kind::tab:
            said.push_back(fmt::format("Put glue on {} {}, and press {} onto {}.",
                                       bonds.size() == 1 ? "tab" : "tabs", labels(bonds),
                                       bonds.size() == 1 ? "it" : "them", places(bonds)));
            return;
    }
}

void Words::then(const GluingStep& step, const BondTurn& turn, std::vector<std::string>& said) const {
    const std::vector<Bond>& bonds = turn.bonds;
    const char* const tabs = bonds.size() == 1 ? "tab" : "tabs";
    if (bonds.front().theirs) {
        const int other = nth(in_.plates, bonds.front().mate).piece;
        said.push_back(
            fmt::format("Put glue on {} {} of {}, and let {} down on it, so that the tab is under it, along "
                        "the fold.",
                        tabs, labels(bonds), piece(other), plate(bonds.front().plate)));
        return;
    }
    if (turn.touch == Touch::close) {
        const bool loose = step.lie == Lie::loose || step.lie == Lie::turned;
        said.push_back(fmt::format(
            "When that holds, fold the piece flat onto that side, so that {} {} face{} up. Put glue on {}, "
            "{} and press: "
            "the glue finds {}. Open it again when it holds.",
            tabs, labels(bonds), bonds.size() == 1 ? "s" : "", bonds.size() == 1 ? "it" : "them",
            loose ? fmt::format("fold {} together over it", piece(step.ground)) : "close the card over it",
            places(bonds)));
        return;
    }
    said.push_back(
        fmt::format("Put glue on {} {}, bend the piece until {} on {}, and hold until the glue does.", tabs,
                    labels(bonds), bonds.size() == 1 ? "it lies" : "they lie", places(bonds)));
}

std::vector<std::string> Words::actions(const GluingStep& step) const {
    std::vector<std::string> said;
    if (!step.ring.empty()) {
        const Bond& bond = step.ring.front();
        said.push_back(
            fmt::format("Bend the piece into a ring: put glue on {} {} and press it behind {}, edge on edge. "
                        "Press the ring flat while the glue sets.",
                        step.ring.size() == 1 ? "tab" : "tabs", labels(step.ring), plate(bond.mate)));
    }
    // What is laid over waiting tabs is, before the card is closed on the rest.
    std::vector<const BondTurn*> turns;
    for (const BondTurn& turn : step.turns) turns.push_back(&turn);
    if (!turns.empty()) {
        std::stable_partition(turns.begin() + 1, turns.end(),
                              [](const BondTurn* turn) { return turn->bonds.front().theirs; });
    }
    for (std::size_t i = 0; i < turns.size(); ++i) {
        if (i == 0 && !turns[i]->bonds.front().theirs) {
            press(*turns[i], said);
        } else {
            then(step, *turns[i], said);
        }
    }
    return said;
}

std::string Words::left_free(int piece, const std::vector<Bond>& later) const {
    std::vector<std::string> labels;
    std::vector<std::string> names;
    for (const Bond& bond : later) {
        if (!bond.theirs || nth(in_.plates, bond.mate).piece != piece) continue;
        labels.push_back(label(bond));
        const std::string name = this->piece(nth(in_.plates, bond.plate).piece);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    if (labels.empty()) return {};
    return fmt::format("Leave {} {} free: {} {} on {} later.", labels.size() == 1 ? "tab" : "tabs",
                       listed(labels), listed(names), names.size() == 1 ? "comes" : "come",
                       labels.size() == 1 ? "it" : "them");
}

std::string Words::lies(const GluingStep& step, int card) const {
    const std::string ground = piece(step.ground);
    switch (step.lie) {
        case Lie::loose:
            return fmt::format("Piece {} lies on the table, printed side up.", ground);
        case Lie::turned:
            return step.ground == card ? std::string("Turn the card over: it lies open, its back up.")
                                       : fmt::format("Turn piece {} over: its back is up.", ground);
        case Lie::half_open:
            return "Hold the card half open.";
        case Lie::open:
            break;
    }
    return "The card lies open on the table.";
}

}  // namespace popup::book
