// Allowances for the board of cartons.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/geometry/regions.h"
#include "base/nth.h"
#include "folded/carton/carton_size.h"
#include "folded/carton/cut_apart.h"
#include "folded/carton/rough.h"
#include "folded/lower.h"
#include "popup/crease_pattern.h"

namespace popup {
namespace {

using folded::Fold;
using folded::FoldedState;
using folded::Rigid3;
using folded::RoughShape;
using folded::Stretch;

constexpr double kTuckBoards = 1.5;       // so far behind its wall a tuck flap stands
constexpr double kParallelFaces = 0.999;  // cosine of panels that lie on each other
constexpr double kMovesIn = 0.7;          // cosine between the way of a panel and the way into the box
constexpr double kEnoughMm = 0.02;
constexpr double kOneLengthMm = 1e-9;  // lengths that differ by less are one, but for rounding
constexpr double kMendedMm = 0.02;     // as fold_sheet() has it for a sheet with moved creases
constexpr double kLeastOverlapMm2 = 4.0;
constexpr double kMostBoards = 6.0;  // so far is a crease moved at most
constexpr int kRounds = 8;           // what was moved may be too near to something else then
constexpr std::size_t kToldAtMost = 40;

double plane_product(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

// A cut along the line of a fold between two walls, from where that fold ends to a corner that only one of
// them has: the creases of their flaps, which began in one corner, were moved by different lengths.
struct Slit {
    int fold = 0;
    int end = 0;    // of the fold
    int other = 0;  // where the crease of the other flap begins
};

// Two panels that lie nearer to each other than the board is thick, and which of them is to go inside.
struct Need {
    int inner = 0, outer = 0;
    double apart_mm = 0.0;  // how far inside it stands now
    double wanted_mm = 0.0;
    int fold = -1;  // that is to be moved, into what the inner panel hangs on; -1: none is
    double by_mm = 0.0;
};

class BoardRoom {
 public:
    BoardRoom(const CreasePattern& pattern, const RoughShape& rough, double board_mm)
        : pattern_(pattern), board_(board_mm), in_loop_(rough.sheet.folds.size(), 0) {
        for (const folded::Loop& loop : rough.sheet.loops) {
            for (const folded::Step& step : loop.steps) nth(in_loop_, step.fold) = 1;
        }
        folded::ApartShape apart = folded::cut_apart(rough);
        corners_ = std::move(apart.corners);
        shape_ = std::move(apart.shape);
        for (const std::string& name : shape_.names) is_tuck_.push_back(name.ends_with("-tuck") ? 1 : 0);
        moved_.assign(shape_.sheet.folds.size(), 0.0);
        goes_.assign(shape_.sheet.folds.size(), {-1, -1});
        children_.resize(shape_.sheet.panels.size());
        for (const int panel : shape_.tree.order) {
            if (parent(panel) >= 0) nth(children_, parent(panel)).push_back(panel);
        }
    }

    void run() {
        for (int round = 0; round < kRounds; ++round) {
            std::map<int, Need> moves;  // by fold: the one that asks for most
            for (const Need& need : needs()) {
                if (need.fold < 0) continue;
                const auto [at, fresh] = moves.try_emplace(need.fold, need);
                if (!fresh && at->second.by_mm < need.by_mm - kOneLengthMm) at->second = need;
            }
            bool any = false;
            for (const auto& [fold, need] : moves) any = move(need) || any;
            if (!any) return;
        }
    }

    void tell(const RoughShape& before, Diagnostics& diagnostics) const {
        std::size_t told = 0;
        for (std::size_t i = 0; i < moved_.size(); ++i) {
            if (moved_[i] <= 0.0 || ++told > kToldAtMost) continue;
            const Fold& fold = shape_.sheet.folds[i];
            const auto [inner, outer] = goes_[i];
            const auto shown = [&](const folded::Sheet& sheet) {
                const Segment line = sheet.line_of(sheet.folds[i]);
                return shown_point(pattern_.ruler, line.a) + " to " + shown_point(pattern_.ruler, line.b);
            };
            diagnostics
                .warning(
                    "crease-moved", nth(pattern_.lines, fold.line).place,
                    fmt::format("the crease between {} and {} lacks {:.2f} mm for board of {:.2f} mm: {} "
                                "goes inside {}; it was moved into {}",
                                nth(shape_.names, parent(inner)), nth(shape_.names, inner), moved_[i], board_,
                                nth(shape_.names, inner), nth(shape_.names, outer),
                                nth(shape_.names, parent(inner))))
                .hint("draw it there, and what lies beyond it as far")
                .changed(shown(before.sheet), shown(shape_.sheet));
        }
        for (const Need& need : needs()) {
            if (++told > kToldAtMost) return;
            diagnostics
                .warning("no-room-for-board", {},
                         fmt::format("{} and {} lie {:.2f} mm apart, and board of {:.2f} mm wants {:.2f} mm; "
                                     "no crease can be moved for it",
                                     nth(shape_.names, need.inner), nth(shape_.names, need.outer),
                                     std::max(0.0, need.apart_mm), board_, need.wanted_mm))
                .hint("make the panel smaller, or its wall shorter, in the drawing");
        }
    }

    // Names of panels are guessed by their sizes, and those have changed: what is told has the names that the
    // moved sheet has for whoever folds it.
    void take_names(const CreasePattern& moved) {
        FoldOptions mended;
        mended.snap_mm = kMendedMm;
        Diagnostics unheard;
        const std::optional<folded::Sheet> sheet = folded::make_sheet(moved, mended, unheard);
        if (!sheet) return;
        const Assembly named = folded::assembly_of_panels(moved, *sheet, folded::make_tree(moved, *sheet));
        for (std::size_t i = 0; i < shape_.names.size(); ++i) {
            const Vec2 within = inner_point(shape_.sheet.outline_of(shape_.sheet.panels[i]), kEnoughMm).at;
            const auto plate = std::find_if(named.plates.begin(), named.plates.end(),
                                            [&](const Plate& one) { return contains(one.outline, within); });
            if (plate != named.plates.end()) shape_.names[i] = plate->name;
        }
    }

    [[nodiscard]] bool any_moved() const {
        return std::any_of(moved_.begin(), moved_.end(), [](double by) { return by > 0.0; });
    }
    [[nodiscard]] const RoughShape& shape() const { return shape_; }

 private:
    [[nodiscard]] int parent(int panel) const {
        const int number = nth(shape_.tree.fold_of, panel);
        if (number < 0) return -1;
        const Fold& fold = nth(shape_.sheet.folds, number);
        return fold.left == panel ? fold.right : fold.left;
    }

    // Pairs of panels of one piece whose boxes, grown by the board, meet.
    [[nodiscard]] std::vector<std::pair<int, int>> near_pairs(const FoldedState& state) const {
        struct Bounds {
            Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
            int panel = 0;
        };
        std::vector<Bounds> all;
        for (std::size_t i = 0; i < shape_.sheet.panels.size(); ++i) {
            Bounds& box = all.emplace_back();
            box.panel = static_cast<int>(i);
            for (const int corner : shape_.sheet.panels[i].outer) {
                const Vec3 at = state.place({box.panel, corner});
                box.low = {std::min(box.low.x, at.x), std::min(box.low.y, at.y), std::min(box.low.z, at.z)};
                box.high = {std::max(box.high.x, at.x), std::max(box.high.y, at.y),
                            std::max(box.high.z, at.z)};
            }
        }
        std::sort(all.begin(), all.end(), [](const Bounds& a, const Bounds& b) {
            return std::tie(a.low.x, a.panel) < std::tie(b.low.x, b.panel);
        });
        const double near = kTuckBoards * board_;
        std::vector<std::pair<int, int>> pairs;
        std::vector<Bounds> open;
        for (const Bounds& box : all) {
            std::erase_if(open, [&](const Bounds& other) { return other.high.x + near < box.low.x; });
            for (const Bounds& other : open) {
                const bool apart = other.high.y + near < box.low.y || box.high.y + near < other.low.y ||
                                   other.high.z + near < box.low.z || box.high.z + near < other.low.z;
                const bool one_piece =
                    nth(shape_.sheet.panels, box.panel).piece == nth(shape_.sheet.panels, other.panel).piece;
                const bool folded = parent(box.panel) == other.panel || parent(other.panel) == box.panel;
                if (!apart && one_piece && !folded)
                    pairs.emplace_back(std::min(box.panel, other.panel), std::max(box.panel, other.panel));
            }
            open.push_back(box);
        }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

    // By how much two panels, of which the second is flat in its own coordinates, cover each other.
    [[nodiscard]] double overlap(const FoldedState& state, int one, int other) const {
        const Rigid3& frame = state.frame(other);
        const auto flat = [&](Vec2 p) {
            const Vec3 d = state.frame(one).point({p.x, p.y, 0.0}) - frame.shift;
            return Vec2{dot(frame.axes[0], d), dot(frame.axes[1], d)};
        };
        Polygon seen = shape_.sheet.outline_of(nth(shape_.sheet.panels, one));
        std::transform(seen.outer.begin(), seen.outer.end(), seen.outer.begin(), flat);
        if (signed_area(seen.outer) < 0.0) std::reverse(seen.outer.begin(), seen.outer.end());
        seen.holes.clear();
        return area(intersect({seen}, {shape_.sheet.outline_of(nth(shape_.sheet.panels, other))}));
    }

    [[nodiscard]] Vec3 middle(const FoldedState& state, int panel) const {
        const Box box = bounds(shape_.sheet.outline_of(nth(shape_.sheet.panels, panel)).outer);
        return state.frame(panel).point({box.centre().x, box.centre().y, 0.0});
    }

    // The way in which a panel goes when its crease is moved into what it hangs on; none: it hangs on
    // nothing.
    [[nodiscard]] std::optional<Vec3> way_of(const FoldedState& state, int panel) const {
        const int fold = nth(shape_.tree.fold_of, panel);
        if (fold < 0 || nth(in_loop_, fold) != 0) return std::nullopt;
        const Vec2 into = -1.0 * away_from_parent(panel);
        return state.frame(parent(panel)).direction({into.x, into.y, 0.0});
    }
    // On the sheet, from what it hangs on towards it, square to its crease; unit.
    [[nodiscard]] Vec2 away_from_parent(int panel) const {
        const Fold& fold = nth(shape_.sheet.folds, nth(shape_.tree.fold_of, panel));
        const Segment line = shape_.sheet.line_of(fold);
        const Vec2 along = unit(line.b - line.a);
        return fold.left == panel ? left_of(along) : right_of(along);
    }

    [[nodiscard]] double wanted(int inner) const {
        return (nth(is_tuck_, inner) != 0 ? kTuckBoards : 1.0) * board_;
    }

    // `inner` inside `outer`, if that can be had.
    [[nodiscard]] Need need_of(const FoldedState& state, int inner, int outer, Vec3 in) const {
        Need need;
        need.inner = inner;
        need.outer = outer;
        need.apart_mm = dot(middle(state, inner) - middle(state, outer), in);
        need.wanted_mm = wanted(inner);
        const std::optional<Vec3> way = way_of(state, inner);
        // What it hangs on must not come along.
        if (!way || dot(*way, in) < kMovesIn || hangs_on(outer, inner)) return need;
        need.fold = nth(shape_.tree.fold_of, inner);
        need.by_mm = (need.wanted_mm - need.apart_mm) / dot(*way, in);
        return need;
    }

    [[nodiscard]] bool hangs_on(int panel, int other) const {
        for (; panel >= 0; panel = parent(panel)) {
            if (panel == other) return true;
        }
        return false;
    }

    [[nodiscard]] std::vector<Need> needs() const {
        const FoldedState state = shape_.state();
        std::vector<Need> found;
        Vec3 sum;
        double whole = 0.0;
        for (const int panel : shape_.tree.order) {
            const double own = size_of(panel);
            sum = sum + own * middle(state, panel);
            whole += own;
        }
        const Vec3 centre = (1.0 / whole) * sum;
        for (const auto& [a, b] : near_pairs(state)) {
            if (std::abs(dot(state.normal(a), state.normal(b))) < kParallelFaces) continue;
            Vec3 in = state.normal(b);
            const double apart = dot(middle(state, a) - middle(state, b), in);
            if (std::abs(apart) >= std::max(wanted(a), wanted(b)) - kEnoughMm) continue;
            if (overlap(state, a, b) < kLeastOverlapMm2) continue;
            if (dot(centre - middle(state, b), in) < 0.0) in = -in;
            Need one = need_of(state, a, b, in);
            Need other = need_of(state, b, a, in);
            if (goes_first(other, one)) std::swap(one, other);
            if (one.fold < 0 && other.fold >= 0) std::swap(one, other);
            if (one.apart_mm < one.wanted_mm - kEnoughMm) found.push_back(one);
        }
        return found;
    }
    [[nodiscard]] double size_of(int panel) const {
        return area(shape_.sheet.outline_of(nth(shape_.sheet.panels, panel)));
    }

    // Which of two is rather inside: what is so already, else the smaller, else what hangs further out.
    [[nodiscard]] bool goes_first(const Need& one, const Need& other) const {
        if (std::abs(one.apart_mm) > kEnoughMm) return one.apart_mm > other.apart_mm;
        const double own = size_of(one.inner);
        const double theirs = size_of(other.inner);
        if (std::abs(own - theirs) > 1e-6 * (own + theirs)) return own < theirs;
        return nth(shape_.tree.plate_of, one.inner) > nth(shape_.tree.plate_of, other.inner);
    }

    // Moves a crease and all beyond it. False: that would cross what is there.
    bool move(const Need& need) {
        if (nth(moved_, need.fold) + need.by_mm > kMostBoards * board_) return false;
        const Vec2 shift = -need.by_mm * away_from_parent(need.inner);
        std::set<int> beyond{need.inner};
        std::vector<int> open{need.inner};
        while (!open.empty()) {
            const int panel = open.back();
            open.pop_back();
            for (const int child : nth(children_, panel)) {
                beyond.insert(child);
                open.push_back(child);
            }
        }
        const RoughShape before = shape_;
        const std::vector<std::vector<int>> corners_before = corners_;
        const std::vector<Slit> slits_before = slits_;
        for (const int corner : ends_of(need.fold)) part_at(tip_from(corner, need), need, beyond, shift);
        std::set<int> moving;
        for (const int panel : beyond)
            moving.insert(nth(corners_, panel).begin(), nth(corners_, panel).end());
        add_ends(need.fold, beyond, moving);
        if (!may_move(need.fold, beyond, moving, shift)) {
            shape_ = before;
            corners_ = corners_before;
            slits_ = slits_before;
            return false;
        }
        for (const int corner : moving) {
            Vec2& at = nth(shape_.sheet.corners, corner);
            at = at + shift;
        }
        nth(moved_, need.fold) += need.by_mm;
        nth(goes_, need.fold) = {need.inner, need.outer};
        return true;
    }

    [[nodiscard]] std::set<int> ends_of(int number) const {
        const std::vector<Stretch>& stretches = nth(shape_.sheet.folds, number).stretches;
        return {stretches.front().a, stretches.back().b};
    }

    static bool is_along(Vec2 a, Vec2 b) {
        return std::abs(plane_product(a, b)) <= 1e-3 * length(a) * length(b);
    }

    // Whether the edge of a panel goes through a corner in that direction.
    [[nodiscard]] bool goes_straight_on(int panel, int corner, Vec2 way) const {
        const std::vector<int>& ring = nth(shape_.sheet.panels, panel).outer;
        const auto at = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), corner) - ring.begin());
        if (at == ring.size()) return true;
        const Vec2 here = shape_.sheet.at(corner);
        const Vec2 before = shape_.sheet.at(ring[(at + ring.size() - 1) % ring.size()]);
        const Vec2 after = shape_.sheet.at(ring[(at + 1) % ring.size()]);
        return is_along(way, before - here) && is_along(way, after - here);
    }

    // Where the edge of the wall that goes on from the end of a crease, in its direction, comes to an end.
    [[nodiscard]] int tip_from(int corner, const Need& need) const {
        const int wall = parent(need.inner);
        const Segment line = shape_.sheet.line_of(nth(shape_.sheet.folds, need.fold));
        std::map<int, std::vector<int>> next;
        for (const Stretch cut : nth(shape_.sheet.cuts, nth(shape_.sheet.panels, wall).piece)) {
            const Vec2 edge = shape_.sheet.at(cut.b) - shape_.sheet.at(cut.a);
            if (length(edge) < 1e-9 || !is_along(line.b - line.a, edge)) continue;
            next[cut.a].push_back(cut.b);
            next[cut.b].push_back(cut.a);
        }
        const std::vector<int>& own = nth(corners_, wall);
        std::set<int> seen{corner};
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            for (const int one : next[corner]) {
                if (std::find(own.begin(), own.end(), one) == own.end() || !seen.insert(one).second) continue;
                corner = one;
                goes_on = true;
                break;
            }
        }
        return corner;
    }

    // Where walls stand side by side, the crease of a flap ends at a corner that the crease of the flap
    // beside it has, too. Each gets a corner of its own, and the fold between the walls ends at the lower
    // one.
    void part_at(int corner, const Need& need, const std::set<int>& beyond, Vec2 shift) {
        const int wall = parent(need.inner);
        for (Slit& slit : slits_) {
            if (slit.end == corner) return;
            if (slit.other != corner) continue;
            if (length(shift) > distance(shape_.sheet.at(slit.end), shape_.sheet.at(corner)) + kOneLengthMm)
                turn_slit(slit, wall);
            return;
        }
        int between = -1;  // the fold that the corner goes along
        for (std::size_t i = 0; i < shape_.sheet.folds.size(); ++i) {
            const Fold& fold = shape_.sheet.folds[i];
            const auto number = static_cast<int>(i);
            if (number == need.fold || !ends_of(number).contains(corner)) continue;
            if (beyond.contains(fold.left) || beyond.contains(fold.right)) continue;
            const Segment line = shape_.sheet.line_of(fold);
            const bool is_walls = fold.left == wall || fold.right == wall;
            if (is_along(shift, line.b - line.a) && is_walls) between = number;
        }
        if (between < 0) return;
        folded::Sheet& sheet = shape_.sheet;
        const Fold& walls = nth(sheet.folds, between);
        const int other = walls.left == wall ? walls.right : walls.left;
        if (goes_straight_on(other, corner, shift)) return;  // they are drawn apart
        const auto fresh = static_cast<int>(sheet.corners.size());
        sheet.corners.push_back(sheet.at(corner));
        const auto replace = [&](std::vector<int>& in) { std::replace(in.begin(), in.end(), corner, fresh); };
        const auto replace_in_panel = [&](int panel) {
            replace(nth(sheet.panels, panel).outer);
            replace(nth(corners_, panel));
        };
        // Cuts that lead away from there over what is moved.
        std::set<int> theirs;
        for (const int panel : beyond)
            theirs.insert(nth(corners_, panel).begin(), nth(corners_, panel).end());
        theirs.insert(nth(corners_, wall).begin(), nth(corners_, wall).end());
        std::vector<Stretch>& cuts = nth(sheet.cuts, nth(sheet.panels, wall).piece);
        for (Stretch& cut : cuts) {
            if (cut.a == corner && theirs.contains(cut.b)) cut.a = fresh;
            if (cut.b == corner && theirs.contains(cut.a)) cut.b = fresh;
        }
        for (const int panel : beyond) replace_in_panel(panel);
        replace_in_panel(wall);
        for (const int number : {need.fold, between}) {
            for (Stretch& one : nth(sheet.folds, number).stretches) {
                if (one.a == corner) one.a = fresh;
                if (one.b == corner) one.b = fresh;
            }
        }
        // The wall on the other side has both corners.
        insert_between(other, corner, far_from(between, fresh), fresh);
        cuts.push_back({corner, fresh});
        slits_.push_back({between, fresh, corner});
    }

    // The corner of a fold's stretch that is not its end.
    [[nodiscard]] int far_from(int fold, int end) const {
        const std::vector<Stretch>& way = nth(shape_.sheet.folds, fold).stretches;
        const Stretch& last = way.front().a == end ? way.front() : way.back();
        return last.a == end ? last.b : last.a;
    }

    void insert_between(int panel, int a, int b, int fresh) {
        std::vector<int>& ring = nth(shape_.sheet.panels, panel).outer;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            if (std::minmax(ring[k], ring[(k + 1) % ring.size()]) != std::minmax(a, b)) continue;
            ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(k) + 1, fresh);
            break;
        }
        nth(corners_, panel).push_back(fresh);
    }

    // The crease of this wall's flap is about to pass where the fold between the walls ends: then it ends
    // where that crease begins, and the wall on the other side has both corners.
    void turn_slit(Slit& slit, int wall) {
        Fold& walls = nth(shape_.sheet.folds, slit.fold);
        const int other = walls.left == wall ? walls.right : walls.left;
        const int far = far_from(slit.fold, slit.end);
        std::erase(nth(shape_.sheet.panels, wall).outer, slit.end);
        std::erase(nth(corners_, wall), slit.end);
        insert_between(other, slit.end, far, slit.other);
        for (Stretch& one : walls.stretches) {
            if (one.a == slit.end) one.a = slit.other;
            if (one.b == slit.end) one.b = slit.other;
        }
        std::swap(slit.end, slit.other);
    }

    [[nodiscard]] bool is_slit(int a, int b) const {
        return std::any_of(slits_.begin(), slits_.end(), [&](const Slit& slit) {
            return std::minmax(a, b) == std::minmax(slit.end, slit.other);
        });
    }

    // Cuts that go on from the ends of a crease in its direction move with it, so that they stay square to
    // it.
    void add_ends(int number, const std::set<int>& beyond, std::set<int>& moving) const {
        const Segment line = shape_.sheet.line_of(nth(shape_.sheet.folds, number));
        std::set<int> theirs;
        for (const int panel : beyond)
            theirs.insert(nth(corners_, panel).begin(), nth(corners_, panel).end());
        std::map<int, std::vector<int>> next;
        for (const Stretch cut : nth(shape_.sheet.cuts, nth(shape_.sheet.panels, *beyond.begin()).piece)) {
            if (theirs.contains(cut.a) && theirs.contains(cut.b)) continue;
            const Vec2 edge = shape_.sheet.at(cut.b) - shape_.sheet.at(cut.a);
            // Corners that were just parted lie on each other.
            if (length(edge) < 1e-9 || !is_along(line.b - line.a, edge)) continue;
            next[cut.a].push_back(cut.b);
            next[cut.b].push_back(cut.a);
        }
        std::vector<int> open;
        for (const int corner : ends_of(number)) open.push_back(corner);
        // Slits along it go with it, and those that are closed just now, too.
        for (const Slit& slit : slits_) {
            if (slit.fold != number) continue;
            for (const int corner : {slit.end, slit.other}) {
                if (moving.insert(corner).second) open.push_back(corner);
            }
        }
        while (!open.empty()) {
            const auto found = next.find(open.back());
            open.pop_back();
            if (found == next.end()) continue;
            for (const int corner : found->second) {
                if (moving.insert(corner).second) open.push_back(corner);
            }
        }
    }

    [[nodiscard]] bool may_move(int number, const std::set<int>& beyond, const std::set<int>& moving,
                                Vec2 shift) const {
        for (std::size_t i = 0; i < shape_.sheet.folds.size(); ++i) {
            const Fold& fold = shape_.sheet.folds[i];
            if (static_cast<int>(i) == number || beyond.contains(fold.left) || beyond.contains(fold.right))
                continue;
            const Segment line = shape_.sheet.line_of(fold);
            const bool moves_a = moving.contains(fold.stretches.front().a);
            const bool moves_b = moving.contains(fold.stretches.back().b);
            if (!moves_a && !moves_b) continue;
            // Another crease may grow longer or shorter, and no more.
            if (moves_a && moves_b) return false;
            if (!is_along(shift, line.b - line.a)) return false;
        }
        // No edge turns back on itself.
        for (std::size_t i = 0; i < shape_.sheet.panels.size(); ++i) {
            if (beyond.contains(static_cast<int>(i))) continue;
            const std::vector<int>& ring = shape_.sheet.panels[i].outer;
            for (std::size_t k = 0; k < ring.size(); ++k) {
                const int a = ring[k];
                const int b = ring[(k + 1) % ring.size()];
                if (moving.contains(a) == moving.contains(b) || is_slit(a, b)) continue;
                const Vec2 edge = shape_.sheet.at(b) - shape_.sheet.at(a);
                const Vec2 made = moving.contains(b) ? edge + shift : edge - shift;
                if (dot(edge, made) <= kOneLengthMm * length(edge)) return false;
            }
        }
        return true;
    }

    const CreasePattern& pattern_;
    double board_;
    std::vector<char> in_loop_;               // by fold
    std::vector<char> is_tuck_;               // by panel, as they are drawn
    RoughShape shape_;                        // as it is moved
    std::vector<std::vector<int>> corners_;   // by panel
    std::vector<std::vector<int>> children_;  // by panel
    std::vector<double> moved_;               // by fold, mm
    std::vector<std::pair<int, int>> goes_;   // by fold: the panel that goes inside, and the other
    std::vector<Slit> slits_;
};

}  // namespace

std::optional<BoardedSheet> allow_for_board(const CreasePattern& pattern, const FoldOptions& options,
                                            double board_mm, Diagnostics& diagnostics) {
    FoldOptions whole = options;
    whole.to = 1.0;
    Diagnostics unheard;  // what is wrong with the sheet is told once, by whoever folds it
    const auto rough = folded::rough_shape(pattern, whole, unheard);
    if (!rough) return std::nullopt;
    BoardRoom room(pattern, *rough, board_mm);
    room.run();
    BoardedSheet boarded{pattern, room.any_moved()};
    if (boarded.moved) {
        boarded.pattern = folded::pattern_of(pattern, room.shape(), rough->angles);
        room.take_names(boarded.pattern);
    }
    room.tell(*rough, diagnostics);
    folded::tell_carton_size(room.shape(), board_mm, diagnostics);
    // The mends of the drawing are in it, and would not be found again.
    if (boarded.moved) static_cast<void>(folded::make_sheet(pattern, whole, diagnostics));
    return boarded;
}

}  // namespace popup
