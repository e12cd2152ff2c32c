#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "folded/carton/rough.h"
#include "popup/refinement.h"

namespace popup {
namespace {

using folded::Closed;
using folded::CornerOf;
using folded::Fold;
using folded::FoldedState;
using folded::PanelJoin;
using folded::RoughShape;

constexpr double kPapersMm = 50.0;
constexpr double kNearShare = 0.1;      // of the sheet
constexpr double kEqualLengths = 0.01;  // of the longer edge
constexpr double kCornerTurn = 0.26;    // sine: an outline that turns by less has no corner
constexpr double kMetMm = 0.01;
constexpr double kLeftShare = 0.05;    // of what is near: what leaves more open is not suggested
constexpr double kHardlyNearer = 0.9;  // of what is apart: what leaves more is not suggested
constexpr double kFrontsAlike = 0.5;   // the paper's
constexpr double kFrontsNearlyOne = 0.85;
constexpr double kParallelFaces = 0.999;    // cosine of panels that lie on each other
constexpr std::size_t kMostPairs = 20'000;  // the nearest ones are looked at
// So often may a panel be moved a step to find out what joins leave, all panels and joins together: of what
// stands in long rows, near one another, and of nets that fold as one there is no end else.
constexpr std::size_t kMostMoved = 200'000;

bool are_equal(double a, double b) { return std::abs(a - b) <= kEqualLengths * std::max(a, b); }

// A corner in space, with all panels that share it.
struct Spot {
    std::vector<CornerOf> of;   // sorted
    std::vector<double> edges;  // lengths of the edges that end there, ascending
    Vec3 at;
    std::vector<int> rigid;  // panels that it never moves against: its own, and those across folds on whose
                             // ends it lies
    [[nodiscard]] bool shares_panel(const Spot& other) const {
        return std::any_of(of.begin(), of.end(), [&](const CornerOf& a) {
            return std::any_of(other.of.begin(), other.of.end(),
                               [&](const CornerOf& b) { return a.panel == b.panel; });
        });
    }
    // Whether the distance to another is always the same.
    [[nodiscard]] bool is_rigid_with(const Spot& other) const {
        return std::any_of(rigid.begin(), rigid.end(), [&](int panel) {
            return std::find(other.rigid.begin(), other.rigid.end(), panel) != other.rigid.end();
        });
    }
    [[nodiscard]] bool has_edge_like(const Spot& other) const {
        return std::any_of(edges.begin(), edges.end(), [&](double a) {
            return std::any_of(other.edges.begin(), other.edges.end(),
                               [&](double b) { return are_equal(a, b); });
        });
    }
};

// The spots of a folded sheet, in the order of the tree.
class Spots {
 public:
    explicit Spots(const FoldedState& state) : state_(state) {
        for (const int panel : state.tree().order) add_corners(panel);
        for (const Fold& fold : state.sheet().folds) {
            for (const int corner : {fold.stretches.front().a, fold.stretches.back().b})
                unite({fold.left, corner}, {fold.right, corner});
        }
    }

    std::vector<Spot> run() {
        std::map<int, std::size_t> spot_of;  // by root
        std::vector<Spot> spots;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const auto [at, is_new] = spot_of.try_emplace(find(static_cast<int>(i)), spots.size());
            if (is_new) spots.push_back({{}, {}, state_.place(corners_[i]), {}});
            Spot& spot = spots[at->second];
            spot.of.push_back(corners_[i]);
            spot.rigid.push_back(corners_[i].panel);
            spot.edges.insert(spot.edges.end(), edges_[i].begin(), edges_[i].end());
        }
        for (const Fold& fold : state_.sheet().folds) {
            for (const int corner : {fold.stretches.front().a, fold.stretches.back().b}) {
                for (const auto& [one, other] :
                     {std::pair{fold.left, fold.right}, std::pair{fold.right, fold.left}}) {
                    const auto number = numbers_.find({one, corner});
                    if (number != numbers_.end())
                        spots[spot_of.at(find(number->second))].rigid.push_back(other);
                }
            }
        }
        for (Spot& spot : spots) {
            std::sort(spot.of.begin(), spot.of.end());
            std::sort(spot.edges.begin(), spot.edges.end());
            // The edge that two panels share is one.
            const auto same = [](double a, double b) { return b - a <= 1e-6; };
            spot.edges.erase(std::unique(spot.edges.begin(), spot.edges.end(), same), spot.edges.end());
        }
        return spots;
    }

 private:
    void add_corners(int panel) {
        const folded::Sheet& sheet = state_.sheet();
        const std::vector<int>& outer = nth(sheet.panels, panel).outer;
        std::vector<int> turns;
        for (std::size_t i = 0; i < outer.size(); ++i) {
            const Vec2 at = sheet.at(outer[i]);
            const Vec2 in = at - sheet.at(outer[(i + outer.size() - 1) % outer.size()]);
            const Vec2 out = sheet.at(outer[(i + 1) % outer.size()]) - at;
            if (std::abs(cross(in, out)) > kCornerTurn * length(in) * length(out)) turns.push_back(outer[i]);
        }
        for (std::size_t i = 0; i < turns.size(); ++i) {
            const CornerOf one{panel, turns[i]};
            if (!numbers_.try_emplace(one, static_cast<int>(corners_.size())).second) continue;
            corners_.push_back(one);
            root_.push_back(static_cast<int>(root_.size()));
            const Vec2 at = sheet.at(turns[i]);
            edges_.push_back({distance(at, sheet.at(turns[(i + 1) % turns.size()])),
                              distance(at, sheet.at(turns[(i + turns.size() - 1) % turns.size()]))});
        }
    }
    int find(int number) {
        while (nth(root_, number) != number) number = nth(root_, number) = nth(root_, nth(root_, number));
        return number;
    }
    void unite(CornerOf a, CornerOf b) {
        const auto one = numbers_.find(a);
        const auto other = numbers_.find(b);
        if (one == numbers_.end() || other == numbers_.end()) return;
        const int first = find(one->second);
        const int second = find(other->second);
        nth(root_, std::max(first, second)) = std::min(first, second);
    }

    const FoldedState& state_;
    std::vector<CornerOf> corners_;
    std::vector<std::array<double, 2>> edges_;  // by corner
    std::vector<int> root_;                     // by corner
    std::map<CornerOf, int> numbers_;
};

struct SpotPair {
    double apart = 0.0;
    std::size_t a = 0, b = 0;
    friend bool operator<(const SpotPair& one, const SpotPair& other) {
        return std::tie(one.apart, one.a, one.b) < std::tie(other.apart, other.a, other.b);
    }
};

// Spots of different panels that are as near as that, the nearest first.
std::vector<SpotPair> near_pairs(const std::vector<Spot>& spots, double near) {
    using Cell = std::array<std::int64_t, 3>;
    std::map<Cell, std::vector<std::size_t>> cells;
    std::vector<SpotPair> pairs;
    double furthest = HUGE_VAL;
    const auto keep_nearest = [&pairs] {
        std::sort(pairs.begin(), pairs.end());
        if (pairs.size() > kMostPairs) pairs.resize(kMostPairs);
    };
    const auto cell_of = [near](double x) { return static_cast<std::int64_t>(std::floor(x / near)); };
    for (std::size_t i = 0; i < spots.size(); ++i) {
        const Cell own{cell_of(spots[i].at.x), cell_of(spots[i].at.y), cell_of(spots[i].at.z)};
        for (int at = 0; at < 27; ++at) {
            const auto found =
                cells.find({own[0] + at % 3 - 1, own[1] + at / 3 % 3 - 1, own[2] + at / 9 - 1});
            if (found == cells.end()) continue;
            for (const std::size_t j : found->second) {
                const double apart = distance(spots[i].at, spots[j].at);
                if (apart > furthest || apart >= near) continue;
                // Rounded, so that what is equal but for the last digits keeps the order of the drawing.
                if (!spots[i].shares_panel(spots[j])) pairs.push_back({std::round(apart * 1e6) / 1e6, j, i});
                if (pairs.size() < 2 * kMostPairs) continue;
                keep_nearest();
                furthest = pairs.back().apart + 1e-6;
            }
        }
        cells[own].push_back(i);
    }
    keep_nearest();
    return pairs;
}

class Finder {
 public:
    Finder(const RoughShape& rough, const FoldedState& state, std::vector<PanelJoin> accepted,
           std::span<const Join> named, double near)
        : rough_(rough),
          state_(state),
          accepted_(std::move(accepted)),
          named_(named),
          near_(near),
          spots_(Spots(state).run()) {
        for (const Fold& fold : rough.sheet.folds) folded_.insert(std::minmax(fold.left, fold.right));
    }

    Suggestions run() {
        found_.near_mm = near_;
        pairs_ = near_pairs(spots_, near_);
        find_merges();
        find_planes();
        find_glue();
        number_rows();
        return std::move(found_);
    }

 private:
    // What a join leaves open, with those accepted; nullopt when the work has run out.
    std::optional<Closed> leaves(const PanelJoin& join) {
        if (moved_ > kMostMoved) return std::nullopt;
        std::vector<PanelJoin> joins = accepted_;
        joins.push_back(join);
        Closed closed = close_joins(state_, joins, !accepted_.empty());
        moved_ += closed.panels * static_cast<std::size_t>(std::max(closed.steps, 1));
        return closed;
    }
    [[nodiscard]] bool is_worth_while(const PanelJoin& join, const Closed& left) const {
        return left.residual_mm <= rough_.enough_mm() ||
               (left.residual_mm <= kLeftShare * near_ &&
                left.residual_mm <= kHardlyNearer * state_.apart(join));
    }
    [[nodiscard]] PanelJoin merge_of(const std::vector<std::size_t>& group) const {
        PanelJoin join;
        for (const std::size_t spot : group) join.merged.push_back(spots_[spot].of.front());
        return join;
    }

    void find_merges() {
        std::vector<std::size_t> group_of(spots_.size());
        std::iota(group_of.begin(), group_of.end(), std::size_t{0});
        std::vector<std::vector<std::size_t>> groups(spots_.size());
        for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = {i};
        bool met_told = false;
        for (const SpotPair& pair : pairs_) {
            if (!spots_[pair.a].has_edge_like(spots_[pair.b])) continue;
            const bool met = pair.apart <= kMetMm;
            if (!met && !met_told) tell_met(groups);
            met_told = met_told || !met;
            std::size_t one = group_of[pair.a];
            std::size_t other = group_of[pair.b];
            if (one == other) continue;
            if (never_meet(groups[one], groups[other])) continue;
            const PanelJoin two = merge_of({pair.a, pair.b});
            if (!met) {
                const std::optional<Closed> left = leaves(two);
                if (!left || !is_worth_while(two, *left)) continue;
            }
            if (one > other) std::swap(one, other);
            for (const std::size_t spot : groups[other]) group_of[spot] = one;
            groups[one].insert(groups[one].end(), groups[other].begin(), groups[other].end());
            groups[other].clear();
        }
        if (!met_told) tell_met(groups);
        for (std::vector<std::size_t>& group : groups) {
            if (group.size() < 2) continue;
            std::sort(group.begin(), group.end());
            const PanelJoin join = merge_of(group);
            if (state_.apart(join) > kMetMm && add(JoinKind::merge, join)) merged_.push_back(group);
        }
        find_alike();
    }

    // As it is when it is accepted, for what has met is accepted with it.
    [[nodiscard]] FoldTurn furthest_turn(const PanelJoin& join, const Closed& alone) {
        if (met_.empty() || alone.residual_mm > rough_.enough_mm() || moved_for_turns_ > kMostMoved / 2)
            return folded::furthest_turn(rough_, alone.angles);
        std::vector<PanelJoin> joins = accepted_;
        joins.push_back(join);
        joins.insert(joins.end(), met_.begin(), met_.end());
        const Closed whole = close_joins(state_, joins, true);
        moved_for_turns_ += whole.panels * static_cast<std::size_t>(std::max(whole.steps, 1));
        return folded::furthest_turn(rough_,
                                     whole.residual_mm <= rough_.enough_mm() ? whole.angles : alone.angles);
    }

    // The nearest pairs come first: so far groups are of what has met.
    void tell_met(std::vector<std::vector<std::size_t>> groups) {
        for (std::vector<std::size_t>& group : groups) {
            if (group.size() < 2) continue;
            std::sort(group.begin(), group.end());
            met_.push_back(merge_of(group));
            found_.met.push_back(join_of(JoinKind::merge, met_.back()));
        }
    }
    [[nodiscard]] Join join_of(JoinKind kind, const PanelJoin& join) const {
        Join made;
        made.kind = kind;
        for (const CornerOf& one : join.merged)
            made.parts.push_back({nth(rough_.names, one.panel), rough_.sheet.at(one.corner)});
        if (join.merged.empty())
            made.parts = {{nth(rough_.names, join.a), {}}, {nth(rough_.names, join.b), {}}};
        return made;
    }

    // A flap may begin beside the corner of its wall: these two are as far apart however it is folded.
    [[nodiscard]] bool never_meet(const std::vector<std::size_t>& a,
                                  const std::vector<std::size_t>& b) const {
        return std::any_of(a.begin(), a.end(), [&](std::size_t one) {
            return std::any_of(b.begin(), b.end(), [&](std::size_t other) {
                return spots_[one].shares_panel(spots_[other]) ||
                       (spots_[one].is_rigid_with(spots_[other]) &&
                        distance(spots_[one].at, spots_[other].at) > kMetMm);
            });
        });
    }

    // Two groups are symmetric where their corners have as many edges, as long, one to one.
    void find_alike() {
        std::vector<std::vector<std::vector<double>>> shapes;
        for (const std::vector<std::size_t>& group : merged_) {
            std::vector<std::vector<double>>& shape = shapes.emplace_back();
            for (const std::size_t spot : group) {
                std::vector<double> edges = spots_[spot].edges;
                for (double& edge : edges) edge = std::round(edge * 1e3) / 1e3;
                shape.push_back(std::move(edges));
            }
            std::sort(shape.begin(), shape.end());
        }
        const auto alike = [](const auto& one, const auto& other) {
            return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                              [](const auto& a, const auto& b) {
                                  return std::equal(a.begin(), a.end(), b.begin(), b.end(), are_equal);
                              });
        };
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            for (std::size_t j = 0; j < shapes.size(); ++j) {
                if (i != j && alike(shapes[i], shapes[j]))
                    found_.rows[i].like.push_back(
                        static_cast<int>(j));  // its row; number_rows() makes it a number
            }
        }
    }

    // Pairs of panels whose boxes, grown by what is near, meet.
    [[nodiscard]] std::vector<std::pair<int, int>> pairs_of_panels() const {
        struct Bounds {
            Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
            int panel = 0;
        };
        std::vector<Bounds> all;
        for (std::size_t i = 0; i < rough_.sheet.panels.size(); ++i) {
            Bounds& box = all.emplace_back();
            box.panel = static_cast<int>(i);
            for (const int corner : rough_.sheet.panels[i].outer) {
                const Vec3 at = state_.place({box.panel, corner});
                box.low = {std::min(box.low.x, at.x), std::min(box.low.y, at.y), std::min(box.low.z, at.z)};
                box.high = {std::max(box.high.x, at.x), std::max(box.high.y, at.y),
                            std::max(box.high.z, at.z)};
            }
        }
        std::sort(all.begin(), all.end(), [](const Bounds& a, const Bounds& b) {
            return std::tie(a.low.x, a.panel) < std::tie(b.low.x, b.panel);
        });
        std::vector<std::pair<int, int>> pairs;
        std::vector<Bounds> open;
        for (const Bounds& box : all) {
            std::erase_if(open, [&](const Bounds& other) { return other.high.x + near_ < box.low.x; });
            for (const Bounds& other : open) {
                const bool apart = other.high.y + near_ < box.low.y || box.high.y + near_ < other.low.y ||
                                   other.high.z + near_ < box.low.z || box.high.z + near_ < other.low.z;
                const std::pair<int, int> pair = std::minmax(box.panel, other.panel);
                if (!apart && !folded_.contains(pair)) pairs.push_back(pair);
            }
            open.push_back(box);
        }
        return pairs;
    }

    [[nodiscard]] Vec2 middle_of(int panel) const {
        const Ring ring = rough_.sheet.outline_of(nth(rough_.sheet.panels, panel)).outer;
        Vec2 sum;
        double whole = 0.0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i];
            const Vec2 b = ring[(i + 1) % ring.size()];
            const double share = cross(a - ring[0], b - ring[0]);
            sum = sum + share * (a + b + ring[0]);
            whole += share;
        }
        return (1.0 / (3.0 * whole)) * sum;
    }

    // Whether the middle of one panel lies over another, and how far its corners are from that one's plane.
    struct Over {
        bool is_over = false;
        double off = 0.0;
    };
    [[nodiscard]] Over over(int one, int other) const {
        const std::vector<int>& ground = nth(rough_.sheet.panels, other).outer;
        const folded::Rigid3 frame = state_.frame(other);
        const auto page = [&](Vec3 p) {
            const Vec3 d = p - frame.shift;
            return Vec3{dot(frame.axes[0], d), dot(frame.axes[1], d), dot(frame.axes[2], d)};
        };
        Over result;
        for (const int corner : nth(rough_.sheet.panels, one).outer)
            result.off = std::max(result.off, std::abs(page(state_.place({one, corner})).z));
        const Vec2 middle = middle_of(one);
        const Vec3 at = page(state_.frame(one).point({middle.x, middle.y, 0.0}));
        Polygon outline;
        for (const int corner : ground) outline.outer.push_back(rough_.sheet.at(corner));
        result.is_over = contains(outline, {at.x, at.y});
        return result;
    }

    void find_planes() {
        std::set<std::pair<int, int>> beside;
        for (const SpotPair& pair : pairs_) {
            for (const CornerOf& a : spots_[pair.a].of) {
                for (const CornerOf& b : spots_[pair.b].of) beside.insert(std::minmax(a.panel, b.panel));
            }
        }
        std::vector<std::tuple<int, int, int>> found;  // kind, and places in the tree
        const auto place = [&](int panel) { return nth(rough_.tree.plate_of, panel); };
        for (auto [small, large] : pairs_of_panels()) {
            const double fronts = dot(state_.normal(small), state_.normal(large));
            if (fronts <= kFrontsAlike) continue;
            const auto size = [&](int panel) {
                return area(rough_.sheet.outline_of(nth(rough_.sheet.panels, panel)));
            };
            if (size(small) > size(large) * (1.0 + 1e-9)) std::swap(small, large);
            const Over lies = over(small, large);
            if (lies.off >= near_) continue;
            if (lies.is_over) {
                found.emplace_back(static_cast<int>(JoinKind::paste), place(small), place(large));
            } else if (fronts > kFrontsNearlyOne && beside.contains(std::minmax(small, large))) {
                found.emplace_back(static_cast<int>(JoinKind::coplanar), place(small), place(large));
            }
        }
        std::sort(found.begin(), found.end());
        for (const auto& [kind, small, large] : found) {
            PanelJoin join;
            join.a = nth(rough_.tree.order, small);
            join.b = nth(rough_.tree.order, large);
            if (state_.apart(join) > kMetMm) add(static_cast<JoinKind>(kind), join);
        }
    }

    // Of each panel the nearest of those on which it lies.
    void find_glue() {
        std::map<int, std::pair<double, int>> nearest;  // by place in the tree: how far off, and the panel
        for (auto [small, large] : pairs_of_panels()) {
            if (std::abs(dot(state_.normal(small), state_.normal(large))) < kParallelFaces) continue;
            const auto size = [&](int panel) {
                return area(rough_.sheet.outline_of(nth(rough_.sheet.panels, panel)));
            };
            if (size(small) > size(large) * (1.0 + 1e-9)) std::swap(small, large);
            const Over lies = over(small, large);
            if (!lies.is_over || lies.off > kMostGlueGapMm || is_glued(small, large)) continue;
            const std::pair<double, int> one{std::round(lies.off * 1e6) / 1e6,
                                             nth(rough_.tree.plate_of, large)};
            const auto [at, fresh] = nearest.try_emplace(nth(rough_.tree.plate_of, small), one);
            if (!fresh && one < at->second) at->second = one;
        }
        for (const auto& [small, one] : nearest) {
            if (found_.rows.size() >= kMostSuggestions) {
                ++found_.left_out;
                continue;
            }
            PanelJoin join;
            join.a = nth(rough_.tree.order, small);
            join.b = nth(rough_.tree.order, one.second);
            Suggestion& row = found_.rows.emplace_back();
            row.join = join_of(JoinKind::glue, join);
            row.apart_mm = state_.apart(join);
            row.closes = true;
        }
    }
    // By its name, by a join, or by a suggestion that brings it nearer.
    [[nodiscard]] bool is_glued(int flap, int panel) const {
        const std::string& name = nth(rough_.names, flap);
        if (name.find(kGlueFlapName) != std::string::npos || name.find(kGlueCornerName) != std::string::npos)
            return true;
        const auto is_it = [&](const Join& join) {
            return (join.kind == JoinKind::paste || join.kind == JoinKind::glue) &&
                   std::all_of(join.parts.begin(), join.parts.end(), [&](const JoinPart& part) {
                       return part.panel == name || part.panel == nth(rough_.names, panel);
                   });
        };
        return std::any_of(named_.begin(), named_.end(), is_it) ||
               std::any_of(found_.rows.begin(), found_.rows.end(),
                           [&](const Suggestion& row) { return is_it(row.join); });
    }

    bool add(JoinKind kind, const PanelJoin& join) {
        // Beyond what is listed, they are counted, and nobody looks whether they close.
        const std::optional<Closed> looked =
            found_.rows.size() < kMostSuggestions ? leaves(join) : std::nullopt;
        if (!looked) {
            ++found_.left_out;
            return false;
        }
        const Closed& left = *looked;
        if (!is_worth_while(join, left)) return false;
        Suggestion& row = found_.rows.emplace_back();
        row.join = join_of(kind, join);
        row.apart_mm = state_.apart(join);
        row.residual_mm = left.residual_mm;
        row.settled = left.settled;
        row.turn_deg = left.turn * 180.0 / std::numbers::pi;
        row.furthest = furthest_turn(join, left);
        row.swings = left.swings;
        row.closes = left.residual_mm <= rough_.enough_mm() && !left.swings;
        return true;
    }

    void number_rows() {
        std::array<int, kJoinKindNames.size()> numbers{};
        const auto is_taken = [&](JoinKind kind, int number) {
            return std::any_of(named_.begin(), named_.end(),
                               [&](const Join& one) { return one.kind == kind && one.number == number; });
        };
        for (Suggestion& row : found_.rows) {
            int& number = nth(numbers, row.join.kind);
            do ++number;
            while (is_taken(row.join.kind, number));
            row.number = row.join.number = number;
        }
        for (Suggestion& row : found_.rows) {
            for (int& other : row.like) other = nth(found_.rows, other).number;
        }
    }

    const RoughShape& rough_;
    const FoldedState& state_;
    std::vector<PanelJoin> accepted_;
    std::span<const Join> named_;  // the same
    double near_;
    std::vector<Spot> spots_;
    std::vector<SpotPair> pairs_;
    std::set<std::pair<int, int>> folded_;
    std::vector<std::vector<std::size_t>> merged_;  // by row
    std::vector<PanelJoin> met_;                    // as found_.met
    std::size_t moved_ = 0;                         // panels by a step, in all that leaves() has tried
    std::size_t moved_for_turns_ = 0;               // and by furthest_turn(), which leaves no suggestion out
    Suggestions found_;
};

}  // namespace

std::string Suggestion::name() const {
    return fmt::format("{} {}", kJoinKindNames.at(static_cast<std::size_t>(join.kind)), number);
}

std::string shown_outcome(const Suggestion& suggestion) {
    if (suggestion.lies()) return "lies there already";
    if (suggestion.swings) return fmt::format("swings a fold by {:.0f}°", suggestion.turn_deg);
    const double by = suggestion.furthest.by_deg();
    if (suggestion.closes)
        return by > kMostTurnDeg ? fmt::format("closes, turning a fold by {:.0f}°", by) : "closes";
    return "leaves " + shown_gap(suggestion.residual_mm) + (suggestion.settled ? "" : " or less");
}

std::optional<Suggestions> suggest_joins(const CreasePattern& pattern, const SuggestOptions& options,
                                         Diagnostics& diagnostics) {
    const auto rough = folded::rough_shape(pattern, options.fold, diagnostics);
    if (!rough) return std::nullopt;
    Diagnostics& of_joins = options.of_joins != nullptr ? *options.of_joins : diagnostics;
    auto joins = folded::resolve(*rough, options.joins, pattern, of_joins);
    if (!joins) return std::nullopt;
    const double near = options.near_mm.value_or(std::min(kPapersMm, kNearShare * rough->sheet.size()));
    std::vector<double> angles = rough->angles;
    if (!joins->empty()) angles = folded::close_joins(rough->state(), *joins, true).angles;
    const FoldedState state(rough->sheet, rough->tree, std::move(angles));
    return Finder(*rough, state, std::move(*joins), options.joins, near).run();
}

}  // namespace popup
