// An order for the folds of a sheet. It is searched from the end, as one finds out how a box is closed by
// opening it: what is folded last can be unfolded first, and what has been unfolded is out of the way of most
// others, so that a choice is seldom wrong.
//
// A flap that is tucked in behind a wall does not open so: it leaves upright, while the lid that it hangs on
// begins to rise. So the two are tried together, the flap turning on by as much as the lid turns back.
//
// Each step is looked at by itself, and what lies on one another between two steps has no sides there. So the
// sides are kept from step to step: those on which plates came there, and those that a box has when it is
// closed, where an order can be found that has them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "base/sets.h"
#include "motion/examine.h"
#include "motion/linkage.h"
#include "motion/opening_order.h"
#include "motion/plate_shape.h"
#include "motion/seen_pairs.h"
#include "motion/touching.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kFlatDeg = 180.0;
// More parts than this are not put in an order, and no more poses are looked at. Cartons of the kit take some
// 1,000 to 14,000 poses a part.
constexpr std::size_t kMostParts = 64;
constexpr std::size_t kMostPosesAPart = 30'000;
constexpr std::size_t kToldAtMost = 6;  // plates of a step
// How far a lid rises while the flap on it stays upright, degrees.
constexpr std::array kUprightDeg{10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 75.0};
constexpr double kParallelRad = 1e-6;  // folds this near to parallel are

// What a part does while something is looked at, in shares of its way: 0 where it lies flat, 1 where it is
// folded. Other shares are of parts of one fold, whose law is straight.
struct Doing {
    double begin = 0.0, end = 0.0;
    friend bool operator==(const Doing&, const Doing&) = default;
};
constexpr Doing kFlat{0.0, 0.0};
constexpr Doing kMoves{0.0, 1.0};
constexpr Doing kFolded{1.0, 1.0};

bool shows_clear(const Examination& found) {
    return found.undecided.empty() && found.decided_up_to_deg >= kFlatDeg && found.contacts.empty();
}

enum class Wishes { all, of_others };  // which count: all, or not those of the part that goes

// A part that goes in a step.
struct Move {
    int part = 0;
    Doing doing = kMoves;
};
using Step = std::vector<Move>;  // its parts go at once; each is in it once
// With what lies on one another where its parts are folded, and where they are opened.
struct Stage {
    Step moves;
    TouchingPlates folded, opened;
};

class Order {
 public:
    Order(const Assembly& assembly, const MotionOptions& options) : work_(assembly) {
        options_.tolerances = options.tolerances;
        laws_.resize(work_.joints.size());
        for (std::size_t i = 0; i < work_.joints.size(); ++i) {
            if (const Law* const law = law_of(work_.joints[i])) laws_[i] = *law;
        }
        work_.sweep = {0.0, kFlatDeg, false};
        find_parts();
        shapes_ = plate_shapes(work_, options_);
    }

    // The steps. Empty: all may go at once and close no box, or there is nothing to be put in an order, or no
    // order was found.
    std::vector<Step> run(const Examination* at_once) {
        if (parts_.size() < 2 || parts_.size() > kMostParts) return {};
        for (const OrderedPart& part : parts_) of_box_.push_back(of_box(work_, part));
        const bool has_lid =
            std::any_of(of_box_.begin(), of_box_.end(), [](const OfBox& one) { return one.closes; });
        set_all(kMoves);
        all_at_once_ = at_once != nullptr ? shows_clear(*at_once) : is_clear();
        // No hand gets into a box that closes everywhere at a time.
        if (all_at_once_ && !has_lid) return {};
        // What crosses in the end, as two flaps do that are drawn too long, crosses in any order.
        set_all(kFolded);
        set_laws();
        Linkage linkage(work_);
        const Examination found = examine(work_, linkage, shapes_, options_);
        poses_ += found.poses;
        for (const Contact& contact : found.contacts) set_aside_.insert({contact.a, contact.b});
        set_all(kMoves);
        if (!set_aside_.empty() && is_clear()) return {};
        set_all(kMoves);
        set_laws();
        over_ = rolled_over_by(work_, parts_);
        std::vector<Stage> stages = unfold(has_lid ? OpenFirst::lids : OpenFirst::small);
        // What is rolled up is unrolled from where it hangs.
        for (const OpenFirst first : {OpenFirst::small, OpenFirst::large}) {
            if (all_clear_ || all_at_once_ || !has_work_left()) break;
            if (first == OpenFirst::small && !has_lid) continue;
            std::vector<Stage> others = unfold(first);
            if (all_clear_) stages = std::move(others);
        }
        if (all_at_once_ && !all_clear_) return {};
        std::reverse(stages.begin(), stages.end());
        join(stages);
        if (stages.size() < 2) return {};
        std::vector<Step> steps;
        steps.reserve(stages.size());
        for (Stage& stage : stages) steps.push_back(std::move(stage.moves));
        return steps;
    }

    // The law of a joint of `part` in these steps.
    [[nodiscard]] Law law_in(int joint, int part, const std::vector<Step>& steps) const {
        const double wide = kFlatDeg / static_cast<double>(steps.size());
        const Law& own = nth(laws_, joint);
        Law law;
        for (std::size_t i = steps.size(); i-- > 0;) {  // by opening, ascending
            const auto move =
                std::find_if(steps[i].begin(), steps[i].end(), [&](const Move& m) { return m.part == part; });
            if (move == steps[i].end()) continue;
            // Steps share their ends to the last digit, or there would be ranges of no width.
            const double low = kFlatDeg - wide * static_cast<double>(i + 1);
            const double high = kFlatDeg - wide * static_cast<double>(i);
            if (move->doing == kMoves) {
                law = own;
                for (Vec2& point : law) point.x = low + wide * (point.x / kFlatDeg);
                return law;
            }
            const double here = angle_at(own, move->doing.end);
            if (!law.empty() && law.back().x < low) add_range(law, {low, here});
            if (law.empty()) law.push_back({low, here});
            add_range(law, {high, angle_at(own, move->doing.begin)});
        }
        return law;
    }
    // How far a fold of the part has gone at a share, degrees.
    [[nodiscard]] double turned_deg(int part, double share) const {
        return std::abs(angle_at(nth(laws_, nth(parts_, part).joints.front()), share));
    }
    [[nodiscard]] const std::vector<OrderedPart>& parts() const { return parts_; }
    // Whether nothing passes through anything in any step, but for what crosses in the end.
    [[nodiscard]] bool is_all_clear() const { return all_clear_; }
    [[nodiscard]] bool could_go_at_once() const { return all_at_once_; }
    [[nodiscard]] const PlatePairs& crossing_in_the_end() const { return set_aside_; }

 private:
    static double angle_at(const Law& own, double share) {
        return own.back().y + share * (own.front().y - own.back().y);
    }
    // Leads a law straight on to a point.
    static void add_range(Law& law, Vec2 to) {
        const Vec2 from = law.back();
        for (std::size_t i = 1; i < Folded::kLawSteps; ++i) law.push_back(lerp(from, to, chebyshev_share(i)));
        law.push_back(to);
    }

    void find_parts() {
        Sets sets(work_.joints.size());
        std::vector<int> placed_by(work_.plates.size(), -1);  // the fold that places a plate
        std::vector<int> base(work_.plates.size(), -1);
        std::vector<int> depth(work_.plates.size(), 0);
        for (std::size_t i = 0; i < work_.joints.size(); ++i) {
            if (const auto* const folded = std::get_if<Folded>(&work_.joints[i].how)) {
                nth(placed_by, folded->plate) = static_cast<int>(i);
                nth(base, folded->plate) = folded->base;
                nth(depth, folded->plate) = nth(depth, folded->base) + 1;
            }
        }
        for (std::size_t i = 0; i < work_.joints.size(); ++i) {
            const auto* const closing = std::get_if<LoopFold>(&work_.joints[i].how);
            if (closing == nullptr) continue;
            int a = closing->plate;
            int b = closing->base;
            while (a != b) {
                int& deeper = nth(depth, a) >= nth(depth, b) ? a : b;
                if (nth(placed_by, deeper) < 0) break;
                sets.unite(static_cast<int>(i), nth(placed_by, deeper));
                deeper = nth(base, deeper);
            }
        }
        std::vector<double> area_of(work_.plates.size(), 0.0);  // with all that hangs on a plate
        for (std::size_t i = work_.joints.size(); i-- > 0;) {
            const auto* const folded = std::get_if<Folded>(&work_.joints[i].how);
            if (folded == nullptr) continue;
            nth(area_of, folded->plate) += area(nth(work_.plates, folded->plate).outline);
            nth(area_of, folded->base) += nth(area_of, folded->plate);
        }
        std::vector<int> number(work_.joints.size(), -1);
        for (std::size_t i = 0; i < work_.joints.size(); ++i) {
            const Law& law = laws_[i];
            if (law.empty()) continue;
            int& of = nth(number, sets.find(static_cast<int>(i)));
            if (of < 0) {
                of = static_cast<int>(parts_.size());
                parts_.emplace_back();
            }
            OrderedPart& part = nth(parts_, of);
            part.joints.push_back(static_cast<int>(i));
            if (const auto* const folded = std::get_if<Folded>(&work_.joints[i].how))
                part.area = std::max(part.area, nth(area_of, folded->plate));
        }
        std::erase_if(parts_, [this](const OrderedPart& part) {
            return std::all_of(part.joints.begin(), part.joints.end(), [this](int joint) {
                const Law& law = nth(laws_, joint);
                return std::all_of(law.begin(), law.end(), [](Vec2 point) { return point.y == 0.0; });
            });
        });
        parts_at_.resize(work_.plates.size());
        std::vector<int> mover(work_.plates.size(), -1);
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            for (const int joint : parts_[i].joints) {
                const auto* const folded = std::get_if<Folded>(&nth(work_.joints, joint).how);
                if (folded == nullptr) continue;
                nth(mover, folded->plate) = static_cast<int>(i);
                nth(parts_at_, folded->plate).push_back(static_cast<int>(i));
                nth(parts_at_, folded->base).push_back(static_cast<int>(i));
            }
        }
        seen_.emplace(base, mover);
    }

    void set_all(Doing doing) { doing_.assign(parts_.size(), doing); }

    [[nodiscard]] bool has_work_left() const { return poses_ <= kMostPosesAPart * parts_.size(); }

    // Sets the laws to what each part is doing.
    void set_laws() {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            for (const int joint : parts_[i].joints) {
                Law& law = *law_of(nth(work_.joints, joint));
                const Law& own = nth(laws_, joint);
                if (doing_[i] == kMoves) {
                    law = own;
                } else {
                    law = {{0.0, angle_at(own, doing_[i].end)}, {kFlatDeg, angle_at(own, doing_[i].begin)}};
                }
            }
        }
    }

    // False, too, when the work has run out.
    bool is_clear() {
        set_laws();
        Linkage linkage(work_);
        seen_->set(numbers_of(doing_), still_);
        const bool clear = popup::is_clear(work_, linkage, shapes_, options_, set_aside_, *seen_, poses_);
        return has_work_left() && clear;
    }

    // Of what each part is doing, the same for the same.
    std::vector<int> numbers_of(const std::vector<Doing>& doing) {
        std::vector<int> numbers;
        for (const Doing one : doing) {
            const auto known = std::find(done_.begin(), done_.end(), one);
            numbers.push_back(static_cast<int>(known - done_.begin()));
            if (known != done_.end()) continue;
            done_.push_back(one);
            still_.push_back(one.begin == one.end ? 1 : 0);
        }
        return numbers;
    }

    // The steps of opening it; what does not open so is the last one.
    std::vector<Stage> unfold(OpenFirst first) {
        first_ = first;
        set_all(kFolded);
        set_laws();
        const PlateFrames closed = frames_at(work_, 0.0);
        std::vector<int> left = opening_order(work_, parts_, closed, first);
        touching_ = touching_plates(work_, shapes_, closed);
        for (const auto& pair : set_aside_) touching_.erase(pair);
        wish_sides(work_, closed, touching_);
        std::vector<Stage> stages;
        while (!left.empty() && has_work_left()) {
            if (open_one(left, stages)) continue;
            heeds_wishes_ = false;
            const bool opened = open_one(left, stages);
            heeds_wishes_ = true;
            if (!opened) break;
        }
        all_clear_ = left.empty();
        if (!left.empty()) {
            stages.emplace_back();
            for (const int part : left) stages.back().moves.push_back({part, kMoves});
        }
        return stages;
    }

    // Opens a part, or a lid with its flap: the first that opens by itself, of the lid before the bottom, and
    // of both before walls.
    bool open_one(std::vector<int>& left, std::vector<Stage>& stages) {
        if (!ranked()) return open_one_of(std::vector<int>(left), left, stages);
        for (const BoxPart of : {BoxPart::lid, BoxPart::bottom, BoxPart::walls}) {
            std::vector<int> group = left;
            std::erase_if(group, [&](int part) { return nth(of_box_, part).part != of; });
            if (open_one_of(group, left, stages)) return true;
        }
        return false;
    }

    // A tucked flap leaves with its lid, or where paper would have to give way for that, by itself, before
    // walls are tried: they could well be laid on it from outside.
    bool open_one_of(const std::vector<int>& group, std::vector<int>& left, std::vector<Stage>& stages) {
        for (const int part : group) {
            if (heeds_wishes_ && is_under(part)) continue;
            if (go({{part, kMoves}}, stages)) {
                std::erase(left, part);
                return true;
            }
            if (!is_tucked(part)) continue;
            if (goes_upright(part) && open_upright(part, left, stages)) return true;
            if (go({{part, kMoves}}, stages, Wishes::of_others)) {
                std::erase(left, part);
                return true;
            }
        }
        return std::any_of(group.begin(), group.end(), [&](int part) {
            return !is_tucked(part) && goes_upright(part) && open_upright(part, left, stages);
        });
    }
    [[nodiscard]] bool is_under(int part) const {
        return std::any_of(nth(over_, part).begin(), nth(over_, part).end(),
                           [&](int lining) { return nth(doing_, lining) == kFolded; });
    }
    [[nodiscard]] bool goes_upright(int part) const { return !ranked() || !nth(of_box_, part).closes; }
    [[nodiscard]] bool ranked() const { return first_ == OpenFirst::lids; }

    // Opens it by a step, if that is clear and leaves what touches on its sides.
    bool go(Step step, std::vector<Stage>& stages, Wishes wishes = Wishes::all) {
        const std::vector<Doing> before = doing_;
        for (const Move& move : step) nth(doing_, move.part) = move.doing;
        const int own = wishes == Wishes::of_others ? plate_of(step.front().part) : -1;
        if (!keeps_sides(own) || !is_clear()) {
            doing_ = before;
            return false;
        }
        TouchingPlates opened = touching_when_opened();
        for (const Move& move : step) nth(doing_, move.part) = {move.doing.begin, move.doing.begin};
        stages.push_back({std::move(step), std::move(touching_), opened});
        touching_ = std::move(opened);
        return true;
    }

    // Whether what touches at the beginning of opening a step leaves to the sides it is on. Wishes of the
    // plate `but` do not count.
    bool keeps_sides(int but = -1) {
        set_laws();
        TouchingPlates held = touching_;
        std::erase_if(held, [&](const auto& known) {
            const auto& [pair, one] = known;
            return one.wished && (!heeds_wishes_ || pair.first == but || pair.second == but);
        });
        return leave_to_their_sides(work_, shapes_, held);
    }
    // What touches when the step is opened, from what touches when it is folded.
    [[nodiscard]] TouchingPlates touching_when_opened() {
        set_laws();
        return touching_at_end(work_, shapes_, touching_);
    }

    // A flap that is to lie on the inside of a wall, from which a lid that it hangs on takes it, and that is
    // not glued there.
    [[nodiscard]] bool is_tucked(int part) const {
        const int flap = plate_of(part);
        if (flap < 0 || nth(work_.plates, flap).name.find(kGlueFlapName) != std::string::npos) return false;
        const std::vector<int> lids = lids_of(part);
        return std::any_of(touching_.begin(), touching_.end(), [&](const auto& known) {
            const auto& [pair, one] = known;
            if (!one.wished || (pair.first != flap && pair.second != flap)) return false;
            return std::any_of(lids.begin(), lids.end(), [&, ends = pair](int lid) {
                return hangs_on(ends.first, plate_of(lid)) != hangs_on(ends.second, plate_of(lid));
            });
        });
    }
    // The plate of a part that is one fold; -1: it is none such.
    [[nodiscard]] int plate_of(int part) const {
        const Folded* const own = single_fold(part);
        return own == nullptr ? -1 : own->plate;
    }
    [[nodiscard]] bool hangs_on(int plate, int on) const {
        while (plate >= 0 && plate != on) plate = nth(work_.plates, plate).parent;
        return plate >= 0;
    }

    // The one fold of a part whose way is straight; null: it is none such.
    [[nodiscard]] const Folded* single_fold(int part) const {
        const std::vector<int>& joints = nth(parts_, part).joints;
        if (joints.size() != 1 || nth(laws_, joints.front()).size() != 2) return nullptr;
        return std::get_if<Folded>(&nth(work_.joints, joints.front()).how);
    }

    // What turns a lid against the rest of the box, as seen from a flap on that lid: the fold by which the
    // lid hangs, or where the box hangs on the lid a larger part that hangs there, too. All fold the same way
    // about parallel lines.
    [[nodiscard]] std::vector<int> lids_of(int flap) const {
        std::vector<int> lids;
        const Folded* const own = single_fold(flap);
        if (own == nullptr) return lids;
        for (const int other : nth(parts_at_, own->base)) {
            const Folded* const lid = other == flap ? nullptr : single_fold(other);
            if (lid == nullptr || std::abs(cross(own->dir, lid->dir)) > kParallelRad) continue;
            if (nth(parts_, other).area <= nth(parts_, flap).area) continue;
            const Law& law = nth(laws_, nth(parts_, other).joints.front());
            if (law.front().y * nth(laws_, nth(parts_, flap).joints.front()).front().y > 0.0)
                lids.push_back(other);
        }
        return lids;
    }

    // Opens a flap with a lid that it hangs on; false where there is none that opens so.
    bool open_upright(int flap, std::vector<int>& left, std::vector<Stage>& stages) {
        for (const int lid : lids_of(flap)) {
            if (nth(doing_, lid) != kFolded || !open_upright(flap, lid, stages)) continue;
            std::erase_if(left, [&](int part) { return part == flap || part == lid; });
            return true;
        }
        return false;
    }

    bool open_upright(int flap, int lid, std::vector<Stage>& stages) {
        const double lid_deg = turned_deg(lid, 1.0);
        const double flap_deg = turned_deg(flap, 1.0);
        const std::vector<Doing> doing = doing_;
        const TouchingPlates touching = touching_;
        const std::size_t count = stages.size();
        for (const double by : kUprightDeg) {
            if (by >= lid_deg || flap_deg + by > kFlatDeg || !has_work_left()) return false;
            const double risen = 1.0 - by / lid_deg;
            const double turned = 1.0 + by / flap_deg;
            // Further up it would go the same way first.
            if (!go({{flap, {turned, 1.0}}, {lid, {risen, 1.0}}}, stages)) return false;
            if (go({{lid, {0.0, risen}}}, stages) && go({{flap, {0.0, turned}}}, stages)) return true;
            doing_ = doing;
            touching_ = touching;
            stages.resize(count);
        }
        return false;
    }

    // Steps that can go at once with the one before do.
    void join(std::vector<Stage>& stages) {
        for (std::size_t i = 0; i + 1 < stages.size() && has_work_left();) {
            set_all(kFlat);
            for (std::size_t k = 0; k < i; ++k) {
                for (const Move& move : stages[k].moves)
                    nth(doing_, move.part) = {move.doing.end, move.doing.end};
            }
            if (!join_two(stages[i], stages[i + 1])) {
                ++i;
                continue;
            }
            stages.erase(stages.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        }
    }

    // Walls stand before the bottom is closed, it is closed before the lid comes down, and corners are in
    // before a wall is rolled over them, even where they could go at once.
    [[nodiscard]] bool goes_early(const Stage& first, const Stage& second) const {
        const auto before = [this](int a, int b) {
            const OfBox& lid = nth(of_box_, b);
            const std::vector<int>& over = nth(over_, a);
            return (lid.closes && nth(of_box_, a).part < lid.part) ||
                   std::find(over.begin(), over.end(), b) != over.end();
        };
        return std::any_of(first.moves.begin(), first.moves.end(), [&](const Move& a) {
            return std::any_of(second.moves.begin(), second.moves.end(), [&](const Move& b) {
                return before(a.part, b.part) || before(b.part, a.part);
            });
        });
    }

    // Makes one of two, if that is clear, and everything comes to lie as it does one after the other.
    bool join_two(Stage& first, const Stage& second) {
        const bool once = std::none_of(first.moves.begin(), first.moves.end(), [&](const Move& a) {
            return std::any_of(second.moves.begin(), second.moves.end(),
                               [&](const Move& b) { return a.part == b.part; });
        });
        if (!once || goes_early(first, second)) return false;
        Step both = first.moves;
        both.insert(both.end(), second.moves.begin(), second.moves.end());
        for (const Move& move : both) nth(doing_, move.part) = move.doing;
        touching_ = second.folded;
        if (!keeps_sides() || !is_clear()) return false;
        for (const auto& [pair, one] : touching_when_opened()) {
            const auto known = first.opened.find(pair);
            if (known != first.opened.end() && known->second.side * one.side < 0) return false;
        }
        first.moves = std::move(both);
        first.folded = second.folded;
        return true;
    }

    Assembly work_;
    MotionOptions options_;
    std::vector<Law> laws_;  // by joint, all at once
    std::vector<OrderedPart> parts_;
    std::vector<OfBox> of_box_;               // by part
    std::vector<std::vector<int>> over_;      // by part, as rolled_over_by()
    std::vector<std::vector<int>> parts_at_;  // by plate: those of which a fold is at it
    std::vector<Doing> doing_;                // by part
    std::vector<PlateShape> shapes_;          // by plate; folding changes none
    PlatePairs set_aside_;
    std::optional<SeenPairs> seen_;
    TouchingPlates touching_;  // where the parts are folded that have not been opened yet
    bool heeds_wishes_ = true;
    std::vector<Doing> done_;  // by the numbers that seen_ has, as the next
    std::vector<char> still_;
    std::size_t poses_ = 0;
    OpenFirst first_ = OpenFirst::small;
    bool all_clear_ = true;
    bool all_at_once_ = false;  // nothing passes through anything where all folds go at a time
};

std::string names_of(const Assembly& assembly, const Order& order, const Step& step) {
    std::vector<std::pair<int, std::string>> plates;  // with how far they go, if that is not where they end
    for (const Move& move : step) {
        std::string far;
        if (move.doing.end != 1.0)
            far = fmt::format(" to {:.0f}°", order.turned_deg(move.part, move.doing.end));
        for (const int joint : nth(order.parts(), move.part).joints) {
            if (const auto* const folded = std::get_if<Folded>(&nth(assembly.joints, joint).how))
                plates.emplace_back(folded->plate, far);
        }
    }
    std::sort(plates.begin(), plates.end());
    std::string names;
    for (std::size_t i = 0; i < plates.size() && i < kToldAtMost; ++i) {
        if (i > 0) names += ", ";
        names += nth(assembly.plates, plates[i].first).name + plates[i].second;
    }
    if (plates.size() > kToldAtMost) names += fmt::format(" and {} more", plates.size() - kToldAtMost);
    return names;
}

}  // namespace

bool order_folds(Assembly& assembly, const MotionOptions& options, Diagnostics& diagnostics,
                 const Examination* at_once) {
    const bool goes_all_the_way =
        std::all_of(assembly.joints.begin(), assembly.joints.end(), [](Joint& joint) {
            const Law* const law = law_of(joint);
            return law == nullptr || (law->front().x == 0.0 && law->back().x == kFlatDeg);
        });
    if (assembly.sweep.bends || !goes_all_the_way) return false;
    Order order(assembly, options);
    const std::vector<Step> steps = order.run(at_once);
    if (steps.empty()) return false;
    std::string told;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        for (const Move& move : steps[i]) {
            for (const int joint : nth(order.parts(), move.part).joints)
                *law_of(nth(assembly.joints, joint)) = order.law_in(joint, move.part, steps);
        }
        told += fmt::format("{}{}", i == 0 ? "" : "; then ", names_of(assembly, order, steps[i]));
    }
    auto& remark =
        diagnostics.remark("folds-in-order", {},
                           fmt::format("{} in {} steps, {}",
                                       order.could_go_at_once() ? "its folds go as a box is closed,"
                                                                : "its folds cannot all go at once: they go",
                                       steps.size(), told));
    if (!order.is_all_clear()) {
        remark.hint(
            "for the panels of the first step no order was found in which none passes through another");
    } else if (const PlatePairs& aside = order.crossing_in_the_end(); !aside.empty()) {
        const auto [a, b] = *aside.begin();
        remark.hint(fmt::format(
            "where it ends \"{}\" goes through \"{}\"{}, in any order; nothing else passes through anything "
            "in this one",
            nth(assembly.plates, a).name, nth(assembly.plates, b).name,
            aside.size() > 1 ? fmt::format(", as do {} more", aside.size() - 1) : ""));
    } else {
        remark.hint("fold it in that order, too");
    }
    return true;
}

}  // namespace popup
