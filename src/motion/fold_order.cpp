// An order for the folds of a sheet. It is searched from the end, as one finds out how a box is closed by
// opening it: what is folded last can be unfolded first, and what has been unfolded is out of the way of most
// others, so that a choice is seldom wrong.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/nth.h"
#include "base/sets.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kFlatDeg = 180.0;
// More parts than this are not put in an order, and no more poses are looked at.
constexpr std::size_t kMostParts = 64;
constexpr std::size_t kMostPoses = 4'000'000;
constexpr std::size_t kToldAtMost = 6;  // plates of a step

using Law = std::vector<Vec2>;

Law* law_of(Joint& joint) {
    if (auto* const folded = std::get_if<Folded>(&joint.how)) return &folded->law;
    if (auto* const closing = std::get_if<LoopFold>(&joint.how)) return &closing->law;
    return nullptr;
}

// Folds that only go together.
struct Part {
    std::vector<int> joints;  // ascending
    double area = 0.0;        // of what it moves
};

// What is looked at: in which parts move, which are folded already, and which still lie flat.
enum class Doing : char { flat, moves, folded };

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
    }

    // The steps, each with parts that go at once. Empty: all may go at once, or there is nothing to be put in
    // an order, or no order was found.
    std::vector<std::vector<int>> run(const Examination* at_once) {
        if (parts_.size() < 2 || parts_.size() > kMostParts) return {};
        set_all(Doing::moves);
        if (at_once != nullptr ? shows_clear(*at_once) : is_clear()) return {};
        // What crosses in the end, as two flaps do that are drawn too long, crosses in any order.
        set_all(Doing::folded);
        look();
        for (const Contact& contact : found_.contacts) set_aside_.insert({contact.a, contact.b});
        set_all(Doing::moves);
        if (!set_aside_.empty() && is_clear()) return {};
        std::vector<std::vector<int>> steps = unfold();
        std::reverse(steps.begin(), steps.end());
        join(steps);
        return steps.size() > 1 ? steps : std::vector<std::vector<int>>{};
    }

    // The law of a joint when its part goes in step `step` of `steps`.
    [[nodiscard]] Law law_in(int joint, std::size_t step, std::size_t steps) const {
        Law law = nth(laws_, joint);
        const double wide = kFlatDeg / static_cast<double>(steps);
        const double end = kFlatDeg - wide * static_cast<double>(step + 1);
        for (Vec2& point : law) point.x = end + wide * (point.x / kFlatDeg);
        return law;
    }
    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    // Whether nothing passes through anything in any step, but for what crosses in the end.
    [[nodiscard]] bool is_all_clear() const { return all_clear_; }

 private:
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
            Part& part = nth(parts_, of);
            part.joints.push_back(static_cast<int>(i));
            if (const auto* const folded = std::get_if<Folded>(&work_.joints[i].how))
                part.area = std::max(part.area, nth(area_of, folded->plate));
        }
        std::erase_if(parts_, [this](const Part& part) {
            return std::all_of(part.joints.begin(), part.joints.end(), [this](int joint) {
                const Law& law = nth(laws_, joint);
                return std::all_of(law.begin(), law.end(), [](Vec2 point) { return point.y == 0.0; });
            });
        });
    }

    void set_all(Doing doing) { doing_.assign(parts_.size(), doing); }

    // False when the work ran out.
    bool look() {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            for (const int joint : parts_[i].joints) {
                Law& law = *law_of(nth(work_.joints, joint));
                const Law& own = nth(laws_, joint);
                if (doing_[i] == Doing::moves) {
                    law = own;
                } else {
                    const double angle = doing_[i] == Doing::folded ? own.front().y : own.back().y;
                    law.assign(2, {0.0, angle});
                    law.back().x = kFlatDeg;
                }
            }
        }
        found_ = examine(work_, options_);
        poses_ += found_.poses;
        return poses_ <= kMostPoses;
    }

    bool is_clear() { return look() && shows_clear(found_); }

    [[nodiscard]] bool shows_clear(const Examination& found) const {
        return found.undecided.empty() && found.decided_up_to_deg >= kFlatDeg &&
               std::all_of(found.contacts.begin(), found.contacts.end(), [this](const Contact& contact) {
                   return set_aside_.contains({contact.a, contact.b});
               });
    }

    // The steps of opening it, one part each; what does not open so is the last one.
    std::vector<std::vector<int>> unfold() {
        std::vector<int> left(parts_.size());
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
        // Flaps before the walls that they hang on.
        std::stable_sort(left.begin(), left.end(),
                         [this](int a, int b) { return nth(parts_, a).area < nth(parts_, b).area; });
        set_all(Doing::folded);
        std::vector<std::vector<int>> steps;
        while (!left.empty() && poses_ <= kMostPoses) {
            const auto found = std::find_if(left.begin(), left.end(), [this](int part) {
                nth(doing_, part) = Doing::moves;
                const bool clear = is_clear();
                nth(doing_, part) = Doing::folded;
                return clear;
            });
            if (found == left.end()) break;
            nth(doing_, *found) = Doing::flat;
            steps.push_back({*found});
            left.erase(found);
        }
        all_clear_ = left.empty();
        if (!left.empty()) steps.push_back(std::move(left));
        return steps;
    }

    // Steps that can go at once with the one before do.
    void join(std::vector<std::vector<int>>& steps) {
        for (std::size_t i = 0; i + 1 < steps.size() && poses_ <= kMostPoses;) {
            set_all(Doing::flat);
            for (std::size_t k = 0; k <= i + 1; ++k) {
                for (const int part : steps[k]) nth(doing_, part) = k < i ? Doing::folded : Doing::moves;
            }
            if (!is_clear()) {
                ++i;
                continue;
            }
            steps[i].insert(steps[i].end(), steps[i + 1].begin(), steps[i + 1].end());
            steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        }
    }

    Assembly work_;
    MotionOptions options_;
    std::vector<Law> laws_;  // by joint, all at once
    std::vector<Part> parts_;
    std::vector<Doing> doing_;  // by part
    Examination found_;
    std::set<std::pair<int, int>> set_aside_;  // plates
    std::size_t poses_ = 0;
    bool all_clear_ = true;
};

std::string names_of(const Assembly& assembly, const std::vector<Part>& parts, const std::vector<int>& step) {
    std::vector<int> plates;
    for (const int part : step) {
        for (const int joint : nth(parts, part).joints) {
            if (const auto* const folded = std::get_if<Folded>(&nth(assembly.joints, joint).how))
                plates.push_back(folded->plate);
        }
    }
    std::sort(plates.begin(), plates.end());
    std::string names;
    for (std::size_t i = 0; i < plates.size() && i < kToldAtMost; ++i) {
        if (i > 0) names += ", ";
        names += nth(assembly.plates, plates[i]).name;
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
    const std::vector<std::vector<int>> steps = order.run(at_once);
    if (steps.empty()) return false;
    std::string told;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        for (const int part : steps[i]) {
            for (const int joint : nth(order.parts(), part).joints)
                *law_of(nth(assembly.joints, joint)) = order.law_in(joint, i, steps.size());
        }
        told += fmt::format("{}{}", i == 0 ? "" : "; then ", names_of(assembly, order.parts(), steps[i]));
    }
    auto& remark = diagnostics.remark(
        "folds-in-order", {},
        fmt::format("its folds cannot all go at once: they go in {} steps, {}", steps.size(), told));
    if (order.is_all_clear()) {
        remark.hint("fold it in that order, too");
    } else {
        remark.hint(
            "for the panels of the first step no order was found in which none passes through another");
    }
    return true;
}

}  // namespace popup
